"""Monotonic time, injected wherever it is needed, so that tests and sweeps can run on their own."""

import time
from dataclasses import dataclass
from typing import Protocol


class Clock(Protocol):
    """Source of monotonic time [s]. Wall-clock time appears in file headers only."""

    def now(self) -> float:
        """Return the time [s] since an arbitrary origin."""
        ...

    def sleep(self, duration: float) -> None:
        """Let `duration` [s] pass."""
        ...

    def sleep_until(self, moment: float) -> None:
        """Let time pass up to a moment [s]; what is over already is not waited for."""
        ...


class SystemClock:
    """The machine's monotonic clock: the same one that the compiled loop reads."""

    def now(self) -> float:
        """Return CLOCK_MONOTONIC [s]."""
        return time.monotonic()

    def sleep(self, duration: float) -> None:
        """Sleep [s]."""
        time.sleep(max(0.0, duration))

    def sleep_until(self, moment: float) -> None:
        """Sleep up to a moment [s]."""
        self.sleep(moment - self.now())


@dataclass
class VirtualClock:
    """A clock that moves only when told to: for tests and for runs faster than real time."""

    time: float = 0.0

    def now(self) -> float:
        """Return the current virtual time [s]."""
        return self.time

    def sleep(self, duration: float) -> None:
        """Advance virtual time [s]."""
        self.time += max(0.0, duration)

    def sleep_until(self, moment: float) -> None:
        """Advance virtual time up to a moment [s]."""
        self.time = max(self.time, moment)
