"""Where the robot's parts are, from its joint angles: points in world, metres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.mechanisms.errors import MechanismError
from app.mechanisms.geometry import Geometry


@dataclass(frozen=True, slots=True, eq=False)
class RobotShape:
    """The points that the links join, each of shape (3,) in world [m].

    Attributes:
        motors: left and right motor axis.
        elbows: ends of the two proximal links; None where the angles are not usable.
        tool: P3, where the needle crosses the plane of the links; None likewise.
        fulcrum: P_I, the ball under the skin's surface.
    """

    motors: tuple[FloatArray, FloatArray]
    elbows: tuple[FloatArray, FloatArray] | None
    tool: FloatArray | None
    fulcrum: FloatArray

    @classmethod
    def of(cls, geometry: Geometry, q: ArrayLike | None) -> RobotShape:
        """Place the links; without usable angles only what does not move is shown.

        Args:
            geometry: lengths of the mechanism.
            q: joint angles [rad], shape (2,), or None before the robot is connected.
        """
        half = geometry.base / 2.0
        motors = (frozen([-half, 0.0, 0.0]), frozen([half, 0.0, 0.0]))
        fulcrum = frozen(geometry.fulcrum)
        if q is None or not np.isfinite(q).all():
            return cls(motors, None, None, fulcrum)
        from app.mechanisms.pantograph import forward  # compiled: loaded since a robot runs

        angles = np.asarray(q, dtype=np.float64)
        arms = geometry.proximal * np.column_stack([np.cos(angles), np.sin(angles), [0.0, 0.0]])
        elbows = (frozen(motors[0] + arms[0]), frozen(motors[1] + arms[1]))
        try:
            tool = frozen([*forward(geometry, angles), 0.0])
        except MechanismError:  # a pose in which the links do not close: show the driven ones
            tool = None
        return cls(motors, elbows, tool, fulcrum)

    def links(self) -> list[tuple[FloatArray, FloatArray]]:
        """Return the ends of the rods to draw: base, proximal, distal; five where all is known."""
        rods = [self.motors]
        if self.elbows is not None:
            rods += list(zip(self.motors, self.elbows, strict=True))
            if self.tool is not None:
                rods += [(elbow, self.tool) for elbow in self.elbows]
        return rods
