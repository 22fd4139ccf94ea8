"""Marks and segments over a slice."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import ceil, cos, sin, tau

from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPixmap

from app.views.kit import theme
from app.views.kit.theme import Mark, Symbol
from app.views.slices.drawing import Ink, Shape, Strokes, stroke
from app.views.slices.labels import PlacedLabel, Wanted
from app.views.slices.words import PLATE, rimmed


class SegmentItem(Strokes):
    """A straight piece of needle or path with a dark rim, so that it shows on bone."""

    def __init__(self, z: float) -> None:
        super().__init__(z, visible=False)
        self._state: tuple[object, ...] = ()

    def place(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        ink: Ink,
        alphas: tuple[float, float] = (1.0, 1.0),
    ) -> None:
        """Run from `start` to `end` [mm].

        Args:
            start: one end [mm].
            end: the other [mm].
            ink: of the line.
            alphas: opacity at either end; it changes evenly between them.
        """
        state = (start, end, ink, alphas)
        if state == self._state:
            return
        self._state = state
        self.set_rows([*stroke(start, end, ink.rim, alphas), *stroke(start, end, ink, alphas)])


class MarkItem(Shape):
    """Entry, target or needle tip: a symbol of constant size with its name and its distance."""

    RADIUS = 7.0

    def __init__(self, mark: Mark, z: float, optional: bool = False) -> None:
        """Make a mark; an `optional` label is left out where there is no good place for it."""
        super().__init__(z)
        self._mark, self._optional = mark, optional
        self._label, self._near = "", True
        self._words: Callable[[], str] = str
        self._size = QSizeF()
        self._at = QPointF()
        self._rect: QRectF | None = None
        self._last = 0
        self._looks: tuple[object, ...] = ()
        self._symbol, self._picture, self._middle = QPixmap(), QPixmap(), QPointF()

    def x(self) -> float:
        """Return where it stands [mm]."""
        return self._at.x()

    def y(self) -> float:
        """Return where it stands [mm]."""
        return self._at.y()

    def setVisible(self, visible: bool) -> None:
        """Draw it from now on, or not; a hidden one holds no words, and with them no plane's CT."""
        super().setVisible(visible)
        if not visible:
            self._words = str

    def place(self, x: float, y: float, words: Callable[[], str], near: bool) -> None:
        """Stand at (x, y) [mm].

        Args:
            x: place in the plane, to the right.
            y: place in the plane, down.
            words: its name; asked only as often as words are written.
            near: whether it lies in the slice; else it is faded, with a broken outline.
        """
        self._words, self._near = words, near
        self._at = QPointF(x, y)
        self.touch()

    def wanted(self, at: QPointF) -> Wanted | None:
        """Say what place the label wants, the mark standing at this pixel; None without a label."""
        if not self.isVisible():
            return None
        label = self._words()
        if label != self._label:
            self._label = label
            self.touch()
        if not label:
            return None
        self._size = _text_size(self._label, theme.SMALL_PX)
        width, height = self._size.width(), self._size.height()
        return Wanted(at.x(), at.y(), width, height, self.RADIUS, self._last, self._optional)

    def place_label(self, at: QPointF, placed: PlacedLabel | None) -> None:
        """Put the label where it was arranged, the mark standing at this pixel; None hides it."""
        rect = None
        if placed is not None:
            self._last = placed.place
            rect = QRectF(*placed.rect).translated(-at)
        if not _alike(rect, self._rect):
            self._rect = rect
            self.touch()

    @property
    def label_rect(self) -> QRectF | None:
        """Place of the label seen from the mark [px]; None while it is not shown."""
        return self._rect

    def paint(self, painter: QPainter) -> None:
        """Copy the symbol, then the label on its dark plate; neither zooms."""
        at = painter.transform().map(self._at)
        painter.resetTransform()
        ratio = painter.device().devicePixelRatioF()
        looks = (self._near, self._label, theme.SMALL_PX, ratio)
        if self._looks != looks:
            self._looks = looks
            self._symbol = _symbol(self._mark, self._near, ratio)
            colour = self._mark.qcolor(1.0 if self._near else 0.95)
            name = colour.name(QColor.NameFormat.HexArgb)
            self._picture = rimmed(self._label, theme.SMALL_PX, name, ratio)
            size = self._picture.deviceIndependentSize()
            self._middle = QPointF(size.width() / 2, size.height() / 2)
        half = _reach(self._mark)
        painter.drawPixmap(at - QPointF(half, half), self._symbol)
        if self._rect is not None and self._label:
            painter.fillRect(self._rect.translated(at), PLATE)
            painter.drawPixmap(self._rect.center() + at - self._middle, self._picture)


