"""Smoothness of the last insertion: spectral arc length (SPARC) of the tip's speed.

-1.4 is one smooth push; the more stops and starts, the more negative. Published in J. NeuroEng.
Rehabil. 12:112 (2015). Up to scoring version 5 positions were smoothed over 0.1 s, behind which 16
stops in 8 s passed for smoother than 8.
"""

from typing import Any, Final

import numpy as np

from app.scoring.smoothness import (
    COARSE,
    RATE,
    insertion_speed,
    picture_speed,
    repeated_picture_speeds,
    repeated_speeds,
    spectral_arc_length,
)
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Smoothness (SPARC)",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


_LAST_SMOOTHED: Final = 5
"""Last scoring version whose rule smoothed over 0.1 s."""


def compute(trajectory: Trajectory) -> float:
    """Return the arc length, negative; nearer to zero is smoother."""
    speed = insertion_speed if _smoothed(trajectory) else picture_speed
    return spectral_arc_length(speed(trajectory), RATE)


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation, of the insertion measured again and again."""
    repeated = repeated_speeds if _smoothed(trajectory) else repeated_picture_speeds
    again = [spectral_arc_length(speed, RATE, COARSE) for speed in repeated(trajectory)]
    return float(np.std(again, ddof=1))


def _smoothed(trajectory: Trajectory) -> bool:
    return trajectory.scoring_version <= _LAST_SMOOTHED
