"""Share of the lesion that was ablated."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Lesion ablated",
    "unit": "%",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the share [%].

    Raises:
        MetricUnavailableError: if nothing was ablated.
    """
    return 100.0 * trajectory.steps().ablated().share
