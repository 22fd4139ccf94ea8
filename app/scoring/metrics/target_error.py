"""Distance from the tip to the target where it is at the end: |tip − target|."""

from typing import Any, Final

import numpy as np

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import tip_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Target error",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("target_shift", "tip_offset"),
}


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    i = trajectory.final()
    return float(np.linalg.norm(trajectory.tip[i] - trajectory.target(i))) / MILLIMETRE


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation of the tip towards the target [mm]."""
    i = trajectory.final()
    return tip_sd(trajectory, i, trajectory.tip[i] - trajectory.target(i)) / MILLIMETRE
