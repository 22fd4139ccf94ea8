"""What runs the ticks of a loop, and with which priority."""

import sys
from enum import StrEnum

from app.core.clock import Clock, VirtualClock

THREAD_RATE_HZ = 250.0
"""Highest rate that the plain thread promises, where the compiled loop does not exist."""


class Host(StrEnum):
    """What runs the ticks.

    `COMPILED`: a compiled kernel with absolute deadlines, without the interpreter lock (Linux).
    `THREAD`: a plain thread, at most `THREAD_RATE_HZ`. `STEPPED`: `Loop.step` on a virtual clock.
    """

    COMPILED = "compiled"
    THREAD = "thread"
    STEPPED = "stepped"


class Priority(StrEnum):
    """Priority of the compiled loop's thread. `REALTIME` is done without where it is refused."""

    REALTIME = "realtime"
    NORMAL = "normal"


def default_host(clock: Clock) -> Host:
    """Host for a clock on this platform."""
    if isinstance(clock, VirtualClock):
        return Host.STEPPED
    return Host.COMPILED if sys.platform == "linux" else Host.THREAD
