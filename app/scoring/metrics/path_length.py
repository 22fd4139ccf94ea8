"""Length of the tip's path in the body, over all insertions, without the jitter of the tracking.

Positions are averaged over blocks of half a second first (`scoring.paths`): the plain sum over
samples grows with noise and sampling rate. `path_length_raw` is that plain sum.
"""

from typing import Any, Final

from app.core.units import MILLIMETRE
from app.scoring.paths import smooth_length, smooth_slopes
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import path_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Path length",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the length [mm]."""
    time, tip = trajectory.time, trajectory.tip
    return sum(smooth_length(time[s], tip[s]) for s in trajectory.measured_stays()) / MILLIMETRE


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [mm], to first order."""
    stays = trajectory.measured_stays()
    slopes = [smooth_slopes(trajectory.time[stay], trajectory.tip[stay]) for stay in stays]
    return path_sd(trajectory, stays, slopes) / MILLIMETRE
