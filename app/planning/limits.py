"""What reach asks of a device: a few numbers and one question."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.mechanisms.profile import DeviceProfile

if TYPE_CHECKING:
    from app.mechanisms.remote_centre import RemoteCentre


@dataclass(frozen=True, slots=True)
class ReachLimits:
    """The part of a device profile that decides whether a path can be followed.

    Attributes:
        fulcrum: P_I in world [m], shape (3,).
        tilt_limit: largest angle between needle and vertical [rad].
        depth_limit: deepest position of the tip beyond the fulcrum [m].
        in_workspace: whether the machine can point the needle so that it crosses z = 0 at (x, y)
            [m]; there a pantograph holds it.
    """

    fulcrum: FloatArray
    tilt_limit: float
    depth_limit: float
    in_workspace: Callable[[float, float], bool]

    @classmethod
    def of(cls, profile: DeviceProfile) -> ReachLimits:
        """Take the limits out of a device profile."""
        return cls(
            fulcrum=frozen(profile.fulcrum, (3,), "fulcrum"),
            tilt_limit=profile.tilt_limit,
            depth_limit=profile.depth_range[1],
            in_workspace=in_workspace(profile),
        )

    def tool_point(self, axis: FloatArray) -> tuple[float, float] | None:
        """Return where the needle crosses the plane z = 0 [m]; None if it never does.

        Args:
            axis: needle direction, hub to tip, unit vector.
        """
        if axis[2] >= -1e-9:
            return None
        x, y, _ = self.fulcrum - axis * (self.fulcrum[2] / axis[2])
        return float(x), float(y)

    def holds(self, axis: FloatArray, margin: float = 0.0) -> bool:
        """Return whether the needle can point along `axis`, and `margin` [rad] around it."""
        if tilt_of(axis) > self.tilt_limit - margin + 1e-9:
            return False
        around = cone(axis, margin) if margin > 0.0 else [axis]
        points = [self.tool_point(direction) for direction in around]
        return all(point is not None and self.in_workspace(*point) for point in points)


def in_workspace(profile: DeviceProfile) -> Callable[[float, float], bool]:
    """Return what tells whether the machine can point the needle at (x, y) [m] in z = 0.

    Where links would have to pass through each other, or the machine would have to be put together
    otherwise, it cannot: only the branch that it is built in counts.
    """
    machine: RemoteCentre | None = None

    def holds(x: float, y: float) -> bool:
        nonlocal machine
        if machine is None:
            machine = profile.machine  # compiled: loaded when first asked
        return machine.holds(np.array([x, y, 0.0]) - machine.centre)

    return holds


def tilt_of(axis: FloatArray) -> float:
    """Angle between a direction and straight down [rad], 0 ... π."""
    return float(np.arctan2(np.hypot(axis[0], axis[1]), -axis[2]))


def cone(axis: FloatArray, angle: float, count: int = 8) -> list[FloatArray]:
    """Directions at `angle` [rad] around `axis`, evenly spaced, and `axis` itself."""
    first = np.cross(axis, np.eye(3)[int(np.argmin(np.abs(axis)))])
    first /= np.linalg.norm(first)
    second = np.cross(axis, first)
    turns = np.arange(count) * (2.0 * np.pi / count)
    ring = [
        np.cos(angle) * axis + np.sin(angle) * (np.cos(turn) * first + np.sin(turn) * second)
        for turn in turns
    ]
    return [axis, *ring]
