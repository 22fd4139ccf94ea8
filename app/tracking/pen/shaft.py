"""Direction of the shaft in the body's frame: by how it is mounted, or by rolling the pen."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, read_only, unit
from app.core.rotation import skew
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.errors import PenError
from app.tracking.pen.pivot import FEWEST, MeasuredPose, TipCalibration

LEAST_ROLL = 60.0 * DEGREE


@dataclass(frozen=True, slots=True, eq=False)
class AxisCalibration:
    """Direction of the shaft in the body's frame.

    Attributes:
        axis: unit direction towards the tip, shape (3,).
        covariance: of it, shape (3, 3); nothing along it.
        source: `mount` or `rolling`.
    """

    axis: FloatArray
    covariance: FloatArray
    source: str

    @property
    def sd_deg(self) -> float:
        """Standard deviation in the worse direction [deg]."""
        return float(np.sqrt(np.linalg.eigvalsh(self.covariance)[-1])) / DEGREE


def axis_by_mount(tip: TipCalibration, mount_sd: float = 1.0e-3) -> AxisCalibration:
    """Direction from the middle of the cube to the tip: the shaft runs through both holes' centres.

    Args:
        tip: as pivoting found it.
        mount_sd: how far the shaft may pass beside the cube's middle, per axis [m].

    Raises:
        PenError: if the tip lies in the cube.
    """
    length = float(np.linalg.norm(tip.p_tip))
    if length < 0.02:
        raise PenError(
            f"the tip lies {length / MILLIMETRE:.0f} mm from the middle of the cube; 20 mm are "
            "the least from which its direction can be told"
        )
    axis = tip.p_tip / length
    across = np.eye(3) - np.outer(axis, axis)
    spread = across @ (tip.covariance + mount_sd**2 * np.eye(3)) @ across / length**2
    return AxisCalibration(read_only(axis), read_only(spread), "mount")


def axis_by_rolling(poses: Sequence[MeasuredPose], towards: FloatArray) -> AxisCalibration:
    """Direction of the shaft from poses of a pen that was rolled about it, its line held still.

    The direction a in the body that stays at one b in the poses' frame: the largest singular value
    of the mean rotation belongs to it.

    Args:
        poses: at least `FEWEST`, over at least `LEAST_ROLL` of roll.
        towards: roughly towards the tip, in the body's frame, shape (3,).

    Raises:
        PenError: with too few poses, too little roll, or if no direction stood still.
    """
    if len(poses) < FEWEST:
        raise PenError(
            f"{len(poses)} poses are too few to find the shaft; roll on until there are {FEWEST}"
        )
    rotations = np.array([pose.T.rotation for pose in poses])
    left, values, right = np.linalg.svd(rotations.mean(axis=0))
    axis, fixed = right[0], left[:, 0]
    if axis @ towards < 0.0:
        axis, fixed = -axis, -fixed
    if values[1] > 0.5 * (1.0 + np.sinc(LEAST_ROLL / (2.0 * np.pi))):
        raise PenError(
            "the pen was rolled too little: roll it by a quarter turn or more about its own axis, "
            "lying in a groove"
        )
    covariance, misfit, freedom = _axis_covariance(poses, axis, fixed)
    if misfit > 25.0 * freedom:
        raise PenError(
            "the shaft did not keep its direction while it was rolled: lay it into a groove, for "
            "instance between two books, and roll it there"
        )
    covariance = max(1.0, misfit / freedom) * covariance
    return AxisCalibration(read_only(axis), read_only(covariance), "rolling")


def _axis_covariance(
    poses: Sequence[MeasuredPose], axis: FloatArray, fixed: FloatArray
) -> tuple[FloatArray, float, int]:
    """Covariance (3, 3) of the direction, chi-square of the fit and its degrees of freedom.

    In the plane across `fixed`: R_i (a + A α) = b + B β + noise of the pose's rotation.
    """
    across_axis, across_fixed = _plane(axis), _plane(fixed)
    normal, rows = np.zeros((4, 4)), []
    for pose in poses:
        by = np.hstack([across_fixed.T @ pose.T.rotation @ across_axis, -np.eye(2)])
        turn = -across_fixed.T @ skew(pose.T.rotation @ axis)
        spread = turn @ pose.covariance[3:, 3:] @ turn.T + 1e-12 * np.eye(2)
        weight = np.linalg.inv(spread)
        normal += by.T @ weight @ by
        rest = across_fixed.T @ (pose.T.rotation @ axis - fixed)
        rows.append(rest @ weight @ rest)
    covariance = across_axis @ np.linalg.inv(normal)[:2, :2] @ across_axis.T
    return covariance, float(np.sum(rows)), 2 * len(poses) - 4


def _plane(direction: FloatArray) -> FloatArray:
    """Two unit vectors across a direction, shape (3, 2)."""
    first = unit(np.cross(direction, np.eye(3)[int(np.argmin(np.abs(direction)))]))
    return np.column_stack([first, np.cross(direction, first)])
