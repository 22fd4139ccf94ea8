"""The exercise panel: what is practised, by whom, with how much help, its buttons, and how it
goes.
"""

from collections.abc import Sequence
from math import degrees, remainder, tau
from typing import Final

import numpy as np
from PySide6.QtCore import QEvent, QObject, QSignalBlocker, Qt, QTimer, Signal
from PySide6.QtGui import QKeyEvent, QKeySequence, QResizeEvent, QShortcut
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QFrame,
    QGridLayout,
    QHBoxLayout,
    QPushButton,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.core.units import MILLIMETRE
from app.exercises.guidance import GuidancePart
from app.planning.plan import Plan
from app.session.machine import RUNNING, State
from app.session.pad.hand import Handle
from app.session.snapshot import BreathHold, Snapshot
from app.views.exercise.ablation_panel import AblationPanel
from app.views.exercise.assistance_dial import AssistanceDial
from app.views.exercise.attempt_rail import AttemptRail, RailFigures
from app.views.exercise.enable_switch import EnableSwitch
from app.views.exercise.energy_gauge import EnergyGauge
from app.views.exercise.entry_marking import EntryMarkPanel
from app.views.exercise.live import LiveFigures
from app.views.exercise.procedure_panel import ComplicationPanel, ProcedurePanel
from app.views.exercise.readouts import AttemptReadouts
from app.views.exercise.scan_view import ScanPanel
from app.views.exercise.stages import Steps
from app.views.kit import theme
from app.views.kit.access import ACCESS
from app.views.kit.lines import PseudonymLine
from app.views.kit.parts import FittingButton, PlainLabel
from app.views.kit.text import literal, tr, translated


