"""Volumes at reduced size: voxels averaged in blocks."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, frozen


def reduced_block(slices: NDArray[Any], factors: tuple[int, int]) -> NDArray[Any]:
    """Average a few slices to one of fewer pixels.

    Args:
        slices: shape (n, rows, columns), int16 or float32.
        factors: pixels of a block along i and j, at most as many as there are; what is left over
            at the far ends is left out.

    Returns:
        Means, shape (rows // j, columns // i), rounded to the nearest where the input is whole.
    """
    i, j = factors
    count, rows, columns = len(slices), slices.shape[1] // j, slices.shape[2] // i
    whole = slices[:, : rows * j, : columns * i].reshape(count, rows, j, columns, i)
    mean: NDArray[Any] = whole.mean(axis=(0, 2, 4), dtype=np.float64)
    return np.rint(mean) if slices.dtype.kind == "i" else mean


def reduced_affine(affine_mm: FloatArray, factors: tuple[int, int, int]) -> FloatArray:
    """Affine of a volume after averaging: centres of the blocks, shape (4, 4) -> the same."""
    scale = np.diag([*map(float, factors), 1.0])
    scale[:3, 3] = (np.array(factors) - 1.0) / 2.0
    return frozen(affine_mm @ scale, (4, 4), "affine")
