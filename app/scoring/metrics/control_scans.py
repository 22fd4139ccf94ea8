"""Number of control scans that the student took."""

from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

NAME = "control_scans"
LABEL = "Control scans"
UNIT = "scans"
HIGHER_IS_BETTER = False


def compute(trajectory: Trajectory) -> float:
    """Count of control scans."""
    if not trajectory.running.any():
        raise MetricUnavailableError("the attempt never got that far")
    return float(len(trajectory.scans))
