"""Fréchet distance of the tip's path in the last insertion from the planned path.

The shortest leash between two who walk along the two paths, forwards only: the largest deviation
that no choice of pace avoids. Both paths are resampled at 0.5 mm, the tip's without the jitter of
the tracking, as for `path_length`. Eiter and Mannila (1994); PerkTutor's deviation of that name.
"""

from typing import Any, Final

from app.core.units import MILLIMETRE
from app.scoring.paths import frechet, insertion_and_plan
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import largest_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Fréchet distance from the path",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    return frechet(*insertion_and_plan(trajectory)) / MILLIMETRE


def deviation(trajectory: Trajectory) -> float:
    """Return an upper bound of the standard deviation [mm]: the tip's largest on its path."""
    return largest_sd(trajectory, trajectory.measured_stays()[-1]) / MILLIMETRE
