"""Words over a pane: text with a dark rim at marks, in the corners, on the edges, and the ruler.

Each is drawn once, as a picture, and copied with every painting of the slice below it.
"""

from __future__ import annotations

from enum import IntEnum, auto
from functools import lru_cache
from operator import itemgetter

from PySide6.QtCore import QPoint, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QWidget

from app.views.kit import theme
from app.views.kit.text import tr
from app.views.slices.camera import ruler

PADDING = 6
RULER_PX = 110.0
_A = Qt.AlignmentFlag
_RIM = ((-1, 0), (1, 0), (0, -1), (0, 1))
_RIM_COLOUR = QColor(0, 0, 0, 220)

PLATE = QColor(0, 0, 0, 153)
"""Behind words on bright tissue, which a rim alone leaves smeared: black of 60 %."""


def blank(size: QSize, ratio: float) -> QPixmap:
    """Return a transparent picture of a size in the window's pixels, `ratio` times as fine."""
    picture = QPixmap(size * ratio)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    return picture


def with_rim(text: QPixmap, size: QSize, rim: QColor | Qt.GlobalColor) -> QPixmap:
    """Put a dark rim round text that is drawn already: letters are slow to draw, quick to copy.

    Args:
        text: on transparent ground.
        size: of it in the window's pixels.
        rim: colour of the rim.
    """
    dark, picture = QPixmap(text), blank(size, text.devicePixelRatio())
    with QPainter(dark) as painter:
        painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceIn)
        painter.fillRect(QRect(QPoint(), size), rim)
    with QPainter(picture) as painter:
        for dx, dy in _RIM:
            painter.drawPixmap(dx, dy, dark)
        painter.drawPixmap(0, 0, text)
    return picture


@lru_cache(maxsize=256)
def rimmed(text: str, pixels: int, colour: str, ratio: float) -> QPixmap:
    """Return a picture of a text.

    Args:
        text: a few letters.
        pixels: height of the font.
        colour: of the text.
        ratio: the screen's pixels to one of the window's.
    """
    font = QFont()
    font.setPixelSize(pixels)
    metrics = QFontMetrics(font)
    size = QSize(metrics.horizontalAdvance(text) + 4, metrics.height() + 2)
    letters = blank(size, ratio)
    with QPainter(letters) as painter:
        painter.setFont(font)
        painter.setPen(QColor(colour))
        painter.drawText(QRect(QPoint(), size), _A.AlignCenter | Qt.TextFlag.TextDontClip, text)
    return with_rim(letters, size, Qt.GlobalColor.black)


class Worth(IntEnum):
    """How much a line is worth: where there is no room for all, the least goes first."""

    ZOOM = auto()
    RULER = auto()
    NAME = auto()
    THICKNESS = auto()
    PLACE = auto()
    COUNT = auto()
    TILT = auto()
    WINDOW = auto()
    VALUE = auto()
    UPRIGHT_LETTER = auto()
    POSITION = auto()
    LETTER = auto()
    WARNING = auto()
    TITLE = auto()


Line = tuple[str, Worth]


class Written:
    """A picture of words at a place in a pane.

    Attributes:
        held: place that it may need soon, to be kept free; none at first.
        left_out: the lines for which there is no room; changed by `leave_out`.
    """

    def __init__(self, pane: QWidget) -> None:
        self._pane = pane
        self.held = QRect()
        self.left_out: frozenset[Line] = frozenset()
        self._rect = QRect()
        self._picture = QPixmap()
        self._visible = True

    def geometry(self) -> QRect:
        """Place and size in the pane."""
        return QRect(self._rect)

    def pos(self) -> QPoint:
        """Left top corner in the pane."""
        return self._rect.topLeft()

    def isVisible(self) -> bool:
        """Return whether it is painted."""
        return self._visible

    def setVisible(self, visible: bool) -> None:
        """Paint it, or not."""
        if visible != self._visible:
            self._visible = visible
            self._pane.update()

    def move(self, x: int, y: int) -> None:
        """Stand there."""
        if (x, y) != (self._rect.x(), self._rect.y()):
            self._rect.moveTo(x, y)
            self._pane.update()

    def paint(self, painter: QPainter) -> None:
        """Copy the picture."""
        if self._visible and not self._picture.isNull():
            painter.drawPixmap(self._rect.topLeft(), self._picture)

    @property
    def is_empty(self) -> bool:
        """Return whether it shows nothing."""
        return not self._visible

    @property
    def least(self) -> Line | None:
        """The line that goes first where there is no room; None if what is left must stay."""
        raise NotImplementedError

    def leave_out(self, *lines: Line) -> None:
        """Show all lines but these."""
        raise NotImplementedError

    def _blank(self, size: QSize) -> QPixmap:
        """Become so large; return a transparent picture of that size in the screen's pixels."""
        self._rect.setSize(size)
        return blank(size, self._pane.devicePixelRatioF())


