"""Pictures that were mirrored on the way: what they look like, and how they are told.

A checkerboard is its own mirror image, so one mirrored picture of it looks like a picture from
another place. Two cameras give it away: no T_right_left fits both, until one side is mirrored back.
"""

from collections.abc import Sequence

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.calibration.corner_order import PosedPair, agree
from app.tracking.calibration.poses import board_pose
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError


def mirrored_view(view: BoardView) -> BoardView:
    """Return the view as the picture mirrored left to right shows it."""
    board = view.board
    ids = np.arange(board.count).reshape(board.rows, board.columns)[:, ::-1].ravel()
    pixels = view.pixels.copy()
    pixels[:, 0] = view.image_size[0] - 1.0 - pixels[:, 0]
    return BoardView(board, ids[view.ids], pixels, view.image_size, name=view.name)


def mirrored_camera(parameters: FloatArray, width: int) -> FloatArray:
    """Return the camera that mirrored pictures seem to come from: cx and p2 change their side."""
    result = parameters.copy()
    result[2] = width - 1.0 - parameters[2]
    result[7] = -parameters[7]
    return result


def one_side_is_mirrored(pairs: Sequence[PosedPair], right_camera: FloatArray) -> bool:
    """Whether the pairs agree once the right pictures are mirrored back."""
    width = pairs[0].right.image_size[0]
    camera = mirrored_camera(right_camera, width)
    try:
        turned = []
        for pair in pairs:
            view = mirrored_view(pair.right)
            turned.append(
                PosedPair(pair.left, view, pair.T_left_board, board_pose(view, camera)[0])
            )
        found = agree(turned, camera)
    except CalibrationError:
        return False
    return bool(found.agreeing.mean() > 0.5)
