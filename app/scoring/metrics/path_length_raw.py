"""Plain sum of the tip's steps in the body, over all insertions, as PerkTutor defines path length.

It grows with measurement noise and with the sampling rate: compare only attempts recorded alike.
"""

from typing import Any, Final

from app.core.units import MILLIMETRE
from app.scoring.paths import length_slopes, raw_length
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import path_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Path length, raw",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the length [mm]."""
    return sum(raw_length(trajectory.tip[s]) for s in trajectory.measured_stays()) / MILLIMETRE


def deviation(trajectory: Trajectory) -> float:
    """Return an upper bound of the standard deviation [mm], to first order.

    Repeated measurements vary by two thirds of it where noise is as large as a step; what noise
    adds on average is more.
    """
    stays = trajectory.measured_stays()
    slopes = [length_slopes(trajectory.tip[stay]) for stay in stays]
    return path_sd(trajectory, stays, slopes) / MILLIMETRE
