"""What comes next after an attempt, and why: only what is true, known to the student, and open."""

import json
from dataclasses import replace
from types import MappingProxyType, SimpleNamespace

import pytest

from app.exercises.drill import DrillPart
from app.exercises.guidance import Purpose
from app.exercises.library import library
from app.scoring.conditions import Conditions, DeviceKind
from app.scoring.result import judge
from app.scoring.rows import Row, ScoreRules
from app.scoring.tolerance import Tolerance
from app.session.board import Standing
from app.session.course import Course, CourseItem, holding
from app.session.index import Indexed
from app.session.next_exercise import (
    TRIES,
    ProposalReason,
    around,
    comes_next,
    held_by,
    propose,
    still_open,
)
from app.session.people import People, Person
from app.session.roster import RosterLine
from app.session.sidecar import write_summary
from app.session.summary import Summary

SEVEN = (
    "first-insertion",
    "thick-tissue",
    "breathing-liver",
    "past-the-vessel",
    "plan-it-yourself",
    "against-repulsion",
    "scans-only",
)
EXERCISES = tuple(one for one in library() if one.id in SEVEN)
ADA = Person("p-0123456789ab", "ada", ("A",))


def score(angle: float, lateral: float = 0.5):
    """A score of two metrics, each of which is expert below 1, and fails above 3."""
    limits = Tolerance.model_validate({"expert": 1, "good": 2, "pass": 3, "required": True})
    rows = (
        Row("angle_error", "Angle error", "°", angle, "", limits),
        Row("lateral_error", "Off the path", "mm", lateral, "", limits),
    )
    return judge(rows, ScoreRules())


def done(exercise, passed, verdict="unsigned"):
    version = next((one.version for one in EXERCISES if one.id == exercise), 1)
    known = Conditions(exercise, 1, kind=DeviceKind.SIMULATED, scoring_version=2)
    total = 90.0 if passed else 40.0
    return Indexed(
        f"{exercise}-{passed}", "2026-11-20T10:00:00+00:00", "ada", exercise, version, "ended",
        30.0, total, passed, verdict, True, json.dumps(known.document()), "{}",
    )  # fmt: skip


def twice(*names):
    """Two passes in a row at each exercise: it is mastered."""
    return [done(name, True) for name in names for _ in range(2)]


def level(name):
    return next(one.level for one in EXERCISES if one.id == name)


def test_what_was_not_passed_is_proposed_again_with_the_metric_that_cost_most():
    found = propose("first-insertion", score(5.0), [done("first-insertion", False)], EXERCISES)
    assert (found.exercise, found.reason) == ("first-insertion", ProposalReason.AGAIN)
    assert found.metric == "Angle error"
    assert found.points == pytest.approx(50.0 * (1.0 - 0.2), abs=10.0)


def test_only_two_passes_in_a_row_lead_on_to_the_easiest_that_is_not_mastered_yet():
    once = propose("first-insertion", score(0.5), [done("first-insertion", True)], EXERCISES)
    assert (once.exercise, once.reason) == ("first-insertion", ProposalReason.CONFIRM)
    before = [done("first-insertion", True), done("first-insertion", False)]
    before.append(done("first-insertion", True))
    apart = propose("first-insertion", score(0.5), before, EXERCISES)
    assert apart.reason is ProposalReason.CONFIRM
    before.append(done("first-insertion", True))
    found = propose("first-insertion", score(0.5), before, EXERCISES)
    assert found.reason is ProposalReason.LEVEL
    assert found.level == min(one.level for one in EXERCISES if one.id != "first-insertion")
    further = [*before, *twice(found.exercise)]
    after = propose("first-insertion", score(0.5), further, EXERCISES)
    assert after.exercise not in ("first-insertion", found.exercise)


def test_passes_of_an_earlier_version_master_nothing():
    before = [replace(one, version=1) for one in twice("first-insertion")]
    found = propose("first-insertion", score(0.5), before, EXERCISES)
    assert found.reason is ProposalReason.CONFIRM


def test_a_research_machine_follows_from_no_lesson():
    machine = next(one for one in library() if one.id == "tensegrity-liver")
    some = sorted((*EXERCISES, machine), key=lambda one: one.level)
    found = propose("first-insertion", score(0.5), twice("first-insertion"), some)
    assert found.exercise == "thick-tissue"
    assert machine not in still_open(some, None, ())
    assert machine in still_open(some, course("tensegrity-liver"), ())


