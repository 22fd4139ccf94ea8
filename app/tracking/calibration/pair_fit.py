"""Pairs of views against two cameras that are known."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from app.core.transform import RigidTransform
from app.tracking.calibration.bundle import Adjusted, adjust, rms
from app.tracking.calibration.corner_order import turns
from app.tracking.calibration.poses import board_pose
from app.tracking.calibration.sightings import SeenBoard
from app.tracking.calibration.validation import ViewPair
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError


def matched(pair: ViewPair, adjusted: Adjusted) -> ViewPair:
    """Return a pair with its right picture numbered as the left one, by cameras that are known."""
    left, right = pair
    T_left_board, _ = board_pose(left, adjusted.state.parameters[0])
    best = min(
        turns(left.board),
        key=lambda order: _pair_error(left, right.reordered(order), T_left_board, adjusted),
    )
    return left, right.reordered(best)


def matched_residual(pair: ViewPair, adjusted: Adjusted) -> float:
    """Root mean square residual of a pair that took no part, its board's pose fitted [px]."""
    T_left_board, _ = board_pose(pair[0], adjusted.state.parameters[0])
    return _pair_error(*pair, T_left_board, adjusted)


def _pair_error(
    left: BoardView, right: BoardView, T_left_board: RigidTransform, adjusted: Adjusted
) -> float:
    """Root mean square residual of a pair whose board pose alone is fitted [px]."""
    start = replace(adjusted.state, poses=(T_left_board,))
    none = np.zeros(adjusted.state.parameters.shape, dtype=bool)
    try:
        found = adjust(pair_sightings([(left, right)]), start, none, rounds=20, pose_free=False)
    except CalibrationError:
        return float("inf")
    return found.rms_px


def pair_sightings(pairs: Sequence[ViewPair]) -> list[SeenBoard]:
    """List what both cameras saw of the boards of pairs, left and right in turn."""
    return [
        SeenBoard(i, side, view.points, view.pixels)
        for i, pair in enumerate(pairs)
        for side, view in enumerate(pair)
    ]


def pair_residuals(adjusted: Adjusted, pairs: int) -> list[float]:
    """Root mean square residual of each pair, both pictures together [px]."""
    both = adjusted.residuals[: 2 * pairs]
    return [rms(np.concatenate(both[i : i + 2])) for i in range(0, len(both), 2)]
