import json
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PySide6.QtTest import QSignalSpy
from PySide6.QtWidgets import QFileDialog, QMessageBox, QWidget

from app.imaging.body import find_body
from app.mechanisms.profile import load_profile
from app.planning.draft import DraftPlan
from app.planning.placement import PatientOrientation, Placement
from app.planning.plan import Plan
from app.views.kit import theme
from app.views.kit.language import use_language
from app.views.plan.editor import PlanEditor, PlanFiles
from app.views.plan.feature import PlanFeature, PlanPanel
from app.views.plan.verdict import verdict_words
from app.views.shell.settings import Recents, open_settings
from app.views.slices.plane import PaneId
from app.views.slices.presets import default_window
from app.views.slices.viewing import Tool, Viewing

FRONT = (5.0, -18.0, 140.0)
INSIDE = (5.0, 5.0, 140.0)


@pytest.fixture
def editor(application, volume):
    editor = PlanEditor()
    editor.set_body(find_body(volume))
    editor.set_profile(load_profile("icube"))
    return editor


@pytest.fixture
def placed(editor):
    editor.place(Tool.ENTRY, FRONT, True)
    editor.place(Tool.TARGET, INSIDE, True)
    return editor


@pytest.fixture
def files(placed, application):
    window = QWidget()
    yield PlanFiles(placed, Recents(open_settings(), "recent/plans"), window)
    window.deleteLater()


def test_an_entry_lands_on_the_skin(placed):
    entry = placed.edit.draft.entry_mm
    assert entry[1] == pytest.approx(-18.5, abs=0.6)
    assert_allclose([entry[0], entry[2]], [FRONT[0], FRONT[2]], atol=1.0)


def test_an_entry_far_from_the_skin_is_refused_with_the_distance(placed):
    spy = QSignalSpy(placed.refused)
    before = placed.edit
    placed.place(Tool.ENTRY, (5.0, 100.0, 140.0), True)
    assert placed.edit == before
    assert "mm" in spy.at(0)[0]


def test_the_verdict_comes_with_every_change(placed):
    assert placed.verdict.reach.reachable
    assert placed.verdict.placed is not None
    placed.set_placement(Placement(PatientOrientation.PRONE))
    assert not placed.verdict.reach.reachable
    assert placed.verdict.placed is None


def test_the_suggested_rotation_makes_the_path_reachable(placed):
    placed.set_placement(Placement(PatientOrientation.PRONE))
    placed.apply_remedy()
    assert placed.verdict.reach.reachable
    placed.undo()
    placed.undo()
    assert placed.edit.placement == Placement()


def test_a_target_outside_the_body_is_a_problem_and_not_a_path(placed):
    placed.place(Tool.TARGET, (5.0, -29.0, 140.0), True)
    assert "outside the body" in placed.verdict.problem
    assert placed.verdict.placed is None


def test_target_on_entry_is_a_problem(placed):
    placed.place(Tool.TARGET, placed.edit.draft.entry_mm, True)
    assert "apart" in placed.verdict.problem


def test_one_drag_is_one_step_to_undo(placed):
    before = placed.edit
    for n in range(5):
        placed.place(Tool.TARGET, (5.0 + n, 5.0, 140.0), n == 0)
    placed.undo()
    assert placed.edit == before
    placed.redo()
    assert placed.edit.draft.target_mm[0] == pytest.approx(9.0)


def test_a_drag_that_begins_in_the_air_is_still_one_step(placed):
    before = placed.edit
    placed.place(Tool.ENTRY, (5.0, -200.0, 140.0), True)
    placed.place(Tool.ENTRY, (8.0, -18.0, 140.0), False)
    placed.place(Tool.ENTRY, (9.0, -18.0, 140.0), False)
    placed.undo()
    assert placed.edit == before


def test_nothing_changes_while_an_attempt_runs(placed):
    spy = QSignalSpy(placed.refused)
    before = placed.edit
    placed.set_locked(True)
    placed.place(Tool.TARGET, (1.0, 1.0, 140.0), True)
    placed.undo()
    placed.set_placement(Placement(PatientOrientation.PRONE))
    assert placed.edit == before
    assert spy.count() == 3
    assert not placed.can_undo


def test_a_plan_is_saved_and_opened_again_to_the_last_bit(files, placed, tmp_path, monkeypatch):
    path = tmp_path / "my plan"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(path), ""))
    assert placed.dirty
    assert files.save()
    assert not placed.dirty
    written = path.with_name("my plan.mrk.json")
    assert json.loads(written.read_text())["markups"][0]["type"] == "Line"
    draft = placed.edit.draft
    placed.start(None)
    files.open(written)
    assert placed.edit.draft.entry_mm == pytest.approx(draft.entry_mm, abs=1e-9)
    assert placed.path == written
    assert files._recents.paths() == [written.resolve()]


def test_a_broken_plan_file_is_told_and_the_plan_stays(files, placed, tmp_path):
    broken = tmp_path / "broken.mrk.json"
    broken.write_text("{")
    placed.saved(tmp_path / "x")
    spy = QSignalSpy(files.failed)
    before = placed.edit
    files.open(broken)
    assert placed.edit == before
    assert "broken.mrk.json" in str(spy.at(0)[0])


@pytest.mark.parametrize(
    ("answer", "goes"),
    [(QMessageBox.StandardButton.Cancel, False), (QMessageBox.StandardButton.Discard, True)],
)
def test_unsaved_changes_are_asked_about(files, placed, monkeypatch, answer, goes):
    monkeypatch.setattr(QMessageBox, "question", lambda *_: answer)
    files.new()
    assert (placed.edit.draft.entry_mm is None) == goes


