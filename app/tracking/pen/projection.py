"""Derivatives of the projection: with points, and with the camera's parameters."""

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.distortion import distortion_jacobian


def skews(points: FloatArray) -> FloatArray:
    """Cross-product matrices, (n, 3) -> (n, 3, 3)."""
    result = np.zeros((len(points), 3, 3))
    x, y, z = points.T
    result[:, 0, 1], result[:, 0, 2], result[:, 1, 2] = -z, y, -x
    result[:, 1, 0], result[:, 2, 0], result[:, 2, 1] = z, -y, x
    return result


def projection_jacobians(model: CameraModel, p_camera: FloatArray) -> FloatArray:
    """Return how pixels change with points in the camera's frame [px/m], shape (n, 2, 3)."""
    fx, fy = model.intrinsics[:2]
    inverse = 1.0 / p_camera[:, 2]
    x, y = p_camera[:, 0] * inverse, p_camera[:, 1] * inverse
    xx, xy, yy = distortion_jacobian(x, y, model.distortion)
    result = np.empty((len(p_camera), 2, 3))
    result[:, 0, 0], result[:, 0, 1] = fx * xx, fx * xy
    result[:, 1, 0], result[:, 1, 1] = fy * xy, fy * yy
    result[:, 0, 2] = -fx * (xx * x + xy * y)
    result[:, 1, 2] = -fy * (xy * x + yy * y)
    result *= inverse[:, None, None]
    return result


def parameter_jacobians(model: CameraModel, p_camera: FloatArray) -> FloatArray:
    """Return how pixels change with fx, fy, cx, cy, k1, k2, p1, p2, k3, shape (n, 2, 9)."""
    fx, fy, cx, cy = model.intrinsics
    x, y = p_camera[:, 0] / p_camera[:, 2], p_camera[:, 1] / p_camera[:, 2]
    r2 = x * x + y * y
    uv, _ = model.project_camera(p_camera)
    result = np.zeros((len(p_camera), 2, 9))
    result[:, 0, 0], result[:, 1, 1] = (uv[:, 0] - cx) / fx, (uv[:, 1] - cy) / fy
    result[:, 0, 2] = result[:, 1, 3] = 1.0
    for column, power in ((4, r2), (5, r2**2), (8, r2**3)):
        result[:, 0, column], result[:, 1, column] = fx * x * power, fy * y * power
    result[:, 0, 6], result[:, 1, 6] = fx * 2.0 * x * y, fy * (r2 + 2.0 * y * y)
    result[:, 0, 7], result[:, 1, 7] = fx * (r2 + 2.0 * x * x), fy * 2.0 * x * y
    return result
