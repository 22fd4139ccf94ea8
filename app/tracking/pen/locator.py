"""Pose of a board from all its markers in one picture: Gauss-Newton on reprojection, both minima.

A single face looks almost the same from two sides (the planar ambiguity of perspective): IPPE gives
both poses of each marker as starts, all are refined over all corners, and where two different
poses explain the picture about equally well the answer is a refusal, not a guess.

Poses from which the search for a board begins: IPPE, both of its answers.

Collins, Bartoli: Infinitesimal plane-based pose estimation, IJCV 109 (2014).
"""

from collections.abc import Sequence
from dataclasses import replace

import cv2
import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.tracking.confidence import chi_square_quantile
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.board import Marker, MarkerBoard
from app.tracking.pen.detector import MarkerSighting
from app.tracking.pen.pose import BoardPose, PoseStatus
from app.tracking.pen.problem import SAME, BoardProblem, Minimum, angle_between, refine

_STARTS = 6


def starts_of(
    model: CameraModel, pairs: list[tuple[Marker, MarkerSighting]], problem: BoardProblem
) -> list[RigidTransform]:
    """Both poses of each marker by IPPE, best over all corners first."""
    flat = problem.points.shape[0] > 4 and np.ptp(problem.points[:, 2]) < 1e-9
    starts = _plane_poses(model, problem) if flat else []
    # Both poses of a plane of many markers hold all that those of its single markers could add.
    for marker, sighting in [] if starts else pairs:
        rays, ok = model.undistort(sighting.corners)
        if ok.all():
            starts += _square_poses(marker, rays)
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
    if not any(_explains(pose, square, rays) for pose in poses):
        # Of a square turned exactly about one of its own axes IPPE tells neither pose.
        poses = _ippe(square, rays + _NUDGE, cv2.SOLVEPNP_IPPE_SQUARE)
    return [pose @ T_board_marker.inverse() for pose in poses]


def _explains(pose: RigidTransform, points: FloatArray, rays: FloatArray) -> bool:
    """Return whether a pose shows points within a fifth of their rays' spread of where they are
    seen.
    """
    seen = pose @ points
    if not (seen[:, 2] > 0.0).all():
        return False
    off = np.abs(seen[:, :2] / seen[:, 2:] - rays).max()
    return bool(off < 0.2 * np.ptp(rays, axis=0).max())


def _plane_poses(model: CameraModel, problem: BoardProblem) -> list[RigidTransform]:
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


def _misfit(problem: BoardProblem, pose: RigidTransform) -> float:
    uv, ok = problem.model.project_camera(pose @ problem.points)
    return float(((problem.pixels - uv) ** 2).sum()) if ok.all() else float("inf")


DECISIVE = 16.0
"""Difference of chi-square between the two minima from which the better one is certain."""

_BESIDE = 0.05
"""Angle [rad] from a known minimum within which a start would only lead there."""

_NUDGE = np.array([[1e-7, 0.0], [0.0, 1e-7], [0.0, 0.0], [0.0, 0.0]])
"""Of normalised corners: far below a pixel, and enough to take the symmetry away."""

_ONE_PLANE = 0.99
"""Cosine between two faces' normals above which they are one plane."""

_GATE = 1e-6
"""Probability with which a good picture is refused by the check of its residual."""

