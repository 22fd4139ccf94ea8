"""A record that somebody looks at while it is written or ended accuses nobody."""

import os
import time
from pathlib import Path

import pytest
from session_fakes import Bench

from app.session import sidecar as beside
from app.session.errors import SessionError
from app.session.recording import open_recording
from app.session.review import review
from app.session.signature import signature_file
from app.session.store import delete, list_sessions


def ended(folder: Path) -> Path:
    """Record and sign an attempt; return its record, with nothing kept of it."""
    bench = Bench(folder)
    bench.trainer.begin("s")
    bench.run(4.0, 0.05)
    bench.trainer.end()
    (record,) = bench.folder.glob("*.mcap")
    beside.sidecar(record).unlink()
    return record


def cut(record: Path, seconds_ago: float) -> tuple[bytes, bytes]:
    """Put a record back to before its end; return it and its signature as they were."""
    whole, signature = record.read_bytes(), signature_file(record).read_bytes()
    signature_file(record).unlink()
    record.write_bytes(whole[: len(whole) // 2])
    os.utime(record, (time.time() - seconds_ago,) * 2)
    return whole, signature


def test_a_record_that_is_ended_while_a_list_reads_it_is_not_called_altered(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record = ended(tmp_path / "records")
    whole, signature = cut(record, 60.0)
    derive = beside.derive

    def derived_slowly(*arguments):
        summary = derive(*arguments)
        if not signature_file(record).exists():
            record.write_bytes(whole)
            os.utime(record, (time.time() - 20.0,) * 2)
            signature_file(record).write_bytes(signature)
        return summary

    monkeypatch.setattr(beside, "derive", derived_slowly)
    (first,) = list_sessions(record.parent)
    assert (first.state, first.signature) == ("unfinished", "unsigned")
    (then,) = list_sessions(record.parent)
    assert (then.state, then.signature) == ("ended", "verified")


def test_a_running_attempt_is_said_to_be_recorded_and_is_not_deleted(tmp_path: Path) -> None:
    record = ended(tmp_path / "records")
    cut(record, 1.0)
    (summary,) = list_sessions(record.parent)
    assert (summary.state, summary.signature) == ("unfinished", "unsigned")
    assert "it is being recorded" in summary.reason
    assert summary.problems == ()
    with pytest.raises(SessionError, match="is being recorded: end its attempt first"):
        delete(record.parent, record.stem)
    assert record.exists()
    cut_off = time.time() - 60.0
    os.utime(record, (cut_off, cut_off))
    delete(record.parent, record.stem)


def test_the_debrief_of_an_altered_record_shows_no_points_either(tmp_path: Path) -> None:
    record = ended(tmp_path / "records")
    before = review(open_recording(record))
    assert before.problems == ()
    assert before.score is not None
    data = bytearray(record.read_bytes())
    data[len(data) // 2] ^= 1
    record.write_bytes(bytes(data))
    shown = review(open_recording(record))
    assert shown.score is None
    assert shown.reason.startswith("altered after it was signed")
    assert shown.rings == before.rings


def test_the_debrief_of_a_running_attempt_finds_no_fault_in_its_missing_end(tmp_path: Path) -> None:
    record = ended(tmp_path / "records")
    cut(record, 1.0)
    shown = review(open_recording(record))
    assert (shown.score, shown.problems) == (None, ())
    assert shown.reason == beside.BEING_RECORDED
