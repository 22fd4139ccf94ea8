"""Defects of the integrators' hard cases: Euler's steps, joints each on its own."""

from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from tests.hard.defects import Defect


def euler(force: float, travel: float, level: float, stiffness: float) -> float:
    return force + stiffness * travel * (1.0 - force / level)


def backward(force: float, travel: float, level: float, stiffness: float) -> float:
    return (force + stiffness * travel) / (1.0 + stiffness * travel / level) + 1e-12


def one_by_one(*v: float) -> tuple[float, float]:
    a11, _, a22, b1, b2, _, _, most = v
    return (b1 + most) / a11, (b2 - most) / a22


def explicit_hand(stage: Any) -> Any:
    # The same mass and spring by explicit Euler, in the same substeps.

    def step(state: FloatArray, parameters: FloatArray) -> None:
        for _ in range(max(1, round(state[sv.DT] / 0.5e-3))):
            stretch = 0.05 - state[sv.PLANT_DEPTH]
            depth = state[sv.PLANT_DEPTH] + 0.5e-3 * state[sv.PLANT_DEPTH_RATE]
            state[sv.PLANT_DEPTH_RATE] += 0.5e-3 * 5e5 * stretch / 0.05
            state[sv.PLANT_DEPTH] = float(np.clip(depth, -1e100, 1e100))

    return step


DEFECTS = {
    "integrators": {
        "exponential step of Dahl's friction over 1e-12 m": Defect("implicit Euler", backward),
        **dict.fromkeys(
            (
                "exponential step of Dahl's friction over 0.3 mm",
                "exponential step of Dahl's friction over 0.3 mm, as stiff as 5e8 N/m",
            ),
            Defect("explicit Euler", euler),
        ),
        "a thousand steps of Dahl's friction are one": Defect(
            "implicit Euler", lambda f, x, g, s: (f + s * x) / (1.0 + s * x / g)
        ),
        "dry friction of two joints that are coupled to 95 %": Defect(
            "each joint on its own", one_by_one
        ),
        **dict.fromkeys(
            (f"a hand of 5e5 N/m without damping, at ticks of {step} ms" for step in (1, 5)),
            Defect("explicit Euler", explicit_hand),
        ),
    },
}
