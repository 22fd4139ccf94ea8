"""Length of the tip's path in the last insertion over the straight line between its two ends."""

from typing import Any, Final

import numpy as np

from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.scoring.errors import MetricUnavailableError
from app.scoring.paths import length_slopes, smooth_length, smooth_slopes
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import path_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Path ratio",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}
SHORTEST = 1.0 * MILLIMETRE


def compute(trajectory: Trajectory) -> float:
    """Return the ratio, 1 for a straight insertion; the length is that of `path_length`."""
    last = trajectory.measured_stays()[-1]
    tip = trajectory.tip[last]
    straight = float(np.linalg.norm(tip[-1] - tip[0]))
    if straight < SHORTEST:
        raise MetricUnavailableError(
            sentence(
                "the tip ended {straight_mm:.2f} mm from where it entered; "
                "a ratio needs at least 1 mm",
                straight_mm=straight / MILLIMETRE,
            )
        )
    return smooth_length(trajectory.time[last], tip) / straight


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation, to first order, of length and straight line together."""
    last = trajectory.measured_stays()[-1]
    tip = trajectory.tip[last]
    straight = float(np.linalg.norm(tip[-1] - tip[0]))
    slopes = smooth_slopes(trajectory.time[last], tip)
    slopes[[0, -1]] -= compute(trajectory) * length_slopes(tip[[0, -1]])
    return path_sd(trajectory, [last], [slopes / straight])
