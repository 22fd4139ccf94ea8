"""A patch of the screen that turns bright and dark at random times, and says when."""

from __future__ import annotations

import time
from collections.abc import Sequence

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QColor, QPainter, QPaintEvent
from PySide6.QtWidgets import QWidget

_DARK, _BRIGHT = QColor(0, 0, 0), QColor(255, 255, 255)
_LEAD = 0.3
"""Time [s] for which the patch is dark before it begins."""


class BlinkPatch(QWidget):
    """Blinks once through a list of times.

    Signals:
        progressed(float): share of the changes that were shown, 0 to 1.
        finished(): all were shown.
    """

    progressed = Signal(float)
    finished = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.shown: list[float] = []
        self._times: Sequence[float] = ()
        self._start = 0.0
        self._bright = False
        self._timer = QTimer(self, singleShot=True)
        self._timer.setTimerType(Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self._change)
        self.setMinimumSize(260, 260)

    def begin(self, times: Sequence[float]) -> None:
        """Blink at these times [s] from now on; `shown` gets the times [s] of the changes."""
        self._times, self._start = times, time.monotonic() + _LEAD
        self.shown, self._bright = [], False
        self.update()
        self._wait()

    def stop(self) -> None:
        """Stay dark."""
        self._timer.stop()
        self._bright = False
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Fill the patch."""
        QPainter(self).fillRect(self.rect(), _BRIGHT if self._bright else _DARK)

    def _wait(self) -> None:
        due = self._start + self._times[len(self.shown)] - time.monotonic()
        self._timer.start(max(0, round(1e3 * due)))

    def _change(self) -> None:
        self._bright = not self._bright
        self.repaint()  # at once; what follows is the screen's own delay
        self.shown.append(time.monotonic())
        self.progressed.emit(len(self.shown) / len(self._times))
        if len(self.shown) < len(self._times):
            self._wait()
        else:
            self.finished.emit()
