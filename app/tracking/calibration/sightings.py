"""What an adjustment starts from: boards seen by cameras; and how predictions change with both."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, crosses
from app.core.transform import RigidTransform
from app.tracking.optics.distortion import distort_with_derivatives


def project(points: FloatArray, p: FloatArray) -> FloatArray:
    """Pixels of points, (n, 3) -> (n, 2); see `project_with_derivatives`."""
    xy = points[:, :2] / points[:, 2:]
    pixels: FloatArray = p[:2] * distort_with_derivatives(xy, p[4:])[0] + p[2:4]
    return pixels


def project_with_derivatives(
    points: FloatArray, p: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Pixels (n, 2), their derivatives by the point (n, 2, 3) and by the parameters (n, 2, m).

    Args:
        points: in the camera's frame, in front of it [m], shape (n, 3).
        p: fx, fy, cx, cy and the lens' coefficients, whose number tells the model (see
            `optics.distortion`), shape (m,); unchecked.
    """
    z = points[:, 2]
    xy = points[:, :2] / z[:, None]
    bent, by_xy, by_lens = distort_with_derivatives(xy, p[4:])
    focal = p[:2]
    by_point = np.empty((len(points), 2, 3))
    by_point[:, :, :2] = focal[:, None] * by_xy / z[:, None, None]
    by_point[:, :, 2] = -(by_point[:, :, :2] * xy[:, None]).sum(axis=2)
    by_parameter = np.zeros((len(points), 2, p.size))
    by_parameter[:, 0, 0], by_parameter[:, 1, 1] = bent[:, 0], bent[:, 1]
    by_parameter[:, 0, 2] = by_parameter[:, 1, 3] = 1.0
    by_parameter[:, :, 4:] = focal[:, None] * by_lens
    return focal * bent + p[2:4], by_point, by_parameter


@dataclass(frozen=True, eq=False)
class SeenBoard:
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
class AdjustedState:
    """What is estimated.

    Attributes:
        parameters: of each camera, shape (cameras, m): both have the same model of the lens.
        T_right_left: identity for one camera.
        poses: T_left_board of every board.
    """

    parameters: FloatArray
    T_right_left: RigidTransform
    poses: tuple[RigidTransform, ...]


def rows(
    seen: SeenBoard, state: AdjustedState, size: int
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
    count = state.parameters.shape[1]
    by_global = np.zeros((len(points), 2, size))
    by_global[:, :, seen.camera * count : (seen.camera + 1) * count] = by_parameter
    if seen.camera == 1:
        by_global[:, :, 2 * count :] = _by_twist(by_point, points)
    residual = (seen.pixels - uv).ravel()
    by_board = _by_twist(by_left, p_left)
    return residual, by_global.reshape(-1, size), by_board.reshape(-1, 6)


def _by_twist(by_point: FloatArray, points: FloatArray) -> FloatArray:
    """Differentiate by a twist on the left of the pose that made the points: [I | -[p]x]."""
    turn = crosses(points[:, None, :], by_point)  # row·(ω x p) = ω·(p x row)
    return np.concatenate([by_point, turn], axis=2)
