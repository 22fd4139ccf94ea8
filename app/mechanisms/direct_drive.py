"""Motors on the joints themselves, for `needle_motion`: what most machines have."""

from typing import Final

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.needle_motion import bounded

STRONGEST: Final = 5.0
"""Far beyond any motor of this size [N·m]."""


@njit
def direct_drive(
    state: FloatArray, p: FloatArray, h: float
) -> tuple[float, float, float, float, float]:
    """Return TORQUE_*, whatever the joints do, and nothing that is added to the mass matrix."""
    left = bounded(state[sv.TORQUE_LEFT], STRONGEST)
    right = bounded(state[sv.TORQUE_RIGHT], STRONGEST)
    return left, right, 0.0, 0.0, 0.0


@njit
def nothing_behind(state: FloatArray, p: FloatArray, h: float) -> None:
    """Motors on the joints have no motion of their own."""
