"""Planning help in the window: the table, the map in every pane, nothing chosen by itself."""

import threading

import numpy as np
import pytest

import app.imaging.skin as skin
from app.core.arrays import frozen
from app.planning.draft import DraftPlan
from app.planning.paths import PathObstacle, PathScores, best
from app.planning.patient import Patient
from app.views.plan.paths import PathsFeature, PathsPanel

TARGET = (-6.0, 5.0, 140.0)
"""Beside the rod of bone of the box."""


def scores(values, blocked=()):
    """Paths of these scores from entries 20 mm apart."""
    count = len(values)
    block = np.zeros(count, np.intp)
    block[list(blocked)] = tuple(PathObstacle).index(PathObstacle.BONE)
    score = np.array(values, float)
    score[list(blocked)] = np.nan
    entries = np.array([(20.0 * n, -18.0, 140.0) for n in range(count)]).reshape(count, 3)
    return PathScores(
        target_mm=frozen(np.array(TARGET)), entries_mm=entries, score=score, block=block,
        length_mm=np.linspace(40.0, 60.0, count), angle_deg=np.linspace(5.0, 30.0, count),
        bone_mm=np.zeros(count), lung_mm=np.zeros(count), vessel_mm=np.zeros(count),
        gut_mm=np.zeros(count), heart_mm=np.zeros(count), pleural_deg=np.full(count, np.nan),
        clear_mm=np.linspace(12.0, 3.0, count),
        nearest_mm=np.linspace(4.0, 9.0, count),
        nearest=np.zeros(count, np.intp), names=("Aorta",),
    )  # fmt: skip


@pytest.fixture
def panel(application, destroy):
    panel = PathsPanel()
    destroy(panel)
    return panel


@pytest.fixture
def planned(window, patient):
    window.show_patient(patient)
    window.editor.start(DraftPlan(None, TARGET, "map me"))
    return window


def texts(panel, column):
    return [panel.table.item(row, column).text() for row in range(panel.table.rowCount())]


# --- the table --------------------------------------------------------------------------------
def test_rows_are_sorted_best_first_and_blocked_paths_are_not_listed(panel):
    found = scores([55.0, 90.0, 10.0, 70.0, 80.0], blocked=(4,))
    panel.show_scores(found, best(found))
    assert texts(panel, 0) == ["90", "70", "55", "10"]
    assert "4 of 5" in panel.note.text()


def test_nothing_is_chosen_before_a_click(panel):
    told = []
    panel.shown.connect(told.append)
    panel.taken.connect(told.append)
    found = scores([55.0, 90.0])
    panel.show_scores(found, best(found))
    assert panel.table.selectedItems() == []
    assert panel.table.currentRow() == -1
    assert not panel.take.isEnabled()
    panel.take.clicked.emit()
    assert told == []


def test_a_click_looks_and_only_the_button_takes(panel):
    read, taken = [], []
    panel.shown.connect(read.append)
    panel.taken.connect(taken.append)
    found = scores([55.0, 90.0])
    panel.show_scores(found, best(found))
    panel.table.selectRow(1)
    assert read == [0]
    assert taken == []
    panel.take.click()
    assert taken == [0]


def test_a_second_map_forgets_what_was_chosen_in_the_first(panel):
    found = scores([55.0, 90.0])
    panel.show_scores(found, best(found))
    panel.table.selectRow(0)
    panel.show_scores(found, best(found))
    assert panel.table.selectedItems() == []
    assert not panel.take.isEnabled()


@pytest.mark.parametrize("found", [scores([]), scores([50.0, 60.0], blocked=(0, 1))])
def test_a_result_without_any_path_says_what_to_do(panel, found):
    panel.show_scores(found, best(found))
    assert panel.table.rowCount() == 0
    assert not panel.take.isEnabled()
    assert "turn the patient" in panel.note.text()


def test_a_map_without_structures_says_that_it_knows_none(panel):
    found = scores([50.0])
    object.__setattr__(found, "names", ())
    object.__setattr__(found, "nearest", np.array([-1]))
    panel.show_scores(found, best(found))
    assert texts(panel, 3) == ["none"]
    assert "No structure warns" in panel.note.text()


