"""The view `target_motion`: the target where breathing has it now, on slices and in 3D; and what is
ablated there.

Where the view is off, the snapshot that everybody gets has the target at rest (`exercise.shown`),
and with it the bull's-eye, its rings and every distance.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.session.ablation import AblationState
from app.session.ablation_shown import AblationShown
from app.session.snapshot import Snapshot
from app.session.touching import TargetMarks
from app.views.exercise.run import ExerciseRun
from app.views.reading.workspace import WorkspacePage
from app.views.scene.guides import ABLATION, ablation_guides
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
