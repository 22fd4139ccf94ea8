"""The commissioning wizard: step by step from the connection to the summary.

Steps a commissioning routine beside the window's other work, and keeps what it finds.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QWidget

from app.core.errors import AcusError
from app.device.commissioning.records import settle
from app.views.kit.text import tr, translated
from app.views.kit.verdict import Verdict
from app.views.kit.wizard import Wizard
from app.views.robot.wizard_pages import (
    ConnectionPage,
    RoutinePage,
    SummaryPage,
    state_of,
    step_words,
    steps_of,
)

if TYPE_CHECKING:
    from app.device.commissioning.bench import Bench
    from app.device.commissioning.results import RoutineName, RoutineReport
    from app.device.commissioning.routine import Routine


PERIOD_MS: Final = 10


class Runner(QObject):
    """At most one routine at a time; however it ends, the forces are off.

    Signals:
        reported(RoutineReport): what the routine says, at every change.
        kept(RoutineName): a routine ended well and its result is in the record.
        failed(str): why it ended without a result, or why its result could not be kept.
    """

    reported = Signal(object)
    kept = Signal(object)
    failed = Signal(str)

    def __init__(self, bench: Bench, parent: QObject) -> None:
        super().__init__(parent)
        self._bench = bench
        self._routine: Routine | None = None
        self._step: RoutineName | None = None
        self._said: RoutineReport | None = None
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self.poll)

    @property
    def running(self) -> bool:
        """Return whether a routine runs."""
        return self._routine is not None

    def start(self, step: RoutineName) -> None:
        """Begin a routine; one that must not begin yet says why through `failed`."""
        self.cancel()
        try:
            self._routine = self._bench.routine(step)
        except AcusError as error:
            self.failed.emit(translated(error))
            return
        self._step, self._said = step, None
        self._timer.start()
        self.poll()

    def answer(self, value: float | None = None) -> None:
        """Give what the routine asks for; a refused answer is told and the question stays."""
        if self._routine is None:
            return
        try:
            self._routine.answer(value)
        except AcusError as error:
            self.failed.emit(translated(error))

    def cancel(self) -> None:
        """End the routine with the forces off; idempotent."""
        self._timer.stop()
        routine, self._routine = self._routine, None
        if routine is not None:
            routine.cancel()

    def poll(self) -> None:
        """Step the routine once."""
        routine = self._routine
        if routine is None:
            return
        try:
            report = routine.step(self._bench.clock.now())
        except AcusError as error:
            self.cancel()
            self.failed.emit(translated(error))
            return
        except BaseException:
            self.cancel()
            raise
        if report != self._said:
            self._said = report
            self.reported.emit(report)
        if report.done:
            self._end(report)

    def _end(self, report: RoutineReport) -> None:
        self._timer.stop()
        self._routine = None
        if self._step is None:
            return
        try:
            failure = settle(self._bench, self._step, report)
        except AcusError as error:
            self.failed.emit(translated(error))
            return
        if failure:
            self.failed.emit(failure)
        else:
            self.kept.emit(self._step)


class CommissioningWizard(Wizard):
    """Leads a robot through its commissioning and closes it at the end, whichever way it ends."""

    def __init__(self, bench: Bench, parent: QWidget | None = None) -> None:
        title = tr("Commissioning of {name}", name=bench.profile.name)
        super().__init__(title, (860, 560), 190, parent)
        self._bench = bench
        self.runner = Runner(bench, self)
        self.steps = steps_of(bench)
        self._connection, self._summary = ConnectionPage(bench, self), SummaryPage(bench, self)
        self.routines = tuple(RoutinePage(bench, step, self) for step in self.steps)
        self.add_pages((self._connection, *self.routines, self._summary))
        self._connect()
        self.show_page(0)

    @property
    def page(self) -> QWidget:
        """Page that is shown."""
        return self.pages.currentWidget() or self._connection

    @property
    def busy(self) -> bool:
        """Return whether a routine runs."""
        return self.runner.running

    def marks(self) -> tuple[tuple[Verdict, str], ...]:
        """Return how each step stands, and its title."""
        cleared = not self._bench.clearance().reason
        return (
            (Verdict.GOOD, tr("Connect")),
            *((state_of(self._bench, step)[0], step_words(step).title) for step in self.steps),
            (Verdict.GOOD if cleared else Verdict.WARNING, tr("Summary")),
        )

    def enter(self, number: int) -> None:
        """Show the present state on a page that is shown now."""
        page = self.page
        if isinstance(page, RoutinePage):
            if not self.busy:
                page.set_idle()
        else:
            self._connection.refresh()
            self._summary.refresh()

    def done(self, code: int) -> None:
        """Close by any way: the routine ends, the forces are off, the robot is let go."""
        self.runner.cancel()
        self._bench.close()
        super().done(code)

    # --- routines -----------------------------------------------------------------------------
    def _start(self, step: RoutineName) -> None:
        page = self._routine_page()
        page.set_running()
        self.runner.start(step)
        self.refresh()

    def _cancel(self) -> None:
        self.runner.cancel()
        self._routine_page().set_idle(tr("cancelled, the forces are off"))
        self.refresh()

    def _undo(self, step: RoutineName) -> None:
        page = self._routine_page()
        try:
            self._bench.undo(step)
        except AcusError as error:
            page.set_idle(translated(error))
        else:
            page.set_idle()
        self.refresh()

    def _kept(self, step: RoutineName) -> None:
        self._routine_page().set_idle()
        self.refresh()
        self.next.setFocus()

    def _failed(self, reason: str) -> None:
        page = self._routine_page()
        if self.runner.running:  # an answer was refused; the routine goes on
            page.show_refusal(reason)
        else:
            page.set_idle(reason)
        self.refresh()

    def _reported(self, report: object) -> None:
        self._routine_page().show_report(report)  # type: ignore[arg-type]

    def _routine_page(self) -> RoutinePage:
        page = self.page
        if not isinstance(page, RoutinePage):
            raise TypeError(f"a routine runs on its own page only, not on {type(page).__name__}")
        return page

    def _connect(self) -> None:
        for page in self.routines:
            page.start_wanted.connect(self._start)
            page.answered.connect(self.runner.answer)
            page.cancel_wanted.connect(self._cancel)
            page.undo_wanted.connect(self._undo)
        self.runner.reported.connect(self._reported)
        self.runner.kept.connect(self._kept)
        self.runner.failed.connect(self._failed)
