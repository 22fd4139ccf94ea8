"""A line of the crosshair, of any direction."""

from __future__ import annotations

from app.views.kit.theme import Mark
from app.views.slices.drawing import Ink, Strokes, stroke
from app.views.slices.slab import chord

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
