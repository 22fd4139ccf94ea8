"""Courses as files, who may begin, and a board on which only comparable attempts meet."""

import json
import time
from datetime import UTC, date, datetime, timedelta
from pathlib import Path
from typing import Any

import pytest

from app.core.errors import ConfigurationError
from app.core.messages import Sentence
from app.exercises.guidance import Purpose
from app.exercises.library import load_exercise
from app.scoring.conditions import Assistance, Conditions, DeviceKind
from app.session.access import Known, Visitor
from app.session.board import Standing, every_item, progress_board, standings
from app.session.course import (
    Course,
    CourseError,
    CourseItem,
    assessed_by,
    courses,
    courses_folder,
    find_course,
    pinned_problems,
    read_course,
    refusals,
    why_not,
)
from app.session.index import Indexed
from app.session.next_exercise import comes_next
from app.session.people import PEOPLE, Person, Remarks, people_folder

NOW = datetime(2026, 11, 20, 12, tzinfo=UTC)
ADA, BOB = Person("p-a", "Ada", ("A",)), Person("p-b", "Bob", ("B",))


def attempt(
    name: str, student: str, total: float | None, day: int = 0, exercise: str = "lung", **other: Any
) -> Indexed:
    made = {"hand": "mouse", "kind": DeviceKind.SIMULATED, "version": 1} | other
    verdict, state = made.pop("verdict", "verified"), made.pop("state", "ended")
    dial = made.pop("dial", 0.5)
    known = Conditions(
        exercise, scoring_version=3, assistance=Assistance(dial, dial, dial, dial), **made
    )
    person = not known.scripted and known.kind is not DeviceKind.EMULATED
    return Indexed(
        id=name,
        started=(NOW - timedelta(days=30 - day)).isoformat(),
        student=student,
        exercise=exercise,
        version=known.version,
        state=state,
        duration=30.0,
        total=total,
        passed=None if total is None else total >= 60,
        verdict=verdict,
        counts=person and total is not None,
        under=json.dumps(known.document()),
        document="{}",
    )


def board(attempts: list[Indexed], remarks: dict[str, Remarks] | None = None) -> Any:
    items = [CourseItem(exercise="lung"), CourseItem(exercise="liver")]
    return progress_board([ADA, BOB], items, attempts, remarks or {}, NOW)


def test_a_cell_has_best_last_trend_and_time_since() -> None:
    found = board([attempt(f"a{k}", "p-a", t, k) for k, t in enumerate((40, 70, 60, 80))])
    cell = found.cells["p-a", "lung"]
    assert (cell.attempts, cell.best, cell.last, cell.passed) == (4, 80, 80, True)
    assert cell.trend == pytest.approx(35 / 3)  # median of the slopes 30, 10, 40/3, -10, 5, 20
    assert cell.since == timedelta(days=27)
    assert found.cells["p-b", "lung"].attempts == 0
    assert [(p.total, p.best, p.median) for p in found.curve("p-a", "lung")] == [
        (40, 40, 40), (70, 70, 55), (60, 70, 60), (80, 80, 65),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("other", "why"),
    [
        ({"scripted": "expert"}, "scripted"),
        ({"kind": DeviceKind.EMULATED}, "emulated robot"),
        ({"version": 2}, "version 2 of the exercise"),
        ({"verdict": "altered"}, "altered after it was signed"),
        ({"hand": "keyboard"}, "made under other conditions than most"),
        ({"dial": 0.9}, "made under other conditions than most"),
    ],
)
def test_what_cannot_be_compared_is_counted_apart_with_its_reason(other: Any, why: str) -> None:
    some = [attempt("a1", "p-a", 50, 1), attempt("a2", "p-a", 55, 2)]
    cell = board([*some, attempt("x", "p-a", 99, 3, **other)]).cells["p-a", "lung"]
    assert (cell.attempts, cell.best, cell.others) == (2, 55, 1)
    assert cell.why == ((why, 1),)
    assert isinstance(cell.why[0][0], Sentence)  # so it comes in the window's language


