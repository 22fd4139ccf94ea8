"""Smoothness of the last insertion: log dimensionless jerk (LDLJ) of the tip's speed.

Nearer to zero is smoother; pauses make it more negative, as the duration enters by its third power.
Published in J. NeuroEng. Rehabil. 12:112 (2015).
"""

from typing import Any, Final

import numpy as np

from app.scoring.smoothness import (
    RATE,
    insertion_speed,
    log_dimensionless_jerk,
    repeated_speeds,
)
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Smoothness (LDLJ)",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the logarithm, negative for any hand; nearer to zero is smoother."""
    return log_dimensionless_jerk(insertion_speed(trajectory), RATE)


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation, of the insertion measured again and again."""
    again = [log_dimensionless_jerk(speed, RATE) for speed in repeated_speeds(trajectory)]
    return float(np.std(again, ddof=1))
