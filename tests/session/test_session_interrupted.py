"""Attempts that were cut off: offered unless somebody writes them, closed as they stand."""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from session_fakes import Bench

from app.session.errors import SessionError
from app.session.index import Index
from app.session.interrupted import QUIET_S, interrupted, is_cut_off, recover
from app.session.recording import read_recording
from app.session.replay import why_not
from app.session.sidecar import read_summary
from app.session.store import delete, restore
from app.session.summary import UNFINISHED


def age(path, seconds=10 * QUIET_S):
    then = time.time() - seconds
    os.utime(path, (then, then))


@pytest.fixture(scope="module")
def attempt(tmp_path_factory):
    """A folder with an attempt that is being recorded, and what a kill would leave of it."""
    folder = tmp_path_factory.mktemp("attempt")
    bench = Bench(folder)
    bench.trainer.begin("s")
    bench.run(3.0, 0.03)
    (written,) = folder.glob("*.mcap")
    yield bench, written
    bench.trainer.end()


@pytest.fixture
def cut(attempt, tmp_path):
    """A record that a killed program left, with a tail that is not whole."""
    path = tmp_path / "cut.mcap"
    path.write_bytes(attempt[1].read_bytes() + b"\x06\xff\x00")
    age(path)
    return path


@pytest.mark.long("journey")
def test_a_record_without_its_end_is_offered_and_kept_as_unfinished_with_all_that_is_whole(cut):
    folder = cut.parent
    before = read_recording(cut)
    found, fresh = interrupted(folder)
    assert [one.id for one in found] == ["cut"]
    assert not fresh
    recover(folder, "cut")
    after = read_recording(cut)
    assert after.complete
    assert not any("footer" in problem or "cut off" in problem for problem in after.problems)
    assert np.array_equal(after.samples.time, before.samples.time)
    assert np.array_equal(after.inputs.values, before.inputs.values)
    assert why_not(after.inputs) == ""
    summary = read_summary(cut)
    assert (summary.state, summary.score) == (UNFINISHED, None)
    assert "interrupted after 3 s" in summary.reason
    assert interrupted(folder) == ([], False)
    age(cut)
    Index(folder).refresh()
    (row,) = Index(folder).attempts()
    assert (row.state, row.total, row.counts) == (UNFINISHED, None, False)


@pytest.mark.skipif(os.name != "posix", reason="needs locks")
def test_a_record_that_a_running_program_writes_is_never_offered_nor_closed(attempt):
    bench, written = attempt
    age(written)  # as if the program was stopped for long
    assert is_cut_off(written)
    assert interrupted(bench.folder) == ([], False)
    before = written.read_bytes()
    with pytest.raises(SessionError, match="running program"):
        recover(bench.folder, written.stem)
    assert written.read_bytes() == before


def test_what_grew_a_moment_ago_is_looked_at_once_more(cut):
    age(cut, 1.0)
    assert interrupted(cut.parent) == ([], True)
    with pytest.raises(SessionError, match="try again"):
        recover(cut.parent, "cut")


def test_recovering_twice_changes_nothing_and_leaves_nothing_beside(cut):
    recover(cut.parent, "cut")
    once = cut.read_bytes()
    recover(cut.parent, "cut")
    assert cut.read_bytes() == once
    assert [p.name for p in cut.parent.iterdir() if p.suffix != ".json"] == ["cut.mcap"]


def test_a_discarded_one_comes_back_and_is_offered_again(cut):
    delete(cut.parent, "cut")
    assert interrupted(cut.parent) == ([], False)
    restore(cut.parent, "cut")
    assert [one.id for one in interrupted(cut.parent)[0]] == ["cut"]


def test_what_is_no_record_or_damaged_from_its_beginning_is_not_offered(cut):
    folder = cut.parent
    for name, data in (("text", b"a text of many letters"), ("empty", b""), ("head", b"\x89MCAP0")):
        (folder / f"{name}.mcap").write_bytes(data)
        age(folder / f"{name}.mcap")
    (folder / "torn.mcap").write_bytes(cut.read_bytes()[:40])
    age(folder / "torn.mcap")
    assert [one.id for one in interrupted(folder)[0]] == ["cut"]


