"""Angle between the path that the student chose and the pleura's normal where the lung is entered.

0 is straight in.
"""

from typing import Any, Final

from app.scoring.planned import known, own_lung_path
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Angle at the pleura of the planned path",
    "unit": "°",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the angle [deg]."""
    report = own_lung_path(trajectory)
    return known(report.pleural_deg)


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: the plan is known exactly."""
    return 0.0
