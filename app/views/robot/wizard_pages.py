"""The wizard's pages: connection, one per routine, summary; and what they say."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from PySide6.QtCore import QLocale, Signal
from PySide6.QtGui import QDoubleValidator
from PySide6.QtWidgets import (
    QGridLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QProgressBar,
    QPushButton,
    QWidget,
)

from app.device.commissioning.results import RoutineName
from app.views.kit import theme
from app.views.kit.parts import PlainLabel, column, label
from app.views.kit.text import date_text, tr
from app.views.kit.verdict import Verdict, tell

if TYPE_CHECKING:
    from app.device.commissioning.bench import Bench
    from app.device.commissioning.results import RoutineName, RoutineReport


ORDER: Final = (
    RoutineName.HOMING,
    RoutineName.SIGNS,
    RoutineName.FORCE,
    RoutineName.LATENCY,
    RoutineName.FRICTION,
    RoutineName.GAUGE,
)
NEEDED: Final = (RoutineName.HOMING, RoutineName.SIGNS)
"""Without these the robot gives no force in this power cycle; the others may wait."""

_SAME: Final = {RoutineName.HOMING: (RoutineName.HOMING, RoutineName.OFFSETS)}


@dataclass(frozen=True, slots=True)
class StepWords:
    """One page: its title, what it is for, and what must lie ready."""

    title: str
    purpose: str
    ready: str


def step_words(step: RoutineName) -> StepWords:
    """Words of a step."""
    return {
        RoutineName.HOMING: StepWords(
            tr("Homing"),
            tr(
                "The encoders only count. Bringing both links to a known pose tells the "
                "program where they are. Needed each time the robot is switched on."
            ),
            tr("The robot gives no force in this step."),
        ),
        RoutineName.OFFSETS: StepWords(
            tr("Encoder offsets"),
            tr("Finds the encoders' zero with the needle in a jig instead of at the stops."),
            tr("The robot gives no force in this step."),
        ),
        RoutineName.SIGNS: StepWords(
            tr("Sign check"),
            tr(
                "Finds out whether each encoder counts the right way and each motor pushes the "
                "right joint the right way. A robot with a wrong sign runs away instead of "
                "guiding. Needed each time the robot was switched on."
            ),
            tr("Blunt needle. One hand at the switch of the motor supply. Small pulses."),
        ),
        RoutineName.FORCE: StepWords(
            tr("Force scale"),
            tr(
                "Finds out whether a commanded newton is a newton. Until it is measured on this "
                "device, forces stay below 1 N."
            ),
            tr("A kitchen scale that shows grams. The robot pushes with 0.2, 0.5 and 0.9 N."),
        ),
        RoutineName.LATENCY: StepWords(
            tr("Latency"),
            tr(
                "Measures the round trip of the wire and the time from a torque to the motion. "
                "Stiffness that is stable depends on it."
            ),
            tr("Hands off the needle. Small pulses."),
        ),
        RoutineName.FRICTION: StepWords(
            tr("Friction"),
            tr(
                "Measures the torque at which each joint begins to move, and its friction in "
                "motion, so that it can be compensated."
            ),
            tr("Hands off the needle. Slow movements."),
        ),
        RoutineName.GAUGE: StepWords(
            tr("Force gauge"),
            tr(
                "Calibrates the board's own gauge by weights, so that the force is measured "
                "instead of estimated."
            ),
            tr("Two or more known weights and a thread."),
        ),
    }[step]


def steps_of(bench: Bench) -> tuple[RoutineName, ...]:
    """Return the steps that this robot needs: a gauge is calibrated only where there is one."""
    return tuple(s for s in ORDER if s is not RoutineName.GAUGE or bench.info.gauge)


def state_of(bench: Bench, step: RoutineName) -> tuple[Verdict, str, str]:
    """Verdict, when and what was found, of a step on this robot."""
    entry = bench.record.newest(*_SAME.get(step, (step,)))
    if entry is None:
        needed = Verdict.BAD if step in NEEDED else Verdict.IDLE
        return needed, tr("not done yet"), ""
    when, found = date_text(entry.date), entry.result.summary()
    if step in NEEDED and not bench.done(*_SAME.get(step, (step,))):
        return Verdict.BAD, tr("{when}, before it was switched on again", when=when), found
    return Verdict.GOOD, when, found


def connection_lines(bench: Bench) -> tuple[tuple[str, str], ...]:
    """Return who is at the other end, line by line."""
    info = bench.info
    return (
        (tr("Profile"), bench.profile.name),
        (tr("Robot"), tr("simulated, to practise") if info.simulated else tr("real")),
        (tr("Board"), info.serial or tr("no serial number")),
        (tr("Firmware"), info.firmware or "–"),
        (tr("Protocol"), info.protocol or "–"),
        (tr("Power cycle"), str(info.boot) if info.boot else tr("not numbered")),
    )


def clearance_words(bench: Bench) -> tuple[Verdict, str]:
    """Return how much force the robot is cleared for, and why it is not more."""
    clearance = bench.clearance()
    if not clearance.reason:
        return Verdict.GOOD, tr("cleared for {n:g} N at the hand", n=clearance.force_cap)
    verdict = Verdict.WARNING if clearance.force_cap > 0.0 else Verdict.BAD
    return verdict, clearance.reason


class ConnectionPage(QWidget):
    """Who is at the other end, and what the robot is cleared for."""

    def __init__(self, bench: Bench, parent: QWidget) -> None:
        super().__init__(parent)
        self._bench = bench
        self._clearance = label()
        rows = column(self, tr("Connected"), theme.MARGIN)
        grid = QGridLayout()
        grid.setColumnStretch(1, 1)
        for row, (name, value) in enumerate(connection_lines(bench)):
            title = label(role="dim")
            title.setText(name)
            grid.addWidget(title, row, 0)
            grid.addWidget(PlainLabel(value), row, 1)
        rows.addLayout(grid)
        rows.addWidget(self._clearance)
        note = label(role="dim")
        note.setText(
            tr(
                "The program's stop is not safety-rated: use a blunt needle, and keep a hand at "
                "the switch of the motor supply (docs/hardware.md). Cancel ends every step at "
                "once, with the forces off."
            )
        )
        rows.addWidget(note)
        rows.addStretch(1)
        self.refresh()

    def refresh(self) -> None:
        """Show the present state."""
        tell(self._clearance, *clearance_words(self._bench))


class SummaryPage(QWidget):
    """What was found, when, and what the robot is cleared for now."""

    def __init__(self, bench: Bench, parent: QWidget) -> None:
        super().__init__(parent)
        self._bench = bench
        self._clearance = label()
        rows = column(self, tr("Summary"), theme.MARGIN)
        grid = QGridLayout()
        grid.setColumnStretch(2, 1)
        grid.setVerticalSpacing(theme.SPACING)
        self._rows: dict[RoutineName, tuple[QLabel, QLabel]] = {}
        for row, step in enumerate(steps_of(bench)):
            when, found = label(), label(role="dim")
            grid.addWidget(PlainLabel(step_words(step).title), 2 * row, 0)
            grid.addWidget(when, 2 * row, 1, 1, 2)
            grid.addWidget(found, 2 * row + 1, 1, 1, 2)
            self._rows[step] = (when, found)
        rows.addLayout(grid)
        rows.addWidget(self._clearance)
        rows.addStretch(1)
        self.refresh()

    def refresh(self) -> None:
        """Show the present state."""
        for step, (when, found) in self._rows.items():
            verdict, words, summary = state_of(self._bench, step)
            tell(when, verdict, words)
            found.setText(summary)
            found.setVisible(bool(summary))
        tell(self._clearance, *clearance_words(self._bench))


class RoutinePage(QWidget):
    """One routine: what it is for, what it does now, what it asks.

    Signals:
        start_wanted(RoutineName): begin it, or begin it again.
        answered(float | None): the answer to what it asks.
        cancel_wanted(), undo_wanted(RoutineName).
    """

    start_wanted = Signal(object)
    answered = Signal(object)
    cancel_wanted = Signal()
    undo_wanted = Signal(object)

    def __init__(self, bench: Bench, step: RoutineName, parent: QWidget) -> None:
        super().__init__(parent)
        self._bench, self.step = bench, step
        words = step_words(step)
        self._state, self.message, self.question = label(), label(), label()
        self.bar = QProgressBar(self)
        self.bar.setRange(0, 1000)
        self.bar.setTextVisible(False)
        self.bar.setFixedHeight(10)
        self.reading, self._unit = QLineEdit(self), PlainLabel(self)
        self.confirm, self.start = QPushButton(tr("Confirm"), self), QPushButton(self)
        self.cancel = QPushButton(tr("Cancel: forces off"), self)
        self.undo = QPushButton(tr("Undo the last result"), self)
        rows = column(self, words.title, theme.MARGIN)
        for text, role in ((words.purpose, ""), (words.ready, "dim")):
            line = label(role=role)
            line.setText(text)
            rows.addWidget(line)
        for widget in (self._state, self.bar, self.message, self.question):
            rows.addWidget(widget)
        rows.addLayout(self._answer_row())
        rows.addStretch(1)
        rows.addLayout(self._buttons())
        self._prepare()
        self.set_idle()

    def show_report(self, report: RoutineReport) -> None:
        """Show what the routine says, and ask what it asks."""
        self.bar.setValue(round(1000 * report.progress))
        self.message.setText(report.message)
        self.question.setText(f"➜ {report.needs}" if report.needs else "")
        asks, numbers = bool(report.needs), bool(report.unit)
        fresh = asks and not self.confirm.isEnabled()
        self.confirm.setEnabled(asks)
        self._ask_number(asks and numbers, report.unit)
        if fresh:
            self.reading.clear()
            (self.reading if numbers else self.confirm).setFocus()

    def set_running(self) -> None:
        """Be ready for reports."""
        tell(self._state, Verdict.WARNING, tr("running"))
        self.start.setEnabled(False)
        self.undo.setEnabled(False)
        self.cancel.setEnabled(True)

    def set_idle(self, failure: str = "") -> None:
        """Show what is known of the step, and why it failed if it has."""
        verdict, when, found = state_of(self._bench, self.step)
        tell(self._state, verdict, ": ".join(part for part in (when, found) if part))
        if failure:
            tell(self._state, Verdict.BAD, failure)
        self.message.clear()
        self.question.clear()
        self.bar.setValue(0)
        known = self._bench.record.newest(self.step) is not None
        self.start.setText(tr("Begin again") if known else tr("Begin"))
        self.start.setEnabled(True)
        self.undo.setEnabled(known)
        self._ask_number(False, "")
        for widget in (self.confirm, self.cancel):
            widget.setEnabled(False)

    def show_refusal(self, reason: str) -> None:
        """Say why an answer was not taken; the question stays."""
        tell(self._state, Verdict.BAD, reason)

    def _ask_number(self, asked: bool, unit: str) -> None:
        self.reading.setVisible(asked)
        self._unit.setVisible(asked)
        self.reading.setEnabled(asked)
        self._unit.setText(unit)

    def _give(self) -> None:
        if not self.confirm.isEnabled():
            return
        if not self.reading.isEnabled():
            self.answered.emit(None)
            return
        value, known = QLocale.c().toDouble(self.reading.text().replace(",", "."))
        if known:
            self.answered.emit(value)
        else:
            self.show_refusal(tr("type the number that the scale shows, such as 51.5"))

    def _prepare(self) -> None:
        validator = QDoubleValidator(-1e5, 1e5, 3, self.reading)
        validator.setLocale(QLocale.c())
        self.reading.setFixedWidth(120)
        self.reading.setAccessibleName(tr("Reading"))
        self.message.setMinimumHeight(2 * theme.TITLE_PX)
        self.question.setStyleSheet(f"font-size: {theme.FONT_PX + 3}px; font-weight: 600;")
        self.question.setMinimumHeight(3 * theme.TITLE_PX)
        for button in (self.confirm, self.start):
            button.setProperty("role", "primary")
        self.cancel.setProperty("role", "danger")
        self.reading.returnPressed.connect(self._give)
        self.confirm.clicked.connect(self._give)
        self.start.clicked.connect(lambda: self.start_wanted.emit(self.step))
        self.cancel.clicked.connect(self.cancel_wanted)
        self.undo.clicked.connect(lambda: self.undo_wanted.emit(self.step))
        for button in (self.confirm, self.start, self.cancel, self.undo):
            button.setAutoDefault(False)

    def _answer_row(self) -> QHBoxLayout:
        row = QHBoxLayout()
        for widget in (self.reading, self._unit, self.confirm):
            row.addWidget(widget)
        row.addStretch(1)
        return row

    def _buttons(self) -> QHBoxLayout:
        row = QHBoxLayout()
        row.addWidget(self.start)
        row.addWidget(self.cancel)
        row.addStretch(1)
        row.addWidget(self.undo)
        return row
