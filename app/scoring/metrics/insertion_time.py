"""Time with the needle in the body: inserting and holding, over all insertions."""

from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

NAME = "insertion_time"
LABEL = "Insertion time"
UNIT = "s"
HIGHER_IS_BETTER = False


def compute(trajectory: Trajectory) -> float:
    """Return the time [s]."""
    mask = trajectory.inserted
    if not mask.any():
        raise MetricUnavailableError("the attempt never got that far")
    return trajectory.duration(mask)
