"""Distance from the tip to the planned target, at rest: |tip − planned target| at the end.

Equals the target error where the target does not move; with breathing, the difference tells how
well the student chose the moment.
"""

from typing import Any, Final

import numpy as np

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import tip_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Error to the planned target",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    tip = trajectory.tip[trajectory.final()]
    return float(np.linalg.norm(tip - trajectory.placed.p_target)) / MILLIMETRE


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation of the tip towards the planned target [mm]."""
    i = trajectory.final()
    return tip_sd(trajectory, i, trajectory.tip[i] - trajectory.placed.p_target) / MILLIMETRE
