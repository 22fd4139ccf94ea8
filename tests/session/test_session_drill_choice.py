"""Drills: which one an attempt calls for, what it keeps of its exercise, and how it ends."""

import json
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from session_fakes import EXERCISE, placed_plan
from test_session_reasons import BACK, HEAD, LEFT, evidence, pushed, recorded
from test_session_reasons import ENTRY_MM as ENTRY

from app.compose.run_context import conditions_of as metadata_of
from app.exercises.drill import ROUND_S, THROUGH_S, DrillKind, DrillPart, asks
from app.exercises.drilled import drilled
from app.exercises.guidance import FadingKind, FadingPart, Purpose
from app.exercises.library import load_exercise
from app.exercises.schema import Exercise
from app.scoring.conditions import Conditions, comparable
from app.scoring.result import judge
from app.scoring.rows import Row, ScoreRules
from app.scoring.score import score
from app.scoring.tolerance import Tolerance
from app.session.beginnings import Beginnings
from app.session.drill_choice import drill_for, exercise_in
from app.session.next_exercise import ProposalReason, _whole
from app.session.scored import trajectory


def lost(metric, value=9.0):
    """Score in which one metric alone cost points."""
    bands = Tolerance.model_validate({"expert": 1.0, "good": 2.0, "pass": 4.0, "weight": 1.0})
    return judge((Row(metric, metric, "", value, "", bands, 0.0),), ScoreRules())


STRAIGHT = evidence(*pushed(lambda _: 0.0 * HEAD))
ASKEW = evidence(*pushed(lambda d: np.tan(np.radians(4.0)) * d * LEFT))
BENT_LATE = evidence(*pushed(lambda d: 5.0 * LEFT if d > 40.0 else 0.0 * LEFT))
WHOLE = Exercise(id="liver-01", title="Liver")


def breathing():
    time = np.arange(0.0, 60.0, 0.05)
    tips = ENTRY + np.linspace(0.0, 60.0, len(time))[:, None] * BACK
    moved = np.tile(8.0 * HEAD, (len(time), 1))
    return evidence(*recorded(time + 7.0, ["inserting"] * len(time), tips, shift_mm=moved))


@pytest.mark.parametrize(
    ("metric", "past", "kind"),
    [
        ("lateral_error", ASKEW, DrillKind.ALIGN),
        ("lateral_error", BENT_LATE, DrillKind.REPEAT),
        ("angle_at_skin", STRAIGHT, DrillKind.ALIGN),
        ("depth_error", STRAIGHT, DrillKind.DEPTH),
        ("depth_error", breathing(), DrillKind.BREATH),
        ("lateral_error", breathing(), DrillKind.BREATH),
        ("total_time", STRAIGHT, DrillKind.REPEAT),
        ("control_scans", ASKEW, DrillKind.REPEAT),
    ],
)
def test_the_drill_is_of_what_cost_most(metric, past, kind):
    assert drill_for(lost(metric), past, WHOLE) is kind


def test_no_drill_where_nothing_was_lost_or_judged_and_none_of_an_assessment():
    assert drill_for(None, ASKEW, WHOLE) is None
    assert drill_for(lost("depth_error", 0.5), ASKEW, WHOLE) is None
    assert drill_for(lost("depth_error"), ASKEW, None) is None
    exam = WHOLE.model_copy(update={"purpose": Purpose.ASSESSMENT})
    assert drill_for(lost("depth_error"), ASKEW, exam) is None


@pytest.mark.parametrize("kind", list(DrillKind))
def test_a_drill_keeps_patient_and_plan_and_is_read_again_from_its_record(kind):
    whole, placed = load_exercise("first-insertion"), placed_plan()
    drill = drilled(whole, kind, placed)
    assert drill.ct == whole.ct
    assert drill.plan.entry_mm == pytest.approx(tuple(placed.plan.entry_mm))
    assert drill.plan.target_mm == pytest.approx(tuple(placed.plan.target_mm))
    document = drill.model_dump(mode="json")
    assert Exercise.model_validate(document).drill == drill.drill
    recording = SimpleNamespace(attachments={"exercise.json": json.dumps(document).encode()})
    assert exercise_in(recording).drill == DrillPart(
        kind=kind, of="first-insertion", version=whole.version
    )
    again = drilled(drill, kind, placed)
    assert (again.id, again.drill) == (drill.id, drill.drill)


@pytest.mark.parametrize("kind", list(DrillKind))
def test_what_a_drill_says_of_forbidden_tissue_is_so(kind):
    whole = load_exercise("first-insertion")
    rules = whole.rules.model_copy(update={"forbidden": ("bone",)})
    strict = whole.model_copy(update={"rules": rules})
    forbids = drilled(strict, kind, placed_plan()).rules.forbidden == ("bone",)
    assert forbids is (kind is not DrillKind.ALIGN)
    if kind is not DrillKind.REPEAT:  # which is judged as the whole exercise is
        for aligned in (False, True):
            assert ("nothing may be met" in asks(kind, aligned)) is forbids


@pytest.mark.parametrize("kind", [DrillKind.ALIGN, DrillKind.DEPTH, DrillKind.BREATH])
def test_only_what_is_practised_counts(kind):
    drill = drilled(load_exercise("first-insertion"), kind, placed_plan())
    counted = [name for name, bands in drill.tolerances.items() if bands.weight > 0.0]
    names = {"align": "angle_at_skin", "depth": "depth_error", "breath": "breath_offset"}
    assert counted == [names[kind]]
    required = [name for name, bands in drill.tolerances.items() if bands.required]
    assert required == counted


def test_ten_times_three_minutes_are_judged_as_the_whole_exercise():
    whole = load_exercise("first-insertion")
    assert drilled(whole, DrillKind.REPEAT, placed_plan()).tolerances == whole.tolerances


