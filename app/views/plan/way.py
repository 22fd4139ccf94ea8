"""What lies on the planned way, looked up beside the window as soon as there is a plan.

The field round the target is the one that the map of entries is made with: whoever makes both waits
once. The plan that an exercise gives is not looked up: its author has checked it, and the time is
the attempt's.
"""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal

from app.core.loading import turn
from app.core.progress import Progress
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.text import tr, translated
from app.views.plan.verdict import PlannedWay, WayState

if TYPE_CHECKING:
    from app.imaging.field import TissueField
    from app.imaging.structures.structure import Structure
    from app.views.shell.feature import Context

_MODULE: Final = "app.imaging.field.making"

AFTER_MS: Final = 300
"""So long a target stays where it is before the tissue round it is looked up."""

SILENT_S: Final = 2.0
"""A look-up that lasts longer says what it is at."""

ABOUT_TARGET_MM: Final = 125.0
"""No path that is scored is longer."""


class WayWatch(QObject):
    """Follows plan, patient and structures.

    Signals:
        changed(): `way` is another.

    Attributes:
        way: as far as it is known now.
    """

    changed = Signal()

    def __init__(self, context: Context, parent: QObject) -> None:
        super().__init__(parent)
        self._conductor, self._editor = context.conductor, context.editors.plan
        self._book = context.editors.structures
        self.way = PlannedWay()
        self._task: BackgroundTask | None = None
        self._tissues: TissueField | None = None
        self._reason, self._begun = "", 0.0
        self._structures: list[Structure] = []
        self._place: tuple[Any, ...] = ()  # what field, or reason, and task are of
        self._timer = QTimer(self, singleShot=True, interval=AFTER_MS)
        self._timer.timeout.connect(self._begin)
        self._editor.changed.connect(self.look)
        for signal in (self._book.changed, self._book.measured):
            signal.connect(self.look)
        self._conductor.patient_changed.connect(self.look)
        self._conductor.exercise_taken.connect(lambda _: self.look())

    def look(self) -> None:
        """Say what is known now, and look up what is not."""
        place = self._wanted()
        if place != self._place:
            self._drop()
            self._place, self._tissues, self._reason = place, None, ""
        draft = self._editor.edit.draft
        if not place or draft.entry_mm is None or draft.target_mm is None:
            self._timer.stop()
            self._tell(PlannedWay())
        elif self._reason:
            self._tell(PlannedWay(WayState.UNKNOWN, reason=self._reason))
        elif self._tissues is not None:
            from app.planning.on_the_way import hindrances  # loaded with the field

            met = hindrances(self._tissues, draft.entry_mm, draft.target_mm)
            self._tell(PlannedWay(WayState.KNOWN, met))
        else:
            if self.way.state is not WayState.LOOKING:
                self._tell(PlannedWay(WayState.LOOKING))
            if self._task is None:
                self._timer.start()

    def close(self) -> None:
        """End what runs; idempotent."""
        self._timer.stop()
        if self._task is not None:
            self._task.close()
            self._task = None

    def _wanted(self) -> tuple[Any, ...]:
        """Return what the field depends on; empty where nobody asks for it."""
        patient, editor = self._conductor.patient, self._editor
        reached = editor.verdict.reach
        if patient is None or reached is None or not reached.reachable or editor.locked:
            return ()
        exercise = self._conductor.exercise
        untouched = not editor.dirty and editor.path is None
        given = exercise is not None and not exercise.is_own_plan
        if given and untouched and self._conductor.fits(patient):
            return ()
        self._structures = [structure for structure, _ in self._book.fields]  # keeps their ids
        structures = tuple(map(id, self._structures))
        return editor.edit.draft.target_mm, id(patient.volume), structures

    def _begin(self) -> None:
        patient, target = self._conductor.patient, self._editor.edit.draft.target_mm
        place = self._place
        if patient is None or target is None or not place or self._task is not None:
            return
        if patient.volume.unit != "HU":
            self._fail(tr("the CT has no Hounsfield values"))
            return
        structures = self._structures

        def work(progress: Progress) -> TissueField:
            with turn(progress, _MODULE):  # scipy: behind the window
                from app.imaging.field.making import field_of
            return field_of(
                patient.volume,
                structures,
                np.array(target),
                ABOUT_TARGET_MM,
                progress=progress,
                body=patient.body,
            )

        def done(tissues: TissueField) -> None:
            self._task, self._tissues = None, tissues
            self.look()

        def failed(error: Exception) -> None:
            self._task = None
            self._fail(translated(error))

        def stopped() -> None:
            self._task = None
            self.look()  # nobody has the answer: it is asked for again

        self._begun = monotonic()
        self._task = run_in_background(self, work, done, failed, stopped)
        self._task.progressed.connect(self._tell_progress)

    def _tell_progress(self, _: float, words: str) -> None:
        """Say what a look-up that lasts does, or waits for."""
        lasts = monotonic() - self._begun >= SILENT_S
        if lasts and self.way.state is WayState.LOOKING:
            self._tell(PlannedWay(WayState.LOOKING, reason=words))

    def _fail(self, reason: str) -> None:
        self._reason = reason
        self.look()

    def _drop(self) -> None:
        if self._task is not None:
            self._task.drop()
            self._task = None

    def _tell(self, way: PlannedWay) -> None:
        if way != self.way:
            self.way = way
            self.changed.emit()
