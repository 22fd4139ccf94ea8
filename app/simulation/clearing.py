"""First stage of the effects: what only they add to begins each tick at zero."""

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage


@stage
def clear(state: FloatArray, parameters: FloatArray) -> None:
    """Zero what only effects add to."""
    state[sv.AXIAL_FORCE] = 0.0
    state[sv.TARGET_SHIFT_X] = 0.0
    state[sv.TARGET_SHIFT_Y] = 0.0
    state[sv.TARGET_SHIFT_Z] = 0.0
