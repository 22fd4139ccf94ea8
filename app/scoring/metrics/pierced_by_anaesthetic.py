"""How often the needle for local anaesthetic went through the pleura or the capsule."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Pierced by the anaesthetic",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often it came into lung, or into what holds the target."""
    return float(len(trajectory.steps().pierced))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
