"""Makes the picture of the needle holder in 3D; part of `make docs-pictures`.

`python -m tools.holder_pictures FOLDER` draws the built-in patient with the holder over the entry
of `tensegrity-liver`, its cables at tensions from slack to strong, without a window.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Final

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage

from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.planning.patient import load_phantom
from app.views.scene.orbit import Orbit
from app.views.scene.robot import RobotShape
from app.views.scene.stage import Stage
from app.views.scene.surfaces import extract_surfaces
from app.views.scene.view import HOME_TURN_PX
from app.views.shell.application import start

SIZE, SHOWN_PX = (900, 760), 560
TENSIONS: Final = (0.0, 30.0, 6.0, 150.0)
"""One slack cable, and three from weak to strong [N]."""


def main(folder: Path) -> None:
    """Write holder.png."""
    application = start(offscreen=True)
    exercise = load_exercise("tensegrity-liver")
    profile = device_of(exercise)
    placed = placed_plan_of(exercise, profile)
    patient, T_patient_world = load_phantom(1, Progress()), placed.T_world_patient.inverse()
    stage = Stage()
    surfaces = extract_surfaces(patient.volume, patient.body, Progress(), patient.phantom_seed)
    stage.open()
    stage.set_patient(patient)
    stage.set_surfaces(surfaces)
    stage.set_plan(DraftPlan.of(placed.plan))
    robot = RobotShape.of(profile, profile.machine.usable(placed.axis), TENSIONS)
    stage.set_robot(robot, T_patient_world)
    p_tip, axis = placed.p_entry + 0.03 * placed.axis, placed.axis
    stage.set_needle(
        NeedleOverlay.of_world(
            p_tip, axis, profile.needle_length, placed.T_world_patient, True, None, None
        )
    )
    ends = np.array([end for rod in robot.links() for end in rod])
    points = (T_patient_world @ ends) / MILLIMETRE
    low, high = surfaces.skin.points.min(axis=0), surfaces.skin.points.max(axis=0)
    points = np.vstack([points, 0.5 * (low + high)])
    orbit = Orbit.from_side("A", points.mean(axis=0), 1.0).turned(*HOME_TURN_PX).fitted(points)
    picture = np.ascontiguousarray(stage.render(orbit, SIZE, moving=False))
    image = QImage(picture.data, *SIZE, QImage.Format.Format_RGBX8888)
    smooth = Qt.TransformationMode.SmoothTransformation
    shown = image.convertToFormat(QImage.Format.Format_RGB888).scaledToWidth(SHOWN_PX, smooth)
    shown.save(str(folder / "holder.png"))
    stage.close()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
