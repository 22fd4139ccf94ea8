"""Lines and ellipses over a slice that say where something lies.

The crosshair's lines, in which other panes cut the slice, and light beside them the needle's; the
needle's line ahead of the tip, with a tick every 10 mm; ellipses of true size: errors of target and
tip, and the tolerance of the target.
"""

from __future__ import annotations

from math import cos, hypot, sin

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QPainter

from app.core.arrays import FloatArray
from app.imaging.reformat import Frame, trace
from app.planning.error_overlay import ErrorOverlay
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Ink, Shape, Strokes, ellipse, stroke
from app.views.slices.items import MarkItem
from app.views.slices.panes import NEEDLE_PANES, PANE_MARKS, PaneId, crossing_panes
from app.views.slices.plane import SlicePlane
from app.views.slices.slab import chord, crossing
from app.views.slices.viewing import Viewing
from app.views.slices.words import rimmed

STEP_MM = 10.0
LABEL_PX = 42.0
"""Labels stand no nearer to each other than this."""

TICK_PX, LONG_TICK_PX = 4.0, 8.0
BEYOND_MM, SHORTEST_MM, LONGEST_MM = 20.0, 50.0, 200.0
"""The line goes so far beyond the target, and is at least and at most so long."""

LINE = Mark(theme.NEEDLE_TIP.colour, dash=(1.5, 3.0), width=1.5)
_LINE_INK, _TICK_INK = Ink.of(LINE), Ink.of(LINE, dash=())


class TicksItem(Strokes):
    """A dotted line with ticks; their distances from its start stand in `labels`."""

    def __init__(self) -> None:
        super().__init__(2.5, visible=False)
        self.labels = _Labels()
        self._start, self._along = (0.0, 0.0), (0.0, 0.0)
        self._length = self._step = 0.0
        self._state: tuple[object, ...] = ()

    def setVisible(self, visible: bool) -> None:
        """Draw line and labels from now on, or not."""
        super().setVisible(visible)
        self.labels.setVisible(visible)

    def place(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        length_mm: float,
        scale: float,
        faded: bool,
    ) -> None:
        """Run from `start` to `end` in the plane.

        Args:
            start: where it starts [mm].
            end: where it ends [mm].
            length_mm: true length in space; in the plane it may be shorter.
            scale: zoom [px/mm].
            faded: whether it is off the slice.
        """
        run, fall = end[0] - start[0], end[1] - start[1]
        seen = hypot(run, fall)
        if seen < 1e-6:
            self.setVisible(False)
            return
        self.setVisible(True)
        state = (start, end, length_mm, scale, faded)
        if state == self._state:
            return
        self._state = state
        self._start, self._along = start, (run / seen, fall / seen)
        self._length, self._step = seen, STEP_MM * seen / length_mm
        apart = self._step * scale
        label_mm = STEP_MM * next((n for n in (1, 2, 5, 10, 20) if n * apart >= LABEL_PX), 50)
        opacity = 0.5 if faded else 0.95
        alphas = (opacity, opacity)
        rows = [*stroke(start, end, _LINE_INK, alphas)]
        dx, dy = -self._along[1] / scale, self._along[0] / scale
        labels: list[tuple[QPointF, str]] = []
        for number, (x, y) in enumerate(self._places(), start=1):
            reach = LONG_TICK_PX if number % 5 == 0 else TICK_PX
            across, down = reach * dx, reach * dy
            rows += stroke((x - across, y - down), (x + across, y + down), _TICK_INK, alphas)
            depth = number * STEP_MM
            if round(depth % label_mm, 6) == 0:
                beside = 2.2 * LONG_TICK_PX
                labels.append((QPointF(x + beside * dx, y + beside * dy), f"{depth:.0f}"))
        self.set_rows(rows)
        self.labels.show(labels, opacity)

    def _places(self) -> list[tuple[float, float]]:
        count = int(self._length / self._step + 1e-9) if self._step > 0.0 else 0
        (x, y), (dx, dy), step = self._start, self._along, self._step
        return [(x + n * step * dx, y + n * step * dy) for n in range(1, count + 1)]

    @property
    def ticks(self) -> list[QPointF]:
        """Places of the ticks [mm], the first one step from the start."""
        return [QPointF(x, y) for x, y in self._places()]


