"""Defects of tissue along the needle: forces that jump, cut twice, drift, linger."""

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.effects import cutting, puncture, shaft_friction
from app.studies.hard_cases.tissue_laws import MEMBRANE
from tests.hard.defects import Defect


def unlimited(state: FloatArray, parameters: FloatArray) -> None:
    puncture.step(state, parameters)
    x = max(float(state[sv.PLANT_DEPTH]), 0.0)
    state[sv.AXIAL_FORCE] = MEMBRANE.indentation_hardening * x * x


def forgetful(state: FloatArray, parameters: FloatArray) -> None:
    parameters[parameters > 0.03] *= 0.0 if state[sv.PLANT_DEPTH] < 0.0 else 1.0
    cutting.step(state, parameters)
    state[sv.AXIAL_FORCE] += 0.2 if state[sv.PLANT_DEPTH] > 0.0 else 0.0


def by_depth(state: FloatArray, parameters: FloatArray) -> None:
    shaft_friction.step(state, parameters)
    state[sv.AXIAL_FORCE] *= 1.01


def lingering(state: FloatArray, parameters: FloatArray) -> None:
    parameters[:] = 1e-310


DEFECTS = {
    "effects": {
        "a membrane that a tick goes far beyond holds no more than what tears it": Defect(
            "a spring without end", unlimited
        ),
        "the second way into one hole cuts nothing": Defect("it forgets its ways", forgetful),
        "friction of what is inserted does not drift over many ways in and out": Defect(
            "a hundredth too much", by_depth
        ),
        "hours of rest leave no subnormal force in what relaxes": Defect(
            "nothing is snapped to zero", lingering
        ),
    },
}
