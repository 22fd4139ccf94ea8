"""Makes the pictures of the 3D view: six views, and its modes.

Part of `make docs-pictures`. `python -m tools.scene_pictures FOLDER` draws the chest CT of the test
data (left out where it is not there) and the built-in patient, without a window.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtGui import QImage

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.imaging.body import find_body
from app.imaging.reading import load_ct
from app.imaging.reformat import Frame
from app.imaging.window import WindowLevel
from app.planning.draft import DraftPlan
from app.planning.needle_overlay import NeedleOverlay
from app.planning.needle_planes import frame_of, in_plane
from app.planning.patient import Patient, load_phantom
from app.planning.placement import Placement
from app.planning.plan import Plan
from app.views.scene.display import Display, Section
from app.views.scene.orbit import Orbit
from app.views.scene.stage import Stage
from app.views.scene.surfaces import extract_surfaces
from app.views.scene.view import CUT_TURN_PX, HOME_TURN_PX, NEEDLE_HALF_MM
from app.views.shell.application import start
from tools.docs_pictures import CHEST
from tools.reading_studio import LIVER, chest_of

SIZE = (900, 700)
SHOWN_PX = 560
NEEDLE_MM, DEPTH_SHARE = 200.0, 0.55
SOFT = WindowLevel(400.0, 40.0)


class Sitting:
    """One patient on the stage, a needle on the way to the target."""

    def __init__(self, folder: Path, name: str, patient: Patient, plan: Plan) -> None:
        self._folder, self._name, self._patient = folder, name, patient
        self.entry, self.target = plan.entry_mm, plan.target_mm
        surfaces = extract_surfaces(patient.volume, patient.body, Progress(), patient.phantom_seed)
        self._stage = Stage()
        self._stage.open()
        self._stage.set_patient(patient)
        self._stage.set_surfaces(surfaces)
        self._stage.set_plan(DraftPlan.of(plan))
        self._stage.set_tolerances((2.0, 5.0))
        way = self.target - self.entry
        self.axis: FloatArray = way / np.linalg.norm(way)
        self.tip: FloatArray = self.entry + DEPTH_SHARE * way
        self._stage.set_needle(NeedleOverlay(self.tip - NEEDLE_MM * self.axis, self.tip))
        self.points = surfaces.skin.points.astype(np.float64)
        middle = (self.points.min(axis=0) + self.points.max(axis=0)) / 2.0
        front = Orbit.from_side("A", middle, 1.0).turned(*HOME_TURN_PX)
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        self.corners = np.array([np.where(bits, high, low) for bits in np.ndindex(2, 2, 2)])
        self.front = front.fitted(self.corners)

    def keep(self, name: str, orbit: Orbit, display: Display | None = None) -> None:
        """Write a picture as scene-<patient>[-<name>].png."""
        self._stage.set_display(display or Display())
        picture = np.ascontiguousarray(self._stage.render(orbit, SIZE, moving=False))
        image = QImage(picture.data, *SIZE, QImage.Format.Format_RGBX8888)
        words = "-".join(filter(None, ("scene", self._name, name)))
        smooth = Qt.TransformationMode.SmoothTransformation
        shown = image.convertToFormat(QImage.Format.Format_RGB888).scaledToWidth(SHOWN_PX, smooth)
        shown.save(str(self._folder / f"{words}.png"))  # a palette has too few shades of skin

    def as_before(self) -> None:
        """Make the three views that there are of before."""
        self.keep("", self.front)
        self.keep("behind", self.front.seen_from("P"))
        self.keep("near", replace(self.front.zoomed(2.4), focus_mm=self.target))

    def modes(self) -> None:
        """Make a picture of every way to look and to show."""
        self.keep("xray", self.front, Display(xray=True))
        self.keep("light", self.front, Display(light=True))
        along = Orbit.towards(self.axis, (0.0, 0.0, 1.0), self.tip, NEEDLE_HALF_MM)
        self.keep("needle", along)
        operator = Orbit.from_operator(Placement().rotation, self.front.focus_mm, 1.0)
        self.keep("operator", operator.fitted(self.corners))
        x, y, z = np.eye(3)
        frames = (Frame(self.target, x, y), Frame(self.target, y, -z), Frame(self.target, x, -z))
        self._stage.set_sections(tuple(Section(self._patient, one, SOFT) for one in frames))
        self.keep("slices", self.front, Display(slices=True))
        self._stage.set_sections(())
        cut = Section(self._patient, in_plane(frame_of(self.tip, self.axis)), SOFT)
        self._stage.set_cut(cut)
        eye = Orbit.towards(cut.frame.normal, z, self.front.focus_mm, self.front.half_mm)
        self.keep("cut", eye.turned(*CUT_TURN_PX))

    def close(self) -> None:
        """Free the graphics."""
        self._stage.close()


def main(folder: Path) -> None:
    """Make them all."""
    application = start(offscreen=True)
    patients: list[tuple[str, Patient, Plan]] = []
    if (chest := chest_of(CHEST)) is not None:
        volume = load_ct(chest)
        patients.append(("chest", Patient(volume, find_body(volume), "chest"), LIVER.plan()))
    built_in = load_phantom(1, Progress())
    if built_in.proposed is not None:
        patients.append(("phantom", built_in, built_in.proposed))
    for name, patient, plan in patients:
        sitting = Sitting(folder, name, patient, plan)
        sitting.as_before()
        sitting.modes()
        sitting.close()
    application.quit()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
