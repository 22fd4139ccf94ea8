"""The layer of error ellipses: round the target by the registration check, round the tip."""

from __future__ import annotations

from functools import lru_cache
from math import ceil, cos, degrees, hypot, radians, sin

from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPixmap

from app.planning.error_overlay import ErrorOverlay
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.plane import SlicePlane

TARGET_ERROR = Mark(theme.TARGET.colour, dash=(3.0, 2.0), width=1.5)
TIP_ERROR = Mark(theme.NEEDLE_TIP.colour, width=1.5)


_MIDDLE = QPointF()

LARGEST_COPIED_PX = 100.0
"""Rings up to this radius are copied as pictures, larger ones drawn."""


class EllipseItem(Shape):
    """An ellipse with a dark rim, of true size in the plane."""

    def __init__(self, mark: Mark, z: float) -> None:
        super().__init__(z, visible=False)
        self._at, self._axes, self._angle_deg = QPointF(), (0.0, 0.0), 0.0
        self._mark = mark
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
        scale = painter.transform().m11()
        radius = self._axes[0] * scale
        if self._axes[0] == self._axes[1] and radius <= LARGEST_COPIED_PX:
            at = painter.transform().map(self._at)
            painter.resetTransform()
            ratio = painter.device().devicePixelRatioF()
            picture = _ring(self._mark, self._near, round(radius, 1), ratio)
            half = picture.deviceIndependentSize().width() / 2.0
            painter.drawPixmap(at - QPointF(half, half), picture)
            return
        painter.translate(self._at)
        if self._angle_deg:
            painter.rotate(self._angle_deg)
        for pen in _pens(self._mark, self._near):
            painter.setPen(pen)
            painter.drawEllipse(_MIDDLE, *self._axes)


@lru_cache(maxsize=64)
def _pens(mark: Mark, near: bool) -> tuple[QPen, QPen]:
    """Pens of the rim and of the line."""
    line = mark.pen(alpha=1.0 if near else 0.6)
    rim = QPen(QColor.fromRgbF(0.0, 0.0, 0.0, 0.5), line.widthF() + 2.0)
    rim.setCosmetic(True)
    return rim, line


@lru_cache(maxsize=64)
def _ring(mark: Mark, near: bool, radius_px: float, ratio: float) -> QPixmap:
    """Picture of a ring: of the same size as long as nobody zooms."""
    half = ceil(radius_px + mark.width + 2.0)
    picture = QPixmap(round(2 * half * ratio), round(2 * half * ratio))
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    with QPainter(picture) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        for pen in _pens(mark, near):
            painter.setPen(pen)
            painter.drawEllipse(QPointF(half, half), radius_px, radius_px)
    return picture


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
