"""Scores are computed again wherever one is shown; what was written is not believed."""

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from shutil import copyfile

import pytest
from typer.testing import CliRunner

from app.commands import build as command_line
from app.core.exits import Exit
from app.exchange.csv_export import score_table
from app.scoring.conditions import DeviceKind, comparable
from app.scoring.version import KNOWN_VERSIONS, SCORING_VERSION
from app.session.recording import read_recording
from app.session.review import review
from app.session.sidecar import cached, fresh_summary, read_summary, sidecar, verify_record
from app.session.station import StationKey
from app.session.store import computed, list_sessions
from app.session.verify import verify
from tests.kept_records import with_score

FOLDER = Path(__file__).parents[1] / "data" / "records"
TOTAL = 22.22222222222222
"""Points of both records."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Records of a hand that swings, the second with the dial turned; nothing beside them."""
    for path in FOLDER.glob("*.mcap"):
        copyfile(path, tmp_path / path.name)
    return tmp_path


def run(*words: str) -> tuple[int, str]:
    result = CliRunner().invoke(command_line(), list(words))
    return result.exit_code, result.output


def test_an_honest_record_is_confirmed_with_code_0(folder: Path) -> None:
    path = next(folder.glob("*a001.mcap"))
    assert verify(read_recording(path)).changes == ()
    code, said = run("session", "verify", path.stem, "--folder", str(folder))
    assert code == Exit.DONE
    assert "confirmed: 22" in said


def test_an_edited_file_beside_the_record_is_believed_nowhere(folder: Path) -> None:
    path = next(folder.glob("*a002.mcap"))
    good = read_summary(path)
    text = sidecar(path).read_text()
    edited = text.replace(f'"total": {TOTAL}', '"total": 55.5')
    assert edited != text
    sidecar(path).write_text(edited)
    code, said = run("session", "verify", path.stem, "--folder", str(folder))
    assert code == Exit.NO
    assert "55.5" in said
    assert (fresh_summary(path).score or {})["total"] == TOTAL
    sidecar(path).write_text(edited)
    assert read_summary(path) == good  # its own digest is wrong: even a list computes
    assert sidecar(path).read_text() == text  # and has written it anew


