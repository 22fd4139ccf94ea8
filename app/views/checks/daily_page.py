"""The page of the start-of-day check: one line per step, what to do, and the day's result."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

from PySide6.QtCore import QTimer, Signal
from PySide6.QtGui import QCloseEvent, QShowEvent
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QProgressBar,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.core.arrays import FloatArray
from app.planning.registration.plate import FiducialPlate
from app.session.checks.facts import RobotFacts, TouchFacts
from app.session.checks.gather import daily_facts, robot_facts, touch_facts
from app.session.checks.record import DayCheck, newest_check, save_check
from app.session.checks.steps import CheckVerdict, StepResult, daily_check, overall
from app.session.touch import Touch
from app.tracking.inspection import Inspection
from app.views.checks.toucher import Toucher, move_there, tell_tracker
from app.views.exercise.run import ExerciseRun
from app.views.kit import theme
from app.views.kit.parts import PlainLabel, size_dialog
from app.views.kit.text import tr, translated

LOOKS = {
    CheckVerdict.GOOD: theme.VERDICTS["good"],
    CheckVerdict.WARNING: theme.VERDICTS["warning"],
    CheckVerdict.BAD: theme.VERDICTS["bad"],
    CheckVerdict.WAITING: (theme.TEXT_DIM, "–"),
}
"""Colour and symbol of a verdict."""


class StepRow:
    """Symbol, title, and what was found above what to do."""

    def __init__(self, grid: QGridLayout, row: int, parent: QWidget) -> None:
        self._symbol, self._title = PlainLabel(parent), PlainLabel(parent)
        self._text = PlainLabel(parent)
        self._text.setWordWrap(True)
        self._title.setProperty("role", "heading")
        for column, label in enumerate((self._symbol, self._title, self._text)):
            grid.addWidget(label, row, column)

    def show_step(self, step: StepResult | None) -> None:
        """Show a step; None hides the row."""
        for label in (self._symbol, self._title, self._text):
            label.setVisible(step is not None)
        if step is None:
            return
        colour, symbol = LOOKS[step.verdict]
        self._symbol.setText(symbol)
        self._symbol.setStyleSheet(f"color: {theme.now(colour)};")
        self._title.setText(translated(step.title))
        result, todo = translated(step.found), translated(step.todo)
        self._text.setText(f"{result}\n→ {todo}" if todo else result)


def line(parent: QWidget) -> QFrame:
    """Return a horizontal line."""
    made = QFrame(parent)
    made.setFrameShape(QFrame.Shape.HLine)
    made.setStyleSheet(f"color: {theme.BORDER};")
    return made


PERIOD_MS = 400


class DailyPage(QDialog):
    """Polls the running trainer a few times a second.

    Args:
        run: what runs now; None where nothing does.
        plate: its fiducials are the known points.

    Signals:
        kept(str): the day's result was written; when, in words.
    """

    kept = Signal(str)

    def __init__(
        self,
        run: Callable[[], ExerciseRun | None],
        plate: FiducialPlate,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Daily check"))
        size_dialog(self, theme.px(720), theme.px(520))
        self._run, self._plate = run, plate
        self._touch: TouchFacts | None = None
        self._failure, self._touching = "", ""
        self.results: tuple[StepResult, ...] = ()
        self._rows: list[StepRow] = []
        self.toucher = Toucher(run, self)
        self._verdict, self._day = PlainLabel(self), PlainLabel(self)
        self._steps = QGridLayout()
        self.point, self.touch = QComboBox(self), QPushButton(tr("Touch now"), self)
        self.move_tip = QPushButton(tr("Bring the simulated tip there"), self)
        self.progress, self.keep = (
            QProgressBar(self),
            QPushButton(tr("Keep as today's check"), self),
        )
        self._lay_out()
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self.poll)
        self._connect()

    def poll(self) -> None:
        """Judge what runs now."""
        run = self._run()
        if run is None or run.inspect is None:
            self._show(
                (
                    StepResult(
                        "run",
                        tr("Start"),
                        CheckVerdict.WAITING,
                        tr("nothing runs yet"),
                        tr("choose an exercise and a patient: robot and cameras start with them"),
                    ),
                )
            )
            return
        snapshot = run.trainer.snapshot()
        robot: RobotFacts = robot_facts(snapshot, run.board, run.clearance, run.readiness)
        seen: Inspection = run.inspect(False, False)
        facts = daily_facts(snapshot, seen, robot, self._touch, self._failure)
        self._show(daily_check(facts))

    def keep_result(self) -> None:
        """Write the day's result."""
        run = self._run()
        if run is None or not self.results:
            return
        now = datetime.now().astimezone()
        seen = run.inspect(False, False) if run.inspect is not None else None
        check = DayCheck.of(
            self.results,
            now,
            run.profile.name,
            not run.is_real,
            seen.calibration if seen is not None else "",
        )
        save_check(check)
        self._show_day()
        self.kept.emit(translated(check.words(now)))

    # --- touching -----------------------------------------------------------------------------
    def _known(self) -> tuple[str, FloatArray] | None:
        name = str(self.point.currentData() or "")
        if self._plate.place is None or not name:
            return None
        row = self._plate.rows((name,))[0]
        return f"{self._plate.name} {name}", self._plate.place.transform @ self._plate.touch[row]

    def _start(self) -> None:
        self._touch, self._failure = None, ""
        self._touching = str(self.point.currentData() or "")
        self.toucher.start()

    def _touched(self, touch: Touch) -> None:
        known = self._known()
        if known is not None:
            self._touch = touch_facts(*known, touch)
            tell_tracker(self._run(), self._touch)
        self.poll()

    def _failed(self, reason: str) -> None:
        self._failure = reason
        self.poll()

    def _move(self) -> None:
        run, known = self._run(), self._known()
        if run is not None and known is not None:
            move_there(run, known[1])

    # --- showing ------------------------------------------------------------------------------
    def _show(self, results: tuple[StepResult, ...]) -> None:
        self.results = results
        while len(self._rows) < len(results):
            self._rows.append(StepRow(self._steps, len(self._rows), self))
        for i, row in enumerate(self._rows):
            row.show_step(results[i] if i < len(results) else None)
        verdict = overall(results)
        colour, symbol = LOOKS[verdict]
        words = {
            CheckVerdict.GOOD: tr("Everything is well"),
            CheckVerdict.WARNING: tr("Usable, with remarks"),
            CheckVerdict.BAD: tr("Not ready"),
            CheckVerdict.WAITING: tr("Something is still to be done"),
        }[verdict]
        self._verdict.setText(f"{symbol} {words}")
        self._verdict.setStyleSheet(f"color: {colour}; font-size: {theme.TITLE_PX}px;")
        run = self._run()
        self.keep.setEnabled(run is not None and len(results) > 1)
        self.touch.setEnabled(run is not None and not self.toucher.active)
        self.move_tip.setVisible(run is not None and not run.is_real and run.interactive)

    def _show_day(self) -> None:
        newest = newest_check()
        now = datetime.now().astimezone()
        self._day.setText(
            translated(newest.words(now)) if newest is not None else tr("never checked")
        )

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        head.addWidget(self._verdict, 1)
        self._day.setProperty("role", "dim")
        head.addWidget(self._day)
        for name in self._plate.names:
            self.point.addItem(f"{self._plate.name} {name}", name)
        self.point.setCurrentIndex(self.point.count() - 1)
        self.progress.setRange(0, 100)
        self.progress.setTextVisible(False)
        self.progress.setFixedHeight(10)
        self.keep.setProperty("role", "primary")
        self._steps.setColumnStretch(2, 1)
        self._steps.setHorizontalSpacing(theme.MARGIN)
        self._steps.setVerticalSpacing(theme.SPACING)
        touch = QHBoxLayout()
        for widget in (PlainLabel(tr("Known point"), self), self.point, self.touch, self.move_tip):
            touch.addWidget(widget)
        touch.addStretch(1)
        last = QHBoxLayout()
        last.addWidget(self.progress, 1)
        last.addWidget(self.keep)
        column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.MARGIN, theme.MARGIN, theme.MARGIN)
        column.setSpacing(theme.MARGIN)
        column.addLayout(head)
        column.addWidget(line(self))
        column.addLayout(self._steps)
        column.addStretch(1)
        column.addWidget(line(self))
        column.addLayout(touch)
        column.addLayout(last)

    def _connect(self) -> None:
        self.touch.clicked.connect(self._start)
        self.move_tip.clicked.connect(self._move)
        self.keep.clicked.connect(self.keep_result)
        self.toucher.progressed.connect(lambda share: self.progress.setValue(round(100 * share)))
        self.toucher.touched.connect(self._touched)
        self.toucher.failed.connect(self._failed)

    def showEvent(self, event: QShowEvent) -> None:
        """Begin to poll."""
        super().showEvent(event)
        self._show_day()
        self.poll()
        self._timer.start()

    def closeEvent(self, event: QCloseEvent) -> None:
        """Stop looking."""
        self._timer.stop()
        self.toucher.stop()
        super().closeEvent(event)
