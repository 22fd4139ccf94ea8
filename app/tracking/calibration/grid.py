"""The grid that corners form in a picture: its plane map, cells, handedness and colours."""

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.tracking.calibration.boards import Board


def plane_map(board: Board, ids: NDArray[np.int64], pixels: FloatArray) -> FloatArray | None:
    """Homography from board (x, y) [squares] to pixels, shape (3, 3), or None if there is none.

    Least squares over all corners; lens distortion stays as its residual.
    """
    xy = board.points[ids, :2] / board.square
    if ids.size < 4 or np.linalg.matrix_rank(xy - xy.mean(axis=0), tol=1e-9) < 2:
        return None
    found, _ = cv2.findHomography(xy, pixels, 0)
    if found is None or not np.isfinite(found).all():
        return None
    result: FloatArray = np.asarray(found, dtype=np.float64)
    return result


def mapped(homography: FloatArray, xy: FloatArray) -> FloatArray:
    """Pixels of board points (n, 2) [squares], shape (n, 2)."""
    p = np.column_stack([xy, np.ones(len(xy))]) @ homography.T
    result: FloatArray = p[:, :2] / p[:, 2:]
    return result


def local_axes(homography: FloatArray, xy: FloatArray) -> FloatArray:
    """Differentiate pixels by the board's (x, y) [px per square], shape (n, 2, 2)."""
    p = np.column_stack([xy, np.ones(len(xy))]) @ homography.T
    uv = p[:, :2] / p[:, 2:]
    rows = homography[None, :2, :2] - uv[:, :, None] * homography[None, 2:, :2]
    result: FloatArray = rows / p[:, 2, None, None]
    return result


def extents(axes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Shortest way across a square [px] and foreshortening, each (n,).

    The shortest way is the smaller height of the parallelogram that a square becomes; the
    foreshortening is the ratio of the singular values: the cosine of the tilt, 0 on edge.
    """
    area = np.abs(np.linalg.det(axes))
    longest = np.linalg.norm(axes, axis=1).max(axis=1)
    values = np.linalg.svd(axes, compute_uv=False)
    return area / longest, values[:, 1] / values[:, 0]


def is_mirrored(homography: FloatArray, board: Board) -> bool:
    """Return whether the numbering runs the other way round than on the printed side."""
    middle = np.array([[board.columns - 1, board.rows - 1]]) / 2.0
    return bool(np.linalg.det(local_axes(homography, middle)[0]) < 0.0)


def first_square_is_dark(grey: NDArray[np.uint8], board: Board, pixels: FloatArray) -> bool:
    """Return whether the square between corners 0, 1 and the next row's is a dark one.

    All squares vote: the mean grey of those that should look like the first one against the others.
    """
    grid = pixels.reshape(board.rows, board.columns, 2)
    centres = (grid[:-1, :-1] + grid[1:, :-1] + grid[:-1, 1:] + grid[1:, 1:]) / 4.0
    values = cv2.remap(
        cv2.GaussianBlur(grey, (3, 3), 0),
        centres[..., 0].astype(np.float32),
        centres[..., 1].astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    ).astype(np.float64)
    odd = np.add.outer(np.arange(board.rows - 1), np.arange(board.columns - 1)) % 2
    if not odd.any():
        return True
    return bool(values[odd == 0].mean() < values[odd == 1].mean())


def goes_on(grey: NDArray[np.uint8], board: Board, homography: FloatArray) -> bool:
    """Return whether dark and bright squares go on beyond the one row that surrounds the inner
    corners.

    Then the print has more corners than the board was said to have, and the ones found are some of
    them: others in every picture. The outermost squares of a print may be trimmed, so the place
    just behind that row counts.
    """
    x, y = np.arange(board.columns + 1) - 0.5, np.arange(board.rows + 1) - 0.5
    inner = _alternation(grey, homography, np.stack(np.meshgrid(x[1:-1], y[1:-1]), -1))
    if inner is None or abs(inner) < 1.0:
        return False
    behind = [np.column_stack([np.full(y.size, place), y]) for place in (-_BEHIND, x[-1] + 0.7)]
    behind += [np.column_stack([x, np.full(x.size, place)]) for place in (-_BEHIND, y[-1] + 0.7)]
    values = [_alternation(grey, homography, row) for row in behind]
    return any(value is not None and abs(value / inner) > _MORE for value in values)


_BEHIND = 1.2
"""Distance from the outermost corners at which no square may be any more [squares]."""

_MORE = 0.5
"""Contrast, in parts of the board's, from which a row of squares is one."""


def _alternation(
    grey: NDArray[np.uint8], homography: FloatArray, centres: FloatArray
) -> float | None:
    """Mean grey of every other square less that of those between; None outside the picture."""
    xy = centres.reshape(-1, 2)
    uv = mapped(homography, xy)
    size = np.array(grey.shape[::-1]) - 1.0
    inside = (uv >= 0.0).all(axis=1) & (uv <= size).all(axis=1)
    odd = np.rint((xy + 0.5).sum(axis=1)).astype(np.int64) % 2 == 1
    if (inside & odd).sum() < 2 or (inside & ~odd).sum() < 2:
        return None
    column, row = np.rint(np.clip(uv, 0.0, size)).astype(np.int64).T
    values = grey[row, column].astype(np.float64)
    return float(values[inside & odd].mean() - values[inside & ~odd].mean())
