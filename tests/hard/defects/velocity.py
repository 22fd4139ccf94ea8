"""Defects of the velocity's hard cases: differences as they come, over the wrong time."""

from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.control.velocity import VelocityMethod, velocity_stage
from app.studies.hard_cases.velocity import PROFILE
from tests.hard.defects import Defect


def difference(_: VelocityMethod) -> Any:
    return velocity_stage(PROFILE, VelocityMethod.BACKWARD_DIFFERENCE)


def raw(_: Any) -> Any:
    # A difference of whatever comes.
    stage = difference(VelocityMethod.BACKWARD_DIFFERENCE)
    memory = [0.0]

    def step(state: FloatArray, parameters: FloatArray) -> None:
        with np.errstate(all="ignore"):
            now = (state[sv.Q_LEFT] - memory[0]) / state[sv.DT] + 1e-320
        state[sv.QD_LEFT], memory[0] = now, float(state[sv.Q_LEFT])

    return stage._replace(function=step)


def halved(method: VelocityMethod) -> Any:
    stage = velocity_stage(PROFILE, method)

    def step(state: FloatArray, parameters: FloatArray) -> None:
        state[sv.DT] *= 2.0
        state[sv.Q_TIME] = state[sv.TIME] = 2.0 * state[sv.TIME]
        stage.function(state, parameters)
        state[sv.DT] *= 0.5

    return stage._replace(function=step)


def by_step(method: VelocityMethod) -> Any:
    # The clamped step instead of the time between the stamps.
    stage = velocity_stage(PROFILE, method)

    def step(state: FloatArray, parameters: FloatArray) -> None:
        kept, state[sv.Q_TIME] = state[sv.Q_TIME], 0.0
        stage.function(state, parameters)
        state[sv.Q_TIME] = kept

    return stage._replace(function=step)


DEFECTS = {
    "velocity": {
        **dict.fromkeys(
            (f"a decaying velocity ends in exact zero, by {method}" for method in VelocityMethod),
            Defect("a difference of whatever comes", raw),
        ),
        **dict.fromkeys(
            (
                "a steady 0.2 rad/s, by the default method",
                "a steady 0.2 rad/s after the encoder wrapped, by the default method",
                "a steady 0.2 rad/s after one reading of 1e308, by the default method",
            ),
            Defect("twice the step", halved),
        ),
        "ticks 100 ms late, their step clamped to 5 ms, show as no burst of speed": Defect(
            "difference over the clamped step", by_step
        ),
        "a joint at rest on the edge of a count, by the default method": Defect(
            "backward difference", difference
        ),
    },
}
