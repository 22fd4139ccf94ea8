"""Part of tip − target along the planned path, at the end; positive beyond the target."""

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory

NAME = "depth_error"
LABEL = "Depth error"
UNIT = "mm"
HIGHER_IS_BETTER = False
READS = ("target_shift_x", "target_shift_y", "target_shift_z")


def compute(trajectory: Trajectory) -> float:
    """Return e·a [mm], with e = tip − target and a the planned direction."""
    i = trajectory.final()
    error = trajectory.tip[i] - trajectory.target(i)
    return float(error @ trajectory.placed.axis) / MILLIMETRE
