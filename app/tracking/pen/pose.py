"""Pose of a board in one picture, or why there is none: the value that all others speak of."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.transform import RigidTransform


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
        sensitivity: change of that twist with the camera's parameters, in the order
            `optics.calibration.PARAMETERS`, shape (6, 9).
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
        zero, by = read_only(np.zeros((6, 6))), read_only(np.zeros((6, 9)))
        identity = RigidTransform.identity()
        return cls(status, identity, zero, by, ids=ids, tilt_apart=tilt_apart, reason=reason)
