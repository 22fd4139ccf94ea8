"""Where the needle's planes cut a patient view: thin lines, light beside the crosshair's."""

from __future__ import annotations

import numpy as np

from app.imaging.reformat import Frame, trace
from app.views.slices.cross_line import CrossLine
from app.views.slices.drawing import Drawing
from app.views.slices.panes import NEEDLE_PANES, PANE_MARKS, PaneId
from app.views.slices.plane import SlicePlane
from app.views.slices.viewing import Viewing

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
