"""Corrections of one device: encoder offsets and the gauge, applied to what the link reads.

The one place for what was measured on a robot; links speak its profile. There are no signs among
them: an encoder or motor that turns the wrong way is refused by the sign check and put right at
the robot, so that no record can turn a force round.
"""

from math import isfinite
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.messages import sentence
from app.core.parameters import Stage, numbered, packed
from app.device.errors import DeviceError


class _CorrectionsPlaces(NamedTuple):
    """Offsets [rad], zero [N] and factor of the gauge, and what was written last."""

    left: int
    right: int
    zero: int
    scale: int
    time: int = 0
    out_left: int = 0
    out_right: int = 0
    out_gauge: int = 0


_AT: Final = numbered(_CorrectionsPlaces)


@stage
def corrections_stage(state: FloatArray, p: FloatArray) -> None:
    """Add the offsets to Q_*; correct GAUGE_FORCE.

    Without a new reading a link leaves the slots as they are: what this stage wrote is not
    corrected a second time. (Joint angles are whole counts, so an equal one may be new: Q_TIME
    tells.)
    """
    old = state[sv.Q_TIME] == p[_AT.time]
    joints = state[sv.Q_LEFT] == p[_AT.out_left] and state[sv.Q_RIGHT] == p[_AT.out_right]
    if not (old and joints):
        state[sv.Q_LEFT] += p[_AT.left]
        state[sv.Q_RIGHT] += p[_AT.right]
    if state[sv.GAUGE] != 0.0 and not (old and state[sv.GAUGE_FORCE] == p[_AT.out_gauge]):
        state[sv.GAUGE_FORCE] = (state[sv.GAUGE_FORCE] - p[_AT.zero]) * p[_AT.scale]
    p[_AT.out_left], p[_AT.out_right] = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    p[_AT.out_gauge] = state[sv.GAUGE_FORCE]
    p[_AT.time] = state[sv.Q_TIME]


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
        self._parameters = packed(
            _AT, left=0.0, right=0.0, zero=0.0, scale=1.0, time=np.nan, out_gauge=np.nan
        )
        self.set_offsets(*offsets)
        self.set_gauge(*gauge)

    @property
    def offsets(self) -> tuple[float, float]:
        """Offsets in use (left, right) [rad]."""
        return float(self._parameters[_AT.left]), float(self._parameters[_AT.right])

    @property
    def gauge(self) -> tuple[float, float]:
        """Zero [N] and factor of the gauge in use."""
        return float(self._parameters[_AT.zero]), float(self._parameters[_AT.scale])

    def set_offsets(self, left: float, right: float) -> None:
        """Use other offsets [rad] from the next reading on; do so at zero force only.

        Raises:
            DeviceError: if one is not finite; those in use stay.
        """
        self._parameters[_AT.left], self._parameters[_AT.right] = _finite(
            "encoder offsets [rad]", left, right
        )

    def set_gauge(self, zero: float, scale: float) -> None:
        """Use another zero [N] and factor of the gauge from the next reading on.

        Raises:
            DeviceError: if one is not finite; those in use stay.
        """
        self._parameters[_AT.zero], self._parameters[_AT.scale] = _finite(
            "zero and factor of the gauge", zero, scale
        )

    def stage(self) -> Stage:
        """Return the stage for a loop's table; it belongs behind the judgement of what was read."""
        return Stage("corrections", corrections_stage, self._parameters)


def _finite(what: str, first: float, second: float) -> tuple[float, float]:
    if not (isfinite(first) and isfinite(second)):
        raise DeviceError(
            sentence(
                "{quantities} are {first} and {second}; both must be finite: calibrate anew",
                quantities=what,
                first=first,
                second=second,
            )
        )
    return first, second
