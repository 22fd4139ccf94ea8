"""What other threads share with the loop: named inputs, written as one change, and its history."""

import threading

import numpy as np
from numpy.typing import NDArray

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.device.control import kernel
from app.device.control.kernel import COUNTERS, HEAD
from app.device.errors import UnknownInputError

INPUT_NAMES: tuple[str, ...] = tuple(name for name, k in sv.INDEX.items() if k < sv.INPUTS)
"""Names of the inputs: the lower-case names of the first slots of the state."""


class Inbox:
    """Inputs of a loop. Any thread may write; the loop reads without ever waiting."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self.values: FloatArray = np.zeros(sv.INPUTS)
        self.sequence = np.zeros(1, dtype=np.int64)
        self._slots: dict[tuple[str, ...], NDArray[np.int64]] = {}

    def write(self, **values: float) -> None:
        """Set inputs by name, all seen by the same tick, e.g. `write(assistance=0.5, enabled=1)`.

        Raises:
            UnknownInputError: if a name is not an input; names those that are.
        """
        names = tuple(values)
        slots = self._slots.get(names)
        if slots is None:
            slots = self._slots[names] = _slots_of(names)
        numbers = np.array(list(values.values()), dtype=np.float64)
        with self._lock:
            kernel.post(self.values, self.sequence, slots, numbers)

    def read(self) -> dict[str, float]:
        """Return what was written last, by name."""
        with self._lock:
            return {name: float(self.values[sv.INDEX[name]]) for name in INPUT_NAMES}


def _slots_of(names: tuple[str, ...]) -> NDArray[np.int64]:
    for name in names:
        if name not in INPUT_NAMES:
            raise UnknownInputError(
                sentence(
                    "the loop has no input {name!r}; valid names: {input_names}",
                    name=name,
                    input_names=", ".join(INPUT_NAMES),
                )
            )
    return np.array([sv.INDEX[name] for name in names], dtype=np.int64)


class TickHistory:
    """Ring of the last ticks. The loop writes it without waiting for readers.

    Row of tick n (from 1) is number n - 1; a reader copies and then checks that the loop has not
    come round and overwritten what it copied.
    """

    def __init__(self, capacity: int = 16_384) -> None:
        self.ring: FloatArray = np.zeros((capacity, sv.SLOTS))
        self.counters = np.zeros(COUNTERS, dtype=np.int64)

    @property
    def head(self) -> int:
        """Number of the newest tick; 0 before the first."""
        return int(self.counters[HEAD])

    def rows(self, since_tick: int = 0) -> FloatArray:
        """Copy the ticks after `since_tick` that are still there, oldest first, (n, SLOTS).

        A reader that comes too late sees a first tick later than `since_tick` + 1.
        """
        capacity = len(self.ring)
        head = self.head
        first = max(since_tick, head - capacity + 1, 0)
        begin, end = first % capacity, head % capacity
        copy = (
            self.ring[begin:end].copy()
            if begin < end
            else self.ring[np.arange(first, head) % capacity]
        )
        overwritten = self.head - capacity + 1 - first
        return copy[max(overwritten, 0) :]

    def last(self) -> FloatArray:
        """Copy the newest tick, shape (SLOTS,); zeros before the first."""
        while True:
            head = self.head
            if head == 0:
                return np.zeros(sv.SLOTS)
            row: FloatArray = self.ring[(head - 1) % len(self.ring)].copy()
            if self.head - head < len(self.ring) - 1:
                return row

    def column(self, slot: int, count: int) -> FloatArray:
        """Copy one slot of up to `count` newest ticks, oldest first, shape (n,)."""
        head = self.head
        first = max(head - min(count, len(self.ring) - 1), 0)
        return np.array(self.ring[np.arange(first, head) % len(self.ring), slot])
