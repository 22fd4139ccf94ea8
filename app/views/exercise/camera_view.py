"""One camera's picture with what was found in it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QImage, QMouseEvent, QPainter, QPaintEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.views.exercise.camera_marks import (
    draw_curve,
    draw_magnified,
    draw_marker,
    draw_mask,
    draw_region,
)
from app.views.kit import theme
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.tracking.inspection import InspectedPicture


@dataclass(frozen=True, slots=True)
class Overlays:
    """What is drawn over a picture.

    Attributes:
        mask: pixels that count as the marker's colour.
        epipolar: where the other camera's marker may lie here.
        region: where the marker is looked for.
        magnifier: the marker large, in a corner.
    """

    mask: bool = False
    epipolar: bool = True
    region: bool = False
    magnifier: bool = True


class CameraView(QWidget):
    """The picture at its true proportions, the marker as circle and cross, the name in a corner.

    Signals:
        clicked(str, object): name of the camera and the pixel, shape (2,), that was clicked.
    """

    clicked = Signal(str, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown: InspectedPicture | None = None
        self._instead = ""
        self._image = QImage()
        self.overlays = Overlays()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 120)
        self.setAccessibleName(tr("Camera picture"))

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(320, 240)

    def show_picture(self, inspected: InspectedPicture | None, instead: str = "") -> None:
        """Show a picture; None says that there is none, or what is to be said `instead`."""
        self._shown, self._instead = inspected, instead
        self._image = qimage(inspected.picture.image) if inspected else QImage()
        self.update()

    def pixel_at(self, position: QPointF) -> NDArray[np.float64] | None:
        """Pixel of the picture at a point of the widget, shape (2,), or None beside it."""
        if self._image.isNull():
            return None
        corner, scale = self._placed()
        # OpenCV's pixel (0, 0) is the centre of the first pixel, the widget's its corner.
        pixel = np.array([position.x() - corner.x(), position.y() - corner.y()]) / scale - 0.5
        limit = np.array([self._image.width(), self._image.height()]) - 0.5
        return pixel if bool((pixel >= -0.5).all() and (pixel <= limit).all()) else None

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Tell of a click into the picture."""
        pixel = self.pixel_at(event.position())
        if pixel is not None and self._shown and event.button() is Qt.MouseButton.LeftButton:
            self.clicked.emit(self._shown.picture.name, pixel)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw picture, what was found in it, and the name."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(theme.IMAGE_BACKGROUND))
        if self._shown is None or self._image.isNull():
            painter.setPen(QColor(theme.IMAGE_DIM))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect(), flags, self._instead or tr("No picture"))
            return
        corner, scale = self._placed()
        size = QPointF(scale * self._image.width(), scale * self._image.height())
        place = QRectF(corner, corner + size)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(place, self._image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setClipRect(place)
        self._draw_overlays(painter, self._shown, place, scale)
        _draw_name(painter, corner, self._shown)

    def _draw_overlays(
        self, painter: QPainter, shown: InspectedPicture, place: QRectF, scale: float
    ) -> None:
        def at(pixel: NDArray[np.float64]) -> QPointF:
            return place.topLeft() + QPointF(float(pixel[0]) + 0.5, float(pixel[1]) + 0.5) * scale

        if self.overlays.mask and shown.mask is not None:
            draw_mask(painter, place, shown.mask)
        if self.overlays.epipolar:
            draw_curve(painter, [at(pixel) for pixel in shown.epipolar])
        if self.overlays.region and shown.region is not None:
            left, top, right, bottom = shown.region
            draw_region(
                painter, QRectF(at(np.array([left, top])), at(np.array([right, bottom])))
            )  # fmt: skip
        pixel = shown.picture.pixel
        if pixel is not None:
            draw_marker(painter, at(pixel))
            if self.overlays.magnifier:
                mask = shown.mask if self.overlays.mask else None
                draw_magnified(painter, place, self._image, pixel, mask)

    def _placed(self) -> tuple[QPointF, float]:
        """Upper left corner of the picture in the widget and its scale."""
        width, height = self._image.width(), self._image.height()
        scale = min(self.width() / width, self.height() / height)
        return QPointF(
            (self.width() - scale * width) / 2, (self.height() - scale * height) / 2
        ), scale  # fmt: skip


def _draw_name(painter: QPainter, corner: QPointF, shown: InspectedPicture) -> None:
    found = shown.found
    colour, symbol = theme.VERDICTS["good" if found else "bad"]
    colour = theme.on_image(colour)
    name = camera_name(shown.picture.name)
    why = shown.why or tr("marker not seen")
    text = name if found else tr("{name}: {why}", name=name, why=why)
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


def qimage(image: NDArray[np.uint8]) -> QImage:
    """Copy a picture of OpenCV into one of Qt."""
    data = np.ascontiguousarray(image)
    rows, columns = data.shape[:2]
    colour = data.ndim == 3
    kind = QImage.Format.Format_BGR888 if colour else QImage.Format.Format_Grayscale8
    return QImage(data.data, columns, rows, data.strides[0], kind).copy()