class _Labels(Shape):
    """Distances beside the ticks; they do not zoom."""

    def __init__(self) -> None:
        super().__init__(3.9, visible=False)
        self._labels: list[tuple[QPointF, str]] = []
        self._opacity = 1.0

    def show(self, labels: list[tuple[QPointF, str]], opacity: float) -> None:
        """Write these in the middle of these places [mm]."""
        self._labels, self._opacity = labels, opacity
        self.touch()

    def paint(self, painter: QPainter) -> None:
        """Copy the words."""
        ratio, to_pixels = painter.device().devicePixelRatioF(), painter.transform()
        painter.resetTransform()
        painter.setOpacity(self._opacity)
        for place, text in self._labels:
            picture = rimmed(text, theme.SMALL_PX, theme.NEEDLE_TIP.colour, ratio)
            size, at = picture.deviceIndependentSize(), to_pixels.map(place)
            painter.drawPixmap(at - QPointF(size.width() / 2, size.height() / 2), picture)
        painter.setOpacity(1.0)


class TickLayer:
    """Ticks ahead of the live tip; without a needle, from the entry along the planned path."""

    def __init__(self, drawing: Drawing, viewing: Viewing) -> None:
        self._viewing = viewing
        self.item = TicksItem()
        drawing.add(self.item)
        drawing.add(self.item.labels)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Show the ticks where needle or path are."""
        line = self._line()
        if line is None:
            self.hide()
            return
        start, end = (plane.point(point, index) for point in line)
        faded = max(abs(start.distance), abs(end.distance)) > plane.half_slab_mm
        length = float(np.linalg.norm(line[1] - line[0]))
        self.item.place((start.x, start.y), (end.x, end.y), length, scale, faded)

    def hide(self) -> None:
        """Show nothing."""
        self.item.setVisible(False)

    def _line(self) -> tuple[FloatArray, FloatArray] | None:
        """Start and end of the line, LPS [mm]."""
        needle, draft = self._viewing.needle, self._viewing.shown_draft
        target = None if draft.target_mm is None else np.asarray(draft.target_mm)
        if needle is not None and needle.valid:
            shaft = needle.tip_direction
            length = float(np.linalg.norm(shaft))
            if length < 1e-6:
                return None
            axis = shaft / length
            left = 0.0 if target is None else float((target - needle.tip_mm) @ axis)
            ahead = min(max(left + BEYOND_MM, SHORTEST_MM), LONGEST_MM)
            return needle.tip_mm, needle.tip_mm + ahead * axis
        if needle is None and draft.entry_mm is not None and target is not None:
            entry = np.asarray(draft.entry_mm)
            return (entry, target) if np.linalg.norm(target - entry) > 1.0 else None
        return None


TARGET_ERROR = Mark(theme.TARGET.colour, dash=(3.0, 2.0), width=1.5)
TIP_ERROR = Mark(theme.NEEDLE_TIP.colour, width=1.5)


class EllipseItem(Strokes):
    """An ellipse with a dark rim, of true size in the plane."""

    def __init__(self, mark: Mark, z: float) -> None:
        super().__init__(z, visible=False)
        self._at, self._axes, self._angle = (0.0, 0.0), (0.0, 0.0), 0.0
        line = Ink.of(mark)
        rim = Ink(line.width + 2.0, (0.0, 0.0, 0.0), 0.5)
        self._inks = {True: (rim, line), False: (rim, line._replace(opacity=0.6))}

    def place(
        self, x: float, y: float, axes: tuple[float, float], near: bool, angle: float = 0.0
    ) -> None:
        """Stand round (x, y) [mm] with these half axes [mm], the first turned by `angle` [rad].

        Where the slice is not `near` it is faded.
        """
        self.setVisible(True)
        self._at, self._axes, self._angle = (x, y), axes, angle
        rim, line = self._inks[near]
        self.set_rows([*ellipse((x, y), axes, rim, angle), *ellipse((x, y), axes, line, angle)])

    def boundingRect(self) -> QRectF:
        """Return the ellipse's rectangle [mm]."""
        (x, y), (a, b), angle = self._at, self._axes, self._angle
        width, height = hypot(a * cos(angle), b * sin(angle)), hypot(a * sin(angle), b * cos(angle))
        return QRectF(x - width, y - height, 2.0 * width, 2.0 * height)


