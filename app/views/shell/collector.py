"""Python's garbage collection, at moments when nobody waits for the window.

A full collection walks every object that Python knows. Compiled kernels leave hundreds of thousands
of them, and the walk then holds the interpreter for most of a second, on whichever thread happens
to allocate: long enough to miss the window's sign of life to the robot. Here the young objects are
collected on the window's thread, what stands for good is left out of the walk, and full collections
wait until no attempt runs. What was left out is looked at again when a patient has gone: a
reference cycle that was made before would hold his CT for good. Qt objects that Python lost in a
cycle also die on Qt's own thread so: Python does not get it back from a window that closes, as
threads that still stop would do it.
"""

from __future__ import annotations

import ctypes
import gc
import sys
from collections.abc import Callable
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QObject, QTimer

if TYPE_CHECKING:
    from app.views.shell.window import MainWindow

PERIOD_MS: Final = 2000
"""Young objects are collected this often: seldom enough that most have died without help."""

FULL_EVERY: Final = 15
"""One in so many collections is a full one."""

TRIMS: Final = 10
"""So many collections after something big was loaded also give freed memory back to the system."""

_YOUNG, _ALL = 1, 2


class Collector(QObject):
    """Takes over the collection from Python's own count of allocations, for good."""

    def __init__(self, busy: Callable[[], bool], parent: QObject | None = None) -> None:
        """Collect for a window.

        Args:
            busy: whether a full collection has to wait: an attempt runs, or something is loading.
            parent: Qt's owner.
        """
        super().__init__(parent)
        self._busy = busy
        self._since_full, self._settled, self._left = 0, False, False
        self._trims = 0
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self.collect)

    def open(self) -> None:
        """Take over; what stands already, such as imported modules, is not walked again."""
        gc.disable()
        gc.freeze()
        self._timer.start()

    def settle(self) -> None:
        """Leave all that stands now out of future collections: after something big was built."""
        gc.collect(_YOUNG)
        gc.freeze()
        self._settled = True
        self.trim()

    def trim(self) -> None:
        """Give back for a while what loading something big leaves behind."""
        self._trims = TRIMS

    @property
    def waits(self) -> bool:
        """Return whether a patient has gone and not all that was his is given back yet."""
        return self._left or self._trims > 0

    def leave(self) -> None:
        """Look at everything once nobody is kept waiting: a patient goes, with hundreds of MB."""
        self._left = True

    def collect(self) -> None:
        """Collect what is young, and now and then everything, if nobody is kept waiting.

        Before anything has settled, everything is new and a full walk is as long as it can be.
        """
        if self._trims and not self._busy():
            self._trims -= 1
            give_back()
        if self._left and not self._busy():
            self._left, self._since_full = False, 0
            gc.unfreeze()
            gc.collect(_ALL)
            gc.freeze()
            self.trim()
            return
        self._since_full += 1
        if self._settled and self._since_full >= FULL_EVERY and not self._busy():
            self._since_full = 0
            gc.collect(_ALL)
            give_back()
        else:
            gc.collect(_YOUNG)

    def close(self) -> None:
        """Collect no more: the window goes, and another one or the program's end follows."""
        self._timer.stop()


def give_back() -> None:
    """Give freed memory back to the system, where the C library keeps it for itself: on Linux."""
    if not sys.platform.startswith("linux"):
        return
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)  # not in every C library
    if trim is not None:
        trim(ctypes.c_size_t(0))


def collect_for(window: MainWindow) -> Collector:
    """Return an open collector for a window; it settles whenever a robot was started."""
    collector = Collector(lambda: window.editor.locked or window.progress.count > 0, window)
    window.runs.ready.connect(lambda _: collector.settle())
    window.conductor.patient_left.connect(collector.leave)
    window.conductor.patient_changed.connect(collector.trim)
    collector.open()
    return collector
