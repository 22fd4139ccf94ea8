"""Corrections of one device: encoder offsets and the gauge, applied to what the link reads.

The one place for what was measured on a robot; links speak its profile. There are no signs among
them: an encoder or motor that turns the wrong way is refused by the sign check and put right at
the robot, so that no record can turn a force round.
"""

from math import isfinite
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.device.errors import DeviceError

_LEFT, _RIGHT, _ZERO, _SCALE, _TIME, _OUT_LEFT, _OUT_RIGHT, _OUT_GAUGE, _SIZE = range(9)


@stage
def corrections_stage(state: FloatArray, p: FloatArray) -> None:
    """Add the offsets to Q_*; correct GAUGE_FORCE.

    A link without news leaves the slots as they are: what this stage wrote is not corrected a
    second time. (Joint angles are whole counts, so an equal one may be new: Q_TIME tells.)
    """
    old = state[sv.Q_TIME] == p[_TIME]
    joints = state[sv.Q_LEFT] == p[_OUT_LEFT] and state[sv.Q_RIGHT] == p[_OUT_RIGHT]
    if not (old and joints):
        state[sv.Q_LEFT] += p[_LEFT]
        state[sv.Q_RIGHT] += p[_RIGHT]
    if state[sv.GAUGE] != 0.0 and not (old and state[sv.GAUGE_FORCE] == p[_OUT_GAUGE]):
        state[sv.GAUGE_FORCE] = (state[sv.GAUGE_FORCE] - p[_ZERO]) * p[_SCALE]
    p[_OUT_LEFT], p[_OUT_RIGHT] = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    p[_OUT_GAUGE] = state[sv.GAUGE_FORCE]
    p[_TIME] = state[sv.Q_TIME]


class Corrections:
    """What is added to a link's readings; commissioning may change it while the loop runs.

    Args:
        offsets: added to the joint angles of the link (left, right) [rad].
        gauge: reading of the gauge without a force [N], and the factor on what is above it.
    """

    def __init__(
        self,
        offsets: tuple[float, float] = (0.0, 0.0),
        gauge: tuple[float, float] = (0.0, 1.0),
    ) -> None:
        self._parameters = np.zeros(_SIZE)
        self._parameters[_TIME] = self._parameters[_OUT_GAUGE] = np.nan
        self.set_offsets(*offsets)
        self.set_gauge(*gauge)

    @property
    def offsets(self) -> tuple[float, float]:
        """Offsets in use (left, right) [rad]."""
        return float(self._parameters[_LEFT]), float(self._parameters[_RIGHT])

    @property
    def gauge(self) -> tuple[float, float]:
        """Zero [N] and factor of the gauge in use."""
        return float(self._parameters[_ZERO]), float(self._parameters[_SCALE])

    def set_offsets(self, left: float, right: float) -> None:
        """Use other offsets [rad] from the next reading on; do so at zero force only.

        Raises:
            DeviceError: if one is not finite; those in use stay.
        """
        self._parameters[_LEFT : _RIGHT + 1] = _finite("encoder offsets [rad]", left, right)

    def set_gauge(self, zero: float, scale: float) -> None:
        """Use another zero [N] and factor of the gauge from the next reading on.

        Raises:
            DeviceError: if one is not finite; those in use stay.
        """
        self._parameters[_ZERO : _SCALE + 1] = _finite("zero and factor of the gauge", zero, scale)

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table; it belongs right after the link's read stages."""
        return "corrections", corrections_stage, self._parameters


def _finite(what: str, first: float, second: float) -> tuple[float, float]:
    if not (isfinite(first) and isfinite(second)):
        raise DeviceError(f"{what} are {first} and {second}; both must be finite: calibrate anew")
    return first, second
