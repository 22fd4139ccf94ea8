"""Mean distance of the tip's path in the last insertion from the planned path, paces matched.

Dynamic time warping with the symmetric weights of Sakoe and Chiba (1978), divided by them, so that
it is a mean. Both paths are resampled at 0.5 mm, the tip's without the jitter of the tracking.
"""

from typing import Any, Final

from app.core.units import MILLIMETRE
from app.scoring.paths import insertion_and_plan, time_warping
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import largest_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Mean distance from the path (DTW)",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    return time_warping(*insertion_and_plan(trajectory)) / MILLIMETRE


def deviation(trajectory: Trajectory) -> float:
    """Return an upper bound of the standard deviation [mm]: the tip's largest on its path."""
    return largest_sd(trajectory, trajectory.measured_stays()[-1]) / MILLIMETRE
