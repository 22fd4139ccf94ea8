"""What force laws and effects cannot change, whatever they write: all but what is theirs to write.

Laws and effects may come from anybody. Before them the whole state is kept; after them everything
but the sums that they add to and what effects say of the scene is taken from what was kept. Inputs
(ENABLED, FORCE_CAP, HOMED, HEARTBEAT), time, kinematics and the slots of governor, guard and safety
are therefore the loop's own when the stages behind them look. What laws may write goes through all
the limits behind them; a value there that is not finite holds the force at zero.
"""

from collections.abc import Iterable
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage

_THEIRS: Final = sv.SUMS + sv.SCENE
_SIZE: Final = sv.SLOTS + len(_THEIRS)


@stage
def keep_stage(state: FloatArray, p: FloatArray) -> None:
    """Keep the state."""
    for slot in range(sv.SLOTS):
        p[slot] = state[slot]


@stage
def give_back_stage(state: FloatArray, p: FloatArray) -> None:
    """Take the state back, but for what laws and effects may write."""
    place = sv.SLOTS
    for slot in _THEIRS:
        p[place] = state[slot]
        place += 1
    for slot in range(sv.SLOTS):
        state[slot] = p[slot]
    place = sv.SLOTS
    for slot in _THEIRS:
        state[slot] = p[place]
        place += 1


def protected(stages: Iterable[tuple[str, Any, FloatArray]]) -> list[tuple[str, Any, FloatArray]]:
    """Return laws and effects between the two stages, which share one array; none stay none."""
    inner = list(stages)
    memory = np.zeros(_SIZE)
    around = ("keep", keep_stage, memory), ("give back", give_back_stage, memory)
    return [around[0], *inner, around[1]] if inner else []
