"""`acus session export ID --dicom`, `acus pacs send`: the expert's attempt as DICOM objects."""

import json
import sys
from pathlib import Path

import highdicom
import numpy as np
import pydicom
import pytest

sys.path.append(str(Path(__file__).parents[1] / "imaging"))
sys.path.append(str(Path(__file__).parents[1] / "exchange"))
from lrs_server import ScriptedLrs, answer
from test_imaging_results import validated

from app.__main__ import main
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.session.recording import read_recording
from tests.virtual_attempt import attempt


@pytest.fixture
def made(tmp_path):
    """An attempt on a small built-in patient: its record and plan."""
    place = tmp_path / "made"
    _, plan = attempt(phantom_series(1, slices=64, rows=128), place)
    (record,) = place.glob("*.mcap")
    return record, plan


@pytest.fixture
def acus(monkeypatch, capsys, made):
    monkeypatch.setenv("ACUS_SESSIONS", str(made[0].parent))

    def run(*words, code=0, command=("session", "export", made[0].stem)):
        monkeypatch.setattr("sys.argv", ["acus", *command, *map(str, words), "--json"])
        with pytest.raises(SystemExit) as ended:
            main()
        out, err = capsys.readouterr()
        assert ended.value.code == code, err
        return json.loads(out)["facts"] if out else err

    return run


@pytest.mark.long("journey")
def test_an_attempt_leaves_as_objects_and_reaches_an_archive(acus, made, tmp_path):
    record, plan = made
    taken = {"00081199": {"vr": "SQ", "Value": [{}, {}, {}]}}
    ct = phantom_series(1, slices=64, rows=128)
    facts = acus("--dicom", tmp_path / "out", "--ct", ct)
    files = [Path(name) for name in facts["files"]]
    with ScriptedLrs(answer(200, taken)) as server:
        web = f"http://127.0.0.1:{server.port}/dw"
        sent = acus(tmp_path / "out", "--web", web, command=("pacs", "send"))
    assert sent == {"to": f"127.0.0.1:{server.port}", "objects": 3}
    assert {path.name for path in files} == {"rtstruct.dcm", "gsps.dcm", "sr.dcm"}
    assert any("no structures" in note for note in facts["notes"])
    for path in files:
        assert validated(path) == []
        assert b"tester" not in path.read_bytes()  # who practised
    report = highdicom.sr.srread(tmp_path / "out" / "sr.dcm")
    points = {
        one.tracking_identifier: one.roi.value[0]
        for one in report.content.get_planar_roi_measurement_groups(
            graphic_type=highdicom.sr.GraphicTypeValues3D.POINT
        )
    }
    assert np.abs(points["Entry"] - plan.entry_mm).max() < 1e-3
    assert np.abs(points["Target"] - plan.target_mm).max() < 1e-3
    # The tip by the placement's own rule: LPS = entry + R^T (tip - fulcrum), in millimetres.
    recording = read_recording(record)
    placed = recording.placed_plan()
    tip = recording.samples.tip[np.isfinite(recording.samples.tip).all(axis=1)][-1]
    rotation = placed.T_world_patient.rotation
    expected = plan.entry_mm + 1e3 * rotation.T @ (tip - placed.p_entry)
    assert np.abs(points["Tip"] - expected).max() < 1e-3
    ct = pydicom.dcmread(load_ct(Path(facts["ct"])).series.files[0])
    assert all(pydicom.dcmread(p).StudyInstanceUID == ct.StudyInstanceUID for p in files)


@pytest.mark.long("journey")
def test_what_cannot_be_is_said_in_one_line(acus, tmp_path, monkeypatch):
    out = tmp_path / "out"
    other = phantom_series(2, slices=64, rows=128)
    assert "made on another CT" in acus("--dicom", out, "--ct", other, code=2)
    assert "goes with --dicom" in acus("--out", out, "--ct", other, code=2)
    assert "give --out FILE" in acus(code=2)
    assert "exclude each other" in acus("--dicom", out, "--trajectory", code=2)
    assert not out.exists()


@pytest.mark.long("journey")
def test_only_objects_of_attempts_are_sent(monkeypatch, capsys, tmp_path):
    def send(*words):
        monkeypatch.setattr("sys.argv", ["acus", "pacs", "send", *map(str, words)])
        with pytest.raises(SystemExit) as ended:
            main()
        assert ended.value.code == 2
        return capsys.readouterr().err

    assert "there is no folder" in send(tmp_path / "nosuch")
    assert "holds no DICOM objects: give the folder" in send(tmp_path)
    ct = phantom_series(1, slices=64, rows=128)
    assert "is not an object of an attempt: nothing was sent" in send(ct)
    (tmp_path / "sr.dcm").write_text("cut")
    assert "sr.dcm cannot be read" in send(tmp_path)
    (tmp_path / "sr.dcm").unlink()
    own = pydicom.dcmread(next(iter(sorted(ct.glob("*.dcm")))))
    own.SeriesDescription = "Acus: first insertion"
    own.save_as(tmp_path / "sr.dcm")
    assert "no PACS is configured" in send(tmp_path, "--pacs", "x")
    assert "plain http" in send(tmp_path, "--web", "http://pacs.school.example/dicom-web")
    assert "give --pacs NAME, or --web URL" in send(tmp_path, "--user", "ada")
