"""How often the tip crossed the pleura: into the lung, and out of it into something else.

Vessels and airways within the lung are lung, as is a nodule in it that holds the target: going from
one into the other crosses no pleura.
"""

from typing import Any, Final

from app.scoring.pleura import crossings
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Pleural crossings",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how often, inwards and outwards."""
    return float(crossings(trajectory.tissues_met()))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
