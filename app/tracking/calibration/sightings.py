"""What an adjustment starts from: boards seen by cameras; and how predictions change with both."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.tracking.calibration.lens import project_with_derivatives


@dataclass(frozen=True, eq=False)
class Sighting:
    """A board seen by a camera.

    Attributes:
        pose: number of the board's pose.
        camera: 0 left, 1 right.
        points: in the board's frame [m], shape (n, 3).
        pixels: shape (n, 2).
    """

    pose: int
    camera: int
    points: FloatArray
    pixels: FloatArray


@dataclass(frozen=True, eq=False)
class State:
    """What is estimated.

    Attributes:
        parameters: of each camera, shape (cameras, 9), in the order of `PARAMETERS`.
        T_right_left: identity for one camera.
        poses: T_left_board of every board.
    """

    parameters: FloatArray
    T_right_left: RigidTransform
    poses: tuple[RigidTransform, ...]


def rows(
    seen: Sighting, state: State, size: int
) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """Residuals (2n,), and derivatives of the prediction by cameras (2n, size), board (2n, 6)."""
    p_left = state.poses[seen.pose] @ seen.points
    points = p_left if seen.camera == 0 else state.T_right_left @ p_left
    if not (np.isfinite(points).all() and points[:, 2].min() > 1e-6):
        return None
    uv, by_point, by_parameter = project_with_derivatives(points, state.parameters[seen.camera])
    if not np.isfinite(uv).all():
        return None
    by_left = by_point if seen.camera == 0 else by_point @ state.T_right_left.rotation
    by_global = np.zeros((len(points), 2, size))
    by_global[:, :, 9 * seen.camera : 9 * seen.camera + 9] = by_parameter
    if seen.camera == 1:
        by_global[:, :, 18:] = _by_twist(by_point, points)
    residual = (seen.pixels - uv).ravel()
    by_board = _by_twist(by_left, p_left)
    return residual, by_global.reshape(-1, size), by_board.reshape(-1, 6)


def _by_twist(by_point: FloatArray, points: FloatArray) -> FloatArray:
    """Differentiate by a twist on the left of the pose that made the points: [I | -[p]x]."""
    turn = np.cross(points[:, None, :], by_point)  # row·(ω x p) = ω·(p x row)
    return np.concatenate([by_point, turn], axis=2)
