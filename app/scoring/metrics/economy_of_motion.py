"""Shortest way of the tip from touch to touch over the way that it went, times the share touched.

From where it came into the body by straight lines to where it touched one target after the other,
over its path up to the last touch: 100 % without any detour, if all targets were touched. A way
that was left undone is not saved: of six targets touched one, it is 17 % at most. Published
trainers give the path's length or its ratio to a shortest one as economy of motion; without the
jitter of the tracking, as `path_length`.
"""

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.paths import length_slopes, smooth_length, smooth_slopes
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import path_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Economy of motion",
    "unit": "%",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the ratio [%], at most 100; 0 where nothing was touched."""
    share = _share(trajectory)
    if not share:
        return 0.0
    rows, corners = _rows(trajectory)
    went = smooth_length(trajectory.time[rows], trajectory.tip[rows])
    straight = _polyline(trajectory.tip[rows[corners]])
    return 100.0 * share * min(1.0, straight / went)


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [%], to first order, of both lengths together."""
    share = _share(trajectory)
    if not share:
        return 0.0
    rows, corners = _rows(trajectory)
    time, tip = trajectory.time[rows], trajectory.tip[rows]
    went = smooth_length(time, tip)
    ratio = _polyline(tip[corners]) / went
    slopes = -ratio * smooth_slopes(time, tip)
    slopes[corners] += length_slopes(tip[corners])
    return 100.0 * share * path_sd(trajectory, [rows], [slopes / went])


def _share(trajectory: Trajectory) -> float:
    touches = trajectory.to_touch()
    return len(touches.times) / touches.of


def _rows(trajectory: Trajectory) -> tuple[np.ndarray, np.ndarray]:
    """Find the samples of the path with a measured depth, and which of them are its corners."""
    rows = trajectory.touching()
    rows = rows[trajectory.depth_valid[rows]]
    if not len(rows):
        raise MetricUnavailableError(sentence("the depth of the tip was not measured in the body"))
    times = trajectory.to_touch().times
    touched = np.searchsorted(trajectory.time[rows], times)
    corners = np.unique(np.concatenate([[0], np.minimum(touched, len(rows) - 1)]))
    if len(corners) < 2:
        raise MetricUnavailableError(sentence("the tip touched a target where it came in"))
    return rows, corners


def _polyline(points: FloatArray) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())
