"""What is read, not followed: done at once, but no more often than an eye takes it in."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic

from PySide6.QtCore import QObject, QTimer

READING_MS = 100
"""Numbers and names that change more often than this are not read."""


class Unhurried(QObject):
    """Does something no more often than every `READING_MS`; what was asked last is always done.

    While it is asked again and again it is done within one of the asks: together with what else
    is drawn then, not between.
    """

    def __init__(self, action: Callable[[], None], parent: QObject) -> None:
        super().__init__(parent)
        self._action, self._done_at = action, -1.0
        self._timer = QTimer(self, interval=READING_MS, singleShot=True)
        self._timer.timeout.connect(self.do)

    @property
    def is_waiting(self) -> bool:
        """Whether it is still to be done."""
        return self._timer.isActive()

    def ask(self) -> None:
        """Do it now, or as soon as the last time is long enough ago."""
        if 1e3 * (monotonic() - self._done_at) >= READING_MS:
            self.do()
        else:
            self._timer.start()

    def do(self) -> None:
        """Do it now."""
        self._timer.stop()
        self._done_at = monotonic()
        self._action()
