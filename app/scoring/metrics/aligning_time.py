"""Time in the phase aligning: the needle is outside the body."""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Phase, Trajectory
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Aligning time",
    "unit": "s",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the time [s]; 0 if an attempt that ran never was in this phase."""
    if not trajectory.running.any():
        raise MetricUnavailableError(sentence("the attempt was never begun"))
    return trajectory.duration(trajectory.phase == Phase.ALIGNING)


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [s] that the time between samples leaves."""
    return time_sd(trajectory, trajectory.phase == Phase.ALIGNING)