@pytest.mark.skipif(os.name != "posix" or os.geteuid() == 0, reason="needs a folder that is closed")
def test_a_folder_that_cannot_be_written_is_said_and_nothing_is_lost(cut):
    before = cut.read_bytes()
    cut.parent.chmod(0o500)
    try:
        with pytest.raises(SessionError, match="cannot recover"):
            recover(cut.parent, "cut")
    finally:
        cut.parent.chmod(0o700)
    assert cut.read_bytes() == before


def test_a_full_disk_while_recovering_loses_nothing(cut, monkeypatch):
    before = cut.read_bytes()

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("app.session.interrupted.os.fsync", full)
    with pytest.raises(SessionError, match="No space left"):
        recover(cut.parent, "cut")
    assert cut.read_bytes() == before
    assert not list(cut.parent.glob("*.part"))


@pytest.mark.long("journey")
def test_an_attempt_that_had_ended_when_the_program_was_killed_keeps_its_score(tmp_path):
    bench = Bench(tmp_path / "whole")
    bench.trainer.begin("s")
    bench.run(4.0, 0.05)
    result = bench.trainer.end()
    (path,) = bench.folder.glob("*.mcap")
    assert not is_cut_off(path)
    assert result.score is not None
    shutil.copy(path, tmp_path / "cut.mcap")
    data = path.read_bytes()
    (tmp_path / "cut.mcap").write_bytes(data[: len(data) - 60])  # killed while it was closed
    age(tmp_path / "cut.mcap")
    whole = read_summary(path)
    recover(tmp_path, "cut")
    found = read_summary(tmp_path / "cut.mcap")
    assert found.state == whole.state
    assert found.score == whole.score


CHILD = """
import sys, time
from datetime import UTC, datetime
from pathlib import Path
from app.session.header import SessionHeader
from app.session.recorder import Recorder
recorder = Recorder(Path(sys.argv[1]), SessionHeader("k", datetime.now(UTC), 0.0, "s", "x"))
recorder.open()
print("open", flush=True)
time.sleep(60)
"""


@pytest.mark.skipif(os.name != "posix", reason="needs locks")
def test_another_program_holds_its_record_until_it_is_killed(tmp_path):
    with subprocess.Popen(
        [sys.executable, "-c", CHILD, str(tmp_path)],
        stdout=subprocess.PIPE,
        cwd=Path(__file__).parents[2],
    ) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == b"open\n"
        path = tmp_path / "k.mcap"
        age(path)
        assert interrupted(tmp_path) == ([], False)
        child.kill()
        child.wait(timeout=30)
    assert [one.id for one in interrupted(tmp_path)[0]] == ["k"]


@pytest.fixture(scope="module")
def ended(tmp_path_factory):
    """The whole record of an attempt that was scored."""
    bench = Bench(tmp_path_factory.mktemp("ended"))
    bench.trainer.begin("s")
    bench.insertion()
    bench.trainer.end()
    (path,) = bench.folder.glob("*.mcap")
    return path


@pytest.mark.parametrize("share", [0.99, 0.95, 0.8, 0.5])
def test_a_record_that_was_cut_has_a_score_only_if_all_of_its_attempt_is_there(
    ended, tmp_path, share
):
    whole, path = read_recording(ended), tmp_path / "cut.mcap"
    path.write_bytes(ended.read_bytes()[: int(share * ended.stat().st_size)])
    age(path)
    left, summary = read_recording(path), read_summary(path)
    if len(left.samples.time) < len(whole.samples.time):
        assert summary.state == UNFINISHED
    assert (summary.score is None) == (summary.state == UNFINISHED)
    assert any("cut off" in problem for problem in summary.problems)
