"""Part of tip − target that is perpendicular to the planned path, at the end."""

import numpy as np

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory

NAME = "lateral_error"
LABEL = "Lateral error"
UNIT = "mm"
HIGHER_IS_BETTER = False
READS = ("target_shift_x", "target_shift_y", "target_shift_z")


def compute(trajectory: Trajectory) -> float:
    """Return |e − (e·a)a| [mm], with e = tip − target and a the planned direction."""
    i = trajectory.final()
    error = trajectory.tip[i] - trajectory.target(i)
    axis = trajectory.placed.axis
    return float(np.linalg.norm(error - (error @ axis) * axis)) / MILLIMETRE
