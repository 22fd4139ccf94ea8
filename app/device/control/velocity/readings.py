"""What every velocity estimator must survive: bad, first, repeated and late readings, and jumps.

A tick may come late with its step DT clamped, while the encoder went on moving; a wire may deliver
the same reading twice. The time between readings is therefore DT, unless their stamps Q_TIME say
that it was clearly longer. Stamps of 0 are no stamps.
"""

from math import isfinite, pi
from typing import Final

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.device.control.vectors import snapped

STARTED: Final = 0
STAMP: Final = 1
FREE: Final = 2
"""Entries of every estimator's parameters: whether there is a last reading, its stamp [s]; what
follows belongs to the estimator."""

KEEP: Final = 0
RESTART: Final = 1
STEP: Final = 2
"""What a reading asks for: leave everything as it is, begin with it, or go on with it."""

FASTEST: Final = 100.0
"""[rad/s] No joint of this size turns faster; an estimate beyond is cut to it."""

JUMP: Final = pi
"""[rad] Half a turn between two readings is no movement: an encoder wrapped, slipped or failed."""

_LATE: Final = 1.5  # of DT: what an ordinary wake-up does not exceed
_HELD: Final = 0.020  # [s] a velocity is kept this long without a new reading: as safety fades from
_GAP: Final = 0.200  # [s] after a longer gap nothing is known of the movement


@njit
def next_reading(state: FloatArray, p: FloatArray) -> tuple[int, float]:
    """Judge the reading in Q_*: what to do, and the time since the last one [s].

    On RESTART, and where a reading is not finite or too old, QD_* has been set to zero.
    """
    stamp, dt = state[sv.Q_TIME], state[sv.DT]
    if not isfinite(state[sv.Q_LEFT] + state[sv.Q_RIGHT]):
        return _forget(state, p), 0.0
    if p[STARTED] == 0.0:
        return _begin(state, p, stamp), 0.0
    if not dt > 0.0:  # the clock stands still; also for NaN
        return KEEP, 0.0
    if stamp == 0.0 or not isfinite(stamp):
        return STEP, min(dt, _GAP)
    between = stamp - p[STAMP]
    if between == 0.0 and abs(state[sv.TIME] - stamp) <= _HELD:
        return KEEP, 0.0
    if between == 0.0:
        state[sv.QD_LEFT], state[sv.QD_RIGHT] = 0.0, 0.0
        return KEEP, 0.0
    if not 0.0 < between <= _GAP:
        return _begin(state, p, stamp), 0.0
    p[STAMP] = stamp
    return STEP, between if between > _LATE * dt else dt


@njit
def _forget(state: FloatArray, p: FloatArray) -> int:
    p[STARTED] = 0.0
    state[sv.QD_LEFT], state[sv.QD_RIGHT] = 0.0, 0.0
    return KEEP


@njit
def _begin(state: FloatArray, p: FloatArray, stamp: float) -> int:
    p[STARTED] = 1.0
    p[STAMP] = stamp if isfinite(stamp) else 0.0
    state[sv.QD_LEFT], state[sv.QD_RIGHT] = 0.0, 0.0
    return RESTART


@njit
def plausible(velocity: float) -> float:
    """Return an estimate within ±FASTEST; NaN and what is too small to matter become zero."""
    if not abs(velocity) <= FASTEST:
        return FASTEST if velocity > FASTEST else (-FASTEST if velocity < -FASTEST else 0.0)
    return snapped(velocity)