def test_of_equally_hard_ones_the_one_that_judges_what_cost_most_is_proposed():
    easier = [one.id for one in EXERCISES if one.level < 4]
    before = twice(*easier, "breathing-liver")
    found = propose("breathing-liver", score(2.5), before, EXERCISES)
    chosen = next(one for one in EXERCISES if one.id == found.exercise)
    assert found.reason is ProposalReason.WEAKNESS
    assert chosen.tolerances["angle_error"].weight > 0.0


def test_after_several_attempts_that_did_not_pass_an_easier_one_is_proposed():
    before = [done("breathing-liver", False)] * TRIES
    found = propose("breathing-liver", score(5.0), before, EXERCISES)
    assert found.reason is ProposalReason.EASIER
    assert level(found.exercise) < level("breathing-liver")
    assert found.tries == TRIES
    passed_between = [before[0], done("breathing-liver", True), before[0]]
    found = propose("breathing-liver", score(5.0), passed_between, EXERCISES)
    assert found.reason is ProposalReason.AGAIN


def test_a_void_attempt_is_proposed_again_without_a_word_on_what_cost_points():
    found = propose("first-insertion", None, [], EXERCISES)
    assert (found.reason, found.metric) == (ProposalReason.VOID, "")


def course(*names, ordered=False, purpose=Purpose.PRACTICE):
    items = tuple(CourseItem(exercise=name, purpose=purpose) for name in names)
    return Course(id="autumn", title="Autumn", ordered=ordered, groups=("A",), items=items)


def test_in_a_course_the_first_that_is_not_passed_follows_also_one_that_was_skipped():
    names = ("thick-tissue", "scans-only", "first-insertion")
    found = propose("scans-only", score(0.5), [], EXERCISES, course(*names))
    assert (found.exercise, found.reason) == ("thick-tissue", ProposalReason.COURSE)
    assert found.course == "Autumn"
    before = [done("thick-tissue", True)]
    found = propose("scans-only", score(0.5), before, EXERCISES, course(*names))
    assert found.exercise == "first-insertion"
    before.append(done("first-insertion", True))
    found = propose("scans-only", score(0.5), before, EXERCISES, course(*names))
    assert found.reason is ProposalReason.DONE


def test_start_page_and_debrief_name_the_same_exercise():
    for known in ((), ("first-insertion",), ("first-insertion", "thick-tissue")):
        before = twice(*known, "plan-it-yourself")
        found = propose("plan-it-yourself", score(0.5), before, EXERCISES)
        stood = {name: Standing(2, 90.0, True, 2, 1) for name in (*known, "plan-it-yourself")}
        there = comes_next(stood, EXERCISES, None)
        level = {one.id: one.level for one in EXERCISES}
        # Of equally easy ones the debrief prefers what trains what cost most.
        assert level[found.exercise] == level[there]


def test_one_pass_leaves_the_same_exercise_the_next_on_start_page_and_in_debrief():
    found = propose("first-insertion", score(0.5), [done("first-insertion", True)], EXERCISES)
    stood = {"first-insertion": Standing(1, 90.0, True, 1, 0)}
    assert comes_next(stood, EXERCISES, None) == found.exercise == "first-insertion"


def test_who_masters_everything_goes_on_where_the_best_points_are_lowest():
    stood = {one.id: Standing(2, 90.0, True, 2, 1) for one in EXERCISES}
    stood["past-the-vessel"] = Standing(2, 70.0, True, 2, 1)
    assert comes_next(stood, EXERCISES, None) == "past-the-vessel"
    assert comes_next(stood, EXERCISES, None, lambda _: "closed") == ""


def test_what_may_not_be_begun_is_not_proposed():
    def refused(name):
        return "it opens tomorrow" if name in ("thick-tissue", "scans-only") else ""

    names = ("first-insertion", "thick-tissue", "past-the-vessel")
    found = propose("first-insertion", score(0.5), [], EXERCISES, course(*names), refused)
    assert found.exercise == "past-the-vessel"
    found = propose("scans-only", score(9.0), [], EXERCISES, None, refused)
    assert (found.exercise, found.reason) == ("", ProposalReason.CLOSED)


