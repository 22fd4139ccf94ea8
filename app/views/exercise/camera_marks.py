"""What is drawn over a camera's picture: dark below bright, so that it shows on any picture."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPen, QPolygonF

from app.views.kit import theme

MARK: Final = "#35d6ed"
CURVE: Final = "#ffd84d"
MASK: Final = (53, 214, 237, 140)
ZOOM: Final = 6.0
_HALF: Final = 11
_SHARE: Final = 0.42
"""The magnifier takes at most this share of the picture's height."""


def draw_marker(painter: QPainter, at: QPointF, radius: float = 12.0) -> None:
    """Circle and cross."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for colour, width in ((QColor(0, 0, 0, 180), 4.0), (QColor(MARK), 1.8)):
        painter.setPen(QPen(colour, width))
        painter.drawEllipse(at, radius, radius)
        for x, y in ((1.0, 0.0), (0.0, 1.0)):
            arm = QPointF(x, y) * (radius + 6)
            painter.drawLine(at - arm, at - arm * 0.3)
            painter.drawLine(at + arm * 0.3, at + arm)


def draw_curve(painter: QPainter, points: list[QPointF]) -> None:
    """Epipolar curve, dashed: it is computed, not seen."""
    if len(points) < 2:
        return
    painter.setBrush(Qt.BrushStyle.NoBrush)
    line = QPolygonF(points)
    painter.setPen(QPen(QColor(0, 0, 0, 150), 3.0))
    painter.drawPolyline(line)
    pen = QPen(QColor(CURVE), 1.4)
    pen.setDashPattern([5.0, 4.0])
    painter.setPen(pen)
    painter.drawPolyline(line)


def draw_region(painter: QPainter, region: QRectF) -> None:
    """Where the marker is looked for, dotted."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(0, 0, 0, 150), 3.0))
    painter.drawRect(region)
    painter.setPen(QPen(QColor(theme.IMAGE_TEXT), 1.2, Qt.PenStyle.DotLine))
    painter.drawRect(region)


def draw_mask(painter: QPainter, place: QRectF, mask: NDArray[np.uint8]) -> None:
    """Show what counts as the marker's colour, in one translucent colour."""
    painter.drawImage(place, mask_image(mask))


def mask_image(mask: NDArray[np.uint8]) -> QImage:
    """Return the mask as a picture, clear where it is zero."""
    colours = np.zeros((*mask.shape, 4), dtype=np.uint8)
    red, green, blue, alpha = MASK
    colours[mask > 0] = (blue, green, red, alpha)
    rows, columns = mask.shape
    return QImage(colours.data, columns, rows, 4 * columns, QImage.Format.Format_ARGB32).copy()


def draw_magnified(
    painter: QPainter,
    place: QRectF,
    image: QImage,
    pixel: NDArray[np.float64],
    mask: NDArray[np.uint8] | None = None,
) -> None:
    """Show the marker's surroundings enlarged, unsmoothed, in the lower corner away from it."""
    side = min(ZOOM * (2 * _HALF + 1), _SHARE * place.height())
    column, row = np.rint(pixel).astype(int).tolist()
    left_free = pixel[0] > 0.5 * image.width()
    x = place.left() + 4 if left_free else place.right() - side - 4
    window = QRectF(x, place.bottom() - side - 4, side, side)
    source = QRectF(column - _HALF, row - _HALF, 2 * _HALF + 1, 2 * _HALF + 1)
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, False)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing, False)
    painter.fillRect(window, QColor(theme.IMAGE_BACKGROUND))
    painter.drawImage(window, image, source)
    if mask is not None:
        painter.drawImage(window, mask_image(mask), source)
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    painter.setPen(QPen(QColor(theme.IMAGE_LINE), 1.5))
    painter.drawRect(window)
    scale = side / (2 * _HALF + 1)
    middle = window.topLeft() + QPointF(
        pixel[0] - column + _HALF + 0.5, pixel[1] - row + _HALF + 0.5
    ) * scale  # fmt: skip
    for colour, width in ((QColor(0, 0, 0, 180), 3.0), (QColor(MARK), 1.2)):
        painter.setPen(QPen(colour, width))
        for arm in (QPointF(1.0, 0.0), QPointF(0.0, 1.0)):
            painter.drawLine(middle - arm * 0.3 * side, middle - arm * 5)
            painter.drawLine(middle + arm * 5, middle + arm * 0.3 * side)
    painter.restore()
