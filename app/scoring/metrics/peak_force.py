"""Largest force that the hand felt while the needle was in the body."""

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
    trajectory.insertions()
    return float(np.linalg.norm(trajectory.forces()[trajectory.inserted], axis=1).max())
