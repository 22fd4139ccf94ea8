"""Number of control scans that the student took."""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Control scans",
    "unit": "scans",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Count of control scans."""
    if not trajectory.running.any():
        raise MetricUnavailableError(sentence("the attempt never got that far"))
    return float(len(trajectory.scans))


def deviation(trajectory: Trajectory) -> float:
    """Return 0: it is counted."""
    del trajectory
    return 0.0
