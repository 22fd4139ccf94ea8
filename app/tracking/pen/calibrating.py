"""Calibrating a pen from the pictures of a webcam: collecting poses, then pivoting.

While poses are collected, the pen is rocked to every side: how it leans now, and which sides are
still missing, is told. A measured tip is judged on positions that were held back: what no fit to
them can flatter. The shaft's direction in the body's frame is known by how it is mounted, or by
rolling the pen.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import atan2, pi

import numpy as np

from app.core.arrays import FloatArray, read_only, unit
from app.core.messages import sentence
from app.core.rotation import skew
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.pen.body import PenProfile, TipProfile
from app.tracking.pen.errors import PenError
from app.tracking.pen.pivot import FEWEST, MeasuredPose, TipCalibration, pivot
from app.tracking.pen.pose import PoseStatus
from app.tracking.pen.step import PenObservation

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
            sentence(
                "the tip lies {length_mm:.0f} mm from the middle of the cube; 20 mm are "
                "the least from which its direction can be told",
                length_mm=length / MILLIMETRE,
            )
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
            sentence(
                "{poses} poses are too few to find the shaft; roll on until there are {fewest}",
                poses=len(poses),
                fewest=FEWEST,
            )
        )
    rotations = np.array([pose.T.rotation for pose in poses])
    left, values, right = np.linalg.svd(rotations.mean(axis=0))
    axis, fixed = right[0], left[:, 0]
    if axis @ towards < 0.0:
        axis, fixed = -axis, -fixed
    if values[1] > 0.5 * (1.0 + np.sinc(LEAST_ROLL / (2.0 * np.pi))):
        raise PenError(
            sentence(
                "the pen was rolled too little: roll it by a quarter turn or more about its own "
                "axis, lying in a groove"
            )
        )
    covariance, misfit, freedom = _axis_covariance(poses, axis, fixed)
    if misfit > 25.0 * freedom:
        raise PenError(
            sentence(
                "the shaft did not keep its direction while it was rolled: lay it into a groove, "
                "for instance between two books, and roll it there"
            )
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
        """Return what was found, for people."""
        return sentence(
            "on {poses} positions held back the tip was {rms_mm:.2f} mm from "
            "its dimple (at most {worst_mm:.1f} mm)",
            poses=self.poses,
            rms_mm=self.rms / MILLIMETRE,
            worst_mm=self.worst / MILLIMETRE,
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
        """Return what was found, for people."""
        x, y, z = (self.tip.p_tip / MILLIMETRE).tolist()
        return sentence(
            "tip at ({x:.1f}, {y:.1f}, {z:.1f}) mm from the middle of the cube, standard "
            "deviation {tip_sd_mm:.2f} mm; it stood still to {tip_rms_mm:.2f} "
            "mm in {tip_poses} poses ({tip_left_out} left out); axis to "
            "{axis_sd_deg:.2f}°",
            x=x,
            y=y,
            z=z,
            tip_sd_mm=self.tip.sd_mm,
            tip_rms_mm=self.tip.rms / MILLIMETRE,
            tip_poses=self.tip.poses,
            tip_left_out=self.tip.left_out,
            axis_sd_deg=self.axis.sd_deg,
        ) + (f"; {self.check.words}" if self.check else "")


class PoseCollector:
    """Keeps poses of the body on the sheet that differ from each other.

    Cube and sheet must be seen together: the webcam may then move.
    """

    def __init__(self) -> None:
        self.poses: list[MeasuredPose] = []

    @property
    def share(self) -> float:
        """Return how far it is, 0 to 1."""
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

    def finish_rolling(self, result: PenCalibration) -> PenCalibration:
        """Return a calibration with the shaft as these poses of a rolled pen tell it.

        Raises:
            PenError: if they do not; says what to do.
        """
        axis = axis_by_rolling(self.poses, result.tip.p_tip)
        return replace(result, pen=with_tip(result.pen, result.tip, axis), axis=axis)


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


SIDES = ("right", "away, right", "away", "away, left", "left", "near, left", "near", "near, right")
"""Where the pen's upper end points, as the webcam sees it: `near` is towards it."""

LEANT = 15.0 * DEGREE
"""Lean [rad] from which a position counts for its side."""


@dataclass(frozen=True, slots=True)
class Lean:
    """How the pen leans on its sheet, as the webcam sees it.

    Attributes:
        right, away: where its upper end points: parts of a unit vector, lengths the sine of lean.
    """

    right: float
    away: float

    @property
    def angle(self) -> float:
        """Lean against the upright [rad]."""
        return float(np.arcsin(min(1.0, (self.right**2 + self.away**2) ** 0.5)))

    @property
    def side(self) -> int | None:
        """Index into `SIDES`; None while it stands too upright."""
        if self.angle < LEANT:
            return None
        return round(atan2(self.away, self.right) / (2.0 * pi / len(SIDES))) % len(SIDES)


def lean_of(seen: PenObservation) -> Lean | None:
    """Lean of the pen in a picture; None where cube or sheet were not found."""
    if seen.body.status is not PoseStatus.FOUND or seen.base.status is not PoseStatus.FOUND:
        return None
    T_base_camera = seen.base.T_camera_board.inverse()
    # The body's z points to the tip, so that its upper end is at -z.
    up = -(T_base_camera.rotation @ seen.body.T_camera_board.rotation)[:, 2]
    right = T_base_camera.rotation[:, 0] * (1.0, 1.0, 0.0)
    if np.linalg.norm(right) < 1e-6:
        return None
    right = unit(right)
    away = np.array([-right[1], right[0], 0.0])
    return Lean(float(up @ right), float(up @ away))


class Rocking:
    """Collects what a guided calibration of the tip needs.

    `add` is called by the thread that looks at the pictures, all else by any other.
    """

    def __init__(self) -> None:
        self.collector = PoseCollector()
        self.leans: list[Lean] = []
        self.now: Lean | None = None

    def add(self, seen: PenObservation) -> None:
        """Take what one picture says."""
        self.now = lean_of(seen)
        if self.now is not None and self.collector.add(seen):
            self.leans.append(self.now)

    @property
    def covered(self) -> frozenset[int]:
        """Indices of the sides to which the pen has leant."""
        return frozenset(side for lean in list(self.leans) if (side := lean.side) is not None)

    @property
    def missing(self) -> tuple[str, ...]:
        """Names of the sides that are still missing."""
        covered = self.covered
        return tuple(name for i, name in enumerate(SIDES) if i not in covered)

    @property
    def progress(self) -> float:
        """Return how far it is, 0 to 1: positions and sides."""
        return min(self.collector.share, len(self.covered) / len(SIDES))

    @property
    def enough(self) -> bool:
        """Return whether more would hardly help."""
        return self.progress >= 1.0

    @property
    def computable(self) -> bool:
        """Return whether there are as many positions as are needed at least."""
        return len(self.collector.poses) >= FEWEST
