"""Number of control scans that the student took."""

from app.scoring.trajectory import Trajectory

NAME = "control_scans"
LABEL = "Control scans"
UNIT = "scans"
HIGHER_IS_BETTER = False


def compute(trajectory: Trajectory) -> float:
    """Count of control scans."""
    return float(len(trajectory.scans))