@contextmanager
def another_station(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[pytest.MonkeyPatch]:
    """Be a station with data and a key of its own for a while."""
    StationKey.of()
    with monkeypatch.context() as elsewhere:
        elsewhere.setenv("ACUS_DATA", str(tmp_path / "another"))
        StationKey.of()
        yield elsewhere


def test_a_file_beside_the_record_that_another_station_wrote_is_no_edited_one(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = next(folder.glob("*a002.mcap"))
    with another_station(tmp_path, monkeypatch):
        fresh_summary(path)
    before = sidecar(path).read_text()
    code, said = run("session", "verify", path.stem, "--folder", str(folder))
    assert "edited" not in said
    assert f"{path.stem}.json is not sealed by this station" in said
    assert code == Exit.DONE
    assert sidecar(path).read_text() == before


def test_a_file_beside_the_record_of_a_station_with_another_version_is_no_edited_one(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = next(folder.glob("*a002.mcap"))
    with another_station(tmp_path, monkeypatch) as elsewhere:
        elsewhere.setattr("app.session.verify.SCORING_VERSION", SCORING_VERSION + 1)
        assert list_sessions(folder)
    code, said = run("session", "verify", path.stem, "--folder", str(folder))
    assert f"{path.stem}.json is not sealed by this station" in said
    assert f"{path.stem}.json:" not in said
    assert code == Exit.DONE


def test_a_file_with_a_forged_digest_is_found_out_where_a_score_counts(folder: Path) -> None:
    from app.session import sidecar as module

    path = next(folder.glob("*a002.mcap"))
    read_summary(path)
    document = json.loads(sidecar(path).read_text())
    document.pop("digest")
    document["score"]["total"] = 12.0
    document["digest"] = module._digest(document)
    sidecar(path).write_text(json.dumps(document))
    assert (read_summary(path).score or {})["total"] == 12.0  # a list trusts it
    assert not verify_record(path).confirmed
    assert verify(read_recording(path)).confirmed  # the record itself is as it was
    shown = review(read_recording(path)).score
    assert shown is not None
    assert shown.total == TOTAL
    assert run("session", "verify", path.stem, "--folder", str(folder))[0] == Exit.NO
    assert [(s.score or {})["total"] for s in computed(folder)] == [pytest.approx(TOTAL)] * 2


def test_a_score_rewritten_inside_the_record_is_found_out(folder: Path) -> None:
    path = next(folder.glob("*a001.mcap"))
    with_score(path, f'"total":{TOTAL}', f'"total":{TOTAL + 10.0}')
    recording = read_recording(path)
    assert recording.complete
    assert recording.problems == ()
    found = verify(recording)
    assert [change.what for change in found.changes] == ["total"]
    assert run("session", "verify", path.stem, "--folder", str(folder))[0] == Exit.NO


def test_a_score_of_another_version_is_kept_said_and_not_comparable(folder: Path) -> None:
    path = next(folder.glob("*a001.mcap"))
    now, then = KNOWN_VERSIONS[0], KNOWN_VERSIONS[0] - 1  # the records are of the first
    with_score(path, f'"total":{TOTAL}', f'"total":{TOTAL + 70.0:.14f}')
    with_score(path, f'"scoring_version":{now}', f'"scoring_version":{then}')
    shown = review(read_recording(path))
    assert shown.score is not None
    assert shown.score.total == pytest.approx(TOTAL + 70.0)
    assert f"scored by version {then}: 92, by today's rules: 0" in shown.problems
    found = verify(read_recording(path))
    assert not found.confirmed
    assert found.changes == ()
    only = "it cannot be checked: this program has the rules of versions 5, 6 and 7"
    assert only in found.sentences()
    assert run("session", "verify", path.stem, "--folder", str(folder))[0] == Exit.NO
    old = fresh_summary(path).conditions
    assert old is not None
    from dataclasses import replace

    assert comparable(old, old) == ()
    assert comparable(old, replace(old, scoring_version=2)) == (f"scored by version: {then} and 2",)


def test_lists_read_a_record_once_and_again_when_it_changed(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from app.session import sidecar as module

    read: list[Path] = []

    def counted(path: Path) -> object:
        read.append(path)
        return read_recording(path)

    monkeypatch.setattr(module, "open_recording", counted)
    first = list_sessions(folder)
    assert len(read) == 2
    assert list_sessions(folder) == first
    assert len(read) == 2  # what was missing had been written
    path = next(folder.glob("*a001.mcap"))
    os.utime(path, ns=(1, 1))
    list_sessions(folder)
    assert read[2:] == [path]
    list_sessions(folder)
    assert len(read) == 3


def test_conditions_stand_in_summary_list_table_and_debrief(folder: Path) -> None:
    path = next(folder.glob("*a002.mcap"))
    known = read_summary(path).conditions
    assert known is not None
    assert known == review(read_recording(path)).conditions
    kept = cached(path)
    assert kept is not None
    assert kept.summary.conditions == known
    assert (known.exercise, known.kind, known.hand) == (
        "against-repulsion",
        DeviceKind.SIMULATED,
        "mouse",
    )
    dial = known.assistance
    assert dial is not None
    assert (dial.least, dial.most) == (-0.5, 0.65)
    assert dial.mean == pytest.approx(0.075, abs=0.01)  # half of the time each
    assert dial.moved
    table = score_table(list_sessions(folder)).splitlines()
    assert "assistance_least" in table[0]
    assert "comparison_group" in table[0]
    assert any("-0.5,0.65" in line for line in table)


def test_two_attempts_are_compared_by_their_conditions_alone(folder: Path) -> None:
    code, said = run(
        "session", "compare", "20261120-080001", "20261120-081002", "--folder", str(folder)
    )
    assert code == Exit.NO
    assert "exercise: first-insertion and against-repulsion" in said
    code, said = run(
        "session", "compare", "20261120-080001", "20261120-080001", "--folder", str(folder)
    )
    assert code == Exit.DONE
    assert "comparable" in said


def test_what_cannot_be_verified_is_no_answer(folder: Path) -> None:
    (folder / "x.mcap").write_bytes(b"no record")
    result = CliRunner().invoke(
        command_line(), ["session", "verify", "x", "--folder", str(folder)], standalone_mode=False
    )
    assert result.exception is not None
    assert "not an MCAP file" in str(result.exception)  # __main__ makes one line and code 2 of it
