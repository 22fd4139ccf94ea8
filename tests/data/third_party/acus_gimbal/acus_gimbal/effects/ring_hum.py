"""Hum of the rings' motors: a small side force at one frequency."""

from collections.abc import Mapping
from math import isfinite, pi, sin
from typing import Any, Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import numbered, packed
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Hum of the rings",
    "reads": ("time",),
    "writes": ("force",),
    "consumers": ("device axis lateral",),
    "needs": (),
    "models": {"sine": "one frequency, exact in time"},
    "energy": ("active", "driven by time"),
    "cost_class": "A",
    "parameters": {
        "amplitude": (0.1, "N", 0.0, 1.0, "largest force"),
        "frequency": (50.0, "Hz", 1.0, 200.0, "of the hum"),
    },
}


class _Places(NamedTuple):
    """Largest force [N] and angular frequency [rad/s]."""

    amplitude: int
    rate: int


_AT: Final = numbered(_Places)


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters."""
    return packed(_AT, amplitude=values["amplitude"], rate=2.0 * pi * values["frequency"])


@stage
def step(state: FloatArray, p: FloatArray) -> None:
    """Add the force along y."""
    if isfinite(state[sv.TIME]):
        state[sv.FORCE_Y] += p[_AT.amplitude] * sin(p[_AT.rate] * state[sv.TIME])
