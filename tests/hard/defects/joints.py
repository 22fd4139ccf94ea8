"""Defects of the ball joints' hard cases: explicit steps, a force along the motion."""

from collections.abc import Callable
from typing import Any

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.effects import ball_joint
from app.studies.hard_cases.joints import joint
from tests.hard.defects import Defect


def euler(z: Any, way: Any, play: float, level: float, stiffness: float) -> Any:
    held = ball_joint.moment(z, play, level, stiffness)[0]
    return z[0] + way[0] + abs(way[0]) * held / level, 0.0, 0.0


def driving(state: FloatArray, parameters: FloatArray) -> None:
    ball_joint.step(state, parameters)
    state[sv.FORCE] *= -1.0


def dahl() -> Callable[[FloatArray, FloatArray], None]:
    memory = joint("dahl", {"printed_play": 0.0})

    def step(state: FloatArray, _: FloatArray) -> None:
        ball_joint.step(state, memory)

    return step


DEFECTS = {
    "integrators": {
        "ball joint tilted in one step off its play, through it and against the other edge": Defect(
            "explicit Euler", euler
        ),
    },
    "effects": {
        **dict.fromkeys(
            (
                f"a hand that trembles in the play of a ball joint gains nothing, {law}"
                for law in ("kikuuwe", "dahl", "lugre")
            ),
            Defect("a force along the motion", driving),
        ),
        "a still hand on the edge of an encoder count keeps the sign of the joints' force": Defect(
            "Dahl's law, which creeps to zero", dahl()
        ),
    },
}
