"""Where the numbers of a pane stand and what they say."""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QObject, Qt

from app.core.arrays import FloatArray
from app.imaging.volume import Volume
from app.views.kit import theme
from app.views.kit.coordinates import lps_words
from app.views.kit.names import NAMES
from app.views.kit.text import tr
from app.views.slices.canvas import SliceCanvas
from app.views.slices.needle_source import Along
from app.views.slices.panes import PANE_MARKS, PaneId, pane_name
from app.views.slices.plane import SlicePlane
from app.views.slices.words import PADDING, Overlay, Ruler

_A = Qt.AlignmentFlag

_ROOMY = 22
"""Width of a pane in heights of its letters from which the zoom is written too."""


SHOWN_TILT_DEG = 0.5
"""From this angle to the patient's axes a plane is called oblique."""


def needle_slice_words(plane: SlicePlane, index: float, along: Along = Along.NEEDLE) -> str:
    """Say where a slice of a needle's pane stands, of what the pane is laid along."""
    offset = index * plane.step_mm
    at = {Along.PATH: tr("the target"), Along.POINTS: tr("the 2nd point")}.get(along, tr("the tip"))
    line = {Along.PATH: tr("the path"), Along.POINTS: tr("both points")}.get(
        along, tr("the needle")
    )
    if plane.pane is PaneId.PROBE:
        if abs(offset) < 0.05:
            return tr("at {place}", place=at)
        if offset > 0.0:
            return tr("{distance:.0f} mm ahead of {place}", distance=offset, place=at)
        return tr("{distance:.0f} mm behind {place}", distance=-offset, place=at)
    if abs(offset) < 0.05:
        return tr("through {line}", line=line)
    side = plane.towards(offset)
    return tr("{distance:.0f} mm {side} of {line}", distance=abs(offset), side=side, line=line)


