"""How far the path that the student chose stays from bone, lung, vessels, gut and heart.

The smallest distance over the straight path, to half a voxel of the tissue field or better; 0 where
it meets one of them; nothing that holds the target counts.
"""

from math import isfinite
from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.planned import own_plan
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Room about the planned path",
    "unit": "mm",
    "higher_is_better": True,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    clear_mm = own_plan(trajectory).clear_mm
    if not isfinite(clear_mm):
        raise MetricUnavailableError(
            sentence("nothing that a needle should not meet is near the planned path")
        )
    return clear_mm


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: the plan is known exactly."""
    return 0.0
