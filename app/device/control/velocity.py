"""Joint velocities from encoder angles: backward difference and a first-order filter."""

from dataclasses import dataclass
from math import isfinite, pi
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.control.vectors import snapped

_TIME_CONSTANT, _STARTED, _LAST_LEFT, _LAST_RIGHT, _SIZE = range(5)


@njit
def _filtered(velocity: float, difference: float, dt: float, time_constant: float) -> float:
    # Backward Euler of a first-order low-pass on the difference quotient, without dividing by dt.
    # More than half a turn in a tick is no movement, and must not stay in the memory for seconds.
    if not (abs(difference) < pi and isfinite(velocity)):
        return 0.0
    return snapped(velocity + (difference - velocity * dt) / (time_constant + dt))


@stage
def velocity_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_* over DT. Zero at first and after a bad reading."""
    left, right, dt = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.DT]
    if not (isfinite(left) and isfinite(right)):
        p[_STARTED] = 0.0
        state[sv.QD_LEFT] = 0.0
        state[sv.QD_RIGHT] = 0.0
        return
    if p[_STARTED] == 0.0:
        state[sv.QD_LEFT] = 0.0
        state[sv.QD_RIGHT] = 0.0
    elif dt > 0.0:
        constant = p[_TIME_CONSTANT]
        state[sv.QD_LEFT] = _filtered(state[sv.QD_LEFT], left - p[_LAST_LEFT], dt, constant)
        state[sv.QD_RIGHT] = _filtered(state[sv.QD_RIGHT], right - p[_LAST_RIGHT], dt, constant)
    p[_STARTED] = 1.0
    p[_LAST_LEFT] = left
    p[_LAST_RIGHT] = right


@dataclass(frozen=True, slots=True)
class VelocityFilter:
    """Backward difference through a first-order low-pass.

    Attributes:
        cutoff_hz: corner of the filter. At 1 kHz one encoder count is 0.3 rad/s without it.
    """

    cutoff_hz: float = 50.0

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = np.zeros(_SIZE)
        parameters[_TIME_CONSTANT] = 1.0 / (2.0 * pi * self.cutoff_hz)
        return "velocity", velocity_stage, parameters
