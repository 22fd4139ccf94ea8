"""Latest value with its time: how streams cross threads. Nobody waits, nothing queues up."""

import threading
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Stamped(Generic[T]):
    """A value and the monotonic time [s] at which it was true."""

    value: T
    time: float

    def age(self, now: float) -> float:
        """Seconds since the value was true."""
        return now - self.time


class Latest(Generic[T]):
    """Holds the newest of a stream of immutable values; one writer, any number of readers."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._stamped: Stamped[T] | None = None

    def publish(self, value: T, time: float) -> None:
        """Replace the value; `time` [s] is when it was captured, not when it arrived."""
        with self._lock:
            self._stamped = Stamped(value, time)

    def read(self) -> Stamped[T] | None:
        """Return the newest value with its time, or None before the first."""
        with self._lock:
            return self._stamped
