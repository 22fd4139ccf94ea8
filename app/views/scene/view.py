"""The view `three_d`: shows the newest picture of the render thread; mouse and keys turn it.

A patient's surfaces are extracted beside the window and shown when they are there.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from PySide6.QtCore import QObject, QPointF, Qt, Signal
from PySide6.QtGui import (
    QCloseEvent,
    QColor,
    QContextMenuEvent,
    QImage,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
    QShowEvent,
    QWheelEvent,
)
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from app.core.arrays import FloatArray
from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.core.transform import RigidTransform
from app.core.units import MILLIMETRE
from app.imaging.volume import Volume
from app.planning.draft import DraftPlan
from app.planning.error_overlay import Enlargement
from app.planning.needle_overlay import NeedleOverlay
from app.planning.patient import Patient
from app.planning.placement import Placement
from app.session.touching import TargetMarks
from app.views.kit import theme
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.text import tr
from app.views.scene.display import ORGAN_COLOURS, Display, Section, organ_title
from app.views.scene.orbit import Orbit
from app.views.scene.renderer import SceneFeed, SceneRenderer
from app.views.scene.robot import RobotShape
from app.views.scene.shape import SceneShape
from app.views.scene.words import Entry, draw_compass, draw_targets, draw_words

if TYPE_CHECKING:
    from app.imaging.structures.structure import Colour
    from app.views.plan.entry_map import EntryMap
    from app.views.scene.guides import Guides
    from app.views.scene.mesh import Mesh
    from app.views.scene.surfaces import Surfaces


DECLARATION: Final[dict[str, Any]] = {
    "view": "three_d",
    "title": "3D view",
    "reads": ("tip_offset",),
}

HOME_TURN_PX = (-50.0, 30.0)
"""From the front one first looks a little from the left and from above, for depth."""

BESIDE_TURN_PX, TARGETS_MARGIN = (60.0, 30.0), 2.5
"""Targets to be touched are looked at from the patient's right, turned so far, with such room."""

BESIDE_LEGEND = 0.12
"""Share of the width by which they stand right of the middle: the legend is at the left."""

ZOOM_PER_PX, ZOOM_PER_NOTCH, NOTCH = 1.01, 1.15, 120

NEEDLE_HALF_MM = 75.0
"""Half of what the view along the needle shows."""

CUT_TURN_PX = (-36.0, 24.0)
"""A cut is looked at a little from the side, so that one sees what it cuts."""

SIDES = ("A", "P", "L", "R", "S", "I")
PRESETS = ("", "bone", "skin", "lung", "vessels")
"""Surfaces, then the presets of the volume rendering in their order."""

MOST_BACK = 50
"""So many places of the eye are kept to go back to."""

STANDS_MM = 1.0
"""The home view is fitted anew when the robot's base moved more than this in the patient."""


LEGEND_FROM_PX = 400
"""In a narrower pane there is no room for a legend beside the body: it is left out."""


