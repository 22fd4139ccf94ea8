"""How often the needle was drawn back by more than 10 mm and went on in another direction.

Another direction is one that differs by more than 2°. Residents' CT-guided insertions are judged by
this count (AJR; 3.3 corrections freehand against 1.6 guided, Weigel 2023).
"""

from typing import Any, Final

import numpy as np

from app.core.arrays import angle_between
from app.core.units import DEGREE, MILLIMETRE
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Redirects",
    "unit": "times",
    "higher_is_better": False,
    "reads": (),
}
DRAWN_BACK = 10.0 * MILLIMETRE
ONWARDS = 2.0 * MILLIMETRE
TURNED = 2.0 * DEGREE


def compute(trajectory: Trajectory) -> float:
    """Count them over all insertions."""
    samples = np.concatenate(trajectory.measured_stays())
    depths = trajectory.depth.tolist()
    count = 0
    deepest = shallowest = int(samples[0])
    for i in samples.tolist():
        depth = depths[i]
        if depth < depths[shallowest]:
            shallowest = i
        back = depths[deepest] - depths[shallowest] > DRAWN_BACK
        if back and depth > depths[shallowest] + ONWARDS:
            count += angle_between(trajectory.axis[deepest], trajectory.axis[i]) > TURNED
            deepest = shallowest = i
        elif depth >= depths[deepest]:
            deepest = shallowest = i
    return float(count)


def deviation(trajectory: Trajectory) -> float:
    """Return 0: it is counted."""
    del trajectory
    return 0.0