class ErrorLayer:
    """Ellipses of the target and of the tip."""

    def __init__(self, drawing: Drawing) -> None:
        self.target, self.tip = EllipseItem(TARGET_ERROR, 3.5), EllipseItem(TIP_ERROR, 3.6)
        for item in (self.target, self.tip):
            drawing.add(item)

    def place_target(self, error: ErrorOverlay | None, plane: SlicePlane, index: float) -> None:
        """Show the target's, or none."""
        _place(self.target, error, plane, index)

    def place_tip(self, error: ErrorOverlay | None, plane: SlicePlane, index: float) -> None:
        """Show the tip's, or none."""
        _place(self.tip, error, plane, index)

    def hide(self) -> None:
        """Show nothing."""
        self.target.setVisible(False)
        self.tip.setVisible(False)


def _place(item: EllipseItem, error: ErrorOverlay | None, plane: SlicePlane, index: float) -> None:
    if error is None:
        item.setVisible(False)
        return
    at = plane.point(error.centre_mm, index)
    near = abs(at.distance) <= plane.half_slab_mm
    *axes, angle = error.ellipse_mm(plane.first.right, plane.first.down)
    item.place(at.x, at.y, (axes[0], axes[1]), near, angle)


INNER = Mark(theme.TARGET.colour, width=2.0)
OUTER = Mark(theme.TARGET.colour, dash=(5.0, 3.0), width=1.5)
SMALLEST_PX = MarkItem.RADIUS + 2.0
"""Rings that would lie under the target's own mark are not drawn."""


