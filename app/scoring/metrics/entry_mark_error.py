"""Way along the skin between the entry that was planned and the one marked by the grid."""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Marked entry off the planned one",
    "unit": "mm",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the way [mm].

    Raises:
        MetricNotAskedError: if the exercise has no steps of a procedure.
        MetricUnavailableError: if no entry was marked.
    """
    error = trajectory.steps().entry_error_mm
    if error is None:
        raise MetricUnavailableError(sentence("no entry was marked with the grid"))
    return error


def deviation(trajectory: Trajectory) -> float:
    """Return 0: both places are given, not measured."""
    del trajectory
    return 0.0
