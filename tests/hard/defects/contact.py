"""Defects of the hard cases along the needle: relaxing tissue, membranes, bone."""

from math import exp
from typing import Any

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.effects import bone_contact, relaxation
from tests.hard.defects import Defect


def plain(stretch: float, change: float, h: float, tau: float) -> float:
    return stretch * exp(-h / tau) + change * tau / h * (1.0 - exp(-h / tau))


def implicit(_: str, *given: float) -> Any:
    return bone_contact.coefficients("implicit", *given)


def pulling(state: FloatArray, parameters: FloatArray) -> None:
    bone_contact.step(state, parameters)
    state[sv.AXIAL_FORCE] += 1e4 * min(state[sv.PLANT_DEPTH] - 0.05, 0.0)


def forgetful(state: FloatArray, parameters: FloatArray) -> None:
    state[sv.AXIAL_FORCE] += 2300.0 * (state[sv.PLANT_DEPTH] - 0.02) ** 2 * 2.0


DEFECTS = {
    "integrators": {
        "spring of relaxing tissue after a millionth of its time": Defect(
            "1 - exp(-h/τ), which cancels", plain
        ),
        "spring of relaxing tissue after a thousand times its time": Defect(
            "implicit midpoint", relaxation.midpoint
        ),
        **dict.fromkeys(
            (
                "bone of 1 N/m under 0.05 kg, exact over 1 ms",
                "bone of 40000 N/m under 0.05 kg, exact over 1 ms",
                "bone of 500000 N/m under 5 kg, exact over 1 ms",
            ),
            Defect("linearly implicit Euler", implicit),
        ),
    },
    "effects": {
        "a tip 1 µm above bone feels nothing of it, not even when it leaves": Defect(
            "a spring that pulls as well", pulling
        ),
        "a membrane gives way at its force, whatever the ticks and the trembling": Defect(
            "a spring that never gives way", forgetful
        ),
    },
}
