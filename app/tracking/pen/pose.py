"""Pose of a board from all its markers in one picture: Gauss-Newton on reprojection, both minima.

A single face looks almost the same from two sides (the planar ambiguity of perspective): IPPE gives
both poses of each marker as starts, all are refined over all corners, and where two different
poses explain the picture about equally well the answer is a refusal, not a guess.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import cv2
import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.transform import RigidTransform
from app.tracking.confidence import chi_square_quantile
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.board import Marker, MarkerBoard
from app.tracking.pen.detector import MarkerSighting
from app.tracking.pen.projection import parameter_jacobians, projection_jacobians, skews

DECISIVE = 16.0
"""Difference of chi-square between the two minima from which the better one is certain."""

_SAME = 0.01
"""Angle [rad] below which two poses are one."""

_BESIDE = 0.05
"""Angle [rad] from a known minimum within which a start would only lead there."""

_GATE = 1e-6
"""Probability with which a good picture is refused by the check of its residual."""

_GROSS_PX = 2.0
"""Residual [px] that no calibration error explains. Below it a misfit widens the covariance."""

_STEPS = 12
_STARTS = 6
_CONVERGED = 1e-6
"""Decrease of chi-square still to be expected, below which a pose is as good as it gets."""


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


@dataclass(frozen=True, slots=True, eq=False)
class _Problem:
    """All corners of a board in one picture: points (n, 3) [m], pixels (n, 2), and weights."""

    model: CameraModel
    points: FloatArray
    pixels: FloatArray
    covariances: FloatArray  # (markers, 8, 8) [px²]
    build_sd: float

    def evaluate(self, T: RigidTransform) -> tuple[FloatArray, FloatArray, FloatArray] | None:
        """Whitened residual (2n,), whitened Jacobian (2n, 6) and bare residual; None outside."""
        p_camera = T @ self.points
        uv, ok = self.model.project_camera(p_camera)
        if not ok.all():
            return None
        by_point = projection_jacobians(self.model, p_camera)
        jacobian = np.concatenate([by_point, -by_point @ skews(p_camera)], axis=2)
        residual = (self.pixels - uv).reshape(-1, 8)
        whiten = self._whitening(by_point)
        white = np.einsum("mij,mj->mi", whiten, residual).ravel()
        slopes = np.einsum("mij,mjk->mik", whiten, jacobian.reshape(-1, 8, 6)).reshape(-1, 6)
        return white, slopes, residual.ravel()

    def by_parameters(self, T: RigidTransform) -> FloatArray:
        """Whitened derivative of the pixels with the camera's parameters, (2n, 9)."""
        p_camera = T @ self.points
        by_point = projection_jacobians(self.model, p_camera)
        slopes = parameter_jacobians(self.model, p_camera).reshape(-1, 8, 9)
        return np.einsum("mij,mjk->mik", self._whitening(by_point), slopes).reshape(-1, 9)

    def _whitening(self, by_point: FloatArray) -> FloatArray:
        """Inverse Cholesky factors of the corners' covariance with what the print adds."""
        built = self.build_sd**2 * by_point @ by_point.transpose(0, 2, 1)
        total = self.covariances.copy()
        for k in range(4):
            total[:, 2 * k : 2 * k + 2, 2 * k : 2 * k + 2] += built[k::4]
        return np.linalg.inv(np.linalg.cholesky(total))


@dataclass(frozen=True, slots=True, eq=False)
class _Minimum:
    pose: RigidTransform
    cost: float
    normal: FloatArray
    slopes: FloatArray
    residual_px: float


