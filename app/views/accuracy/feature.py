"""What accuracy costs: the panel of the scene that runs, and the page of all choices."""

from __future__ import annotations

from collections import deque
from functools import partial
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import TYPE_CHECKING, ClassVar

from PySide6.QtCore import QTimer, Signal, SignalInstance
from PySide6.QtWidgets import QFileDialog

from app.core import paths
from app.core.errors import AcusError
from app.core.progress import Progress
from app.exercises.locks import Lock
from app.exercises.schema import Exercise
from app.session.machine import RUNNING
from app.session.snapshot import Snapshot
from app.views.accuracy.budget import SceneCost
from app.views.accuracy.panel import EffectsPanel
from app.views.kit.background import BackgroundTask, run_in_background
from app.views.kit.menu_entries import add_entries
from app.views.kit.roles import TECHNICIANS, Role
from app.views.kit.text import tr
from app.views.reading.lock_words import why_locked
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.studies.findings import Findings
    from app.studies.kept import Kept
    from app.studies.sweep_table import SweepTable
    from app.views.accuracy.page import AccuracyPage

LOOK_AGAIN_MS = 5_000
"""So often a sweep that grows is looked at [ms]."""

_PARTS = ".parts"
"""Ends the name of the folder of a sweep's parts."""

REPEATS = 5
"""Timings per way and setting on this computer."""