def test_void_attempts_and_those_without_a_score_do_not_count() -> None:
    some = [attempt("a1", "p-a", 50), attempt("a2", "p-a", None), attempt("a3", "p-a", 90)]
    cell = board(some, {"a3": Remarks(void="camera fell")}).cells["p-a", "lung"]
    assert (cell.attempts, cell.best) == (1, 50)
    assert dict(cell.why) == {"not scored or void": 1, "declared void by the instructor": 1}


def test_unsigned_records_count_and_those_of_whom_nobody_knows_do_not() -> None:
    some = [attempt("a1", "p-a", 50, verdict="unsigned"), attempt("a2", "somebody", 99)]
    found = board(some)
    assert found.cells["p-a", "lung"].best == 50
    assert found.cells["p-b", "lung"].attempts == 0


def test_without_a_course_each_exercise_stands_in_its_newest_version() -> None:
    items = every_item([attempt("a", "p-a", 1), attempt("b", "p-a", 1, version=3)])
    assert items == [CourseItem(exercise="lung", version=3)]


def test_a_result_that_is_held_and_a_void_one_are_told_apart_and_counted_nowhere() -> None:
    some = [attempt(f"a{k}", "p-a", 70 + k, k) for k in range(3)]
    items = [CourseItem(exercise="lung")]
    said = {"a0": Remarks(void="camera fell")}
    found = progress_board([ADA], items, some, said, NOW, held={"a2"})
    cell = found.cells["p-a", "lung"]
    assert (cell.best, cell.attempts, cell.void) == (71, 1, ("camera fell",))
    assert dict(cell.why)["not released yet"] == 1
    assert [point.attempt for point in found.curve("p-a", "lung")] == ["a1"]


def test_a_board_tells_who_is_competent_by_the_attempts_that_count() -> None:
    """By hand: ten passes in a row make a student competent, three failures then a relapse."""
    ten = [attempt(f"a{k}", "p-a", 80, k) for k in range(11)]
    void = board(ten, {"a3": Remarks(void="camera fell")}).competence("p-a", "lung")
    assert (void.state, void.changes[-1].attempt) == ("competent", 10)
    short = board(ten, {f"a{k}": Remarks(void="x") for k in (3, 4)}).competence("p-a", "lung")
    assert (short.state, short.fewest) == ("not yet", 1)
    fallen = [*ten, *(attempt(f"b{k}", "p-a", 20, 11 + k) for k in range(3))]
    assert board(fallen).competence("p-a", "lung").state == "relapse"
    assert board(fallen).competence("p-b", "lung") is None


def test_weeks_between_attempts_and_since_the_last_one_are_a_gap_on_the_board() -> None:
    some = [attempt(f"a{k}", "p-a", 80, k - 60 if k < 6 else k) for k in range(10)]
    assert board(some).competence("p-a", "lung").fewest == 6
    old = [attempt(f"a{k}", "p-a", 80, k - 60) for k in range(6)]
    assert board(old).competence("p-a", "lung").fewest == 10


def test_a_course_states_its_own_rates_and_keeps_them_in_its_file(tmp_path: Path) -> None:
    path = tmp_path / "c.yaml"
    path.write_text("id: c\ntitle: C\ncompetence: {unacceptable: 0.5, missed: 0.2}\n")
    course = read_course(path)
    assert (course.competence.acceptable, course.competence.unacceptable) == (0.1, 0.5)
    again = read_course(course.save(tmp_path))
    assert again.competence == course.competence
    some = [attempt(f"a{k}", "p-a", 80, k) for k in range(8)]
    items = [CourseItem(exercise="lung")]
    sooner = progress_board([ADA], items, some, {}, NOW, rule=course.competence)
    assert sooner.competence("p-a", "lung").state == "competent"  # six passes: log(0.9/0.5) each
    assert board(some).competence("p-a", "lung").state == "not yet"


