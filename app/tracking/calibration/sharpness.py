"""How sharp the squares' edges are."""

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.tracking.calibration.boards import Board, BoardKind
from app.tracking.calibration.grid import local_axes, mapped

_REACH = 8.0
"""Profiles reach this far to both sides of an edge [px]."""

_SAMPLES = 33


def edge_width(
    grey: NDArray[np.uint8], board: Board, homography: FloatArray, seen: FloatArray
) -> float:
    """Width of the edges of the squares between the corners `seen` [px].

    The step's height over its steepest slope, median over all edges: for a step blurred by a
    Gaussian that is its width from 10 to 90 % (within 2 %). Profiles end where the next corner's
    square or a ChArUco marker begins.

    Args:
        grey: picture, shape (h, w).
        board: which board.
        homography: board [squares] to pixels.
        seen: board points of the corners found [squares], shape (n, 2).
    """
    columns = _edges(grey, board, homography, seen, 0)
    rows = _edges(grey, board, homography, seen, 1)
    widths = np.concatenate([columns, rows])
    return float(np.median(widths)) if widths.size else 0.0


def _edges(
    grey: NDArray[np.uint8], board: Board, homography: FloatArray, seen: FloatArray, along: int
) -> FloatArray:
    """Widths of the edges that run along x (0) or y (1)."""
    step = np.eye(2)[along]
    known = {tuple(point) for point in np.rint(seen).astype(int)}
    starts = [p for p in known if (p[0] + int(step[0]), p[1] + int(step[1])) in known]
    if not starts:
        return np.zeros(0)
    middle = np.array(sorted(starts)) + 0.5 * step
    axes = local_axes(homography, middle)
    height = np.abs(np.linalg.det(axes)) / np.linalg.norm(axes[:, :, along], axis=1)
    margin = (
        0.4 if board.kind is BoardKind.CHECKERBOARD else 0.5 * (1 - board.marker / board.square)
    )
    reach = np.minimum(margin, _REACH / height)  # [squares]
    t = np.linspace(-1.0, 1.0, _SAMPLES)
    place = mapped(homography, middle)[:, None, :] + (
        (reach[:, None] * t)[..., None] * axes[:, None, :, 1 - along]
    )
    values = cv2.remap(
        grey,
        place[..., 0].astype(np.float32),
        place[..., 1].astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    ).astype(np.float64)
    return _widths(values, 2.0 * reach * height / (_SAMPLES - 1))


def _widths(values: FloatArray, spacing: FloatArray) -> FloatArray:
    """Step over slope of profiles (n, samples) sampled at `spacing` [px], (n,)."""
    step = np.ptp(values, axis=1)
    apart = np.clip(np.rint(1.0 / np.maximum(spacing, 1e-9)), 1, _SAMPLES // 4).astype(int)
    slope = np.empty(len(values))
    for count in np.unique(apart):
        rows = apart == count
        change = np.abs(values[rows, count:] - values[rows, :-count]).max(axis=1)
        slope[rows] = change / (count * spacing[rows])
    clear = (step > 8.0) & (slope > 0.0)
    result: FloatArray = step[clear] / slope[clear]
    return result
