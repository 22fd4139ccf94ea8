"""How far an attempt is: its states in a row, for the side panel; what others draw them by."""

from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, QTimer
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen
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


def phase_word(state: str) -> str:
    """Name of a recorded state on the time axis of an attempt that is over.

    While it was `withdrawing` the needle went to its start and then waited for the hand: both are
    before the attempt.
    """
    return tr("Before the start") if state == State.WITHDRAWING else state_word(state)


ORDER: Final[tuple[State, ...]] = (
    State.READY,
    State.ALIGNING,
    State.INSERTING,
    State.HOLDING,
    State.ENDED,
)


TURN_MS: Final = 60
TURN: Final = 16
"""A ring goes round in so many pictures, so far apart."""

BRIEF: Final[tuple[State, ...]] = (State.READY, State.INSERTING, State.ENDED)
"""Where control scans guide: `inserting` stands for all that happens in between."""


class TurningRing:
    """A ring that goes round in a widget while the needle is on its way to its start."""

    def __init__(self, widget: QWidget) -> None:
        self._widget, self._turn = widget, 0
        self._timer = QTimer(widget, interval=TURN_MS)
        self._timer.timeout.connect(self.advance)

    @property
    def turns(self) -> bool:
        """Return whether it goes round; else it costs nothing."""
        return self._timer.isActive()

    def show_state(self, state: State | None, ready: bool) -> None:
        """Go round in the one state in which something is waited for."""
        if state is not State.WITHDRAWING or ready:
            self._timer.stop()
        elif not self.turns:
            self._timer.start()

    def advance(self) -> None:
        """Show the next picture."""
        self._turn = (self._turn + 1) % TURN
        self._widget.update()

    def draw(self, painter: QPainter, box: QRectF) -> None:
        """Draw a quarter of the ring in a square."""
        painter.setPen(QPen(QColor(theme.TEXT), 2.5))
        painter.drawArc(box, -16 * 360 * self._turn // TURN, 16 * 90)


class Stages(QWidget):
    """Knows how far an attempt is; whoever inherits it draws that.

    Attributes:
        ring: goes round while the needle is on its way to its start.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._state: State | None = None
        self._order, self._reached = ORDER, 0
        self._ready, self.ring = False, TurningRing(self)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(self.word)

    def set_brief(self, brief: bool) -> None:
        """Show the steps between beginning and end as one, or all; where it stands stays."""
        order = BRIEF if brief else ORDER
        if order is not self._order:
            self._order, self._reached = order, 0
            self._reach()

    def show_state(self, state: State | None, ready: bool = False) -> None:
        """Show a state; None before there is an attempt.

        `ready`: whether only the first movement of the hand is waited for.
        """
        if state is self._state and ready is self._ready:
            return
        self._state, self._ready = state, ready
        self.ring.show_state(state, ready)
        self._reach()

    def _reach(self) -> None:
        if self._state in self._order:
            self._reached = self._order.index(self._state)
        elif self._state is None or self._state is State.WITHDRAWING:
            self._reached = 0
        self.setAccessibleName(self.word)
        self.update()

    @property
    def word(self) -> str:
        """Return the name of the state."""
        if self._state is None:
            return tr("No attempt")
        if self._ready:
            return state_word(State.READY)
        return self.step_word(self._state)

    def step_word(self, state: State) -> str:
        """Return the name of a step."""
        if self._order is BRIEF and state is State.INSERTING:
            return tr("Under way")
        return state_word(state)


class Steps(Stages):
    """Filled discs with ✔ for what is done, a ring for now, hollow for what comes."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setMinimumSize(300, 48)

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(330, 48)

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
        if here and self.ring.turns:
            self.ring.draw(painter, QRectF(centre.x() - 10, 4, 20, 20))
            sign = ""
        painter.setFont(theme.font_of(11, True))
        painter.setPen(QColor(colour))
        disc = QRectF(centre.x() - 10, 4, 20, 20)
        painter.drawText(disc, Qt.AlignmentFlag.AlignCenter, sign)
        painter.setFont(theme.font_of(theme.SMALL_PX, here))
        painter.setPen(QColor(theme.TEXT if here else theme.TEXT_DIM))
        name = state_word(State.ABORTED) if here and aborted else self.step_word(state)
        name = tr("Paused") if paused else name
        if here and self._state is State.WITHDRAWING and not self._ready:
            name = tr("Pull out")  # what fits below a step
        top = Qt.AlignmentFlag.AlignHCenter | Qt.AlignmentFlag.AlignTop
        painter.drawText(box.adjusted(0, 26, 0, 0), top, name)
