"""What is drawn over a slice, in plane millimetres: marks and segments."""

from __future__ import annotations

from functools import lru_cache

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFont,
    QFontMetrics,
    QLinearGradient,
    QPainter,
    QPen,
)
from PySide6.QtWidgets import QGraphicsItem, QStyleOptionGraphicsItem, QWidget

from app.views.kit import theme
from app.views.kit.theme import Mark, Symbol
from app.views.slices.labels import Placed, Wanted
from app.views.slices.rimmed_text import rimmed


class SegmentItem(QGraphicsItem):
    """A straight piece of needle or path with a dark rim, so that it shows on bone."""

    def __init__(self, z: float) -> None:
        super().__init__()
        self._start, self._end = QPointF(), QPointF()
        self._pen, self._rim, self._bounds = QPen(), QPen(), QRectF()
        self._state: tuple[object, ...] = ()
        self.setZValue(z)
        self.setVisible(False)

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
        state = (start, end, pen, scale, alphas)
        if state == self._state:
            return
        self.prepareGeometryChange()
        self._state = state
        self._start, self._end = QPointF(*start), QPointF(*end)
        rim = QPen(Qt.GlobalColor.black, pen.widthF() + 2.0)
        rim.setCosmetic(True)
        rim.setCapStyle(pen.capStyle())
        self._pen = self._faded(pen, alphas)
        self._rim = self._faded(rim, (0.55 * alphas[0], 0.55 * alphas[1]))
        m = (pen.widthF() + 4.0) / scale
        self._bounds = QRectF(self._start, self._end).normalized().adjusted(-m, -m, m, m)
        self.update()

    def boundingRect(self) -> QRectF:
        """Return the line's surroundings."""
        return self._bounds

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
        reach = self.RADIUS + mark.width + 2.0
        self._symbol = self._bounds = QRectF(-reach, -reach, 2 * reach, 2 * reach)
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
            self._size = _text_size(label, theme.SMALL_PX)
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
            self._rect, self._bounds = rect, self._symbol
            if rect is not None:
                self._bounds = self._symbol.united(rect.adjusted(-1, -1, 2, 2))
            self.update()

    @property
    def label_rect(self) -> QRectF | None:
        """Place of the label seen from the mark [px]; None while it is not shown."""
        return self._rect

    def boundingRect(self) -> QRectF:
        """Return symbol and label [px]."""
        return self._bounds

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
        colour = self._mark.qcolor(min(1.0, alpha + 0.2)).name(QColor.NameFormat.HexArgb)
        ratio = painter.device().devicePixelRatioF()
        picture = rimmed(self._label, theme.SMALL_PX, colour, ratio)
        middle, size = self._rect.center(), picture.deviceIndependentSize()
        corner = QPointF(middle.x() - size.width() / 2, middle.y() - size.height() / 2)
        painter.drawPixmap(corner, picture)


@lru_cache(maxsize=512)
def _text_size(text: str, pixels: int) -> QSizeF:
    """Room of a name in letters of so many pixels, which `label_font` has."""
    metrics = QFontMetrics(label_font())
    return QSizeF(metrics.horizontalAdvance(text) + 2, metrics.height())


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
