"""Steps of a procedure in an attempt: which may follow which, what is kept, what scoring reads."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.events import Event
from app.core.transform import RigidTransform
from app.exercises.procedure import (
    AnaestheticPart,
    BiopsyPart,
    ChecklistPart,
    ProcedurePart,
    RolloverPart,
    ThrowPart,
)
from app.imaging.field import TissueField, TissueKind
from app.session.errors import ProcedureNotPossibleError
from app.session.procedure import (
    KIND,
    NeedleNow,
    ProcedureState,
    Step,
    ToolInHand,
    begin_data,
    perform,
)
from app.session.procedure_marks import marks_of
from app.session.scripted_steps import ScriptedSteps
from app.simulation.procedure_script import StopPhase
from tests.field_rig import ball, beyond, field_of_shapes

TARGET = np.array([20.0, 40.0, 20.0])
WHOLE = ProcedurePart(anaesthetic=AnaestheticPart(most_deposits=2), biopsy=BiopsyPart())
SAMPLE = (Step.STYLET_OUT, Step.GUN_IN, Step.FIRE, Step.GUN_OUT, Step.STYLET_IN)


def patient(kind: TissueKind = TissueKind.LUNG) -> TissueField:
    """Return skin from y = 2, lung from y = 20, a nodule of 12 mm in it at y = 40 [mm]."""
    return field_of_shapes(
        [
            (TissueKind.MUSCLE, "", beyond((0.0, 1.0, 0.0), 2.0)),
            (kind, "", beyond((0.0, 1.0, 0.0), 20.0)),
            (TissueKind.ORGAN, "lung nodule", ball(TARGET, 6.0)),
        ],
        (0.0, 0.0, 0.0),
        (41, 81, 41),
    )


FIELD = patient()
PLACED: Any = SimpleNamespace(  # the patient lies in the robot's frame as in his own
    T_world_patient=RigidTransform.identity(),
    p_target=TARGET * 1e-3,
    p_entry=np.array([0.020, 0.002, 0.020]),
)


def needle(
    depth_mm: float, *, measured: bool = True, aside_mm: float = 0.0, shift_mm: float = 0.0
) -> NeedleNow:
    """Return a needle straight in from the skin at y = 2 mm; the target moved along z."""
    tip = np.array([20.0 + aside_mm, 2.0 + depth_mm, 20.0]) * 1e-3
    target = PLACED.p_target + np.array([0.0, 0.0, shift_mm * 1e-3])
    return NeedleNow(tip, np.array([0.0, 1.0, 0.0]), depth_mm * 1e-3, target, measured)


def done(state: ProcedureState, step: Step, look: NeedleNow, **how: Any) -> tuple[Any, Event]:
    """Do a step; return how it stands and the event of it."""
    time, field = how.pop("time", 1.0), how.pop("field", FIELD)
    state, words, data = perform(state, step, look, PLACED, field, time=time, **how)
    return state, Event(time, KIND, words, data)


def samples(until: float = 100.0) -> Any:
    """Return samples with the tip in the body from 10 s on."""
    time = np.arange(0.0, until, 0.1)
    return SimpleNamespace(time=time, depth=np.where(time >= 10.0, 0.03, -0.01))


def test_a_whole_biopsy_runs_in_its_order() -> None:
    state = ProcedureState.at_begin(WHOLE)
    assert state.tool is ToolInHand.ANAESTHETIC
    state, _ = done(state, Step.INJECT, needle(16.0))
    state, _ = done(state, Step.TAKE_NEEDLE, needle(-5.0))
    for step in SAMPLE * 2:
        assert step in state.possible
        state, _ = done(state, step, needle(26.0))
    assert state.tool is ToolInHand.STYLET
    assert (state.deposits, len(state.samples)) == (1, 2)
    assert all(one.is_diagnostic for one in state.samples)


def test_without_local_anaesthetic_the_outer_needle_is_held_from_the_beginning() -> None:
    state = ProcedureState.at_begin(ProcedurePart(biopsy=BiopsyPart()))
    assert state.tool is ToolInHand.STYLET
    assert Step.INJECT not in state.possible
    assert Step.TAKE_NEEDLE not in state.possible


@pytest.mark.parametrize(
    ("steps", "refused", "depth_mm", "words"),
    [
        ((), Step.FIRE, 16.0, "held is the needle for local anaesthetic"),
        ((), Step.TAKE_NEEDLE, 16.0, "still in the body: draw it out first"),
        ((), Step.INJECT, -2.0, "outside the skin: insert it first"),
        ((Step.INJECT, Step.INJECT), Step.INJECT, 16.0, "empty after 2 times"),
        ((Step.TAKE_NEEDLE,), Step.FIRE, 20.0, "held is the outer needle with its stylet"),
        ((Step.TAKE_NEEDLE,), Step.STYLET_OUT, -1.0, "outside the skin"),
        ((Step.TAKE_NEEDLE, Step.STYLET_OUT), Step.STYLET_OUT, 20.0, "open to air"),
        ((Step.TAKE_NEEDLE, *SAMPLE[:3]), Step.FIRE, 20.0, "the biopsy gun, fired"),
    ],
)
def test_what_cannot_follow_is_refused_in_words_and_changes_nothing(
    steps: tuple[Step, ...], refused: Step, depth_mm: float, words: str
) -> None:
    state = ProcedureState.at_begin(WHOLE)
    for step in steps:
        state, _ = done(state, step, needle(-5.0 if step is Step.TAKE_NEEDLE else 16.0))
    with pytest.raises(ProcedureNotPossibleError, match=words):
        done(state, refused, needle(depth_mm))


def test_where_nobody_sees_the_needle_nothing_is_done() -> None:
    state = ProcedureState.at_begin(WHOLE)
    with pytest.raises(ProcedureNotPossibleError, match="not measured now"):
        done(state, Step.INJECT, needle(16.0, measured=False))
    with pytest.raises(ProcedureNotPossibleError, match="not measured now"):
        perform(state, Step.INJECT, None, PLACED, FIELD)


def test_where_no_field_tells_a_sample_cannot_be_taken() -> None:
    state = ProcedureState.at_begin(ProcedurePart(biopsy=BiopsyPart()))
    for step in SAMPLE[:2]:
        state, _, _ = perform(state, step, needle(26.0), PLACED, None)
    with pytest.raises(ProcedureNotPossibleError, match="use tissue: field"):
        perform(state, Step.FIRE, needle(26.0), PLACED, None)


def test_so_many_samples_and_no_more() -> None:
    state = ProcedureState.at_begin(ProcedurePart(biopsy=BiopsyPart(most_samples=1)))
    for step in SAMPLE:
        state, _ = done(state, step, needle(26.0))
    state, _ = done(state, Step.STYLET_OUT, needle(26.0))
    with pytest.raises(ProcedureNotPossibleError, match="the exercise allows no more"):
        done(state, Step.GUN_IN, needle(26.0))


def test_a_setting_of_the_gun_that_is_none_is_refused() -> None:
    state = ProcedureState.at_begin(ProcedurePart(biopsy=BiopsyPart()))
    for step in SAMPLE[:2]:
        state, _ = done(state, step, needle(26.0))
    with pytest.raises(ProcedureNotPossibleError, match="setting 7 of the gun: there are 0 to 1"):
        done(state, Step.FIRE, needle(26.0), throw=7)


def test_the_deposit_tells_how_far_short_of_the_pleura_it_was() -> None:
    """The pleura lies 18 mm beyond the skin."""
    state = ProcedureState.at_begin(WHOLE)
    for depth_mm, gap_mm in ((16.0, 2.0), (20.5, -2.5)):
        state, event = done(state, Step.INJECT, needle(depth_mm))
        assert event.data["gap_mm"] == pytest.approx(gap_mm, abs=0.1)


def test_a_sample_is_of_the_lesion_where_the_breath_has_it() -> None:
    """The lesion went 5 mm with the breath: the needle that goes where it was brings less of it."""
    liver = patient(TissueKind.ORGAN)
    still, moved = (
        done(_cocked(), Step.FIRE, needle(32.0, shift_mm=shift), field=liver)[0]
        .samples[-1]
        .lesion_mm
        for shift in (0.0, 5.0)
    )
    assert still == pytest.approx(12.0, abs=0.3)
    assert moved == pytest.approx(2.0 * np.sqrt(6.0**2 - 5.0**2), abs=0.5)


def _cocked() -> ProcedureState:
    state = ProcedureState.at_begin(ProcedurePart(biopsy=BiopsyPart()))
    for step in SAMPLE[:2]:
        state, _ = done(state, step, needle(26.0))
    return state


def test_scoring_reads_the_steps_back_from_the_record() -> None:
    state, events = ProcedureState.at_begin(WHOLE), []
    events.append(Event(0.0, KIND, state.words, begin_data(state)))
    plan = [(Step.INJECT, 12.0, 16.0), (Step.TAKE_NEEDLE, 20.0, -5.0)]
    plan += [(step, 40.0 + n, 26.0) for n, step in enumerate(SAMPLE)]
    for step, time, depth in plan:
        state, event = done(state, step, needle(depth), time=time)
        events.append(event)
    marks = marks_of(events, samples(), ())
    assert marks is not None
    assert [one.gap_mm for one in marks.deposits] == pytest.approx([2.0], abs=0.1)
    assert marks.samples == state.samples
    assert marks.needle_from == 20.0
    assert marks.open_s == pytest.approx(2.0, abs=0.2), "stylet to gun, gun to stylet: 1 s each"


def test_a_hub_left_open_counts_until_the_end_and_only_in_the_body() -> None:
    events = [Event(5.0, KIND, "", {"step": "stylet_out"})]
    marks = marks_of(events, samples(30.0), None)
    assert marks is not None
    assert marks.open_s == pytest.approx(20.0, abs=0.2)


def test_a_needle_that_was_never_taken_counts_for_nothing() -> None:
    state = ProcedureState.at_begin(WHOLE)
    events = [Event(0.0, KIND, "", begin_data(state))]
    marks = marks_of(events, samples(), ())
    assert marks is not None
    assert marks.needle_from == np.inf


def test_a_record_without_steps_has_none_and_damaged_ones_are_left_out() -> None:
    assert marks_of([Event(0.0, "scan", "", {})], samples(), ()) is None
    odd = [
        Event(1.0, KIND, "", {"step": "inject", "depth_mm": "deep", "gap_mm": None}),
        Event(2.0, KIND, "", {"step": "fire"}),
        Event(2.5, KIND, "", {"step": "fire", "lesion_mm": float("nan"), "hits": []}),
        Event(3.0, KIND, "", {"step": 7}),
        Event(4.0, KIND, "", {"step": "inject", "depth_mm": 16.0, "gap_mm": None}),
    ]
    marks = marks_of(odd, samples(), ())
    assert marks is not None
    assert [one.time for one in marks.deposits] == [4.0]
    assert marks.samples == ()


@settings(max_examples=60, deadline=None)
@given(
    st.lists(
        st.tuples(st.sampled_from(list(Step)), st.floats(-20.0, 70.0), st.booleans()), max_size=25
    )
)
def test_whatever_is_asked_in_whatever_order_is_done_or_refused_by_name(
    asked: list[tuple[Step, float, bool]],
) -> None:
    state = ProcedureState.at_begin(WHOLE)
    for step, depth_mm, measured in asked:
        before = state
        try:
            state, _ = done(state, step, needle(depth_mm, measured=measured))
        except ProcedureNotPossibleError as error:
            words = str(error)
            assert state is before, words
        assert len(state.samples) <= BiopsyPart().most_samples
        assert state.deposits <= 2
        assert all(np.isfinite(one.lesion_mm) for one in state.samples)


def test_an_exercise_names_what_is_wrong_with_its_procedure() -> None:
    for part, words in (
        ({}, "names no step"),
        ({"biopsy": {"diagnostic_mm": 30}}, "more than the longest notch holds"),
        ({"biopsy": {"throws": []}}, "at least 1"),
        ({"biopsy": {"throws": [{"throw_mm": 10, "notch_mm": 9, "dead_tip_mm": 4}]}}, "longer"),
    ):
        with pytest.raises(ValueError, match=words):
            ProcedurePart.model_validate(part)
    assert ThrowPart(throw_mm=20, notch_mm=14, dead_tip_mm=6).throw().notch_span_mm == (0.0, 14.0)


TURNED = WHOLE.model_copy(update={"checklist": ChecklistPart(inr=1.1), "rollover": RolloverPart()})


def through_one_sample(state: ProcedureState) -> tuple[ProcedureState, list[Event]]:
    events = [Event(0.0, KIND, "", begin_data(state))]
    moments = [(Step.INJECT, 16.0, 12.0), (Step.TAKE_NEEDLE, -5.0, 14.0)]
    moments += [(step, 26.0, 20.0 + n) for n, step in enumerate(SAMPLE)]
    for step, depth, time in moments:
        state, event = done(state, step, needle(depth), time=time)
        events.append(event)
    return state, events


def test_consent_and_coagulation_count_only_before_any_needle() -> None:
    state = ProcedureState.at_begin(TURNED)
    assert state.checks_left
    state, first = done(state, Step.CONSENT, needle(-5.0), time=3.0)
    assert "held is" not in state.refusal(Step.COAGULATION)
    state, late = done(state, Step.COAGULATION, needle(16.0), time=15.0)
    assert "INR 1.1 (at most 1.8), platelets 230" in late.message
    assert late.data["inr"] == 1.1
    assert not state.checks_left
    with pytest.raises(ProcedureNotPossibleError, match="checked already"):
        done(state, Step.CONSENT, needle(-5.0))
    begin = Event(0.0, KIND, "", begin_data(ProcedureState.at_begin(TURNED)))
    for events, share in (([first, late], 0.5), ([first], 0.5), ([], 0.0)):
        marks = marks_of([begin, *events], samples(), ())
        assert marks is not None
        assert marks.checked == share


def test_the_patient_is_turned_after_a_sample_with_the_needle_out_and_once() -> None:
    state = ProcedureState.at_begin(TURNED)
    with pytest.raises(ProcedureNotPossibleError, match="no sample was taken"):
        done(state, Step.ROLL_OVER, needle(-5.0))
    state, events = through_one_sample(state)
    with pytest.raises(ProcedureNotPossibleError, match="still in the body: draw it out"):
        done(state, Step.ROLL_OVER, needle(20.0))
    state, turned = done(state, Step.ROLL_OVER, needle(-5.0), time=70.0)
    for step in (Step.STYLET_OUT, Step.ROLL_OVER):
        with pytest.raises(ProcedureNotPossibleError, match="was turned"):
            done(state, step, needle(-5.0))
    time = np.arange(0.0, 100.0, 0.1)
    inside = (time >= 10.0) & (time < 60.0)
    seen: Any = SimpleNamespace(time=time, depth=np.where(inside, 0.03, -0.01))
    marks = marks_of([*events, turned], seen, ())
    assert marks is not None
    assert marks.turning is not None
    assert marks.turning.wait == pytest.approx(10.0, abs=0.11)
    assert marks.turning.last == pytest.approx(22.0)
    never = marks_of(events, seen, ())
    assert never is not None
    assert never.turning is not None
    assert never.turning.wait == 600.0


def test_an_exercise_without_checklist_and_turning_keeps_nothing_of_them() -> None:
    state = ProcedureState.at_begin(WHOLE)
    assert set(begin_data(state)) == {"version", "step", "tool", "plans"}
    assert not state.checks_left
    for step, words in (
        (Step.CONSENT, "has no checklist"),
        (Step.ROLL_OVER, "the patient is not turned"),
    ):
        assert words in state.refusal(step)
    _, events = through_one_sample(state)
    marks = marks_of(events, samples(), ())
    assert marks is not None
    assert marks.turning is None


def test_a_script_tries_the_checklist_again_until_the_attempt_has_begun() -> None:
    steps, done_at = ScriptedSteps(TURNED), list[tuple[float, Step]]()

    def act(step: Step, throw: int, deg: float, now: float) -> ProcedureState:
        if now < 5.0:
            raise ProcedureNotPossibleError("not begun")
        done_at.append((now, step))
        return ProcedureState.at_begin(TURNED)

    for now in np.arange(0.0, 20.0, 0.1).tolist():
        phase = 1.0 if now < 12.0 else float(StopPhase.INJECT)
        steps.look(phase, now, lambda *how, now=now: act(*how, now))
    assert [step for _, step in done_at] == [Step.CONSENT, Step.COAGULATION, Step.INJECT]
    assert 5.0 <= done_at[0][0] < 6.5