# --- the helper -------------------------------------------------------------------------------
def test_there_is_no_map_without_a_target(window, patient):
    window.show_patient(patient)
    window.editor.start(None)
    assert not window.feature(PathsFeature).panel.make.isEnabled()
    window.feature(PathsFeature).make()
    assert window.progress.count == 0


@pytest.mark.long("journey")
def test_a_map_is_made_shown_and_changes_no_plan_until_a_path_is_taken(planned, settle):
    before = planned.editor.edit.draft
    planned.feature(PathsFeature).make()
    assert settle(lambda: planned.feature(PathsFeature).scores is not None)
    assert planned.editor.edit.draft == before
    table = planned.feature(PathsFeature).panel.table
    assert table.rowCount() > 0
    assert table.selectedItems() == []
    table.selectRow(0)
    assert planned.editor.edit.draft == before  # looking is not choosing
    number = best(planned.feature(PathsFeature).scores)[0]
    entry = planned.feature(PathsFeature).scores.entries_mm[number]
    np.testing.assert_allclose(planned.workspace.viewing.cursor_mm, entry, atol=1.0)
    planned.feature(PathsFeature).panel.take.click()
    np.testing.assert_allclose(planned.editor.edit.draft.entry_mm, entry)
    planned.editor.undo()
    assert planned.editor.edit.draft == before


@pytest.mark.long("journey")
def test_cancelling_leaves_neither_map_nor_message(planned, settle, monkeypatch):
    begun, real = threading.Event(), skin.skin_points

    def slow(body, progress):
        begun.set()
        for _ in range(2000):
            progress.report(0.5)  # raises once it is cancelled
            threading.Event().wait(0.005)
        return real(body, progress=progress)

    monkeypatch.setattr(skin, "skin_points", slow)
    planned.feature(PathsFeature).make()
    assert settle(begun.is_set)
    assert not planned.feature(PathsFeature).panel.make.isEnabled()
    planned.feature(PathsFeature)._task.cancel()
    assert settle(lambda: planned.feature(PathsFeature).panel.make.isEnabled())
    assert planned.feature(PathsFeature).scores is None
    assert planned.message_bar.text == ""


def test_another_target_takes_the_map_away(planned, settle):
    planned.feature(PathsFeature).make()
    assert settle(lambda: planned.feature(PathsFeature).scores is not None)
    planned.editor.start(DraftPlan(None, (-7.0, 6.0, 140.0), "another"))
    assert planned.feature(PathsFeature).scores is None
    assert planned.feature(PathsFeature).panel.table.rowCount() == 0


@pytest.mark.long("journey")
def test_a_failure_is_told_and_another_try_is_possible(planned, settle, monkeypatch):
    def fails(body, progress):
        raise ValueError("no skin here")

    monkeypatch.setattr(skin, "skin_points", fails)
    planned.feature(PathsFeature).make()
    assert settle(lambda: "no skin here" in planned.message_bar.text)
    assert planned.feature(PathsFeature).panel.make.isEnabled()


@pytest.mark.long("journey")
def test_the_map_reaches_panes_that_a_later_layout_shows(planned, settle):
    planned.feature(PathsFeature).make()
    assert settle(lambda: planned.feature(PathsFeature).scores is not None)
    planned.editor.take(
        planned.editor.edit.draft.with_entry((-6.0, -18.0, 140.0)), planned.editor.edit.placement
    )
    assert planned.feature(PathsFeature).scores is not None  # another entry, the same target
    planned.workspace.show_layout("needle")
    pane = planned.workspace.needle_panes[0]
    assert settle(lambda: pane.canvas.plane is not None)
    layer = planned.feature(PathsFeature)._layers[planned.workspace.slices.index(pane)]
    assert settle(lambda: layer._dots.isVisible() and len(layer._dots._places) > 0)


@pytest.mark.long("journey")
def test_patients_that_come_and_go_leave_no_map(planned, patient, settle):
    planned.feature(PathsFeature).make()
    assert settle(lambda: planned.feature(PathsFeature).scores is not None)
    planned.show_patient(Patient(patient.volume, patient.body, "CT-OTHER"))
    assert planned.feature(PathsFeature).scores is None
