"""Time from the begin to the end of the attempt: aligning, inserting and holding together."""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Total time",
    "unit": "s",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the time [s]."""
    mask = trajectory.running
    if not mask.any():
        raise MetricUnavailableError(sentence("the attempt never got that far"))
    return trajectory.duration(mask)


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [s] that the time between samples leaves."""
    return time_sd(trajectory, trajectory.running)
