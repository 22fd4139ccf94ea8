"""`acus session list | show | export`."""

import csv
import json
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from app.__main__ import main
from app.commands import demo
from app.core.clock import VirtualClock
from app.core.disclaimer import DISCLAIMER
from app.core.events import Event
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.session.facts import PLAN, plan_record
from app.session.header import SessionHeader
from app.session.recorder import Recorder


@pytest.fixture
def store(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    placed = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 60.0, 0.0])), Placement(), np.zeros(3))
    for name in ("20260115-100000-aaaa", "20260116-100000-bbbb"):
        started = datetime(2026, 1, int(name[6:8]), 10, tzinfo=UTC)
        header = SessionHeader(name, started, 0.0, "s-1", "e", metadata={PLAN: plan_record(placed)})
        recorder = Recorder(tmp_path, header, clock=VirtualClock())
        recorder.open()
        recorder.event(Event(0.5, "scan", "control scan 1", {"number": 1}))
        recorder.finish(result={"state": "ended", "reason": "", "duration_s": "1.5"})
    (tmp_path / "broken.mcap").write_bytes(b"no")
    monkeypatch.setenv("ACUS_SESSIONS", str(tmp_path))
    return tmp_path


def run(monkeypatch: pytest.MonkeyPatch, *arguments: str) -> int:
    monkeypatch.setattr("sys.argv", ["acus", "session", *arguments])
    try:
        main()
    except SystemExit as stop:
        return int(stop.code or 0)
    return 0


def test_list_shows_newest_first_and_broken_ones_with_the_reason(
    store: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    assert run(monkeypatch, "list") == 0
    text = capsys.readouterr().out
    assert text.index("bbbb") < text.index("aaaa")
    assert "not an MCAP file" in text


def test_list_and_show_say_that_an_attempt_of_the_arm_is_no_students(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ACUS_SESSIONS", str(tmp_path))
    monkeypatch.setenv("COLUMNS", "200")
    placed = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 60.0, 0.0])), Placement(), np.zeros(3))
    for name, hand in (("aaaa", "arm"), ("bbbb", "mouse")):
        begun = datetime(2026, 1, 15, 10, tzinfo=UTC)
        facts = {PLAN: plan_record(placed), "trainee": {"scripted": "", "hand": hand}}
        header = SessionHeader(f"20260115-100000-{name}", begun, 0.0, "s-1", "e", metadata=facts)
        recorder = Recorder(tmp_path, header, clock=VirtualClock())
        recorder.open()
        if hand == "arm":
            recorder.event(Event(0.5, "taken_over", "taken over by pen", {"hand": "pen"}))
        recorder.finish(result={"state": "ended", "reason": "", "duration_s": "1.5"})
    assert run(monkeypatch, "list") == 0
    of_arm, of_student = sorted(
        line for line in capsys.readouterr().out.splitlines() if "20260115" in line
    )
    assert "no student's attempt: arm then pen" in of_arm
    assert "no student's" not in of_student
    for name, said in (("aaaa", True), ("bbbb", False)):
        assert run(monkeypatch, "show", f"20260115-100000-{name}") == 0
        assert ("no student's attempt: arm then pen" in capsys.readouterr().out) is said


def test_list_as_json_has_the_documented_keys(
    store: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "list", "--folder", str(store), "--json") == 0
    document = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)["facts"]
    assert document["folder"] == str(store)
    assert {s["state"] for s in document["sessions"]} == {"ended", "broken"}
    for session in document["sessions"]:
        assert session.keys() == {
            "version",
            "id",
            "started",
            "student",
            "exercise",
            "state",
            "reason",
            "duration_s",
            "scans",
            "score",
            "problems",
            "software",
            "calibration",
            "conditions",
            "note",
            "signature",
        }


def test_show_takes_the_beginning_of_an_id(
    store: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "show", "20260115") == 0
    text = capsys.readouterr().out
    assert "control scan 1" in text
    assert DISCLAIMER in text
    assert run(monkeypatch, "show", "20260115", "--json") == 0
    document = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)["facts"]
    assert document["events"][0]["kind"] == "scan"
    assert 0.0 <= document["events"][0]["time_s"] <= document["duration_s"]
    assert document["complete"] is True
    assert document["duration_s"] == 1.5


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("show", "nope"), "'nope' is no session"),
        (("show", "2026"), "fits several sessions"),
        (("show", "broken"), "not an MCAP file"),
        (("list", "--folder", "/nonexistent"), "is not a folder"),
        (("export", "--out", "x.txt"), "only .csv can be written"),
        (("export", "--out", "x.csv", "--trajectory"), "exactly one session id"),
        (("export", "nope", "--out", "x.csv"), "is no session"),
    ],
)
def test_bad_input_is_one_line_on_stderr_and_exit_code_2(
    store: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    arguments: tuple[str, ...],
    said: str,
) -> None:
    assert run(monkeypatch, *arguments) == 2
    captured = capsys.readouterr()
    assert captured.err.count("\n") == 1
    assert said in captured.err
    assert captured.out == ""


