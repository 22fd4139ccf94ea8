"""Text with a dark rim, drawn once and then copied: it stands over slices that move."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPixmap

_RIM = ((-1, 0), (1, 0), (0, -1), (0, 1))


def draw_rimmed(
    painter: QPainter, box: QRectF, text: str, colour: QColor, flags: Qt.AlignmentFlag
) -> None:
    """Draw text with its rim; it may reach beyond its box."""
    painter.setPen(Qt.GlobalColor.black)
    free = flags | Qt.TextFlag.TextDontClip
    for dx, dy in _RIM:
        painter.drawText(box.translated(dx, dy), free, text)
    painter.setPen(colour)
    painter.drawText(box, free, text)


@lru_cache(maxsize=256)
def rimmed(text: str, pixels: int, colour: str, ratio: float) -> QPixmap:
    """Return a picture of a text.

    Args:
        text: a few letters.
        pixels: height of the font.
        colour: of the text.
        ratio: the screen's pixels to one of the window's.
    """
    font = QFont()
    font.setPixelSize(pixels)
    metrics = QFontMetrics(font)
    size = QSize(metrics.horizontalAdvance(text) + 4, metrics.height() + 2)
    picture = QPixmap(size * ratio)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    with QPainter(picture) as painter:
        painter.setFont(font)
        box = QRectF(0.0, 0.0, size.width(), size.height())
        draw_rimmed(painter, box, text, QColor(colour), Qt.AlignmentFlag.AlignCenter)
    return picture
