"""The tick of a robot that is being commissioned: no force law, only the service stage.

The service stage adds the small test forces and torques of the routines.
"""

from dataclasses import dataclass
from math import isfinite
from typing import Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.device.control.corrections import Corrections
from app.device.control.depth_interval import DepthInterval
from app.device.control.governor import SpeedGovernor
from app.device.control.kinematics import Kinematics
from app.device.control.safety import Safety
from app.device.control.table import Table
from app.device.control.transmission import Transmission
from app.device.control.vectors import shrink_kernel
from app.device.control.velocity import VelocityFilter
from app.device.links.link import Link
from app.mechanisms.profile import DeviceProfile

LARGEST_FORCE: Final = 1.0
"""Largest test force at the hub [N]: what an unverified robot may give."""

LARGEST_TORQUE: Final = 0.03
"""Largest test torque of a joint [N·m]: about 0.3 N at the hand."""


class _ServicePlaces(NamedTuple):
    """Bounds of `Service`, and the force now."""

    force: int
    torque: int
    rate: int
    x: int = 0
    y: int = 0
    z: int = 0


_AT: Final = numbered(_ServicePlaces)


@njit
def _bounded(value: float, limit: float) -> float:
    return min(max(value, -limit), limit) if isfinite(value) else 0.0


@njit
def _follow(state: FloatArray, p: FloatArray, x: float, y: float, z: float) -> None:
    """Move the force towards (x, y, z) at a limited rate; towards zero at once."""
    if x == 0.0 and y == 0.0 and z == 0.0:
        p[_AT.x], p[_AT.y], p[_AT.z] = 0.0, 0.0, 0.0
        return
    step = p[_AT.rate] * max(state[sv.DT], 0.0)
    dx, dy, dz = x - p[_AT.x], y - p[_AT.y], z - p[_AT.z]
    scale = shrink_kernel(dx, dy, dz, step)
    p[_AT.x] += scale * dx
    p[_AT.y] += scale * dy
    p[_AT.z] += scale * dz


@stage
def service_stage(state: FloatArray, p: FloatArray) -> None:
    """Add TEST_X, TEST_Y, TEST_Z to FORCE_* and TEST_LEFT, TEST_RIGHT to JOINT_*, all bounded."""
    if not state[sv.ENABLED] > 0.5:
        p[_AT.x], p[_AT.y], p[_AT.z] = 0.0, 0.0, 0.0
        return
    x, y, z = state[sv.TEST_X], state[sv.TEST_Y], state[sv.TEST_Z]
    if not (isfinite(x) and isfinite(y) and isfinite(z)):
        x, y, z = 0.0, 0.0, 0.0
    scale = shrink_kernel(x, y, z, p[_AT.force])
    _follow(state, p, scale * x, scale * y, scale * z)
    state[sv.FORCE_X] += p[_AT.x]
    state[sv.FORCE_Y] += p[_AT.y]
    state[sv.FORCE_Z] += p[_AT.z]
    state[sv.JOINT_LEFT] += _bounded(state[sv.TEST_LEFT], p[_AT.torque])
    state[sv.JOINT_RIGHT] += _bounded(state[sv.TEST_RIGHT], p[_AT.torque])


@dataclass(frozen=True, slots=True)
class Service:
    """Bounds of the commissioning routines.

    Attributes:
        force: largest test force [N].
        torque: largest test torque of a joint [N·m].
        rate: how fast the force comes up [N/s]; it goes to zero at once.
    """

    force: float = LARGEST_FORCE
    torque: float = LARGEST_TORQUE
    rate: float = 2.0

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = packed(_AT, force=self.force, torque=self.torque, rate=self.rate)
        return Stage("service", service_stage, parameters)


def commissioning_table(
    profile: DeviceProfile, link: Link, corrections: Corrections | None = None
) -> Table:
    """Table of a tick: link read, corrections, velocity, kinematics, service, transmission,
    speed governor, safety, link write.

    Args:
        profile: the robot's numbers.
        link: the robot's two ends.
        corrections: of its encoders and gauge; nothing is corrected by default.
    """
    return Table.of(
        [
            *link.read,
            (corrections or Corrections()).stage(),
            VelocityFilter().stage(),
            DepthInterval.of(profile).stage(),
            Kinematics.of(profile).stage(),
            Service().stage(),
            Transmission.of(profile).stage(),
            SpeedGovernor.of(profile).stage(),
            Safety.of(profile).stage(),
        ],
        link.write,
    )
