"""Part of tip − target along the path at the end; positive beyond the target."""

from typing import Any, Final

from app.core.units import MILLIMETRE
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Depth error",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("target_shift", "tip_offset"),
}


def compute(trajectory: Trajectory) -> float:
    """Return what the tip went beyond the target as it is then, along the path to it [mm]."""
    return -trajectory.offset(trajectory.final()).remaining / MILLIMETRE
