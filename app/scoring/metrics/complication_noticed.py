"""Time from the beginning of a complication until somebody said that something is wrong.

Of several the mean. One that nobody noticed counts as noticed after 600 s; one that began in the
last 30 s is not asked for.
"""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Complication noticed after",
    "unit": "s",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the time [s].

    Raises:
        MetricNotAskedError: if no complication happened in time to be noticed.
    """
    waits = trajectory.complications().waits()
    if not waits:
        raise MetricNotAskedError(sentence("no complication happened"))
    return sum(waits) / len(waits)


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: both moments are exact."""
    return 0.0
