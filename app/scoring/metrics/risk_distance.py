"""Smallest distance of the needle from a structure marked as risk; 0 where it was inside one."""

from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory

NAME = "risk_distance"
LABEL = "Distance from risk"
UNIT = "mm"
HIGHER_IS_BETTER = True
READS = ("tip_offset_x", "tip_offset_y", "tip_offset_z")


def compute(trajectory: Trajectory) -> float:
    """Distance [mm] of the needle's part in the body from the nearest risk."""
    if not trajectory.risks:
        raise MetricNotAskedError("no structure of risk was measured")
    return max(0.0, min(risk.closest_mm for risk in trajectory.risks))
