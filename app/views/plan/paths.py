"""Planning help in the window: scores paths beside it, shows them, takes the one chosen.

Nothing is chosen by the program: the plan changes when the user takes a path, as one step to undo.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

import numpy as np
from PySide6.QtCore import SignalInstance

from app.core.loading import ONE_AT_A_TIME
from app.core.progress import Progress
from app.planning.clearance import Field
from app.planning.draft import DraftPlan
from app.planning.limits import ReachLimits
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.text import tr
from app.views.plan.entry_map import EntryMap, EntryMapLayer
from app.views.plan.paths_panel import PathsPanel
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.planning.paths import PathScores


class PathsFeature(Feature):
    """Connects the panel below the plan with target, structures, panes and 3D view."""

    topic: ClassVar[str] = "paths"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._conductor, self._views = context.conductor, context.views
        self._editor, self._book = context.editors.plan, context.editors.structures
        self.panel = PathsPanel()
        context.shell.add_panel(self.panel, below=tr("Plan"))
        self.scores: PathScores | None = None
        self._task: BackgroundTask | None = None
        self._stands_on: tuple[object, ...] = ()
        self._layers = []
        for pane in self._views.slices:
            layer = EntryMapLayer(pane.canvas.drawing)
            pane.canvas.add_layer(layer)
            self._layers.append(layer)
        self.panel.map_wanted.connect(self.make)
        self.panel.clear_wanted.connect(self.clear)
        self.panel.shown.connect(self._look_at)
        self.panel.taken.connect(self._take)
        self._editor.changed.connect(self._check)
        self._conductor.patient_changed.connect(self.clear)
        self._check()

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._editor.changed,)

    def forget(self) -> None:
        """Take the map of the patient who leaves away."""
        self.clear()

    def suit_room(self) -> None:
        """Take another size of text."""
        self.panel.suit_text()

    def _standing(self) -> tuple[object, ...]:
        """Return what the scores depend on."""
        edit = self._editor.edit
        patient = self._conductor.patient
        return (edit.draft.target_mm, edit.placement, None if patient is None else patient.volume)

    def _check(self) -> None:
        """Take a map away that belongs to another target or position."""
        if self._stands_on and self._stands_on != self._standing():
            self.clear()
        ready = self._editor.edit.draft.target_mm is not None and not self._editor.locked
        self.panel.make.setEnabled(ready and self._conductor.profile is not None)
        self.panel.make.setToolTip("" if ready else tr("Place the target first (key T)"))

    def make(self) -> None:
        """Score the paths to the target, beside the window."""
        patient, profile = self._conductor.patient, self._conductor.profile
        edit, fields = self._editor.edit, self._book.fields
        if patient is None or profile is None or edit.draft.target_mm is None:
            return
        if self._task is not None:
            self._task.close(timeout=0.0)
        standing = self._standing()
        limits, target = ReachLimits.of(profile), np.array(edit.draft.target_mm)

        def work(progress: Progress) -> PathScores:
            with ONE_AT_A_TIME:  # scipy: behind the window
                from app.imaging.skin import skin_points
                from app.planning.paths import score_paths
            skin = skin_points(patient.body, progress=progress.part(0.0, 0.3))
            return score_paths(target, skin, patient.body, _warning(fields), edit.placement,
                               limits, progress=progress.part(0.3, 1.0))  # fmt: skip

        self.panel.make.setEnabled(False)
        self._task = run_in_background(
            self, work, lambda scores: self._show(scores, standing), self._failed, self._ended,
            title=tr("Scoring paths"), indicator=self.context.shell.progress,
        )  # fmt: skip

    def _show(self, scores: PathScores, standing: tuple[object, ...]) -> None:
        self._ended()
        if standing != self._standing():
            return
        from app.planning.paths import best

        self.scores, self._stands_on = scores, standing
        self.panel.show_scores(scores, best(scores))
        self._draw(EntryMap.of(scores))

    def clear(self) -> None:
        """Take map and table away."""
        self.scores, self._stands_on = None, ()
        self.panel.show_scores(None, ())
        self._draw(None)

    def _draw(self, shown: EntryMap | None) -> None:
        for layer in self._layers:
            layer.set_map(shown)
        self._views.refresh()
        self._views.scene.set_entry_map(shown)

    def _failed(self, error: Exception) -> None:
        self._ended()
        self.failed.emit(error)

    def _ended(self) -> None:
        self._task = None
        self._check()

    def _look_at(self, number: int) -> None:
        if self.scores is not None:
            self._views.viewing.set_cursor(self.scores.entries_mm[number])

    def _take(self, number: int) -> None:
        if self.scores is not None:
            x, y, z = self.scores.entries_mm[number].tolist()
            draft: DraftPlan = self._editor.edit.draft.with_entry((x, y, z))
            self._editor.take(draft, self._editor.edit.placement)

    def close(self) -> None:
        """End what runs; idempotent."""
        if self._task is not None:
            self._task.close()
            self._task = None


def _warning(fields: tuple[Field, ...]) -> list[Field]:
    return [one for one in fields if one[0].warn_mm > 0.0]
