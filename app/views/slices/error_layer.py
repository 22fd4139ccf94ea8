"""The layer of error ellipses: round the target by the registration check, round the tip."""

from __future__ import annotations

from math import cos, degrees, hypot, radians, sin

from PySide6.QtCore import QPointF, QRectF
from PySide6.QtGui import QColor, QPainter, QPen

from app.planning.error_overlay import ErrorOverlay
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.plane import SlicePlane

TARGET_ERROR = Mark(theme.TARGET.colour, dash=(3.0, 2.0), width=1.5)
TIP_ERROR = Mark(theme.NEEDLE_TIP.colour, width=1.5)


_MIDDLE = QPointF()


class EllipseItem(Shape):
    """An ellipse with a dark rim, of true size in the plane."""

    def __init__(self, mark: Mark, z: float) -> None:
        super().__init__(z, visible=False)
        self._at, self._axes, self._angle_deg = QPointF(), (0.0, 0.0), 0.0
        width = mark.pen().widthF() + 2.0
        self._pens = {near: mark.pen(alpha=1.0 if near else 0.6) for near in (True, False)}
        self._rim = QPen(QColor.fromRgbF(0.0, 0.0, 0.0, 0.5), width)
        self._rim.setCosmetic(True)
        self._near = True

    def place(
        self, x: float, y: float, axes: tuple[float, float], near: bool, angle: float = 0.0
    ) -> None:
        """Stand round (x, y) [mm] with these half axes [mm], the first turned by `angle` [rad]."""
        self.setVisible(True)
        self._at, self._axes, self._near = QPointF(x, y), axes, near
        self._angle_deg = degrees(angle)
        self.touch()

    def boundingRect(self) -> QRectF:
        """Return the ellipse's rectangle [mm]."""
        (a, b), angle = self._axes, radians(self._angle_deg)
        width, height = hypot(a * cos(angle), b * sin(angle)), hypot(a * sin(angle), b * cos(angle))
        return QRectF(self._at.x() - width, self._at.y() - height, 2.0 * width, 2.0 * height)

    def paint(self, painter: QPainter) -> None:
        """Draw rim and line; faded where the slice is not near."""
        painter.translate(self._at)
        if self._angle_deg:
            painter.rotate(self._angle_deg)
        for pen in (self._rim, self._pens[self._near]):
            painter.setPen(pen)
            painter.drawEllipse(_MIDDLE, *self._axes)


class ErrorLayer:
    """Ellipses of the target and of the tip."""

    def __init__(self, drawing: Drawing) -> None:
        self.target, self.tip = EllipseItem(TARGET_ERROR, 3.5), EllipseItem(TIP_ERROR, 4.5)
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
