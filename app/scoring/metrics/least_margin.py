"""Least margin about the lesion: how near its surface comes to what was not ablated of the organ.

Where the lesion itself was not covered it is 0: `ablated_share` tells by how much. Beyond the
organ's capsule none is asked for.
"""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Least margin",
    "unit": "mm",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the margin [mm].

    Raises:
        MetricUnavailableError: if nothing was ablated.
    """
    return max(0.0, trajectory.steps().ablated().least_margin_mm)
