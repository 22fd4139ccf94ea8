"""First stage of the effects: what only they write begins each tick at zero."""

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage


@stage
def clear(state: FloatArray, parameters: FloatArray) -> None:
    """Zero what only effects write."""
    state[sv.AXIAL_FORCE] = 0.0
    for slot in sv.SCENE:
        state[slot] = 0.0
