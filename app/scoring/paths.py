"""Sampled paths: their length, with and without jitter, and how far two of them are apart."""

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

WINDOW = 0.5
"""Positions are averaged over blocks of this duration [s] before a path is measured."""

SPACING = 0.5 * MILLIMETRE
"""Paths are compared on points that lie this far apart [m]."""

LONGEST = 1.0
"""Longer paths are not compared [m]: the work grows with the square."""


def raw_length(points: FloatArray) -> float:
    """Sum of the steps of a polyline, shape (n, 3) [m]; grows with every sample of noise."""
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def smooth_length(time: FloatArray, points: FloatArray, window: float = WINDOW) -> float:
    """Length of the path through the block means of `points`, from its first to its last point.

    Noise of standard deviation σ at a pause of duration T adds about T/window · 2σ/√m to the
    length (m samples a block) instead of 2σ for each sample. A path along a straight line keeps
    its length; detours shorter than `window` are lost.

    Args:
        time: strictly rising [s], shape (n,).
        points: shape (n, 3) [m].
        window: duration of a block [s].
    """
    return raw_length(smoothed(time, points, window))


def smoothed(time: FloatArray, points: FloatArray, window: float = WINDOW) -> FloatArray:
    """Return the polyline whose length `smooth_length` is, shape (m, 3) [m]."""
    if len(points) < 3:
        return points
    starts, counts = _blocks(time, window)
    means = np.add.reduceat(points, starts, axis=0) / counts[:, None]
    return np.vstack([points[:1], means, points[-1:]])


def smooth_slopes(time: FloatArray, points: FloatArray, window: float = WINDOW) -> FloatArray:
    """Slopes of `smooth_length` in each of its points, shape (n, 3)."""
    if len(points) < 3:
        return length_slopes(points)
    _, counts = _blocks(time, window)
    nodes = length_slopes(smoothed(time, points, window))
    slopes = np.repeat(nodes[1:-1] / counts[:, None], counts, axis=0)
    slopes[0] += nodes[0]
    slopes[-1] += nodes[-1]
    return slopes


def length_slopes(points: FloatArray) -> FloatArray:
    """Slopes of the length of a polyline in its points, shape (n, 3); none where it stands."""
    slopes = np.zeros_like(points)
    steps = np.diff(points, axis=0)
    lengths = np.linalg.norm(steps, axis=1)[:, None]
    units = np.divide(steps, lengths, out=np.zeros_like(steps), where=lengths > 0.0)
    slopes[1:] += units
    slopes[:-1] -= units
    return slopes


def _blocks(time: FloatArray, window: float) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return where each block begins, and of how many points it is."""
    blocks = np.floor((time - time[0]) / window)
    starts = np.flatnonzero(np.diff(blocks, prepend=-1.0))
    return starts, np.diff(starts, append=len(time))


def resampled(points: FloatArray, spacing: float = SPACING) -> FloatArray:
    """Points along a polyline at most `spacing` apart, evenly, both ends included, shape (m, 3)."""
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(0.0, along[-1], max(1, int(np.ceil(along[-1] / spacing - 1e-9))) + 1)
    return np.column_stack([np.interp(at, along, one) for one in points.T])


def insertion_and_plan(trajectory: Trajectory) -> tuple[FloatArray, FloatArray]:
    """Resample the tip's path in the last insertion and the planned path, shapes (n, 3), (m, 3).

    Raises:
        MetricUnavailableError: if the depth was not measured, or the path is too long.
    """
    last = trajectory.measured_stays()[-1]
    path = smoothed(trajectory.time[last], trajectory.tip[last])
    if (length := raw_length(path)) > LONGEST:
        raise MetricUnavailableError(
            sentence(
                "the tip's path is {length:.2f} m long; paths up to {longest:g} m are compared",
                length=length,
                longest=LONGEST,
            )
        )
    placed = trajectory.placed
    return resampled(path), resampled(np.vstack([placed.p_entry, placed.p_target]))


def frechet(a: FloatArray, b: FloatArray) -> float:
    """Discrete Fréchet distance [m] of two polylines, shapes (n, 3) and (m, 3).

    Eiter and Mannila, "Computing discrete Fréchet distance", TU Wien (1994).
    """
    return _coupled(a, b, longest=True)


def time_warping(a: FloatArray, b: FloatArray) -> float:
    """Mean distance [m] of two polylines, shapes (n, 3) and (m, 3), under their best warping.

    Sakoe and Chiba, IEEE Trans. ASSP 26:43 (1978), symmetric form: a step along both counts twice,
    and the sum is divided by n + m.
    """
    return _coupled(a, b, longest=False) / (len(a) + len(b))


def _coupled(a: FloatArray, b: FloatArray, *, longest: bool) -> float:
    """Cheapest way from the first to the last pair: its longest distance, or their weighted sum.

    Diagonal by diagonal, as the pairs of one do not depend on each other. The pairs (i, k - i) of
    the diagonal k stand in one row, so that its neighbours are the two rows before, shifted by one.
    """
    n, m = len(a), len(b)
    i, j = np.arange(n)[:, None], np.arange(m)
    distances = np.full((n + m - 1, n), np.inf)
    x, y, z = (np.subtract.outer(a[:, k], b[:, k]) for k in range(3))
    distances[i + j, i] = np.sqrt(x * x + y * y + z * z)
    before, last, cost = np.full((3, n + 1), np.inf)  # each led by the edge i = -1
    before[0] = 0.0
    for distance in distances:
        along = np.minimum(last[1:], last[:-1])
        if longest:
            np.maximum(distance, np.minimum(along, before[:-1], out=along), out=cost[1:])
        else:
            np.minimum(along + distance, before[:-1] + 2.0 * distance, out=cost[1:])
        before, last, cost = last, cost, before
        cost[0] = np.inf  # the corner counts once
    return float(last[n])
