"""The window as `reading_pictures` takes it: one patient, an attempt that stands still."""

from __future__ import annotations

import sys
from pathlib import Path

from PySide6.QtCore import QRect
from PySide6.QtWidgets import QWidget

from app.core import paths
from app.exercises.library import load_exercise
from app.exercises.parts import Ct, PlanPoints
from app.exercises.schema import Exercise
from app.imaging.privacy.key import BYTES, key_path
from app.views.exercise.feature import ExerciseFeature
from app.views.shell.window import MainWindow
from app.views.slices.camera import SliceCamera
from tools.palette import small_png
from tools.robot_pictures import pause, wait
from tools.still_run import StillDesktop, StillTrainer

SIZE = (1280, 760)
DEPTH_SHARE = 0.6
"""How far the needle is in, of the way to the target."""

LIVER = PlanPoints(
    entry_mm=(-102.8, 79.0, -628.8), target_mm=(-75.0, 128.0, -630.0), name="liver-biopsy"
)
"""Between two ribs into the liver of the chest CT."""


class Studio:
    """The window with what stands in it.

    Args:
        folder: where the pictures go.
        sessions: where the records go.
        chest: folder of the chest CT; None for the phantom in its place.
    """

    def __init__(self, folder: Path, sessions: Path, chest: Path | None) -> None:
        _fix_key()
        self.folder, self.chest = folder, chest
        self.window = MainWindow(StillDesktop(sessions=sessions))
        self.window.resize(*SIZE)
        self.window.show()

    def exercise(self, identifier: str) -> Exercise:
        """Return an exercise, moved to the chest where there is one."""
        exercise = load_exercise(identifier)
        if self.chest is None:
            return exercise
        return exercise.model_copy(update={"ct": Ct(folder=self.chest), "plan": LIVER})

    def begin(self, identifier: str) -> None:
        """Open an exercise with its patient, and wait until all of it is there."""
        window, conductor = self.window, self.window.conductor
        window.feature(ExerciseFeature).exercises[identifier] = self.exercise(identifier)
        window.begin_exercise(identifier)
        wait(lambda: conductor.exercise is not None and conductor.exercise.id == identifier)
        pause(0.5)
        wait(lambda: conductor.settled)
        pause(0.5)  # the debrief of an attempt before, if any
        window.show_workspace()

    @property
    def trainer(self) -> StillTrainer:
        """The attempt's trainer."""
        run = self.window.conductor.controller.run
        if run is None or not isinstance(run.trainer, StillTrainer):
            raise RuntimeError("no attempt stands still here")
        return run.trainer

    def insert(self, share: float = DEPTH_SHARE) -> None:
        """Begin an attempt and stop it on the way to the target."""
        self.window.workspace.exercise_panel.start_requested.emit("demo")
        self.push(share)

    def push(self, share: float) -> None:
        """Go on until the tip has come this share of the way."""
        self.trainer.go_on(
            lambda now: (
                now.pose.measured
                and now.pose.depth >= share * (now.pose.depth + now.offset.remaining)
            )
        )
        self.settle()

    def settle(self) -> None:
        """Wait for every picture that is still to come."""
        workspace = self.window.workspace
        pause(0.5)
        panes = (*workspace.panes, *workspace.needle_panes)
        wait(lambda: not any(pane.canvas.feed.is_waiting for pane in panes if pane.isVisible()))
        wait(lambda: workspace.scene.is_settled or not workspace.scene.isVisible())
        pause(0.1)

    def zoom(self, scale: float) -> None:
        """Enlarge the three slices about the crosshair [px/mm]."""
        viewing = self.window.workspace.viewing
        for pane in self.window.workspace.panes:
            plane = pane.canvas.plane
            if plane is not None:
                at = plane.point(viewing.cursor_mm, pane.canvas.index)
                pane.canvas.set_camera(SliceCamera(at.x, at.y, scale))

    def keep(self, name: str, widget: QWidget | None = None) -> None:
        """Write a picture of the panes, or of another widget."""
        self.settle()
        small_png((widget or self.window.workspace.grid).grab(), self.folder / f"{name}.png")

    def keep_window(self, name: str) -> None:
        """Write a picture of the window without its status strip, which says that time is still."""
        self.settle()
        window = self.window
        height = window.height() - window.workspace.status.height()
        small_png(window.grab(QRect(0, 0, window.width(), height)), self.folder / f"{name}.png")


def chest_of(folder: Path) -> Path | None:
    """Return the chest CT's folder if it is there; say so if not."""
    if folder.is_dir():
        return folder
    print(f"no chest CT in {folder}: the phantom stands in for it", file=sys.stderr)
    return None


def _fix_key() -> None:
    """Pseudonyms come from the key of an installation: in pictures they are always the same."""
    paths.settings().mkdir(parents=True, exist_ok=True)
    if not key_path().exists():
        key_path().write_bytes(bytes(range(BYTES)))