class AccuracyFeature(Feature):
    """Panel of effects, page of studies.

    Signals:
        measured(): what was being measured has ended, or was cancelled.

    Attributes:
        panel: effects of the scene that runs.
        page: studies; None until it is shown.
    """

    topic: ClassVar[str] = "accuracy"
    place: ClassVar[int] = 160
    roles: ClassVar[frozenset[Role]] = TECHNICIANS
    help: ClassVar[str] = "user-guide.md#what-accuracy-costs"
    measured = Signal()

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._runs, self._shell = context.runs, context.shell
        self.panel = EffectsPanel()
        self.page: AccuracyPage | None = None
        self._explained: BackgroundTask | None = None
        self._measured: BackgroundTask | None = None
        self._scene: Exercise | None = None
        self._sweep: Path | None = None
        self._frames: deque[float] = deque(maxlen=60)
        context.shell.add_panel(self.panel, tr("Effects"), scrolls=True)
        self.panel.chosen.connect(self.compute_by)
        self.panel.page_wanted.connect(self.open_page)
        self._runs.ready.connect(lambda _: self._explain())
        self._runs.gone.connect(self.panel.clear)
        context.conductor.controller.snapshot_taken.connect(self._show)
        (self.action,) = add_entries(
            context.shell.menu(tr("&Checks")), [(tr("Cost of accuracy…"), "", self.open_page)]
        )

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self.noted, self.measured, self.context.conductor.controller.finished)

    def close(self) -> None:
        """End what runs beside the window; idempotent."""
        for task in (self._explained, self._measured):
            if task is not None and task.is_running():
                task.close()

    # --- the scene that runs --------------------------------------------------------------------
    def compute_by(self, effect: str, model: str) -> None:
        """Compute an effect by another of its models from the next tick on."""
        try:
            exercise = self._runs.compute_by(effect, model)
        except AcusError as error:
            self.panel.go_back()
            self.failed.emit(error)
            return
        if exercise is not None:
            self.noted.emit(
                tr("{effect} is computed by {model}", effect=effect.replace("_", " "), model=model)
            )
            self._explain()

    def _explain(self) -> None:
        exercise = self._runs.exercise
        if exercise is None:
            return
        if self._explained is not None and self._explained.is_running():
            self._explained.drop()
        self._scene = exercise
        services = self.context.services
        self._explained = run_in_background(
            self,
            lambda _: SceneCost.of(services.explain_exercise(exercise)),
            self._explained_scene,
            self.failed.emit,
        )

    def _explained_scene(self, scene: SceneCost) -> None:
        if self._scene is not None:
            self.panel.show_scene(scene, why_locked(self._scene, Lock.MODELS))

    def _show(self, snapshot: Snapshot) -> None:
        self.panel.show_snapshot(snapshot, median(self._frames) if self._frames else 0.0)
        if self.panel.isVisible():
            # A timer of no time fires when all that was asked to be painted is painted.
            QTimer.singleShot(0, partial(self._painted, perf_counter()))

    def _painted(self, began: float) -> None:
        self._frames.append(perf_counter() - began)

    # --- all choices ----------------------------------------------------------------------------
    def open_page(self) -> None:
        """Show the page."""
        page = self.page
        if page is None:
            from app.views.accuracy.page import AccuracyPage

            page = self.page = AccuracyPage()
            self._shell.add_page(page, self.roles)
            page.closed.connect(self.context.leave_page)
            page.wanted.connect(self.show_study)
            page.measure_wanted.connect(self.measure)
            page.source_wanted.connect(lambda here: self.show_study(page.name, here))
            page.hard.wanted.connect(self.try_hard_cases)
            page.sweeps.wanted.connect(self.choose_sweep)
            page.set_studies(_titles())
        self._shell.show_page(page)

    def show_study(self, name: str, here: bool | None = None) -> None:
        """Show a study: this computer's figures where there are some, else those kept."""
        if self.page is None:
            return
        own = _own(name)
        here = own.is_file() if here is None else here
        if here and not own.is_file():
            self.measure(name)
            return
        try:
            self.page.show_study(_read(name, here), here)
        except AcusError as error:
            self.failed.emit(error)

    def choose_sweep(self) -> None:
        """Ask which sweep to show."""
        parent = self._shell.dialog_parent
        kind = tr("Table of a sweep (*.parquet)")
        dialog = QFileDialog(parent, tr("Open a sweep"), str(Path.cwd()), kind)
        # a sweep that works has no table yet: its name may be typed
        dialog.setFileMode(QFileDialog.FileMode.AnyFile)
        dialog.setLabelText(QFileDialog.DialogLabel.Accept, tr("Open"))
        dialog.fileSelected.connect(lambda name: self.show_sweep(Path(name)))
        dialog.finished.connect(dialog.deleteLater)
        dialog.open()

    def show_sweep(self, path: Path) -> None:
        """Show a sweep's table, or what there is of it by now, which is looked at again."""
        if path.parent.name.endswith(_PARTS):  # one of its parts was chosen
            path = path.parent
        if path.name.endswith(_PARTS):
            path = path.with_name(path.name.removesuffix(_PARTS))

        def read(_: Progress) -> SweepTable:
            from app.studies.sweep_table import read_sweep

            return read_sweep(path)

        def show(sweep: SweepTable) -> None:
            if self.page is None or path != self._sweep:
                return
            self.page.sweeps.show_sweep(sweep)
            if not sweep.finished:
                QTimer.singleShot(LOOK_AGAIN_MS, self, again)

        def again() -> None:
            if path == self._sweep and self.page is not None and self.page.isVisible():
                run_in_background(self, read, show, self.failed.emit)

        self._sweep = path
        run_in_background(self, read, show, self.failed.emit)

    def try_hard_cases(self) -> None:
        """Try every hard case on this computer, beside the window."""
        page = self.page
        if page is None or not self._may_work():
            return
        self._measured = run_in_background(
            self,
            _try_hard_cases,
            page.hard.show_findings,
            self.failed.emit,
            title=tr("Trying hard cases"),
            indicator=self._shell.progress,
        )
        self._follow_work(self._measured, page)

    def measure(self, name: str) -> None:
        """Measure a study on this computer, beside the window; not while an attempt runs."""
        if not self._may_work():
            return
        self._measured = run_in_background(
            self,
            lambda progress: _measure(name, progress),
            lambda _: self.show_study(name, True),
            self.failed.emit,
            lambda: self.show_study(name, False),
            title=tr("Measuring on this computer"),
            indicator=self._shell.progress,
        )
        if self.page is not None:
            self._follow_work(self._measured, self.page)

    def _follow_work(self, task: BackgroundTask, page: AccuracyPage) -> None:
        """Let nothing else be measured until this has ended."""
        page.set_measuring(True)
        task.finished.connect(lambda: page.set_measuring(False))
        task.finished.connect(self.measured)

    def _may_work(self) -> bool:
        """Return whether a measurement may begin now; says why not."""
        run = self._runs.run
        if run is not None and run.trainer.snapshot().state in RUNNING:
            self.failed.emit(tr("End the attempt first: measuring takes processor time from it"))
            return False
        if self._measured is not None and self._measured.is_running():
            self.failed.emit(
                tr("Something is being measured already: wait, or cancel it at the top")
            )
            return False
        return True


def _titles() -> dict[str, str]:
    from app.studies.kept import kept, kept_names

    return {name: kept(name).result.study.title for name in kept_names()}


def _own(name: str) -> Path:
    return paths.cache() / "studies" / f"{name}.json"


def _read(name: str, here: bool) -> Kept:
    from app.studies.kept import kept, read

    return read(_own(name)) if here else kept(name)


def _try_hard_cases(progress: Progress) -> Findings:
    from app.studies.runner import examine

    return examine("hard", progress).findings


def _measure(name: str, progress: Progress) -> None:
    from app.studies.kept import keep
    from app.studies.runner import run

    path = _own(name)
    path.parent.mkdir(parents=True, exist_ok=True)
    keep(run(name, REPEATS, progress), REPEATS, path)
