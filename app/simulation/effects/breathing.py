"""Breathing moves the target: Lujan's periodic asymmetric waveform with hysteresis.

    shift(t) = b(π t / T) · (A_SI inferior + A_LR left) + b(π t / T - φ) · A_AP anterior,
    b(x) = sin^{2n}(x).

Lujan 1999 writes -A cos^{2n}(π t / T - φ0); φ0 = π/2 starts at the end of exhalation, where the
organ rests longest and the CT is taken. The anterior part lags by φ, so the path is a loop.
Median amplitudes of the liver: SI 11.9, AP 3.8, LR 1.3 mm.

Driven by time, so declared active: it is not counted in energy balances.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Breathing moves the target",
    "reads": ("time",),
    "writes": ("target_shift",),
    "consumers": ("view target_motion", "score of tip to target"),
    "needs": (),
    "models": {"lujan": "sin^2n along inferior and left, lagging along anterior; exact in time"},
    "energy": ("active", "driven by time"),
    "cost_class": "A",
    "parameters": {
        "superior_inferior": (0.0119, "m", 0.0, 0.06, "amplitude towards the feet"),
        "anterior_posterior": (0.0038, "m", 0.0, 0.03, "amplitude towards the front"),
        "left_right": (0.0013, "m", 0.0, 0.03, "amplitude towards the patient's left"),
        "period": (4.0, "s", 0.5, 60.0, "of one breath"),
        "shape": (2.0, "-", 1.0, 10.0, "n of sin^2n: higher rests longer at exhalation"),
        "anterior_lag": (0.392699, "rad", 0.0, 1.5708, "phase by which the anterior part lags"),
    },
}


class _BreathingPlaces(NamedTuple):
    """Constants, when the first breath began [s], and the two displacements [m]."""

    period: int
    shape: int
    lag: int
    start: int
    in_phase_x: int
    in_phase_y: int
    in_phase_z: int
    lagging_x: int
    lagging_y: int
    lagging_z: int


_AT: Final = numbered(_BreathingPlaces)


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh parameters array; breathing starts at exhalation at its first tick."""
    left, posterior, superior = binding.scene.R_world_patient.T
    in_phase = values["left_right"] * left - values["superior_inferior"] * superior
    lagging = -values["anterior_posterior"] * posterior
    return packed(
        _AT,
        period=values["period"],
        shape=values["shape"],
        lag=values["anterior_lag"],
        start=np.nan,
        in_phase_x=in_phase[0],
        in_phase_y=in_phase[1],
        in_phase_z=in_phase[2],
        lagging_x=lagging[0],
        lagging_y=lagging[1],
        lagging_z=lagging[2],
    )


@njit
def lujan(phase: float, shape: float) -> float:
    """sin^{2n}(phase), in [0, 1]; for a whole n by multiplying, four times faster than a power."""
    square = np.sin(phase) ** 2
    if shape != np.floor(shape):
        return square**shape
    result = square
    for _ in range(int(shape) - 1):
        result *= square
    return result


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the displacement of the target to TARGET_SHIFT_*."""
    time = state[sv.TIME]
    if not np.isfinite(time):
        return
    if np.isnan(parameters[_AT.start]):
        parameters[_AT.start] = time
    breaths = (time - parameters[_AT.start]) / parameters[_AT.period]
    phase = np.pi * (breaths - np.floor(breaths))  # one breath: hours lose no digits
    in_phase = lujan(phase, parameters[_AT.shape])
    lagging = lujan(phase - parameters[_AT.lag], parameters[_AT.shape])
    for axis in range(3):
        state[sv.TARGET_SHIFT_X + axis] += (
            in_phase * parameters[_AT.in_phase_x + axis]
            + lagging * parameters[_AT.lagging_x + axis]
        )
