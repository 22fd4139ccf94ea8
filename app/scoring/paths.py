"""Lengths of sampled paths, raw and without the jitter of the measurement."""

import numpy as np

from app.core.arrays import FloatArray

WINDOW = 0.5
"""Positions are averaged over blocks of this duration [s] before a path is measured."""


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
    if len(points) < 3:
        return raw_length(points)
    blocks = np.floor((time - time[0]) / window)
    starts = np.flatnonzero(np.diff(blocks, prepend=-1.0))
    counts = np.diff(starts, append=len(points))
    means = np.add.reduceat(points, starts, axis=0) / counts[:, None]
    return raw_length(np.vstack([points[:1], means, points[-1:]]))
