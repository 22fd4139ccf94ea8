"""Share of the targets that the tip touched, in their order."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Targets touched",
    "unit": "%",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the share [%]."""
    touches = trajectory.to_touch()
    return 100.0 * len(touches.times) / touches.of


def deviation(trajectory: Trajectory) -> float:
    """Return 0: it is counted."""
    del trajectory
    return 0.0
