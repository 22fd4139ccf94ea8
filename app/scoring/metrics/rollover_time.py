"""Time from the needle's end in the body until the patient was turned puncture side down.

One whom nobody turned counts as turned after 600 s.
"""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Patient turned after",
    "unit": "s",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the time [s].

    Raises:
        MetricNotAskedError: if the exercise does not have the patient turned.
    """
    turning = trajectory.steps().turning
    if turning is None:
        raise MetricNotAskedError(sentence("the exercise does not have the patient turned"))
    return turning.wait


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [s] that the time between samples leaves."""
    return time_sd(trajectory, trajectory.running)
