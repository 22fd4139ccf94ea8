"""The layer of error ellipses: round the target by the registration check, round the tip."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from app.core.arrays import FloatArray
from app.planning.error_overlay import ErrorOverlay
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.plane import SlicePlane

TARGET_ERROR = Mark(theme.TARGET.colour, dash=(3.0, 2.0), width=1.5)
TIP_ERROR = Mark(theme.NEEDLE_TIP.colour, width=1.5)


class OutlineItem(Shape):
    """A closed line with a dark rim, of true size in the plane."""

    def __init__(self, mark: Mark, z: float) -> None:
        super().__init__(z, visible=False)
        self._at, self._line, self._outline = QPointF(), QPolygonF(), b""
        width = mark.pen().widthF() + 2.0
        self._pens = {near: mark.pen(alpha=1.0 if near else 0.6) for near in (True, False)}
        self._rim = QPen(QColor.fromRgbF(0.0, 0.0, 0.0, 0.5), width)
        self._rim.setCosmetic(True)
        self._near = True

    def place(self, x: float, y: float, outline: FloatArray, near: bool) -> None:
        """Stand round (x, y) [mm]; `outline` [mm] from there, shape (n, 2)."""
        self.setVisible(True)
        shape = outline.tobytes()
        if shape != self._outline:  # the rings of a tolerance stay the same while they move
            self._outline = shape
            self._line = QPolygonF([QPointF(dx, dy) for dx, dy in outline.tolist()])
        self._at, self._near = QPointF(x, y), near
        self.touch()

    def boundingRect(self) -> QRectF:
        """Return the outline's rectangle [mm]."""
        return self._line.boundingRect().translated(self._at)

    def paint(self, painter: QPainter) -> None:
        """Draw rim and line; faded where the slice is not near."""
        painter.translate(self._at)
        for pen in (self._rim, self._pens[self._near]):
            painter.setPen(pen)
            painter.drawPolygon(self._line)


class ErrorLayer:
    """Ellipses of the target and of the tip."""

    def __init__(self, drawing: Drawing) -> None:
        self.target, self.tip = OutlineItem(TARGET_ERROR, 3.5), OutlineItem(TIP_ERROR, 4.5)
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


def _place(item: OutlineItem, error: ErrorOverlay | None, plane: SlicePlane, index: float) -> None:
    if error is None:
        item.setVisible(False)
        return
    at = plane.point(error.centre_mm, index)
    ends = [plane.point(error.centre_mm + axis, index) for axis in np.eye(3)]
    across = np.array([[end.x - at.x for end in ends], [end.y - at.y for end in ends]])
    near = abs(at.distance) <= plane.half_slab_mm
    item.place(at.x, at.y, error.outline_mm(across), near)
