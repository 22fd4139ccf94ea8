"""Recomputed states against a record: where they first differ, and where most."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.session.blocks import SLOT_NAMES
from app.session.digest import MEASURED, digests
from app.session.ticks import Inputs

_INDEX = {name: k for k, name in enumerate(SLOT_NAMES) if name}


@dataclass(frozen=True, slots=True)
class Difference:
    """One slot of one tick.

    Attributes:
        tick: first tick whose state differs.
        time: its monotonic time [s].
        slot: name of the slot; empty if the record holds too little to tell which.
        recorded: value in the record.
        recomputed: value now.
        seen_at: tick whose values these are: `tick`, or the next one that is recorded whole.
    """

    tick: int
    time: float
    slot: str
    recorded: float
    recomputed: float
    seen_at: int

    @property
    def size(self) -> float:
        """Magnitude of the difference; inf if one of the two is not a number."""
        size = abs(self.recorded - self.recomputed)
        return size if np.isfinite(size) else float("inf")


class Comparison:
    """Compares piece after piece; values are equal if all their bits are.

    Args:
        inputs: the recorded ticks.
        given: slots that a tick is given, which are not compared by value.

    Attributes:
        first: where they first differ; None if nowhere.
        largest: the largest difference relative to what the slot's values are; None if none.
        every_slot: whether every slot of every tick was compared (by its digest).
    """

    def __init__(self, inputs: Inputs, given: tuple[str, ...]) -> None:
        self.first: Difference | None = None
        self.largest: Difference | None = None
        self.every_slot = inputs.slots == SLOT_NAMES and len(inputs.digests) == len(inputs.values)
        self._inputs = inputs
        self._tick = inputs.column("tick")
        self._time = inputs.column("time")
        self._columns = [name for name in inputs.columns if name not in given and name in _INDEX]
        self._slots = [name for name in inputs.slots if name in _INDEX and name not in MEASURED]
        self._scales: dict[str, float] = {}
        self._share = 0.0
        self._open: tuple[int, float] | None = None

    def look(self, first_row: int, states: FloatArray) -> None:
        """Compare recomputed states, shape (n, SLOTS), with the rows from `first_row` on."""
        rows = np.arange(first_row, first_row + len(states))
        found = self._by_value(rows, states) + self._by_state(first_row, states)
        wrong = [d.tick for d in found]
        if self.every_slot:
            bad = np.flatnonzero(digests(states) != self._inputs.digests[rows])
            wrong += [int(self._tick[rows[k]]) for k in bad[:1]]
        for difference in found:
            self._measure(difference)
        if self.first is None and wrong:
            tick = min(wrong)
            time = float(self._time[np.searchsorted(self._tick[: rows[-1] + 1], tick)])
            self.first = Difference(tick, time, "", float("nan"), float("nan"), tick)
        if self.first is not None and not self.first.slot and found:
            seen = min(found, key=lambda d: d.tick)
            self.first = Difference(
                self.first.tick,
                self.first.time,
                seen.slot,
                seen.recorded,
                seen.recomputed,
                seen.tick,
            )

    def _by_value(self, rows: np.ndarray, states: FloatArray) -> list[Difference]:
        """Per column: the first difference and the largest."""
        found = []
        for name in self._columns:
            recorded = self._inputs.column(name)[rows]
            found += self._of(name, rows, recorded, states[:, _INDEX[name]])
        return found

    def _by_state(self, first_row: int, states: FloatArray) -> list[Difference]:
        """Differences in the rows that are recorded whole."""
        inputs = self._inputs
        inside = (inputs.state_rows >= first_row) & (inputs.state_rows < first_row + len(states))
        rows, whole = inputs.state_rows[inside], inputs.states[inside]
        found = []
        for name in self._slots:
            recorded = whole[:, inputs.slots.index(name)]
            found += self._of(name, rows, recorded, states[rows - first_row, _INDEX[name]])
        return found

    def _of(
        self, name: str, rows: np.ndarray, recorded: FloatArray, recomputed: FloatArray
    ) -> list[Difference]:
        a, b = (np.ascontiguousarray(x).view(np.uint64) for x in (recorded, recomputed))
        at = np.flatnonzero(a != b)
        if not len(at):
            return []
        with np.errstate(invalid="ignore"):
            size = np.abs(recorded[at] - recomputed[at])
        most = at[int(np.argmax(np.where(np.isfinite(size), size, np.inf)))]
        return [
            Difference(
                int(self._tick[rows[k]]),
                float(self._time[rows[k]]),
                name,
                float(recorded[k]),
                float(recomputed[k]),
                int(self._tick[rows[k]]),
            )
            for k in dict.fromkeys((int(at[0]), int(most)))
        ]

    def _measure(self, difference: Difference) -> None:
        share = difference.size / self._scale(difference.slot)
        if self.largest is None or share > self._share:
            self._share, self.largest = share, difference

    def _scale(self, name: str) -> float:
        """Largest magnitude of a slot in the record; 1 where it is zero or unknown."""
        if name not in self._scales:
            inputs = self._inputs
            values = (
                inputs.column(name)
                if name in inputs.columns
                else inputs.states[:, inputs.slots.index(name)]
            )
            finite = np.abs(values[np.isfinite(values)])
            self._scales[name] = float(finite.max(initial=0.0)) or 1.0
        return self._scales[name]
