"""A camera's picture, as large as it fits, with a line drawn into it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.themes import DARK

if TYPE_CHECKING:
    from app.core.arrays import FloatArray
    from app.tracking.cameras.camera import Image

_LINE = QColor(DARK.good)
_DARK = QColor(0, 0, 0, 150)


class PictureView(QWidget):
    """Shows a picture (blue, green, red) and an outline in its pixels."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._image: Image | None = None
        self._outline: FloatArray | None = None
        self._size = (640, 480)
        self._dimmed = False
        self.setMinimumSize(280, 210)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:
        """Half a usual picture."""
        return QSize(400, 300)

    @property
    def has_image(self) -> bool:
        """Whether there is a picture."""
        return self._image is not None

    def show_image(self, image: Image | None) -> None:
        """Show a picture, (height, width, 3); None shows none."""
        if image is not self._image:
            self._image = image
            self.update()

    def set_outline(self, outline: FloatArray | None, size: tuple[int, int]) -> None:
        """Draw a closed line [px], (m, 2), of pictures of a size (width, height)."""
        self._outline, self._size = outline, size
        self.update()

    def set_dimmed(self, dimmed: bool) -> None:
        """Darken the picture: it is an old one."""
        if dimmed != self._dimmed:
            self._dimmed = dimmed
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint picture and outline."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor(theme.IMAGE_BACKGROUND))
        frame = self._frame()
        if self._image is None:
            painter.setPen(QColor(theme.IMAGE_DIM))
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, tr("no picture"))
        else:
            height, width = self._image.shape[:2]
            image = QImage(
                self._image.tobytes(), width, height, 3 * width, QImage.Format.Format_BGR888
            )
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(frame, image)
            if self._dimmed:
                painter.fillRect(frame, _DARK)
        self._draw_outline(painter, frame)

    def _frame(self) -> QRectF:
        """Return where the picture lies: as large as it fits, in the middle."""
        width, height = self._size
        if self._image is not None:
            height, width = self._image.shape[:2]
        scale = min(self.width() / width, self.height() / height)
        w, h = scale * width, scale * height
        return QRectF(0.5 * (self.width() - w), 0.5 * (self.height() - h), w, h)

    def _draw_outline(self, painter: QPainter, frame: QRectF) -> None:
        if self._outline is None or not self._outline.size:
            return
        width, height = self._size
        scale_x, scale_y = frame.width() / width, frame.height() / height
        points = [
            QPointF(frame.x() + (u + 0.5) * scale_x, frame.y() + (v + 0.5) * scale_y)
            for u, v in self._outline.tolist()
        ]
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setClipRect(frame)
        painter.setPen(QPen(QColor(0, 0, 0, 160), 4.0))
        painter.drawPolygon(QPolygonF(points))
        painter.setPen(QPen(_LINE, 2.0))
        painter.drawPolygon(QPolygonF(points))
