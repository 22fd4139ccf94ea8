"""What the process of a trial says that it does, and how long that may take: see `core.trial`."""

import mmap
import signal
import struct
import time
from typing import Any, Final

EACH: Final = 1.0
"""Processor time that one call of a stage may take in the trial [s]."""

CALL: Final = 5.0
"""Processor time that one call of anything else may take [s]. What is compiled meanwhile does not
count."""

SECONDS: Final = 10.0
"""Processor time that all calls may take together [s]."""

PATIENCE: Final = 60.0
CLOCK: Final = 300.0
"""Longest that a call, and a trial with all that it compiles, may take on the clock [s]."""

PAGE: Final = 512
HEAD: Final = "<qd"
"""Bytes in which the process says what it does: the number of a state (-1: none) and the processor
time that it may take [s], then a text."""

_TEXT: Final = struct.calcsize(HEAD)


class Watch:
    """Says what is being tried, and ends the process if that does not return.

    What numba compiles meanwhile is not counted.

    Attributes:
        seconds: processor time of all calls that were counted [s].
    """

    def __init__(self, page: Any) -> None:
        self.seconds = 0.0
        self._page = page
        self._began = self._paused = self._allowed = 0.0
        self._compiling = 0

    def doing(self, activity: str, seconds: float = EACH) -> None:
        """Say what is called from now on, and how much processor time it may take [s]."""
        text = activity.encode()[: PAGE - _TEXT - 1]
        self._page[_TEXT : _TEXT + len(text) + 1] = text + b"\0"
        self._mark(-1, seconds)
        _wind(seconds, PATIENCE)

    def state(self, number: int) -> None:
        """Say the number of the state in which it is called now."""
        self._mark(number, EACH)
        _wind(EACH)

    def begin(self) -> None:
        """Begin to count the processor time of many calls."""
        self._began = time.process_time()
        _wind(EACH, CLOCK)

    def late(self) -> bool:
        """Return whether those calls have taken too long together."""
        return time.process_time() - self._began > SECONDS

    def rest(self) -> None:
        """End the count of many calls; what follows may take its time."""
        self.seconds += time.process_time() - self._began
        _wind(0.0, 0.0)

    def compiling(self, more: int) -> None:
        """Let the time rest while something is compiled: +1 as it begins, -1 as it ends."""
        self._compiling += more
        if more > 0 and self._compiling == 1:
            self._paused = time.process_time()
            _wind(0.0, 0.0)
        elif self._compiling == 0:
            self._began += time.process_time() - self._paused
            _wind(self._allowed, PATIENCE)

    def _mark(self, number: int, seconds: float) -> None:
        self._allowed = seconds
        struct.pack_into(HEAD, self._page, 0, number, seconds)


def _wind(seconds: float, clock: float | None = None) -> None:
    """Let the process end after so much processor time, and time on the clock [s]; 0: never."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_PROF, seconds)
        if clock is not None:
            signal.setitimer(signal.ITIMER_REAL, clock)


def doing_in(page: mmap.mmap) -> str:
    """Read what a process says that it does."""
    text = page[_TEXT:].split(b"\0", 1)[0]
    return text.decode("utf-8", "replace") or "its import"
