"""States and events of an attempt on its time axis."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.events import Event
from app.session.abort_reasons import abort_words

_COUNTED: Final = {"scan": "▼", "touch": "●"}
"""Kinds of events that are numbered, and the sign that stands before their number."""

LONGEST_SIGN: Final = 24
"""Characters of an event that stand on a plot."""


@dataclass(frozen=True, slots=True)
class Span:
    """A stretch of time in one state of the attempt [s since the beginning]."""

    state: str
    start: float
    end: float


@dataclass(frozen=True, slots=True)
class TimeMark:
    """An event on the time axis [s since the beginning]."""

    time: float
    kind: str
    label: str

    @property
    def sign(self) -> str:
        """Return what stands on a plot: the number of a scan or a touch, or the words, cut
        short.
        """
        return self.sign_of(self.label)

    def sign_of(self, label: str) -> str:
        """Return what stands on a plot where the label is said in other words."""
        if self.kind in _COUNTED:
            return f"{_COUNTED[self.kind]} {label}"
        whole = len(label) <= LONGEST_SIGN
        return f"! {label if whole else label[: LONGEST_SIGN - 1].rstrip() + '…'}"


def spans(time: FloatArray, state: NDArray[np.str_]) -> tuple[Span, ...]:
    """Stretches of equal state; each ends where the next one begins."""
    if len(time) == 0:
        return ()
    starts = [0, *(np.flatnonzero(state[1:] != state[:-1]) + 1).tolist()]
    ends = [*starts[1:], len(time) - 1]
    return tuple(
        Span(str(state[a]), float(time[a]), float(time[b]))
        for a, b in zip(starts, ends, strict=True)
    )


def marks(events: Sequence[Event], origin: float, kinds: Sequence[str]) -> tuple[TimeMark, ...]:
    """Events of some kinds on the time axis; scans and touches are numbered."""
    found, counts = [], dict.fromkeys(kinds, 0)
    for event in events:
        if event.kind in counts:
            counts[event.kind] += 1
            label = str(counts[event.kind]) if event.kind in _COUNTED else _words(event)
            found.append(TimeMark(event.time - origin, event.kind, label))
    return tuple(found)


def _words(event: Event) -> str:
    return abort_words(event.message) if event.kind == "abort" else event.message
