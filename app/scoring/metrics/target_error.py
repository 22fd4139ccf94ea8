"""Distance from the tip to the target where it is at the end: |tip − target|."""

import numpy as np

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory

NAME = "target_error"
LABEL = "Target error"
UNIT = "mm"
HIGHER_IS_BETTER = False
READS = (
    "target_shift_x",
    "target_shift_y",
    "target_shift_z",
    "tip_offset_x",
    "tip_offset_y",
    "tip_offset_z",
)


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    i = trajectory.final()
    return float(np.linalg.norm(trajectory.tip[i] - trajectory.target(i))) / MILLIMETRE
