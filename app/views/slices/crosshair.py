"""Lines in which other panes cut a slice: the crosshair's, and light beside it the needle's."""

from __future__ import annotations

import numpy as np

from app.imaging.reformat import Frame, trace
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Ink, Strokes, stroke
from app.views.slices.panes import NEEDLE_PANES, PANE_MARKS, PaneId, crossing_panes
from app.views.slices.plane import SlicePlane
from app.views.slices.slab import chord, crossing
from app.views.slices.viewing import Viewing

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


def _is_flat(one: Frame, other: Frame) -> bool:
    return abs(float(one.normal @ other.normal)) > STEEPEST
