"""How rightly complications were answered, by the table of answers: 100 % where all were at once.

Right after another answer counts half, as does one that helps and is not enough; an answer to
nothing counts as a wrong one.
"""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Complication answered",
    "unit": "%",
    "higher_is_better": True,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the share [%].

    Raises:
        MetricNotAskedError: if no complication happened in time to be answered, and none was.
    """
    worth = trajectory.complications().worth()
    if not worth:
        raise MetricNotAskedError(sentence("no complication happened"))
    return 100.0 * sum(worth) / len(worth)


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
