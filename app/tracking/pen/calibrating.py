"""Calibrating a pen from the pictures of a webcam: collecting poses, then pivoting.

A measured tip on positions that were held back: what no fit to them can flatter.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from app.core.arrays import FloatArray
from app.core.rotation import skew
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.pen.body import PenProfile, TipProfile
from app.tracking.pen.pivot import FEWEST, MeasuredPose, TipCalibration, pivot
from app.tracking.pen.pose import PoseStatus
from app.tracking.pen.shaft import AxisCalibration, axis_by_mount, axis_by_rolling
from app.tracking.pen.step import PenObservation

EVERY = 4
"""Every so many positions one is held back."""


@dataclass(frozen=True, slots=True)
class HeldBack:
    """How far the tip was from its dimple in positions that the fit had not seen.

    Attributes:
        rms: root mean square distance [m].
        worst: largest distance [m].
        poses: how many were held back.
    """

    rms: float
    worst: float
    poses: int

    @property
    def words(self) -> str:
        """What was found, for people."""
        return (
            f"on {self.poses} positions held back the tip was {self.rms / MILLIMETRE:.2f} mm from "
            f"its dimple (at most {self.worst / MILLIMETRE:.1f} mm)"
        )


def held_back(poses: Sequence[MeasuredPose]) -> HeldBack | None:
    """Fit three quarters of the positions and hold the rest against it.

    Returns:
        None where too few would be left to fit.

    Raises:
        PenError: if the rest does not tell the tip; says what to do.
    """
    taken = [pose for k, pose in enumerate(poses) if k % EVERY]
    left = [pose for k, pose in enumerate(poses) if k % EVERY == 0]
    if len(taken) < FEWEST:
        return None
    found = pivot(taken)
    away = np.array([np.linalg.norm(p.T @ found.p_tip - found.p_dimple) for p in left])
    return HeldBack(float(np.sqrt(np.mean(away**2))), float(away.max()), len(left))


WANTED = 80
"""Poses after which a rocked tip is usually known well enough."""

_APART = 2.0 * DEGREE
"""Turn [rad] from every kept pose from which another one says something new."""


@dataclass(frozen=True, slots=True, eq=False)
class PenCalibration:
    """A pen with its measured tip.

    Attributes:
        pen: profile with tip and axis measured.
        tip: what pivoting found.
        axis: direction of the shaft.
        check: on positions held back; None where there were too few.
    """

    pen: PenProfile
    tip: TipCalibration
    axis: AxisCalibration
    check: HeldBack | None = None

    @property
    def words(self) -> str:
        """What was found, for people."""
        x, y, z = (self.tip.p_tip / MILLIMETRE).tolist()
        return (
            f"tip at ({x:.1f}, {y:.1f}, {z:.1f}) mm from the middle of the cube, standard "
            f"deviation {self.tip.sd_mm:.2f} mm; it stood still to {self.tip.rms / MILLIMETRE:.2f} "
            f"mm in {self.tip.poses} poses ({self.tip.left_out} left out); axis to "
            f"{self.axis.sd_deg:.2f}°" + (f"; {self.check.words}" if self.check else "")
        )


class PoseCollector:
    """Keeps poses of the body on the sheet that differ from each other.

    Cube and sheet must be seen together: the webcam may then move.
    """

    def __init__(self) -> None:
        self.poses: list[MeasuredPose] = []

    @property
    def share(self) -> float:
        """How far it is, 0 to 1."""
        return min(1.0, len(self.poses) / WANTED)

    def add(self, seen: PenObservation) -> bool:
        """Take a picture's pose if it says something new; return whether it did."""
        if seen.body.status is not PoseStatus.FOUND or seen.base.status is not PoseStatus.FOUND:
            return False
        pose = relative_pose(seen)
        if any(_turn(pose.T, kept.T) < _APART for kept in self.poses):
            return False
        self.poses.append(pose)
        return True

    def finish(self, pen: PenProfile) -> PenCalibration:
        """Find tip and axis; the shaft is taken to run through the middle of the cube.

        Raises:
            PenError: if the poses do not tell the tip; says what to do.
        """
        poses = tuple(self.poses)  # another thread may still add to them
        tip = pivot(poses)
        axis = axis_by_mount(tip)
        return PenCalibration(with_tip(pen, tip, axis), tip, axis, held_back(poses))

    def finish_rolling(self, found: PenCalibration) -> PenCalibration:
        """Return a calibration with the shaft as these poses of a rolled pen tell it.

        Raises:
            PenError: if they do not; says what to do.
        """
        axis = axis_by_rolling(self.poses, found.tip.p_tip)
        return replace(found, pen=with_tip(found.pen, found.tip, axis), axis=axis)


def relative_pose(seen: PenObservation) -> MeasuredPose:
    """Pose of the body in the sheet's frame, with its covariance about that frame's origin.

    T = T_base⁻¹ T_body; a twist δ in the camera's frame is Ad(T_base⁻¹) δ in the sheet's.
    """
    to_base = seen.base.T_camera_board.inverse()
    adjoint = np.zeros((6, 6))
    adjoint[:3, :3] = adjoint[3:, 3:] = to_base.rotation
    adjoint[:3, 3:] = skew(to_base.translation) @ to_base.rotation
    covariance = adjoint @ (seen.body.covariance + seen.base.covariance) @ adjoint.T
    return MeasuredPose(to_base @ seen.body.T_camera_board, covariance)


def with_tip(pen: PenProfile, tip: TipCalibration, axis: AxisCalibration) -> PenProfile:
    """Return the pen with its measured tip and axis."""
    measured = TipProfile.model_validate(
        {
            "position_mm": (tip.p_tip / MILLIMETRE).tolist(),
            "covariance_mm2": (tip.covariance / MILLIMETRE**2).tolist(),
            "axis": axis.axis.tolist(),
            "axis_sd_deg": axis.sd_deg,
            "calibrated": True,
        }
    )
    return pen.model_copy(update={"tip": measured})


def _turn(first: RigidTransform, second: RigidTransform) -> float:
    trace: FloatArray = np.trace(first.rotation.T @ second.rotation)
    return float(np.arccos(np.clip(0.5 * (trace - 1.0), -1.0, 1.0)))
