"""Keeps a trainer running for the exercise and plan on screen; building one never blocks."""

from __future__ import annotations

import threading
from collections.abc import Callable

from PySide6.QtCore import QObject, Signal

from app.core.errors import AcusError
from app.core.messages import joined
from app.core.progress import Progress
from app.exercises.schema import Exercise
from app.planning.placement import PlacedPlan
from app.session.abort_reasons import WINDOW_CLOSED
from app.views.exercise.run import ExerciseRun
from app.views.kit.background import BackgroundTask, Indicator, run_in_background
from app.views.kit.text import tr
from app.views.shell.services import OpenRun, RunSetup, Services


class Runs(QObject):
    """At most one open run; another plan moves it, another exercise or robot changes it.

    Signals:
        ready(ExerciseRun): a trainer runs with this plan.
        moved(ExerciseRun): the same trainer took another plan.
        gone(): there is no trainer now.
        failed(object): the error that kept one from running.
        starting(bool): one is being built, or no more.
        unusable(object): a sentence: which of the user's own files cannot be used, and why.
        prepared(): what an exercise needs is loaded, or cannot be.

    Attributes:
        is_prepared: whether it is.
    """

    ready = Signal(object)
    moved = Signal(object)
    gone = Signal()
    failed = Signal(object)
    starting = Signal(bool)
    unusable = Signal(object)
    prepared = Signal()

    def __init__(self, services: Services, indicator: Indicator, parent: QObject) -> None:
        super().__init__(parent)
        self._services, self._indicator = services, indicator
        self.is_prepared = False
        self._open: OpenRun | None = None
        self._setup: RunSetup | None = None
        self._task: BackgroundTask | None = None
        self._preparation: BackgroundTask | None = None
        self._wanted: RunSetup | None = None
        self._closing: threading.Thread | None = None

    @property
    def run(self) -> ExerciseRun | None:
        """The run that is open."""
        return None if self._open is None else self._open.run

    @property
    def exercise(self) -> Exercise | None:
        """The exercise of the open run, with the models by which its effects are computed now."""
        return None if self._open is None else self._open.exercise

    def compute_by(self, effect: str, model: str) -> Exercise | None:
        """Compute an effect of the open run by another of its models from the next tick on.

        Returns:
            The exercise as it is computed now; None without a run.

        Raises:
            AcusError: if the exercise keeps its models, or there is no such effect or model.
        """
        return None if self._open is None else self._open.compute_by(effect, model)

    def prepare(self) -> None:
        """Load beside the window what an exercise needs, so that the first one begins soon."""
        if self._preparation is None:
            self._preparation = run_in_background(
                self, self._services.prepare, self._loaded, self._prepared
            )

    def _loaded(self, unusable: tuple[str, ...]) -> None:
        self._prepared(None)
        if unusable:
            self.unusable.emit(joined("; ", unusable))

    def _prepared(self, error: Exception | None) -> None:
        self._preparation, self.is_prepared = None, True
        if error is not None:
            self.failed.emit(error)
        self.prepared.emit()

    def want(self, setup: RunSetup | None) -> None:
        """Have a trainer for this setup; None wants none."""
        self._wanted = setup
        if self._task is not None:
            return  # `_built` asks again
        if setup is None:
            self._drop()
        elif self._open is not None and self._setup is not None and setup.same_run(self._setup):
            self._move(setup.placed)
        else:
            self._drop()  # whoever hears of it may have asked anew, and been heard
            if self._task is None and self._wanted is setup:
                self._build(setup)

    def abort(self, reason: str) -> None:
        """Want no trainer; an attempt that runs ends at once without force, saved with `reason`.

        The reason stands in the record: it is English, whatever the window's language. Scoring and
        writing go on beside the window.
        """
        self._wanted = None
        if self._task is None:
            self._drop(reason)

    def closed(self) -> Callable[[], None]:
        """Return what waits until the last run has let go of its robot; for other threads."""
        closing = self._closing
        return closing.join if closing is not None else lambda: None

    def close(self) -> None:
        """End the run and wait for it; for the end of the window; idempotent."""
        self._wanted = None
        if self._preparation is not None:
            self._preparation.close()
            self._preparation = None
        if self._task is not None:
            self._task.close()
            self._task = None
        opened, self._open = self._open, None
        if opened is not None:
            opened.run.trainer.abort(WINDOW_CLOSED)  # what runs is saved
            opened.close()
        self.closed()()

    def _build(self, setup: RunSetup) -> None:
        self._setup = setup
        self.starting.emit(True)
        closed, services = self.closed(), self._services

        def operation(progress: Progress) -> OpenRun:
            closed()  # two runs must not want one robot
            return services.open_run(setup, progress)

        self._task = run_in_background(
            self,
            operation,
            lambda opened: self._built(setup, opened),
            self._not_built,
            lambda: self._not_built(None),
            title=tr("Starting robot and cameras"),
            indicator=self._indicator,
        )

    def _built(self, setup: RunSetup, opened: OpenRun) -> None:
        self._task, self._open = None, opened
        self.starting.emit(False)
        if self._wanted is None or not self._wanted.same_run(setup):
            self.want(self._wanted)
            return
        self.ready.emit(opened.run)
        self._move(self._wanted.placed)

    def _not_built(self, error: Exception | None) -> None:
        self._task, self._setup = None, None
        self.starting.emit(False)
        if error is not None:
            self.failed.emit(error)

    def _move(self, placed: PlacedPlan) -> None:
        if self._open is None or _same(self._open.run.placed, placed):
            return
        try:
            self.moved.emit(self._open.place(placed))
        except AcusError as error:
            self.failed.emit(error)

    def _drop(self, reason: str = "") -> None:
        opened, self._open = self._open, None
        if opened is None:
            return
        self._setup = None  # with its CT
        if reason:
            opened.run.trainer.disarm()

        def close() -> None:
            if reason:
                opened.run.trainer.abort(reason)
            opened.close()

        self.gone.emit()
        self._closing = threading.Thread(target=close, name="acus-run-close", daemon=True)
        self._closing.start()


def _same(placed: PlacedPlan, other: PlacedPlan) -> bool:
    return placed.plan == other.plan and placed.placement == other.placement
