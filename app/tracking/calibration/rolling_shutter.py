"""Whether the board moved while the rows of its pictures were read: a rolling shutter.

A sensor that is read row by row sees each row a little later. A board that moves meanwhile by a
twist ξ looks bent, in each picture differently: its corners stand at J·ξ·s off, with J their change
with the board's pose and s the row, in parts of the picture's height about the board's middle. No
lens and no pose follows that, and the focal length comes out wrong while the residual looks usual.

Freeing ξ in every picture takes away six unknowns each; the F test tells whether that is beyond
chance. It would be as well for a board that is not flat or misprinted, and for a lens that its
model does not follow. Such a board is bent in every picture alike: corners that may be off on the
board then explain more. Such a lens leaves what neighbouring corners share (`misfit`); motion takes
it.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.tracking.calibration.bundle import Adjusted
from app.tracking.calibration.misfit import misfit_px
from app.tracking.calibration.sightings import SeenBoard, SightedBoards
from app.tracking.calibration.views import BoardView

LEAST_VIEWS: Final = 5

LEAST_F: Final = 6.0
"""F statistic from which motion shows: still boards come to 5 where noise is strong."""

LEFT: Final = 0.5
"""Share of what neighbouring corners had in common that motion may leave."""

_MOTION: Final = 6
"""Unknowns of a motion."""


def moved_px(views: Sequence[BoardView], adjusted: Adjusted) -> float | None:
    """Return by how much boards moved from the first to the last row read, if the views show it.

    Args:
        views: of one camera, in the order of the estimate's poses.
        adjusted: the camera.

    Returns:
        Root mean square over views of what a rolling shutter shifted the corners by, beyond what a
        pose follows [px]; None if nothing speaks for one.
    """
    if len(views) < LEAST_VIEWS:
        return None
    parts = [_linear(i, view, adjusted) for i, view in enumerate(views)]
    if any(part is None for part in parts):
        return None
    known = [part for part in parts if part is not None]
    still = [residual for residual, _, _ in known]
    after = [
        residual - motion @ np.linalg.lstsq(motion, residual, rcond=None)[0]
        for residual, motion, _ in known
    ]
    squares, rest = (float(sum(r @ r for r in each)) for each in (still, after))
    count = _MOTION * len(views)
    freedom = sum(r.size for r in still) - 2 * count
    if freedom <= 0 or rest <= 0.0:
        return None
    moved = squares - rest
    if moved / count < LEAST_F * rest / freedom or moved < 2.0 * _by_board(views, known):
        return None
    left = [
        _shared(views, adjusted, each, total / (freedom + more), unknowns)
        for each, total, more, unknowns in (
            (still, squares, count, count),
            (after, rest, 0, 2 * count),
        )
    ]
    if left[1] > LEFT * left[0]:
        return None
    return float(np.sqrt(moved / sum(len(view.ids) for view in views)))


def rolling_remark(name: str, moved: float) -> str:
    """Say that a rolling shutter shows, what it does and what to do."""
    return sentence(
        "{name}: the board moved while its pictures were read row by row (rolling shutter): "
        "it looks bent differently in each, by {moved:.2g} px, and focal length and "
        "distances come out wrong; lay the board down or hold it against something still, "
        "and take the pictures again, or use a camera with a global shutter",
        name=name,
        moved=moved,
    )


_Linear = tuple[FloatArray, FloatArray, FloatArray]


def _linear(number: int, view: BoardView, adjusted: Adjusted) -> _Linear | None:
    """Residual (2n,), and its change by motion (2n, 6) and by corners (2n, 3n), beside the pose."""
    state = adjusted.state
    seen = SightedBoards([SeenBoard(0, 0, view.points, view.pixels)], 0)
    pose = state.poses[number]
    linear = seen.linearised(
        state.parameters[0], pose.rotation[None], pose.translation[None], state.T_right_left
    )
    if linear is None:
        return None
    residual, by_pose = linear[0].ravel(), linear[2].reshape(-1, 6)
    height = view.pixels[:, 1] - view.pixels[:, 1].mean()
    late = np.repeat(height / view.image_size[1], 2)[:, None]
    basis = np.linalg.qr(by_pose)[0]
    by_point = by_pose[:, :3] @ state.poses[number].rotation
    corners = np.zeros((residual.size, 3 * view.board.count))
    for i, corner in enumerate(view.ids):
        corners[2 * i : 2 * i + 2, 3 * corner : 3 * corner + 3] = by_point[2 * i : 2 * i + 2]
    beside = [part - basis @ (basis.T @ part) for part in (residual, by_pose * late, corners)]
    return beside[0], beside[1], beside[2]


def _by_board(views: Sequence[BoardView], known: Sequence[_Linear]) -> float:
    """Sum of squares that corners off on the board explain, the same in every view [px²]."""
    size = 3 * views[0].board.count
    normal, right = np.zeros((size, size)), np.zeros(size)
    for residual, _, corners in known:
        normal += corners.T @ corners
        right += corners.T @ residual
    return float(right @ np.linalg.lstsq(normal, right, rcond=1e-9)[0])


def _shared(
    views: Sequence[BoardView],
    adjusted: Adjusted,
    residuals: Sequence[FloatArray],
    variance: float,
    unknowns: int,
) -> float:
    """Deviation that neighbouring corners share [px]."""
    each = tuple(residual.reshape(-1, 2) for residual in residuals)
    changed = replace(adjusted, residuals=each, sigma_px=float(np.sqrt(variance)))
    return misfit_px(views, changed, unknowns)
