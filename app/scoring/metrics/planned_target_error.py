"""Distance from the tip to the planned target, at rest: |tip − planned target| at the end.

Equals the target error where the target does not move; with breathing, the difference tells how
well the student chose the moment.
"""

import numpy as np

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory

NAME = "planned_target_error"
LABEL = "Error to the planned target"
UNIT = "mm"
HIGHER_IS_BETTER = False
READS = ("tip_offset_x", "tip_offset_y", "tip_offset_z")


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    tip = trajectory.tip[trajectory.final()]
    return float(np.linalg.norm(tip - trajectory.placed.p_target)) / MILLIMETRE
