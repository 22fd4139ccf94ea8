"""Share of the checklist, consent and coagulation, that was done before any needle went in."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Checklist before the needle",
    "unit": "%",
    "higher_is_better": True,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the share [%].

    Raises:
        MetricNotAskedError: if the exercise has no steps of a procedure.
    """
    return 100.0 * trajectory.steps().checked


def deviation(trajectory: Trajectory) -> float:
    """Return 0: what was done is known exactly."""
    del trajectory
    return 0.0
