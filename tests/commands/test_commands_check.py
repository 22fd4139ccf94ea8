"""`acus check`: what it prints; the whole check runs in tests/test_compose_daily_check.py."""

import json
from datetime import datetime

import pytest

from app.__main__ import main
from app.session.checks.record import DayCheck, save_check
from app.session.checks.steps import CheckVerdict, StepResult


def run(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> int:
    monkeypatch.setattr("sys.argv", ["acus", "check", *arguments])
    try:
        main()
    except SystemExit as stop:
        return int(stop.code or 0)
    return 0


@pytest.fixture(autouse=True)
def _data(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))


def kept(verdict: CheckVerdict) -> None:
    steps = (StepResult("marker", "Marker", verdict, "left: too small", "push the needle on"),)
    save_check(DayCheck.of(steps, datetime.now().astimezone(), "icube", simulated=True))


def test_no_check_is_said(monkeypatch, capsys):
    assert run(monkeypatch, "--last") == 3
    assert "no daily check" in capsys.readouterr().out
    assert run(monkeypatch, "--last", "--json") == 3
    assert json.loads(capsys.readouterr().out)["facts"]["check"] is None


def test_the_newest_check_says_what_to_do_and_ends_with_3(monkeypatch, capsys):
    kept(CheckVerdict.BAD)
    assert run(monkeypatch, "--last") == 3
    text = capsys.readouterr().out
    assert "✖ marker" in text
    assert "→ push the needle on" in text
    assert "check failed today" in text


def test_a_good_check_ends_with_0(monkeypatch, capsys):
    kept(CheckVerdict.GOOD)
    assert run(monkeypatch, "--last", "--json") == 0
    document = json.loads(capsys.readouterr().out)["facts"]["check"]
    assert document["verdict"] == "good"
    assert document["steps"][0]["name"] == "marker"


def test_an_unknown_point_names_the_valid_ones(monkeypatch, capsys):
    assert run(monkeypatch, "--point", "Z") == 2
    assert "it has A, B, C, D, E, F" in capsys.readouterr().err
