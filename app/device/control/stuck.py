"""Noticing a tick that does not return, and which stage it is in.

Compiled code cannot be interrupted. The board's own watchdog ends the torque 20 ms after the last
command; what is left for the host is to see it, to say which law it was, and to go on without the
loop's thread. A tick counts as stuck once the thread has used 20 ms of *processor time* in it: a
busy machine that keeps the thread waiting is late, not stuck.
"""

import contextlib
import os
import threading
import time
from typing import Final

from app.device.control.kernel import HEAD, RUNNING
from app.device.control.table import Table

LIMIT: Final = 0.020
"""Processor time of one tick [s]; a whole one takes some microseconds."""

_WITHOUT_CLOCK: Final = 1.0  # [s] of waiting, where a thread's processor time cannot be read


class TickWatch:
    """Looks at the counters of one loop from another thread."""

    def __init__(self, counters: object, table: Table) -> None:
        self._counters: object = counters
        self._names = tuple(stage.name for stage in table)
        self._seen = (-1, 0)
        self._since = 0.0
        self.reason = ""

    def look(self, thread: threading.Thread) -> str:
        """Return why the loop is stuck, or nothing; once stuck it stays so.

        Call it again and again: a tick is stuck that used `LIMIT` between two calls.
        """
        if self.reason:
            return self.reason
        head, running = int(self._counters[HEAD]), int(self._counters[RUNNING])  # type: ignore[index]
        used, limit = _used(thread)
        if running == 0 or head != self._seen[0]:
            self._seen, self._since = (head, running), used
        elif used - self._since >= limit:
            self.reason = self._words(running)
            _let_others_run(thread)
        return self.reason

    def _words(self, running: int) -> str:
        name = self._names[running - 1]
        law = "keep" in self._names and (
            self._names.index("keep") < running - 1 < self._names.index("give back")
        )
        what = f"the force law or effect {name!r}" if law else f"the stage {name!r} of the loop"
        return (
            f"{what} does not return: there is no force any more; end the program, mend or remove"
            " it, and start again"
        )


def _used(thread: threading.Thread) -> tuple[float, float]:
    """Processor time of a thread and its limit [s]; or the time of day's, where there is none."""
    if hasattr(time, "pthread_getcpuclockid") and thread.ident is not None and thread.is_alive():
        return time.clock_gettime(time.pthread_getcpuclockid(thread.ident)), LIMIT
    return time.monotonic(), _WITHOUT_CLOCK


def _let_others_run(thread: threading.Thread) -> None:
    """Give an endless thread no more of the processor than nobody else wants."""
    if hasattr(os, "sched_setscheduler") and thread.native_id is not None:
        with contextlib.suppress(OSError):
            os.sched_setscheduler(thread.native_id, os.SCHED_IDLE, os.sched_param(0))
