"""The position of the patient to and from 3D Slicer, from the menu."""

import numpy as np
import pytest
from PySide6.QtWidgets import QFileDialog
from window_rig import plan

from app.exchange.transforms import read_tfm, write_tfm
from app.planning.placement import PatientOrientation, Placement, placement_of
from app.views.plan.position import PositionFeature


@pytest.fixture
def placed(window, patient, settle):
    window.show_patient(patient)
    plan(window)
    window.editor.set_placement(Placement(PatientOrientation.PRONE, (5.0, -10.0, 20.0)))
    settle()
    return window


@pytest.fixture
def told(placed):
    notes, errors = [], []
    placed.feature(PositionFeature).noted.connect(notes.append)
    placed.feature(PositionFeature).failed.connect(errors.append)
    return notes, errors


@pytest.mark.long("journey")
def test_what_is_exported_comes_back_and_can_be_undone(placed, told, tmp_path, monkeypatch):
    path = tmp_path / "placed.tfm"
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", staticmethod(lambda *_: (str(path.with_suffix("")), ""))
    )
    monkeypatch.setattr(QFileDialog, "getOpenFileName", staticmethod(lambda *_: (str(path), "")))
    before = placed.editor.edit.placement
    placed.feature(PositionFeature).ask_export()
    placed.editor.set_placement(Placement())
    placed.feature(PositionFeature).ask_open()
    after = placed.editor.edit.placement
    assert after.orientation is PatientOrientation.PRONE
    np.testing.assert_allclose(after.rotation, before.rotation, atol=1e-12)
    placed.undo.undo()
    assert placed.editor.edit.placement == Placement()
    notes, errors = told
    assert [note.split()[0] for note in notes] == ["Exported", "Position"]
    assert not errors


@pytest.mark.long("journey")
def test_the_other_direction_is_refused_and_a_shift_that_cannot_be_kept_is_said(
    placed, told, tmp_path
):
    notes, errors = told
    path = tmp_path / "placed.tfm"
    placed.feature(PositionFeature).export(path)
    T_patient_world = read_tfm(path)
    placed.editor.set_placement(Placement())
    write_tfm(path, T_patient_world.inverse())
    placed.feature(PositionFeature).open(path)
    assert "other direction" in str(errors[-1])
    assert placed.editor.edit.placement == Placement()
    shifted = type(T_patient_world)(
        T_patient_world.rotation, T_patient_world.translation + [0.0, 0.003, 0.004]
    )
    write_tfm(path, shifted)
    placed.open_dropped(path)
    assert "5.0 mm" in notes[-1]
    assert placed.editor.edit.placement.orientation is PatientOrientation.PRONE


@pytest.mark.long("journey")
def test_without_a_plan_and_with_a_file_that_is_none_it_says_so(window, patient, tmp_path):
    errors = []
    window.feature(PositionFeature).failed.connect(errors.append)
    window.feature(PositionFeature).export(tmp_path / "a.tfm")
    window.show_patient(patient)
    window.feature(PositionFeature).export(tmp_path / "a.tfm")
    (tmp_path / "b.tfm").write_text("nothing")
    window.feature(PositionFeature).open(tmp_path / "b.tfm")
    assert len(errors) == 3
    assert "exercise" in str(errors[0])
    assert "b.tfm" in str(errors[2])
    assert not (tmp_path / "a.tfm").exists()


@pytest.mark.parametrize("orientation", PatientOrientation)
def test_every_rotation_becomes_a_placement_of_the_same_rotation(orientation):
    rng = np.random.default_rng(5)
    for vector in (*rng.uniform(-100.0, 100.0, (20, 3)), (180.0, 0.0, 0.0), (0.0, 0.0, 0.0)):
        wanted = Placement(orientation, tuple(vector)).rotation
        found = placement_of(wanted)
        np.testing.assert_allclose(found.rotation, wanted, atol=1e-9)
    assert placement_of(orientation.rotation) == Placement(orientation)
