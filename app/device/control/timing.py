"""How late the loop's ticks are, and whether one does not return, and in which stage.

Compiled code cannot be interrupted. The board's own watchdog ends the torque 20 ms after the last
command; what is left for the host is to see it, to say which law it was, and to go on without the
loop's thread. A tick counts as endless once the thread has used 20 ms of *processor time* in it: a
busy machine that keeps the thread waiting is late, nothing more.
"""

from __future__ import annotations

import contextlib
import os
import threading
import time
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import IntArray
from app.core.messages import sentence
from app.device.control.kernel import HEAD, MISSED, RUNNING
from app.device.control.shared import TickHistory
from app.device.control.table import Table


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


def measure(history: TickHistory, rate_hz: float, host: str, realtime: bool, count: int) -> Timing:
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


LIMIT: Final = 0.020
"""Processor time of one tick [s]; a whole one takes some microseconds."""

_WITHOUT_CLOCK: Final = 1.0  # [s] of waiting, where a thread's processor time cannot be read


class TickWatch:
    """Looks at the counters of one loop from another thread."""

    def __init__(self, counters: IntArray, table: Table) -> None:
        self._counters = counters
        self._names = tuple(stage.name for stage in table)
        self._seen = (-1, 0)
        self._since = 0.0
        self.reason = ""

    def check(self, thread: threading.Thread) -> str:
        """Return which stage does not return, or nothing; once said it stays so.

        Call it again and again: a tick is endless that used `LIMIT` between two calls.
        """
        if self.reason:
            return self.reason
        head, running = int(self._counters[HEAD]), int(self._counters[RUNNING])
        used, limit = _used(thread)
        if running == 0 or head != self._seen[0]:
            self._seen, self._since = (head, running), used
        elif used - self._since >= limit:
            self.reason = self._words(running)
            _let_others_run(thread)
        return self.reason

    def ended(self, error: BaseException) -> str:
        """Say which stage raised what ended the loop; just what, if it was none."""
        running = int(self._counters[RUNNING])
        if running == 0:
            return str(error)
        text = f"{type(error).__name__}: {error}".rstrip(": ")
        return sentence(
            "{named} raises {fault}; mend or remove it, and start again",
            named=self._named(running),
            fault=text,
        )

    def _words(self, running: int) -> str:
        return sentence(
            "{named} does not return: there is no force any more; end the program,"
            " mend or remove it, and start again",
            named=self._named(running),
        )

    def _named(self, running: int) -> str:
        name = self._names[running - 1]
        law = "keep" in self._names and (
            self._names.index("keep") < running - 1 < self._names.index("give back")
        )
        return (
            sentence("the force law or effect {name!r}", name=name)
            if law
            else sentence("the stage {name!r} of the loop", name=name)
        )


def _used(thread: threading.Thread) -> tuple[float, float]:
    """Processor time of a thread and its limit [s]; or the time of day's, where there is none."""
    if hasattr(time, "pthread_getcpuclockid") and thread.ident is not None and thread.is_alive():
        with contextlib.suppress(OSError):  # it can end between the two
            return time.clock_gettime(time.pthread_getcpuclockid(thread.ident)), LIMIT
    return time.monotonic(), _WITHOUT_CLOCK


def _let_others_run(thread: threading.Thread) -> None:
    """Give an endless thread no more of the processor than nobody else wants."""
    if hasattr(os, "sched_setscheduler") and thread.native_id is not None:
        with contextlib.suppress(OSError):
            os.sched_setscheduler(thread.native_id, os.SCHED_IDLE, os.sched_param(0))
