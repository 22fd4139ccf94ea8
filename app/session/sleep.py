"""Notices that the whole program stood still: the computer slept, or somebody stopped the process.

Not the same as a window that is busy or an interpreter that is held: then the compiled loop goes
on.
"""

import time
from collections.abc import Callable
from typing import Final

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


class Sleep:
    """Looks at two clocks and at the loop each time that the trainer does.

    Args:
        asleep: time for which the computer has slept so far [s], which a monotonic clock does not
            count.
    """

    def __init__(self, asleep: Callable[[], float] = suspended) -> None:
        self._asleep = asleep
        self._now: float | None = None
        self._tick = 0
        self._slept = 0.0

    def look(self, now: float, tick: int) -> float:
        """Return for how long everything stood still before this look [s]; 0 if it did not.

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


def words(seconds: float) -> str:
    """Say why the attempt ends."""
    return (
        f"the computer or the program slept for {seconds:.1f} s: what the needle did meanwhile is "
        "not known"
    )
