"""Read-outs over a pane: text with a dark rim in the corners, letters on the edges, the ruler."""

from __future__ import annotations

from PySide6.QtCore import QEvent, QPointF, QRect, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPaintEvent, QPen, QPixmap
from PySide6.QtWidgets import QWidget

from app.views import theme
from app.views.slices.camera import ruler
from app.views.text import tr

PADDING = 6
RULER_PX = 110.0


class Overlay(QWidget):
    """Lines of text that lie over the image and let the mouse through."""

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
        self._alignment, self._colour = alignment, QColor(colour)
        self._larger, self._bold = larger, bold
        self._font = self._sized_font()
        self._lines: tuple[str, ...] = ()
        self._first: QColor | None = None
        self._picture: QPixmap | None = None

    def _sized_font(self) -> QFont:
        font = QFont(self.font())
        font.setPixelSize(theme.SMALL_PX + self._larger)
        font.setBold(self._bold)
        return font

    def changeEvent(self, event: QEvent) -> None:
        """Take another size of the text."""
        if event.type() == QEvent.Type.FontChange and hasattr(self, "_picture"):
            self._font, self._picture = self._sized_font(), None
            self.resize(self.sizeHint())
            self.place()

    def set_lines(self, *lines: str, first: str = "") -> None:
        """Show these lines, the first of them in the colour `first` if given."""
        if lines == self._lines:
            return
        self._lines = lines
        self._first = QColor(first) if first else self._first
        self._picture = None
        self.update()
        self.resize(self.sizeHint())
        self.place()

    @property
    def text(self) -> str:
        """What is shown."""
        return "\n".join(self._lines)

    def sizeHint(self) -> QSize:
        """Return the room that the lines take."""
        metrics = QFontMetrics(self._font)
        width = max((metrics.horizontalAdvance(line) for line in self._lines), default=0)
        return QSize(width + 4, metrics.height() * len(self._lines) + 2)

    def place(self) -> None:
        """Stand at one's corner or edge of the parent."""
        outer = self._outer.rect().adjusted(PADDING, PADDING, -PADDING, -PADDING)
        size = self.size()
        x, y = outer.center().x() - size.width() // 2, outer.center().y() - size.height() // 2
        if self._alignment & Qt.AlignmentFlag.AlignLeft:
            x = outer.left()
        elif self._alignment & Qt.AlignmentFlag.AlignRight:
            x = outer.right() - size.width() + 1
        if self._alignment & Qt.AlignmentFlag.AlignTop:
            y = outer.top()
        elif self._alignment & Qt.AlignmentFlag.AlignBottom:
            y = outer.bottom() - size.height() + 1
        self.move(x, y)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Copy the text, drawn once: it is repainted with every slice that scrolls below it."""
        if self._picture is None or self._picture.devicePixelRatio() != self.devicePixelRatioF():
            self._picture = self._drawn()
        with QPainter(self) as painter:
            painter.drawPixmap(0, 0, self._picture)

    def _drawn(self) -> QPixmap:
        """Every line several times: a dark rim, then the text."""
        ratio = self.devicePixelRatioF()
        picture = QPixmap(self.size() * ratio)
        picture.setDevicePixelRatio(ratio)
        picture.fill(Qt.GlobalColor.transparent)
        with QPainter(picture) as painter:
            self._draw(painter)
        return picture

    def _draw(self, painter: QPainter) -> None:
        painter.setFont(self._font)
        height = QFontMetrics(self._font).height()
        flags = self._alignment & Qt.AlignmentFlag.AlignHorizontal_Mask
        for number, line in enumerate(self._lines):
            box = QRect(1, 1 + number * height, self.width() - 2, height)
            painter.setPen(QColor(0, 0, 0, 220))
            for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
                painter.drawText(box.translated(dx, dy), flags, line)
            first = self._first if number == 0 and self._first is not None else self._colour
            painter.setPen(first)
            painter.drawText(box, flags, line)


class Ruler(QWidget):
    """A scale bar of a round length, with its length written above."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_TransparentForMouseEvents)
        self._scale, self._length = 1.0, 0.0
        self.resize(int(RULER_PX) + 8, 26)

    def set_scale(self, scale: float) -> None:
        """Fit the ruler to this zoom [px/mm]."""
        if scale != self._scale:
            self._scale, self._length = scale, ruler(scale, RULER_PX)
            self.update()

    @property
    def text(self) -> str:
        """Length of the ruler."""
        if self._length >= 10.0:
            return tr("{length:g} cm", length=self._length / 10.0)
        return tr("{length:g} mm", length=self._length)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the bar between two ticks, light on dark."""
        painter = QPainter(self)
        right, base = self.width() - 3.0, self.height() - 4.0
        left = right - self._length * self._scale
        for colour, width in (("#000000", 4.0), (theme.IMAGE_TEXT, 1.5)):
            painter.setPen(QPen(QColor(colour), width))
            painter.drawLine(QPointF(left, base), QPointF(right, base))
            for x in (left, right):
                painter.drawLine(QPointF(x, base - 5), QPointF(x, base))
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        box = self.rect().adjusted(0, 0, -4, -8)
        flags = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignTop
        painter.setPen(QColor("#000000"))
        painter.drawText(box.translated(1, 1), flags, self.text)
        painter.setPen(QColor(theme.IMAGE_TEXT))
        painter.drawText(box, flags, self.text)
