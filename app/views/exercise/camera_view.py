"""One camera's picture with what was found in it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QImage, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.views import theme
from app.views.text import tr

MARK = "#35d6ed"


@dataclass(frozen=True, slots=True, eq=False)
class CameraPicture:
    """A picture and the marker in it.

    Attributes:
        name: which camera, for people.
        image: grey (rows, columns) or blue-green-red (rows, columns, 3), uint8, as OpenCV has it.
        marker: pixel (column, row) of the marker's centre; None if it was not found.
        radius: of the marker [px].
    """

    name: str
    image: NDArray[np.uint8]
    marker: tuple[float, float] | None
    radius: float = 12.0


class CameraView(QWidget):
    """The picture at its true proportions, the marker as circle and cross, the name in a corner."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._picture: CameraPicture | None = None
        self._image = QImage()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 120)

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(320, 240)

    def show_picture(self, picture: CameraPicture | None) -> None:
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
        if self._picture.marker is not None:
            # OpenCV's pixel (0, 0) is the centre of the first pixel, the widget's its corner.
            column, row = self._picture.marker
            at = corner + QPointF(column + 0.5, row + 0.5) * scale
            _draw_marker(painter, at, max(8.0, 1.5 * scale * self._picture.radius))
        self._draw_name(painter, corner, self._picture)

    @staticmethod
    def _draw_name(painter: QPainter, corner: QPointF, picture: CameraPicture) -> None:
        found = picture.marker is not None
        colour, symbol = theme.VERDICTS["good" if found else "bad"]
        text = picture.name if found else tr("{name}: marker not seen", name=picture.name)
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        label = f"{symbol} {text}"
        box = QRectF(corner.x() + 4, corner.y() + 4, 8, 20)
        box.setWidth(painter.fontMetrics().horizontalAdvance(label) + 10)
        painter.fillRect(box, QColor(0, 0, 0, 170))
        painter.setPen(QColor(colour))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, label)


def _draw_marker(painter: QPainter, at: QPointF, radius: float) -> None:
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