def test_export_writes_all_or_the_chosen_attempts(
    store: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    out = tmp_path / "out.csv"
    assert run(monkeypatch, "export", "--out", str(out)) == 0
    rows = list(csv.DictReader(out.read_text(encoding="utf-8-sig").splitlines()))
    assert len(rows) == 3
    assert {row["note"] for row in rows} == {DISCLAIMER}
    assert run(monkeypatch, "export", "20260116", "20260115", "--out", str(out)) == 0
    rows = list(csv.DictReader(out.read_text(encoding="utf-8-sig").splitlines()))
    assert [row["id"][-4:] for row in rows] == ["bbbb", "aaaa"]
    assert run(monkeypatch, "export", "20260116", "--trajectory", "--out", str(out)) == 0


def test_a_list_into_a_pipe_breaks_no_word(
    store: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("COLUMNS", "40")
    assert run(monkeypatch, "list") == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split()[:3] == ["id", "student", "exercise"]
    assert [line.split()[0] for line in lines[1:]] == [
        "broken", "20260116-100000-bbbb", "20260115-100000-aaaa"
    ]  # fmt: skip


@pytest.mark.parametrize(
    "words", [("list",), ("show",), ("show", "--json"), ("replay",), ("verify",), ("compare",)]
)
def test_what_a_record_of_somebody_else_says_steers_no_terminal(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...],
) -> None:
    evil, name = "a\x1b]0;owned\x07b\x9b2Jc\u202ed", "20260115-100000-aaaa"
    monkeypatch.setenv("ACUS_SESSIONS", str(tmp_path))
    placed = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 60.0, 0.0])), Placement(), np.zeros(3))
    facts = {
        PLAN: plan_record(placed),
        "trainee": {"scripted": "", "hand": evil},
        "exercise": {"id": evil, "title": evil, evil: evil},
        evil: {evil: evil},
    }
    begun = datetime(2026, 1, 15, 10, tzinfo=UTC)
    header = SessionHeader(name, begun, 0.0, evil, "e", metadata=facts)
    recorder = Recorder(tmp_path, header, clock=VirtualClock())
    recorder.open()
    recorder.event(Event(0.5, evil, evil, {evil: evil}))
    recorder.finish(result={"state": "ended", "reason": evil, "duration_s": "1.5"})
    noun, *rest = words
    run(monkeypatch, noun, *(() if noun == "list" else (name,) * (1 + (noun == "compare"))), *rest)
    out, err = capsys.readouterr()
    assert out
    assert not set("\x1b\x07\x9b\u202e") & set(out + err)
    if noun in ("list", "show"):
        assert r"\u001b" in out


# --- a record by its path -------------------------------------------------------------------------
@pytest.fixture
def elsewhere(store: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A record in the folder that a demonstration leaves; this user's own folder is empty."""
    kept = tmp_path / "shown" / "sessions"
    kept.mkdir(parents=True)
    record = kept / "20260115-100000-aaaa.mcap"
    (store / record.name).rename(record)
    own = tmp_path / "own"
    own.mkdir()
    monkeypatch.setenv("ACUS_SESSIONS", str(own))
    return record


@pytest.mark.parametrize("command", ["show", "replay"])
@pytest.mark.parametrize("given", ["record", "sessions", "demonstration"])
def test_a_record_is_known_by_its_path_and_by_the_folder_that_holds_it_alone(
    elsewhere: Path,
    command: str,
    given: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    paths = {
        "record": elsewhere,
        "sessions": elsewhere.parent,
        "demonstration": elsewhere.parents[1],
    }
    assert run(monkeypatch, command, str(paths[given])) == 0
    assert capsys.readouterr().err == ""


def test_a_relative_path_of_a_record_works_too(
    elsewhere: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(elsewhere.parents[1])
    assert run(monkeypatch, "show", str(elsewhere.relative_to(Path.cwd()))) == 0


def test_a_folder_of_several_records_or_none_asks_for_a_file(
    elsewhere: Path,
    store: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (elsewhere.parent / "20260116-100000-bbbb.mcap").write_bytes(b"another")
    assert run(monkeypatch, "show", str(elsewhere.parent)) == 2
    assert "holds 2 records: give the file of one of them" in capsys.readouterr().err
    empty = store / "empty"
    empty.mkdir()
    assert run(monkeypatch, "show", str(empty)) == 2
    assert "holds 0 records" in capsys.readouterr().err


def test_what_a_demonstration_prints_leads_to_its_record(
    elsewhere: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shown = SimpleNamespace(score=None, record=elsewhere)
    demo._tell(shown, SimpleNamespace(pictures=elsewhere.parents[1]), False)
    printed = capsys.readouterr().out
    path = next(line for line in printed.splitlines() if line.startswith("session: "))
    assert run(monkeypatch, "show", path.split()[1]) == 0
    folder = printed.splitlines()[0].removeprefix("pictures and report are in ")
    assert run(monkeypatch, "replay", folder) == 0
