"""What an adjustment starts from: boards seen by cameras; and how predictions change with both."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, crosses
from app.core.transform import RigidTransform


def project(points: FloatArray, p: FloatArray) -> FloatArray:
    """Pixels of points in the camera's frame, (n, 3) [m] -> (n, 2); as `CameraModel`, unchecked.

    Args:
        points: in front of the camera.
        p: parameters in the order of `optics.calibration.PARAMETERS`, shape (9,).
    """
    x, y = points[:, 0] / points[:, 2], points[:, 1] / points[:, 2]
    r2 = x * x + y * y
    g = 1.0 + r2 * (p[4] + r2 * (p[5] + r2 * p[8]))
    u = x * g + 2.0 * p[6] * x * y + p[7] * (r2 + 2.0 * x * x)
    v = y * g + p[6] * (r2 + 2.0 * y * y) + 2.0 * p[7] * x * y
    return np.column_stack([p[0] * u + p[2], p[1] * v + p[3]])


def project_with_derivatives(
    points: FloatArray, p: FloatArray
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Pixels (n, 2), their derivatives by the point (n, 2, 3) and by the parameters (n, 2, 9)."""
    z = points[:, 2]
    x, y = points[:, 0] / z, points[:, 1] / z
    r2 = x * x + y * y
    g = 1.0 + r2 * (p[4] + r2 * (p[5] + r2 * p[8]))
    slope = p[4] + r2 * (2.0 * p[5] + r2 * 3.0 * p[8])  # dg/d(r²)
    u = x * g + 2.0 * p[6] * x * y + p[7] * (r2 + 2.0 * x * x)
    v = y * g + p[6] * (r2 + 2.0 * y * y) + 2.0 * p[7] * x * y
    xx = g + 2.0 * x * x * slope + 2.0 * p[6] * y + 6.0 * p[7] * x
    xy = 2.0 * x * y * slope + 2.0 * p[6] * x + 2.0 * p[7] * y
    yy = g + 2.0 * y * y * slope + 6.0 * p[6] * y + 2.0 * p[7] * x

    by_point = np.empty((len(points), 2, 3))
    by_point[:, 0, 0], by_point[:, 0, 1] = p[0] * xx / z, p[0] * xy / z
    by_point[:, 1, 0], by_point[:, 1, 1] = p[1] * xy / z, p[1] * yy / z
    by_point[:, :, 2] = -(by_point[:, :, 0] * x[:, None] + by_point[:, :, 1] * y[:, None])

    by_parameter = np.zeros((len(points), 2, 9))
    by_parameter[:, 0, 0], by_parameter[:, 1, 1] = u, v
    by_parameter[:, 0, 2] = by_parameter[:, 1, 3] = 1.0
    for place, power in ((4, r2), (5, r2 * r2), (8, r2 * r2 * r2)):
        by_parameter[:, 0, place], by_parameter[:, 1, place] = p[0] * x * power, p[1] * y * power
    by_parameter[:, 0, 6], by_parameter[:, 1, 6] = 2.0 * p[0] * x * y, p[1] * (r2 + 2.0 * y * y)
    by_parameter[:, 0, 7], by_parameter[:, 1, 7] = p[0] * (r2 + 2.0 * x * x), 2.0 * p[1] * x * y
    return np.column_stack([p[0] * u + p[2], p[1] * v + p[3]]), by_point, by_parameter


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
        parameters: of each camera, shape (cameras, 9), in the order of `PARAMETERS`.
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
    by_global = np.zeros((len(points), 2, size))
    by_global[:, :, 9 * seen.camera : 9 * seen.camera + 9] = by_parameter
    if seen.camera == 1:
        by_global[:, :, 18:] = _by_twist(by_point, points)
    residual = (seen.pixels - uv).ravel()
    by_board = _by_twist(by_left, p_left)
    return residual, by_global.reshape(-1, size), by_board.reshape(-1, 6)


def _by_twist(by_point: FloatArray, points: FloatArray) -> FloatArray:
    """Differentiate by a twist on the left of the pose that made the points: [I | -[p]x]."""
    turn = crosses(points[:, None, :], by_point)  # row·(ω x p) = ω·(p x row)
    return np.concatenate([by_point, turn], axis=2)