class BoardLocator:
    """Finds one board; holds what is known about it, no memory.

    Args:
        board: its markers.
        systematic_px: what lens model and print leave in a corner beside noise, per axis.
    """

    def __init__(self, board: MarkerBoard, systematic_px: float = 0.0) -> None:
        self.board = board
        self._systematic = systematic_px**2 * np.eye(8)

    def locate(self, model: CameraModel, sightings: Sequence[MarkerSighting]) -> BoardPose:
        """Pose from all of the board's markers; every failure is a status, never an exception."""
        found = [(self.board.find(s.id), s) for s in sightings]
        pairs = [(m, s) for m, s in found if m is not None and _usable(s)]
        if not pairs:
            return BoardPose.none(
                PoseStatus.UNSEEN, f"no marker of the {self.board.name} is in the picture"
            )
        ids = tuple(sighting.id for _, sighting in pairs)
        problem = _Problem(
            model,
            np.concatenate([marker.corners for marker, _ in pairs]),
            np.concatenate([sighting.corners for _, sighting in pairs]),
            np.array([s.covariance + self._systematic for _, s in pairs]),
            self.board.build_sd,
        )
        starts = _starts(model, pairs, problem)
        minima = [m for m in _minima(problem, starts) if _fronts_seen(m.pose, pairs)]
        return self._judge(problem, sorted(minima, key=lambda m: m.cost), ids)

    def _judge(self, problem: _Problem, minima: list[_Minimum], ids: tuple[int, ...]) -> BoardPose:
        name, freedom = self.board.name, 2 * len(problem.points) - 6
        if not minima:
            return BoardPose.none(
                PoseStatus.INCONSISTENT, f"no pose of the {name} explains its markers", ids
            )
        best = minima[0]
        misfit = best.cost > chi_square_quantile(1.0 - _GATE, freedom)
        if misfit and best.residual_px > _GROSS_PX:
            return BoardPose.none(
                PoseStatus.INCONSISTENT,
                f"the markers of the {name} disagree by {best.residual_px:.1f} px: bent, built in"
                " another size, or two of them in view",
                ids,
            )
        other = next((m for m in minima[1:] if _apart(m.pose, best.pose) > _SAME), None)
        apart = _apart(other.pose, best.pose) if other is not None else 0.0
        factor = max(1.0, best.cost / freedom) if misfit else 1.0
        if other is not None and other.cost - best.cost < factor * DECISIVE:
            either = tuple(_found(problem, m, ids, apart, factor) for m in (best, other))
            reason = (
                f"the {name} is seen too flat: two poses {np.degrees(apart):.0f}° apart look the "
                "same; turn it so that two faces show, or move the webcam to the side"
            )
            return replace(BoardPose.none(PoseStatus.AMBIGUOUS, reason, ids, apart), either=either)
        return _found(problem, best, ids, apart, factor)


def _found(
    problem: _Problem, best: _Minimum, ids: tuple[int, ...], apart: float, factor: float
) -> BoardPose:
    """Pose of a minimum; `factor` widens its covariance."""
    covariance = np.linalg.inv(best.normal)
    sensitivity = -covariance @ (best.slopes.T @ problem.by_parameters(best.pose))
    return BoardPose(
        PoseStatus.FOUND,
        best.pose,
        read_only(0.5 * factor * (covariance + covariance.T)),
        read_only(sensitivity),
        best.cost,
        2 * len(problem.points) - 6,
        best.residual_px,
        ids,
        apart,
    )


def _usable(sighting: MarkerSighting) -> bool:
    return bool(
        np.isfinite(sighting.corners).all()
        and np.isfinite(sighting.covariance).all()
        and np.diag(sighting.covariance).min() >= 0.0
    )


def _starts(
    model: CameraModel, pairs: list[tuple[Marker, MarkerSighting]], problem: _Problem
) -> list[RigidTransform]:
    """Both poses of each marker by IPPE, best over all corners first."""
    starts = []
    for marker, sighting in pairs:
        rays, ok = model.undistort(sighting.corners)
        if ok.all():
            starts += _square_poses(marker, rays)
    if problem.points.shape[0] > 4 and np.ptp(problem.points[:, 2]) < 1e-9:
        starts += _plane_poses(model, problem)
    rated = [(_misfit(problem, start), i) for i, start in enumerate(starts)]
    order = [i for misfit, i in sorted(rated) if np.isfinite(misfit)]
    return [starts[i] for i in order[:_STARTS]]


