"""A measured tip on positions that were held back: what no fit to them can flatter."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.core.units import MILLIMETRE
from app.tracking.pen.pivot import FEWEST, MeasuredPose, pivot

EVERY = 4
"""Every so many positions one is held back."""


@dataclass(frozen=True, slots=True)
class HeldBack:
    """How far the tip was from its dimple in positions that the fit had not seen.

    Attributes:
        rms: root mean square distance [m].
        worst: largest distance [m].
        poses: how many were held back.
    """

    rms: float
    worst: float
    poses: int

    @property
    def words(self) -> str:
        """What was found, for people."""
        return (
            f"on {self.poses} positions held back the tip was {self.rms / MILLIMETRE:.2f} mm from "
            f"its dimple (at most {self.worst / MILLIMETRE:.1f} mm)"
        )


def held_back(poses: Sequence[MeasuredPose]) -> HeldBack | None:
    """Fit three quarters of the positions and hold the rest against it.

    Returns:
        None where too few would be left to fit.

    Raises:
        PenError: if the rest does not tell the tip; says what to do.
    """
    taken = [pose for k, pose in enumerate(poses) if k % EVERY]
    left = [pose for k, pose in enumerate(poses) if k % EVERY == 0]
    if len(taken) < FEWEST:
        return None
    found = pivot(taken)
    away = np.array([np.linalg.norm(p.T @ found.p_tip - found.p_dimple) for p in left])
    return HeldBack(float(np.sqrt(np.mean(away**2))), float(away.max()), len(left))
