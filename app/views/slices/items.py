"""What is drawn in a slice, in plane millimetres: image, crosshair lines, marks and segments."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFont,
    QFontMetrics,
    QImage,
    QLinearGradient,
    QPainter,
    QPen,
)
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from app.imaging.window import WindowLevel, to_grey
from app.views import theme
from app.views.slices.labels import Placed, Wanted
from app.views.theme import Mark, Symbol


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
        self._inverted = False

    def set_slice(
        self,
        hu: NDArray[Any],
        window: WindowLevel,
        bounds_mm: tuple[float, float, float, float],
        inverted: bool = False,
    ) -> None:
        """Show Hounsfield units, shape (rows, columns), on this left, top, width, height [mm]."""
        rect = QRectF(*bounds_mm)
        if rect != self._rect:
            self.prepareGeometryChange()
            self._rect = rect
        self._stale, self._inverted = (hu, window), inverted
        self.update()

    def clear(self) -> None:
        """Show nothing."""
        self.prepareGeometryChange()
        self._rect, self._stale = QRectF(), None

    def image(self) -> QImage:
        """Return the slice in grey."""
        if self._stale is not None:
            grey = np.ascontiguousarray(to_grey(*self._stale))
            if self._inverted:
                np.subtract(255, grey, out=grey)
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
        if self._rect.isEmpty():
            return
        painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
        painter.drawImage(self._rect, self.image())


class SegmentItem(QGraphicsItem):
    """A straight piece of needle or path with a dark rim, so that it shows on bone."""

    def __init__(self, z: float) -> None:
        super().__init__()
        self._start, self._end = QPointF(), QPointF()
        self._pen, self._rim, self._margin = QPen(), QPen(), 1.0
        self.setZValue(z)

    def place(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        pen: QPen,
        scale: float,
        alphas: tuple[float, float] = (1.0, 1.0),
    ) -> None:
        """Run from `start` to `end` [mm] in this pen.

        Args:
            start: one end [mm].
            end: the other [mm].
            pen: cosmetic, opaque.
            scale: zoom [px/mm].
            alphas: opacity at either end; it changes evenly between them.
        """
        self.prepareGeometryChange()
        self._start, self._end = QPointF(*start), QPointF(*end)
        rim = QPen(Qt.GlobalColor.black, pen.widthF() + 2.0)
        rim.setCosmetic(True)
        rim.setCapStyle(pen.capStyle())
        self._pen = self._faded(pen, alphas)
        self._rim = self._faded(rim, (0.55 * alphas[0], 0.55 * alphas[1]))
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
        painter.setPen(self._rim)
        painter.drawLine(self._start, self._end)
        painter.setPen(self._pen)
        painter.drawLine(self._start, self._end)

    def _faded(self, pen: QPen, alphas: tuple[float, float]) -> QPen:
        faded, colours = QPen(pen), []
        for alpha in alphas:
            colour = QColor(pen.color())
            colour.setAlphaF(alpha)
            colours.append(colour)
        if alphas[0] == alphas[1]:
            faded.setColor(colours[0])
            return faded
        gradient = QLinearGradient(self._start, self._end)
        gradient.setColorAt(0.0, colours[0])
        gradient.setColorAt(1.0, colours[1])
        faded.setBrush(QBrush(gradient))
        return faded


class MarkItem(QGraphicsItem):
    """Entry, target or needle tip: a symbol of constant size with its name and its distance."""

    RADIUS = 7.0

    def __init__(self, mark: Mark, z: float, optional: bool = False) -> None:
        """Make a mark; an `optional` label is left out where there is no good place for it."""
        super().__init__()
        self._mark, self._optional = mark, optional
        self._label, self._near, self._text_px = "", True, theme.SMALL_PX
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
        state = (label, near, theme.SMALL_PX)
        if state != (self._label, self._near, self._text_px):
            metrics = QFontMetrics(label_font())
            self._size = QSizeF(metrics.horizontalAdvance(label) + 2, metrics.height())
            self._label, self._near, self._text_px = state
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
