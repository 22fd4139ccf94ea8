"""Where the robot's parts are, from its joint angles: points in world, metres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.mechanisms.profile import DeviceProfile

if TYPE_CHECKING:
    from app.mechanisms.remote_centre import MachineDrawing


@dataclass(frozen=True, slots=True, eq=False)
class RobotShape:
    """A machine as it is drawn.

    Attributes:
        drawing: its points and rods in world [m]; the base comes first.
        fulcrum: remote centre, the ball under the skin's surface, shape (3,).
    """

    drawing: MachineDrawing
    fulcrum: FloatArray

    @classmethod
    def of(cls, profile: DeviceProfile, q: ArrayLike | None) -> RobotShape:
        """Place the parts; without usable angles only what does not move is shown.

        Args:
            profile: of the robot.
            q: joint angles [rad], shape (2,), or None before the robot is connected.
        """
        angles = None if q is None else np.asarray(q, dtype=np.float64)
        usable = angles is not None and bool(np.isfinite(angles).all())
        return cls(profile.machine.drawn(angles if usable else None), frozen(profile.fulcrum))

    def links(self) -> list[tuple[FloatArray, FloatArray]]:
        """Return the ends of the rods to draw."""
        return self.drawing.ends()
