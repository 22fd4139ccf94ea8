"""Voxels inside closed lines, by the even-odd rule: holes, islands in them, and keyholes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray


def even_odd(lines: Sequence[FloatArray], shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Which pixel centres lie inside an odd number of lines.

    A contour inside another one is a hole, one inside that an island; a keyhole (one line that runs
    in to the hole through a channel and back again) gives the same, since the channel has no width.

    Args:
        lines: closed lines of points (column, row) as floats, each of shape (n, 2); the last point
            is joined to the first.
        shape: rows and columns of the picture.

    Returns:
        Shape (rows, columns).
    """
    rows, columns = shape
    toggles = np.zeros((rows, columns + 1), np.uint8)
    for line in lines:
        start, end = line, np.roll(line, -1, axis=0)
        low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
        # rows whose centre lies in [low, high): a corner on a row counts once
        first = np.clip(np.ceil(low), 0, rows).astype(np.intp)
        last = np.clip(np.ceil(high), 0, rows).astype(np.intp)
        count = last - first
        edge = np.repeat(np.arange(len(line)), count)
        row = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + first[edge]
        share = (row - start[edge, 1]) / (end[edge, 1] - start[edge, 1])
        crossing = start[edge, 0] + share * (end[edge, 0] - start[edge, 0])
        column = np.clip(np.ceil(crossing), 0, columns).astype(np.intp)
        np.bitwise_xor.at(toggles, (row, column), 1)
    inside: NDArray[np.bool_] = np.bitwise_xor.accumulate(toggles, axis=1)[:, :-1].astype(bool)
    return inside
