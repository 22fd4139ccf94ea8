"""A camera's picture with the board found in it and the part of it that is covered so far."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QImage, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.tracking.calibration.corners import to_grey
from app.tracking.calibration.coverage import COLUMNS, ROWS, Coverage
from app.tracking.calibration.views import BoardView
from app.views.kit import theme
from app.views.kit.text import tr

if TYPE_CHECKING:
    from numpy.typing import NDArray

_MANY = 12
"""Corners in a cell at which it has its full colour."""


class CoverageView(QWidget):
    """Shows the picture in grey, cells that hold corners in colour, and the corners found now."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._name = name
        self._image: QImage | None = None
        self._size = (640, 480)
        self._view: BoardView | None = None
        self._coverage = Coverage()
        self._kept = False
        self.setMinimumSize(260, 195)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)

    def sizeHint(self) -> QSize:
        """Half a usual picture."""
        return QSize(360, 270)

    def show_picture(
        self, image: NDArray[Any] | None, view: BoardView | None, kept: bool = False
    ) -> None:
        """Show a picture and the corners found in it; `kept` marks it as one that is used."""
        if image is not None:
            grey = to_grey(image)
            height, width = grey.shape
            self._size = (width, height)
            self._image = QImage(
                grey.tobytes(), width, height, width, QImage.Format.Format_Grayscale8
            ).copy()
        else:
            self._image = None
        self._view, self._kept = view, kept
        self.update()

    def show_coverage(self, coverage: Coverage) -> None:
        """Show which part of the picture is covered."""
        self._coverage = coverage
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint picture, cells, corners and the name."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.fillRect(self.rect(), QColor(theme.IMAGE_BACKGROUND))
        frame = self._frame()
        if self._image is not None:
            painter.drawImage(frame, self._image)
        self._paint_cells(painter, frame)
        if self._view is not None:
            self._paint_corners(painter, frame, self._view)
        self._paint_words(painter, frame)

    def _frame(self) -> QRectF:
        width, height = self._size
        scale = min(self.width() / width, self.height() / height)
        w, h = scale * width, scale * height
        return QRectF(0.5 * (self.width() - w), 0.5 * (self.height() - h), w, h)

    def _paint_cells(self, painter: QPainter, frame: QRectF) -> None:
        width, height = frame.width() / COLUMNS, frame.height() / ROWS
        colour = QColor(theme.on_image(theme.GOOD))
        for row in range(ROWS):
            for k in range(COLUMNS):
                count = int(self._coverage.cells[row, k])
                if count:
                    colour.setAlphaF(0.14 + 0.20 * min(1.0, count / _MANY))
                    cell = QRectF(frame.x() + k * width, frame.y() + row * height, width, height)
                    painter.fillRect(cell.adjusted(1, 1, -1, -1), colour)

    def _paint_corners(self, painter: QPainter, frame: QRectF, view: BoardView) -> None:
        scale = frame.width() / self._size[0]
        points = [
            QPointF(frame.x() + (u + 0.5) * scale, frame.y() + (v + 0.5) * scale)
            for u, v in view.pixels.tolist()
        ]
        painter.setPen(QPen(QColor(theme.on_image(theme.ACCENT)), 1.0))
        painter.drawPolyline(QPolygonF(points))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.on_image(theme.GOOD if self._kept else theme.WARNING)))
        for point in points:
            painter.drawEllipse(point, 2.5, 2.5)

    def _paint_words(self, painter: QPainter, frame: QRectF) -> None:
        share = round(100.0 * self._coverage.covered)
        words = tr("{camera}: {n} different views, {share} % covered", camera=self._name,
                   n=len(self._coverage.views), share=share)  # fmt: skip
        box = QRectF(frame.x(), frame.bottom() - 24.0, frame.width(), 24.0)
        painter.fillRect(box, QColor(0, 0, 0, 150))
        painter.setPen(QColor(theme.IMAGE_TEXT))
        painter.drawText(box.adjusted(8, 0, -8, 0), Qt.AlignmentFlag.AlignVCenter, words)
        if self._image is None:
            painter.setPen(QColor(theme.IMAGE_DIM))
            painter.drawText(frame, Qt.AlignmentFlag.AlignCenter, tr("no picture yet"))
