"""Part of tip − target along the path at the end; positive beyond the target."""

from typing import Any, Final

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import tip_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Depth error",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("target_shift", "tip_offset"),
}


def compute(trajectory: Trajectory) -> float:
    """Return what the tip went beyond the target as it is then, along the path to it [mm]."""
    return -trajectory.offset(trajectory.final()).remaining / MILLIMETRE


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation of the tip along the path [mm]."""
    i = trajectory.final()
    return tip_sd(trajectory, i, trajectory.offset(i).path) / MILLIMETRE
