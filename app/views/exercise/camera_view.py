"""One camera's picture with what was found in it, dark below bright, to show on any picture."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QImage, QMouseEvent, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.views.kit import theme
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.tracking.inspection import InspectedPicture


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
    """Return where the marker is looked for, dotted."""
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
    middle = (
        window.topLeft()
        + QPointF(pixel[0] - column + _HALF + 0.5, pixel[1] - row + _HALF + 0.5) * scale
    )
    for colour, width in ((QColor(0, 0, 0, 180), 3.0), (QColor(MARK), 1.2)):
        painter.setPen(QPen(colour, width))
        for arm in (QPointF(1.0, 0.0), QPointF(0.0, 1.0)):
            painter.drawLine(middle - arm * 0.3 * side, middle - arm * 5)
            painter.drawLine(middle + arm * 5, middle + arm * 0.3 * side)
    painter.restore()


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
            draw_region(painter, QRectF(at(np.array([left, top])), at(np.array([right, bottom]))))
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
        ), scale


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
