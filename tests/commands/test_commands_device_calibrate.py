"""`acus device calibrate`: typed and prepared answers, and what cannot be used."""

import io
import subprocess
import sys
import time

import pytest
from device.commissioning_rig import commission, make
from typer.testing import CliRunner

from app.commands import build
from app.commands.answers import AnswerError, Answers, numbers
from app.commands.device import _commission as _run
from app.device.commissioning.results import RoutineName, RoutineReport
from app.device.errors import CommissioningError, LinkError

CONFIRM = RoutineReport(0.0, "", needs="hold it")
NUMBER = RoutineReport(0.0, "", needs="type the reading", unit="g")


class Routine:
    TITLE = "Test"


def typed(answers, report, tries=200):
    for _ in range(tries):
        value = answers.to(Routine(), report)
        if value is not None:
            return value
        time.sleep(0.005)
    return None


def test_readings_are_numbers_between_commas():
    assert numbers("20.5, 51,102", "--readings", 3) == (20.5, 51.0, 102.0)


@pytest.mark.parametrize("text", ["", "1,2", "1,2,x", "1,nan,2", "1,2,3,4", "inf,1,2"])
def test_readings_that_cannot_be_used_are_named(text):
    with pytest.raises(AnswerError, match="--readings"):
        numbers(text, "--readings", 3)


def test_typed_answers_are_waited_for_and_wrong_ones_asked_again(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", io.StringIO("\nnonsense\nnan\n20,5\n"))
    answers = Answers()
    assert typed(answers, CONFIRM) == 0.0
    assert typed(answers, NUMBER) == 20.5
    out = capsys.readouterr().out
    assert "> hold it [Enter]" in out
    assert "'nonsense' is not a number in g" in out


def test_the_end_of_the_input_ends_the_routine(monkeypatch):
    monkeypatch.setattr("sys.stdin", io.StringIO(""))
    with pytest.raises(AnswerError, match="ended"):
        typed(Answers(), CONFIRM)


def test_prepared_readings_come_in_order_and_a_missing_one_is_named():
    answers = Answers(confirm=True, prepared=(1.0, 2.0))
    assert [answers.to(Routine(), report) for report in (CONFIRM, NUMBER, NUMBER)] == [
        0.0,
        1.0,
        2.0,
    ]
    with pytest.raises(AnswerError, match="--readings"):
        answers.to(Routine(), NUMBER)


def test_a_port_that_is_not_there_is_told(tmp_path):
    result = CliRunner().invoke(build(), ["device", "calibrate", str(tmp_path / "none"), "--yes"])
    assert isinstance(result.exception, LinkError)


@pytest.mark.long("journey")
@pytest.mark.parametrize("command", ["show", "test", "conform", "calibrate"])
def test_a_port_that_is_not_there_is_told_before_anything_is_compiled(command):
    """Compiled code of a new installation takes minutes: numba is not even imported."""
    program = [sys.executable, "-X", "importtime", "-m", "app", "device", command, "/dev/no-board"]
    ended = subprocess.run(program, capture_output=True, text=True, timeout=60, check=False)
    assert ended.returncode == 2
    assert "there is no port /dev/no-board" in ended.stderr
    assert "numba" not in ended.stderr


def test_a_sign_check_that_fails_is_told_with_what_counts_no_more(tmp_path):
    link, bench, person = make(tmp_path)

    class Scripted:
        def to(self, routine, report, as_json):
            return person(report)

    with bench:
        commission(bench, person)
        link.motors[:4] = 0.0, 1, 1, 0
        with pytest.raises(CommissioningError, match=r"swapped.*the earlier sign check counts no"):
            _run(bench, RoutineName.SIGNS, Scripted(), yes=True)
        assert bench.clearance().homed == 0.0
