"""What a lens model leaves in the corners, apart from their noise.

Corners are found each by itself: their noise is white. What the model cannot follow is smooth in
the picture, so that neighbouring corners share it. The mean product of neighbours' residuals is
therefore its variance, but for the part of the noise that the estimate has followed: residuals have
E[r_i r_j] = -σ² H_ij, and the hat matrix H of a smooth model is for neighbours what it is on its
diagonal, on average unknowns over measurements.
"""

from collections.abc import Sequence

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.calibration.bundle import Adjusted
from app.tracking.calibration.views import BoardView


def misfit_px(views: Sequence[BoardView], adjusted: Adjusted, unknowns: int) -> float:
    """Return the standard deviation per axis of what the model leaves besides noise [px].

    Args:
        views: in the order of `adjusted.residuals`; more residuals may follow.
        adjusted: the estimate.
        unknowns: how many it has, the boards' poses included.
    """
    products, count = 0.0, 0
    for view, residual in zip(views, adjusted.residuals, strict=False):
        total, pairs = _of_neighbours(view, residual)
        products, count = products + total, count + pairs
    if not count:
        return 0.0
    measured = 2 * sum(len(residual) for residual in adjusted.residuals)
    followed = adjusted.sigma_px**2 * min(1.0, unknowns / measured)
    return float(np.sqrt(max(0.0, products / (2 * count) + followed)))


def _of_neighbours(view: BoardView, residual: FloatArray) -> tuple[float, int]:
    """Sum of the products of neighbouring corners' residuals, and how many pairs there are."""
    board = view.board
    known_at = np.full((board.count, 2), np.nan)
    known_at[view.ids] = residual
    grid = known_at.reshape(board.rows, board.columns, 2)
    total, pairs = 0.0, 0
    for one, other in ((grid[1:], grid[:-1]), (grid[:, 1:], grid[:, :-1])):
        product = (one * other).sum(axis=2)
        known = np.isfinite(product)
        total, pairs = total + float(product[known].sum()), pairs + int(known.sum())
    return total, pairs
