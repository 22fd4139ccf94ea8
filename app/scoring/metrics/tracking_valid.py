"""Share of the time in the body, pauses included, during which the tip's depth was measured."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Tracking valid",
    "unit": "%",
    "higher_is_better": True,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the share [%]; of a single sample, 0 or 100."""
    trajectory.insertions()
    inserted = trajectory.inserted | trajectory.paused
    whole = trajectory.duration(inserted)
    if whole > 0.0:
        return 100.0 * trajectory.duration(inserted & trajectory.depth_valid) / whole
    return 100.0 * float(trajectory.depth_valid[inserted].mean())


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [%] that the time between samples leaves."""
    inserted = trajectory.inserted | trajectory.paused
    whole = trajectory.duration(inserted)
    seen = time_sd(trajectory, inserted & trajectory.depth_valid)
    return 100.0 * seen / whole if whole > 0.0 else 0.0