def test_saving_cancelled_in_the_dialog_keeps_the_changes(files, placed, monkeypatch):
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    monkeypatch.setattr(QMessageBox, "question", lambda *_: QMessageBox.StandardButton.Save)
    files.new()
    assert placed.edit.draft.complete
    assert placed.dirty


def test_recents_keep_the_newest_first_and_forget_what_is_gone(tmp_path):
    recents = Recents(open_settings(), "recent/x")
    for n in range(12):
        (tmp_path / str(n)).mkdir()
        recents.add(tmp_path / str(n))
    recents.add(tmp_path / "9")
    (tmp_path / "10").rmdir()
    assert [path.name for path in recents.paths()][:3] == ["9", "11", "8"]
    assert len(recents.paths()) <= 8
    assert Recents(open_settings(), "recent/none").paths() == []
    single = Recents(open_settings(), "recent/one")
    single.add(Path(tmp_path / "1"))
    assert [path.name for path in Recents(open_settings(), "recent/one").paths()] == ["1"]


@pytest.fixture
def panel(editor):
    viewing = Viewing(default_window())
    panel = PlanPanel(editor, viewing)
    yield panel
    panel.deleteLater()


@pytest.mark.parametrize("code", ["de", "fr"])
def test_the_panel_has_room_for_its_words_beside_the_pictures(editor, application, code):
    use_language(application, code)
    try:
        panel = PlanPanel(editor, Viewing(default_window()))
        editor.place(Tool.ENTRY, FRONT, True)
        editor.place(Tool.TARGET, INSIDE, True)
        assert panel.minimumSizeHint().width() <= 354  # of a window of 1366 pixels
        panel.deleteLater()
    finally:
        use_language(application, "en")


def test_the_panel_leads_from_nothing_to_a_plan(panel, editor):
    assert "E" in panel.verdict.text()
    editor.place(Tool.ENTRY, FRONT, True)
    assert "T" in panel.verdict.text()
    editor.place(Tool.TARGET, INSIDE, True)
    assert panel.verdict.text().startswith("✔")
    assert theme.GOOD in panel.verdict.styleSheet()
    assert panel.remedy.isHidden()


def test_a_path_out_of_reach_says_why_and_offers_the_rotation(panel, placed):
    index = panel.orientation.findData(PatientOrientation.PRONE.value)
    panel.orientation.setCurrentIndex(index)
    panel.orientation.activated.emit(index)
    assert panel.verdict.text().startswith("✖")
    assert not panel.remedy.isHidden()
    panel.remedy.click()
    assert panel.verdict.text().startswith("✔")


def test_the_spin_boxes_turn_the_patient(panel, placed):
    panel.turns[1].setValue(25.0)
    assert placed.edit.placement.rotation_deg == (0.0, 25.0, 0.0)
    assert verdict_words(placed).measures.startswith("Path")


def test_the_place_buttons_are_the_tool(panel):
    panel.place_entry.click()
    assert panel._viewing.tool is Tool.ENTRY
    panel.place_target.click()
    assert panel._viewing.tool is Tool.TARGET
    assert not panel.place_entry.isChecked()
    panel.place_target.click()
    assert panel._viewing.tool is Tool.NAVIGATE


def test_a_plan_that_comes_with_a_patient_is_not_dirty(editor):
    editor.start(Plan(np.array(FRONT), np.array(INSIDE), "given"))
    assert not editor.dirty
    assert not editor.can_undo


def test_a_target_that_the_exercise_gives_cannot_be_moved_nor_lost(application):
    editor, said = PlanEditor(), []
    editor.refused.connect(said.append)
    editor.start(DraftPlan(None, (0.0, 0.0, 50.0), "own"))
    editor.set_keeps_target(True)
    editor.place(Tool.TARGET, (9.0, 0.0, 50.0), True)
    editor.take(DraftPlan((0.0, -50.0, 50.0), (9.0, 0.0, 50.0)), Placement())
    editor.opened(Path("x"), Plan(np.array([0.0, -50.0, 50.0]), np.array([9.0, 0.0, 50.0])))
    assert len(said) == 3
    assert editor.edit.draft.target_mm == (0.0, 0.0, 50.0)
    editor.place(Tool.ENTRY, (0.0, -50.0, 50.0), True)
    assert editor.edit.draft.complete
    editor.start(None)
    assert editor.edit.draft == DraftPlan(None, (0.0, 0.0, 50.0), "own")


def test_an_entry_that_leaves_its_clicked_slice_says_so(window, patient):
    window.show_patient(patient)
    viewing, panel = window.workspace.viewing, window.feature(PlanFeature).panel
    volume = patient.volume
    beyond, within = volume.lps_mm((30.0, 30.0, 39.0)), volume.lps_mm((30.0, 11.0, 20.0))
    for pane, point, far in (
        (PaneId.AXIAL, beyond, True),
        (PaneId.AXIAL, within, False),
        (PaneId.CORONAL, beyond, False),
        (PaneId.AXIAL, within, False),
        (PaneId.AXIAL, beyond, True),
    ):
        viewing.clicked_pane = pane
        viewing.point_placed.emit(Tool.ENTRY, tuple(map(float, point)), True)
        entry = window.editor.edit.draft.entry_mm
        away = abs(entry[2] - point[2])
        assert (away > 2.0) == (point is beyond)
        assert bool(panel.left_slice.text()) == far
        assert panel.left_slice.isHidden() != far
        if far:
            assert f"{away:.1f} mm out of the slice" in panel.left_slice.text()
    window.editor.undo()
    assert not panel.left_slice.text()
