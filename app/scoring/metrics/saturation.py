"""Share of the insertion in which the force that the robot should give was at its limit.

Beyond it the needle is guided by less than the law asks for, whatever the dial says. The record
says of each sample whether force or torque was held back.
"""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Force at its limit",
    "unit": "%",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the share [%]; of a single sample, 0 or 100."""
    trajectory.insertions()
    if trajectory.clamped is None:
        raise MetricUnavailableError(
            sentence("whether the force was at its limit was not recorded")
        )
    inserted = trajectory.inserted
    whole = trajectory.duration(inserted)
    if whole > 0.0:
        return 100.0 * trajectory.duration(inserted & trajectory.clamped) / whole
    return 100.0 * float(trajectory.clamped[inserted].mean())


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [%] that the time between samples leaves."""
    whole = trajectory.duration(trajectory.inserted)
    if trajectory.clamped is None or not whole > 0.0:
        return 0.0
    return 100.0 * time_sd(trajectory, trajectory.inserted & trajectory.clamped) / whole