@pytest.mark.parametrize(
    ("rule", "said"),
    [
        ("{acceptable: 0.4}", "it must be more"),
        ("{acceptable: 0.1, unacceptable: 0.11}", "too near to be told apart"),
        ("{acceptable: 0}", "acceptable"),
        ("{false_alarm: 1}", "false_alarm"),
        ("{alpha: 0.05}", "alpha"),
    ],
)
def test_a_course_with_rates_that_make_no_test_is_refused(
    rule: str, said: str, tmp_path: Path
) -> None:
    path = tmp_path / "c.yaml"
    path.write_text(f"id: c\ntitle: C\ncompetence: {rule}\n")
    with pytest.raises(ConfigurationError, match=said):
        read_course(path)


@pytest.mark.long("journey")
def test_ten_thousand_attempts_make_a_board_within_a_second() -> None:
    people = [Person(f"p-{k}", f"s{k}") for k in range(200)]
    some = [
        attempt(f"{k}-{n}", f"p-{k}", (7 * k + n) % 101, n % 30, f"e-{n % 10}")
        for n in range(50)
        for k in range(200)
    ]
    items = [CourseItem(exercise=f"e-{n}") for n in range(10)]
    best = min(timed(people, items, some) for _ in range(3))
    assert best < 1.0


def timed(*parts: Any) -> float:
    for one in parts[2]:
        one.__dict__.pop("conditions", None)
    begin = time.process_time()
    progress_board(*parts, {}, NOW)
    return time.process_time() - begin


# --- courses --------------------------------------------------------------------------------------
COURSE = Course(
    id="autumn",
    title="Autumn",
    groups=("A",),
    ordered=True,
    items=(
        CourseItem(exercise="lung", attempts=2, opens=date(2026, 11, 1), closes=date(2026, 11, 30)),
        CourseItem(exercise="liver", purpose=Purpose.ASSESSMENT),
    ),
)


def test_a_course_is_one_file_that_reads_back_equal(tmp_path: Path) -> None:
    path = COURSE.save(tmp_path)
    assert read_course(path) == COURSE
    assert find_course("autumn", tmp_path) == COURSE
    assert courses(tmp_path) == ([COURSE], [])
    with pytest.raises(CourseError, match="is no course; there: autumn"):
        find_course("../x", tmp_path)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("id: a\ntitle: T\nitems:\n- {exercise: x, atempts: 3}\n", "atempts"),
        ("id: a\ntitle: T\nitems:\n- {exercise: x, attempts: 0}\n", "attempts"),
        ("id: a\ntitle: T\nitems:\n- {exercise: x}\n- {exercise: x}\n", "twice"),
        ("id: ../a\ntitle: T\n", "id"),
        ("id: a\ntitle: T\nitems:\n- {exercise: x, opens: 2026-02-02, closes: 2026-01-01}\n",
         "before it opens"),
        ("id: a\ntitle: T\nitems:\n- {exercise: x, opens: soon}\n", "opens"),
    ],
)  # fmt: skip
def test_a_wrong_course_names_file_and_field(tmp_path: Path, text: str, said: str) -> None:
    path = courses_folder(tmp_path) / "a.yaml"
    path.parent.mkdir(parents=True)
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=said):
        read_course(path)
    assert str(path) in courses(tmp_path)[1][0]


