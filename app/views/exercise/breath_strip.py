"""The breath of the patient: its curve, the band in which the target is where the plan has it, now.

The curve is how far what breathes has gone from where it was in the CT, as a belt round the body
would tell: nothing of the needle. Within the band the target is off its place by less than the
inner ring.
"""

from __future__ import annotations

from collections import deque
from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core.units import MILLIMETRE
from app.session.snapshot import Snapshot, excursion
from app.views.kit import theme
from app.views.kit.text import literal, tr

SPAN_S: Final = 12.0
"""So much of the past is seen [s]: about three breaths."""

_NOW: Final = 0.86
"""Share of the width at which now is."""

_HEIGHT: Final = 72
"""Of the curve [px]; its words stand below."""


class BreathStrip(QWidget):
    """Draws the last seconds; hidden where the patient does not breathe.

    Attributes:
        gate: half width of the band [m].
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.gate = 0.0
        self._curve: deque[tuple[float, float]] = deque()
        self._deepest = 0.0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Breath"))
        self.setToolTip(
            literal(
                tr(
                    "How far the breath has moved the target from where the CT has it. In the band "
                    "it is within the inner ring: push there, wait elsewhere."
                )
            )
        )
        self.hide()

    def sizeHint(self) -> QSize:
        """Preferred size: the curve, and a line of words below it."""
        return QSize(200, _HEIGHT + self._line())

    def minimumSizeHint(self) -> QSize:
        """Return the height that curve and words need."""
        return QSize(120, _HEIGHT + self._line())

    def begin(self, gate: float, breathes: bool) -> None:
        """Begin another curve.

        Args:
            gate: half width of the band [m].
            breathes: whether the patient does. The strip is there from the beginning or never:
                what stands below it does not move in an attempt.
        """
        self.gate, self._deepest = gate, 0.0
        self._curve.clear()
        self.setVisible(breathes)

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Take one more moment; equal times count once."""
        moved = excursion(snapshot)
        if moved is None or (self._curve and snapshot.time <= self._curve[-1][0]):
            return
        self._curve.append((snapshot.time, moved))
        while snapshot.time - self._curve[0][0] > SPAN_S:
            self._curve.popleft()
        self._deepest = max(self._deepest, moved)
        self.setAccessibleName(self.words)
        self.update()

    @property
    def in_gate(self) -> bool:
        """Return whether the target is within the band now."""
        return bool(self._curve) and self._curve[-1][1] <= self.gate

    @property
    def words(self) -> str:
        """Say where the target is: in words, for whoever sees no colour."""
        if not self._curve:
            return tr("Breath")
        away = self._curve[-1][1] / MILLIMETRE
        if self.in_gate:
            return tr("✔ at rest: push")
        return tr("▲ {mm:.1f} mm away: wait", mm=away)

    @property
    def points(self) -> QPolygonF:
        """Return the curve in the widget [px]: the newest at now, the deepest breath at the top."""
        if not self._curve:
            return QPolygonF()
        now = self._curve[-1][0]
        right = _NOW * self.width()
        return QPolygonF(
            [
                QPointF(right * (1.0 - (now - time) / SPAN_S), self.level(moved))
                for time, moved in self._curve
            ]
        )

    def level(self, moved: float) -> float:
        """Return the height of an excursion [m] in the widget [px]: up is away from rest."""
        full = max(1.15 * self._deepest, 3.0 * self.gate, MILLIMETRE)
        room = _HEIGHT - 2 * theme.SPACING
        return _HEIGHT - theme.SPACING - room * min(1.0, moved / full)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw band, curve, now, and the words below."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        box = QRectF(0.5, 0.5, self.width() - 1.0, _HEIGHT - 1.0)
        painter.setPen(QPen(QColor(theme.IMAGE_LINE), 1.0))
        painter.setBrush(QColor(theme.IMAGE_GROUND))
        painter.drawRect(box)
        painter.setPen(Qt.PenStyle.NoPen)
        band = QColor(theme.on_image(theme.GOOD))
        band.setAlphaF(0.28)
        painter.setBrush(band)
        top = self.level(self.gate)
        painter.drawRect(QRectF(1.0, top, self.width() - 2.0, _HEIGHT - 1.0 - top))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.setPen(QPen(QColor(theme.IMAGE_TEXT), 2.0))
        points = self.points
        painter.drawPolyline(points)
        if points.size():
            self._paint_now(painter, points.last())
        self._paint_words(painter)

    def _paint_now(self, painter: QPainter, at: QPointF) -> None:
        painter.setPen(QPen(QColor(theme.IMAGE_DIM), 1.0))
        painter.drawLine(QPointF(at.x(), 1.0), QPointF(at.x(), _HEIGHT - 1.0))
        colour = QColor(theme.on_image(theme.GOOD if self.in_gate else theme.WARNING))
        painter.setPen(QPen(colour, 2.0))
        painter.setBrush(colour if self.in_gate else QColor(theme.IMAGE_GROUND))
        painter.drawEllipse(at, 5.0, 5.0)

    def _paint_words(self, painter: QPainter) -> None:
        font = QFont(self.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        painter.setPen(QColor(theme.GOOD if self.in_gate else theme.WARNING))
        below = QRectF(0.0, _HEIGHT, self.width(), self._line())
        words = painter.fontMetrics().elidedText(
            self.words, Qt.TextElideMode.ElideRight, self.width()
        )
        painter.drawText(below, Qt.AlignmentFlag.AlignVCenter, words)

    @staticmethod
    def _line() -> int:
        return theme.SMALL_PX + theme.SPACING
