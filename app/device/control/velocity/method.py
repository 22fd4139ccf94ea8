"""The velocity estimators by the names that a device profile chooses from."""

from collections.abc import Callable
from math import pi
from typing import Any, Final

from app.core.arrays import FloatArray
from app.device.control.velocity.alpha_beta import AlphaBeta
from app.device.control.velocity.difference import BackwardDifference
from app.device.control.velocity.filtered import VelocityFilter
from app.device.control.velocity.foaw import AdaptiveWindow
from app.device.control.velocity.kalman import Kalman
from app.mechanisms.profile import DeviceProfile, VelocityMethod

_Triple = tuple[str, Any, FloatArray]

_STAGES: Final[dict[VelocityMethod, Callable[[float], _Triple]]] = {
    VelocityMethod.BACKWARD_DIFFERENCE: lambda count: BackwardDifference().stage(),
    VelocityMethod.FILTERED: lambda count: VelocityFilter().stage(),
    VelocityMethod.ALPHA_BETA: lambda count: AlphaBeta().stage(),
    VelocityMethod.FOAW: lambda count: AdaptiveWindow(count).stage(),
    VelocityMethod.KALMAN: lambda count: Kalman(count).stage(),
}


def velocity_stage(
    profile: DeviceProfile, method: VelocityMethod | None = None
) -> tuple[str, Any, FloatArray]:
    """Return an estimator's stage for a loop's table, with memory of its own.

    It reads Q_*, Q_TIME, TIME and DT, and writes QD_*: zero at first and after a bad reading.

    Args:
        profile: gives the encoders' resolution, and the estimator.
        method: another estimator than the profile's.
    """
    return _STAGES[method or profile.velocity](2.0 * pi / profile.encoder.counts_per_turn)
