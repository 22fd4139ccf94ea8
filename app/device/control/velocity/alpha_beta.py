"""Alpha-beta filter: a tracker of constant velocity with fixed gains.

Prediction x + v h, residual r, then x += α r and v += β r/h. Gains follow the time h between the
readings: α = h/(τ + h), and β = α²/(2 - α), the best transient response for a given α (Benedict and
Bordner 1962). Written so, v changes by at most r/h for a long step and by nothing for a short one.
"""

from dataclasses import dataclass
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
_POSITION: Final = FREE + 1  # left and right


@njit
def _track(p: FloatArray, slot: int, reading: float, velocity: float, h: float) -> float:
    predicted = p[slot] + velocity * h
    residual = reading - predicted
    if not abs(residual) < JUMP:
        p[slot] = reading
        return 0.0
    constant = p[_TIME_CONSTANT]
    alpha = h / (constant + h)
    p[slot] = predicted + alpha * residual
    # β r/h with α = h/(τ + h): the step cancels.
    return plausible(velocity + alpha * residual / ((constant + h) * (2.0 - alpha)))


@stage
def alpha_beta_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_*."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    left, right = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if action == RESTART:
        p[_POSITION], p[_POSITION + 1] = left, right
        return
    state[sv.QD_LEFT] = _track(p, _POSITION, left, state[sv.QD_LEFT], elapsed)
    state[sv.QD_RIGHT] = _track(p, _POSITION + 1, right, state[sv.QD_RIGHT], elapsed)


@dataclass(frozen=True, slots=True)
class AlphaBeta:
    """Tracker of constant velocity.

    Attributes:
        time_constant: τ [s]; 2.5 ms is α = 0.29 at 1 kHz (`acus study velocity`).
    """

    time_constant: float = 2.5e-3

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = np.zeros(_POSITION + 2)
        parameters[_TIME_CONSTANT] = self.time_constant
        return "velocity", alpha_beta_stage, parameters
