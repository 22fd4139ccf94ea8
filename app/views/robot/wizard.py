"""The commissioning wizard: step by step from the connection to the summary."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QDialog,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QPushButton,
    QStackedWidget,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.views.exercise.status_items import Verdict
from app.views.kit import theme
from app.views.kit.text import tr
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


class Wizard(QDialog):
    """Leads a robot through its commissioning and closes it at the end, whichever way it ends."""

    def __init__(self, bench: Bench, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Commissioning of {name}", name=bench.profile.name))
        self.resize(theme.px(860), 560)
        self._bench = bench
        self.runner = Runner(bench, self)
        self.steps = steps_of(bench)
        self.list, self.pages = QListWidget(self), QStackedWidget(self)
        self._connection, self._summary = ConnectionPage(bench, self), SummaryPage(bench, self)
        self.routines = tuple(RoutinePage(bench, step, self) for step in self.steps)
        for page in (self._connection, *self.routines, self._summary):
            self.pages.addWidget(page)
            self.list.addItem(QListWidgetItem())
        self.back, self.next = QPushButton(tr("Back"), self), QPushButton(self)
        self._lay_out()
        self._connect()
        self.show_page(0)

    @property
    def page(self) -> QWidget:
        """Page that is shown."""
        return self.pages.currentWidget() or self._connection

    def show_page(self, number: int) -> None:
        """Go to a page; a routine that runs keeps its page."""
        if self.runner.running:
            number = self.pages.currentIndex()
        number = min(max(number, 0), self.pages.count() - 1)
        self.pages.setCurrentIndex(number)
        self.list.setCurrentRow(number)
        page = self.page
        if isinstance(page, RoutinePage):
            page.set_idle() if not self.runner.running else None
        else:
            self._connection.refresh()
            self._summary.refresh()
        self._refresh()

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
        self._refresh()

    def _cancel(self) -> None:
        self.runner.cancel()
        self._routine_page().set_idle(tr("cancelled, the forces are off"))
        self._refresh()

    def _undo(self, step: RoutineName) -> None:
        page = self._routine_page()
        try:
            self._bench.undo(step)
        except AcusError as error:
            page.set_idle(str(error))
        else:
            page.set_idle()
        self._refresh()

    def _kept(self, step: RoutineName) -> None:
        self._routine_page().set_idle()
        self._refresh()
        self.next.setFocus()

    def _failed(self, reason: str) -> None:
        page = self._routine_page()
        if self.runner.running:  # an answer was refused; the routine goes on
            page.show_refusal(reason)
        else:
            page.set_idle(reason)
        self._refresh()

    def _reported(self, report: object) -> None:
        self._routine_page().show_report(report)  # type: ignore[arg-type]

    def _routine_page(self) -> RoutinePage:
        page = self.page
        if not isinstance(page, RoutinePage):
            raise TypeError(f"a routine runs on its own page only, not on {type(page).__name__}")
        return page

    # --- around -------------------------------------------------------------------------------
    def _refresh(self) -> None:
        """Mark the steps in the list, and say what Next does."""
        last, running = self.pages.count() - 1, self.runner.running
        self._mark(0, Verdict.GOOD, tr("Connect"))
        for i, step in enumerate(self.steps, start=1):
            verdict, _, _ = state_of(self._bench, step)
            self._mark(i, verdict, step_words(step).title)
        cleared = not self._bench.clearance().reason
        self._mark(last, Verdict.GOOD if cleared else Verdict.WARNING, tr("Summary"))
        here = self.pages.currentIndex()
        self.back.setEnabled(here > 0 and not running)
        self.next.setEnabled(not running)
        self.next.setText(tr("Close") if here == last else tr("Next"))
        self.list.setEnabled(not running)

    def _mark(self, row: int, verdict: Verdict, title: str) -> None:
        colour, symbol = verdict.look
        item = self.list.item(row)
        item.setText(f"{symbol} {title}")
        item.setForeground(QColor(colour))

    def _go_on(self) -> None:
        here = self.pages.currentIndex()
        if here == self.pages.count() - 1:
            self.accept()
        else:
            self.show_page(here + 1)

    def _lay_out(self) -> None:
        self.list.setFixedWidth(190)
        row = QHBoxLayout()
        row.addWidget(self.list)
        row.addWidget(self.pages, 1)
        buttons = QHBoxLayout()
        buttons.addStretch(1)
        for button in (self.back, self.next):
            button.setAutoDefault(False)
            buttons.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        column.addLayout(row, 1)
        column.addLayout(buttons)

    def _connect(self) -> None:
        self.list.currentRowChanged.connect(self.show_page)
        self.back.clicked.connect(lambda: self.show_page(self.pages.currentIndex() - 1))
        self.next.clicked.connect(self._go_on)
        for page in self.routines:
            page.start_wanted.connect(self._start)
            page.answered.connect(self.runner.answer)
            page.cancel_wanted.connect(self._cancel)
            page.undo_wanted.connect(self._undo)
        self.runner.reported.connect(self._reported)
        self.runner.kept.connect(self._kept)
        self.runner.failed.connect(self._failed)
