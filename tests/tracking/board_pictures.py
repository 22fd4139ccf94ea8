"""Pictures of boards with known truth: drawn through a camera model, distortion included."""

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.transform import RigidTransform
from app.tracking.calibration.boards import Board
from app.tracking.calibration.pattern import dark_rectangles
from app.tracking.optics.camera_model import CameraModel

_PER_SQUARE = 40


@lru_cache
def texture(board: Board) -> NDArray[np.uint8]:
    """The print with a white rim of one square; 40 pixels a square."""
    scale = _PER_SQUARE / board.square
    height, width = (board.rows + 3) * _PER_SQUARE, (board.columns + 3) * _PER_SQUARE
    picture = np.full((height, width), 235, np.uint8)
    for x, y, w, h in dark_rectangles(board) * scale + [_PER_SQUARE, _PER_SQUARE, 0, 0]:
        picture[round(y) : round(y + h), round(x) : round(x + w)] = 25
    return cv2.GaussianBlur(picture, (0, 0), 0.7)


def board_picture(
    board: Board,
    model: CameraModel,
    T_camera_board: RigidTransform,
    *,
    blur: float = 0.7,
    noise: float = 2.0,
    seed: int = 0,
) -> NDArray[np.uint8]:
    """Picture of a board before grey; twice oversampled, then blurred [px] and noisy [levels]."""
    width, height = model.image_size
    u, v = np.meshgrid((np.arange(2 * width) - 0.5) / 2, (np.arange(2 * height) - 0.5) / 2)
    rays, found = model.undistort(np.column_stack([u.ravel(), v.ravel()]))
    R, t = T_camera_board.rotation, T_camera_board.translation
    homography = np.linalg.inv(np.column_stack([R[:, 0], R[:, 1], t]))
    p = np.column_stack([rays, np.ones(len(rays))]) @ homography.T
    # The texture's pixel (0, 0) is centred half a pixel in; the first inner corner 2 squares in.
    xy = p[:, :2] / p[:, 2:] / board.square * _PER_SQUARE + 2.0 * _PER_SQUARE - 0.5
    xy[~found | (p[:, 2] <= 0.0)] = -1e4
    maps = xy.reshape(2 * height, 2 * width, 2).astype(np.float32)
    fine = cv2.remap(
        texture(board),
        maps[..., 0],
        maps[..., 1],
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_CONSTANT,
        borderValue=110,
    )
    picture = cv2.resize(fine, (width, height), interpolation=cv2.INTER_AREA).astype(np.float64)
    if blur > 0.0:
        picture = cv2.GaussianBlur(picture, (0, 0), blur)
    picture += noise * np.random.default_rng(seed).normal(size=picture.shape)
    return np.clip(np.rint(picture), 0, 255).astype(np.uint8)


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
