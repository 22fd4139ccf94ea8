"""Points that the planner gives the path that the student chose, 0 to 100: what the map of entries
says of it.

Of its length, its angle to the skin, the angle at the pleura, and how far it stays from bone, lung,
vessels, gut and heart; 0 where it meets one of them, is too long or lies too flat.
"""

from typing import Any, Final

from app.scoring.planned import own_plan
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Planned path",
    "unit": "points",
    "higher_is_better": True,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the points."""
    return own_plan(trajectory).points


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: the plan is known exactly."""
    return 0.0
