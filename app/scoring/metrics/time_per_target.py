"""Time from the entry into the body to the last touch, over the number of targets touched.

Pauses do not count. Published trainers time the whole task: peg transfer of FLS moves six objects
there and back, and is proficient at 48 s (Ritter and Scott 2007, Surg Innov 14:107), cut off at
300 s (Peters et al. 2004, Surgery 135:21): 4 s and 25 s for each of twelve transfers.
"""

from typing import Any, Final

import numpy as np

from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Time per target",
    "unit": "s",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the time [s]."""
    rows = trajectory.touching()
    counts = np.zeros(len(trajectory), dtype=bool)
    counts[rows[:-1]] = True
    return trajectory.duration(counts & trajectory.running) / len(trajectory.to_touch().times)


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [s] that the time between samples leaves."""
    rows = trajectory.touching()
    counts = np.zeros(len(trajectory), dtype=bool)
    counts[rows[:-1]] = True
    return time_sd(trajectory, counts) / len(trajectory.to_touch().times)
