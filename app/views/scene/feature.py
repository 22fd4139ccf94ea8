"""The 3D view's menu, slices and cut of the CT in it, and what of it is remembered."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import ClassVar

import numpy as np
from PySide6.QtCore import QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from app.planning.needle_planes import NeedleFrame, follow, frame_of, in_plane
from app.views.kit.roles import EVERYBODY, Role
from app.views.kit.text import keys_text, literal, tr
from app.views.scene.display import Display, Section
from app.views.scene.view import PRESETS, SceneView
from app.views.shell.feature import Context, Feature
from app.views.slices.panes import MPR_PANES

KEY = "scene"
"""Where the settings keep it."""

LATEST_MS = 60
"""Slices and cut are laid anew at most this often, however fast crosshair and needle move."""


class SceneFeature(Feature):
    """Brings the CT's slices and the cut along the needle into the 3D view, and its menu."""

    topic: ClassVar[str] = "scene"
    place: ClassVar[int] = 130
    roles: ClassVar[frozenset[Role]] = EVERYBODY

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._scene, self._viewing = context.views.scene, context.views.viewing
        self._settings = context.shell.settings
        self._along: NeedleFrame | None = None
        self._sections: tuple[Section, ...] = ()
        self._cut: tuple[Section, ...] = ()
        self._late = QTimer(self, interval=LATEST_MS, singleShot=True)
        self._late.timeout.connect(self._lay)
        self.menu = SceneMenu(context.shell.menu(tr("&View"), tr("3D view")), self._scene)
        self._restore()
        viewing = self._viewing
        for changed in (viewing.cursor_changed, viewing.window_changed, viewing.needle_changed):
            changed.connect(self._wait)
        viewing.plane_changed.connect(lambda _: self._wait())
        viewing.plan_changed.connect(self._take_plan)
        context.conductor.patient_changed.connect(self._take_patient)
        self._scene.display_changed.connect(self._take_display)

    def forget(self) -> None:
        """Let go of the patient who leaves."""
        self._late.stop()
        self._along, self._sections, self._cut = None, (), ()
        self._scene.set_sections(())
        self._scene.set_cut(None)
        self._scene.set_patient(None)

    def close(self) -> None:
        """Lay nothing any more; idempotent."""
        self._late.stop()

    def _restore(self) -> None:
        try:
            state = json.loads(str(self._settings.value(KEY) or "{}"))
            self._scene.set_display(Display.of_document(state))
        except (ValueError, AttributeError):  # written by hand or by another version
            return

    def _take_display(self) -> None:
        self._settings.setValue(KEY, json.dumps(self._scene.display.document()))
        self._lay()

    def _take_patient(self) -> None:
        self._scene.set_patient(self.context.conductor.patient)
        self._wait()

    def _take_plan(self) -> None:
        self._scene.set_tolerances(self._viewing.tolerances_mm)
        self._scene.set_placement(self.context.editors.plan.edit.placement.rotation)
        self._wait()

    def _wait(self) -> None:
        display = self._scene.display
        if (display.slices or display.cut) and not self._late.isActive():
            self._late.start()

    def _lay(self) -> None:
        """Lay slices and cut where crosshair and needle are now."""
        patient, display, viewing = (
            self.context.conductor.patient,
            self._scene.display,
            self._viewing,
        )
        sections: tuple[Section, ...] = ()
        cut = None
        if patient is not None and viewing.volume is patient.volume:
            frames = (viewing.frame(pane) for pane in MPR_PANES if display.slices)
            sections = tuple(
                Section(patient, frame, viewing.window) for frame in frames if frame is not None
            )
            self._along = self._needle_frame() if display.cut else None
            if self._along is not None:
                cut = Section(patient, in_plane(self._along), viewing.window)
        if not _alike(self._sections, sections):
            self._scene.set_sections(sections)
        if not _alike(self._cut, () if cut is None else (cut,)):
            self._scene.set_cut(cut)
        self._sections, self._cut = sections, () if cut is None else (cut,)

    def _needle_frame(self) -> NeedleFrame | None:
        """Planes of the needle, of the path where there is none, or None without either."""
        needle, draft = self._viewing.needle, self._viewing.draft
        if needle is not None and needle.valid:
            return follow(self._along, needle.tip_mm, needle.tip_mm - needle.start_mm)
        if draft.entry_mm is None or draft.target_mm is None:
            return None
        way = np.subtract(draft.target_mm, draft.entry_mm)
        return frame_of(draft.target_mm, way) if np.linalg.norm(way) > 1.0 else None


