"""A running curve of two values, left and right, over the last seconds."""

from collections import deque
from math import isfinite
from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.views.kit import theme
from app.views.kit.text import tr

SPAN: Final = 10.0
"""Time that is shown [s]."""

_TITLE: Final = 20
_LOOKS: Final = ((theme.NEEDLE_TIP.colour, ()), (theme.NEEDLE.colour, (4.0, 2.0)))
_SMALLEST: Final = 1e-9


class Trace(QWidget):
    """The scale grows with the values and shrinks when they have left; dashes tell right apart."""

    def __init__(self, title: str, unit: str, smallest: float, parent: QWidget) -> None:
        """Name the curve; its scale is never finer than ±`smallest` [unit]."""
        super().__init__(parent)
        self._title, self._unit = title, unit
        self._smallest = max(smallest, _SMALLEST)
        self._points: deque[tuple[float, float, float]] = deque()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(240, 84)

    def add(self, time: float, left: float, right: float) -> None:
        """Add a moment [s]; values that are not finite leave a gap, going back in time clears."""
        if self._points and time < self._points[-1][0]:
            self._points.clear()
        self._points.append((time, left, right))
        while self._points[0][0] < time - SPAN:
            self._points.popleft()
        self.update()

    @property
    def scale(self) -> float:
        """Value at the upper edge."""
        sizes = [abs(v) for point in self._points for v in point[1:] if isfinite(v)]
        return max(self._smallest, *sizes) if sizes else self._smallest

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw frame, zero line, both curves and the words."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        box = QRectF(0, _TITLE, self.width() - 1, self.height() - _TITLE - 2)
        painter.fillRect(box, QColor("#0e1114"))
        painter.setPen(QPen(QColor(theme.IMAGE_LINE), 1.0))
        painter.drawRect(box)
        painter.drawLine(
            QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y())
        )
        scale = self.scale
        for side, (colour, dashes) in enumerate(_LOOKS):
            pen = QPen(QColor(colour), 1.5)
            if dashes:
                pen.setDashPattern(list(dashes))
            painter.setPen(pen)
            for line in self._lines(box, side, scale):
                painter.drawPolyline(line)
        title = QRectF(0, 0, self.width(), _TITLE)
        painter.setPen(QColor(theme.TEXT))
        painter.drawText(title, Qt.AlignmentFlag.AlignLeft, self._title)
        painter.setPen(QColor(theme.TEXT_DIM))
        words = tr("— left  - - right   ±{scale:.3g} {unit}", scale=scale, unit=self._unit)
        painter.drawText(title, Qt.AlignmentFlag.AlignRight, words)

    def _lines(self, box: QRectF, side: int, scale: float) -> list[QPolygonF]:
        """Unbroken stretches of one side's curve."""
        lines = [QPolygonF()]
        if not self._points:
            return lines
        newest = self._points[-1][0]
        for point in self._points:
            value = point[1 + side]
            if not isfinite(value):
                lines.append(QPolygonF())
                continue
            x = box.right() - (newest - point[0]) / SPAN * box.width()
            y = box.center().y() - 0.48 * box.height() * value / scale
            lines[-1].append(QPointF(x, y))
        return [line for line in lines if line.count() > 1]
