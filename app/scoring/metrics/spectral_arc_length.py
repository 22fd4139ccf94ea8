"""Smoothness of the last insertion: spectral arc length (SPARC) of the tip's speed.

-1.4 is one smooth push; the more stops and starts, the more negative. Published in J. NeuroEng.
Rehabil. 12:112 (2015).
"""

from typing import Any, Final

import numpy as np

from app.scoring.smoothness import (
    COARSE,
    RATE,
    insertion_speed,
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


def compute(trajectory: Trajectory) -> float:
    """Return the arc length, negative; nearer to zero is smoother."""
    return spectral_arc_length(insertion_speed(trajectory), RATE)


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation, of the insertion measured again and again."""
    again = [spectral_arc_length(speed, RATE, COARSE) for speed in repeated_speeds(trajectory)]
    return float(np.std(again, ddof=1))
