"""The attempt's states for people: their names, and a row of steps: done, present, to come."""

from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPaintEvent, QPen
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.session.machine import State
from app.views.kit import theme
from app.views.kit.text import tr


def state_word(state: str) -> str:
    """Name of a recorded state; unknown ones as they stand."""
    return {
        "ready": tr("Ready"),
        "withdrawing": tr("Withdrawing"),
        "aligning": tr("Aligning"),
        "inserting": tr("Inserting"),
        "holding": tr("Holding"),
        "paused": tr("Paused"),
        "ended": tr("Ended"),
        "aborted": tr("Aborted"),
        "unfinished": tr("Unfinished"),
        "broken": tr("Broken"),
    }.get(state, state)


ORDER: Final[tuple[State, ...]] = (
    State.READY,
    State.ALIGNING,
    State.INSERTING,
    State.HOLDING,
    State.ENDED,
)


BRIEF: Final[tuple[State, ...]] = (State.READY, State.INSERTING, State.ENDED)
"""Where control scans guide: `inserting` stands for all that happens in between."""


class Steps(QWidget):
    """Filled discs with ✔ for what is done, a ring for now, hollow for what comes."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state: State | None = None
        self._order = ORDER
        self._reached = 0
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setMinimumSize(300, 48)
        self.setAccessibleName(tr("No attempt"))

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(330, 48)

    def set_brief(self, brief: bool) -> None:
        """Show the steps between beginning and end as one: they are read from the needle."""
        self._order = BRIEF if brief else ORDER
        self._reached = 0
        state, self._state = self._state, None
        self.show_state(state)
        self.update()

    def show_state(self, state: State | None) -> None:
        """Show a state; None before there is an attempt."""
        if state is self._state:
            return
        if state in self._order:
            self._reached = self._order.index(state)
        elif state is None or state is State.WITHDRAWING:
            self._reached = 0
        self._state = state
        brief = self._order is BRIEF and state is State.INSERTING
        word = tr("Under way") if brief else state_word(state) if state else tr("No attempt")
        self.setAccessibleName(word)
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the row."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        step = self.width() / len(self._order)
        painter.setPen(QPen(QColor(theme.BORDER), 2.0))
        painter.drawLine(QPointF(step / 2, 14), QPointF(self.width() - step / 2, 14))
        for i, state in enumerate(self._order):
            self._paint_step(painter, i, state, QRectF(i * step, 0, step, self.height()))

    def _paint_step(self, painter: QPainter, i: int, state: State, box: QRectF) -> None:
        aborted = self._state is State.ABORTED
        here = self._state is not None and i == self._reached
        done = self._state is not None and (i < self._reached or self._state is State.ENDED)
        paused = here and self._state is State.PAUSED
        colour = theme.BAD if here and aborted else theme.ACCENT if here or done else theme.BORDER
        colour = theme.WARNING if paused else colour
        sign = "✖" if here and aborted else "✔" if done else "●" if here else ""
        sign = "Ⅱ" if paused else sign
        centre = QPointF(box.center().x(), 14)
        painter.setPen(QPen(QColor(colour), 2.5))
        painter.setBrush(QColor(theme.BACKGROUND))
        painter.drawEllipse(centre, 10, 10)
        painter.setFont(_font(painter, 11, True))
        painter.setPen(QColor(colour))
        disc = QRectF(centre.x() - 10, 4, 20, 20)
        painter.drawText(disc, Qt.AlignmentFlag.AlignCenter, sign)
        painter.setFont(_font(painter, theme.SMALL_PX, here))
        painter.setPen(QColor(theme.TEXT if here else theme.TEXT_DIM))
        name = state_word(State.ABORTED) if here and aborted else state_word(state)
        if self._order is BRIEF and state is State.INSERTING:
            name = tr("Under way")
        name = tr("Paused") if paused else name
        if here and self._state is State.WITHDRAWING:
            name = tr("Pull out")  # what fits below a step
        top = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop
        painter.drawText(box.adjusted(0, 26, 0, 0), top, name)


def _font(painter: QPainter, pixels: int, bold: bool) -> QFont:
    font = QFont(painter.font())
    font.setPixelSize(pixels)
    font.setBold(bold)
    return font