def test_a_result_that_is_held_is_told_by_no_proposal():
    names = ("first-insertion", "thick-tissue")
    open_course = course(*names, purpose=Purpose.ASSESSMENT)
    found = propose("first-insertion", score(9.0), [], EXERCISES, open_course, held=True)
    same = propose("first-insertion", score(0.5), [], EXERCISES, open_course, held=True)
    assert found == same
    assert (found.exercise, found.metric, found.points) == ("thick-tissue", "", 0.0)
    strict = course(*names, ordered=True, purpose=Purpose.ASSESSMENT)
    found = propose("first-insertion", score(0.5), [], EXERCISES, strict, held=True)
    assert found.reason is ProposalReason.CLOSED
    assert propose("first-insertion", None, [], EXERCISES, held=True).exercise == ""


def test_attempts_that_were_altered_or_made_by_a_script_pass_nothing():
    scripted = replace(done("thick-tissue", True), counts=False)
    altered = done("thick-tissue", True, verdict="altered")
    before = [scripted, altered, done("first-insertion", True)]
    before.append(done("first-insertion", True))
    found = propose("first-insertion", score(0.5), before, EXERCISES)
    assert found.exercise == "thick-tissue"


def test_a_result_is_held_for_who_takes_an_assessment_until_it_is_released_and_for_nobody_else():
    assessed = course("first-insertion", purpose=Purpose.ASSESSMENT)
    practised = course("first-insertion")
    assert holding([practised, assessed], ADA, "first-insertion", 1, released=False) is assessed
    assert holding([assessed], ADA, "first-insertion", 1, released=True) is None
    assert holding([assessed], ADA, "first-insertion", 2, released=False) is None
    assert holding([assessed], ADA, "thick-tissue", 1, released=False) is None
    assert holding([assessed], None, "first-insertion", 1, released=False) is None
    other = Person("p-ba9876543210", "ben", ("B",))
    assert holding([assessed], other, "first-insertion", 1, released=False) is None


