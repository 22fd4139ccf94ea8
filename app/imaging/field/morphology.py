"""Shapes of masks: grown, shrunk, pooled, filled and taken apart, in shifts of whole arrays."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

Mask = NDArray[np.bool_]


def grown(mask: Mask, steps: int = 1) -> Mask:
    """Return a mask grown by voxels along the axes."""
    for _ in range(steps):
        result = mask.copy()
        for axis in range(3):
            here, there = np.moveaxis(result, axis, 0), np.moveaxis(mask, axis, 0)
            here[1:] |= there[:-1]
            here[:-1] |= there[1:]
        mask = result
    return mask


def shrunk(mask: Mask, steps: int = 1) -> Mask:
    """Return a mask shrunk by voxels along the axes; beyond the array it goes on."""
    return ~grown(~mask, steps)


def closed(mask: Mask, steps: int) -> Mask:
    """Return a mask with its gaps of up to twice so many voxels closed."""
    return shrunk(grown(mask, steps), steps)


def pooled(values: NDArray[Any], factor: int, how: Any = np.maximum) -> NDArray[Any]:
    """Return blocks of voxels taken together by their maximum, or by another ufunc.

    In whole strided arrays: a quarter of the time of `reduceat`.
    """
    for axis in range(3):
        before = (slice(None),) * axis
        result = values[(*before, slice(0, None, factor))].copy()
        for n in range(1, factor):
            part = values[(*before, slice(n, None, factor))]
            there = result[(*before, slice(0, part.shape[axis]))]
            how(there, part, out=there)
        values = result
    return values


def spread(values: NDArray[Any], factor: int, shape: tuple[int, ...]) -> NDArray[Any]:
    """Return each value for all voxels of its block; undoes `pooled` but for what it lost."""
    for axis in range(3):
        values = values.repeat(factor, axis=axis)
    return values[: shape[0], : shape[1], : shape[2]]


def pieces(mask: Mask) -> tuple[NDArray[np.int32], int]:
    """Return the number of each voxel's connected piece, 0 outside, and how many there are."""
    labels, count = ndimage.label(mask, np.ones((3, 3, 3), bool))
    return labels, int(count)


def filled(mask: Mask, axis: int) -> Mask:
    """Fill what each plane across an axis encloses."""
    joined = ndimage.generate_binary_structure(3, 1)
    joined[(slice(None),) * axis + ([0, 2],)] = False
    parts, count = ndimage.label(~mask, joined)
    is_open = np.zeros(count + 1, bool)
    for across in {0, 1, 2} - {axis}:
        is_open[np.moveaxis(parts, across, 0)[[0, -1]]] = True
    is_open[0] = False
    return ~is_open[parts]


def smoothed(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return values averaged 1 : 2 : 1 along each axis, edges carried on; in place."""
    for axis in range(3):
        along = np.moveaxis(values, axis, 0)
        if len(along) < 3:
            continue
        previous = along[0].copy()
        for n in range(len(along)):
            following = along[min(n + 1, len(along) - 1)]
            mean = 0.25 * previous + 0.5 * along[n] + 0.25 * following
            previous = along[n].copy()
            along[n] = mean
    return values


def counts_by(labels: NDArray[Any], count: int) -> NDArray[np.intp]:
    """Return how many voxels each number has, shape (count + 1,)."""
    return np.bincount(labels.ravel(), minlength=count + 1)
