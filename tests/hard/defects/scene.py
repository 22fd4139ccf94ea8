"""Defects of the effects' hard cases: forces that jump, grow, creep, or forget."""

from collections.abc import Callable
from math import nan

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.effects import breathing, lateral_tissue, shaft_friction
from app.studies.hard_cases.scene import varying_breaths
from tests.hard.defects import Defect


def at_the_tip(state: FloatArray, parameters: FloatArray) -> None:
    # The whole layer's stiffness as if it stood at the tip: d³, not d³/3.
    lateral_tissue.step(state, parameters)
    state[sv.FORCE] *= 3.0


def thick(state: FloatArray, parameters: FloatArray) -> None:
    lateral_tissue.step(state, parameters)
    state[sv.FORCE] += 1e-3


def switching(state: FloatArray, parameters: FloatArray) -> None:
    lateral_tissue.step(state, parameters)
    state[sv.FORCE] *= 10.0 if state[sv.DEPTH] > 0.05 else 1.0


def unbounded(state: FloatArray, parameters: FloatArray) -> None:
    lateral_tissue.step(state, parameters)
    state[sv.FORCE] *= 0.02 / max(state[sv.L_OUT], 1e-9)


def explicit_dahl(stiffness: float) -> Callable[[FloatArray, FloatArray], None]:
    """Dahl by explicit Euler: unstable for |v| > 2 g / (σ T)."""
    memory = {"force": 0.0, "depth": nan}

    def step(state: FloatArray, parameters: FloatArray) -> None:
        depth = float(state[sv.PLANT_DEPTH])
        travel = depth - memory["depth"] if memory["depth"] == memory["depth"] else 0.0
        memory["depth"], level = depth, 10.57 * depth
        rate = stiffness * depth * (travel - abs(travel) * memory["force"] / level)
        memory["force"] = float(np.clip(memory["force"] + rate, -1e200, 1e200))
        state[sv.AXIAL_FORCE] += memory["force"]

    return step


def creeping(state: FloatArray, parameters: FloatArray) -> None:
    for _ in range(2):
        state[sv.AXIAL_FORCE] = 0.0
        shaft_friction.step(state, parameters)
        state[sv.PLANT_DEPTH] -= 1e-12


def decaying(state: FloatArray, parameters: FloatArray) -> None:
    parameters[:] = 1e-310


def single(state: FloatArray, parameters: FloatArray) -> None:
    kept = state[sv.TIME]
    state[sv.TIME] = np.float32(kept)
    breathing.step(state, parameters)
    state[sv.TIME] = kept


def forgetful() -> Callable[[FloatArray, FloatArray], None]:
    other, looks = varying_breaths(draws=2.0), [0]

    def step(state: FloatArray, parameters: FloatArray) -> None:
        looks[0] += 1
        breathing.step(state, parameters if looks[0] % 2 else other)

    return step


DEFECTS = {
    "effects": {
        "side force 120 mm deep where the needle is tilted by 1e-6 rad": Defect(
            "d³ instead of d³/3", at_the_tip
        ),
        "layers of no thickness count for nothing": Defect("they count with 1 mN", thick),
        "grazing the boundary of two layers does not chatter": Defect(
            "the deeper layer's stiffness for the whole needle", switching
        ),
        "a hub at the fulcrum has the force of the shortest lever": Defect(
            "moment over L_out", unbounded
        ),
        **{
            f"friction at 300 mm/s, {stiffness:g} N/m², steps of {step} ms": Defect(
                "explicit Euler", explicit_dahl(stiffness)
            )
            for stiffness in (1e6, 1e9)
            for step in (1, 5)
        },
        "friction of a needle at rest holds and does not creep": Defect(
            "a depth that trembles by 1 pm", creeping
        ),
        "a measured depth at rest leaves no subnormal speed behind": Defect(
            "nothing is snapped to zero", decaying
        ),
        "where the target is after twelve days of breathing": Defect(
            "time in single precision", single
        ),
        "breaths that vary go over into each other without a jump": Defect(
            "each look draws its own breaths", forgetful()
        ),
    },
}