class TargetDisc:
    """Rings of the viewing's tolerances: the inner one solid, the outer one dashed."""

    def __init__(self, drawing: Drawing, viewing: Viewing) -> None:
        self._viewing = viewing
        self.rings = (EllipseItem(INNER, 3.4), EllipseItem(OUTER, 3.3))
        for ring in self.rings:
            drawing.add(ring)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Show the rings; faded where the target is not in the slice."""
        target = self._viewing.shown_draft.target_mm
        if target is None:
            self.hide()
            return
        at = plane.point(target, index)
        near = abs(at.distance) <= plane.half_slab_mm
        radii = (*self._viewing.tolerances_mm, 0.0, 0.0)
        for ring, radius in zip(self.rings, radii, strict=False):
            if radius * scale >= SMALLEST_PX:
                ring.place(at.x, at.y, (radius, radius), near)
            else:
                ring.setVisible(False)

    def hide(self) -> None:
        """Show nothing."""
        for ring in self.rings:
            ring.setVisible(False)


GAP_PX = 14.0
"""Half of the gap in the crosshair: the voxel under it stays visible."""


END_SHARE = 0.06
"""Length of the ends of a line that shows nothing else, as a share of it."""


class CrossLine(Strokes):
    """One line of the crosshair through the whole plane, with a gap around the point."""

    def __init__(self, mark: Mark, alpha: float = 0.9) -> None:
        super().__init__(1.0)
        self._ink = Ink.of(mark, alpha, smooth=False)
        self._state: tuple[float, ...] = ()

    def place(
        self,
        at: tuple[float, float],
        direction: tuple[float, float],
        bounds_mm: tuple[float, float, float, float],
        scale: float,
        ends_only: bool = False,
    ) -> None:
        """Run through a point and leave the gap there.

        Args:
            at: the point [mm].
            direction: of the line, unit.
            bounds_mm: rectangle (left, top, width, height) that the line fills.
            scale: zoom [px/mm].
            ends_only: draw nothing but the ends: what lies along the line stays visible.
        """
        gap = GAP_PX / scale
        state = (*at, *direction, *bounds_mm, gap, float(ends_only))
        self.setVisible(True)
        if state == self._state:
            return
        self._state = state
        first, last = chord(at, direction, bounds_mm)
        halves = ((first, min(-gap, last)), (max(gap, first), last))
        if ends_only:
            end = END_SHARE * (last - first)
            halves = ((first, min(-gap, first + end)), (max(gap, last - end), last))
        x, y, (dx, dy) = *at, direction
        rows: list[float] = []
        for a, b in halves:
            if b > a:
                rows += stroke((x + a * dx, y + a * dy), (x + b * dx, y + b * dy), self._ink)
        self.set_rows(rows)


class CrosshairLayer:
    """The traces of the two other panes of the family, in their colours.

    Attributes:
        ends_only: draw their ends alone, so that they cover nothing of the picture.
    """

    def __init__(self, drawing: Drawing, viewing: Viewing, pane: PaneId) -> None:
        self._viewing = viewing
        self.ends_only = False
        self._lines = {other: CrossLine(PANE_MARKS[other]) for other in crossing_panes(pane)}
        for line in self._lines.values():
            line.setVisible(False)
            drawing.add(line)

    @property
    def traced(self) -> frozenset[PaneId]:
        """Panes whose traces it shows."""
        return frozenset(self._lines)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Cross where the three planes meet."""
        this = plane.frame(index)
        traces = {other: self._trace(this, other) for other in self._lines}
        cuts = [cut for cut in traces.values() if cut is not None]
        meeting = crossing(cuts[0], cuts[1]) if len(cuts) == 2 else None
        for other, line in self._lines.items():
            cut = traces[other]
            if cut is None:
                line.setVisible(False)
                continue
            at = meeting or cut[:2]
            line.place(at, cut[2:], plane.bounds_mm, scale, self.ends_only)

    def hide(self) -> None:
        """Show nothing."""
        for line in self._lines.values():
            line.setVisible(False)

    def _trace(self, this: Frame, other: PaneId) -> tuple[float, float, float, float] | None:
        frame = self._viewing.frame(other)
        return None if frame is None else trace(this, frame)


ALPHA = 0.55
STEEPEST = float(np.cos(np.radians(10.0)))
"""Planes that lie nearer to each other than 10° have no line: it would run about the picture."""


class NeedleTraces:
    """A line for each of the needle's panes that is seen, with a gap at the tip."""

    def __init__(self, drawing: Drawing, viewing: Viewing) -> None:
        self._viewing = viewing
        self.lines = {pane: CrossLine(PANE_MARKS[pane], ALPHA) for pane in NEEDLE_PANES}
        for line in self.lines.values():
            line.setVisible(False)
            drawing.add(line)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Draw the lines that there are in this slice."""
        this = plane.frame(index)
        for pane, line in self.lines.items():
            frame = self._frame(pane)
            cut = None if frame is None or _is_flat(this, frame) else trace(this, frame)
            if frame is None or cut is None:
                line.setVisible(False)
                continue
            x, y, dx, dy = cut
            tip = this.point(frame.origin_mm)
            along = (tip[0] - x) * dx + (tip[1] - y) * dy
            line.place((x + along * dx, y + along * dy), (dx, dy), plane.bounds_mm, scale)

    def hide(self) -> None:
        """Show nothing."""
        for line in self.lines.values():
            line.setVisible(False)

    def _frame(self, pane: PaneId) -> Frame | None:
        viewing = self._viewing
        seen = viewing.shows_traces and pane in viewing.seen_panes
        return viewing.frame(pane) if seen else None


def _is_flat(item: Frame, other: Frame) -> bool:
    return abs(float(item.normal @ other.normal)) > STEEPEST
