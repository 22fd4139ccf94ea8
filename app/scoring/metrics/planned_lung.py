"""Aerated lung that the path that the student chose goes through.

From the pleura to the lesion, vessels and bronchi in it counted, as published lengths have it.
"""

from typing import Any, Final

from app.scoring.planned import known, own_lung_path
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Lung on the planned path",
    "unit": "mm",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the length [mm]."""
    report = own_lung_path(trajectory)
    return known(report.lung_mm)


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: the plan is known exactly."""
    return 0.0