class SceneView(QWidget):
    """Surfaces, robot, needle and plan in 3D.

    Signals:
        maximise_wanted(): double click.
        clicked(object, object): a click that did not turn: point and direction [mm, LPS] of the
            line of sight.
        display_changed(): something else is shown, or otherwise.
        surfaces_changed(): other surfaces are there, or none, or other structures.

    Attributes:
        commands: what the view does by itself, by the key that asks for it.
        surfaces: skin, bone and organs as they are shown; None while there are none.
        structures: those that are shown, each in its colour.
        guides: what the exercise asks for beside, by its part.
        overlays: draw more over the picture, with the place of any point in the pane.
    """

    maximise_wanted = Signal()
    clicked = Signal(object, object)
    display_changed = Signal()
    surfaces_changed = Signal()

    def __init__(self, renderer: SceneRenderer, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setMinimumSize(120, 90)
        self._home = Orbit.from_side("A", np.zeros(3), 250.0)
        self._feed = SceneFeed(renderer, self._home, self)
        self._feed.arrived.connect(self.update)
        self._body: FloatArray = _box(np.zeros((1, 3)))
        self._robot: FloatArray | None = None
        self.note = self.off = ""
        self.surfaces: Surfaces | None = None
        self.structures: tuple[tuple[Colour, Mesh], ...] = ()
        self.legend: tuple[Entry, ...] = ()
        self._robot_legend: tuple[Entry, ...] = ()
        self._organs: tuple[str, ...] = ()
        self.guides: Mapping[str, Guides] = {}
        self._enlargement = Enlargement()
        self._pressed, self._last = QPointF(), QPointF()
        self.display, self._before = Display(), list[Orbit]()
        self._needle: NeedleOverlay | None = None
        self._draft, self._cut = DraftPlan(), False
        self._targets: TargetMarks | None = None
        self.overlays: list[Callable[[QPainter, SceneView], None]] = []
        self._R_world_patient = Placement().rotation
        self.commands = self._commands()
        self._button = QToolButton(self)
        self._button.setText("☰")
        self._button.setToolTip(tr("Viewpoint, and what is shown"))
        self._button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        self._button.setAccessibleName(tr("Viewpoint, and what is shown"))
        self._button.setFocusPolicy(Qt.FocusPolicy.TabFocus)  # a click leaves the keys to the view
        self._button.hide()

    def _commands(self) -> Mapping[str, Callable[[], None]]:
        def side(letter: str) -> Callable[[], None]:
            return lambda: self.view_from(self.orbit.seen_from(letter))

        def switch(part: str) -> Callable[[], None]:
            return lambda: self.set_display(self.display.switched(part))

        return {letter: side(letter) for letter in SIDES} | {
            "N": self.view_along_needle,
            "W": self.view_as_operator,
            "Space": lambda: self.view_from(self._home),
            "Backspace": self.view_back,
            "X": switch("xray"),
            "C": switch("cut"),
            "M": switch("slices"),
            "Y": switch("organs"),
            "Q": switch("light"),
            "Z": switch("guides"),
            "V": self.show_next_preset,
        }

    def set_menu(self, menu: QMenu) -> None:
        """Offer a menu in the corner, and at a right click."""
        self._button.setMenu(menu)
        self._button.show()

    @property
    def orbit(self) -> Orbit:
        """From where one looks."""
        return self._feed.orbit

    @property
    def is_settled(self) -> bool:
        """Return whether the picture is the fine one of what there is to be seen."""
        return self._feed.is_settled

    # --- what is shown ------------------------------------------------------------------------
    def set_volume(self, volume: Volume) -> None:
        """Look at another patient; the old surfaces go."""
        corners = volume.lps_mm(np.array([(0, 0, 0), volume.size]) - 0.5)
        self._body, self._robot = _box(corners), None
        self._feed.change("surfaces", lambda stage: stage.set_surfaces(None))
        self.surfaces, self._before, self._organs = None, [], ()
        self._fit_home()
        self.set_orbit(self._home)
        self.surfaces_changed.emit()

    def set_patient(self, patient: Patient | None) -> None:
        """Take slices and volume from this patient; None forgets it."""
        self._feed.change("patient", lambda stage: stage.set_patient(patient))

    def set_placement(self, R_world_patient: FloatArray) -> None:
        """Know how the patient lies before the operator: rotation patient → world, (3, 3)."""
        self._R_world_patient = R_world_patient

    def set_sections(self, sections: tuple[Section, ...]) -> None:
        """Show slices as planes in the picture, and no others."""
        self._feed.change("sections", lambda stage: stage.set_sections(sections))

    def set_cut(self, section: Section | None) -> None:
        """Take away what lies before a section; the first time one looks at it."""
        self._feed.change("cut", lambda stage: stage.set_cut(section))
        had, self._cut = self._cut, section is not None
        if section is not None and not had:
            eye, head = self.orbit, (0.0, 0.0, 1.0)  # as the pane of that plane shows it
            facing = Orbit.towards(section.frame.normal, head, eye.focus_mm, eye.half_mm)
            self.view_from(facing.turned(*CUT_TURN_PX))

    def set_tolerances(self, radii_mm: tuple[float, ...]) -> None:
        """Show rings of these radii round the target [mm]."""
        self._feed.change("tolerances", lambda stage: stage.set_tolerances(radii_mm))

    def set_display(self, display: Display) -> None:
        """Show more or less of the patient, or on another background."""
        if display != self.display:
            self.display = display
            self._feed.change("display", lambda stage: stage.set_display(display), asked=True)
            self.update()
            self.display_changed.emit()

    @property
    def why_no_volume(self) -> str:
        """Say why the volume cannot be rendered here; empty where it can."""
        return self._feed.why_no_volume

    def show_next_preset(self) -> None:
        """Go on to the next preset of the volume rendering, after the last one to surfaces."""
        if not self.why_no_volume:
            at = PRESETS.index(self.display.volume) if self.display.volume in PRESETS else 0
            self.set_display(replace(self.display, volume=PRESETS[(at + 1) % len(PRESETS)]))

    def set_surfaces(self, surfaces: Surfaces | None) -> None:
        """Show skin, bone and organs."""
        self._feed.change("surfaces", lambda stage: stage.set_surfaces(surfaces))
        self._organs = () if surfaces is None else tuple(surfaces.organs)
        if surfaces is not None and len(surfaces.skin.points):
            self._body = _box(surfaces.skin.points.astype(np.float64))
            self._fit_home()
        self.surfaces = surfaces
        self.surfaces_changed.emit()

    def set_structures(
        self, shown: tuple[tuple[Colour, Mesh], ...], legend: tuple[Entry, ...] = ()
    ) -> None:
        """Show structures as surfaces, each in its colour, and say which is which."""
        self._feed.change("structures", lambda stage: stage.set_structures(shown))
        self.structures, self.legend = shown, legend
        self.update()
        self.surfaces_changed.emit()

    def set_entry_map(self, shown: EntryMap | None) -> None:
        """Show scored entries on the skin, or none."""
        self._feed.change("entry map", lambda stage: stage.set_entry_map(shown))

    def set_guides(self, part: str, guides: Guides | None) -> None:
        """Show what a part of the exercise asks for, or nothing of it."""
        if guides is not self.guides.get(part):
            others = {name: one for name, one in self.guides.items() if name != part}
            self.guides = others if guides is None else others | {part: guides}
            self._feed.change(f"guides of {part}", lambda stage: stage.set_guides(part, guides))
            self.update()

    def set_plan(self, draft: DraftPlan) -> None:
        """Show entry, target and path."""
        self._draft = draft
        self._feed.change("plan", lambda stage: stage.set_plan(draft))

    def set_targets(self, targets: TargetMarks | None) -> None:
        """Show the numbers of targets that are touched one after the other; None shows none."""
        if targets is not self._targets:
            self._targets = targets
            self.update()

    def look_at_targets(self) -> None:
        """Look at the targets from beside the way in, so that their depths are told apart."""
        targets = self._targets
        if targets is None:
            return
        middle = targets.points_mm.mean(axis=0)
        beside = Orbit.from_side("R", middle, 1.0).turned(*BESIDE_TURN_PX)
        fitted = beside.fitted(targets.points_mm, TARGETS_MARGIN)
        self.view_from(fitted.panned(BESIDE_LEGEND * self.width(), 0.0, self._size()))

    def set_off(self, words: str) -> None:
        """Show nothing but these words, because the exercise does not show this view; empty ends
        that.
        """
        self.off = words
        self._feed.set_paused(bool(words))
        self.update()

    def set_still(self, still: bool) -> None:
        """Leave the picture as it is, unless somebody turns it, or draw what changes again."""
        self._feed.set_still(still)

    def set_needle(self, needle: NeedleOverlay | None) -> None:
        """Show the needle."""
        self._needle = needle
        scale = self._enlargement.follow(needle.error if needle is not None else None)
        self._feed.change("needle", lambda stage: stage.set_needle(needle, scale))

    def set_ghost(self, ghost: NeedleOverlay | None) -> None:
        """Show another needle beside the own one, dashed; None shows none."""
        self._feed.change("ghost", lambda stage: stage.set_ghost(ghost))

    def set_robot(self, robot: RobotShape | None, T_patient_world: RigidTransform) -> None:
        """Show the robot, placed under the patient."""
        self._feed.change("robot", lambda stage: stage.set_robot(robot, T_patient_world))
        legend = () if robot is None else robot.legend()
        if legend != self._robot_legend:
            self._robot_legend = legend
            self.update()
        if robot is None:
            return
        self._R_world_patient = T_patient_world.rotation.T
        rods = np.array([point for rod in robot.links() for point in rod])
        points = (T_patient_world @ rods) / MILLIMETRE
        if self._robot is None or np.abs(points[:2] - self._robot[:2]).max() > STANDS_MM:
            self._robot = points
            self._fit_home()

    def set_shape(self, shape: SceneShape | None, often: bool = False) -> None:
        """Show what a feature puts into the picture, or none; `often` at the cost of fineness."""
        self._feed.change("shape", lambda stage: stage.set_shape(shape))
        if often:
            self._feed.stir()

    @property
    def body_mm(self) -> FloatArray:
        """Corners of the patient's box, shape (8, 3)."""
        return self._body

    def look_at(self, points_mm: FloatArray) -> None:
        """Look as the operator does at points (n, 3), and know the way back."""
        eye = Orbit.from_operator(self._R_world_patient, points_mm.mean(axis=0), 1.0)
        self.view_from(eye.fitted(points_mm))

    def _fit_home(self) -> None:
        """Let the home view show patient and robot whole; go there, unless one looks elsewhere."""
        was_home = self.orbit is self._home
        points = self._body if self._robot is None else np.vstack([self._body, self._robot])
        front = Orbit.from_side("A", points.mean(axis=0), 1.0).turned(*HOME_TURN_PX)
        self._home = front.fitted(points)
        if was_home:
            self.set_orbit(self._home)

    def pixels(self, points_mm: FloatArray) -> FloatArray:
        """Return where points in the patient are seen, (n, 3) -> (n, 2) [px]."""
        return self.orbit.pixels(points_mm, self._size())

    def _size(self) -> tuple[int, int]:
        return self.width(), self.height()

    def set_orbit(self, orbit: Orbit) -> None:
        """Look from somewhere else."""
        self._feed.turn(orbit)

    @property
    def is_home(self) -> bool:
        """Return whether one sees the whole patient as at first; that view goes with what there
        is.
        """
        return self.orbit is self._home

    def view_home(self) -> None:
        """Look at the whole patient as at first."""
        self.set_orbit(self._home)

    def view_from(self, orbit: Orbit) -> None:
        """Look from somewhere else, and know the way back."""
        self._keep_orbit()
        self.set_orbit(orbit)

    def _keep_orbit(self) -> None:
        self._before = [*self._before, self.orbit][-MOST_BACK:]

    def view_back(self) -> None:
        """Look from where one looked before."""
        if self._before:
            self.set_orbit(self._before.pop())

    def view_along_needle(self) -> None:
        """Look from the hub along the needle, or along the path where there is no needle."""
        needle, entry, target = self._needle, self._draft.entry_mm, self._draft.target_mm
        if needle is not None and needle.valid:
            tip, way = needle.tip_mm, needle.tip_direction
        elif entry is not None and target is not None:
            tip, way = np.asarray(target), np.subtract(target, entry)
        else:
            return
        if np.linalg.norm(way) > 0.0:
            self.view_from(Orbit.towards(way, (0.0, 0.0, 1.0), tip, NEEDLE_HALF_MM))

    def view_as_operator(self) -> None:
        """Look at the patient as the operator does who stands behind the robot."""
        middle = self._body.mean(axis=0)
        eye = Orbit.from_operator(self._R_world_patient, middle, 1.0)
        self.view_from(eye.fitted(self._body))

    def set_note(self, note: str) -> None:
        """Write a line at the bottom, such as the progress of the surfaces."""
        self.note = note
        self.update()

    def picture(self) -> QImage:
        """Return the newest picture."""
        return self._feed.image

    def close_renderer(self) -> None:
        """Stop looking and stop the thread; idempotent."""
        self._feed.close()

    # --- events -------------------------------------------------------------------------------
    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the newest picture, stretched while a better one is on its way."""
        painter = QPainter(self)
        display = self.display
        painter.fillRect(self.rect(), QColor(display.background))
        if self.off:
            painter.setPen(QColor(theme.IMAGE_DIM))
            flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
            painter.drawText(self.rect().adjusted(8, 8, -8, -8), flags, self.off)
            return
        if not self._feed.image.isNull():
            painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform)
            painter.drawImage(self.rect(), self._feed.image)
        if self._targets is not None:
            places = self.orbit.pixels(self._targets.points_mm, self._size())
            draw_targets(painter, places, self._targets, display)
        for paint in self.overlays:
            paint(painter, self)
        draw_compass(painter, self.orbit, QPointF(50.0, self.height() - 50.0), display)
        error = self._feed.error and tr("3D view off: {why}", why=self._feed.error)
        scale, note = self._enlargement.scale, error or self.note
        asked = self.guides.values() if display.guides else ()
        guides = (entry for one in asked for entry in one.legend)
        legend = (*self._robot_legend, *guides, *self.legend, *self._organ_legend())
        if self.width() < LEGEND_FROM_PX * theme.scale():  # it would lie on the body
            legend, scale = (), 0.0
        button = self._button.geometry()
        draw_words(painter, self.rect(), display, scale, legend, note, button)

    def _organ_legend(self) -> tuple[Entry, ...]:
        if not self.display.organs or self.display.volume:
            return ()
        colours = ((name, QColor(ORGAN_COLOURS[name])) for name in self._organs)
        return tuple(((c.red(), c.green(), c.blue()), organ_title(name)) for name, c in colours)

    def showEvent(self, event: QShowEvent) -> None:
        """Look for pictures, which nobody made while it was hidden."""
        super().showEvent(event)
        self._feed.look()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Ask for a picture of the new size."""
        self._button.move(self.width() - self._button.sizeHint().width() - 6, 6)
        self._feed.refresh()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Begin to turn, pan or zoom."""
        self._pressed = self._last = event.position()
        self._keep_orbit()

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Left turns, middle pans, right zooms."""
        step = event.position() - self._last
        self._last = event.position()
        buttons = event.buttons()
        if buttons & Qt.MouseButton.LeftButton:
            self.set_orbit(self.orbit.turned(step.x(), step.y()))
        elif buttons & Qt.MouseButton.MiddleButton:
            self.set_orbit(self.orbit.panned(step.x(), step.y(), self._size()))
        elif buttons & Qt.MouseButton.RightButton:
            self.set_orbit(self.orbit.zoomed(ZOOM_PER_PX ** -step.y()))

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """Tell of a click that stayed in place."""
        moved = (event.position() - self._pressed).manhattanLength()
        if self._before and self._before[-1] is self.orbit:
            self._before.pop()  # nothing was turned
        if event.button() is Qt.MouseButton.LeftButton and moved < 4 and not self.off:
            at = event.position()
            self.clicked.emit(*self.orbit.ray(at.x(), at.y(), self._size()))

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:
        """Offer the menu at a right click, and by its key; a right drag zooms."""
        menu = self._button.menu()
        moved = (self._last - self._pressed).manhattanLength()
        if menu is not None and not self.off and moved < 4:
            menu.popup(event.globalPos())

    def mouseDoubleClickEvent(self, event: QMouseEvent) -> None:
        """Ask to be maximised, or restored."""
        self.maximise_wanted.emit()

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Zoom."""
        notches = event.angleDelta().y() / NOTCH
        self.set_orbit(self.orbit.zoomed(ZOOM_PER_NOTCH**notches))

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Do what a key of `commands` stands for; a small r resets as the space bar does."""
        names = {Qt.Key.Key_Space: "Space", Qt.Key.Key_Backspace: "Backspace"}
        name = names.get(Qt.Key(event.key()), event.text().upper())
        command = self.commands.get("Space" if event.text() == "r" else name)
        if command is None or self.off:
            super().keyPressEvent(event)
        else:
            command()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Stop the thread with the pane."""
        self.close_renderer()
        super().closeEvent(event)


def _box(points_mm: FloatArray) -> FloatArray:
    """Eight corners of the box around points, shape (8, 3)."""
    low, high = points_mm.min(axis=0), points_mm.max(axis=0)
    return np.array([np.where(bits, high, low) for bits in np.ndindex(2, 2, 2)])


class SurfaceExtraction(QObject):
    """At most one at a time: another patient ends that of the last.

    Signals:
        failed(Exception): why there are none.
    """

    failed = Signal(object)

    def __init__(self, scene: SceneView, parent: QObject) -> None:
        super().__init__(parent)
        self._scene = scene
        self._task: BackgroundTask | None = None

    @property
    def is_running(self) -> bool:
        """Return whether surfaces are still to come."""
        return self._task is not None

    def start(self, patient: Patient) -> None:
        """Extract a patient's surfaces."""
        if self._task is not None:
            self._task.drop()
        self._task = run_in_background(
            self,
            lambda progress: _surfaces(patient, progress),
            self._done,
            self._fail,
            lambda: self._done(None),
        )
        self._task.progressed.connect(
            lambda share, _: self._scene.set_note(
                tr("Surfaces {percent:.0f} %", percent=100 * share)
            )
        )

    def close(self) -> None:
        """End it; idempotent."""
        if self._task is not None:
            self._task.close()
            self._task = None

    def _done(self, surfaces: Surfaces | None) -> None:
        self._task = None
        self._scene.set_note("")
        if surfaces is not None:
            self._scene.set_surfaces(surfaces)

    def _fail(self, error: Exception) -> None:
        self._done(None)
        self.failed.emit(error)


def _surfaces(patient: Patient, progress: Progress) -> Surfaces:
    with ONE_AT_A_TIME:  # VTK and scipy: behind the window, not before it
        from app.views.scene.surfaces import extract_surfaces
    return extract_surfaces(patient.volume, patient.body, progress, patient.phantom_seed)
