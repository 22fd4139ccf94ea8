"""Records in the form of today: every way of looking at them works, now and in later versions."""

import shutil
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication

from app.compose.recomputed import replay_recording
from app.exchange.csv_export import score_table, trajectory_table
from app.session.recording import read_recording
from app.session.review import review
from app.session.store import list_sessions
from app.session.verify import verify
from app.views.debrief.report import report_bytes
from tests.kept_records import FOLDER, RECORDS


@pytest.fixture
def kept(tmp_path: Path) -> Path:
    folder = tmp_path / "kept"
    shutil.copytree(FOLDER, folder, copy_function=shutil.copyfile)
    return folder


@pytest.mark.parametrize("name", RECORDS)
def test_a_kept_record_opens_whole_and_its_score_is_confirmed(name: str) -> None:
    recording = read_recording(FOLDER / f"{name}.mcap")
    assert recording.complete
    assert recording.problems == ()
    assert recording.metadata["exercise"]["id"] == RECORDS[name]
    assert len(recording.samples.time) == 60
    assert np.isfinite(recording.samples.tip[-40:]).all()
    found = verify(recording)
    assert found.confirmed  # by the rules of version 5, which it was scored by
    assert found.written is not None
    assert found.written.total is not None


@pytest.mark.parametrize("name", RECORDS)
def test_a_kept_record_is_recomputed_to_the_last_bit_and_forces_acted(name: str) -> None:
    recording = read_recording(FOLDER / f"{name}.mcap")
    report = replay_recording(recording)
    assert report.identical, report.sentences()
    assert report.every_slot
    assert report.ticks >= 1200
    assert np.abs(recording.inputs.column("torque_left")).max() > 1e-3


@pytest.mark.long("journey")
def test_kept_records_are_listed_debriefed_reported_and_exported(kept: Path) -> None:
    application = QApplication.instance() or QApplication([])
    assert application is not None
    found = {summary.id: summary for summary in list_sessions(kept)}
    assert {name: one.exercise_id for name, one in found.items()} == RECORDS
    assert {one.state for one in found.values()} == {"ended"}
    table = score_table(list(found.values())).splitlines()
    assert len(table) == 1 + len(RECORDS)
    for path in sorted(kept.glob("*.mcap")):
        recording = read_recording(path)
        shown = review(recording)
        assert shown.score is not None
        assert np.isfinite(shown.track()).any()
        assert report_bytes(shown).startswith(b"%PDF")
        lines = trajectory_table(recording).splitlines()
        assert len(lines) == 1 + len(recording.samples.time)
