"""Results as tables that spreadsheets and Moodle open, and as JSON."""

import csv
import io
import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

sys.path.append(str(Path(__file__).parents[1] / "session"))
from test_session_course import ADA, BOB, NOW, attempt

from app.core.progress import Cancelled, Progress
from app.exchange.results import Results, ResultsFormat, results_text
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.people import Remarks
from app.session.summary import Summary


def full(one: Any) -> Any:
    """An attempt with the summary that the index would hold."""
    rows = [{"name": "lateral", "label": "", "unit": "mm", "value": 1.5, "note": "",
             "tolerance": None, "utility": 1.0, "band": "expert"}]  # fmt: skip
    score = {"total": one.total, "void_reason": "", "rows": rows}
    summary = Summary(one.id, one.started, one.student, one.exercise, score=score,
                      conditions=one.conditions)  # fmt: skip
    one.__dict__["summary"] = summary
    return one


@pytest.fixture
def results() -> Results:
    some = [
        full(attempt("a1", "p-a", 50.25, 1)),
        full(attempt("a2", "p-a", 70.5, 2)),
        full(attempt("b1", "p-b", 61.0, 3)),
        full(attempt("x1", "=typed", 99.0, 4, hand="keyboard")),
    ]
    board = progress_board([ADA, BOB], [CourseItem(exercise="lung")], some[:3], {}, NOW)
    people = {"p-a": ADA, "p-b": BOB}
    return Results(board, some, people, {"a1": Remarks(comment="steadier")}, {})


def rows(text: str, delimiter: str = ",") -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text), delimiter=delimiter))


def test_the_tidy_table_has_a_row_for_each_metric_of_each_attempt(results: Results) -> None:
    found = rows(results_text(results, ResultsFormat.TIDY))
    assert len(found) == 8
    assert [r["value"] for r in found if r["metric"] == "score_total"] == [
        "50.25", "70.5", "61", "99",
    ]  # fmt: skip
    assert found[0]["comment"] == "steadier"
    assert [r["pseudonym"] for r in found[::2]] == ["Ada", "Ada", "Bob", ""]
    assert found[6]["recorded_as"] == "'=typed"  # no formula
    assert [r["comparison_group"] for r in found[::2]] == ["1", "1", "1", "2"]


def test_the_wide_table_has_a_row_for_each_student(results: Results) -> None:
    found = rows(results_text(results, ResultsFormat.WIDE))
    assert [r["pseudonym"] for r in found] == ["Ada", "Bob"]
    assert (found[0]["lung_best"], found[0]["lung_last"]) == ("70.5", "70.5")
    assert found[0]["lung_attempts"] == "2"


def test_a_french_excel_gets_semicolons_and_decimal_commas(results: Results) -> None:
    found = rows(results_text(results, ResultsFormat.WIDE, semicolons=True), ";")
    assert found[0]["lung_best"] == "70,5"


def test_moodle_gets_a_username_and_grades(results: Results) -> None:
    text = results_text(results, ResultsFormat.MOODLE)
    assert text.splitlines() == [
        'username,"lung, v1"', "Ada,70.5", "Bob,61",
    ]  # fmt: skip


def test_json_holds_all_of_it(results: Results) -> None:
    document = json.loads(results_text(results, ResultsFormat.JSON))
    assert [s["pseudonym"] for s in document["students"]] == ["Ada", "Bob"]
    assert [a["comparison_group"] for a in document["attempts"]] == [1, 1, 1, 2]
    assert document["board"][0]["best"] == 70.5


@pytest.mark.parametrize("form", ResultsFormat)
def test_no_form_steers_the_terminal_that_shows_it(results: Results, form: ResultsFormat) -> None:
    evil = "\x1b]0;owned\x07 \x9b2J \u202e"
    ada = replace(ADA, pseudonym=evil)
    board = replace(results.board, students=(ada, BOB))
    typed = full(attempt("y1", evil, 5.0, 5))
    said = {"a1": Remarks(comment=evil, void=evil)}
    shown = Results(board, [*results.attempts, typed], {"p-a": ada}, said, {"p-a": evil})
    text = results_text(shown, form)
    assert r"\u001b]0;owned\u0007 \u009b2J \u202e" in text
    assert not set("\x1b\x07\x9b\u202e") & set(text)
    if form is ResultsFormat.JSON:
        assert json.loads(text)["students"][0]["pseudonym"] == evil


def test_names_stand_in_files_only_when_asked(results: Results) -> None:
    named = Results(results.board, results.attempts, results.people, {}, {"p-a": "Lovelace"})
    for form in (ResultsFormat.TIDY, ResultsFormat.WIDE, ResultsFormat.JSON):
        assert "Lovelace" in results_text(named, form)
        assert "Lovelace" not in results_text(results, form)


@pytest.mark.long("journey")
def test_ten_thousand_attempts_report_progress_and_can_be_cancelled(results: Results) -> None:
    many = Results(results.board, [*results.attempts] * 2500, results.people, {}, {})
    told: list[float] = []
    results_text(many, ResultsFormat.TIDY, progress=Progress(lambda f, _: told.append(f)))
    assert len(told) >= 50
    assert told == sorted(told)
    progress = Progress(lambda fraction, _: progress.cancel() if fraction > 0.5 else None)
    with pytest.raises(Cancelled):
        results_text(many, ResultsFormat.TIDY, progress=progress)
