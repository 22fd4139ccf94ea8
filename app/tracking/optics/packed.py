"""A camera as one row of numbers, for kernels: they load arrays fast, and objects not at all."""

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.compiled import njit
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.distortion import (
    distort_point,
    distortion_jacobian,
    inside_fold,
    undistort_point,
)

CAMERA: Final = 30
"""Rotation (9) and translation (3) of T_camera_world, fx, fy, cx, cy, fold, number of the lens'
coefficients, and they in up to `distortion.RATIONAL` places."""

_NEAREST: Final = 1e-6
"""As in `camera_model`."""


def packed(model: CameraModel) -> FloatArray:
    """Row of a camera, shape (CAMERA,), read-only."""
    pose = model.T_camera_world
    row = np.zeros(CAMERA)
    row[:9], row[9:12], row[12:16] = pose.rotation.ravel(), pose.translation, model.intrinsics
    row[16], row[17] = model.fold, model.distortion.size
    row[18 : 18 + model.distortion.size] = model.distortion
    return read_only(row)


@njit
def unpack(camera: Any) -> Any:
    """Return rotation (3, 3), translation, intrinsics, distortion and fold of a row."""
    rotation = camera[:9].reshape((3, 3))
    return rotation, camera[9:12], camera[12:16], lens_row(camera), camera[16]


@njit
def lens_row(camera: Any) -> Any:
    """Coefficients of a row's lens."""
    return camera[18 : 18 + int(camera[17])]


@njit
def to_camera(camera: Any, point: Any, offset: float, out: Any) -> None:
    """Carry a point (`offset` 1) or a direction (0) from world into the camera's frame."""
    for i in range(3):
        out[i] = offset * camera[9 + i]
        for k in range(3):
            out[i] += camera[3 * i + k] * point[k]


@njit
def project_point(camera: Any, x: float, y: float, z: float) -> Any:
    """Pixel of a point in the camera's frame: (u, v, whether it has a picture)."""
    if not (np.isfinite(x) and np.isfinite(y) and np.isfinite(z) and z > _NEAREST):
        return 0.0, 0.0, False
    x, y = x / z, y / z
    lens = lens_row(camera)
    if not inside_fold(x, y, lens, camera[16]):
        return 0.0, 0.0, False
    x_d, y_d = distort_point(x, y, lens)
    return camera[12] * x_d + camera[14], camera[13] * y_d + camera[15], True


@njit
def normalise(camera: Any, u: float, v: float, spread: Any, ray: Any, out: Any) -> bool:
    """Normalised coordinates of a pixel and their covariance, in place; see `stereo.rays`.

    Args:
        camera: its row.
        u: column of the pixel.
        v: its row.
        spread: covariance [px²], (2, 2).
        ray: out, (2,).
        out: out, covariance of it, (2, 2).

    Returns:
        False if the pixel belongs to no direction.
    """
    fx, fy, lens = camera[12], camera[13], lens_row(camera)
    x, y, found = undistort_point((u - camera[14]) / fx, (v - camera[15]) / fy, lens, camera[16])
    if not found:
        return False
    ray[0], ray[1] = x, y
    xx, xy, yx, yy = distortion_jacobian(x, y, lens)
    determinant = xx * yy - xy * yx
    a, b = yy / (determinant * fx), -xy / (determinant * fy)
    c, d = -yx / (determinant * fx), xx / (determinant * fy)
    s00, s01, s10, s11 = spread[0, 0], spread[0, 1], spread[1, 0], spread[1, 1]
    out[0, 0] = a * (a * s00 + b * s10) + b * (a * s01 + b * s11)
    out[0, 1] = c * (a * s00 + b * s10) + d * (a * s01 + b * s11)
    out[1, 0] = a * (c * s00 + d * s10) + b * (c * s01 + d * s11)
    out[1, 1] = c * (c * s00 + d * s10) + d * (c * s01 + d * s11)
    return True
