"""Poses from which the search for a board begins: IPPE, both of its answers.

Collins, Bartoli: Infinitesimal plane-based pose estimation, IJCV 109 (2014).
"""

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.board import Marker
from app.tracking.pen.detector import MarkerSighting
from app.tracking.pen.problem import BoardProblem

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
    return [pose @ T_board_marker.inverse() for pose in poses]


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
