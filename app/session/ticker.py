"""The thread that calls the trainer at a steady rate, and what notices that it stood still."""

import threading
import time
from collections.abc import Callable
from typing import Final

from app.core.clock import Clock
from app.core.messages import sentence
from app.core.paced_clock import PacedClock

LONGEST_S: Final = 2.0
"""From here on [s] an attempt cannot go on: nobody knows what the needle did meanwhile."""

_SLOW_HZ: Final = 50.0
"""A loop that ticked less often than this while nobody looked stood still as well."""


def suspended() -> float:
    """Time [s] for which the computer has slept since it was started; 0 where nobody counts it."""
    boot = getattr(time, "CLOCK_BOOTTIME", None)
    if boot is None:
        return 0.0
    return time.clock_gettime(boot) - time.clock_gettime(time.CLOCK_MONOTONIC)


class Standstill:
    """Notices that the computer slept, or that somebody stopped the process.

    Not the same as a window that is busy or an interpreter that is held: then the compiled loop
    goes on. Each tick of the trainer reads two clocks and the number of the loop's newest tick.

    Args:
        asleep: time for which the computer has slept so far [s], which a monotonic clock does not
            count.
    """

    def __init__(self, asleep: Callable[[], float] = suspended) -> None:
        self._asleep = asleep
        self._now: float | None = None
        self._tick = 0
        self._slept = 0.0

    def forget(self) -> None:
        """Begin anew: nothing was to tick until now."""
        self._now = None

    def before(self, now: float, tick: int) -> float:
        """Return for how long everything stood still before this tick [s]; 0 if it did not.

        Args:
            now: monotonic time [s].
            tick: number of the loop's newest tick.
        """
        before, ticks, slept = self._now, tick - self._tick, self._slept
        self._now, self._tick, self._slept = now, tick, self._asleep()
        if before is None:
            return 0.0
        gap = now - before
        stopped = gap if gap >= LONGEST_S and ticks < _SLOW_HZ * gap else 0.0
        away = self._slept - slept
        return max(stopped, away if away >= LONGEST_S else 0.0)


SLOWED: Final = "slowed"
"""Kind of the event that tells by how much virtual time was slower than the wall's: `seconds`."""

SLOWED_S: Final = 1.0
"""Less than this is not told of [s]."""


def slowed_words(seconds: float) -> str:
    """Say that the computer was slow, and that nothing was judged by it."""
    return sentence(
        "this computer was too slow by {seconds:.0f} s: robot, cameras and hand were slowed with "
        "it, and the score is what it would have been",
        seconds=seconds,
    )


def standstill_words(seconds: float) -> str:
    """Say why the attempt ends."""
    return sentence(
        "the computer or the program slept for {seconds:.1f} s: what the needle did "
        "meanwhile is not known; close other programs, keep the computer awake, and begin again",
        seconds=seconds,
    )


NEAREST: Final = 0.75
"""Share of a period from one look to the next at least, also after a late one."""


class Ticker:
    """Calls `tick` every `period` [s] until closed; a late call is not caught up.

    The next one after it comes no sooner than `NEAREST` periods: of two samples that are nearer the
    record keeps one (`samples.SAMPLE_PERIOD`), and who listens live would have heard the other.

    The time of a `PacedClock` does not go on past a call that is still to be made.

    If `tick` raises, the thread ends after it has told `on_error`, and `failed` is True.
    """

    def __init__(
        self,
        tick: Callable[[], object],
        period: float,
        on_error: Callable[[Exception], None],
        clock: Clock | None = None,
    ) -> None:
        self._paced = clock if isinstance(clock, PacedClock) else None
        self._tick = tick
        self._period = period
        self._on_error = on_error
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self.failed = False

    def open(self) -> None:
        """Start the thread; idempotent."""
        if self._thread is None:
            self._stop.clear()
            self._thread = threading.Thread(target=self._run, name="acus-ticker", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Stop and wait for the last call; idempotent; may be called from the tick itself."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            thread.join()

    def _run(self) -> None:
        if self._paced is not None:
            self._run_paced(self._paced)
            return
        deadline = time.monotonic()
        while not self._stop.is_set():
            soonest = time.monotonic() + NEAREST * self._period
            self._look()
            deadline = max(deadline + self._period, soonest, time.monotonic())
            self._stop.wait(deadline - time.monotonic())

    def _run_paced(self, clock: PacedClock) -> None:
        hold = clock.hold("trainer")
        try:
            while not self._stop.is_set():
                self._look()
                due = clock.now() + self._period
                hold.until(due)
                while not self._stop.is_set() and clock.now() < due - 1e-9:
                    clock.sleep_until(due)
        finally:
            hold.release()

    def _look(self) -> None:
        try:
            self._tick()
        except Exception as error:
            self.failed = True
            self._on_error(error)
            raise
