"""The view `target_motion`: the target where breathing has it now, on slices and in 3D; what is
ablated there; and the grid on the skin in 3D.

Where the view is off, the snapshot that everybody gets has the target at rest (`exercise.shown`),
and with it the bull's-eye, its rings and every distance.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from PySide6.QtCore import QObject

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.imaging.skin_grid import SkinGrid
from app.session.ablation import AblationState
from app.session.ablation_shown import AblationShown
from app.session.snapshot import Snapshot
from app.session.touching import TargetMarks
from app.views.exercise.run import ExerciseRun
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.reading.workspace import WorkspacePage
from app.views.scene.guides import ABLATION, GRID, Guides, ablation_guides, grid_guides
from app.views.scene.view import SceneView
from app.views.slices.zones import ZonesLayer

DECLARATION: Final[dict[str, Any]] = {
    "view": "target_motion",
    "title": "Motion of the target",
    "reads": ("target_shift",),
}

SCENE_DEAD_BAND_MM: Final = 0.25
"""The 3D picture is made anew when the target moved more than this."""


class TargetMotion:
    """Lets target, rings and path of slices and 3D go with every snapshot."""

    def __init__(self, workspace: WorkspacePage) -> None:
        self._workspace = workspace
        self._drawn: FloatArray | None = None
        self._marks: TargetMarks | None = None

    def show(self, run: ExerciseRun, snapshot: Snapshot) -> None:
        """Draw the target of a moment, and all of them where several are to be touched."""
        marks = snapshot.target_marks if run.shown.live else None
        if marks is None or not marks.same(self._marks):
            self._mark(marks)
        if not run.shown.live or not (snapshot.p_target != run.placed.p_target).any():
            self._place(None)
            return
        self._place(run.placed.T_world_patient.inverse() @ snapshot.p_target / MILLIMETRE)

    def hide(self) -> None:
        """Let the target stand where the plan has it."""
        self._mark(None)
        self._place(None)

    def _mark(self, marks: TargetMarks | None) -> None:
        if marks is not self._marks:
            before, self._marks = self._marks, marks
            self._workspace.viewing.set_targets(marks)
            self._workspace.scene.set_targets(marks)
            if before is None:
                self._workspace.scene.look_at_targets()

    def _place(self, target_mm: FloatArray | None) -> None:
        viewing, before = self._workspace.viewing, self._drawn
        if viewing.target_now_mm is None and target_mm is not None:
            before = None  # the plan was shown anew meanwhile, with its own target
        viewing.set_target_now(target_mm)
        if target_mm is None:
            again = before is not None
        else:
            again = before is None or np.abs(target_mm - before).max() > SCENE_DEAD_BAND_MM
        if again:
            self._drawn = target_mm
            self._workspace.scene.set_plan(viewing.shown_draft)


class AblationView:
    """Draws zones, margins and electrodes left in place over a workspace's panes, and in 3D."""

    def __init__(self, workspace: WorkspacePage) -> None:
        self._workspace = workspace
        self._layers: dict[object, ZonesLayer] = {}
        self._drawn: AblationState | None = None

    def show(self, snapshot: Snapshot) -> None:
        """Draw the state of a snapshot; nothing where the exercise ablates nothing."""
        state = None if snapshot.procedure is None else snapshot.procedure.ablation
        if state is not self._drawn:
            self._drawn = state
            shown = None if state is None else AblationShown.of_state(state)
            for pane in self._workspace.slices:
                if pane not in self._layers:
                    self._layers[pane] = ZonesLayer(pane.canvas)
                self._layers[pane].set_shown(shown)
            guides = None if shown is None else ablation_guides(shown)
            self._workspace.scene.set_guides(ABLATION, guides)

    def hide(self) -> None:
        """Show nothing."""
        self._drawn = None
        self._workspace.scene.set_guides(ABLATION, None)
        for layer in self._layers.values():
            layer.set_shown(None)


class GridScene(QObject):
    """Keeps the 3D view's grid and laser as the slices have them; one search at a time."""

    def __init__(self, scene: SceneView, parent: QObject) -> None:
        super().__init__(parent)
        self._scene = scene
        self._wanted: tuple[SkinGrid, float | None] | None = None
        self._task: BackgroundTask | None = None

    def show(self, grid: SkinGrid | None, table_mm: float | None) -> None:
        """Show a grid, and the laser at a table position [mm]; None shows nothing."""
        wanted = None if grid is None else (grid, table_mm)
        if wanted == self._wanted:
            return
        had, self._wanted = self._wanted, wanted
        if had is None or wanted is None or had[0] is not wanted[0]:
            self.close()  # of another patient, or another grid
            self._scene.set_guides(GRID, None)
        self._look()

    def close(self) -> None:
        """End a search; idempotent."""
        if self._task is not None:
            self._task.close()
            self._task = None

    def _look(self) -> None:
        """Look for the newest that is wanted, once the last search has ended."""
        wanted = self._wanted
        if wanted is None or self._task is not None:
            return

        def done(guides: Guides | None) -> None:
            self._task = None
            if wanted is self._wanted:
                self._scene.set_guides(GRID, guides)
            else:
                self._look()

        self._task = run_in_background(
            self, lambda _: grid_guides(*wanted), done, lambda _: done(None), lambda: done(None)
        )
