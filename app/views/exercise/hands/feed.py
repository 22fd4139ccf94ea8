"""Pushing and pulling for as long as a key or a button is held, with a soft start.

A press moves by one step at once; held on, the needle goes after a moment with a speed that rises
from nothing. Whoever holds and lets go is followed to the letter: the speed is nothing again when
key or button is let go, when window or pad lose the keyboard, when a dialog opens, and when the
attempt pauses or ends. A key that is still down then moves nothing until it is pressed anew.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from time import monotonic
from typing import Final

from PySide6.QtCore import QEvent, QObject, Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QApplication, QPushButton, QSizePolicy, QWidget

from app.views.kit.parts import text_room
from app.views.kit.text import tr

DEPTH_STEP: Final = 0.001
FINE_DEPTH_STEP: Final = 0.0002
"""Of a notch of the wheel and of a short press [m]."""

HELD: Final = 0.25
"""What is down for longer is held [s]."""

SPEED: Final = 0.02
"""Fastest, along the needle [m/s]: an ordinary insertion. The simulated hand's own bound
(`mechanisms.hand_motion`) is five times that, and holds here as everywhere."""

FINE: Final = 0.2
"""Share of the speed with Shift, as of the step."""

SOFT: Final = 0.6
"""From rest to full speed [s]."""

LONGEST: Final = 0.05
"""A window that was busy makes up for no more than this [s]: nothing leaps."""

_PERIOD_MS: Final = 20


def feed_speed(held: float) -> float:
    """Speed [m/s] after something was held for so long [s], counted from its press."""
    return SPEED * min(1.0, max(0.0, held - HELD) / SOFT)


class Feed(QObject):
    """Moves along the needle while one holder holds.

    Signals:
        advanced(step): depth step [m], positive inwards.
    """

    advanced = Signal(float)

    def __init__(self, parent: QObject, clock: Callable[[], float] = monotonic) -> None:
        super().__init__(parent)
        self._clock = clock
        self._holder: Hashable = None
        self._sign, self._fine = 0.0, False
        self._pressed = self._last = 0.0
        self._timer = QTimer(self, interval=_PERIOD_MS)
        self._timer.timeout.connect(self.step)

    @property
    def is_held(self) -> bool:
        """Return whether somebody holds."""
        return self._holder is not None

    def set_clock(self, clock: Callable[[], float]) -> None:
        """Go by another time [s]: that of the needle, which a busy computer may slow."""
        self.let_go()
        self._clock = clock

    def press(self, holder: Hashable, inwards: bool, fine: bool) -> None:
        """Move by a step, and go on while `holder` holds; the last to press has it."""
        self._holder, self._sign, self._fine = holder, 1.0 if inwards else -1.0, fine
        self._pressed = self._last = self._clock()
        self._timer.start()
        self.advanced.emit(self._sign * (FINE_DEPTH_STEP if fine else DEPTH_STEP))

    def set_fine(self, fine: bool) -> None:
        """Go on finer, or no longer so."""
        self._fine = fine

    def release(self, holder: Hashable) -> None:
        """Stop, if it is this one who holds."""
        if holder == self._holder:
            self.let_go()

    def let_go(self) -> None:
        """Stop, whoever holds; idempotent."""
        self._holder = None
        self._timer.stop()

    def step(self) -> None:
        """Go on for the time since the last step."""
        if self._holder is None:
            return
        if QApplication.activeModalWidget() or QApplication.activePopupWidget():
            self.let_go()
            return
        now = self._clock()
        passed, self._last = min(max(now - self._last, 0.0), LONGEST), now
        speed = feed_speed(now - self._pressed) * (FINE if self._fine else 1.0)
        if speed > 0.0:
            self.advanced.emit(self._sign * speed * passed)


class FeedButton(QPushButton):
    """Pushes or pulls while the mouse holds it down."""

    def __init__(self, feed: Feed, inwards: bool, parent: QWidget) -> None:
        super().__init__(tr("▼ push") if inwards else tr("▲ pull"), parent)
        self._feed, self._inwards, self._brief = feed, inwards, False
        self.setAccessibleName(self.text())
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)  # the pad keeps its keys
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setToolTip(
            tr("Hold to push the needle in. So do: wheel away from you, Page Down, right button")
            if inwards
            else tr("Hold to pull the needle. So do: wheel towards you, Page Up, middle button")
        )
        self.pressed.connect(lambda: feed.press(self, inwards, _is_fine()))
        self.released.connect(lambda: feed.release(self))

    def set_brief(self, brief: bool) -> None:
        """Show the arrow alone, beside a narrow bar, or with its word where that has room."""
        self._brief = brief
        self._fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show the word or leave it out."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        words = self.accessibleName()
        fits = self.fontMetrics().horizontalAdvance(words) <= text_room(self)
        shown = words if fits and not self._brief else words.split()[0]
        if shown != self.text():
            self.setText(shown)

    def event(self, event: QEvent) -> bool:
        """Let go where no release of the mouse will come."""
        if event.type() in GONE:
            self._feed.release(self)
            self.setDown(False)
        return super().event(event)


GONE: Final = frozenset(
    {
        QEvent.Type.WindowDeactivate,
        QEvent.Type.WindowBlocked,
        QEvent.Type.Hide,
        QEvent.Type.EnabledChange,
    }
)
"""What takes a widget from whoever holds something in it."""


def _is_fine() -> bool:
    return bool(QApplication.keyboardModifiers() & Qt.KeyboardModifier.ShiftModifier)
