"""How many tissues beside the organ the zone reaches: gut, gallbladder, lung, skin and the like."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Reached beside the organ",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how many.

    Raises:
        MetricUnavailableError: if nothing was ablated.
    """
    return float(len(trajectory.steps().ablated().reached))