def _square_poses(marker: Marker, rays: FloatArray) -> list[RigidTransform]:
    """T_camera_board by both poses of a square; none if the four rays are no square's picture."""
    half = 0.5 * marker.side
    square = np.array([(-half, half, 0), (half, half, 0), (half, -half, 0), (-half, -half, 0)])
    right = (marker.corners[1] - marker.corners[0]) / marker.side
    up = (marker.corners[0] - marker.corners[3]) / marker.side
    T_board_marker = RigidTransform(
        np.column_stack([right, up, marker.normal]), marker.corners.mean(axis=0)
    )
    poses = _ippe(square, rays, cv2.SOLVEPNP_IPPE_SQUARE)
    return [pose @ T_board_marker.inverse() for pose in poses]


def _plane_poses(model: CameraModel, problem: _Problem) -> list[RigidTransform]:
    rays, ok = model.undistort(problem.pixels)
    return _ippe(problem.points, rays, cv2.SOLVEPNP_IPPE) if ok.all() else []


def _ippe(points: FloatArray, rays: FloatArray, flag: int) -> list[RigidTransform]:
    try:
        _, turns, shifts, _ = cv2.solvePnPGeneric(points, rays, np.eye(3), None, flags=flag)
    except cv2.error:  # corners in one line, or in one point
        return []
    poses = []
    for turn, shift in zip(turns, shifts, strict=True):
        if np.isfinite(turn).all() and np.isfinite(shift).all():
            rotation, _ = cv2.Rodrigues(turn)
            poses.append(RigidTransform(rotation, np.ravel(shift)))
    return poses


def _minima(problem: _Problem, starts: list[RigidTransform]) -> list[_Minimum]:
    """Refine the starts that are not beside a minimum that is known already."""
    minima: list[_Minimum] = []
    for start in starts:
        if all(_apart(start, known.pose) > _BESIDE for known in minima):
            found = _refine(problem, start)
            minima += [] if found is None else [found]
    return minima


def _misfit(problem: _Problem, pose: RigidTransform) -> float:
    uv, ok = problem.model.project_camera(pose @ problem.points)
    return float(((problem.pixels - uv) ** 2).sum()) if ok.all() else float("inf")


def _refine(problem: _Problem, pose: RigidTransform) -> _Minimum | None:
    """Levenberg-Marquardt on the twist; None if it runs out of the picture or is singular."""
    found = problem.evaluate(pose)
    if found is None:
        return None
    damping = 1e-6
    for _ in range(_STEPS):
        white, slopes, _ = found
        normal, gradient = slopes.T @ slopes, slopes.T @ white
        if not np.isfinite(normal).all():
            return None
        damped = normal + damping * np.diag(np.diag(normal))
        try:
            step = np.linalg.solve(damped, gradient)
        except np.linalg.LinAlgError:
            return None
        if step @ gradient < _CONVERGED:
            break
        if np.linalg.norm(step[3:]) > 1.0:
            damping = max(10.0 * damping, 1e-3)
            continue
        tried = RigidTransform.exp(step) @ pose
        after = problem.evaluate(tried)
        if after is None or after[0] @ after[0] > white @ white:
            damping = max(10.0 * damping, 1e-3)
            continue
        pose, found, damping = tried, after, 0.1 * damping
    white, slopes, bare = found
    normal = slopes.T @ slopes
    if np.linalg.cond(normal) > 1e15:
        return None
    rms = float(np.sqrt(np.mean(bare**2)))
    return _Minimum(pose, float(white @ white), normal, slopes, rms)


def _fronts_seen(pose: RigidTransform, pairs: list[tuple[Marker, MarkerSighting]]) -> bool:
    """Whether the pose shows the camera the printed side of every marker that it sees."""
    return all(
        float(pose.rotate(marker.normal) @ (pose @ marker.corners.mean(axis=0))) < 0.0
        for marker, _ in pairs
    )


def _apart(first: RigidTransform, second: RigidTransform) -> float:
    """Angle between two poses' rotations [rad]."""
    return float(np.linalg.norm((first @ second.inverse()).log()[3:]))
