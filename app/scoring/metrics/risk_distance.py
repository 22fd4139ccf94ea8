"""Smallest distance of the needle from a structure marked as risk; 0 where it was inside one."""

from typing import Any, Final

from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Distance from risk",
    "unit": "mm",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Distance [mm] of the needle's part in the body from the nearest risk."""
    if not trajectory.risks:
        raise MetricNotAskedError("no structure of risk was measured")
    return max(0.0, min(risk.closest_mm for risk in trajectory.risks))
