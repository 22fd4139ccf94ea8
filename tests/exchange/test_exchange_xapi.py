"""Attempts as statements of the Experience API: by the specification's rules, twice the same."""

import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

sys.path.append(str(Path(__file__).parents[1] / "session"))
sys.path.append(str(Path(__file__).parent))
from test_session_course import ADA, BOB, NOW, attempt
from xapi_rules import broken_cmi5_rules, broken_rules

from app.exchange.errors import ExportError
from app.exchange.results import Results
from app.exchange.xapi import statements, statements_text, voiding_statements
from app.session.board import progress_board
from app.session.course import CourseItem
from app.session.people import Remarks

HOME = "https://training.hospital.example"


def results(*some: Any, people: Any = (ADA, BOB), said: Any = None) -> Results:
    board = progress_board(list(people), [CourseItem(exercise="lung")], list(some), {}, NOW)
    known = {person.key: person for person in people}
    return Results(board, list(some), known, said or {}, {}, {}, {"lung": "Lung ¶ “apex”"})


SOME = (
    attempt("a1", "p-a", 50.25, 1),
    attempt("a2", "p-a", 100.0, 2),
    attempt("b 1/ü", "p-b", None, 3),
    replace(attempt("b2", "p-b", 0.0, 4), duration=3725.678),
)


def test_every_statement_keeps_the_rules_of_the_specification() -> None:
    told = statements(results(*SOME), HOME, "autumn")
    assert len(told) == 4
    for one in told:
        assert broken_rules(json.loads(json.dumps(one.statement))) == []


def test_the_checker_finds_what_is_wrong() -> None:
    right = json.loads(json.dumps(statements(results(SOME[0]), HOME)[0].statement))
    for place, value, rule in (
        ("result", right["result"] | {"duration": "1:20"}, "4.6"),
        ("result", right["result"] | {"score": {"scaled": 50, "raw": 1, "min": 0, "max": 2}},
         "2.4.5.1"),
        ("timestamp", "2026-11-02T10:00:00Z", "4.5"),
        ("actor", right["actor"] | {"mbox": "mailto:a@b.example"}, "2.4.2.1"),
        ("student", "x", "2.2"),
        ("object", {"id": "lung"}, "2.4.4.1"),
    ):  # fmt: skip
        assert any(line.startswith(rule) for line in broken_rules(right | {place: value})), place


def test_who_what_which_score_how_long_and_when() -> None:
    first, second, third, fourth = (one.statement for one in statements(results(*SOME), HOME))
    assert first["actor"]["account"] == {"homePage": HOME, "name": "Ada"}
    assert "Lovelace" not in json.dumps(first)
    assert "p-a" not in json.dumps(first)
    assert first["result"]["score"] == {"scaled": 0.5025, "raw": 50, "min": 0, "max": 100}
    assert [one["verb"]["display"]["en"] for one in (first, second, third, fourth)] == [
        "failed", "passed", "completed", "failed",
    ]  # fmt: skip
    assert (first["result"]["success"], second["result"]["success"]) == (False, True)
    assert "score" not in third["result"]
    assert "success" not in third["result"]
    assert fourth["result"]["duration"] == "PT3725.68S"
    assert first["object"]["id"] == f"{HOME}/exercises/lung/versions/1"


def scored(one: Any, mark: float, passed: bool | None, *rows: Any) -> Any:
    """An attempt as the index has it, with its score's pass mark and rows."""
    score = {"rules": {"pass_mark": mark}, "rows": list(rows)}
    return replace(one, passed=passed, document=json.dumps({"score": score}))


