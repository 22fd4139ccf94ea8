"""Pixels by OpenCV's own projection: a reference that shares no code with `CameraModel`."""

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform


def opencv_pixels(
    points: FloatArray, T_camera_world: RigidTransform, matrix: FloatArray, distortion: FloatArray
) -> FloatArray:
    """Project points of the world [m], (n, 3), by `cv2.projectPoints`, (n, 2) [px].

    Args:
        points: in front of the camera.
        T_camera_world: of the camera.
        matrix: fx, fy, cx, cy in OpenCV's place, (3, 3).
        distortion: 4, 5, 8, 12 or 14 coefficients in OpenCV's order.
    """
    turn, _ = cv2.Rodrigues(T_camera_world.rotation)
    pixels, _ = cv2.projectPoints(points, turn, T_camera_world.translation, matrix, distortion)
    return np.asarray(pixels[:, 0], dtype=np.float64)
