"""Values between voxels: nearest, trilinear and tricubic (Catmull-Rom)."""

from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray


class Interpolation(StrEnum):
    """Ways to read a value between voxel centres."""

    NEAREST = "nearest"
    TRILINEAR = "trilinear"
    CUBIC = "cubic"


def interpolate(
    values: NDArray[Any], ijk: FloatArray, way: Interpolation = Interpolation.TRILINEAR
) -> FloatArray:
    """Read an array between its voxels; beyond the outermost centres the edge value goes on.

    Args:
        values: shape (K, J, I).
        ijk: indices as floats (i, j, k), shape (n, 3), finite.
        way: nearest; trilinear (exact for linear fields); cubic (Catmull-Rom, exact for
            quadratic fields away from the edges).

    Returns:
        Shape (n,).
    """
    kji = np.asarray(ijk, np.float64)[:, ::-1]
    if way is Interpolation.NEAREST:
        index = _clamped(np.floor(kji + 0.5).astype(np.intp), values.shape)
        return values[index[:, 0], index[:, 1], index[:, 2]].astype(np.float64)
    last = np.array(values.shape) - 1
    kji = np.clip(kji, 0, last)
    base = np.minimum(np.floor(kji).astype(np.intp), np.maximum(last - 1, 0))
    fraction = kji - base
    offsets, weights = _kernel(fraction, way)
    return _separable(values, base, offsets, weights)


def _kernel(fraction: FloatArray, way: Interpolation) -> tuple[range, FloatArray]:
    """Offsets of the taps and their weights, shape (taps, n, 3)."""
    t = fraction
    if way is Interpolation.TRILINEAR:
        return range(2), np.stack([1.0 - t, t])
    weights = [
        0.5 * (-t + 2.0 * t**2 - t**3),
        0.5 * (2.0 - 5.0 * t**2 + 3.0 * t**3),
        0.5 * (t + 4.0 * t**2 - 3.0 * t**3),
        0.5 * (-(t**2) + t**3),
    ]
    return range(-1, 3), np.stack(weights)


def _separable(
    values: NDArray[Any], base: NDArray[np.intp], offsets: range, weights: FloatArray
) -> FloatArray:
    total = np.zeros(len(base))
    for a, dk in enumerate(offsets):
        k = _clamped(base[:, 0] + dk, values.shape[0])
        for b, dj in enumerate(offsets):
            j = _clamped(base[:, 1] + dj, values.shape[1])
            plane = weights[a, :, 0] * weights[b, :, 1]
            for c, di in enumerate(offsets):
                i = _clamped(base[:, 2] + di, values.shape[2])
                total += plane * weights[c, :, 2] * values[k, j, i]
    return total


def _clamped(index: NDArray[np.intp], size: int | tuple[int, ...]) -> NDArray[np.intp]:
    return np.clip(index, 0, np.array(size) - 1)
