"""Time from the begin to the end of the attempt: aligning, inserting and holding together."""

from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

NAME = "total_time"
LABEL = "Total time"
UNIT = "s"
HIGHER_IS_BETTER = False


def compute(trajectory: Trajectory) -> float:
    """Return the time [s]."""
    mask = trajectory.running
    if not mask.any():
        raise MetricUnavailableError("the attempt never got that far")
    return trajectory.duration(mask)
