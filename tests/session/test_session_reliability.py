"""Reliability of a course: whose attempts tell it, what is said where they do not, the command."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from datetime import UTC, datetime
from typing import Any

import numpy as np
import pytest
from reliability_attempts import attempt, attempts, students

from app.__main__ import main
from app.scoring.errors import ReliabilityError
from app.session.board import ProgressBoard, progress_board
from app.session.course import CourseItem
from app.session.index import Index, Indexed
from app.session.people import People, Person, Remarks
from app.session.reliability import course_reliability, reliability_lines

PEOPLE = [Person(f"p{n}", f"S{n}") for n in range(8)]
EXERCISES = ("ribs", "kidney", "liver")
NOW = datetime(2026, 11, 29, tzinfo=UTC)
MARK = {
    "method": "angoff", "points": 70.0, "standard_error": 2.0, "people": 5, "score_error": 4.0,
}  # fmt: skip


def board(
    some: Sequence[Indexed], people: Sequence[Person] = PEOPLE, **remarks: Remarks
) -> ProgressBoard:
    items = [CourseItem(exercise=name) for name in EXERCISES]
    return progress_board(people, items, some, remarks, NOW)


def drawn(each: int = 3, seed: int = 1) -> dict[tuple[str, str], list[float]]:
    """Points of all at all, with students ± 9, exercises ± 6, their pairs ± 4, chance ± 5."""
    rng = np.random.default_rng(seed)
    skill, hard = rng.normal(0, 9, len(PEOPLE)), rng.normal(0, 6, len(EXERCISES))
    return {
        (person.key, name): [
            float(np.clip(round(65 + skill[i] + hard[j] + pair + e, 1), 0, 100))
            for e in rng.normal(0, 5, each)
        ]
        for i, person in enumerate(PEOPLE)
        for j, name in enumerate(EXERCISES)
        for pair in [rng.normal(0, 4)]
    }


def test_a_course_that_all_have_done_is_told_whole() -> None:
    result = course_reliability(board(attempts(drawn())))
    assert (result.students, result.attempts, result.complete) == (8, 72, 8)
    assert result.components is not None
    assert result.components.estimator == "anova"
    assert [one.form for one in result.agreement] == ["1,1", "2,1", "3,1", "1,k", "2,k", "3,k"]
    assert result.notes == ()
    assert [one.exercise for one in result.exercises] == list(EXERCISES)
    for one in result.exercises:
        assert one.statistics is not None
        assert one.statistics.discrimination is not None
        assert one.score_error is not None
        assert one.pass_mark == 60.0


def test_the_newest_attempts_are_taken_and_as_many_at_most_of_everybody() -> None:
    points = drawn(each=2)
    longer = {place: [0.0] * 30 + own for place, own in points.items()}
    newest = course_reliability(board(attempts(longer)), at_most=2)
    assert newest.attempts == len(points) * 2
    assert newest.components is not None
    assert (
        newest.components.variances
        == course_reliability(board(attempts(points))).components.variances
    )  # type: ignore[union-attr]


def test_an_empty_cell_is_named_and_the_rest_is_estimated_without_it() -> None:
    points = drawn()
    del points["p2", "kidney"]
    result = course_reliability(board(attempts(points)))
    assert result.complete == 7
    assert "S2 has no attempt at kidney that counts" in result.notes[0]
    assert result.components is not None
    assert result.components.estimator == "reml"


def test_attempts_of_scripts_are_left_out_and_said_to_be_no_peoples() -> None:
    some = attempts(drawn())
    script = [attempt("p1", "ribs", 20 + n, 100.0, scripted="expert") for n in range(4)]
    result, without = (course_reliability(board(own)) for own in ([*some, *script], some))
    assert result.components == without.components
    assert result.notes == ("4 attempts were left out: scripts, not people",)


def test_void_attempts_are_left_out() -> None:
    some = attempts(drawn())
    void = {one.id: Remarks(void="slipped") for one in some if one.student == "p0"}
    assert course_reliability(board(some, **void)).students == 7


def test_one_exercise_alone_says_what_more_would_tell() -> None:
    points = {place: own for place, own in drawn().items() if place[1] == "ribs"}
    result = course_reliability(board(attempts(points)))
    assert "one exercise only" in result.notes[0]
    assert result.components is not None
    assert result.study is not None
    assert result.study.exercises_for(3) is None
    assert result.agreement == ()


def test_one_attempt_each_says_what_more_would_tell() -> None:
    result = course_reliability(board(attempts(drawn(each=1))))
    assert "one attempt each" in result.notes[0]
    assert result.study is not None
    assert result.study.attempts_for(3) is None
    assert all(one.score_error is None for one in result.exercises)
    assert [one.document()["attempts_wanted"] for one in result.exercises] == [None] * 3


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ({}, "students with points: 0"),
        ({("p0", "ribs"): [50.0, 60.0]}, "students with points: 1; reliability needs 2 students"),
        ({("p0", "ribs"): [50.0], ("p1", "kidney"): [60.0]}, "points once only"),
        ({("p0", "ribs"): [50.0] * 3, ("p1", "ribs"): [50.0] * 3}, "nothing varies"),
    ],
)
def test_too_little_is_refused_in_one_line_that_says_what_to_do(
    points: dict[tuple[str, str], list[float]], message: str
) -> None:
    with pytest.raises(ReliabilityError, match=message) as refused:
        course_reliability(board(attempts(points)))
    assert "\n" not in str(refused.value)


def test_whose_best_is_within_the_error_of_a_single_score_is_named() -> None:
    """Two who repeat by ± 4: the error is √8 = 2.83; 62 is near 60, and 70 is not."""
    points = {("p0", "ribs"): [58.0, 62.0], ("p1", "ribs"): [66.0, 70.0]}
    (ribs,) = course_reliability(board(attempts(points))).exercises
    assert ribs.score_error == pytest.approx(np.sqrt(8.0))
    assert ribs.near_mark == ("S0",)


def test_the_board_says_whose_best_is_near_a_mark_that_people_set() -> None:
    points = {("p0", "ribs"): [50.0, 73.9], ("p1", "ribs"): [70.0, 74.1]}
    cells = board(attempts(points, mark=MARK)).cells
    assert (cells["p0", "ribs"].near_mark, cells["p1", "ribs"].near_mark) == (True, False)
    plain = board(attempts(points)).cells
    assert not plain["p0", "ribs"].near_mark


@pytest.fixture
def acus(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[..., Any]:
    def run(*words: str, code: int = 0) -> Any:
        monkeypatch.setattr("sys.argv", ["acus", *words])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert ended.value.code == code, err
        if code:
            return err
        return json.loads(out)["facts"] if "--json" in words else out

    return run


@pytest.mark.long("journey")
def test_the_command_prints_a_table_and_the_same_as_json(
    acus: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    keys = {f"p{n}": person.key for n, person in enumerate(students(8))}
    some = attempts({(keys[who], name): own for (who, name), own in drawn().items()})
    monkeypatch.setattr(Index, "attempts", lambda *_: some)
    facts = acus("results", "reliability", "--json")
    assert (facts["students"], facts["attempts"], facts["complete"]) == (8, 72, 8)
    shares = [one["share"] for one in facts["variance"]["components"]]
    assert sum(shares) == pytest.approx(1.0)
    rows = {row["attempts"]: row for row in facts["decision"]["rows"]}
    assert rows[12]["g"] > rows[1]["g"] > 0.0
    wanted = facts["decision"]["attempts_for_g"]
    assert wanted is None or wanted >= 1
    table = acus("results", "reliability")
    assert "72 attempts that count" in table
    assert "student x exercise" in table
    assert "ICC(2,1)" in table
    assert all(name in table for name in EXERCISES)
    assert "students with points: 0" in acus("results", "reliability", "--group", "none", code=2)
    assert len(People().everybody()) == 8


def test_what_a_report_says_of_reliability_has_intervals_and_where_there_is_none_the_reason() -> (
    None
):
    lines = reliability_lines(board(attempts(drawn())))
    assert [line.split(" ")[0] for line in lines] == ["G", "Phi", "a", "ICC(2,k)"]
    assert all("(0." in line for line in (*lines[:2], lines[3]))
    assert reliability_lines(board(attempts(drawn()), PEOPLE[:1])) == (
        "students with points: 1; reliability needs 2 students at least: take in more",
    )
