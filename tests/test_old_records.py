"""Records made before scores carried their conditions: every way of looking at them still works."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication

from app.exchange.csv_export import score_table, trajectory_table
from app.session.recording import read_recording
from app.session.replay import contents
from app.session.review import review
from app.session.store import list_sessions
from app.views.debrief.report import report_bytes

FOLDER = Path(__file__).parent / "data" / "records"
"""Version 1.x: `first-insertion` by hand, `against-repulsion` with the dial turned from -0.5 to
0.65 in the middle, `breathing-liver` by the scripted expert; beside them the lists' files."""

EXERCISES = {"a001": "first-insertion", "a002": "against-repulsion", "a003": "breathing-liver"}


@pytest.fixture
def old(tmp_path: Path) -> Path:
    folder = tmp_path / "old"
    shutil.copytree(FOLDER, folder, copy_function=shutil.copyfile)
    return folder


def records(folder: Path) -> list[Path]:
    found = sorted(folder.glob("*.mcap"))
    assert len(found) == 3
    return found


def stored(path: Path) -> dict[str, object]:
    """What the version that made it kept beside it."""
    document: dict[str, object] = json.loads(
        (FOLDER / path.name).with_suffix(".json").read_text(encoding="utf-8")
    )
    return document


def test_old_records_open_whole_with_what_they_said_then(old: Path) -> None:
    for path in records(old):
        recording, before = read_recording(path), stored(path)
        assert recording.complete
        assert recording.problems == ()
        assert recording.metadata["exercise"]["id"] == EXERCISES[path.stem[-4:]]
        assert len(recording.samples.time) >= 250
        assert np.isfinite(recording.samples.tip).all()
        assert json.loads(recording.attachments["score.json"]) == before["score"]
        assert contents(recording).ticks >= 5000


@pytest.mark.long("journey")
def test_old_records_are_listed_with_and_without_the_files_beside_them(old: Path) -> None:
    for beside in (old / "none", *sorted(old.glob("*.json"))):
        beside.unlink(missing_ok=True)
        found = {summary.id: summary for summary in list_sessions(old)}
        assert len(found) == 3
        for record in records(old):
            summary, before = found[record.stem], stored(record)
            assert summary.exercise_id == EXERCISES[record.stem[-4:]]
            assert summary.state == before["state"] == "ended"
            assert summary.duration == pytest.approx(float(str(before["duration_s"])))
            assert (summary.score or {})["total"] == pytest.approx(100.0)


@pytest.mark.long("journey")
def test_old_records_are_debriefed_and_reported(old: Path) -> None:
    application = QApplication.instance() or QApplication([])
    assert application is not None
    for path in records(old):
        shown = review(read_recording(path))
        assert shown.score is not None
        assert shown.score.total == pytest.approx(100.0)
        assert np.isfinite(shown.track()).any()
        assert report_bytes(shown).startswith(b"%PDF")


@pytest.mark.long("journey")
def test_old_records_are_exported(old: Path) -> None:
    table = score_table(list_sessions(old)).splitlines()
    assert len(table) == 4
    assert all(any(name in line for line in table) for name in EXERCISES.values())
    for path in records(old):
        lines = trajectory_table(read_recording(path)).splitlines()
        assert len(lines) == 1 + len(read_recording(path).samples.time)
