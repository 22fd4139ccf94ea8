"""How punctual a loop is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.core import state_vector as sv
from app.device.control.history import History
from app.device.control.kernel import MISSED


@dataclass(frozen=True, slots=True)
class Timing:
    """Lateness of the wake-ups over the last ticks of a loop.

    Attributes:
        rate_hz: rate that the loop is asked to keep [Hz].
        host: `compiled` or `thread`, see `loop.Host`.
        realtime: whether the thread has real-time priority.
        ticks: ticks since the loop was made.
        missed: deadlines missed since then.
        samples: ticks that the following figures cover.
        median: lateness [s].
        p90: lateness that 90 % of the ticks do not exceed [s].
        p99: lateness that 99 % do not exceed [s].
        maximum: largest lateness [s].
        cost: median time that the stages of a tick take [s]; 0 where it is not measured.
    """

    rate_hz: float
    host: str
    realtime: bool
    ticks: int
    missed: int
    samples: int
    median: float
    p90: float
    p99: float
    maximum: float
    cost: float


def measure(history: History, rate_hz: float, host: str, realtime: bool, count: int) -> Timing:
    """Read the timing of the last `count` ticks from the history."""
    lateness = history.column(sv.LATENESS, count)
    costs = history.column(sv.TICK_COST, count)
    if len(lateness) == 0:
        lateness = costs = np.zeros(1)
    median, p90, p99, maximum = np.percentile(lateness, (50, 90, 99, 100)).tolist()
    return Timing(
        rate_hz=rate_hz,
        host=host,
        realtime=realtime,
        ticks=history.head,
        missed=int(history.counters[MISSED]),
        samples=min(history.head, len(lateness)),
        median=median,
        p90=p90,
        p99=p99,
        maximum=maximum,
        cost=float(np.median(costs)),
    )
