"""The layer of error ellipses: round the target by the registration check, round the tip."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPen, QPolygonF
from PySide6.QtWidgets import QGraphicsItem, QGraphicsScene, QStyleOptionGraphicsItem, QWidget

from app.core.arrays import FloatArray
from app.planning.error_overlay import ErrorOverlay
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.plane import SlicePlane

TARGET_ERROR = Mark(theme.TARGET.colour, dash=(3.0, 2.0), width=1.5)
TIP_ERROR = Mark(theme.NEEDLE_TIP.colour, width=1.5)


class OutlineItem(QGraphicsItem):
    """A closed line with a dark rim, of true size in the plane."""

    def __init__(self, mark: Mark, z: float) -> None:
        super().__init__()
        self._mark, self._line, self._rect = mark, QPolygonF(), QRectF()
        self._near = True
        self._state: tuple[object, ...] = ()
        self.setZValue(z)
        self.setVisible(False)

    def place(self, x: float, y: float, outline: FloatArray, near: bool, scale: float) -> None:
        """Stand round (x, y) [mm]; `outline` [mm] from there, shape (n, 2)."""
        self.setVisible(True)
        state = (x, y, outline.tobytes(), near, scale)
        if state == self._state:
            return
        self.prepareGeometryChange()
        self._state = state
        self._line = QPolygonF([QPointF(x + dx, y + dy) for dx, dy in outline.tolist()])
        self._near = near
        margin = 4.0 / scale
        self._rect = self._line.boundingRect().adjusted(-margin, -margin, margin, margin)
        self.update()

    def boundingRect(self) -> QRectF:
        """Return the line's surroundings."""
        return self._rect

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Draw rim and line; faded where the slice is not near."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        pen = self._mark.pen(alpha=1.0 if self._near else 0.6)
        rim = QPen(Qt.GlobalColor.black, pen.widthF() + 2.0)
        rim.setCosmetic(True)
        painter.setOpacity(0.5)
        painter.setPen(rim)
        painter.drawPolygon(self._line)
        painter.setOpacity(1.0)
        painter.setPen(pen)
        painter.drawPolygon(self._line)


class ErrorLayer:
    """Ellipses of the target and of the tip."""

    def __init__(self, scene: QGraphicsScene) -> None:
        self.target, self.tip = OutlineItem(TARGET_ERROR, 3.5), OutlineItem(TIP_ERROR, 4.5)
        for item in (self.target, self.tip):
            scene.addItem(item)

    def place_target(
        self, error: ErrorOverlay | None, plane: SlicePlane, index: float, scale: float
    ) -> None:
        """Show the target's, or none."""
        _place(self.target, error, plane, index, scale)

    def place_tip(
        self, error: ErrorOverlay | None, plane: SlicePlane, index: float, scale: float
    ) -> None:
        """Show the tip's, or none."""
        _place(self.tip, error, plane, index, scale)

    def hide(self) -> None:
        """Show nothing."""
        self.target.setVisible(False)
        self.tip.setVisible(False)


def _place(
    item: OutlineItem, error: ErrorOverlay | None, plane: SlicePlane, index: float, scale: float
) -> None:
    if error is None:
        item.setVisible(False)
        return
    at = plane.point(error.centre_mm, index)
    ends = [plane.point(error.centre_mm + axis, index) for axis in np.eye(3)]
    across = np.array([[end.x - at.x for end in ends], [end.y - at.y for end in ends]])
    near = abs(at.distance) <= plane.half_slab_mm
    item.place(at.x, at.y, error.outline_mm(across), near, scale)
