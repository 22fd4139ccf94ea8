"""Records from before devices had kinds, on three geometries: recomputed to the last bit."""

import json

import numpy as np
import pytest

from app.compose.recomputed import replay_recording
from app.session.recording import read_recording
from tests.machine_records import FOLDER, RECORDS


def test_there_is_a_record_for_each_case() -> None:
    assert sorted(path.stem for path in FOLDER.glob("*.mcap")) == sorted(RECORDS)


@pytest.mark.parametrize("name", RECORDS)
def test_a_record_without_a_kind_is_a_pantograph_and_recomputed_to_the_last_bit(name: str) -> None:
    recording = read_recording(FOLDER / f"{name}.mcap")
    assert "kind" not in json.loads(recording.attachments["device.json"])
    report = replay_recording(recording)
    assert report.identical, report.sentences()
    assert report.every_slot
    assert report.ticks >= 600
    assert np.abs(recording.inputs.column("torque_left")).max() > 1e-4
