"""Rotations: exponential and logarithm that stay accurate near 0 and near π."""

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray


def skew(v: ArrayLike) -> FloatArray:
    """Cross-product matrix, shape (3, 3): `skew(v) @ w == cross(v, w)`."""
    x, y, z = np.asarray(v, dtype=np.float64)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def rotation_exp(omega: ArrayLike) -> FloatArray:
    """Rotation matrix of a rotation vector [rad], shape (3,) -> (3, 3) (Rodrigues).

    Near zero `sinc` and the half-angle form of 1 - cos keep full precision without a branch.
    """
    vector = np.asarray(omega, dtype=np.float64)
    angle = float(np.linalg.norm(vector))
    w = skew(vector)
    a = np.sinc(angle / np.pi)
    b = 0.5 * np.sinc(0.5 * angle / np.pi) ** 2
    result: FloatArray = np.eye(3) + a * w + b * (w @ w)
    return result


def rotation_log(rotation: ArrayLike) -> FloatArray:
    """Rotation vector [rad] of a rotation matrix, (3, 3) -> (3,), of norm in [0, π].

    Goes through the unit quaternion (Shepperd's choice of the largest component), which is
    accurate at every angle: the trace formula loses half its digits near 0 and its axis near π.
    """
    w, v = _quaternion(np.asarray(rotation, dtype=np.float64))
    norm = float(np.linalg.norm(v))
    if norm < 1e-10:
        return 2.0 * v * (1.0 if w > 0 else -1.0)
    if w < 0.0:
        w, v = -w, -v
    return v * (2.0 * np.arctan2(norm, w) / norm)


def closest_rotation(moments: ArrayLike) -> tuple[FloatArray, float]:
    """Rotation R that makes trace(R H) largest, shape (3, 3), and how clear that choice is.

    With H = sum of x yᵀ over centred points this is the least squares fit y ≈ R x (Arun, Huang and
    Blostein 1987; Kabsch 1978), with the sign of Umeyama (1991) that excludes reflections.

    Args:
        moments: H, shape (3, 3).

    Returns:
        R, and the gain over the next best rotation relative to the largest singular value: about 0
        where two rotations serve equally well (points on a line, or mirrored ones).
    """
    left, values, right = np.linalg.svd(np.asarray(moments, dtype=np.float64))
    sign = 1.0 if np.linalg.det(right.T @ left.T) >= 0.0 else -1.0
    rotation: FloatArray = right.T @ np.diag([1.0, 1.0, sign]) @ left.T  # H = U S Vᵀ, R = V D Uᵀ
    gap = float(values[1] + sign * values[2])
    return rotation, gap / float(values[0]) if values[0] > 0.0 else 0.0


def _quaternion(r: FloatArray) -> tuple[float, FloatArray]:
    """Scalar and vector part, of length one, sign free."""
    squares = np.array(
        [
            1.0 + r[0, 0] + r[1, 1] + r[2, 2],
            1.0 + r[0, 0] - r[1, 1] - r[2, 2],
            1.0 - r[0, 0] + r[1, 1] - r[2, 2],
            1.0 - r[0, 0] - r[1, 1] + r[2, 2],
        ]
    )
    largest = int(np.argmax(squares))
    antisymmetric = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    q = np.empty(4)
    if largest == 0:
        q[0], q[1:] = squares[0], antisymmetric
    else:
        i = largest - 1
        q[0] = antisymmetric[i]
        q[1:] = r[:, i] + r[i, :]
        q[1 + i] = squares[largest]
    q /= np.linalg.norm(q)
    return float(q[0]), q[1:]