def test_days_attempts_and_order_decide_who_may_begin() -> None:
    inside = date(2026, 11, 20)
    one, passed = attempt("a1", "p-a", 50), attempt("a2", "p-a", 70)
    assert why_not(COURSE, "lung", [one], inside) == ""
    assert why_not(COURSE, "lung", [], date(2026, 10, 1)) == "it opens on 2026-11-01"
    assert why_not(COURSE, "lung", [], date(2026, 12, 1)) == "it closed on 2026-11-30"
    assert why_not(COURSE, "lung", [one, one], inside) == "all 2 attempts are used"
    assert why_not(COURSE, "liver", [one], inside) == "first pass lung"
    assert why_not(COURSE, "liver", [one, passed], inside) == ""
    assert why_not(COURSE, "liver", [one, one], inside) == ""  # tried as often as is allowed
    assert "is no exercise of the course" in why_not(COURSE, "kidney", [], inside)
    cut = attempt("a3", "p-a", None, state="unfinished")
    assert why_not(COURSE, "lung", [one, cut], inside) == "all 2 attempts are used"
    assert why_not(COURSE, "lung", [one, attempt("s", "p-a", 9, scripted="x")], inside) == ""


def test_an_assessment_of_a_course_is_closed_to_who_does_not_take_it() -> None:
    day = date(2026, 11, 20)
    items = (
        CourseItem(exercise="ribs", attempts=1, purpose=Purpose.ASSESSMENT),
        CourseItem(exercise="lung"),
    )
    course = Course(id="c", title="Autumn", groups=("A",), items=items)
    assert list(assessed_by([course])) == ["ribs"]
    assert refusals([course], ADA, [], day) == {}
    refused = refusals([course], BOB, [], day)["ribs"]
    assert "Autumn, which you do not take" in refused
    assert isinstance(refused, Sentence)
    assert "lung" not in refusals([course], BOB, [], day)
    used = attempt("a1", "p-a", 50, exercise="ribs")
    assert refusals([course], ADA, [used], day) == {"ribs": "the one attempt is used"}
    practice = Course(id="d", title="D", items=(CourseItem(exercise="ribs"),))
    assert refusals([course, practice], BOB, [], day) == {}


def test_a_course_examines_only_those_who_take_it_and_only_by_its_assessments() -> None:
    exam = CourseItem(exercise="ribs", purpose=Purpose.ASSESSMENT)
    course = Course(id="c", title="Autumn", groups=("A",), items=(exam, CourseItem(exercise="x")))
    practice = Course(id="d", title="D", items=(CourseItem(exercise="ribs"),))
    known = Known(courses_here=(practice, course))
    assert Visitor(known, ADA).examined_by("ribs") == "Autumn"
    assert Visitor(known, ADA).examined_by("x") == ""
    assert Visitor(known, BOB).examined_by("ribs") == ""
    assert Visitor(known).examined_by("ribs") == ""


def test_a_pinned_version_that_the_library_does_not_have_is_said() -> None:
    items = (CourseItem(exercise="first-insertion", version=77), CourseItem(exercise="none"))
    said = pinned_problems(Course(id="c", title="C", items=items))
    assert "the course pins version 77" in said[0]
    assert "no such exercise" in said[1]


def test_who_takes_a_course() -> None:
    assert COURSE.takes(ADA)
    assert not COURSE.takes(BOB)
    assert Course(id="c", title="C").takes(BOB)


