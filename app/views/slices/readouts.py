"""Where the numbers of a pane stand and what they say.

None covers another in a pane of any size: where there is no room the least important line goes
first, and the whole text is in the tooltip of what is left.
"""

from __future__ import annotations

from dataclasses import replace

from PySide6.QtCore import QObject, QRect
from PySide6.QtGui import QHelpEvent
from PySide6.QtWidgets import QToolTip

from app.core.arrays import FloatArray
from app.imaging.volume import Volume
from app.views.kit import theme
from app.views.kit.coordinates import lps_words
from app.views.kit.names import NAMES
from app.views.kit.text import literal, number, tr
from app.views.slices.canvas import SliceCanvas
from app.views.slices.edges import EdgeWords, window_line
from app.views.slices.needle_source import Along
from app.views.slices.panes import PANE_MARKS, PaneId, pane_name
from app.views.slices.plane import SlicePlane
from app.views.slices.words import Line, Worth

COUNTED_PX = 320
"""Width of a pane below which it is not said which slice of how many it is: the place says more."""

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
        self._edges = edges = EdgeWords(canvas)
        self.title, self.window, self.cursor, self.slice = edges.corners
        self.letters, self.ruler = edges.letters, edges.ruler
        canvas.written.extend(edges.everything)
        self._arranged: tuple[object, ...] = ()
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
        title, colour = (pane_name(pane), Worth.TITLE), PANE_MARKS[pane].colour
        if plane is None or volume is None:
            for overlay in (self.window, self.cursor, self.slice, *self.letters):
                overlay.set_lines()
            self.title.set_lines(title, (self._note, Worth.WARNING), first=colour)
            self.ruler.setVisible(False)
            return
        note = (self._note, Worth.WARNING)
        if not self._note:
            note = (tr("{step:.2f} mm slices", step=plane.step_mm), Worth.THICKNESS)
        name = (NAMES.shown(volume.series.pseudonym), Worth.NAME)
        special = [(words, Worth.WARNING) for words in (*_made(volume), *self._special_view(plane))]
        self.title.set_lines(title, name, note, *special, first=colour)
        self._edges.set_letters(plane.letters())

    def _special_view(self, plane: SlicePlane) -> list[str]:
        """Say what a reader must not overlook: that it is a slab, that it is turned."""
        presentation = self._canvas.viewing.presentation(self._canvas.pane)
        slab = presentation.slab
        if slab:  # of whole slices it is as thick as they are
            slab = replace(slab, thickness_mm=round(plane.thickness_mm, 2))
        notes = (("▣", slab.words()), ("↻", presentation.turn.words()))
        return [f"{sign} {words}" for sign, words in notes if words]

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
            self._arrange()
            return
        greys, index = self._canvas.viewing.greys, self._canvas.index
        window = greys.of(self._canvas.pane)
        self.window.set_lines(
            window_line(window),
            (tr("locked") if greys.is_locked else "", Worth.WINDOW),
            (tr("inverted") if greys.is_inverted else "", Worth.WARNING),
            (tr("Zoom {zoom:.1f} px/mm", zoom=self._canvas.camera.scale), Worth.ZOOM),
        )
        self.slice.set_lines(*self._slice_words(plane, index))
        self.ruler.set_scale(self._canvas.camera.scale)
        self._follow_slice()
        self._arrange()

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
            (tr("outside the image") if hu is None else f"{hu:.0f}{unit}", Worth.VALUE),
            (lps_words(lps_mm), Worth.PLACE),
        )
        self._arrange()

    def clear_cursor(self) -> None:
        """Forget the mouse."""
        self._hovered = None
        self.cursor.set_lines()
        self._arrange()

    def _slice_words(self, plane: SlicePlane, index: float) -> tuple[Line, ...]:
        if plane.pane.is_needle:
            return ((needle_slice_words(plane, index, self._along), Worth.POSITION),)
        tilt, number = plane.tilt_deg, round(index) + 1
        oblique = tr("{angle:.0f}° oblique", angle=tilt) if tilt > SHOWN_TILT_DEG else ""
        return (
            (oblique, Worth.TILT),
            (tr("{position} mm", position=self._position()), Worth.POSITION),
            (tr("Slice {number} / {count}", number=number, count=plane.count), Worth.COUNT),
        )

    def _position(self) -> str:
        """Patient coordinate of the slice along its own axis, with the axis' letter."""
        plane, cursor = self._canvas.plane, self._canvas.viewing.cursor_mm
        if plane is None:
            return ""
        axis = plane.normal_axis
        value = float(cursor[axis])
        return f"{'RLAPIS'[2 * axis + (value >= 0)]} {number(abs(value), '.1f')}"

    # --- room ---------------------------------------------------------------------------------
    def _arrange(self) -> None:
        """Put all where it covers nothing; leave out line by line what finds no room."""
        canvas = self._canvas
        room = (canvas.width(), canvas.height(), theme.SMALL_PX, canvas.devicePixelRatioF())
        arranged = (room, canvas.plane is None, *(one.lines for one in self._edges.texts))
        if arranged == self._arranged:
            return
        self._arranged = arranged
        narrow = canvas.width() < theme.px(COUNTED_PX)
        without = {Worth.COUNT} if narrow else frozenset[Worth]()
        self._edges.arrange(ruled=canvas.plane is not None, without=without)
        self._hold_cursor()

    def _hold_cursor(self) -> None:
        """Keep the names of marks off what the mouse says, and off as much as it has said."""
        said = QRect() if self.cursor.is_empty else self.cursor.geometry()
        held = said.united(self.cursor.held) if said.isValid() else said
        if held != self.cursor.held:
            self.cursor.held = held
            self._canvas.rewrite()

    def explain(self, event: QHelpEvent) -> bool:
        """Show the whole text where the mouse rests on words that are not all there.

        Returns:
            Whether it did.
        """
        words = [one for one in self._edges.texts if not one.is_empty]
        rests = any(one.geometry().contains(event.pos()) for one in words)
        if not rests or not any(one.is_cut for one in self._edges.corners):
            return False
        QToolTip.showText(event.globalPos(), literal(self.whole_text()), self._canvas)
        return True

    def whole_text(self) -> str:
        """Return all that the corners have to say, whether there is room for it or not."""
        return "\n".join(text for one in self._edges.corners for text, _ in one.lines)


def _made(volume: Volume) -> list[str]:
    """Say what a reader must not overlook of the volume: that it is not as its files are."""
    lines = [f"≈ {words}" for words in volume.made]
    if volume.series.tilt_deg and not volume.made:
        lines.append(tr("gantry tilt {angle:.1f}°", angle=volume.series.tilt_deg))
    if volume.unit != "HU":
        lines.append(tr("{modality}: no Hounsfield units", modality=volume.series.modality))
    return lines