_GROSS_PX = 2.0
"""Residual [px] that no calibration error explains. Below it a misfit widens the covariance."""


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
        pairs = self._pairs(sightings)
        if not pairs:
            return BoardPose.none(
                PoseStatus.UNSEEN, f"no marker of the {self.board.name} is in the picture"
            )
        ids, problem = _ids(pairs), self._problem(model, pairs)
        starts = starts_of(model, pairs, problem)
        minima = [m for m in _minima(problem, starts) if _fronts_seen(m.pose, pairs)]
        return self._judge(problem, sorted(minima, key=lambda m: m.cost), ids)

    def follow(
        self, model: CameraModel, sightings: Sequence[MarkerSighting], last: BoardPose
    ) -> BoardPose | None:
        """Pose near a known one, at a fraction of `locate`'s cost.

        The other minimum is not looked for. With the same markers `last.lead` says how far it was
        behind; markers in two planes have no other that explains them.

        Returns:
            None where only `locate` can tell: another marker alone, or a residual too large.
        """
        pairs = self._pairs(sightings)
        if not pairs or last.status is not PoseStatus.FOUND:
            return None
        ids, lead = _ids(pairs), last.lead
        if ids != last.ids:
            if all(marker.normal @ pairs[0][0].normal > _ONE_PLANE for marker, _ in pairs):
                return None
            lead = float("inf")
        problem = self._problem(model, pairs)
        found = refine(problem, last.T_camera_board)
        if found is None or not _fronts_seen(found.pose, pairs):
            return None
        if found.cost > chi_square_quantile(1.0 - _GATE, 2 * len(problem.points) - 6):
            return None
        return _found(problem, found, ids, last.tilt_apart, 1.0, lead)

    def _pairs(self, sightings: Sequence[MarkerSighting]) -> list[tuple[Marker, MarkerSighting]]:
        found = [(self.board.find(s.id), s) for s in sightings]
        return [(m, s) for m, s in found if m is not None and _usable(s)]

    def _problem(
        self, model: CameraModel, pairs: list[tuple[Marker, MarkerSighting]]
    ) -> BoardProblem:
        return BoardProblem(
            model,
            np.concatenate([marker.corners for marker, _ in pairs]),
            np.concatenate([sighting.corners for _, sighting in pairs]),
            np.array([s.covariance + self._systematic for _, s in pairs]),
            self.board.build_sd,
        )

    def _judge(
        self, problem: BoardProblem, minima: list[Minimum], ids: tuple[int, ...]
    ) -> BoardPose:
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
        other = next((m for m in minima[1:] if angle_between(m.pose, best.pose) > SAME), None)
        apart = angle_between(other.pose, best.pose) if other is not None else 0.0
        factor = max(1.0, best.cost / freedom) if misfit else 1.0
        lead = (other.cost - best.cost) / factor if other is not None else float("inf")
        if other is not None and lead < DECISIVE:
            either = tuple(_found(problem, m, ids, apart, factor, lead) for m in (best, other))
            reason = sentence(
                "the {name} is seen too flat: two poses {apart_deg:.0f}° apart look the "
                "same; turn it so that two faces show, or move the webcam to the side",
                name=name,
                apart_deg=np.degrees(apart),
            )
            return replace(BoardPose.none(PoseStatus.AMBIGUOUS, reason, ids, apart), either=either)
        return _found(problem, best, ids, apart, factor, lead)


def _ids(pairs: list[tuple[Marker, MarkerSighting]]) -> tuple[int, ...]:
    return tuple(sighting.id for _, sighting in pairs)


def _found(
    problem: BoardProblem,
    best: Minimum,
    ids: tuple[int, ...],
    apart: float,
    factor: float,
    lead: float,
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
        lead,
    )


def _usable(sighting: MarkerSighting) -> bool:
    return bool(
        np.isfinite(sighting.corners).all()
        and np.isfinite(sighting.covariance).all()
        and np.diag(sighting.covariance).min() >= 0.0
    )


def _minima(problem: BoardProblem, starts: list[RigidTransform]) -> list[Minimum]:
    """Refine the starts that are not beside a minimum that is known already."""
    minima: list[Minimum] = []
    for start in starts:
        known = [minimum.pose for minimum in minima]
        if all(angle_between(start, pose) > _BESIDE for pose in known):
            found = refine(problem, start, known)
            minima += [] if found is None else [found]
    return minima


def _fronts_seen(pose: RigidTransform, pairs: list[tuple[Marker, MarkerSighting]]) -> bool:
    """Return whether the pose shows the camera the printed side of every marker that it sees."""
    return all(
        float(pose.rotate(marker.normal) @ (pose @ marker.corners.mean(axis=0))) < 0.0
        for marker, _ in pairs
    )
