"""The commissioning wizard: step by step from the connection to the summary."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtWidgets import QWidget

from app.core.errors import AcusError
from app.views.kit.text import tr
from app.views.kit.verdict import Verdict
from app.views.kit.wizard import Wizard
from app.views.robot.runner import Runner
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
    from app.device.commissioning.results import RoutineName


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
        """Whether a routine runs."""
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
            page.set_idle(str(error))
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
