"""A student's curve in an exercise: points over the attempts."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QPointF, QRectF, Qt, Signal
from PySide6.QtGui import QColor, QMouseEvent, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QDialog, QHBoxLayout, QVBoxLayout, QWidget

from app.scoring.competence import Competence
from app.session.board import CurvePoint, ProgressBoard
from app.views.kit import theme
from app.views.kit.parts import button, label
from app.views.kit.text import date_text, literal, tr
from app.views.people.competence_marks import (
    competence_line,
    draw_changes,
    draw_pass_mark,
    rule_words,
)


class CurvePlot(QWidget):
    """Points over the attempts, 0 to 100, with personal best, moving median and pass mark.

    Signals:
        chosen(str): id of the attempt whose point was clicked.
    """

    chosen = Signal(str)

    def __init__(
        self,
        points: Sequence[CurvePoint],
        parent: QWidget | None = None,
        standing: Competence | None = None,
        mark: float | None = None,
    ) -> None:
        super().__init__(parent)
        self._points, self._standing, self._mark = points, standing, mark
        self.setMinimumSize(480, 260)
        self.setMouseTracking(True)

    def place(self, number: int, total: float) -> QPointF:
        """Return where a number of points of the attempt of that number (from 1) is drawn."""
        room = QRectF(self.rect()).adjusted(4 * theme.SPACING, theme.SPACING, -theme.SPACING, 0)
        room.setBottom(room.bottom() - 3 * theme.SPACING)
        x = room.left() + room.width() * (number - 0.5) / max(2, len(self._points))
        return QPointF(x, room.bottom() - room.height() * total / 100.0)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw grid, the two lines and the attempts."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        most, at = max(2, len(self._points)), self.place
        painter.setPen(QColor(theme.now(theme.TEXT_DIM)))
        left, right = 4.0 * theme.SPACING, self.width() - float(theme.SPACING)
        for level in (0, 25, 50, 75, 100):
            y = at(1, level).y()
            painter.drawText(QPointF(0.0, y + 4.0), str(level))
            painter.setOpacity(0.25)
            painter.drawLine(QPointF(left, y), QPointF(right, y))
            painter.setOpacity(1.0)
        step = max(1, most // 12)
        for number in range(1, len(self._points) + 1, step):
            painter.drawText(QPointF(at(number, 0).x() - 4.0, self.height() - 4.0), str(number))
        for colour, style, values in (
            (theme.GOOD, Qt.PenStyle.SolidLine, [p.best for p in self._points]),
            (theme.WARNING, Qt.PenStyle.DashLine, [p.median for p in self._points]),
        ):
            painter.setPen(QPen(QColor(theme.now(colour)), 2.0, style))
            painter.drawPolyline([at(number, total) for number, total in enumerate(values, 1)])
        colours = (theme.now(theme.GOOD), theme.now(theme.WARNING))
        draw_pass_mark(painter, self._mark, at, (left, right), theme.now(theme.TEXT_DIM))
        draw_changes(painter, self._standing, at, colours)
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(QColor(theme.now(theme.TEXT)))
        for number, point in enumerate(self._points, 1):
            painter.drawEllipse(at(number, point.total), 4.0, 4.0)
        painter.end()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Say which attempt is under the mouse."""
        point = self._under(event.position())
        told = "" if point is None else f"{point.total:.0f} · {date_text(point.started)}"
        self.setToolTip(literal(told))
        shape = Qt.CursorShape.ArrowCursor if point is None else Qt.CursorShape.PointingHandCursor
        self.setCursor(shape)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Choose the attempt that is under the mouse."""
        point = self._under(event.position())
        if point is not None:
            self.chosen.emit(point.attempt)

    def _under(self, where: QPointF) -> CurvePoint | None:
        """Return the attempt within reach of a place."""
        for number, point in enumerate(self._points, 1):
            away = self.place(number, point.total) - where
            if away.manhattanLength() < 2.0 * theme.SPACING:
                return point
        return None


class CurveDialog(QDialog):
    """A student's curve in one exercise; a click on a point leads to its attempt.

    Signals:
        attempt_chosen(str): id of the attempt.

    Attributes:
        attempts: button that lists them all.
        competence: says how he stands.
    """

    attempt_chosen = Signal(str)

    def __init__(
        self, title: str, board: ProgressBoard, key: str, exercise: str, parent: QWidget
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.resize(720, 440)
        points, standing = board.curve(key, exercise), board.competence(key, exercise)
        self.plot = CurvePlot(points, self, standing, board.pass_mark(exercise))
        self.attempts = button(tr("Attempts…"))
        self.competence = label(competence_line(board, key, exercise))
        self.competence.setToolTip(literal(rule_words(board)))
        words = tr(
            "{n} attempts that may be compared · ● points, click for the debrief · solid: personal "
            "best · dashed: median of the last five",
            n=len(points),
        )
        close = button(tr("Close"))
        close.clicked.connect(self.reject)
        row = QHBoxLayout()
        row.addWidget(label(words if points else tr("No attempt that counts yet."), "dim"), 1)
        row.addWidget(self.attempts)
        row.addWidget(close)
        column = QVBoxLayout(self)
        column.addWidget(self.plot, 1)
        column.addWidget(self.competence)
        column.addLayout(row)
        self.plot.chosen.connect(self._choose)

    def _choose(self, attempt: str) -> None:
        self.attempt_chosen.emit(attempt)
        self.accept()
