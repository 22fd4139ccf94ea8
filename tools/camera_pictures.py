"""Makes the pictures of the cameras in the user guide; part of `make docs-pictures`.

`python -m tools.camera_pictures FOLDER` needs no camera: two folders of rendered pictures stand in.
"""

import os
import sys
import tempfile
from datetime import UTC, datetime
from pathlib import Path

import cv2
import numpy as np
from PySide6.QtWidgets import QApplication

from app.compose.desktop import Desktop
from app.tracking.calibration.history import CalibrationHistory
from app.tracking.cameras.settings import CameraSettings, parse_cameras, save_settings
from app.tracking.optics.calibration import CameraCalibration, PoseCalibration, StereoCalibration
from app.tracking.optics.rig import RigProfile, load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.scene import MarkerScene
from app.views.cameras.feature import AimDialog
from app.views.cameras.latency_dialog import LatencyDialog
from app.views.cameras.settings_dialog import CameraSettingsDialog
from app.views.shell.application import start
from tools.robot_pictures import keep, pause, wait

FULCRUM = np.array([0.0, 0.16056, 0.090])


def rendered(rig: RigProfile, folder: Path) -> CameraSettings:
    """Write pictures of a needle that leans and is 60 mm deep into the folders left and right."""
    rng = np.random.default_rng(1)
    axis = np.array([0.12, -0.05, -1.0]) / np.linalg.norm([0.12, -0.05, -1.0])
    scene = MarkerScene.from_tip(FULCRUM + 0.06 * axis, axis, rig.needle.marker_offset)
    for index, model in enumerate(rig.models):
        (folder / model.name).mkdir()
        clean = NeedleRenderer(model, rig.needle, rig.blur_px, index).render(scene).astype(float)
        for number in range(8):
            noisy = np.clip(clean + rng.normal(0.0, rig.noise_grey, clean.shape), 0, 255)
            cv2.imwrite(str(folder / model.name / f"{number}.png"), noisy.astype(np.uint8))
    return parse_cameras("left=folder:left,right=folder:right")


def calibration(rig: RigProfile) -> StereoCalibration:
    """Return a rig's own cameras as a calibration."""
    first, second = (
        CameraCalibration(
            name=m.name,
            image_size=m.image_size,
            focal_px=tuple(m.intrinsics[:2]),
            centre_px=tuple(m.intrinsics[2:]),
            distortion=tuple(m.distortion),
        )
        for m in rig.models
    )
    left, right = (model.T_world_camera for model in rig.models)
    return StereoCalibration(
        id="20261122-091244-3f2a",
        created=datetime.now(UTC),
        cameras=(first, second),
        pose=PoseCalibration.of(right.inverse() @ left),
        world=PoseCalibration.of(left),
    )


def main(folder: Path) -> None:
    """Make them all."""
    folder = folder.resolve()
    application = start(offscreen=True)
    services, rig = Desktop(), load_rig("wide")
    with tempfile.TemporaryDirectory() as pictures:
        os.chdir(pictures)  # the folders are shown by name
        settings = rendered(rig, Path())
        save_settings(settings)
        CalibrationHistory().keep(calibration(rig))
        setup = CameraSettingsDialog(settings, services, lambda: None)
        setup.show()
        wait(lambda: all(side.preview.picture.has_image for side in setup.sides))
        pause(1.5)
        keep(setup, folder / "cameras-set-up.png")
        setup.reject()
        setup.closed()()
        aim = AimDialog(settings, "icube", services, lambda: None)
        aim.show()
        wait(lambda: bool(aim.share.text()))
        wait(lambda: all(preview.picture.has_image for preview in aim.previews))
        pause(1.5)
        keep(aim, folder / "cameras-aim.png")
        aim.reject()
        aim.closed()()
        latency = LatencyDialog(settings, "left", services, lambda: None)
        latency.show()
        wait(latency.start.isEnabled)
        latency.begin()
        pause(3.0)
        keep(latency, folder / "cameras-latency.png")
        latency.reject()
        latency.closed()()
    QApplication.processEvents()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