class AttemptActions(QWidget):
    """Start, control scan, end, abort.

    Signals:
        start_requested(), scan_requested(), end_requested(), abort_requested().
    """

    start_requested = Signal()
    scan_requested = Signal()
    end_requested = Signal()
    abort_requested = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.start = _button(tr("Start attempt"), _starts())
        self.start.setProperty("role", "primary")
        self.scan = _button(tr("Control scan (S)"), _takes_here())
        self.end = _button(tr("End attempt (Enter)"), tr("The needle stays as it is and is scored"))
        self.abort = _button(
            tr("Abort (hold Esc)"),
            tr("Set the force to zero at once; the attempt is saved but not scored"),
        )
        self._keys: list[tuple[QShortcut, FittingButton]] = []
        self._ends = self._out = self._narrow = False
        self._placed: tuple[bool, bool] | None = None
        self._state: tuple[State | None, bool, str] = (None, False, "")
        self._escape = HoldKey(Qt.Key.Key_Escape, self)
        self._escape.held.connect(self.abort.click)  # a disabled button ignores it
        self._lay_out()
        self._connect()
        self.show_state(None, False)

    def set_pedal(self, scans: bool) -> None:
        """Say what the scan's key does: it takes the slices that are set, or those at the tip."""
        self.scan.setToolTip(literal(_takes() if scans else _takes_here()))

    def watch(self, window: QWidget) -> None:
        """Listen for Esc held down anywhere in `window`."""
        self._escape.watch(window)

    def listen(self, page: QWidget) -> None:
        """Let the keys work wherever `page` is shown, whichever panel stands in front of this."""
        for shortcut, _ in self._keys:
            shortcut.setParent(page)

    def show_state(self, state: State | None, can_start: bool, reason: str = "") -> None:
        """Enable what is legal.

        Args:
            state: of the attempt; None without one.
            can_start: whether a new attempt can begin.
            reason: it cannot start now, if there is more to say than that something is missing.
        """
        self._state = state, can_start, reason
        running = state in RUNNING and not self._ends
        self.start.setToolTip(literal(reason or _starts()))
        for button, legal in (
            (self.start, can_start and not self._ends),
            (self.scan, running and state is not State.WITHDRAWING and not self._out),
            (self.end, running),
            (self.abort, running),
        ):
            button.setEnabled(legal)
        for shortcut, button in self._keys:
            shortcut.setEnabled(button.isEnabled())

    def set_ending(self, ends: bool) -> None:
        """Take no order while an attempt that was ended is being scored and written."""
        self._ends = ends
        self.show_state(*self._state)

    def set_out(self, left: float | None) -> None:
        """Take no order for a scan while the student is out of the room, but say how long [s]."""
        out = left is not None
        words = tr("Control scan (S)") if left is None else tr("Out of the room: {s:.0f} s", s=left)
        if words != self.scan.text():
            self.scan.setText(words)
        if out is not self._out:
            self._out = out
            self.show_state(*self._state)

    def _lay_out(self) -> None:
        self._grid = grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.addWidget(self.start, 0, 0, 1, 2)
        self.set_narrow(False)

    def set_narrow(self, narrow: bool) -> None:
        """Leave Start out and give the scan a row, as the foot of a rail wants them, or not."""
        self._narrow = narrow
        self.start.setVisible(not narrow)
        self._place()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Put End and Abort beside each other where both can be read."""
        super().resizeEvent(event)
        self._place()

    def _place(self) -> None:
        ends = self.end, self.abort
        widest = max(button.shortest_px for button in ends)
        side = self._narrow and 2 * widest + self._grid.horizontalSpacing() <= self.width()
        if (self._narrow, side) == self._placed:
            return
        self._placed = self._narrow, side
        places = {
            self.scan: (1, 0, 1, 2 if self._narrow else 1),
            self.end: (2, 0, 1, 1 if side else 2) if self._narrow else (1, 1, 1, 1),
            self.abort: (2, 1, 1, 1) if side else (3 if self._narrow else 2, 0, 1, 2),
        }
        for button, place in places.items():
            self._grid.addWidget(button, *place)

    def _connect(self) -> None:
        for button, signal, keys in (
            (self.start, self.start_requested, ()),  # its key works beside every panel
            (self.scan, self.scan_requested, (Qt.Key.Key_S,)),
            (self.end, self.end_requested, (Qt.Key.Key_Return, Qt.Key.Key_Enter)),
            (self.abort, self.abort_requested, ()),
        ):
            button.clicked.connect(signal)
            for key in keys:
                shortcut = QShortcut(QKeySequence(key), self)
                shortcut.setAutoRepeat(False)
                shortcut.activated.connect(button.click)
                self._keys.append((shortcut, button))


def _starts() -> str:
    return tr("Arm the robot and begin recording (F5)")


def _takes_here() -> str:
    return tr(
        "Takes a scan about the needle's tip, counts it, and shows it in place of the live pictures"
    )


def _takes() -> str:
    return tr("The pedal: takes the slices that are set below, with the needle where it is now")


def _button(text: str, help_text: str) -> FittingButton:
    button = FittingButton(text)
    button.setToolTip(literal(help_text))
    # A button that keeps the focus would swallow the pad's keys; Space on it would repeat it.
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    return button


HOLD_MS = 700


class HoldKey(QObject):
    """Watches a window for one key; auto-repeat and other keys change nothing.

    Signals:
        held(): the key was down for `HOLD_MS` without a break.
    """

    held = Signal()

    def __init__(self, key: Qt.Key, parent: QObject) -> None:
        super().__init__(parent)
        self._key = key
        self._since = 0  # [ms] of the events' own clock
        self._timer = QTimer(self, interval=HOLD_MS, singleShot=True)
        self._timer.timeout.connect(self.held)

    def watch(self, window: QWidget) -> None:
        """Listen in a window, before whoever has the focus there: a button of the menu bar keeps
        keys to itself.
        """
        window.installEventFilter(self)
        self._listen_first(window)

    def _listen_first(self, window: QWidget) -> None:
        """Listen to the window of the display as well, which hears of each key once it is shown."""
        handle = window.windowHandle()
        if handle is not None:
            handle.installEventFilter(self)  # again, where it was already, is once

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Start and stop the clock; the event goes on to whoever wants it."""
        if event.type() == QEvent.Type.Show and isinstance(watched, QWidget):
            self._listen_first(watched)
        kinds = (QEvent.Type.KeyPress, QEvent.Type.KeyRelease)
        if event.type() in kinds and isinstance(event, QKeyEvent) and event.key() == self._key:
            if event.isAutoRepeat():
                return False
            if event.type() == QEvent.Type.KeyPress:
                self._since = event.timestamp()
                self._timer.start()
            elif self._timer.isActive():
                self._timer.stop()
                # A window that stood still learns of both at once: the events know how long it was.
                if event.timestamp() - self._since >= HOLD_MS:
                    self.held.emit()
        elif event.type() == QEvent.Type.WindowDeactivate:
            self._timer.stop()
        return False