class Readouts(QObject):
    """Corner texts, edge letters and ruler of one canvas, kept up to date."""

    def __init__(self, canvas: SliceCanvas) -> None:
        super().__init__(canvas)
        self._canvas = canvas
        self._hovered: FloatArray | None = None
        self._note, self._along = "", Along.NEEDLE
        self.title = Overlay(canvas, _A.AlignLeft | _A.AlignTop)
        self.window = Overlay(canvas, _A.AlignRight | _A.AlignTop)
        self.cursor = Overlay(canvas, _A.AlignLeft | _A.AlignBottom)
        self.slice = Overlay(canvas, _A.AlignRight | _A.AlignBottom)
        edges = (
            _A.AlignLeft | _A.AlignVCenter,
            _A.AlignRight | _A.AlignVCenter,
            _A.AlignHCenter | _A.AlignTop,
            _A.AlignHCenter | _A.AlignBottom,
        )
        self.letters = tuple(
            Overlay(canvas, edge, theme.IMAGE_WARNING, bold=True, larger=3) for edge in edges
        )
        self.ruler = Ruler(canvas)
        for one in (self.title, self.window, self.cursor, self.slice, *self.letters, self.ruler):
            canvas.written.append(one)
        self._room: tuple[object, ...] = ()
        self._size: tuple[object, ...] = ()
        self._is_new = True
        canvas.changed.connect(self.refresh)
        canvas.left.connect(self.clear_cursor)
        canvas.plane_taken.connect(self.show_plane)
        NAMES.changed.connect(self.show_plane)

    def show_plane(self) -> None:
        """Write everything anew with the next drawing, as the plane is another one."""
        self._is_new = True
        self._canvas.rewrite()

    def _write_plane(self) -> None:
        """Write what stays the same for a plane; nothing where there is none."""
        plane, volume = self._canvas.plane, self._canvas.viewing.volume
        pane = self._canvas.pane
        colour = PANE_MARKS[pane].colour
        if plane is None or volume is None:
            for overlay in (self.window, self.cursor, self.slice, *self.letters):
                overlay.set_lines()
            self.title.set_lines(pane_name(pane), self._note, first=colour)
            self.ruler.setVisible(False)
            return
        self.ruler.setVisible(True)
        note = self._note or tr("{step:.2f} mm slices", step=plane.step_mm)
        name = NAMES.shown(volume.series.pseudonym)
        lines = [pane_name(pane), name, note, *_made(volume), *self._special_view(plane)]
        self.title.set_lines(*lines, first=colour)
        for overlay, letter in zip(self.letters, plane.letters(), strict=True):
            overlay.set_lines(letter)

    def _special_view(self, plane: SlicePlane) -> list[str]:
        """Say what a reader must not overlook: that it is a slab, that it is turned."""
        presentation = self._canvas.viewing.presentation(self._canvas.pane)
        slab = presentation.slab
        if slab:  # of whole slices it is as thick as they are
            slab = replace(slab, thickness_mm=round(plane.thickness_mm, 2))
        notes = (("▣", slab.words()), ("↻", presentation.turn.words()))
        return [f"{sign} {words}" for sign, words in notes if words]

    def _zoom(self) -> list[str]:
        """Say the zoom where there is room for it beside the title."""
        if self._canvas.width() < _ROOMY * theme.SMALL_PX:
            return []
        return [tr("Zoom {zoom:.1f} px/mm", zoom=self._canvas.camera.scale)]

    def set_note(self, note: str, along: Along = Along.NEEDLE) -> None:
        """Say something else below the title than how thick the slices are.

        Args:
            note: what is said.
            along: what a needle's pane is laid along.
        """
        if (note, along) != (self._note, self._along):
            self._note, self._along = note, along
            self.show_plane()

    def refresh(self) -> None:
        """Write slice, window and zoom, and what has to do with a new plane."""
        if self._is_new:
            self._is_new = False
            self._write_plane()
        plane = self._canvas.plane
        if plane is None:
            self._place()
            return
        greys, index = self._canvas.viewing.greys, self._canvas.index
        window = greys.of(self._canvas.pane)
        notes = [tr("locked")] if greys.is_locked else []
        notes += [tr("inverted")] if greys.is_inverted else []
        self.window.set_lines(
            tr("W {width:.0f}  L {level:.0f}", width=window.width, level=window.level),
            *notes,
            *self._zoom(),
        )
        self.slice.set_lines(*self._slice_words(plane, index))
        self.ruler.set_scale(self._canvas.camera.scale)
        self._follow_slice()
        self._place()

    def _follow_slice(self) -> None:
        """Keep the read-out under a resting mouse true while the slices scroll below it."""
        plane, index = self._canvas.plane, self._canvas.index
        if plane is not None and self._hovered is not None:
            at = plane.point(self._hovered, index)
            if abs(at.distance) > 1e-6:
                self.show_cursor(plane.lps_mm(at.x, at.y, index))

    def show_cursor(self, lps_mm: FloatArray) -> None:
        """Write the point under the mouse and its Hounsfield units."""
        volume = self._canvas.viewing.volume
        hu = None if volume is None else volume.hu_at(lps_mm, "nearest")
        unit = "" if volume is None or not volume.unit else f" {volume.unit}"
        self._hovered = lps_mm
        self.cursor.set_lines(
            tr("outside the image") if hu is None else f"{hu:.0f}{unit}",
            lps_words(lps_mm),
        )

    def clear_cursor(self) -> None:
        """Forget the mouse."""
        self._hovered = None
        self.cursor.set_lines()

    def _slice_words(self, plane: SlicePlane, index: float) -> tuple[str, ...]:
        if plane.pane.is_needle:
            return (needle_slice_words(plane, index, self._along),)
        tilt = plane.tilt_deg
        return (
            tr("{angle:.0f}° oblique", angle=tilt) if tilt > SHOWN_TILT_DEG else "",
            tr("{position} mm", position=self._position()),
            tr("Slice {number} / {count}", number=round(index) + 1, count=plane.count),
        )[tilt <= SHOWN_TILT_DEG :]

    def _position(self) -> str:
        """Patient coordinate of the slice along its own axis, with the axis' letter."""
        plane, cursor = self._canvas.plane, self._canvas.viewing.cursor_mm
        if plane is None:
            return ""
        axis = plane.normal_axis
        value = float(cursor[axis])
        return f"{'RLAPIS'[2 * axis + (value >= 0)]} {abs(value):.1f}"

    def _place(self) -> None:
        canvas, below, words = self._canvas, self.letters[3], self.slice
        size = (canvas.width(), canvas.height(), theme.SMALL_PX, canvas.devicePixelRatioF())
        room = (size, below.lines, words.lines)
        if room == self._room:
            return
        self._room = room
        if size != self._size:  # else who changed has placed itself
            self._size = size
            for overlay in (self.title, self.window, self.cursor, words, *self.letters):
                overlay.place()
        below.place()
        if below.geometry().intersects(words.geometry()):  # a narrow pane: the letter gives way
            left = words.pos().x() - below.geometry().width() - PADDING
            below.move(max(PADDING, left), below.pos().y())
        bar = self.ruler.geometry()
        above = self.slice.pos().y() - bar.height() - 2
        self.ruler.move(self._canvas.width() - PADDING - bar.width(), above)


def _made(volume: Volume) -> list[str]:
    """Say what a reader must not overlook of the volume: that it is not as its files are."""
    lines = [f"≈ {words}" for words in volume.made]
    if volume.series.tilt_deg and not volume.made:
        lines.append(tr("gantry tilt {angle:.1f}°", angle=volume.series.tilt_deg))
    if volume.unit != "HU":
        lines.append(tr("{modality}: no Hounsfield units", modality=volume.series.modality))
    return lines
