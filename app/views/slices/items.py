"""What is drawn in a slice, in plane millimetres: image, crosshair lines, marks and segments."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QFont, QFontMetrics, QImage, QPainter, QPen
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from app.imaging.window import WindowLevel, to_grey
from app.views import theme
from app.views.slices.labels import Placed, Wanted
from app.views.theme import Mark, Symbol

GAP_PX = 14.0
"""Half of the gap in the crosshair: the voxel under it stays visible."""


class ImageItem(QGraphicsItem):
    """A grey slice, scaled smoothly.

    Grey values are made when the slice is painted: of the many windows of a fast drag only those
    that reach the screen cost anything.
    """

    def __init__(self) -> None:
        super().__init__()
        self._rect = QRectF()
        self._image = QImage()
        self._stale: tuple[NDArray[Any], WindowLevel] | None = None

    def set_slice(
        self, hu: NDArray[Any], window: WindowLevel, extent_mm: tuple[float, float]
    ) -> None:
        """Show Hounsfield units, shape (rows, columns), on this width and height [mm]."""
        rect = QRectF(0.0, 0.0, *extent_mm)
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        self._stale = (hu, window)
        self.update()

    def image(self) -> QImage:
        """Return the slice in grey."""
        if self._stale is not None:
            grey = np.ascontiguousarray(to_grey(*self._stale))
            self._stale = None
            rows, columns = grey.shape
            borrowed = QImage(grey.data, columns, rows, columns, QImage.Format.Format_Grayscale8)
            # The conversion copies, so the image owns its pixels; 32 bits scale twice as fast.
            self._image = borrowed.convertToFormat(QImage.Format.Format_RGB32)
        return self._image

    def boundingRect(self) -> QRectF:
        """Return the image's place in the plane."""
        return self._rect

    def paint(
        self, painter: QPainter, option: QStyleOptionGraphicsItem, widget: QWidget | None = None
    ) -> None:
        """Draw the image."""
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(self._rect, self.image())


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

    def __init__(self, mark: Mark, z: float, optional: bool = False) -> None:
        """Make a mark; an `optional` label is left out where there is no good place for it."""
        super().__init__()
        self._mark, self._optional = mark, optional
        self._label, self._near = "", True
        self._size = QSizeF()
        self._rect: QRectF | None = None
        self._last = 0
        self.setFlag(QGraphicsItem.GraphicsItemFlag.ItemIgnoresTransformations)
        # Drawn once, then moved as a picture: a live needle moves many times a second.
        self.setCacheMode(QGraphicsItem.CacheMode.DeviceCoordinateCache)
        self.setZValue(z)

    def place(self, x: float, y: float, label: str, near: bool) -> None:
        """Stand at (x, y) [mm]; faded and with a broken outline where the slice is not `near`."""
        self.setPos(x, y)
        if (label, near) != (self._label, self._near):
            metrics = QFontMetrics(label_font())
            self._size = QSizeF(metrics.horizontalAdvance(label) + 2, metrics.height())
            self._label, self._near = label, near
            self.update()

    def wanted(self, at: QPointF) -> Wanted | None:
        """Say what place the label wants, the mark standing at this pixel; None without a label."""
        if not self._label or not self.isVisible():
            return None
        width, height = self._size.width(), self._size.height()
        return Wanted(at.x(), at.y(), width, height, self.RADIUS, self._last, self._optional)

    def place_label(self, at: QPointF, placed: Placed | None) -> None:
        """Put the label where it was arranged, the mark standing at this pixel; None hides it."""
        rect = None
        if placed is not None:
            self._last = placed.place
            rect = QRectF(*placed.rect).translated(-at)
        if not _alike(rect, self._rect):
            self.prepareGeometryChange()
            self._rect = rect
            self.update()

    @property
    def label_rect(self) -> QRectF | None:
        """Place of the label seen from the mark [px]; None while it is not shown."""
        return self._rect

    def boundingRect(self) -> QRectF:
        """Return symbol and label [px]."""
        reach = self.RADIUS + self._mark.width + 2.0
        symbol = QRectF(-reach, -reach, 2 * reach, 2 * reach)
        return symbol if self._rect is None else symbol.united(self._rect.adjusted(-1, -1, 2, 2))

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
        if self._rect is None:
            return
        painter.setFont(label_font())
        flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextDontClip
        painter.setPen(Qt.GlobalColor.black)
        for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
            painter.drawText(self._rect.translated(dx, dy), flags, self._label)
        painter.setPen(self._mark.qcolor(min(1.0, alpha + 0.2)))
        painter.drawText(self._rect, flags, self._label)


def label_font() -> QFont:
    """Return the font of the marks' names."""
    font = QFont()
    font.setPixelSize(theme.SMALL_PX)
    return font


def _alike(one: QRectF | None, other: QRectF | None) -> bool:
    """Whether two places are the same to a quarter of a pixel: less is not worth drawing anew."""
    if one is None or other is None:
        return one is other
    shift, growth = one.topLeft() - other.topLeft(), one.size() - other.size()
    changes = (shift.x(), shift.y(), growth.width(), growth.height())
    return all(abs(change) < 0.25 for change in changes)