def _alike(item: tuple[Section, ...], other: tuple[Section, ...]) -> bool:
    pairs = zip(item, other, strict=False)
    return len(item) == len(other) and all(a.shows_the_same(b) for a, b in pairs)


class SceneMenu:
    """From where one looks and what is shown, each with its key; check marks kept true.

    Attributes:
        looks: entries of places to look from, by key.
        switches: entries that switch something, by key.
        presets: entries of the volume rendering, by preset; the empty one is surfaces.
    """

    def __init__(self, menu: QMenu, scene: SceneView) -> None:
        self._scene = scene
        menu.setToolTipsVisible(True)
        self.standpoints = self._entries(
            menu,
            (
                ("A", tr("From the front"), tr("What is at the patient's right is on the left.")),
                ("P", tr("From behind"), tr("Onto the back.")),
                ("L", tr("From the patient's left"), tr("The face looks to the left.")),
                ("R", tr("From the patient's right"), tr("The face looks to the right; Shift+R.")),
                ("S", tr("From the head"), tr("The front is on top.")),
                ("I", tr("From the feet"), tr("The front is on top, as in axial slices.")),
                ("N", tr("From the needle"), tr("Along the needle, or the path: what lies ahead.")),
                ("W", tr("From the operator"), tr("From behind the robot, as you stand at it.")),
                ("Space", tr("Whole patient"), tr("Patient and robot, a little from the side.")),
                ("Backspace", tr("Back"), tr("From where one looked before.")),
            ),
        )
        menu.addSeparator()
        self.switches = self._entries(
            menu,
            (
                (
                    "X",
                    tr("X-ray"),
                    tr("Needle, path and target before everything, the body faint."),
                ),
                (
                    "C",
                    tr("Cut along the needle"),
                    tr("What lies before the needle's plane goes; the CT is on the cut."),
                ),
                ("M", tr("Slices"), tr("Axial, sagittal and coronal slice where they are.")),
                ("Y", tr("Organs"), tr("The lungs; of the built-in patient all organs.")),
                (
                    "Z",
                    tr("Grid, electrodes and zones"),
                    tr("What the exercise asks for: grid on the skin; electrodes, zones, margins."),
                ),
                ("Q", tr("Light background"), tr("For projectors.")),
            ),
        )
        for action in self.switches.values():
            action.setCheckable(True)
        self._volume = menu.addMenu(tr("Volume rendering"))
        self._volume.setToolTipsVisible(True)
        titles = (tr("Surfaces"), tr("Bone"), tr("Skin"), tr("Lung"), tr("Vessels"))
        self.presets = {}
        for name, title in zip(PRESETS, titles, strict=True):
            self.presets[name] = action = self._volume.addAction(title)
            action.setCheckable(True)
            action.triggered.connect(
                lambda _=False, name=name: scene.set_display(replace(scene.display, volume=name))
            )
        menu.aboutToShow.connect(self.refresh)
        scene.display_changed.connect(self.refresh)
        scene.set_menu(menu)

    def _entries(self, menu: QMenu, rows: tuple[tuple[str, str, str], ...]) -> dict[str, QAction]:
        found = {}
        for key, text, tip in rows:
            action = menu.addAction(f"{text}\t{keys_text(key)}")  # the key is the 3D view's own
            action.setToolTip(literal(tip))
            action.triggered.connect(lambda _=False, key=key: self._scene.commands[key]())
            found[key] = action
        return found

    def refresh(self) -> None:
        """Check what is shown; say why the volume cannot be rendered, where it cannot."""
        display, why = self._scene.display, self._scene.why_no_volume
        states = {
            "X": display.xray,
            "C": display.cut,
            "M": display.slices,
            "Y": display.organs,
            "Q": display.light,
            "Z": display.guides,
        }
        for key, action in self.switches.items():
            action.setChecked(states[key])
        for name, action in self.presets.items():
            action.setChecked(name == display.volume)
            action.setEnabled(not name or not why)
            action.setToolTip(literal(why if name else ""))
