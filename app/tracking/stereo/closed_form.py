"""Closed forms of triangulation: direct linear transformation, rays and where they are closest."""

import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform

Pair = tuple[RigidTransform, RigidTransform]
"""T_camera_world of both cameras."""


def linear(poses: Pair, observations: FloatArray) -> FloatArray:
    """Direct linear transformation: least singular vector of x·p₃ - p₁ and y·p₃ - p₂ per camera.

    Each row is the plane through a camera's centre in which the point must lie. Skew rays meet in
    no point, and the answer then depends on how the rows are scaled: here every row's normal has
    length one, so that the error is a distance from the plane, the origin is the first camera's
    centre and the length's unit is the baseline. So neither the choice of world nor of units
    matters. `cv2.triangulatePoints` leaves the rows as they come.

    Args:
        poses: of cameras with a baseline.
        observations: normalised coordinates of rays that are not parallel, shape (2, 2).
    """
    origin, second = (-pose.rotation.T @ pose.translation for pose in poses)
    unit = float(np.linalg.norm(second - origin))
    rows = np.empty((4, 4))
    for i, (pose, (x, y)) in enumerate(zip(poses, observations, strict=True)):
        offset = (pose.rotation @ origin + pose.translation) / unit
        camera = np.column_stack([pose.rotation, offset])
        rows[2 * i], rows[2 * i + 1] = x * camera[2] - camera[0], y * camera[2] - camera[1]
    rows /= np.linalg.norm(rows[:, :3], axis=1, keepdims=True)
    vector = np.linalg.svd(rows)[2][-1]
    w = vector[3] if abs(vector[3]) > 1e-12 else np.copysign(1e-12, vector[3])
    return np.asarray(origin + unit * vector[:3] / w)


def ray(pose: RigidTransform, observation: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Centre [m] and unit direction of a camera's ray in world; `pose` is T_camera_world."""
    direction = pose.rotation.T @ np.array([observation[0], observation[1], 1.0])
    return -pose.rotation.T @ pose.translation, direction / np.linalg.norm(direction)


def closest(
    first: tuple[FloatArray, FloatArray], second: tuple[FloatArray, FloatArray]
) -> tuple[FloatArray, FloatArray]:
    """Points of two lines, each a point [m] and a unit direction, that are closest to each other.

    Lines must not be parallel. With c = d₁·d₂ and b = p₂ - p₁: s₁ = (b·d₁ - c·b·d₂) / (1 - c²).
    """
    (p1, d1), (p2, d2) = first, second
    offset, cosine = p2 - p1, float(d1 @ d2)
    sine2 = float(np.linalg.norm(np.cross(d1, d2))) ** 2
    along1 = float(offset @ d1 - cosine * (offset @ d2)) / sine2
    along2 = float(cosine * (offset @ d1) - offset @ d2) / sine2
    return p1 + along1 * d1, p2 + along2 * d2
