"""The loop on Linux: a compiled kernel that sleeps to absolute deadlines without the interpreter.

Import only on Linux: `clock_nanosleep` is resolved when the kernel is built.
"""

import ctypes
import os
from typing import Final

from app.core import state_vector as sv
from app.core.arrays import FloatArray, IntArray
from app.device.control.kernel import (
    EXCHANGE,
    HEAD,
    MISSED,
    STOP,
    TICK_TYPES,
    ArrayList,
    StageList,
    answer,
    compiled,
    publish,
    receive,
    run_tick,
)

import numpy as np  # isort: skip
from app.core.compiled import njit  # isort: skip  (sets the cache folder before numba)
from numba import types  # isort: skip

_MONOTONIC: Final = 1
_ABSOLUTE: Final = 1
_INTERRUPTED: Final = 4
_PR_SET_TIMERSLACK: Final = 29
LATE_TICKS: Final = 2
"""A late tick integrates at most this many periods: it does not catch up."""

_clock_gettime = types.ExternalFunction("clock_gettime", types.int32(types.int32, types.voidptr))
_clock_nanosleep = types.ExternalFunction(
    "clock_nanosleep", types.int32(types.int32, types.int32, types.voidptr, types.voidptr)
)


@njit
def _now(timespec: IntArray) -> int:
    _clock_gettime(_MONOTONIC, timespec.ctypes)
    return timespec[0] * 1_000_000_000 + timespec[1]


@njit
def _sleep_until(deadline: int, timespec: IntArray) -> None:
    timespec[0] = deadline // 1_000_000_000
    timespec[1] = deadline % 1_000_000_000
    while True:  # a signal ends the sleep early; the deadline stands
        answer = _clock_nanosleep(_MONOTONIC, _ABSOLUTE, timespec.ctypes, timespec.ctypes)
        if answer != _INTERRUPTED:
            return


@compiled(types.int64(*TICK_TYPES, types.int64, types.int64))
def run(
    state: FloatArray,
    stages: StageList,
    parameters: ArrayList,
    inbox: FloatArray,
    scratch: FloatArray,
    sequence: IntArray,
    ring: FloatArray,
    counters: IntArray,
    checkpoint: FloatArray,
    period: int,
    begin: int,
) -> int:
    """Tick every `period` [ns] until `counters[STOP]`, or until `counters[EXCHANGE]`.

    Deadlines lie on one grid. A tick that wakes a period or more late counts the deadlines it
    missed, goes on from the next one, and integrates at most `LATE_TICKS` periods. The first one is
    `begin` [ns of the monotonic clock], or a period from now if that is 0; returned is the one to
    go on with.
    """
    timespec = np.zeros(2, np.int64)
    deadline = begin if begin > 0 else _now(timespec) + period
    last = deadline - period
    while counters[STOP] == 0 and counters[EXCHANGE] == 0:
        _sleep_until(deadline, timespec)
        now = _now(timespec)
        late = max(now - deadline, 0)
        skipped = late // period
        deadline += skipped * period
        counters[MISSED] += skipped
        state[sv.TIME] = now * 1e-9
        state[sv.DT] = min(deadline - last, LATE_TICKS * period) * 1e-9
        state[sv.TICK] = counters[HEAD] + 1
        state[sv.LATENESS] = late * 1e-9
        state[sv.MISSED] = counters[MISSED]
        receive(state, inbox, scratch, sequence)
        run_tick(state, stages, parameters, counters)
        state[sv.TICK_COST] = (_now(timespec) - now) * 1e-9
        publish(state, ring, counters)
        answer(state, parameters, counters, checkpoint)
        last = deadline
        deadline += period
    return deadline


def ask_for_precise_timers() -> None:
    """Let the calling thread wake at its deadline, not up to 50 µs later to save power."""
    ctypes.CDLL(None).prctl(_PR_SET_TIMERSLACK, 1, 0, 0, 0)


def ask_for_realtime_priority() -> bool:
    """Ask for SCHED_FIFO for the calling thread; a desktop may not give it.

    Returns:
        Whether the thread has it now.
    """
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(50))
    except OSError:
        return False
    return True
