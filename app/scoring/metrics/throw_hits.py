"""How often a throw of the biopsy gun met what it should not: great vessels, bone, gut, heart, or
what lies beyond the organ's pleura or capsule.
"""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Met by a throw",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often, over all samples."""
    return float(sum(len(sample.hits) for sample in trajectory.steps().samples))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
