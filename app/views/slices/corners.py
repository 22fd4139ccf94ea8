"""Read-outs over a pane: text with a dark rim in the corners, letters on the edges, the ruler."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPoint, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPen, QPixmap
from PySide6.QtWidgets import QLabel, QWidget

from app.views.kit import theme
from app.views.kit.text import tr
from app.views.slices.camera import ruler

PADDING = 6
RULER_PX = 110.0
_A = Qt.AlignmentFlag


class Overlay(QLabel):
    """Lines of text that lie over the image and let the mouse through.

    The text is drawn once, as a picture: it is painted again with every slice below it.
    """

    def __init__(
        self,
        parent: QWidget,
        alignment: Qt.AlignmentFlag,
        colour: str = theme.IMAGE_TEXT,
        bold: bool = False,
        larger: int = 0,
    ) -> None:
        super().__init__(parent)
        self._outer = parent
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self.setAttribute(Qt.WidgetAttribute.WA_NoSystemBackground)
        edges = (_A.AlignLeft, _A.AlignRight, _A.AlignTop, _A.AlignBottom)
        self._edges = tuple(bool(alignment & edge) for edge in edges)
        self._flags = alignment & _A.AlignHorizontal_Mask
        self._colour = QColor(colour)
        self._room: tuple[QSize, QSize] | None = None
        self._at = QPoint()
        self._larger, self._bold = larger, bold
        self._font = self._sized_font()
        self._lines: tuple[str, ...] = ()
        self._first: QColor | None = None

    def _sized_font(self) -> QFont:
        font = QFont(self.font())
        font.setPixelSize(theme.SMALL_PX + self._larger)
        font.setBold(self._bold)
        return font

    def changeEvent(self, event: QEvent) -> None:
        """Take another size of the text; told of several times for one change."""
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_lines"):
            size = theme.SMALL_PX + self._larger
            if size != self._font.pixelSize():
                self._font = self._sized_font()
                self._draw()

    def set_lines(self, *lines: str, first: str = "") -> None:
        """Show these lines, the first of them in the colour `first` if given."""
        if lines != self._lines:
            self._lines = lines
            self._first = QColor(first) if first else self._first
            self._draw()

    def text(self) -> str:
        """Return what is shown."""
        return "\n".join(self._lines)

    def sizeHint(self) -> QSize:
        """Return the room that the lines take."""
        metrics = QFontMetrics(self._font)
        width = max((metrics.horizontalAdvance(line) for line in self._lines), default=0)
        return QSize(width + 4, metrics.height() * len(self._lines) + 2)

    def place(self) -> None:
        """Stand at one's corner or edge of the parent, drawn for the screen it is on."""
        if self._lines and self.pixmap().devicePixelRatio() != self.devicePixelRatioF():
            self._draw()
            return
        size, room = self.size(), (self.size(), self._outer.size())
        if room == self._room and self.pos() == self._at:  # a view that scrolls takes it along
            return
        self._room = room
        outer = self._outer.rect().adjusted(PADDING, PADDING, -PADDING, -PADDING)
        x, y = outer.center().x() - size.width() // 2, outer.center().y() - size.height() // 2
        left, right, top, bottom = self._edges
        if left:
            x = outer.left()
        elif right:
            x = outer.right() - size.width() + 1
        if top:
            y = outer.top()
        elif bottom:
            y = outer.bottom() - size.height() + 1
        self.move(x, y)
        self._at = self.pos()

    def _draw(self) -> None:
        """Every line several times: a dark rim, then the text."""
        self.resize(self.sizeHint())
        picture = blank(self)
        with QPainter(picture) as painter:
            self._draw_on(painter)
        self.setPixmap(picture)
        self.place()

    def _draw_on(self, painter: QPainter) -> None:
        painter.setFont(self._font)
        height = QFontMetrics(self._font).height()
        for number, line in enumerate(self._lines):
            box = QRect(1, 1 + number * height, self.width() - 2, height)
            painter.setPen(QColor(0, 0, 0, 220))
            for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
                painter.drawText(box.translated(dx, dy), self._flags, line)
            first = self._first if number == 0 and self._first is not None else self._colour
            painter.setPen(first)
            painter.drawText(box, self._flags, line)


class Ruler(QLabel):
    """A scale bar of a round length, with its length written above."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._state, self._length = (0.0, 0.0, 0), 0.0
        self.resize(int(RULER_PX) + 8, 26)

    def set_scale(self, scale: float) -> None:
        """Fit the ruler to this zoom [px/mm]."""
        state = (scale, self.devicePixelRatioF(), theme.SMALL_PX)
        if state != self._state:
            self._state, self._length = state, ruler(scale, RULER_PX)
            picture = blank(self)
            with QPainter(picture) as painter:
                self._draw_on(painter, scale)
            self.setPixmap(picture)

    def text(self) -> str:
        """Return the length of the ruler."""
        if self._length >= 10.0:
            return tr("{length:g} cm", length=self._length / 10.0)
        return tr("{length:g} mm", length=self._length)

    def _draw_on(self, painter: QPainter, scale: float) -> None:
        """Draw the bar between two ticks, light on dark."""
        right, base = self.width() - 3.0, self.height() - 4.0
        left = right - self._length * scale
        for colour, width in (("#000000", 4.0), (theme.IMAGE_TEXT, 1.5)):
            painter.setPen(QPen(QColor(colour), width))
            painter.drawLine(QPointF(left, base), QPointF(right, base))
            for x in (left, right):
                painter.drawLine(QPointF(x, base - 5), QPointF(x, base))
        font = QFont(self.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        box = self.rect().adjusted(0, 0, -4, -8)
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop
        painter.setPen(QColor("#000000"))
        painter.drawText(box.translated(1, 1), flags, self.text())
        painter.setPen(QColor(theme.IMAGE_TEXT))
        painter.drawText(box, flags, self.text())


def blank(widget: QWidget) -> QPixmap:
    """Return a transparent picture of a widget's size, in its screen's pixels."""
    ratio = widget.devicePixelRatioF()
    picture = QPixmap(widget.size() * ratio)
    picture.setDevicePixelRatio(ratio)
    picture.fill(Qt.GlobalColor.transparent)
    return picture