@lru_cache(maxsize=16)
def _metrics(family: str, pixels: int, bold: bool) -> QFontMetrics:
    """Measures of a font."""
    font = QFont(family)
    font.setPixelSize(pixels)
    font.setBold(bold)
    return QFontMetrics(font)


class Overlay(Written):
    """Lines of text in a corner or on an edge of a pane, none wider than the pane.

    Attributes:
        lines: what it has to say; changed by `set_lines`.
    """

    def __init__(
        self,
        pane: QWidget,
        alignment: Qt.AlignmentFlag,
        colour: str = theme.IMAGE_TEXT,
        bold: bool = False,
        larger: int = 0,
    ) -> None:
        super().__init__(pane)
        edges = (_A.AlignLeft, _A.AlignRight, _A.AlignTop, _A.AlignBottom)
        self._edges = tuple(bool(alignment & edge) for edge in edges)
        self._flags = alignment & _A.AlignHorizontal_Mask
        self._colour = QColor(colour)
        self._larger, self._bold = larger, bold
        self._drawn: tuple[object, ...] = ()
        self.lines: tuple[Line, ...] = ()
        self._shown: tuple[str, ...] = ()
        self._first: QColor | None = None

    def set_lines(self, *lines: Line, first: str = "") -> None:
        """Say these lines, the first in the colour `first` if given; empty ones fall out."""
        lines = tuple(line for line in lines if line[0])
        if lines != self.lines:
            self.lines, self.left_out = lines, frozenset()
            self._first = QColor(first) if first else self._first
            self.place()

    def leave_out(self, *lines: Line) -> None:
        """Show all lines but these."""
        if self.left_out != frozenset(lines):
            self.left_out = frozenset(lines)
            self.place()

    @property
    def least(self) -> Line | None:
        """The line that goes first where there is no room; None if only the title is left."""
        left = [line for line in self.lines if line not in self.left_out]
        return min(
            (line for line in left if line[1] < Worth.TITLE), key=itemgetter(1), default=None
        )

    @property
    def is_cut(self) -> bool:
        """Return whether there is more to read than is shown."""
        return bool(self.left_out) or any(self._elided(line) != line for line in self._shown)

    @property
    def is_empty(self) -> bool:
        """Return whether it shows nothing."""
        return not self._shown or not self._visible

    def text(self) -> str:
        """Return what is shown."""
        return "\n".join(self._shown)

    def place(self) -> None:
        """Stand at one's corner or edge of the pane, as large as what is shown."""
        self._shown = tuple(line[0] for line in self.lines if line not in self.left_out)
        metrics, most = self._metrics, self._most
        widths = (min(metrics.horizontalAdvance(line), most) for line in self._shown)
        width, height = max(widths, default=0) + 4, metrics.height() * len(self._shown) + 2
        self._rect.setSize(QSize(width, height))
        outer = self._pane.rect().adjusted(PADDING, PADDING, -PADDING, -PADDING)
        x, y = outer.center().x() - width // 2, outer.center().y() - height // 2
        left, right, top, bottom = self._edges
        if left:
            x = outer.left()
        elif right:
            x = outer.right() - width + 1
        if top:
            y = outer.top()
        elif bottom:
            y = outer.bottom() - height + 1
        self.move(x, y)
        if self._looks != self._drawn:
            self._pane.update()

    def paint(self, painter: QPainter) -> None:
        """Copy the picture; draw it first where it says something else than before."""
        if not self._shown:
            return
        if self._looks != self._drawn:
            self._drawn = self._looks
            self._draw()
        super().paint(painter)

    @property
    def _metrics(self) -> QFontMetrics:
        return _metrics(self._pane.font().family(), theme.SMALL_PX + self._larger, self._bold)

    @property
    def _most(self) -> int:
        """Width that a line may have [px]."""
        return max(1, self._pane.width() - 2 * PADDING - 4)

    @property
    def _looks(self) -> tuple[object, ...]:
        ratio, size = self._pane.devicePixelRatioF(), self._rect.size()
        return (self._shown, self._most, theme.SMALL_PX, ratio, size.width(), size.height())

    def _elided(self, line: str) -> str:
        return self._metrics.elidedText(line, Qt.TextElideMode.ElideRight, self._most)

    def _draw(self) -> None:
        font = QFont(self._pane.font())
        font.setPixelSize(theme.SMALL_PX + self._larger)
        font.setBold(self._bold)
        height, size = self._metrics.height(), self._rect.size()
        letters = self._blank(size)
        with QPainter(letters) as painter:
            painter.setFont(font)
            for number, line in enumerate(self._shown):
                box = QRect(1, 1 + number * height, size.width() - 2, height)
                first = self._first if number == 0 and self._first is not None else self._colour
                painter.setPen(first)
                painter.drawText(box, self._flags, self._elided(line))
        self._picture = with_rim(letters, size, _RIM_COLOUR)


