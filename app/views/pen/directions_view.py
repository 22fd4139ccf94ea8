"""Where a rocked pen has leant so far, seen from above, the webcam below."""

from __future__ import annotations

from math import cos, pi, radians, sin

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.tracking.pen.rocking import LEANT, SIDES, Lean
from app.views.kit import theme
from app.views.kit.text import tr

_RIM = sin(radians(40.0))
"""Sine of the lean at the disc's rim."""

_WORDS = 20.0
"""Room for the words round the disc [px]."""


class DirectionsView(QWidget):
    """A disc of sectors, one for each side; those that the pen has leant to are filled."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.covered: frozenset[int] = frozenset()
        self.now: Lean | None = None
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Fixed)
        self.setToolTip(tr(
            "Seen from above, the webcam at the bottom. A sector fills when the pen has leant "
            "that way; the dot is how it leans now"
        ))  # fmt: skip

    def sizeHint(self) -> QSize:
        """Large enough to be read from a table's other side."""
        return QSize(188, 176)

    def show_leans(self, covered: frozenset[int], now: Lean | None) -> None:
        """Show which sides are covered, and how the pen leans now."""
        if covered != self.covered or now != self.now:
            self.covered, self.now = covered, now
            self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint sectors, the ring from which a lean counts, and the dot."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        middle = QPointF(0.5 * self.width(), 0.5 * self.height())
        radius = 0.5 * self.height() - _WORDS
        self._paint_sectors(painter, middle, radius)
        painter.setPen(QColor(theme.TEXT_DIM))
        box = QRectF(0.0, 0.0, self.width(), _WORDS)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, tr("away"))
        box.moveBottom(self.height())
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, tr("webcam"))
        if self.now is not None:
            scale = radius / _RIM
            x, y = self.now.right * scale, -self.now.away * scale
            longest = max(1.0, (x * x + y * y) ** 0.5 / radius)
            painter.setPen(QPen(QColor("#000000"), 2.0))
            painter.setBrush(QColor(theme.WARNING))
            painter.drawEllipse(middle + QPointF(x, y) / longest, 6.0, 6.0)

    def _paint_sectors(self, painter: QPainter, middle: QPointF, radius: float) -> None:
        disc = QRectF(middle.x() - radius, middle.y() - radius, 2 * radius, 2 * radius)
        wide = 360.0 / len(SIDES)
        for side in range(len(SIDES)):
            filled = side in self.covered
            painter.setPen(QPen(QColor(theme.BORDER), 1.5))
            painter.setBrush(QColor(theme.GOOD if filled else theme.SURFACE))
            painter.drawPie(disc, round(16 * (side - 0.5) * wide), round(16 * wide))
            if filled:  # not by colour alone
                angle = 2.0 * pi * side / len(SIDES)
                place = middle + QPointF(cos(angle), -sin(angle)) * (0.72 * radius)
                painter.setPen(QColor(theme.present().on_accent))
                painter.drawText(
                    QRectF(place.x() - 9, place.y() - 9, 18, 18), Qt.AlignmentFlag.AlignCenter, "✔"
                )
        painter.setBrush(QColor(theme.BACKGROUND))
        painter.setPen(QPen(QColor(theme.BORDER), 1.5))
        inner = radius * sin(LEANT) / _RIM
        painter.drawEllipse(middle, inner, inner)
