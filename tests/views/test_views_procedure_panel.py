"""The steps of a procedure in the panel: what the key does next, what is told."""

from typing import Any

import pytest

from app.exercises.procedure import (
    AnaestheticPart,
    BiopsyPart,
    ChecklistPart,
    ProcedurePart,
    RolloverPart,
)
from app.imaging.field.tissue_field import TissueKind
from app.planning.sampling import Ahead, SamplePlan
from app.scoring.procedure import SampleMark
from app.session.procedure import ProcedureState, Step, ToolInHand
from app.session.snapshot import NextStep, StepKind
from app.views.exercise.procedure_panel import ProcedurePanel
from app.views.exercise.steps import step_words

PART = ProcedurePart(anaesthetic=AnaestheticPart(), biopsy=BiopsyPart())


def state(tool: ToolInHand, **more: Any) -> ProcedureState:
    return ProcedureState(PART, tool, **more)


@pytest.fixture
def panel(application: Any) -> ProcedurePanel:
    del application
    made = ProcedurePanel()
    made.seen = []  # type: ignore[attr-defined]
    made.asked.connect(lambda *step: made.seen.append(step))  # type: ignore[attr-defined]
    return made


def test_without_a_procedure_nothing_is_there(panel: ProcedurePanel) -> None:
    panel.show_procedure(None, True)
    assert panel.isHidden()
    assert not panel.next.isEnabled()


@pytest.mark.parametrize(
    ("shown", "inside", "step"),
    [
        (state(ToolInHand.ANAESTHETIC), True, Step.INJECT),
        (state(ToolInHand.ANAESTHETIC, deposits=1), False, Step.TAKE_NEEDLE),
        (state(ToolInHand.STYLET), True, Step.STYLET_OUT),
        (state(ToolInHand.OPEN), True, Step.GUN_IN),
        (state(ToolInHand.GUN), True, Step.GUN_OUT),
        (state(ToolInHand.FIRED, samples=(SampleMark(1.0, 5.0, True),)), True, Step.GUN_OUT),
    ],
)
def test_the_key_does_what_follows_in_the_usual_order(
    panel: ProcedurePanel, shown: ProcedureState, inside: bool, step: Step
) -> None:
    panel.show_procedure(shown, True, inside)
    panel.next.click()
    assert [one[0] for one in panel.seen] == [step]  # type: ignore[attr-defined]


def test_after_a_sample_the_stylet_goes_back_first(panel: ProcedurePanel) -> None:
    sample = (SampleMark(1.0, 5.0, True),)
    panel.show_procedure(state(ToolInHand.FIRED, samples=sample), True, True)
    panel.show_procedure(state(ToolInHand.OPEN, samples=sample), True, True)
    assert panel.next.text() == "Stylet in (J)"


def test_whoever_presses_the_key_at_once_does_not_leave_the_anaesthetic_out(
    panel: ProcedurePanel,
) -> None:
    panel.show_procedure(state(ToolInHand.ANAESTHETIC), True, False)
    assert not panel.next.isEnabled()


def test_nothing_can_be_done_while_the_attempt_waits_or_another_leads(
    panel: ProcedurePanel,
) -> None:
    panel.show_procedure(state(ToolInHand.GUN), False, True)
    assert not panel.next.isEnabled()
    assert not panel.fire.isEnabled()


def test_firing_tells_the_chosen_throw_and_notch(panel: ProcedurePanel) -> None:
    panel.show_procedure(state(ToolInHand.GUN), True, True)
    panel.throw.setCurrentIndex(1)
    panel.notch.setCurrentIndex(3)
    panel.fire.click()
    assert panel.seen == [(Step.FIRE, 1, 270.0)]  # type: ignore[attr-defined]


def test_what_a_throw_would_meet_by_the_plan_is_told_before_it(panel: ProcedurePanel) -> None:
    vessel = Ahead("aorta", TissueKind.VESSEL, 15.0, 5.0)
    plans = tuple(
        SamplePlan(PART.biopsy.throw(n), 60.0 + n, 6.0, hits)  # type: ignore[union-attr]
        for n, hits in enumerate(((vessel,), ()))
    )
    panel.show_procedure(state(ToolInHand.STYLET, plans=plans), True, False)
    assert "stop 60 mm deep" in panel.results.text()
    assert "▲ the throw meets aorta 15.0 mm ahead" in panel.results.text()
    panel.throw.setCurrentIndex(1)
    assert "▲" not in panel.results.text()


