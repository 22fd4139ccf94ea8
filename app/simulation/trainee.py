"""The scripted trainee as a stage of the tick: plays a script into HAND_* and TRAINEE_PHASE.

It runs on TIME since the attempt was armed, so a run is the same on every machine and at every
rate; it begins afresh with every attempt, from where the hand is: what the script's beginning lies
off it is taken out along a minimum-jerk curve while the script hovers.
"""

from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.core.compiled import njit, stage
from app.simulation.errors import SimulationError
from app.simulation.hand_motion import grip_direction
from app.simulation.plan import Stage
from app.simulation.script import (
    STEP,
    TREMOR_ROWS,
    TREMOR_STEP,
    ScriptPhase,
    TraineeScript,
    write_script,
)
from app.simulation.skill import Skill, find_skill

# Parameters array: heads, path axis, tangent basis, where the hand was, tremor tile, script rows.
START, SPEED, ROWS, AXIS, FIRST, SECOND, FROM, HOVER, TREMOR = 0, 1, 2, 3, 6, 9, 12, 15, 16
_SCRIPT: Final = TREMOR + 3 * TREMOR_ROWS
_TREMOR_PERIOD: Final = TREMOR_ROWS * TREMOR_STEP


def trainee_stage(
    axis: FloatArray, depth: float, skill: str | Skill = "expert", seed: int = 0, speed: float = 1.0
) -> Stage:
    """Build the stage that inserts to `depth` [m] along `axis` (hub to tip, shape (3,)).

    Args:
        axis: wanted needle direction in world.
        depth: of the target beyond the fulcrum [m].
        skill: `novice`, `expert` or a `Skill`.
        seed: another seed is another attempt of the same skill.
        speed: 2 plays the script twice as fast; the tremor keeps its frequency.

    Raises:
        SimulationError: for an unknown skill, a depth not above 0 or a speed outside 0.05-20.
    """
    if not 0.05 <= speed <= 20.0:
        raise SimulationError(f"speed factor is {speed}; give 0.05 to 20")
    script = write_script(axis, depth, find_skill(skill), seed)
    return "trainee", step, _parameters(script, unit(axis, "axis"), speed)


def _parameters(script: TraineeScript, axis: FloatArray, speed: float) -> FloatArray:
    head = np.array([np.nan, speed, len(script.rows)])
    hover = np.array(
        [0.0, 0.0, 0.0, np.count_nonzero(script.rows[:, 3] == ScriptPhase.HOVER) * STEP]
    )
    return np.concatenate(
        [head, axis, script.basis.ravel(), hover, script.tremor.ravel(), script.rows.ravel()]
    )


@njit
def _interpolate(
    p: FloatArray, base: int, width: int, row: int, next_row: int, share: float, i: int
) -> float:
    low = p[base + width * row + i]
    return low + share * (p[base + width * next_row + i] - low)


@njit
def _direction(p: FloatArray, e1: float, e2: float, i: int) -> float:
    """Component i of the path direction turned by the error (e1, e2) [rad]."""
    angle = np.sqrt(e1 * e1 + e2 * e2)
    sinc = np.sin(angle) / angle if angle > 1e-9 else 1.0
    return np.cos(angle) * p[AXIS + i] + sinc * (e1 * p[FIRST + i] + e2 * p[SECOND + i])


@njit
def _begin_where_the_hand_is(state: FloatArray, p: FloatArray) -> None:
    """Note how far the hand is off the script's beginning: e1, e2 [rad], depth [m]."""
    gx, gy, gz = grip_direction(state)
    along = gx * p[AXIS] + gy * p[AXIS + 1] + gz * p[AXIS + 2]
    a = gx * p[FIRST] + gy * p[FIRST + 1] + gz * p[FIRST + 2]
    b = gx * p[SECOND] + gy * p[SECOND + 1] + gz * p[SECOND + 2]
    sine = np.sqrt(a * a + b * b)
    turned = np.arctan2(sine, along) / sine if sine > 1e-9 else 1.0
    p[FROM] = turned * a - p[_SCRIPT]
    p[FROM + 1] = turned * b - p[_SCRIPT + 1]
    p[FROM + 2] = state[sv.GRIP_DEPTH] - p[_SCRIPT + 2]
    for i in range(3):
        if not np.isfinite(p[FROM + i]):
            p[FROM + i] = 0.0


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Write the wanted direction and depth, that the hand holds, and the phase."""
    time = state[sv.TIME]
    if not np.isfinite(time):
        return
    if not state[sv.ENABLED] > 0.0:  # between attempts the hand stays as it is told
        parameters[START] = np.nan
        return
    if np.isnan(parameters[START]):
        parameters[START] = time
        _begin_where_the_hand_is(state, parameters)
    elapsed = max(0.0, time - parameters[START])
    last = int(parameters[ROWS]) - 1
    at = min(elapsed * parameters[SPEED] / STEP, float(last))
    row = int(at)
    next_row = min(row + 1, last)
    shaking = (elapsed - _TREMOR_PERIOD * np.floor(elapsed / _TREMOR_PERIOD)) / TREMOR_STEP
    shake = int(shaking) % TREMOR_ROWS
    next_shake = (shake + 1) % TREMOR_ROWS
    e1 = _interpolate(parameters, _SCRIPT, 4, row, next_row, at - row, 0)
    e2 = _interpolate(parameters, _SCRIPT, 4, row, next_row, at - row, 1)
    depth = _interpolate(parameters, _SCRIPT, 4, row, next_row, at - row, 2)
    if parameters[HOVER] > 0.0:
        s = min(elapsed * parameters[SPEED] / parameters[HOVER], 1.0)
        left = 1.0 - s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)
        e1 += left * parameters[FROM]
        e2 += left * parameters[FROM + 1]
        depth += left * parameters[FROM + 2]
    share = shaking - np.floor(shaking)
    e1 += _interpolate(parameters, TREMOR, 3, shake, next_shake, share, 0)
    e2 += _interpolate(parameters, TREMOR, 3, shake, next_shake, share, 1)
    depth += _interpolate(parameters, TREMOR, 3, shake, next_shake, share, 2)
    state[sv.HAND_X] = _direction(parameters, e1, e2, 0)
    state[sv.HAND_Y] = _direction(parameters, e1, e2, 1)
    state[sv.HAND_DEPTH] = depth
    state[sv.HAND_HOLDS] = 1.0
    state[sv.TRAINEE_PHASE] = parameters[_SCRIPT + 4 * row + 3]
