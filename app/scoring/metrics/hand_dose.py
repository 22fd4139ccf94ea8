"""Sum of the doses of the operator's hand at control scans in the room: a teaching estimate."""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricNotAskedError, MetricUnavailableError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Dose of the hand (teaching estimate)",
    "unit": "µSv",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Dose [µSv]: of all scans for which the student stayed in the room.

    Raises:
        MetricUnavailableError: if the attempt never got that far.
        MetricNotAskedError: if no scan says a dose.
    """
    if not trajectory.running.any():
        raise MetricUnavailableError(sentence("the attempt never got that far"))
    doses = [scan.hand_usv for scan in trajectory.scans if scan.hand_usv is not None]
    if not doses:
        raise MetricNotAskedError(
            sentence("no control scan says a dose of the hand: the exercise does not ask for it")
        )
    return float(sum(doses))


def deviation(trajectory: Trajectory) -> float:
    """Return 0: it is counted."""
    del trajectory
    return 0.0
