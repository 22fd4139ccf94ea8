"""The pantograph that an Inverse3 plays: its pose with the hub at the cursor, and a force there."""

from __future__ import annotations

from math import cos, hypot, isfinite, radians, sin, sqrt
from typing import NamedTuple

from app.device.links.inverse_service import NO_FORCE, Cursor
from app.device.links.link import Hub
from app.device.readiness import UNVERIFIED_FORCE
from app.mechanisms import lever
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.profile import PantographProfile
from app.mechanisms.status import OK

SHORTEST = 0.03
"""A hub this near the entry holds no needle [m]."""


class Played(NamedTuple):
    """Hub, the pantograph's joints there [rad], its lever [m] and dP3/dq [m/rad]."""

    hub: Hub
    q: tuple[float, float]
    l_in: float
    jacobian: tuple[float, float, float, float]


class Impersonated:
    """The pantograph that is played, and where its entry stands in the service's frame.

    Args:
        profile: of a pantograph.
        fulcrum: P_I in the service's frame [m].

    Attributes:
        fulcrum: the same.
    """

    def __init__(self, profile: PantographProfile, fulcrum: tuple[float, float, float]) -> None:
        part, self._centre, self.fulcrum = profile.geometry, profile.geometry.fulcrum, fulcrum
        self._links = part.proximal, part.distal, part.base
        self._limit = radians(profile.tilt_limit_deg)

    def pose(self, cursor: Cursor) -> Played | None:
        """Return the pose with the hub at the cursor; None where nobody could say one."""
        x, y, z = (entry - there for entry, there in zip(self.fulcrum, cursor[:3], strict=True))
        l_out = sqrt(x * x + y * y + z * z)
        across = hypot(x, y)
        if not l_out > 0.0:
            return None
        inside = l_out >= SHORTEST and -z >= l_out * cos(self._limit)
        if inside:
            axis = x / l_out, y / l_out, z / l_out
        elif across > 0.0:
            size = sin(self._limit) / across
            axis = size * x, size * y, -cos(self._limit)
        else:
            return None
        fx, fy, fz = self._centre
        l_in = -fz / axis[2]
        px, py = fx + l_in * axis[0], fy + l_in * axis[1]
        status, left, right = kernels.inverse_kernel(px, py, *self._links, 1.0, -1.0)
        if status != OK:
            return None
        status, *rates = kernels.jacobian_kernel(left, right, px, py, *self._links)
        if status != OK:
            return None
        jxl, jxr, jyl, jyr = rates
        return Played(Hub(axis, l_out, inside), (left, right), l_in, (jxl, jxr, jyl, jyr))

    def force(self, pose: Played, torques: tuple[float, float]) -> tuple[float, float, float]:
        """Return the force at the hub [N] that joint torques [N·m] are, at most what is allowed."""
        if not pose.hub.inside:
            return NO_FORCE
        status, gx, gy = lever.tool_force_kernel(*torques, *pose.jacobian)
        if status != OK:
            return NO_FORCE
        x, y, z = lever.felt_kernel(gx, gy, *pose.hub.axis, pose.l_in, pose.hub.l_out)
        size = sqrt(x * x + y * y + z * z)
        if not isfinite(size):
            return NO_FORCE
        share = min(1.0, UNVERIFIED_FORCE / size) if size > 0.0 else 0.0
        return share * x, share * y, share * z
