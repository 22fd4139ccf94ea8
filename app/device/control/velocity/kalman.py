"""Kalman filter for constant velocity, time-varying, quantisation taken as white noise Δ²/12.

State (angle, velocity) driven by white acceleration of spectral density q [rad²/s³]: over a time h
its covariance is q [[h³/3, h²/2], [h²/2, h]] (Bar-Shalom, Li, Kirubarajan 2001, section 6.2.2). The
covariance is carried along, so first readings, late ticks and gaps weigh as they should.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.control.velocity.readings import (
    FREE,
    JUMP,
    KEEP,
    RESTART,
    next_reading,
    plausible,
)

_NOISE: Final = FREE
_DENSITY: Final = FREE + 1
_JOINTS: Final = FREE + 2
_ANGLE, _AA, _AV, _VV, _JOINT_SIZE = range(5)
_SPEED_AT_FIRST: Final = 1.0  # [rad/s] standard deviation of the velocity at the first reading


@njit
def _start(p: FloatArray, m: int, reading: float) -> None:
    p[m + _ANGLE] = reading
    p[m + _AA], p[m + _AV], p[m + _VV] = p[_NOISE], 0.0, _SPEED_AT_FIRST * _SPEED_AT_FIRST


@njit
def _update(p: FloatArray, m: int, reading: float, velocity: float, h: float) -> float:
    q, noise = p[_DENSITY], p[_NOISE]
    residual = reading - (p[m + _ANGLE] + velocity * h)
    if not abs(residual) < JUMP:
        _start(p, m, reading)
        return 0.0
    aa, av, vv = p[m + _AA], p[m + _AV], p[m + _VV]
    aa += h * (2.0 * av + h * (vv + q * h / 3.0))
    av += h * (vv + 0.5 * q * h)
    vv += q * h
    gain_a, gain_v = aa / (aa + noise), av / (aa + noise)
    p[m + _ANGLE] = reading - (1.0 - gain_a) * residual
    # (1 - gain) keeps the variances positive whatever is rounded: aa (1 - gain_a) = gain_a noise.
    p[m + _AA], p[m + _AV] = gain_a * noise, gain_v * noise
    p[m + _VV] = max(vv - gain_v * av, q * h * 1e-6)
    return plausible(velocity + gain_v * residual)


@stage
def kalman_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_*."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    left, right = _JOINTS, _JOINTS + _JOINT_SIZE
    if action == RESTART:
        _start(p, left, state[sv.Q_LEFT])
        _start(p, right, state[sv.Q_RIGHT])
        return
    state[sv.QD_LEFT] = _update(p, left, state[sv.Q_LEFT], state[sv.QD_LEFT], elapsed)
    state[sv.QD_RIGHT] = _update(p, right, state[sv.Q_RIGHT], state[sv.QD_RIGHT], elapsed)


@dataclass(frozen=True, slots=True)
class Kalman:
    """Kalman filter for constant velocity.

    Attributes:
        count: one encoder count Δ [rad]; the readings' variance is Δ²/12.
        density: spectral density of the acceleration that is expected [rad²/s³].
    """

    count: float
    density: float = 0.1

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = np.zeros(_JOINTS + 2 * _JOINT_SIZE)
        parameters[_NOISE] = self.count**2 / 12.0
        parameters[_DENSITY] = self.density
        return "velocity", kalman_stage, parameters
