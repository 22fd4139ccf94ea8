"""The webcam before a pen: a real one, or one whose pictures are drawn of the simulated pen."""

from __future__ import annotations

from typing import Final

import numpy as np

from app.core.clock import Clock
from app.core.units import MILLIMETRE
from app.mechanisms.profile import DeviceProfile
from app.tracking.cameras.camera import Camera
from app.tracking.cameras.factory import make_camera
from app.tracking.cameras.settings import CameraSettings, OneCamera
from app.tracking.optics.calibration import CameraCalibration
from app.tracking.optics.rig import CameraProfile
from app.tracking.pen.settings import PenSettings
from app.tracking.pen.webcam import Webcam
from app.tracking.simulated.cameras import SimulatedCamera
from app.tracking.simulated.pen import PenRenderer
from app.tracking.simulated.pen_scene import PenSceneAt
from app.tracking.simulated.picture_effects import NoiseTile, noise

SIMULATED_WEBCAM: Final = CameraProfile(
    name="webcam",
    image_size=(640, 480),
    focal_px=(620.0, 620.0),
    centre_px=(319.5, 239.5),
    distortion=(-0.05, 0.02, 0.0003, -0.0003, 0.0),
    position_mm=(60.0, 560.0, 380.0),
    looks_at_mm=(0.0, 160.0, 130.0),
)
"""A webcam on a small stand, 47 cm from the entry."""

_SIMULATED_RATE_HZ: Final = 15.0
_NOISE_GREY: Final = 4.0


def attached_camera(settings: PenSettings, clock: Clock) -> Camera:
    """Return the real webcam of the settings, not open yet.

    Raises:
        CameraError: for a simulated one.
    """
    one = OneCamera(source=settings.source)
    wanted = CameraSettings(size=settings.size, rate_hz=settings.rate_hz, left=one, right=one)
    return make_camera(wanted, one, clock)


def simulated_lens() -> Webcam:
    """Return the lens of the simulated webcam, exactly known."""
    camera = SIMULATED_WEBCAM
    return Webcam(
        CameraCalibration(
            name=camera.name,
            image_size=camera.image_size,
            focal_px=camera.focal_px,
            centre_px=camera.centre_px,
            distortion=camera.distortion,
        )
    )


def simulated_webcam(
    settings: PenSettings, scene: PenSceneAt, profile: DeviceProfile, clock: Clock, seed: int
) -> SimulatedCamera:
    """Return a webcam whose pictures are drawn, with noise."""
    model, pen = SIMULATED_WEBCAM.model(), settings.profile()
    base = pen.base.pose(np.array(profile.pantograph.fulcrum))
    edge = pen.body.edge_mm * MILLIMETRE
    renderer = PenRenderer(model, pen.body.board(), pen.base.board(), base, edge, seed=seed)
    tile = NoiseTile.make(model.image_size, _NOISE_GREY, seed + 100)
    return SimulatedCamera(
        renderer, scene, clock, _SIMULATED_RATE_HZ, effects=[(noise, tile)], seed=seed + 200
    )
