"""Time from the entry into the body to the last touch, over all targets; one not touched is 25 s.

Pauses do not count. Published trainers time the whole task: peg transfer of FLS moves six objects
there and back, and is proficient at 48 s (Ritter and Scott 2007, Surg Innov 14:107), cut off at
300 s (Peters et al. 2004, Surgery 135:21): 4 s and 25 s for each of twelve transfers. So what was
left undone counts as cut off: else who touches one target and ends would be the quickest.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Time per target",
    "unit": "s",
    "higher_is_better": False,
    "reads": (),
}


CUT_OFF: Final = 25.0
"""What a target counts that was not touched [s]."""


def compute(trajectory: Trajectory) -> float:
    """Return the time [s]."""
    touches = trajectory.to_touch()
    left = CUT_OFF * (touches.of - len(touches.times))
    return (trajectory.duration(_counts(trajectory)) + left) / touches.of


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [s] that the time between samples leaves."""
    return time_sd(trajectory, _counts(trajectory)) / trajectory.to_touch().of


def _counts(trajectory: Trajectory) -> NDArray[np.bool_]:
    """Mark the samples whose time counts, shape (n,); none where nothing was touched."""
    counts = np.zeros(len(trajectory), dtype=bool)
    if trajectory.to_touch().times:
        counts[trajectory.touching()[:-1]] = True
    return counts & trajectory.running
