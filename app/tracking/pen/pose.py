"""Pose of a board in one picture, or why there is none: the value that all others speak of."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.transform import RigidTransform
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.distortion import distort_with_derivatives


def skews(points: FloatArray) -> FloatArray:
    """Cross-product matrices, (n, 3) -> (n, 3, 3)."""
    result = np.zeros((len(points), 3, 3))
    x, y, z = points.T
    result[:, 0, 1], result[:, 0, 2], result[:, 1, 2] = -z, y, -x
    result[:, 1, 0], result[:, 2, 0], result[:, 2, 1] = z, -y, x
    return result


def projection_jacobians(model: CameraModel, p_camera: FloatArray) -> FloatArray:
    """Return how pixels change with points in the camera's frame [px/m], shape (n, 2, 3)."""
    inverse = 1.0 / p_camera[:, 2]
    xy = p_camera[:, :2] * inverse[:, None]
    by_xy = model.intrinsics[:2, None] * distort_with_derivatives(xy, model.distortion)[1]
    result = np.empty((len(p_camera), 2, 3))
    result[:, :, :2] = by_xy
    result[:, :, 2] = -(by_xy * xy[:, None]).sum(axis=2)
    result *= inverse[:, None, None]
    return result


def parameter_jacobians(model: CameraModel, p_camera: FloatArray) -> FloatArray:
    """Return how pixels change with fx, fy, cx, cy and the lens' coefficients, shape (n, 2, m)."""
    xy = p_camera[:, :2] / p_camera[:, 2:]
    bent, _, by_lens = distort_with_derivatives(xy, model.distortion)
    result = np.zeros((len(p_camera), 2, 4 + model.distortion.size))
    result[:, 0, 0], result[:, 1, 1] = bent[:, 0], bent[:, 1]
    result[:, 0, 2] = result[:, 1, 3] = 1.0
    result[:, :, 4:] = model.intrinsics[:2, None] * by_lens
    return result


class PoseStatus(StrEnum):
    """Whether there is a pose, and if not, why."""

    FOUND = "found"
    UNSEEN = "unseen"  # no marker of the board in the picture
    AMBIGUOUS = "ambiguous"  # two poses explain the picture
    INCONSISTENT = "inconsistent"  # no pose explains it


@dataclass(frozen=True, slots=True, eq=False)
class BoardPose:
    """Pose of a board in the camera's frame, or why there is none.

    Attributes:
        status: only `found` has a pose.
        T_camera_board: the pose; identity without one.
        covariance: of the twist (translation [m], rotation vector [rad]) on the left,
            T = exp(twist) @ T_camera_board; shape (6, 6). Widened by chi-square over its freedom
            where the residual is too large to be noise, as with a lens that is not calibrated.
        sensitivity: change of that twist with the parameters of the camera's lens, shape (6, m);
            (6, 0) without a pose.
        chi_square: of the residual, with `freedom` degrees of freedom.
        residual_px: root mean square of the reprojection error per axis.
        ids: of the markers that were used.
        tilt_apart: angle between the two minima [rad]; 0 if there is one only.
        lead: by how much chi-square is worse at the second minimum; infinite if there is none.
        reason: one line for people; empty when found.
        either: where two poses explain the picture, both, the better one first: who knows more
            than the picture may choose.
    """

    status: PoseStatus
    T_camera_board: RigidTransform
    covariance: FloatArray
    sensitivity: FloatArray
    chi_square: float = 0.0
    freedom: int = 0
    residual_px: float = 0.0
    ids: tuple[int, ...] = ()
    tilt_apart: float = 0.0
    lead: float = float("inf")
    reason: str = ""
    either: tuple["BoardPose", ...] = ()

    @classmethod
    def none(
        cls, status: PoseStatus, reason: str, ids: tuple[int, ...] = (), tilt_apart: float = 0.0
    ) -> "BoardPose":
        """Return that there is no pose, and why."""
        zero, by = read_only(np.zeros((6, 6))), read_only(np.zeros((6, 0)))
        identity = RigidTransform.identity()
        return cls(status, identity, zero, by, ids=ids, tilt_apart=tilt_apart, reason=reason)