def test_each_sample_is_told_by_sign_and_words(panel: ProcedurePanel) -> None:
    samples = (SampleMark(1.0, 9.95, True), SampleMark(2.0, 1.0, False, ("the throw meets rib",)))
    panel.show_procedure(state(ToolInHand.OPEN, samples=samples), True, True)
    first, second, third = panel.results.text().splitlines()
    assert first.startswith("✔ Sample 1: 9.9") or first.startswith("✔ Sample 1: 10.0")
    assert second.startswith("✖ Sample 2: 1.0 mm of lesion, 3 mm are needed")
    assert third == "▲ the throw meets rib"


def test_of_a_long_procedure_the_newest_lines_stand_and_all_are_in_the_tip(
    panel: ProcedurePanel,
) -> None:
    samples = tuple(SampleMark(float(n), float(n), n > 3) for n in range(1, 6))
    panel.show_procedure(state(ToolInHand.OPEN, samples=samples), True, True)
    shown = panel.results.text().splitlines()
    assert len(shown) == 3
    assert shown[-1].startswith("✔ Sample 5")
    assert "Sample 1: 1.0 mm" in panel.results.toolTip()


TOOLS = [tool for tool in ToolInHand if tool is not ToolInHand.ELECTRODE]
"""Of a biopsy; an electrode's words are tried with the ablation."""


def test_every_tool_has_its_order_on_the_line_over_the_views() -> None:
    words = {
        step_words(NextStep(StepKind.PROCEDURE, procedure=state(tool), inside=True), True)
        for tool in TOOLS
    }
    assert len(words) == len(TOOLS)
    given = state(ToolInHand.ANAESTHETIC, deposits=1)
    for inside in (True, False):
        step = NextStep(StepKind.PROCEDURE, procedure=given, inside=inside)
        words.add(step_words(step, True))
    assert len(words) == len(TOOLS) + 2


def test_a_step_is_asked_for_once_however_fast_its_key_is_pressed(panel: ProcedurePanel) -> None:
    """Seen: pressed three times, J told in red "that was checked already"."""
    panel.show_procedure(turned(ToolInHand.ANAESTHETIC), True, None)
    for _ in range(3):
        panel.next.click()
    panel.show_procedure(turned(ToolInHand.ANAESTHETIC, checked=(Step.CONSENT,)), True, None)
    panel.next.click()
    steps = [one[0] for one in panel.seen]  # type: ignore[attr-defined]
    assert steps == [Step.CONSENT, Step.COAGULATION]


def test_before_the_first_movement_the_line_says_what_comes_then() -> None:
    step = NextStep(StepKind.MOVE, procedure=turned(ToolInHand.ANAESTHETIC))
    assert step_words(step, True) == (
        "Ready: the clock starts when you move, or with this: Ask for consent (J)"
    )
    checked = turned(ToolInHand.ANAESTHETIC, checked=(Step.CONSENT, Step.COAGULATION))
    words = step_words(NextStep(StepKind.MOVE, procedure=checked), True)
    assert words.startswith("Ready: the clock starts when you move. Then: Push to just before")


def test_where_control_scans_guide_every_step_can_be_done_by_the_key(panel: ProcedurePanel) -> None:
    tools = (
        state(ToolInHand.ANAESTHETIC),
        state(ToolInHand.ANAESTHETIC, deposits=1),
        state(ToolInHand.STYLET),
        state(ToolInHand.OPEN),
    )
    for shown in tools:
        panel.show_procedure(shown, True, None)
        assert panel.next.isEnabled()
        panel.next.click()
    steps = [Step.INJECT, Step.TAKE_NEEDLE, Step.STYLET_OUT, Step.GUN_IN]
    assert [one[0] for one in panel.seen] == steps  # type: ignore[attr-defined]


def test_where_control_scans_guide_every_order_to_move_names_their_key() -> None:
    for tool in (ToolInHand.ANAESTHETIC, ToolInHand.STYLET):
        for deposits in (0, 1):
            step = NextStep(
                StepKind.PROCEDURE, procedure=state(tool, deposits=deposits), inside=None
            )
            words = step_words(step, True)
            assert words.startswith("By the scans (S): ")
            assert "J" in words or "take the next one" in words


TURNED = PART.model_copy(update={"checklist": ChecklistPart(), "rollover": RolloverPart()})


def turned(tool: ToolInHand, **more: Any) -> ProcedureState:
    return ProcedureState(TURNED, tool, **more)


