"""Metrics of others run when the attempt is closed and sealed, and change neither."""

import json
from pathlib import Path

import pytest
from session_fakes import Bench

from app.imaging.worker.limits import Allowance
from app.scoring import foreign
from app.session.recording import open_recording
from app.session.review import review
from app.session.sidecar import verify_record
from app.session.store import list_sessions

DECLARED = """
import os, time
from pathlib import Path

DECLARATION = {"title": "T", "unit": "mm", "higher_is_better": False, "reads": ()}


def compute(trajectory):
"""
LOOKS = (
    DECLARED
    + """
    there = Path(os.environ["ACUS_SESSIONS"])
    (record,) = there.glob("*.mcap")
    ended = record.read_bytes().endswith(b"\\x89MCAP0\\r\\n")
    names = sorted(path.suffix for path in there.glob(record.stem + ".*"))
    Path(__file__).with_name("seen.txt").write_text(repr((ended, names)))
    return 4.5
"""
)


@pytest.fixture
def attempt(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Bench:
    monkeypatch.setenv("ACUS_SESSIONS", str(tmp_path / "records"))
    monkeypatch.setenv("ACUS_METRICS", str(tmp_path))
    monkeypatch.setattr(foreign, "LIMIT", Allowance(1.0, 1 << 30, 2.0))
    bench = Bench(tmp_path / "records")
    bench.run(0.1)
    bench.trainer.begin("s-1")
    bench.run(1.0, 0.06)
    return bench


@pytest.mark.long("journey")
def test_the_record_is_closed_and_sealed_before_somebody_elses_metric_runs(
    attempt: Bench, tmp_path: Path
) -> None:
    (tmp_path / "looks.py").write_text(LOOKS)
    result = attempt.trainer.end()
    assert (tmp_path / "seen.txt").read_text() == "(True, ['.json', '.mcap', '.sig'])"
    assert result.score is not None
    assert result.score.row("looks").value == 4.5
    (path,) = (tmp_path / "records").glob("*.mcap")
    assert "looks" not in json.dumps(result.summary.document())
    assert verify_record(path).confirmed
    shown = review(open_recording(path)).score
    assert shown is not None
    assert shown.row("looks").value == 4.5


@pytest.mark.long("journey")
@pytest.mark.parametrize("body", ["raise SystemExit", "os._exit(1)", "while True: pass"])
def test_a_metric_that_would_end_the_program_leaves_a_verified_attempt(
    attempt: Bench, tmp_path: Path, body: str
) -> None:
    (tmp_path / "harms.py").write_text(f"{DECLARED}    {body}\n")
    result = attempt.trainer.end()
    assert result.score is not None
    assert "harms.py" in result.score.row("harms").note
    (listed,) = list_sessions(tmp_path / "records")
    assert listed.signature == "verified"
    assert listed.problems == ()
    assert listed.score is not None
    (path,) = (tmp_path / "records").glob("*.mcap")
    assert verify_record(path).confirmed
