"""Pictures of boards with known truth, and where to hold a board before a camera."""

import numpy as np
from numpy.typing import NDArray

from app.core.transform import RigidTransform
from app.tracking.calibration.boards import Board
from app.tracking.optics.camera_model import CameraModel
from app.tracking.simulated.board import BoardRenderer


def board_picture(
    board: Board,
    model: CameraModel,
    T_camera_board: RigidTransform,
    *,
    blur: float = 0.6,
    seed: int = 0,
    supersample: int = 3,
) -> NDArray[np.uint8]:
    """Picture of a board, blurred [px], with noise of 2 levels."""
    rng = np.random.default_rng(seed)
    return BoardRenderer(model, board, supersample).render(T_camera_board, blur, 2.0, rng)


def board_pose(
    board: Board,
    distance: float,
    x_deg: float = 0.0,
    y_deg: float = 0.0,
    roll_deg: float = 0.0,
    aside: tuple[float, float] = (0.0, 0.0),
) -> RigidTransform:
    """T_camera_board: the board's middle at a distance [m] and aside [m], turned [deg].

    Positive `y_deg` brings the board's right side nearer, positive `x_deg` its lower side.
    """
    middle = board.points.mean(axis=0)
    turn = (
        RigidTransform.exp([0, 0, 0, np.radians(-x_deg), 0, 0])
        @ RigidTransform.exp([0, 0, 0, 0, np.radians(y_deg), 0])
        @ RigidTransform.exp([0, 0, 0, 0, 0, np.radians(roll_deg)])
    )
    return (
        RigidTransform.from_translation([*aside, distance])
        @ turn
        @ RigidTransform.from_translation(-middle)
    )
