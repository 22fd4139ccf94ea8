"""One camera's picture with what was found in it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QImage, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.views import theme
from app.views.text import tr

if TYPE_CHECKING:
    from app.tracking.tracker import TrackedPicture

MARK = "#35d6ed"


class CameraView(QWidget):
    """The picture at its true proportions, the marker as circle and cross, the name in a corner."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._picture: TrackedPicture | None = None
        self._image = QImage()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 120)

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(320, 240)

    def show_picture(self, picture: TrackedPicture | None) -> None:
        """Show a picture; None says that there is none."""
        self._picture = picture
        self._image = qimage(picture.image) if picture else QImage()
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw picture, marker, name."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(theme.IMAGE_BACKGROUND))
        if self._picture is None or self._image.isNull():
            painter.setPen(QColor(theme.TEXT_DIM))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, tr("No picture"))
            return
        scale = min(
            self.width() / self._image.width(), self.height() / self._image.height()
        )  # fmt: skip
        size = QPointF(scale * self._image.width(), scale * self._image.height())
        corner = QPointF((self.width() - size.x()) / 2, (self.height() - size.y()) / 2)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(QRectF(corner, corner + size), self._image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._picture.pixel is not None:
            # OpenCV's pixel (0, 0) is the centre of the first pixel, the widget's its corner.
            column, row = self._picture.pixel.tolist()
            _draw_marker(painter, corner + QPointF(column + 0.5, row + 0.5) * scale)
        self._draw_name(painter, corner, self._picture)

    @staticmethod
    def _draw_name(painter: QPainter, corner: QPointF, picture: TrackedPicture) -> None:
        found = picture.pixel is not None
        colour, symbol = theme.VERDICTS["good" if found else "bad"]
        name = camera_name(picture.name)
        text = name if found else tr("{name}: marker not seen", name=name)
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        label = f"{symbol} {text}"
        box = QRectF(corner.x() + 4, corner.y() + 4, 8, 20)
        box.setWidth(painter.fontMetrics().horizontalAdvance(label) + 10)
        painter.fillRect(box, QColor(0, 0, 0, 170))
        painter.setPen(QColor(colour))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, label)


def camera_name(name: str) -> str:
    """Name of a camera of the rig for people."""
    return {"left": tr("left camera"), "right": tr("right camera")}.get(name, name)


def _draw_marker(painter: QPainter, at: QPointF, radius: float = 12.0) -> None:
    """Circle and cross, dark below bright, so that they show on any picture."""
    painter.setBrush(Qt.BrushStyle.NoBrush)
    for colour, width in ((QColor(0, 0, 0, 180), 4.0), (QColor(MARK), 1.8)):
        painter.setPen(QPen(colour, width))
        painter.drawEllipse(at, radius, radius)
        for x, y in ((1.0, 0.0), (0.0, 1.0)):
            arm = QPointF(x, y) * (radius + 6)
            painter.drawLine(at - arm, at - arm * 0.3)
            painter.drawLine(at + arm * 0.3, at + arm)


def qimage(image: NDArray[np.uint8]) -> QImage:
    """Copy a picture of OpenCV into one of Qt."""
    data = np.ascontiguousarray(image)
    rows, columns = data.shape[:2]
    colour = data.ndim == 3
    kind = QImage.Format.Format_BGR888 if colour else QImage.Format.Format_Grayscale8
    return QImage(data.data, columns, rows, data.strides[0], kind).copy()