def test_results_keep_the_rules_of_cmi5() -> None:
    some = (
        *SOME,
        scored(SOME[0], 50.0, True),
        scored(SOME[0], 60.0, False),
        scored(SOME[1], 59.99999, False),  # enough points, and a required metric failed
        replace(SOME[0], passed=None),
        scored(replace(SOME[0], total=59.999), 60.0, False),
        replace(SOME[0], total=-3.0, passed=False),
    )
    told = [json.loads(json.dumps(one.statement)) for one in statements(results(*some), HOME)]
    assert [broken_cmi5_rules(one) for one in told] == [[]] * len(some)
    marks = [one["context"].get("extensions") for one in told]
    name = "https://w3id.org/xapi/cmi5/context/extensions/masteryscore"
    assert marks[4:7] == [{name: 0.5}, {name: 0.6}, None]
    assert told[7]["result"] == {"duration": "PT30.00S", "completion": True}
    wrong = told[0] | {"result": told[0]["result"] | {"completion": True}}
    assert broken_cmi5_rules(wrong) == ["9.5.3: completion"]


def test_what_was_measured_stands_by_names_that_end_in_its_unit() -> None:
    rows = (
        {"name": "lateral_error", "unit": "mm", "value": 2.123456},
        {"name": "angle_error", "unit": "°", "value": 0.0},
        {"name": "saturation", "unit": "%", "value": 12.5},
        {"name": "control_scans", "unit": "scans", "value": 3.0},
        {"name": "peak_force", "unit": "N", "value": None},
        {"name": "path_ratio", "unit": "", "value": 1.5},
    )
    told = statements(results(scored(SOME[0], 60.0, False, *rows)), HOME)[0].statement
    assert broken_rules(json.loads(json.dumps(told))) == []
    assert told["result"]["extensions"] == {
        f"{HOME}/extensions/lateral-error-mm": 2.123,
        f"{HOME}/extensions/angle-error-deg": 0.0,
        f"{HOME}/extensions/saturation-percent": 12.5,
        f"{HOME}/extensions/control-scans": 3.0,
        f"{HOME}/extensions/path-ratio": 1.5,
    }


def test_the_same_attempt_is_the_same_statement_and_another_is_another() -> None:
    once, twice = (statements(results(*SOME), HOME) for _ in range(2))
    assert [one.statement for one in once] == [one.statement for one in twice]
    assert len({one.id for one in once}) == 4
    elsewhere = statements(results(*SOME), "https://other.example")
    assert {one.id for one in once}.isdisjoint(one.id for one in elsewhere)
    backwards = statements(results(*reversed(SOME)), HOME + "/")
    assert {one.id for one in backwards} == {one.id for one in once}


def test_what_is_nobodys_void_aborted_or_of_a_script_leaves_no_statement() -> None:
    some = (
        attempt("s1", "p-a", 70.0, 1, hand="arm"),
        attempt("s2", "typed", 70.0, 1),
        replace(attempt("s3", "p-a", 70.0, 2), state="aborted"),
        replace(attempt("s4", "p-a", 70.0, 3), stands=False),
        attempt("s5", "p-a", 70.0, 4),
    )
    told = statements(results(*some, said={"s5": Remarks(void="the phone rang")}), HOME)
    assert told == []


def test_a_void_attempt_is_taken_back_by_the_id_that_its_statement_had() -> None:
    before = {one.id for one in statements(results(*SOME), HOME)}
    said = {"a1": Remarks(void="the phone rang"), "a2": Remarks(excess="beyond the limit")}
    voiding = voiding_statements(results(*SOME, said=said), HOME)
    assert len(voiding) == 2
    assert set(voiding) < before
    for voided, one in voiding.items():
        assert broken_rules(json.loads(json.dumps(one.statement))) == []
        assert one.statement["verb"]["id"] == "http://adlnet.gov/expapi/verbs/voided"
        assert one.statement["object"] == {"objectType": "StatementRef", "id": voided}
        assert one.id not in before


@pytest.mark.parametrize("home", ["hospital", "ftp://x.example", "https://x y", "https://"])
def test_an_address_that_begins_no_id_is_refused(home: str) -> None:
    with pytest.raises(ExportError, match="give an address that you own"):
        statements(results(*SOME), home)


def test_a_file_is_an_array_or_one_statement_a_line() -> None:
    told = statements(results(*SOME), HOME)
    lines = statements_text(told, array=False).splitlines()
    assert [json.loads(line) for line in lines] == json.loads(statements_text(told, array=True))
