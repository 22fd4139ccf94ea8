"""Pass marks that people set: whose attempts may, the command, what is kept."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reliability_attempts import attempt, attempts, students

from app.__main__ import main
from app.exercises.library import load_exercise
from app.scoring.pass_mark import MarkMethod
from app.scoring.standard_setting import PassMark
from app.session.errors import ScriptsSetNoMarkError, SessionError
from app.session.index import Index, Indexed
from app.session.people import Remarks
from app.session.people_marks import Rating, rated_attempts, refuse_scripts, set_mark

EXERCISE = load_exercise("first-insertion")
SHEET = "judge;first-insertion;scans-only\nA;60;50\nB;66;58\nC;72;57\n"


def of_people() -> list[Indexed]:
    """Eight students about 60 and four consultants about 85, four attempts each."""
    rng = np.random.default_rng(4)
    points = {
        (one.key, EXERCISE.id): np.clip(middle + rng.normal(0, 5, 4), 0, 100).round(1).tolist()
        for group, count, middle in (("A", 8, 60.0), ("consultants", 4, 85.0))
        for one in students(count, group)
    }
    return attempts(points, version=EXERCISE.version)


@pytest.fixture
def acus(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[..., Any]:
    some = of_people()
    monkeypatch.setattr(Index, "attempts", lambda *_: some)

    def run(*words: object, code: int = 0) -> Any:
        monkeypatch.setattr("sys.argv", ["acus", "exercise", "mark", EXERCISE.id, *map(str, words)])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert ended.value.code == code, err
        if code:
            return err
        return json.loads(out)["facts"] if "--json" in words else out

    return run


def sheet(folder: Path, text: str) -> Path:
    path = folder / "sheet.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.long("journey")
def test_judges_set_a_mark_that_a_new_exercise_keeps_with_how_it_was_set(
    acus: Callable[..., Any], tmp_path: Path
) -> None:
    path = sheet(tmp_path, SHEET)
    facts = acus("--angoff", path, "--json")
    assert (facts["points"], facts["method"], facts["people"]) == (66.0, "angoff", 3)
    assert facts["standard_error"] == pytest.approx(3.46)
    assert facts["before"] == EXERCISE.rules.pass_mark
    assert facts["kept"] is None
    assert 3.0 < facts["score_error"] < 7.0  # drawn with 5
    assert any("14%" in line["words"] for line in facts["pass_lines"])
    shares = {one["hands"]: one["share"] for one in facts["published"]}
    assert 0.0 < shares["guided in patients"] < shares["freehand"] < shares["guided"] < 1.0
    kept = acus("--angoff", path, "--title", "Ours", "--json")["kept"]
    rules = load_exercise(kept["id"]).rules
    assert rules.mark is not None
    assert (rules.pass_mark, rules.mark.method) == (66.0, MarkMethod.ANGOFF)
    assert rules.mark.score_error == facts["score_error"]


@pytest.mark.long("journey")
def test_a_mark_is_versioned_with_its_exercise(
    acus: Callable[..., Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = sheet(tmp_path, SHEET)
    first = acus("--angoff", path, "--title", "Ours", "--json")["kept"]
    own = sheet(tmp_path, "judge,ours\nA,70\nB,71\nC,72\n")
    words = ["acus", "exercise", "mark", first["id"], "--angoff", str(own), "--save", "--json"]
    monkeypatch.setattr("sys.argv", words)
    with pytest.raises(SystemExit):
        main()
    assert load_exercise("ours").version == 2
    assert load_exercise("ours").rules.pass_mark == 71.0
    assert load_exercise("ours@1").rules.pass_mark == 66.0


@pytest.mark.long("journey")
def test_examiners_set_a_mark_by_the_ratings_of_peoples_attempts(
    acus: Callable[..., Any], tmp_path: Path
) -> None:
    rows = [f"{one.id},{min(5, max(1, round(((one.total or 0) - 45) / 9)))}" for one in of_people()]
    path = sheet(tmp_path, "\n".join(["attempt,rating", *rows]))
    facts = acus("--borderline", path, "--json")
    assert facts["points"] == pytest.approx(63.0, abs=1.5)  # 45 + 9·2
    assert (facts["people"], facts["attempts"]) == (12, 48)
    assert acus("--borderline", path, "--at", "3", "--json")["points"] > facts["points"] + 5.0


@pytest.mark.long("journey")
def test_contrasting_groups_set_a_mark_between_them(acus: Callable[..., Any]) -> None:
    facts = acus("--experienced", "consultants", "--json")
    assert 65.0 < facts["points"] < 80.0
    assert facts["method"] == "contrasting"
    assert 0.0 < facts["standard_error"] < 6.0
    assert (facts["people"], facts["people_here"], facts["people_reach_it"]) == (12, 12, 4)


@pytest.mark.long("journey")
def test_the_lines_for_people_say_mark_errors_and_published_hands(
    acus: Callable[..., Any], tmp_path: Path
) -> None:
    text = acus("--angoff", sheet(tmp_path, SHEET))
    assert "pass mark 66.0 ± 3.5 points by angoff (3 people)" in text
    assert "judges agree over the exercises of the sheet: ICC(2,k)" in text
    assert "within the error of measurement" in text
    assert "of published hands" in text
    assert "not kept" in text


@pytest.mark.long("journey")
def test_scripts_set_no_mark_by_whatever_way(acus: Callable[..., Any], tmp_path: Path) -> None:
    expert = sheet(tmp_path, "judge,first-insertion\nA,60\nExpert,66\nC,72\n")
    for words in (("--experienced", "expert"), ("--angoff", expert)):
        assert "scripts, not people, and scripts set no mark" in acus(*words, code=2)
    scripted = attempt("x", EXERCISE.id, 1, 90.0, version=EXERCISE.version, scripted="expert")
    with pytest.raises(ScriptsSetNoMarkError, match=r"s\.csv, row 2: .* scripts, not people"):
        rated_attempts([Rating(scripted.id, 4.0, "s.csv, row 2")], EXERCISE, [scripted], {})
    with pytest.raises(ScriptsSetNoMarkError):
        refuse_scripts(["Novice"])
    refuse_scripts(["consultants", "experts of ours"])


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "give one way to set the mark"),
        (("--angoff", "a.csv", "--experienced", "A"), "give one way to set the mark"),
        (("--angoff", "none.csv"), "cannot read none.csv"),
        (("--experienced", "nobody"), "0 people of nobody have attempts"),
        (("--experienced", "A", "--title", "x", "--save"), "give one of them"),
        (("--experienced", "A", "--others", "consultants"), "do not part the two groups"),
    ],
)
def test_what_sets_no_mark_is_refused_in_one_line(
    acus: Callable[..., Any], words: tuple[str, ...], message: str
) -> None:
    refusal = acus(*words, code=2)
    assert message in refusal
    assert refusal.count("\n") == 1


@pytest.mark.long("journey")
def test_a_sheet_without_the_exercise_is_refused(acus: Callable[..., Any], tmp_path: Path) -> None:
    path = sheet(tmp_path, "judge,scans-only\nA,60\nB,61\nC,62\n")
    assert "sheet.csv has no column first-insertion" in acus("--angoff", path, code=2)


def test_attempts_that_do_not_count_or_are_of_another_version_set_no_mark() -> None:
    one = attempt("p", EXERCISE.id, 1, 70.0, version=EXERCISE.version)
    other = attempt("p", EXERCISE.id, 2, 70.0, version=EXERCISE.version + 1)
    cases = [
        (one, {one.id: Remarks(void="slipped")}, "does not count"),
        (other, {}, "not of first-insertion"),
    ]
    for item, remarks, message in cases:
        with pytest.raises(SessionError, match=message):
            rated_attempts([Rating(item.id, 4.0, "s.csv, row 2")], EXERCISE, [item], remarks)
    with pytest.raises(SessionError, match="'gone' is no attempt here"):
        rated_attempts([Rating("gone", 4.0, "s.csv, row 2")], EXERCISE, [one], {})


def test_several_ratings_of_an_attempt_are_one_by_their_mean() -> None:
    some = [attempt("p", EXERCISE.id, n, 60.0 + n, version=EXERCISE.version) for n in range(2)]
    given = ((0, 2.0), (0, 4.0), (1, 5.0))
    ratings = [Rating(some[place].id, rating, "") for place, rating in given]
    rated = rated_attempts(ratings, EXERCISE, some, {})
    assert (rated.ratings, rated.points, rated.people) == ((3.0, 5.0), (60.0, 61.0), 1)


def test_where_nobody_repeated_an_exercise_the_error_of_a_score_is_not_known() -> None:
    mark = PassMark(MarkMethod.ANGOFF, 66.66, 2.345, 5)
    assert set_mark(mark, [[60.0], [70.0]]).score_error is None
    made = set_mark(mark, [[60.0, 64.0], [70.0, 66.0]])
    assert (made.points, made.standard_error) == (66.7, 2.35)
    assert made.score_error == pytest.approx(2.83)