@pytest.fixture
def station(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Any:
    """Ada, Bob, attempts that a test lists, and courses that it writes."""
    attempts: list[Indexed] = []

    class There:
        def __init__(self, *_: Any) -> None: ...
        def refresh(self) -> None: ...
        def attempts(self) -> list[Indexed]:
            return attempts

        def remarks(self) -> dict[str, Remarks]:
            return {"released": Remarks(released=True), "void": Remarks(void="slipped")}

        def everybody(self) -> list[Person]:
            return [ADA, BOB]

    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    people_folder().mkdir(parents=True)
    (people_folder() / PEOPLE).touch()
    monkeypatch.setattr("app.session.board.Index", There)
    monkeypatch.setattr("app.session.board.People", There)
    monkeypatch.setattr("app.session.board.records", lambda _: attempts)
    return attempts


EXERCISES = tuple(
    load_exercise("first-insertion").model_copy(update={"id": name, "title": name.title()})
    for name in ("liver", "lung")
)


def stood(student: Person | None, may_see: Any = lambda _: True) -> dict[str, Standing]:
    exercises = [one.model_copy(update={"version": 1}) for one in EXERCISES]
    return standings(Path("somewhere"), exercises, student, may_see)


def test_how_far_a_student_has_come_is_told_by_what_counts_alone(station: list[Indexed]) -> None:
    station += [
        attempt("a", "p-a", 50),
        attempt("b", "p-a", 80),
        attempt("c", "p-b", 99),
        attempt("d", "p-a", 100, scripted="expert"),
        attempt("e", "p-a", 97, version=2),
        attempt("void", "p-a", 98),
        attempt("f", "p-a", 96, verdict="altered"),
        attempt("g", "p-a", None),
    ]
    assert stood(ADA) == {"lung": Standing(2, 80, True, 1, 0)}
    assert stood(None)["lung"] == Standing(3, 99, True, 1, 0)  # everybody at this station
    assert stood(None, lambda student: student == "p-a")["lung"] == Standing(2, 80, True, 1, 0)
    assert comes_next({}, EXERCISES, ADA) == "liver"
    refused = comes_next({}, EXERCISES, ADA, lambda name: name if name == "liver" else "")
    assert refused == "lung"


def test_two_passes_in_a_row_of_one_person_master_an_exercise(station: list[Indexed]) -> None:
    station += [
        attempt("a", "p-a", 80),
        attempt("b", "p-b", 90),
        attempt("void", "p-a", 40),
        attempt("c", "p-a", 30, scripted="novice"),
        attempt("d", "p-a", 20, version=2),
    ]
    assert stood(None)["lung"].masters == 0, "two persons passed once each"
    station.append(attempt("e", "p-a", 85))
    assert stood(ADA)["lung"] == Standing(2, 85, True, 2, 1)
    assert stood(BOB)["lung"] == Standing(1, 90, True, 1, 0)
    assert stood(None)["lung"] == Standing(3, 90, True, 2, 1)
    assert comes_next(stood(ADA), EXERCISES[1:], None) == "lung"
    assert comes_next(stood(ADA), EXERCISES[::-1], None) == "liver"
    assert comes_next(stood(BOB), EXERCISES[::-1], None) == "lung"
    station.append(attempt("g", "p-a", 50))
    assert stood(ADA)["lung"] == Standing(3, 85, True, 0, 0)


def test_in_a_course_a_pass_leads_on(station: list[Indexed]) -> None:
    items = (CourseItem(exercise="lung"), CourseItem(exercise="liver"))
    Course(id="c", title="C", ordered=True, items=items).save()
    assert comes_next({}, EXERCISES, ADA) == "lung"
    station.append(attempt("a", "p-a", 80))
    assert comes_next(stood(ADA), EXERCISES, ADA) == "liver"


def test_a_result_that_is_not_released_is_an_attempt_and_nothing_more(
    station: list[Indexed],
) -> None:
    item = CourseItem(exercise="lung", purpose=Purpose.ASSESSMENT)
    Course(id="exam", title="Exam", items=(item,)).save()
    station.append(attempt("held", "p-a", 90))
    assert stood(ADA) == {"lung": Standing(1)}
    assert comes_next({}, EXERCISES, ADA) == "lung"  # that of the course
    station.append(attempt("released", "p-a", 70))
    assert stood(ADA) == {"lung": Standing(2, 70, True, 1, 0)}


def test_a_folder_without_records_is_left_as_it_is(tmp_path: Path) -> None:
    assert standings(tmp_path, EXERCISES, None) == {}
    assert not list(tmp_path.iterdir())


def test_an_exercise_that_comes_first_is_named_by_its_title() -> None:
    items = (CourseItem(exercise="liver"), CourseItem(exercise="lung"))
    course = Course(id="c", title="C", ordered=True, items=items)
    why = why_not(course, "lung", [], NOW.date(), {"liver": "Liver below the ribs"})
    assert why == "first pass Liver below the ribs"