class WithdrawalNote(QWidget):
    """Words and, where nothing measures the depth, the button by which the student vouches for it.

    Signals:
        confirmed(): the student says that the needle is out.
        over(): there is no more to wait for.
    """

    confirmed = Signal()
    over = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._words = PlainLabel(self)
        self._words.setWordWrap(True)
        self._words.setStyleSheet(f"color: {theme.WARNING};")
        self.button = QPushButton(tr("The needle is out"), self)
        self.button.setToolTip(
            tr("Recorded as your word, not as measured; a depth inside the skin refutes it")
        )
        self.button.clicked.connect(self.confirmed)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._words)
        column.addWidget(self.button)
        self.hide()

    def show_snapshot(self, snapshot: Snapshot) -> None:
        """Show what a snapshot says, or nothing."""
        words = translated(snapshot.withdrawal)
        if words != self._words.text():
            self._words.setText(words)
            self.setVisible(bool(words))
            if not words:
                self.over.emit()
        self.button.setVisible(snapshot.may_confirm)


class BevelNote(PlainLabel):
    """Says which way a bevelled tip cuts, and how to turn it; nothing where there is no bevel."""

    def show_roll(self, roll: float | None, commands: bool) -> None:
        """Show the roll [rad]; `commands`: whether it can be turned now."""
        self.setVisible(roll is not None)
        if roll is None:
            return
        words = tr("Bevel turned by {angle:.0f}°", angle=degrees(remainder(roll, tau)))
        self.setText(f"{words}  ·  {tr('Q, E in the pad turn it')}" if commands else words)


