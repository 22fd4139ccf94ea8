"""What is drawn in a slice, in plane millimetres: image, crosshair lines, marks and segments."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFont, QFontMetrics, QImage, QPainter, QPen
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from app.views import theme
from app.views.theme import Mark, Symbol

GAP_PX = 14.0
"""Half of the gap in the crosshair: the voxel under it stays visible."""


class ImageItem(QGraphicsItem):
    """A grey slice, scaled smoothly."""

    def __init__(self) -> None:
        super().__init__()
        self._rect = QRectF()
        self._image = QImage()

    def set_grey(self, grey: NDArray[np.uint8], extent_mm: tuple[float, float]) -> None:
        """Show grey values of shape (rows, columns) on this width and height [mm]."""
        rect = QRectF(0.0, 0.0, *extent_mm)
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        grey = np.ascontiguousarray(grey)
        rows, columns = grey.shape
        borrowed = QImage(grey.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
        # The conversion copies, so the image owns its pixels; 32 bits scale twice as fast.
        self._image = borrowed.convertToFormat(QImage.Format.Format_RGB32)
        self.update()

    def boundingRect(self) -> QRectF:
        """Return the image's place in the plane."""
        return self._rect

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Draw the image."""
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(self._rect, self._image)


class CrossLine(QGraphicsItem):
    """One line of the crosshair through the whole plane, with a gap around the point."""

    def __init__(self, mark: Mark, vertical: bool) -> None:
        super().__init__()
        self._pen = mark.pen(alpha=0.9)
        self._vertical = vertical
        self._at, self._along, self._length, self._gap = 0.0, 0.0, 0.0, 0.0
        self.setZValue(1)

    def place(self, at: float, along: float, length: float, scale: float) -> None:
        """Stand at `at` across and leave the gap at `along` [mm]; `length` [mm] of the plane."""
        state = (at, along, length, GAP_PX / scale)
        if state != (self._at, self._along, self._length, self._gap):
            self.prepareGeometryChange()
            self._at, self._along, self._length, self._gap = state

    def boundingRect(self) -> QRectF:
        """Return a strip around the line, so that moving it repaints no more than two strips."""
        half = max(0.2 * self._gap, 1e-3)
        if self._vertical:
            return QRectF(self._at - half, 0.0, 2 * half, self._length)
        return QRectF(0.0, self._at - half, self._length, 2 * half)

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Draw the two halves of the line."""
        painter.setPen(self._pen)
        for start, end in ((0.0, self._along - self._gap), (self._along + self._gap, self._length)):
            if end > start:
                painter.drawLine(self._point(start), self._point(end))

    def _point(self, along: float) -> QPointF:
        return QPointF(self._at, along) if self._vertical else QPointF(along, self._at)


class SegmentItem(QGraphicsItem):
    """A straight piece of needle or path with a dark rim, so that it shows on bone."""

    def __init__(self, z: float) -> None:
        super().__init__()
        self._start, self._end = QPointF(), QPointF()
        self._pen, self._rim, self._margin = QPen(), QPen(), 1.0
        self.setZValue(z)

    def place(
        self, start: tuple[float, float], end: tuple[float, float], pen: QPen, scale: float
    ) -> None:
        """Run from `start` to `end` [mm] in this pen; `scale` is the zoom [px/mm]."""
        self.prepareGeometryChange()
        self._start, self._end, self._pen = QPointF(*start), QPointF(*end), pen
        rim = QPen(pen)
        rim.setColor(Qt.GlobalColor.black)
        rim.setWidthF(pen.widthF() + 2.0)
        rim.setDashPattern([])
        rim.setStyle(Qt.PenStyle.SolidLine)
        self._rim = rim
        self._margin = (pen.widthF() + 4.0) / scale
        self.update()

    def boundingRect(self) -> QRectF:
        """Return the line's surroundings."""
        m = self._margin
        return QRectF(self._start, self._end).normalized().adjusted(-m, -m, m, m)

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Draw rim and line."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setOpacity(0.55 * self._pen.color().alphaF())
        painter.setPen(self._rim)
        painter.drawLine(self._start, self._end)
        painter.setOpacity(1.0)
        painter.setPen(self._pen)
        painter.drawLine(self._start, self._end)


class MarkItem(QGraphicsItem):
    """Entry, target or needle tip: a symbol of constant size with its name and its distance."""

    RADIUS = 7.0

    def __init__(self, mark: Mark, z: float, label_at: tuple[float, float]) -> None:
        super().__init__()
        self._mark = mark
        self._label_at = QPointF(*label_at)
        self._label = ""
        self._near = True
        self.setFlag(QGraphicsItem.GraphicsItemFlag.ItemIgnoresTransformations)
        self.setZValue(z)

    def place(self, x: float, y: float, label: str, near: bool) -> None:
        """Stand at (x, y) [mm]; faded and with a broken outline where the slice is not `near`."""
        self.setPos(x, y)
        if (label, near) != (self._label, self._near):
            self._label, self._near = label, near
            self.update()

    def boundingRect(self) -> QRectF:
        """Return symbol and label [px]."""
        return QRectF(-150.0, -26.0, 300.0, 52.0)

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Draw the symbol, then the label with a dark shadow."""
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        alpha = 1.0 if self._near else 0.75
        for colour, width in ((Qt.GlobalColor.black, self._mark.width + 2.0), (None, 0.0)):
            pen = self._mark.pen(width or None, alpha)
            if colour is not None:
                pen.setColor(colour)
            elif not self._near:
                pen.setDashPattern([1.2, 1.2])
            painter.setPen(pen)
            self._draw_symbol(painter, alpha, fill=colour is None)
        self._draw_label(painter, alpha)

    def _draw_symbol(self, painter: QPainter, alpha: float, fill: bool) -> None:
        r = self.RADIUS
        painter.setBrush(Qt.BrushStyle.NoBrush)
        if self._mark.symbol is Symbol.RING:
            painter.drawEllipse(QPointF(), r, r)
        elif self._mark.symbol is Symbol.DISC:
            if fill and self._near:
                painter.setBrush(self._mark.qcolor(0.35))
            painter.drawEllipse(QPointF(), r, r)
            painter.drawPoint(QPointF())
        elif self._mark.symbol is Symbol.DIAMOND:
            d = 0.7 * r
            corners = [QPointF(0, -d), QPointF(d, 0), QPointF(0, d), QPointF(-d, 0)]
            painter.drawPolygon(corners)

    def _draw_label(self, painter: QPainter, alpha: float) -> None:
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        place = QPointF(self._label_at)
        if place.x() < 0:
            place -= QPointF(QFontMetrics(font).horizontalAdvance(self._label), 0.0)
        painter.setPen(Qt.GlobalColor.black)
        painter.drawText(place + QPointF(1.0, 1.0), self._label)
        painter.setPen(self._mark.qcolor(min(1.0, alpha + 0.2)))
        painter.drawText(place, self._label)
