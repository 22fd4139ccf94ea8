"""Largest angle between the needle and the vertical while it is in the body."""

from typing import Any, Final

import numpy as np

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Widest turn of the rings",
    "unit": "°",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the angle [°]."""
    trajectory.insertions()
    down = -trajectory.axis[trajectory.inserted, 2]
    return float(np.rad2deg(np.arccos(np.clip(down, -1.0, 1.0)).max()))
