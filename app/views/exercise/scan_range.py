"""The range of the next control scan over the planning CT's slices: where the table stands."""

from __future__ import annotations

from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainter

from app.imaging.scan_order import ScanOrder
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.pane import SlicePane
from app.views.slices.plane import SlicePlane

RANGE = Mark("#c9ced3", dash=(1.0, 3.0), width=1.5)


class ScanRange:
    """Two dotted lines where the faces of the scan cut a slice; none in slices along them."""

    def __init__(self, drawing: Drawing) -> None:
        self._order: ScanOrder | None = None
        self._item = _Lines()
        drawing.add(self._item)

    def set_order(self, order: ScanOrder | None) -> None:
        """Show this range from the next refresh on; None shows nothing."""
        self._order = order

    @property
    def lines(self) -> tuple[tuple[QPointF, QPointF], ...]:
        """What is drawn, in plane millimetres."""
        return self._item.lines

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Draw the lines."""
        found = [] if self._order is None else [
            line
            for z in self._order.range_mm
            for line in [_cut(plane, index, z)]
            if line is not None
        ]  # fmt: skip
        self._item.set_lines(tuple(found))

    def hide(self) -> None:
        """Show nothing."""
        self._item.set_lines(())


def attach(pane: SlicePane) -> ScanRange:
    """Let a pane show the range."""
    layer = ScanRange(pane.canvas.drawing)
    pane.canvas.add_layer(layer)
    return layer


def _cut(plane: SlicePlane, index: float, z_mm: float) -> tuple[QPointF, QPointF] | None:
    """Return the ends of the line in which an axial plane at `z_mm` cuts a slice, on its edges."""
    width, height = plane.extent_mm
    corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
    heights = [float(plane.lps_mm(x, y, index)[2]) - z_mm for x, y in corners]
    ends = []
    for i, (x, y) in enumerate(corners):
        (u, v), a, b = corners[(i + 1) % 4], heights[i], heights[(i + 1) % 4]
        if (a > 0.0) != (b > 0.0):
            share = a / (a - b)
            ends.append(QPointF(x + share * (u - x), y + share * (v - y)))
    return (ends[0], ends[1]) if len(ends) == 2 else None


class _Lines(Shape):
    smooth = False

    def __init__(self) -> None:
        super().__init__(1.0)
        self.lines: tuple[tuple[QPointF, QPointF], ...] = ()

    def set_lines(self, lines: tuple[tuple[QPointF, QPointF], ...]) -> None:
        if lines != self.lines:
            self.lines = lines
            self.touch()

    def paint(self, painter: QPainter) -> None:
        painter.setPen(RANGE.pen())
        for start, end in self.lines:
            painter.drawLine(start, end)
