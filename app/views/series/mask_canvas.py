"""One picture with boxes that are drawn with the mouse."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QImage, QMouseEvent, QPainter, QPaintEvent, QPen, QWheelEvent
from PySide6.QtWidgets import QWidget

from app.views.kit import theme
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.imaging.privacy.burned_in import Box

_LEAST_PX = 1
_ALL, _ONE = Qt.PenStyle.SolidLine, Qt.PenStyle.DashLine


class MaskCanvas(QWidget):
    """Shows a grey picture as large as fits, and the boxes on it with their numbers.

    Signals:
        drawn(int, int, int, int): column, row, width and height [pixels of the picture] of a box.
        scrolled(int): pictures to go on.
    """

    drawn = Signal(int, int, int, int)
    scrolled = Signal(int)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(420, 420)
        self.setCursor(Qt.CursorShape.CrossCursor)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setAccessibleName(tr("Picture; drag to draw a box over writing"))
        self._image, self._aspect = QImage(), 1.0
        self._boxes: tuple[tuple[int, Box], ...] = ()
        self._chosen = -1
        self._from: QPointF | None = None
        self._to = QPointF()
        self._turned = 0
        self.may_draw = True

    def show_picture(self, grey: NDArray[np.uint8], aspect: float) -> None:
        """Show grey levels, shape (rows, columns), pixels `aspect` times as high as wide."""
        rows, columns = grey.shape
        grey = np.ascontiguousarray(grey)
        picture = QImage(grey.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        self._image, self._aspect = picture.copy(), aspect
        self.update()

    def show_boxes(self, boxes: Sequence[tuple[int, Box]], chosen: int) -> None:
        """Outline boxes, each with its number; the one of the number `chosen` thicker."""
        self._boxes, self._chosen = tuple(boxes), chosen
        self.update()

    # --- where things are -----------------------------------------------------------------------
    def frame(self) -> QRectF:
        """Rectangle of the picture in the widget [px]."""
        columns, rows = self._image.width(), self._image.height() * self._aspect
        if not columns or not rows:
            return QRectF()
        scale = min(self.width() / columns, self.height() / rows)
        wide, high = scale * columns, scale * rows
        return QRectF((self.width() - wide) / 2.0, (self.height() - high) / 2.0, wide, high)

    def _rectangle(self, box: Box) -> QRectF:
        frame = self.frame()
        x, y = frame.width() / self._image.width(), frame.height() / self._image.height()
        return QRectF(
            frame.left() + x * box.column, frame.top() + y * box.row, x * box.columns, y * box.rows
        )

    def _box(self) -> tuple[int, int, int, int] | None:
        """Column, row, width and height of what is being drawn: whole pixels, cut at the edges."""
        frame = self.frame()
        if self._from is None or frame.isEmpty():
            return None
        rectangle = QRectF(self._from, self._to).normalized().intersected(frame)
        columns, rows = self._image.width(), self._image.height()
        x, y = columns / frame.width(), rows / frame.height()
        left, top = x * (rectangle.left() - frame.left()), y * (rectangle.top() - frame.top())
        right, bottom = left + x * rectangle.width(), top + y * rectangle.height()
        column, row = int(left), int(top)
        width = min(int(np.ceil(right)), columns) - column
        height = min(int(np.ceil(bottom)), rows) - row
        return (column, row, width, height) if min(width, height) >= _LEAST_PX else None

    # --- events ---------------------------------------------------------------------------------
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw picture, boxes, and the one that is being drawn."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), theme.IMAGE_BACKGROUND)
        if self._image.isNull():
            return
        painter.drawImage(self.frame(), self._image)
        for number, box in self._boxes:
            self._outline(painter, number, box)
        if self._from is not None:
            painter.setPen(QPen(QColor(theme.on_image(theme.WARNING)), 2.0, Qt.PenStyle.DotLine))
            painter.drawRect(QRectF(self._from, self._to).normalized().intersected(self.frame()))

    def _outline(self, painter: QPainter, number: int, box: Box) -> None:
        style = _ALL if box.picture is None else _ONE
        width = 3.0 if number == self._chosen else 1.5
        colour = theme.on_image(theme.WARNING if number == self._chosen else theme.ACCENT)
        painter.setPen(QPen(QColor(colour), width, style))
        rectangle = self._rectangle(box)
        painter.drawRect(rectangle)
        text = rectangle.adjusted(4.0, 2.0, 60.0, 40.0)
        painter.drawText(text, Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop, str(number))

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin a box."""
        if event.button() == Qt.MouseButton.LeftButton and self.may_draw:
            self._from = self._to = event.position()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Go on with it."""
        if self._from is not None:
            self._to = event.position()
            self.update()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End it; a mere click draws nothing."""
        if self._from is None or event.button() != Qt.MouseButton.LeftButton:
            return
        moved = (event.position() - self._from).manhattanLength() >= 4.0
        self._to = event.position()
        box, self._from = self._box(), None
        self.update()
        if moved and box is not None:
            self.drawn.emit(*box)

    def abandon(self) -> bool:
        """Let go of a box that is being drawn; return whether there was one."""
        was, self._from = self._from is not None, None
        self.update()
        return was

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Go on through the pictures, a notch each; fine wheels add up."""
        self._turned += event.angleDelta().y()
        steps, self._turned = int(self._turned / 120), self._turned - 120 * int(self._turned / 120)
        if steps:
            self.scrolled.emit(-steps)
