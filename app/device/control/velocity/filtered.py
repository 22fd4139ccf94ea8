"""Backward difference through a first-order low-pass: lag 1/(2π·cutoff), whatever the speed."""

from dataclasses import dataclass
from math import pi
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.control.velocity.readings import (
    FREE,
    JUMP,
    KEEP,
    RESTART,
    next_reading,
    plausible,
)

_TIME_CONSTANT: Final = FREE
_LAST: Final = FREE + 1  # left and right


@njit
def _filtered(velocity: float, turned: float, elapsed: float, constant: float) -> float:
    # Backward Euler of the low-pass on the difference quotient, without dividing by the time.
    if not abs(turned) < JUMP:
        return 0.0
    return plausible(velocity + (turned - velocity * elapsed) / (constant + elapsed))


@stage
def filtered_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_*; the filter's memory is QD_* itself."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    left, right = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if action != RESTART:
        constant = p[_TIME_CONSTANT]
        state[sv.QD_LEFT] = _filtered(state[sv.QD_LEFT], left - p[_LAST], elapsed, constant)
        state[sv.QD_RIGHT] = _filtered(state[sv.QD_RIGHT], right - p[_LAST + 1], elapsed, constant)
    p[_LAST], p[_LAST + 1] = left, right


@dataclass(frozen=True, slots=True)
class VelocityFilter:
    """Backward difference through a first-order low-pass.

    Attributes:
        cutoff_hz: corner of the filter. At 1 kHz one encoder count is 0.3 rad/s without it.
    """

    cutoff_hz: float = 50.0

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = np.zeros(_LAST + 2)
        parameters[_TIME_CONSTANT] = 1.0 / (2.0 * pi * self.cutoff_hz)
        return "velocity", filtered_stage, parameters