def write(
    folder, name, student, total, exercise="first-insertion", started="2026-11-20T10:00:00+00:00",
    **known,
):  # fmt: skip
    """A record as the index finds it: its summary is enough."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.mcap"
    path.write_bytes(b"not opened: the sidecar is enough")
    score = {"total": total, "passed": (total or 0.0) >= 60.0, "void_reason": "", "rows": []}
    made = {"kind": DeviceKind.SIMULATED, "hand": "mouse", "scoring_version": 2} | known
    under = Conditions(exercise, 1, **made)
    write_summary(
        path,
        Summary(
            name, started, student, exercise, state="ended",
            score=MappingProxyType(score), conditions=under,
        ),
    )  # fmt: skip
    return under


def test_the_folder_says_what_comes_next_and_which_attempts_may_stand_beside(tmp_path):
    folder = tmp_path / "records"
    under = write(folder, "a", "ada", 70.0)
    write(folder, "b", "ada", 85.0)
    write(folder, "c", "ben", 95.0)
    write(folder, "d", "eve", 99.0)
    shown = SimpleNamespace(drill=None, id="a", student="ada", conditions=under, score=score(0.5))
    first = [one.model_copy(update={"version": 1}) for one in EXERCISES]
    found = around(folder, shown, False, first, False, lambda who: who != "eve", lambda _: "")
    assert [(one.id, own) for one, own in found.rivals] == [("b", True), ("c", False)]
    assert found.proposal.exercise == "thick-tissue"
    held = around(folder, shown, True, EXERCISES, False, lambda _: True, lambda _: "")
    assert (held.rivals, held.proposal.exercise) == ((), "")


def proposed(folder, under, student="ada", name="z", angle=0.5, drill=None):
    """What follows an attempt of the day of all records here."""
    shown = SimpleNamespace(
        drill=drill, id=name, student=student, conditions=under, score=score(angle),
        started="2026-11-20T10:00:00+00:00",
    )  # fmt: skip
    first = [one.model_copy(update={"version": 1}) for one in EXERCISES]
    return around(folder, shown, False, first, False, lambda _: True, lambda _: "").proposal


def test_two_passes_of_which_one_was_declared_void_master_nothing(tmp_path):
    person, _ = People().add(RosterLine("ada", groups=("A",)))
    folder = tmp_path / "records"
    under = write(folder, "y", person.key, 80.0, started="2026-11-20T09:00:00+00:00")
    write(folder, "z", person.key, 80.0)
    assert proposed(folder, under, person.key).exercise == "thick-tissue"
    People().remark("y", void="the needle was not the one of the exercise")
    found = proposed(folder, under, person.key)
    assert (found.exercise, found.reason) == ("first-insertion", ProposalReason.CONFIRM)


def test_what_a_script_failed_does_not_make_a_person_s_next_exercise_easier(tmp_path):
    folder = tmp_path / "records"
    hard = "breathing-liver"
    for number in range(TRIES):
        at = f"2026-11-20T0{number}:00:00+00:00"
        write(folder, f"s{number}", "ada", 10.0, hard, at, scripted="novice")
    under = write(folder, "z", "ada", 10.0, hard)
    found = proposed(folder, under, angle=9.0)
    assert (found.exercise, found.reason) == (hard, ProposalReason.AGAIN)


def test_rounds_of_a_drill_are_those_of_its_day_that_were_not_declared_void(tmp_path):
    person, _ = People().add(RosterLine("ada", groups=("A",)))
    folder, drill = tmp_path / "records", "drill-repeat-first-insertion"
    for day in (18, 19, 20, 21):
        at = f"2026-11-{day}T09:00:00+00:00"
        under = write(folder, f"d{day}", person.key, 70.0, drill, at, drill="repeat")
    write(folder, "z", person.key, 85.0, drill, drill="repeat")
    write(folder, "later", person.key, 85.0, drill, "2026-11-20T11:00:00+00:00", drill="repeat")
    part = DrillPart(kind="repeat", of="first-insertion", version=1)
    assert proposed(folder, under, person.key, drill=part).tries == 2
    People().remark("d20", void="somebody else had the mouse")
    assert proposed(folder, under, person.key, drill=part).tries == 1


def test_nothing_easier_is_proposed_that_may_not_be_begun():
    easy = [one.id for one in EXERCISES if one.level < level("breathing-liver")]
    before = [done("breathing-liver", False)] * TRIES
    found = propose(
        "breathing-liver", score(5.0), before, EXERCISES, None,
        lambda name: "it opens tomorrow" if name in easy[:-1] else "",
    )  # fmt: skip
    assert (found.exercise, found.reason) == (easy[-1], ProposalReason.EASIER)
    found = propose(
        "breathing-liver", score(5.0), before, EXERCISES, None,
        lambda name: "it opens tomorrow" if name in easy else "",
    )  # fmt: skip
    assert (found.exercise, found.reason) == ("breathing-liver", ProposalReason.AGAIN)


def test_in_a_course_nothing_easier_is_proposed_that_is_not_in_it():
    before = [done("breathing-liver", False)] * TRIES
    some = course("breathing-liver", "thick-tissue")
    found = propose("breathing-liver", score(5.0), before, EXERCISES, some)
    assert found.exercise == "thick-tissue"
    alone = propose("breathing-liver", score(5.0), before, EXERCISES, course("breathing-liver"))
    assert alone.reason is ProposalReason.AGAIN


def test_a_round_of_a_drill_is_an_attempt_with_a_score(tmp_path):
    folder, drill = tmp_path / "records", "drill-repeat-first-insertion"
    under = write(folder, "a", "ada", 70.0, drill)
    write(folder, "b", "ada", 85.0, drill)
    write(folder, "c", "ada", None, drill)  # aborted, or void
    shown = SimpleNamespace(
        drill=DrillPart(kind="repeat", of="first-insertion", version=1), id="b", student="ada",
        conditions=under, score=score(0.5), started="2026-11-20T10:00:00+00:00",
    )  # fmt: skip
    found = around(folder, shown, False, EXERCISES, False, lambda _: True, lambda _: "")
    assert found.proposal.tries == 2


def test_attempts_that_a_course_holds_stand_beside_nothing_but_for_the_instructor(tmp_path):
    person, _ = People().add(RosterLine("ada", groups=("A",)))
    course("first-insertion", purpose=Purpose.ASSESSMENT).save()
    folder = tmp_path / "records"
    under = write(folder, "a", person.key, 70.0)
    write(folder, "b", person.key, 85.0)
    shown = SimpleNamespace(
        drill=None, id="a", student=person.key, conditions=under, score=score(0.5)
    )
    assert held_by(shown) == "Autumn"

    def beside(manages):
        found = around(folder, shown, False, EXERCISES, manages, lambda _: True, lambda _: "")
        return [one.id for one, _ in found.rivals]

    assert beside(False) == []
    assert beside(True) == ["b"]
    People().remark("b", released=True)
    assert beside(False) == ["b"]
