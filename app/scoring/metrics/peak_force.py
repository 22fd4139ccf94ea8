"""Largest force that the hand felt in the attempt, also where the depth was not known."""

from typing import Any, Final

import numpy as np

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Peak force, estimated",
    "unit": "N",
    "higher_is_better": False,
    "reads": ("felt",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the force at the hub point, after all limits [N]."""
    return float(np.linalg.norm(trajectory.forces()[trajectory.pushed()], axis=1).max())
