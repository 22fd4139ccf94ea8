"""How far the tip is off the path at the end: `planning.off_path`, as the window shows it."""

from typing import Any, Final

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import tip_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Off the path",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("target_shift", "tip_offset"),
}


def compute(trajectory: Trajectory) -> float:
    """Return the part of tip − target across the path to the target as it is then [mm]."""
    return trajectory.offset(trajectory.final()).lateral / MILLIMETRE


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation of the tip in the direction in which it is off [mm]."""
    i = trajectory.final()
    path = trajectory.offset(i).path
    away = trajectory.tip[i] - trajectory.target(i)
    away = away - path * float(away @ path) / float(path @ path)
    return tip_sd(trajectory, i, away) / MILLIMETRE
