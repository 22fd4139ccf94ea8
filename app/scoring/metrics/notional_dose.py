"""Sum of the notional dose-length products of the control scans: a teaching estimate."""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Dose (teaching estimate)",
    "unit": "mGy·cm",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Dose [mGy·cm]: slices of all control scans times what the exercise says of one."""
    if not trajectory.running.any():
        raise MetricUnavailableError(sentence("the attempt never got that far"))
    return float(sum(scan.dose for scan in trajectory.scans))


def deviation(trajectory: Trajectory) -> float:
    """Return 0: it is counted."""
    del trajectory
    return 0.0
