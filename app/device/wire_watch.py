"""What the wire did in the last seconds, from its counters in the snapshots."""

from collections import deque
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.rate_meter import RateMeter

WINDOW: Final = 10.0
"""Rates and percentiles are those of so many last seconds."""

_MOST_TRIPS: Final = 400


@dataclass(frozen=True, slots=True)
class WireFigures:
    """The wire over the last `WINDOW` seconds; None where it has not answered yet.

    Attributes:
        replies: per second.
        errors, lost: per second; broken frames, and commands without an answer.
        median, p99: round trip [s] of the answers that the looks happened to see.
    """

    replies: float
    errors: float
    lost: float
    median: float | None
    p99: float | None


class WireWatch:
    """Takes rows of the loop, as often as it likes."""

    def __init__(self) -> None:
        self._replies, self._errors, self._lost = (RateMeter(WINDOW) for _ in range(3))
        self._trips: deque[float] = deque(maxlen=_MOST_TRIPS)
        self._seen = 0.0

    def read(self, row: FloatArray, now: float) -> WireFigures:
        """Take a state vector, shape (SLOTS,), at `now` [s]."""
        counts = row[[sv.LINK_REPLIES, sv.LINK_ERRORS, sv.LINK_LOST]]
        replies, errors, lost = np.nan_to_num(counts).astype(int).tolist()
        trip = float(row[sv.ROUND_TRIP])
        if replies != self._seen and np.isfinite(trip) and trip > 0.0:
            self._seen = replies
            self._trips.append(trip)
        median = p99 = None
        if self._trips:
            median, p99 = np.percentile(list(self._trips), (50.0, 99.0)).tolist()
        return WireFigures(
            self._replies.read(now, replies),
            self._errors.read(now, errors),
            self._lost.read(now, lost),
            median,
            p99,
        )