class TouchNote(PlainLabel):
    """Says how many targets are touched, how far the next one is, and how the hand moves the tip.

    Nothing where there is nothing to touch.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWordWrap(True)
        self.hide()

    def show_touch(self, snapshot: Snapshot, length: float) -> None:
        """Show how a snapshot stands; `length` is that of the tool [m]."""
        touch = snapshot.touch
        self.setVisible(touch is not None)
        if touch is None:
            return
        of = len(touch.task)
        said = [tr("{n} of {of} touched", n=touch.touched, of=of)]
        if snapshot.pose.measured:
            away = float(np.linalg.norm(touch.aim.p_target - snapshot.pose.p_tip)) / MILLIMETRE
            if not touch.done:
                said.append(tr("{mm:.0f} mm to target {n}", mm=away, n=touch.number))
            said.append(hand_words(Handle(length).scale(snapshot.pose.depth)))
        words = "  ·  ".join(said)
        if words != self.text():
            self.setText(words)


def hand_words(scale: float) -> str:
    """Say how far the tip of a tool goes for a way of the hand at its handle."""
    if scale > 0.0:
        return tr("the tip is not through the trocar yet: push")
    return tr("1 mm of hand moves the tip {mm:.1f} mm, the other way", mm=-scale)


class BreathCommand(QWidget):
    """Tells a patient who holds the breath on command to hold it, or to breathe; says how he is.

    Signals:
        asked(bool): he is to hold it.
    """

    asked = Signal(bool)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.button = _button("", tr("Breathe in, breathe out, hold: until you let him breathe"))
        self._words = PlainLabel(self)
        self._wish = False
        self._row = row = QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.button)
        row.addWidget(self._words, 1)
        self.button.clicked.connect(self._turn)
        self._key = QShortcut(QKeySequence(Qt.Key.Key_A), self)
        self._key.setAutoRepeat(False)
        self._key.activated.connect(self.button.click)
        self.show_breath(None, False)

    def set_narrow(self, narrow: bool) -> None:
        """Put the words below the button, or beside it."""
        way = QHBoxLayout.Direction
        self._row.setDirection(way.TopToBottom if narrow else way.LeftToRight)

    def listen(self, page: QWidget) -> None:
        """Let the key work wherever `page` is shown."""
        self._key.setParent(page)

    def show_breath(self, breath: BreathHold | None, commands: bool) -> None:
        """Show how the patient stands, or nothing; `commands`: whether he can be told now."""
        self.setVisible(breath is not None)
        self.button.setEnabled(breath is not None and commands)
        self._key.setEnabled(breath is not None and commands)
        if breath is None:
            return
        self._wish = not breath.asked
        holds, breathes = tr("Hold the breath (A)"), tr("Let breathe (A)")
        self.button.setText(holds if self._wish else breathes)
        if breath.held:
            words = tr("holds: {s:.0f} s left", s=breath.left)
        elif breath.spent:
            words = tr("breathes by himself")
            self.button.setText(tr("Release (A)"))
        else:
            words = tr("breathes out and holds") if breath.asked else tr("breathes")
        self._words.setText(words)
        self._words.setStyleSheet(f"color: {theme.WARNING if breath.spent else theme.TEXT};")

    def _turn(self) -> None:
        self.asked.emit(self._wish)


TELLING_NOTHING: Final = frozenset({"elapsed", "scans"})
"""Read-outs that say nothing of where the needle is."""


class AttemptTools(QWidget):
    """What is pressed and answered in an attempt: beside the rest of the panel, or in the rail.

    Attributes:
        procedure, patient, ablation, buttons, withdrawal, enable, breath, bevel, touch, scan: what
            stands there.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.buttons = AttemptActions(self)
        self.withdrawal = WithdrawalNote(self)
        self.enable = EnableSwitch(self)
        self.breath = BreathCommand(self)
        self.bevel = BevelNote(self)
        self.bevel.hide()
        self.touch = TouchNote(self)
        self.procedure = ProcedurePanel(self)
        self.patient = ComplicationPanel(self)
        self.ablation = AblationPanel(self)
        self.scan = ScanPanel(self)
        self.entry = EntryMarkPanel(self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(theme.SPACING - 2)
        for widget in (
            self.withdrawal,
            self.procedure,
            self.patient,
            self.ablation,
            self.entry,
            self.buttons,
            self.enable,
            self.breath,
            self.bevel,
            self.touch,
            self.scan,
        ):
            column.addWidget(widget)
        self._column = column

    def set_narrow(self, narrow: bool) -> None:
        """Suit a rail, or a panel of the usual width."""
        self.buttons.set_narrow(narrow)
        self.breath.set_narrow(narrow)
        self.procedure.set_narrow(narrow)
        self.scan.set_narrow(narrow)
        # Before the attempt the entry is marked first; in it what is pressed stands first.
        before = self._column.count() - 1 if narrow else self._column.indexOf(self.ablation) + 1
        self._column.insertWidget(before, self.entry)
        if not narrow:  # a rail has them at its foot, where they are seen without scrolling
            self._column.insertWidget(self._column.indexOf(self.enable), self.buttons)
        self.bevel.setWordWrap(narrow)


class ExercisePanel(QWidget):
    """Everything around the pad; holds no state of the attempt.

    The signals of the other buttons are those of `buttons`.

    Signals:
        exercise_chosen(str): identifier of the exercise.
        start_requested(str): pseudonym of the student.
        assistance_changed(float): -1 full repulsion … 0 off … 1 full guidance.
        start_changed(): `may_start` or `why_not` is another.
        start_refused(str): somebody pressed the key of Start; why nothing can begin now.
    """

    exercise_chosen = Signal(str)
    start_requested = Signal(str)
    assistance_changed = Signal(float)
    start_changed = Signal()
    start_refused = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._ready, self._not_ready, self._waiting, self._preparing = False, "", "", ""
        self._state: State | None = None
        self._start: tuple[bool, str] = False, ""
        self._signed_in, self._typed = False, ""
        self._telling: frozenset[str] | None = None
        self._offsets = self._forceful = True
        self.exercise = QComboBox(self)
        self.student = PseudonymLine(self)
        self._title = PlainLabel(self)
        self._title.setProperty("role", "heading")
        self._title.setWordWrap(True)
        self._title.hide()
        self.assistance = AssistanceDial(self)
        self._dial_title = PlainLabel(tr("Assistance"), self)
        self._note = PlainLabel(self)
        self.steps = Steps(self)
        self.tools, self.rail = AttemptTools(self), AttemptRail(self)
        tools = self.tools
        self.buttons, self.withdrawal, self.enable = tools.buttons, tools.withdrawal, tools.enable
        self.breath, self.bevel, self.touch = tools.breath, tools.bevel, tools.touch
        self.procedure, self.patient = tools.procedure, tools.patient
        self.scan, self.ablation = tools.scan, tools.ablation
        self.entry = tools.entry
        self.readouts = AttemptReadouts(self)
        self.energy = EnergyGauge(self)
        self.exercise.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self._prepare_inputs()
        self._lay_out()
        self._connect()

    # --- whether an attempt can begin -------------------------------------------------------------
    @property
    def may_start(self) -> bool:
        """Return whether an attempt can begin now: Start, its key and the line over the views go by
        it.
        """
        return self._ready and not self._waiting and self._state not in RUNNING

    @property
    def why_not(self) -> str:
        """Return what is to be done or waited for before one can begin; empty if nothing is
        known.
        """
        return self._waiting or self._not_ready

    def press_start(self) -> None:
        """Begin as Start does, or say why nothing can begin now."""
        if self.may_start:
            self.buttons.start.click()
        elif self._state not in RUNNING and (why := self.why_not or self._preparing):
            self.start_refused.emit(why)

    # --- what the controller and the window call --------------------------------------------------
    def listen(self, page: QWidget) -> None:
        """Let the attempt's keys work wherever `page` is shown, whichever panel is in front."""
        self.buttons.listen(page)
        self.breath.listen(page)
        self.procedure.listen(page)
        self.patient.listen(page)
        self.ablation.listen(page)

    def set_exercises(
        self, exercises: Sequence[tuple[str, str]], chosen: str | None = None
    ) -> None:
        """Offer exercises as (identifier, title)."""
        with QSignalBlocker(self.exercise):
            self.exercise.clear()
            for identifier, title in exercises:
                self.exercise.addItem(title, identifier)
            self.exercise.setCurrentIndex(max(0, self.exercise.findData(chosen)))
        self._title.setText(self.exercise.currentText())

    def set_chosen_elsewhere(self, elsewhere: bool) -> None:
        """Name the exercise only, where it and the student are chosen on the start page."""
        self._title.setVisible(elsewhere)
        for row in (self.exercise, self.student):
            self._form.setRowVisible(row, not elsewhere)

    def set_student(self, pseudonym: str) -> None:
        """Fill in the pseudonym."""
        self.student.setText(pseudonym)

    def set_assistance(self, share: float) -> None:
        """Show an assistance that came from elsewhere, -1…1; emits nothing."""
        self.assistance.set_share(share)

    def set_locked(self, reason: str) -> None:
        """Keep the dial as the exercise has it, because of `reason`; empty: the student's.

        What is so stands beside the dial.
        """
        self.assistance.set_locked(reason)
        self._dial_title.setText(
            tr("Assistance\nfixed") if reason else tr("Assistance\nfree to turn")
        )
        free = tr("Practice: you may turn the dial. Every attempt begins with the exercise's own.")
        self._dial_title.setToolTip(literal(reason or free))

    def set_ready(self, ready: bool, note: str = "") -> None:
        """Say whether an attempt can start, and if not, why not."""
        self._ready, self._not_ready = ready, note
        self._show_note()
        self._enable()

    def set_preparing(self, preparing: bool) -> None:
        """Say whether robot and cameras are being started: the key of Start says so meanwhile."""
        words = tr("Robot and cameras are being started: an attempt can begin in a moment.")
        self._preparing = words if preparing else ""

    def set_guidance(self, guidance: GuidancePart | None, plan: Plan | None) -> None:
        """Let control scans guide, with the table about the plan's middle; None shows all live."""
        self.scan.set_guidance(guidance, plan)
        self._telling = None if guidance is None else TELLING_NOTHING
        self.readouts.set_telling(self._telling)
        self._tell_rail()
        self.buttons.set_pedal(guidance is not None)

    def show_out(self, left: float | None) -> None:
        """Show how long the student is out of the room yet [s]; None while he is in it."""
        self.scan.choices.show_out(left)
        self.buttons.set_out(left)

    def set_brief(self, brief: bool) -> None:
        """Show what lies between beginning and end of an attempt as one step, or each by itself."""
        self.steps.set_brief(brief)
        self.rail.stage.set_brief(brief)

    def lend_tools(self, lent: bool) -> None:
        """Let the rail have what is pressed in an attempt, or take it back to its place.

        What the rail shows besides, stages, figures and force, is not shown here meanwhile.
        """
        self.tools.set_narrow(lent)
        self.steps.setVisible(not lent)
        self.readouts.set_elsewhere(frozenset(RailFigures.SHOWN if lent else ()))
        if lent:
            self.rail.take(self.tools, self.tools.buttons)
        else:
            self._column.insertWidget(self._column.indexOf(self._note) + 1, self.tools)
            self.tools.show()

    def set_offsets(self, shown: bool) -> None:
        """Say how far the needle is off the path, or not where the bull's-eye may not either."""
        self.readouts.set_offsets(shown)
        self._offsets = shown
        self._tell_rail()

    def _tell_rail(self) -> None:
        self.rail.figures.set_telling(self._telling, self._offsets)
        self.rail.force.setVisible(self._telling is None and self._forceful)

    def set_forceful(self, forceful: bool) -> None:
        """Show the dial and the force felt, or neither where there is nothing that could push."""
        self._form.setRowVisible(self.assistance, forceful)
        self.readouts.set_forceful(forceful)
        self._forceful = forceful
        self._tell_rail()

    def show_figures(self, figures: LiveFigures | None) -> None:
        """Show a moment of the attempt; None without one."""
        self.readouts.show_figures(figures)
        self.rail.show_figures(figures)
        state = figures.state if figures else None
        self.steps.show_state(state, figures.ready if figures else False)
        if state is not self._state:
            self._state = state
            self._enable()

    def forget(self) -> None:
        """Say nothing of the patient who leaves."""
        self.show_figures(None)
        self.set_guidance(None, None)
        self.set_brief(False)
        self.set_offsets(True)
        self.scan.forget()
        self.breath.show_breath(None, False)
        self.touch.hide()
        self.procedure.show_procedure(None, False)
        self.patient.show_patient(None, False)
        self.ablation.show_ablation(None, False)
        self.energy.show_energy(None)

    def set_waiting(self, reason: str) -> None:
        """Let Start wait, and say why; empty ends that."""
        self._waiting = reason
        self._show_note()
        self._enable()

    def _show_note(self) -> None:
        self._note.setText(self.why_not)
        self._note.setVisible(bool(self.why_not))

    # --- inside -----------------------------------------------------------------------------------
    def _show_student(self) -> None:
        """Show who is signed in: nobody types over that."""
        if ACCESS.student is not None:
            self._typed = self._typed if self._signed_in else self.student.text()
            self.student.show_known(ACCESS.student.pseudonym)
        elif self._signed_in:
            self.student.setText(self._typed)
        self._signed_in = ACCESS.student is not None
        self.student.setPlaceholderText(
            tr("anonymous (instructor signed in)") if ACCESS.instructor else tr("anonymous")
        )
        self._enable()

    def _enable(self) -> None:
        running = self._state in RUNNING
        self.exercise.setEnabled(not running)
        self.student.setEnabled(not running and not self._signed_in)
        self.buttons.show_state(self._state, self.may_start, self.why_not)
        start = self.may_start, self.why_not
        if start != self._start:
            self._start = start
            self.start_changed.emit()

    def _prepare_inputs(self) -> None:
        self.student.setPlaceholderText(tr("anonymous"))
        self._note.setWordWrap(True)
        self._note.setStyleSheet(f"color: {theme.WARNING};")
        self._note.hide()

    def _lay_out(self) -> None:
        self._form = form = QFormLayout()
        form.setContentsMargins(0, 0, 0, 0)
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.ExpandingFieldsGrow)
        for title, field in ((tr("Exercise"), self.exercise), (tr("Student"), self.student)):
            name = PlainLabel(title)
            name.setBuddy(field)
            form.addRow(name, field)
        form.addRow(self._dial_title, self.assistance)
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(theme.MARGIN, theme.SPACING, theme.MARGIN, theme.SPACING)
        column.setSpacing(theme.SPACING - 2)  # with every part shown it still fits 768 lines
        column.addWidget(self._title)
        column.addLayout(form)
        for widget in (
            self.steps,
            self._note,
            self.tools,
            _line(),
            self.readouts,
            self.energy,
        ):
            column.addWidget(widget)
        column.addStretch(1)

    def _connect(self) -> None:
        self.exercise.currentTextChanged.connect(self._title.setText)
        self.exercise.activated.connect(
            lambda index: self.exercise_chosen.emit(self.exercise.itemData(index))
        )
        self.assistance.changed.connect(self.assistance_changed)
        self.buttons.start_requested.connect(
            lambda: self.start_requested.emit(ACCESS.recorded_as(self.student.text().strip()))
        )
        ACCESS.changed.connect(self._show_student)
        self._show_student()


def _line() -> QFrame:
    line = QFrame()
    line.setFrameShape(QFrame.Shape.HLine)
    line.setStyleSheet(f"color: {theme.BORDER};")
    return line