def _reach(mark: Mark) -> float:
    """Half the side of a mark's picture [px]."""
    return float(ceil(MarkItem.RADIUS + mark.width + 2.0))


@lru_cache(maxsize=64)
def _symbol(mark: Mark, near: bool, ratio: float) -> QPixmap:
    """Picture of a mark's symbol with its rim; faded and broken where it is not near."""
    reach = _reach(mark)
    side = round(2.0 * reach * ratio)
    picture = QPixmap(side, side)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    with QPainter(picture) as painter:
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.translate(reach, reach)
        alpha = 1.0 if near else 0.75
        rim = mark.pen(mark.width + 2.0, alpha)
        rim.setColor(Qt.GlobalColor.black)
        line = mark.pen(None, alpha)
        if not near:
            line.setDashPattern([1.2, 1.2])
        for pen in (rim, line):
            painter.setPen(pen)
            draw_symbol(painter, mark, pen is line and near)
    return picture


def draw_symbol(painter: QPainter, mark: Mark, fill: bool) -> None:
    """Draw a mark's symbol about the origin with the painter's pen; `fill` fills a disc."""
    r = MarkItem.RADIUS
    painter.setBrush(Qt.BrushStyle.NoBrush)
    if mark.symbol is Symbol.RING:
        painter.drawEllipse(QPointF(), r, r)
    elif mark.symbol is Symbol.DISC:
        if fill:
            painter.setBrush(mark.qcolor(0.35))
        painter.drawEllipse(QPointF(), r, r)
        painter.drawPoint(QPointF())
    elif mark.symbol is Symbol.DIAMOND:
        d = 0.7 * r
        corners = [QPointF(0, -d), QPointF(d, 0), QPointF(0, d), QPointF(-d, 0)]
        painter.drawPolygon(corners)
    elif mark.symbol is Symbol.SQUARE:
        painter.drawRect(QRectF(-0.6 * r, -0.6 * r, 1.2 * r, 1.2 * r))
    elif mark.symbol in _STROKES:
        for turns in _STROKES[mark.symbol]:
            way = [QPointF(r * sin(tau * turn), -r * cos(tau * turn)) for turn in turns]
            painter.drawPolyline(way)


_STROKES: dict[Symbol, tuple[tuple[float, ...], ...]] = {
    Symbol.TRIANGLE: ((0.0, 1 / 3, 2 / 3, 0.0),),
    Symbol.DOWN: ((0.5, 5 / 6, 1 / 6, 0.5),),
    Symbol.CROSS: ((1 / 8, 5 / 8), (3 / 8, 7 / 8)),
    Symbol.PLUS: ((0.0, 0.5), (0.25, 0.75)),
    Symbol.HEXAGON: (tuple(k / 6 for k in range(7)),),
    Symbol.STAR: tuple((k / 10, k / 10 + 0.5) for k in range(5)),
}
"""Lines of a symbol: turns from straight up, clockwise, of their corners."""


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


def _alike(item: QRectF | None, other: QRectF | None) -> bool:
    """Return whether two places are the same to a quarter of a pixel: less is not worth drawing
    anew.
    """
    if item is None or other is None:
        return item is other
    shift, growth = item.topLeft() - other.topLeft(), item.size() - other.size()
    changes = (shift.x(), shift.y(), growth.width(), growth.height())
    return all(abs(change) < 0.25 for change in changes)