class Ruler(Written):
    """A scale bar of a round length, with its length written above."""

    def __init__(self, pane: QWidget) -> None:
        super().__init__(pane)
        self._state, self._length = (0.0, 0.0, 0), 0.0
        self._rect.setSize(QSize(int(RULER_PX) + 8, 26))

    def set_scale(self, scale: float) -> None:
        """Fit the ruler to this zoom [px/mm]."""
        state = (scale, self._pane.devicePixelRatioF(), theme.SMALL_PX)
        if state != self._state:
            self._state, self._length = state, ruler(scale, RULER_PX)
            letters = _metrics(self._pane.font().family(), theme.SMALL_PX, False).height()
            picture = self._blank(QSize(int(RULER_PX) + 8, letters + 10))
            with QPainter(picture) as painter:
                self._draw_on(painter, scale)
            self._picture = picture
            self._pane.update()

    def text(self) -> str:
        """Return the length of the ruler."""
        if self._length >= 10.0:
            return tr("{length:g} cm", length=self._length / 10.0)
        return tr("{length:g} mm", length=self._length)

    @property
    def least(self) -> Line | None:
        """It has one line only."""
        return (self.text(), Worth.RULER)

    def leave_out(self, *lines: Line) -> None:
        """Vanish, or come back."""
        self.left_out = frozenset(lines)
        self.setVisible(not lines)

    def _draw_on(self, painter: QPainter, scale: float) -> None:
        """Draw the bar between two ticks, light on dark."""
        right, base = self._rect.width() - 3.0, self._rect.height() - 4.0
        left = right - self._length * scale
        for colour, width in (("#000000", 4.0), (theme.IMAGE_TEXT, 1.5)):
            painter.setPen(QPen(QColor(colour), width))
            painter.drawLine(QPointF(left, base), QPointF(right, base))
            for x in (left, right):
                painter.drawLine(QPointF(x, base - 5), QPointF(x, base))
        font = QFont(self._pane.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        box = QRect(QPoint(0, 0), self._rect.size()).adjusted(0, 0, -4, -8)
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop
        painter.setPen(QColor("#000000"))
        painter.drawText(box.translated(1, 1), flags, self.text())
        painter.setPen(QColor(theme.IMAGE_TEXT))
        painter.drawText(box, flags, self.text())
