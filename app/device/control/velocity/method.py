"""The velocity estimators by name, and the one that is used unless another is asked for."""

from collections.abc import Callable
from enum import StrEnum
from math import pi
from typing import Any, Final

from app.core.arrays import FloatArray
from app.device.control.velocity.alpha_beta import AlphaBeta
from app.device.control.velocity.difference import BackwardDifference
from app.device.control.velocity.filtered import VelocityFilter
from app.device.control.velocity.foaw import AdaptiveWindow
from app.device.control.velocity.kalman import Kalman
from app.mechanisms.profile import DeviceProfile


class VelocityMethod(StrEnum):
    """How joint velocities come from encoder angles.

    `BACKWARD_DIFFERENCE`: of the last two readings (the thesis). `FILTERED`: the same through a
    low-pass of 50 Hz. `ALPHA_BETA`: tracker with fixed gains. `FOAW`: slope of the longest line
    within one count. `KALMAN`: tracker with gains from the encoder's resolution.
    """

    BACKWARD_DIFFERENCE = "backward_difference"
    FILTERED = "filtered"
    ALPHA_BETA = "alpha_beta"
    FOAW = "foaw"
    KALMAN = "kalman"


DEFAULT_VELOCITY: Final = VelocityMethod.FOAW
"""Chosen by measurement: `acus study velocity`, docs/studies.md."""

_Triple = tuple[str, Any, FloatArray]

_STAGES: Final[dict[VelocityMethod, Callable[[float], _Triple]]] = {
    VelocityMethod.BACKWARD_DIFFERENCE: lambda count: BackwardDifference().stage(),
    VelocityMethod.FILTERED: lambda count: VelocityFilter().stage(),
    VelocityMethod.ALPHA_BETA: lambda count: AlphaBeta().stage(),
    VelocityMethod.FOAW: lambda count: AdaptiveWindow(count).stage(),
    VelocityMethod.KALMAN: lambda count: Kalman(count).stage(),
}


def velocity_stage(method: VelocityMethod, profile: DeviceProfile) -> tuple[str, Any, FloatArray]:
    """Return an estimator's stage for a loop's table, with memory of its own.

    It reads Q_*, Q_TIME, TIME and DT, and writes QD_*: zero at first and after a bad reading.

    Args:
        method: which estimator.
        profile: gives the encoders' resolution.
    """
    return _STAGES[method](2.0 * pi / profile.encoder.counts_per_turn)
