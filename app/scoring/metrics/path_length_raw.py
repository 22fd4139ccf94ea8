"""Plain sum of the tip's steps in the body, over all insertions, as PerkTutor defines path length.

It grows with measurement noise and with the sampling rate: compare only attempts recorded alike.
"""

from app.core.units import MILLIMETRE
from app.scoring.paths import raw_length
from app.scoring.trajectory import Trajectory

NAME = "path_length_raw"
LABEL = "Path length, raw"
UNIT = "mm"
HIGHER_IS_BETTER = False
READS = ("tip_offset_x", "tip_offset_y", "tip_offset_z")


def compute(trajectory: Trajectory) -> float:
    """Return the length [mm]."""
    return sum(raw_length(trajectory.tip[s]) for s in trajectory.measured_stays()) / MILLIMETRE
