"""Errors of the needle: in rendered pictures, and with everything declared drawn anew."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, unit
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.mechanisms.profile import load_profile
from app.studies.webcam.setups import Setup
from app.tracking.cameras.camera import Frame
from app.tracking.optics.calibration import CameraCalibration
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.board import Marker, MarkerBoard
from app.tracking.pen.body import load_pen
from app.tracking.pen.detector import MarkerSighting
from app.tracking.pen.locator import BoardLocator
from app.tracking.pen.needle import PenTip, solve_needle
from app.tracking.pen.pose import PoseStatus
from app.tracking.pen.step import PenStep
from app.tracking.pen.webcam import Webcam
from app.tracking.simulated.pen import PenRenderer
from app.tracking.simulated.pen_scene import PenScene, body_pose

_POSES: Final = 24
_TRIALS: Final = 1000
_SEED: Final = 5


@dataclass(frozen=True, slots=True, eq=False)
class Outcome:
    """Errors of tip [m] and axis [rad], and squared Mahalanobis distances of the tip."""

    tip: FloatArray
    axis: FloatArray
    distance: FloatArray
    share: float


def rendered(setup: Setup, poses: int = _POSES, seed: int = _SEED) -> Outcome:
    """Errors in rendered pictures over the workspace: an exact print, the pictures' error alone."""
    pen, model, rng = setup.pen(), setup.camera(), np.random.default_rng(seed)
    entry = load_profile("icube").pantograph.fulcrum
    draw = PenRenderer(
        model, pen.body.board(), pen.base.board(), pen.base.pose(entry), setup.edge_mm * MILLIMETRE
    )
    known = PenStep(pen, _lens(model), entry)
    tips, axes, distances = [], [], []
    for _ in range(poses):
        T_world_body, p_tip, axis = _held(rng, entry)
        image = draw.render(PenScene(T_world_body, p_tip)).astype(np.float64)
        image += rng.normal(0.0, setup.noise, image.shape[:2])[..., None]
        frame = Frame(np.clip(np.rint(image), 0, 255).astype(np.uint8), 1.0)
        needle = known.look(frame).needle
        if needle is None:
            continue
        error = needle.p_tip - p_tip
        tips.append(float(np.linalg.norm(error)))
        axes.append(float(np.linalg.norm(np.cross(needle.axis, axis))))
        distances.append(float(error @ np.linalg.solve(needle.tip_covariance, error)))
    share = len(tips) / poses
    return Outcome(np.array(tips), np.array(axes), np.array(distances), share)


def trials(count: int = _TRIALS, seed: int = _SEED) -> Outcome:
    """Errors with print, tip and corners drawn anew from what is declared of them."""
    pen, model, rng = load_pen("cube"), Setup().camera(), np.random.default_rng(seed)
    entry = load_profile("icube").pantograph.fulcrum
    tip = PenTip.of(pen.tip)
    boards = (pen.body.board(), replace(pen.base.board(), markers=pen.base.board().markers[::2]))
    locators = [BoardLocator(board) for board in boards]
    tips, axes, distances = [], [], []
    for _ in range(count):
        T_world_body, _, _ = _held(rng, entry)
        drawn = rng.multivariate_normal(np.zeros(6), tip.covariance)
        p_tip, axis = (
            T_world_body @ (tip.p_tip + drawn[:3]),
            T_world_body.rotate(tip.axis + drawn[3:]),
        )
        poses = [
            locator.locate(model, _sightings(model, model.T_camera_world @ T, board, rng))
            for locator, board, T in zip(
                locators, boards, (T_world_body, pen.base.pose(entry)), strict=True
            )
        ]
        if any(pose.status is not PoseStatus.FOUND for pose in poses):
            continue
        needle = solve_needle(poses[0], poses[1], pen.base.pose(entry), tip, np.zeros((9, 9)))
        error = needle.p_tip - p_tip
        tips.append(float(np.linalg.norm(error)))
        axes.append(float(np.linalg.norm(np.cross(needle.axis, unit(axis)))))
        distances.append(float(error @ np.linalg.solve(needle.tip_covariance, error)))
    return Outcome(np.array(tips), np.array(axes), np.array(distances), len(tips) / count)


def _held(
    rng: np.random.Generator, entry: FloatArray
) -> tuple[RigidTransform, FloatArray, FloatArray]:
    """Pose of a pen in the hole: any lean up to 30°, any depth, any turn; its tip and axis."""
    lean, way = np.tan(30.0 * DEGREE) * np.sqrt(rng.uniform()), rng.uniform(0.0, 2.0 * np.pi)
    axis = unit([lean * np.cos(way), lean * np.sin(way), -1.0])
    p_tip = entry + rng.uniform(-0.02, 0.09) * axis
    tip = PenTip.of(load_pen("cube").tip)
    roll = rng.uniform(0.0, 2.0 * np.pi)
    return body_pose(p_tip, axis, tip.p_tip, tip.axis, roll), p_tip, axis


def _sightings(
    model: CameraModel, T_camera_board: RigidTransform, board: MarkerBoard, rng: np.random.Generator
) -> list[MarkerSighting]:
    """Corners of all faces that the camera sees well, with the print's errors and 0.05 px."""
    found = []
    for marker in board.markers:
        if _slant(T_camera_board, marker) < 0.35:
            continue
        corners = marker.corners + rng.normal(0.0, board.build_sd, (4, 3))
        uv, _ = model.project_camera(T_camera_board @ corners)
        noisy = uv + rng.normal(0.0, 0.05, (4, 2))
        found.append(MarkerSighting(marker.id, noisy, 0.05**2 * np.eye(8)))
    return found


def _slant(pose: RigidTransform, marker: Marker) -> float:
    """Cosine between a face's normal and the way to the camera; negative from behind."""
    centre = pose @ marker.corners.mean(axis=0)
    return float(-pose.rotate(marker.normal) @ unit(centre))


def _lens(model: CameraModel) -> Webcam:
    fx, fy, cx, cy = model.intrinsics.tolist()
    k = model.distortion.tolist()
    return Webcam(
        CameraCalibration(
            name=model.name,
            image_size=model.image_size,
            focal_px=(fx, fy),
            centre_px=(cx, cy),
            distortion=(k[0], k[1], k[2], k[3], k[4]),
        )
    )
