"""A pen before a simulated webcam, for the tests of the pen."""

from functools import cache

import numpy as np

from app.core.arrays import unit
from app.core.transform import RigidTransform
from app.tracking.cameras.camera import CameraFrame
from app.tracking.optics.calibration import CameraCalibration
from app.tracking.optics.rig import CameraProfile
from app.tracking.pen.body import load_pen
from app.tracking.pen.detector import MarkerSighting
from app.tracking.pen.step import PenStep
from app.tracking.pen.webcam import Webcam
from app.tracking.simulated.pen import PenRenderer
from app.tracking.simulated.pen_scene import PenScene, body_pose

ENTRY = np.array([0.0, 0.16056, 0.090])
PEN = load_pen("cube")
TIP = np.array([0.0, 0.0, 0.180])
DOWN = np.array([0.0, 0.0, 1.0])
BODY, BASE = PEN.body.board(), PEN.base.board()


@cache
def camera(position_mm=(60, 560, 380), looks_at_mm=(0, 160, 130), size=(640, 480), focal=620.0):
    return CameraProfile(
        name="webcam",
        image_size=size,
        focal_px=(focal, focal),
        centre_px=((size[0] - 1) / 2, (size[1] - 1) / 2),
        distortion=(-0.05, 0.02, 0.0003, -0.0003, 0.0),
        position_mm=position_mm,
        looks_at_mm=looks_at_mm,
    ).model()


def webcam(model):
    """The lens as if it had been calibrated exactly."""
    fx, fy, cx, cy = model.intrinsics
    return Webcam(
        CameraCalibration(
            name="webcam",
            image_size=model.image_size,
            focal_px=(fx, fy),
            centre_px=(cx, cy),
            distortion=tuple(model.distortion),
        )
    )


@cache
def renderer(model):
    """Rays and background of a camera take longer than its pictures: made once."""
    return PenRenderer(model, BODY, BASE, PEN.base.pose(ENTRY), PEN.body.edge_mm * 1e-3)


def scene(lean=(0.15, 0.1), depth=0.05, roll=0.4, beside=(0.0, 0.0, 0.0)):
    axis = unit([*lean, -1.0])
    tip = ENTRY + depth * axis + np.array(beside)
    return PenScene(body_pose(tip, axis, TIP, DOWN, roll), tip), axis


def picture(draw, what, seed=0, noise=4.0, time=1.0):
    image = draw.render(what).astype(np.float64)
    image += np.random.default_rng(seed).normal(0.0, noise, image.shape[:2])[..., None]
    return CameraFrame(np.clip(np.rint(image), 0, 255).astype(np.uint8), time)


def step(model, pen=PEN):
    return PenStep(pen, webcam(model), ENTRY)


def sighting(model, T_camera_board: RigidTransform, marker, rng, sd=0.05, build=0.0):
    corners = marker.corners + build * rng.normal(0.0, 1.0, (4, 3))
    uv, ok = model.project_camera(T_camera_board @ corners)
    assert ok.all()
    return MarkerSighting(marker.id, uv + rng.normal(0.0, sd, (4, 2)), sd**2 * np.eye(8))
