"""Smallest distance of the needle from a structure marked as risk; 0 where it was inside one."""

from typing import Any, Final

from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import tip_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Distance from risk",
    "unit": "mm",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Distance [mm] of the needle's part in the body from the nearest risk."""
    if not trajectory.risks:
        raise MetricNotAskedError(sentence("no structure of risk was measured"))
    return max(0.0, min(risk.closest_mm for risk in trajectory.risks))


def deviation(trajectory: Trajectory) -> float:
    """Return an upper bound of the standard deviation [mm]: the tip's largest at that moment."""
    nearest = min(trajectory.risks, key=lambda risk: risk.closest_mm)
    return tip_sd(trajectory, trajectory.at(nearest.time)) / MILLIMETRE