SAMPLED = (SampleMark(1.0, 5.0, True),)
CHECKED = (Step.CONSENT, Step.COAGULATION)


@pytest.mark.parametrize(
    ("shown", "inside", "step"),
    [
        (turned(ToolInHand.ANAESTHETIC), False, Step.CONSENT),
        (turned(ToolInHand.ANAESTHETIC), None, Step.CONSENT),
        (turned(ToolInHand.ANAESTHETIC, checked=CHECKED[:1]), False, Step.COAGULATION),
        (turned(ToolInHand.ANAESTHETIC, checked=CHECKED), True, Step.INJECT),
        (turned(ToolInHand.STYLET, samples=SAMPLED), True, Step.STYLET_OUT),
        (turned(ToolInHand.STYLET, samples=SAMPLED), False, Step.ROLL_OVER),
    ],
)
def test_the_key_does_checklist_and_turning_where_they_belong(
    panel: ProcedurePanel, shown: ProcedureState, inside: bool | None, step: Step
) -> None:
    panel.show_procedure(shown, True, inside)
    panel.next.click()
    assert [one[0] for one in panel.seen] == [step]  # type: ignore[attr-defined]
    assert panel.other.isHidden()


@pytest.mark.parametrize(
    ("shown", "step", "words"),
    [
        (turned(ToolInHand.ANAESTHETIC, deposits=1), Step.INJECT, "Give more (Alt+J)"),
        (turned(ToolInHand.STYLET, samples=SAMPLED), Step.ROLL_OVER, "Turn the patient (Alt+J)"),
        (state(ToolInHand.ANAESTHETIC, deposits=2), Step.INJECT, "Give more (Alt+J)"),
    ],
)
def test_where_scans_guide_another_step_has_a_button_and_a_key_in_the_guns_place(
    panel: ProcedurePanel, shown: ProcedureState, step: Step, words: str
) -> None:
    panel.show_procedure(shown, True, None)
    assert words in panel.other.accessibleName()
    assert panel.fire.isHidden()
    panel.other.click()
    assert [one[0] for one in panel.seen] == [step]  # type: ignore[attr-defined]
    panel.show_procedure(state(ToolInHand.GUN), True, None)
    assert panel.other.isHidden()
    assert not panel.fire.isHidden()


def test_the_other_key_is_dead_where_no_procedure_is_shown(panel: ProcedurePanel) -> None:
    panel.show_procedure(turned(ToolInHand.ANAESTHETIC, deposits=1), True, None)
    assert panel.other.isEnabled()
    panel.show_procedure(None, False)
    assert not panel.other.isEnabled()
    panel.other.click()
    assert panel.seen == []  # type: ignore[attr-defined]


def test_what_was_checked_and_turned_is_told(panel: ProcedurePanel) -> None:
    panel.show_procedure(turned(ToolInHand.STYLET, checked=CHECKED, rolled=True), True, False)
    assert "INR 1 (at most 1.8)" in panel.results.text()
    assert "puncture side down" in panel.results.text()
    assert not panel.next.isEnabled()


@pytest.mark.parametrize(
    ("shown", "inside", "words"),
    [
        (turned(ToolInHand.ANAESTHETIC), False, "Ask for consent (J)"),
        (turned(ToolInHand.ANAESTHETIC, checked=CHECKED[:1]), None, "Check coagulation (J)"),
        (turned(ToolInHand.STYLET, samples=SAMPLED), False, "Turn the patient"),
        (turned(ToolInHand.STYLET, samples=SAMPLED), None, "turn the patient (Alt+J)"),
        (turned(ToolInHand.STYLET, samples=SAMPLED, rolled=True), False, "Enter ends"),
    ],
)
def test_the_line_over_the_views_says_them(
    shown: ProcedureState, inside: bool | None, words: str
) -> None:
    step = NextStep(StepKind.PROCEDURE, procedure=shown, inside=inside)
    assert words in step_words(step, by_mouse=True)


@pytest.mark.parametrize(
    "shown",
    [
        turned(ToolInHand.ANAESTHETIC),
        turned(ToolInHand.ANAESTHETIC, checked=CHECKED[:1]),
        turned(ToolInHand.STYLET, checked=CHECKED, samples=SAMPLED, rolled=True),
    ],
)
def test_no_scan_is_asked_for_where_the_needle_is_not_moved(shown: ProcedureState) -> None:
    step = NextStep(StepKind.PROCEDURE, procedure=shown, inside=None)
    assert "By the scans" not in step_words(step, by_mouse=True)
