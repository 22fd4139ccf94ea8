"""How far the tip is off the path at the end: `planning.off_path`, as the window shows it."""

from typing import Any, Final

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Off the path",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("target_shift", "tip_offset"),
}


def compute(trajectory: Trajectory) -> float:
    """Return the part of tip − target across the path to the target as it is then [mm]."""
    return trajectory.offset(trajectory.final()).lateral / MILLIMETRE