def test_a_drill_is_another_exercise_than_the_whole_one_and_counts_nowhere_of_it():
    whole = load_exercise("first-insertion")
    drill = drilled(whole, DrillKind.DEPTH, placed_plan())
    assert drill.id != whole.id
    assert metadata_of(drill)["drill"] == "depth"
    assert "drill" not in metadata_of(whole)
    plain = Conditions("liver-01", scoring_version=7)
    assert "drill" not in plain.document()
    practised = replace(plain, exercise=drill.id, drill="depth")
    assert Conditions.of(practised.document()) == practised
    assert comparable(plain, practised)


def test_a_damaged_exercise_in_a_record_is_none():
    for text in (b"{}", b"[]", b"no json", b'{"id": 3}'):
        assert exercise_in(SimpleNamespace(attachments={"exercise.json": text})) is None
    assert exercise_in(SimpleNamespace(attachments={})) is None


def test_aligning_alone_ends_just_after_the_skin_and_three_minutes_end_a_round():
    align = DrillPart(kind="align", of="liver-01")
    assert not align.is_over(False, 99.0, 99.0)
    assert not align.is_over(True, 0.5 * THROUGH_S, 99.0)
    assert align.is_over(True, THROUGH_S, 99.0)
    repeat = DrillPart(kind="repeat", of="liver-01")
    assert not repeat.is_over(True, 99.0, ROUND_S - 0.1)
    assert repeat.is_over(False, 0.0, ROUND_S)
    for kind in ("depth", "breath"):
        assert not DrillPart(kind=kind, of="liver-01").is_over(True, 1e4, 1e4)


def test_the_depth_alone_begins_on_the_path_and_the_rest_off_it():
    placed = placed_plan()
    on = Beginnings(3, 2, np.radians(30.0), aligned=True).next(placed)
    off = Beginnings(3, 2, np.radians(30.0)).next(placed)
    assert (on.x, on.y) == pytest.approx(tuple(placed.axis[:2]))
    assert np.hypot(off.x, off.y) > np.sin(np.radians(7.9))
    assert (on.level, on.seed) == (off.level, off.seed)  # the hand is as unsteady


def test_the_breath_of_a_push_is_the_mean_over_the_way_not_over_the_time():
    # 20 mm in the first 40 s while the target is away by 8 mm, 40 mm in 20 s while it is in place
    time = np.arange(0.0, 60.0, 0.05)
    depth = np.where(time < 40.0, 0.5 * time, 20.0 + 2.0 * (time - 40.0))
    moved = np.where((time < 40.0)[:, None], 8.0 * HEAD, 0.0 * HEAD)
    tips = ENTRY + depth[:, None] * BACK
    states = ["inserting"] * (len(time) - 1) + ["ended"]
    samples, placed = recorded(time, states, tips, shift_mm=moved)
    limits = {"expert": 1.0, "good": 2.0, "pass": 3.0}
    made = score(
        trajectory(samples, placed), {"breath_offset": Tolerance.model_validate(limits)}
    ).row("breath_offset")
    assert made.value == pytest.approx(8.0 * 20.0 / 60.0, rel=0.01)
    still = trajectory(replace(samples, target=samples.target * 0.0 + placed.p_target), placed)
    assert "breath_offset" not in {row.name for row in score(still).rows}


def test_after_a_drill_comes_the_whole_exercise_if_it_may_be_begun():
    whole = load_exercise("first-insertion")
    ahead = _whole("first-insertion", [whole], lambda _: "", 3)
    assert (ahead.reason, ahead.exercise, ahead.tries) == (ProposalReason.WHOLE, whole.id, 3)
    assert _whole("first-insertion", [whole], lambda _: "no", 3).exercise == ""
    assert EXERCISE.drill is None


def test_a_drill_of_an_assessment_or_of_fading_help_is_plain_practice():
    fading = FadingPart(kind=FadingKind.PERFORMANCE)
    changes = {"purpose": Purpose.ASSESSMENT, "fading": fading}
    whole = load_exercise("first-insertion").model_copy(update=changes)
    for kind in DrillKind:
        drill = drilled(whole, kind, placed_plan())
        assert (drill.purpose, drill.fading) == (Purpose.PRACTICE, None)


def test_the_breath_is_judged_by_what_is_expert_across_the_path():
    bands = Tolerance.model_validate({"expert": 3.0, "good": 4.0, "pass": 8.0})
    whole = load_exercise("first-insertion").model_copy(
        update={"tolerances": {"lateral_error": bands}}
    )
    judged = drilled(whole, DrillKind.BREATH, placed_plan()).tolerances["breath_offset"]
    assert (judged.expert, judged.good, judged.pass_) == (1.5, 3.0, 4.5)


def test_aligning_alone_keeps_pass_mark_and_pauses_of_the_rules_and_no_other_rule():
    rules = ScoreRules(
        pass_mark=71.0, minimum_tracking=90.0, maximum_pause=12.0, forbidden=("bone",)
    )
    whole = load_exercise("first-insertion").model_copy(update={"rules": rules})
    assert drilled(whole, DrillKind.ALIGN, placed_plan()).rules == ScoreRules(
        pass_mark=71.0, minimum_tracking=0.0, maximum_pause=12.0
    )
    assert drilled(whole, DrillKind.DEPTH, placed_plan()).rules == rules


def test_what_a_plan_cost_is_practised_by_planning_and_no_drill_asks_for_it():
    whole = load_exercise("plan-it-yourself")
    assert drill_for(lost("plan_score"), STRAIGHT, whole) is None
    for kind in DrillKind:
        assert "plan_score" not in drilled(whole, kind, placed_plan()).tolerances
