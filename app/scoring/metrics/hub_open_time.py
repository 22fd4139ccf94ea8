"""Time for which the outer needle lay in the body with its hub open to air: air gets in there."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Hub open to air",
    "unit": "s",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the time [s]."""
    return trajectory.steps().open_s


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [s] that the time between samples leaves."""
    return time_sd(trajectory, trajectory.running)
