"""Rigid transforms: frozen values that compose and apply with `@`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, cross, frozen, unit
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.core.rotation import rotation_exp, rotation_log, skew

_ORTHONORMAL_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True, eq=False)
class RigidTransform:
    """Element of SE(3): `p_to = rotation @ p_from + translation`.

    Attributes:
        rotation: rotation matrix, shape (3, 3), read-only.
        translation: origin of the source frame in the target frame [m], shape (3,), read-only.

    Raises:
        NumericalError: if the matrix is not a rotation to 1e-6, or a value is not finite.
    """

    rotation: FloatArray
    translation: FloatArray

    def __post_init__(self) -> None:
        rotation = frozen(self.rotation, (3, 3), "rotation")
        if np.abs(rotation @ rotation.T - np.eye(3)).max() > _ORTHONORMAL_TOLERANCE:
            raise NumericalError(
                sentence("rotation {rotation} is not orthonormal", rotation=rotation.tolist())
            )
        if np.linalg.det(rotation) < 0.0:
            raise NumericalError(
                sentence("rotation {rotation} is a reflection", rotation=rotation.tolist())
            )
        object.__setattr__(self, "rotation", rotation)
        object.__setattr__(self, "translation", frozen(self.translation, (3,), "translation"))

    @classmethod
    def identity(cls) -> RigidTransform:
        """Return the transform that changes nothing."""
        return cls(np.eye(3), np.zeros(3))

    @classmethod
    def from_rotation(cls, rotation: ArrayLike) -> RigidTransform:
        """Rotate about the origin."""
        return cls(np.asarray(rotation), np.zeros(3))

    @classmethod
    def from_translation(cls, translation: ArrayLike) -> RigidTransform:
        """Shift without rotating."""
        return cls(np.eye(3), np.asarray(translation))

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> RigidTransform:
        """Read a homogeneous matrix, shape (4, 4).

        Raises:
            NumericalError: if the last row is not (0, 0, 0, 1) or the block is not a rotation.
        """
        array = frozen(matrix, (4, 4), "matrix")
        if np.abs(array[3] - (0.0, 0.0, 0.0, 1.0)).max() > _ORTHONORMAL_TOLERANCE:
            raise NumericalError(
                sentence("last row of a rigid transform is {array}", array=array[3].tolist())
            )
        return cls(array[:3, :3], array[:3, 3])

    @classmethod
    def exp(cls, twist: ArrayLike) -> RigidTransform:
        """Exponential map of a twist (translational part first), shape (6,)."""
        xi = frozen(twist, (6,), "twist")
        return cls(rotation_exp(xi[3:]), _left_jacobian(xi[3:]) @ xi[:3])

    def log(self) -> FloatArray:
        """Twist whose exponential this is, shape (6,); the rotation angle lies in [0, π]."""
        omega = rotation_log(self.rotation)
        rho = np.linalg.solve(_left_jacobian(omega), self.translation)
        return np.concatenate([rho, omega])

    def matrix(self) -> FloatArray:
        """Homogeneous matrix, shape (4, 4)."""
        matrix = np.eye(4)
        matrix[:3, :3] = self.rotation
        matrix[:3, 3] = self.translation
        return matrix

    def inverse(self) -> RigidTransform:
        """Return the transform back."""
        return RigidTransform(self.rotation.T, -self.rotation.T @ self.translation)

    def rotate(self, vectors: ArrayLike) -> FloatArray:
        """Turn directions, shape (3,) or (n, 3), without shifting them."""
        result: FloatArray = np.asarray(vectors, dtype=np.float64) @ self.rotation.T
        return result

    @overload
    def __matmul__(self, other: RigidTransform) -> RigidTransform: ...
    @overload
    def __matmul__(self, other: ArrayLike) -> FloatArray: ...
    def __matmul__(self, other: RigidTransform | ArrayLike) -> RigidTransform | FloatArray:
        """Compose with a transform, or apply to points of shape (3,) or (n, 3)."""
        if isinstance(other, RigidTransform):
            return RigidTransform(
                self.rotation @ other.rotation,
                self.rotation @ other.translation + self.translation,
            )
        return self.rotate(other) + self.translation


def rotation_between(start: ArrayLike, end: ArrayLike) -> FloatArray:
    """Smallest rotation that turns direction `start` onto `end`, shape (3, 3).

    For opposite directions, where the axis is free, any axis perpendicular to `start` serves.
    """
    u, v = unit(start), unit(end)
    if np.dot(u, v) < 0.0:
        # A half turn first, about the same axis, so that 1 + u·v never nears 0.
        axis = _common_perpendicular(u, v)
        half_turn = 2.0 * np.outer(axis, axis) - np.eye(3)
        return rotation_between(-u, v) @ half_turn
    w = skew(cross(u, v))
    return np.eye(3) + w + w @ w / (1.0 + float(np.dot(u, v)))


def _common_perpendicular(u: FloatArray, v: FloatArray) -> FloatArray:
    """Direction of u x v, exactly perpendicular to u; any one where u and v lie on one line."""
    axis = cross(u, v)
    length = float(np.linalg.norm(axis))
    if length < 1e-12:
        return _any_perpendicular(u)
    axis = axis / length
    return unit(axis - np.dot(axis, u) * u)


def _any_perpendicular(u: FloatArray) -> FloatArray:
    return unit(cross(u, np.eye(3)[int(np.argmin(np.abs(u)))]))


def _left_jacobian(omega: FloatArray) -> FloatArray:
    angle = float(np.linalg.norm(omega))
    w = skew(omega)
    if angle < 1e-4:  # Taylor: the closed form loses digits as 1 - cos and angle - sin cancel
        return np.eye(3) + w * (0.5 - angle**2 / 24.0) + w @ w * (1.0 / 6.0 - angle**2 / 120.0)
    b = 2.0 * np.sin(0.5 * angle) ** 2 / angle**2
    c = (angle - np.sin(angle)) / angle**3
    return np.eye(3) + b * w + c * (w @ w)


def exponentials(twists: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rotations (n, 3, 3), shifts (n, 3) of twists (n, 6); see `RigidTransform.exp`."""
    omega = twists[:, 3:]
    angle = np.linalg.norm(omega, axis=1)
    w = np.zeros((len(omega), 3, 3))
    w[:, 2, 1], w[:, 0, 2], w[:, 1, 0] = omega.T
    w -= np.swapaxes(w, 1, 2)
    half = 0.5 * np.sinc(0.5 * angle / np.pi) ** 2
    near = angle < 1e-4  # Taylor, as in `_left_jacobian`
    safe = np.where(near, 1.0, angle)
    third = np.where(near, (1.0 - angle**2 / 20.0) / 6.0, (safe - np.sin(safe)) / safe**3)
    first, second, third = (a[:, None, None] for a in (np.sinc(angle / np.pi), half, third))
    square = w @ w
    rotations = np.eye(3) + first * w + second * square
    shifts = (np.eye(3) + second * w + third * square) @ twists[:, :3, None]
    return rotations, shifts[:, :, 0]


class FrameName(StrEnum):
    """Names of the right-handed frames, all in metres.

    `WORLD` is the robot base: origin midway between the two motor axes, x to the right motor, z up
    towards the skin; the pantograph moves in z = 0. `PATIENT` is DICOM's LPS. `NEEDLE` has its
    origin at the tip and +z out of the tip along the shaft. `VOXEL` counts columns, rows and
    slices (dimensionless). `CAMERA` is OpenCV's: x right, y down, z into the scene.
    """

    WORLD = "world"
    PATIENT = "patient"
    NEEDLE = "needle"
    VOXEL = "voxel"
    CAMERA = "camera"
