"""The steps of a procedure beside the needle, and the patient: what is held, what can be done, what
came of it.
"""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QComboBox, QGridLayout, QWidget

from app.scoring.complications.answers import ANSWER_WORDS, Reaction
from app.scoring.procedure import SampleMark
from app.session.complications import ComplicationsState
from app.session.procedure import ProcedureState, Step
from app.views.exercise.step_panel import (
    KeyedPanel,
    StepPanel,
    first_of,
    other_step,
    shared_results,
    shared_words,
    step_button,
)
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, number, tr, translated

NEXT: Final = (
    Step.INJECT,
    Step.TAKE_NEEDLE,
    Step.STYLET_OUT,
    Step.GUN_IN,
    Step.GUN_OUT,
    Step.STYLET_IN,
    Step.ROLL_OVER,
)
"""What the key of the next step does, the first of these that can be done; the gun has its own."""

CLOCK: Final = (0.0, 90.0, 180.0, 270.0)
"""Directions of the notch, clockwise as seen from the hub."""


class ProcedurePanel(StepPanel):
    """Offers the steps that can follow; hidden where the exercise has none."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown: tuple[ProcedureState | None, bool, bool | None] = None, False, False
        self.fire = step_button()
        self.throw, self.notch = QComboBox(self), QComboBox(self)
        self._prepare()
        self._lay_out()
        self.hide()

    def show_procedure(
        self, state: ProcedureState | None, commands: bool, inside: bool | None = False
    ) -> None:
        """Show how an attempt stands with its steps, or nothing.

        Args:
            state: how it stands; None without steps.
            commands: whether steps can be done now.
            inside: whether the tip is in the body; None where nobody is told.
        """
        self.setVisible(state is not None)
        now = state, commands, inside
        if state is not None and now != self._shown:
            if self._state is None or state.part is not self._state.part:
                self._offer_settings(state)
            self._state, self._shown = state, now
            self._show(state, commands, inside)
        elif state is None:
            self._state, self._shown = None, (None, False, False)
            self._offer_other(None)
            self._enable(set())

    def _offer_settings(self, state: ProcedureState) -> None:
        biopsy = state.part.biopsy
        with QSignalBlocker(self.throw):
            self.throw.clear()
            for part in () if biopsy is None else biopsy.throws:
                self.throw.addItem(tr("{throw} mm", throw=number(part.throw_mm, "g")))
                words = tr(
                    "The notch holds {notch} mm and ends {tip} mm before the needle does",
                    notch=number(part.notch_mm, "g"),
                    tip=number(part.dead_tip_mm, "g"),
                )
                last = self.throw.count() - 1
                self.throw.setItemData(last, literal(words), Qt.ItemDataRole.ToolTipRole)
        self._settings.setVisible(biopsy is not None)
        self.fire.setVisible(biopsy is not None)

    def _show(self, state: ProcedureState, commands: bool, inside: bool | None) -> None:
        self.held.setText(tr("Held: {tool}", tool=translated(state.words)))
        possible = set(state.possible) if commands else set()
        # After its throw the gun comes out; after a sample the stylet goes back before the next.
        # Where nobody is told, the key does what is usual: one deposit, then the outer needle.
        injects = not state.deposits if inside is None else inside
        beside = other_step(state, possible, inside)
        possible.discard(Step.TAKE_NEEDLE if injects else Step.INJECT)
        if not state.deposits:  # whoever presses the key at once has not begun yet
            possible.discard(Step.TAKE_NEEDLE)
        if inside is not False:  # the key goes on with another sample
            possible.discard(Step.ROLL_OVER)
        elif Step.ROLL_OVER in possible:
            possible.discard(Step.STYLET_OUT)
        check = first_of(state, possible)
        order = [check] if check else [step for step in NEXT if step in possible]
        if Step.GUN_IN in order and Step.STYLET_IN in order and self._step is Step.GUN_OUT:
            order.remove(Step.GUN_IN)
        self._step = order[0] if order else self._step
        self.next.setText(_words(self._step) if order else tr("Next step (J)"))
        self.next.setVisible(bool(order) or state.part.biopsy is not None)
        self._offer_other(beside)  # in the gun's place, which nobody holds then
        self.fire.setVisible(beside is None and state.part.biopsy is not None)
        self._enable(possible, bool(order))
        self._show_results(self._warnings(state), _results(state))

    def _show_again(self) -> None:
        state, commands, inside = self._shown
        if state is not None:
            self._show(state, commands, inside)

    def _warnings(self, state: ProcedureState) -> list[str]:
        """Say what the chosen throw would run into by the plan, and where to stop for it."""
        number_of = self.throw.currentIndex()
        if state.samples or not 0 <= number_of < len(state.plans):
            return []
        plan = state.plans[number_of]
        words = tr(
            "By the plan: stop {depth:.0f} mm deep for {mm:.0f} mm of lesion",
            depth=plan.stop_mm,
            mm=plan.lesion_mm,
        )
        return [words, *(f"▲ {translated(hit.sentence)}" for hit in plan.hits)]

    def _enable(self, possible: set[Step], has_next: bool = False) -> None:
        self.next.setEnabled(has_next)
        self.fire.setEnabled(Step.FIRE in possible)
        self._follow_buttons()

    def _setting(self) -> tuple[int, float]:
        return max(0, self.throw.currentIndex()), float(self.notch.currentData())

    def _prepare(self) -> None:
        self.fire.clicked.connect(lambda: self._ask(Step.FIRE))
        self.fire.setText(tr("Fire the gun (Ctrl+J)"))
        self.fire.setToolTip(
            literal(tr("The gun's needle runs ahead by its throw and brings back a core"))
        )
        self.throw.setToolTip(tr("How far the gun's needle runs ahead of the outer needle's tip"))
        self.throw.currentIndexChanged.connect(lambda _: self._show_again())
        self.notch.setToolTip(
            tr("To which side the notch is open, as on a clock seen from the hub: 12 is the front")
        )
        self.throw.setAccessibleName(tr("Throw"))
        self.notch.setAccessibleName(tr("Notch"))
        for hour, turned in zip((12, 3, 6, 9), CLOCK, strict=True):
            self.notch.addItem(tr("{hour} o'clock", hour=hour), turned)
        for box in (self.throw, self.notch):
            box.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self._key("Ctrl+J", self.fire)
        self._offer_other(None)
        self._enable(set())

    def set_narrow(self, narrow: bool) -> None:
        """Suit a rail, or a panel of the usual width."""
        grid = self._grid
        for title in self._titles:
            title.setVisible(not narrow)
        if narrow:
            grid.addWidget(self.throw, 0, 0)
            grid.addWidget(self.notch, 0, 1)
        else:
            for row, (title, box) in enumerate(
                zip(self._titles, (self.throw, self.notch), strict=True)
            ):
                grid.addWidget(title, row, 0)
                grid.addWidget(box, row, 1)
        grid.setColumnStretch(0, int(narrow))
        grid.setColumnStretch(1, 1)

    def _lay_out(self) -> None:
        self._settings = QWidget(self)
        self._titles = tuple(PlainLabel(words, self) for words in (tr("Throw"), tr("Notch")))
        self._grid = grid = QGridLayout(self._settings)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setVerticalSpacing(4)
        for widget in (
            self.held,
            self.next,
            self._settings,
            self.fire,
            self.other,
            self.results,
        ):
            self._column.addWidget(widget)
        self.set_narrow(False)


def _words(step: Step | None) -> str:
    return shared_words(step) or {
        Step.TAKE_NEEDLE: tr("Take the outer needle (J)"),
        Step.STYLET_OUT: tr("Stylet out (J)"),
        Step.GUN_IN: tr("Gun in (J)"),
        Step.GUN_OUT: tr("Gun out (J)"),
        Step.STYLET_IN: tr("Stylet in (J)"),
    }.get(step or Step.FIRE, tr("Next step (J)"))


def _results(state: ProcedureState) -> list[str]:
    """Say what was given and taken, a line each."""
    lines = shared_results(state)
    if state.deposits:
        lines.append(tr("Local anaesthetic given: {n}×", n=state.deposits))
    biopsy = state.part.biopsy
    least = 0.0 if biopsy is None else biopsy.diagnostic_mm
    for count, sample in enumerate(state.samples, start=1):
        lines.append(_sample_words(count, sample, least))
    return lines


def _sample_words(count: int, sample: SampleMark, least_mm: float) -> str:
    words = (
        tr("✔ Sample {n}: {mm:.1f} mm of lesion", n=count, mm=sample.lesion_mm)
        if sample.is_diagnostic
        else tr(
            "✖ Sample {n}: {mm:.1f} mm of lesion, {least:g} mm are needed",
            n=count,
            mm=sample.lesion_mm,
            least=least_mm,
        )
    )
    hits = "".join(f"\n▲ {translated(hit)}" for hit in sample.hits)
    return words + hits


class ComplicationPanel(KeyedPanel):
    """Shows the patient's vital signs and offers the answers; hidden where nothing can happen.

    Signals:
        noticed(): something is wrong.
        answered(Reaction): this is done about it.
    """

    noticed = Signal()
    answered = Signal(object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._shown: tuple[ComplicationsState | None, bool] = None, False
        self.vitals, self.given = PlainLabel(self), PlainLabel(self)
        self.notice, self.answer = step_button(), step_button()
        self.choice = QComboBox(self)
        self._prepare()
        self._lay_out()
        self.hide()

    def show_patient(self, state: ComplicationsState | None, commands: bool) -> None:
        """Show how the patient is, or nothing.

        Args:
            state: what can be seen of him; None where nothing can happen.
            commands: whether something can be answered now.
        """
        self.setVisible(state is not None)
        if (state, commands) == self._shown:
            return
        self._shown = state, commands
        self._enable(state is not None and commands)
        if state is None:
            return
        self.vitals.setText(translated(state.vitals.sentence))
        self.given.setText("\n".join(translated(answer) for answer in state.answers))
        self.given.setVisible(bool(state.answers))

    def _enable(self, can_be: bool) -> None:
        for widget in (self.notice, self.answer, self.choice):
            widget.setEnabled(can_be)
        self._follow_buttons()

    def _prepare(self) -> None:
        self.vitals.setWordWrap(True)
        self.given.setWordWrap(True)
        self.vitals.setToolTip(tr("What the monitor shows, and what the patient says"))
        # A rail has no room for the keys: they stand in the tips.
        wrong, answer = tr("Something is wrong (Shift+J)"), tr("Do this (Ctrl+Shift+J)")
        self.notice.setText(wrong)
        hint = tr("Say it as soon as you see it: the time counts")
        self.notice.setToolTip(literal(f"{wrong}\n{hint}"))
        self.answer.setText(answer)
        self.answer.setToolTip(literal(f"{answer}\n{tr('Do what is chosen here')}"))
        self.choice.setAccessibleName(tr("What is to be done"))
        self.choice.setToolTip(tr("What is to be done about a complication, by its size"))
        self.choice.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        # A rail is narrower than the longest answer; the open list shows it whole.
        self.choice.setSizeAdjustPolicy(
            QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon
        )
        self.choice.setMinimumContentsLength(8)
        for answer in Reaction:
            self.choice.addItem(translated(ANSWER_WORDS[answer]), answer)
        self.choice.currentTextChanged.connect(lambda words: self.choice.setToolTip(literal(words)))
        widest = self.choice.view().sizeHintForColumn(0)
        self.choice.view().setMinimumWidth(widest + 2 * theme.SPACING)
        self.notice.clicked.connect(self.noticed)
        self.answer.clicked.connect(lambda: self.answered.emit(self.choice.currentData()))
        self._key("Shift+J", self.notice)
        self._key("Ctrl+Shift+J", self.answer)
        self._enable(False)

    def _lay_out(self) -> None:
        title = PlainLabel(tr("Patient"), self)
        title.setProperty("role", "heading")
        for widget in (title, self.vitals, self.notice, self.choice, self.answer, self.given):
            self._column.addWidget(widget)
