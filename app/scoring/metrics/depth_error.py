"""Part of tip − target along the path at the end; positive beyond the target."""

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory

NAME = "depth_error"
LABEL = "Depth error"
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
    """Return what the tip went beyond the target as it is then, along the path to it [mm]."""
    return -trajectory.offset(trajectory.final()).remaining / MILLIMETRE
