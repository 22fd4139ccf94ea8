"""How far the tip is off the path at the end: `planning.off_path`, as the window shows it."""

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory

NAME = "lateral_error"
LABEL = "Off the path"
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
    """Return the part of tip − target across the path to the target as it is then [mm]."""
    return trajectory.offset(trajectory.final()).lateral / MILLIMETRE
