import threading
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import QLabel, QMessageBox, QWidget
from window_rig import plan

from app.compose.desktop import unusable_files
from app.compose.plugins import refused_files
from app.core import plugin_folders
from app.core.disclaimer import DISCLAIMER
from app.core.events import Event
from app.imaging import scanning
from app.imaging.series import Listing
from app.planning.needle_overlay import NeedleOverlay
from app.planning.plan import Plan
from app.session.transitions import PAUSED_WORDS, RESUMED_WORDS, PauseCause
from app.session.withdrawal import KIND, WORDS, Start
from app.views.exercise.feature import ExerciseFeature
from app.views.plan.feature import PlanFeature
from app.views.series.browser import SeriesBrowser
from app.views.shell.shortcuts import ShortcutSheet
from app.views.shell.window import MainWindow, tell_pause
from app.views.slices.panes import PaneId
from app.views.slices.viewing import Tool


def test_the_start_page_carries_the_disclaimer_and_the_exercises(window):
    texts = {label.text() for label in window.start_page.findChildren(QLabel)}
    assert DISCLAIMER in texts
    assert len(window.start_page.map.places) == len(window.feature(ExerciseFeature).exercises)
    assert window.pages.currentWidget() is window.start_page


def test_a_patient_comes_up_in_all_panes(window, patient, settle):
    window.show_patient(patient)
    assert window.pages.currentWidget() is window.workspace
    assert all(pane.canvas.plane is not None for pane in window.workspace.panes)
    assert "CT-TEST" in window.windowTitle()
    assert settle(lambda: not window.conductor._surfaces.is_running)


def test_a_finished_plan_starts_robot_and_needle(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert window.editor.verdict.placed is not None
    assert settle(lambda: window.workspace.viewing.needle is not None)
    needle = window.workspace.viewing.needle
    draft = window.editor.edit.draft
    path = np.subtract(draft.target_mm, draft.entry_mm)
    expected = draft.entry_mm + 10.0 * path / np.linalg.norm(path)
    assert needle.tip_mm == pytest.approx(expected, abs=1e-6)
    assert len(services.opened) == 1


def test_another_plan_moves_the_same_trainer(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.editor.place(Tool.TARGET, (6.0, 6.0, 141.0), True)
    assert len(services.opened) == 1
    assert tuple(window.runs.run.placed.plan.target_mm) == (6.0, 6.0, 141.0)


def test_the_plan_is_locked_while_an_attempt_runs(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.workspace.exercise_panel.buttons.start.click()
    assert settle(lambda: window.editor.locked)
    assert window.workspace.grid.shown.panes[:2] == ("in_plane", "in_plane_90")
    window.editor.undo()
    assert "attempt" in window.message_bar.text
    before = window.editor.edit
    window.message_bar.clear()
    window.feature(PlanFeature).files.new()  # the menu, Ctrl+N, and the panel's button
    assert "attempt" in window.message_bar.text
    window.editor.opened(Path("other.mrk.json"), Plan((0, 0, 0), (0, 0, 50)))
    assert window.editor.edit == before
    assert window.workspace.viewing.draft.complete


def test_a_trainer_that_cannot_start_is_told_and_the_program_goes_on(
    window, patient, services, settle
):
    services.refuses = "no robot answers on /dev/x: connect it"
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: "no robot answers" in window.message_bar.text)
    assert window.workspace.viewing.draft.complete


def test_another_patient_ends_the_trainer_of_the_last(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.editor.saved(Path("kept"))
    window.show_patient(patient)
    assert services.opened[0].closed.wait(30.0)
    assert window.workspace.viewing.needle is None


@pytest.mark.parametrize("kind", ["empty", "missing", "text"])
def test_a_folder_that_cannot_be_opened_is_told(window, tmp_path, settle, kind):
    folder = tmp_path / kind
    if kind != "missing":
        folder.mkdir()
    if kind == "text":
        (folder / "notes.dcm").write_text("not an image")
    window.open_ct.open_folder(folder)
    assert settle(lambda: window.message_bar.text != "")
    assert window.pages.currentWidget() is window.start_page


def test_a_dropped_folder_is_opened(window, tmp_path, monkeypatch):
    opened = []
    monkeypatch.setattr(window.open_ct, "open_folder", opened.append)
    data = QMimeData()
    data.setUrls([QUrl.fromLocalFile(str(tmp_path))])
    none = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier
    window.dropEvent(QDropEvent(QPointF(), Qt.DropAction.CopyAction, data, *none))
    assert opened == [tmp_path]


def test_several_usable_series_are_offered(window, volume, monkeypatch, settle):
    other = type(volume.series)(**{n: getattr(volume.series, n) for n in volume.series.__slots__}
                                | {"uid": "7"})  # fmt: skip
    listing = Listing(Path("x"), (volume.series, other), ())
    monkeypatch.setattr(scanning, "scan_folder", lambda *_: listing)
    window.open_ct.open_folder(Path("x"))
    assert settle(lambda: bool(window.findChildren(SeriesBrowser)))
    for dialog in window.findChildren(SeriesBrowser):
        dialog.reject()


def test_a_click_on_the_skin_in_3d_places_the_entry(window, patient):
    window.show_patient(patient)
    viewing = window.workspace.viewing
    viewing.set_tool(Tool.ENTRY)
    window.workspace.scene.clicked.emit(np.array([5.0, -100.0, 140.0]), np.array([0.0, 1.0, 0.0]))
    assert window.editor.edit.draft.entry_mm == pytest.approx((5.0, -18.5, 140.0), abs=1.0)
    assert viewing.tool is Tool.NAVIGATE


def test_a_click_beside_the_patient_in_3d_is_told(window, patient):
    window.show_patient(patient)
    window.workspace.viewing.set_tool(Tool.ENTRY)
    window.workspace.scene.clicked.emit(np.array([500.0, 0.0, 140.0]), np.array([0.0, 1.0, 0.0]))
    assert window.editor.edit.draft.entry_mm is None
    assert "body" in window.message_bar.text


@pytest.mark.long("journey")
def test_a_pause_is_said_on_every_page_until_the_attempt_goes_on(window):
    seen = window.conductor.controller.event_seen
    seen.emit(Event(1.0, "state", "paused", {}))
    seen.emit(Event(1.0, "pause", PAUSED_WORDS[PauseCause.CAMERAS], {"cause": "cameras"}))
    assert window.message_bar.text == PAUSED_WORDS[PauseCause.CAMERAS]
    assert not window.message_bar.isHidden()
    seen.emit(Event(2.0, "pause", RESUMED_WORDS[PauseCause.CAMERAS], {"duration_s": 1.0}))
    assert window.message_bar.isHidden()


def test_a_first_window_is_no_larger_than_the_screen(window):
    screen, least = window.screen().availableGeometry(), window.minimumSize()
    assert window.width() <= max(screen.width(), least.width())
    assert window.height() <= max(screen.height(), least.height())


def test_window_and_level_are_remembered(services, window, patient, destroy):
    window.show_patient(patient)
    window.workspace.panes[0].viewing.set_window(type(window.workspace.viewing.window)(123, 45))
    window.close()
    again = MainWindow(services)
    destroy(again)
    remembered = again.workspace.viewing.window
    assert (remembered.width, remembered.level) == (123, 45)


def test_an_unsaved_plan_can_keep_the_window_open(window, patient, monkeypatch):
    window.show_patient(patient)
    plan(window)
    monkeypatch.setattr(QMessageBox, "question", lambda *_: QMessageBox.StandardButton.Cancel)
    assert not window.close()


@pytest.mark.long("journey")
def test_closing_leaves_no_thread_behind(application, services, patient, settle, destroy):
    window = MainWindow(services)
    destroy(window)
    window.show()
    window.show_patient(patient)
    plan(window)
    settle(lambda: window.runs.run is not None)
    window.editor.saved(Path("kept"))
    window.close()
    assert services.opened[0].closed.is_set()
    ours = lambda: [t for t in threading.enumerate() if t.name.startswith("acus-")]  # noqa: E731
    assert settle(lambda: not ours()), ours()


def test_heavy_parts_load_once_the_window_is_shown(window, services, settle):
    assert not services.prepared.is_set()
    window.show()
    assert settle(services.prepared.is_set)


def test_a_part_that_cannot_be_loaded_is_told(window, services, settle):
    services.missing = "no module named 'vtkmodules'"
    window.show()
    assert settle(lambda: "vtkmodules" in window.message_bar.text)


def test_a_force_law_that_is_refused_is_listed_with_the_reason(window, services, settle):
    services.unusable = ("mine.py, line 7: a while loop may never end",)
    window.show()
    assert settle(lambda: "mine.py, line 7: a while loop" in window.message_bar.text)


def test_every_key_of_the_menus_is_used_once(window):
    keys = [
        key.toString()
        for action in window.findChildren(type(window.undo_action))
        for key in action.shortcuts()
    ]
    assert len(keys) == len(set(keys))


def test_the_sheet_of_keys_opens(window):
    window.show_shortcuts()
    sheet = window.findChild(ShortcutSheet)
    assert sheet is not None
    sheet.reject()


def test_nothing_sticks_out_of_the_window_at_1366_by_768(window, patient, settle):
    window.show_patient(patient)
    window.resize(1366, 768)
    settle(timeout=0.1)
    assert window.width() == 1366
    assert window.height() == 768
    panel = window.feature(PlanFeature).panel
    for child in panel.findChildren(QWidget):
        if child.isVisible():
            right = child.mapTo(panel, child.rect().topRight()).x()
            assert right <= panel.width(), child
    assert window.workspace.panes[0].width() > 450


def test_an_overlay_comes_from_world_to_patient():
    from app.core.transform import RigidTransform

    transform = RigidTransform.from_translation([0.1, 0.0, 0.0])
    overlay = NeedleOverlay.of_world(
        np.array([0.1, 0.0, -0.05]), np.array([0.0, 0.0, -1.0]), 0.2, transform
    )
    assert overlay.tip_mm == pytest.approx((0, 0, -50))
    assert overlay.start_mm == pytest.approx((0, 0, 150))


def test_the_slices_are_axial_sagittal_and_coronal_in_this_order(window):
    order = [pane.pane for pane in window.workspace.panes]
    assert order == [PaneId.AXIAL, PaneId.SAGITTAL, PaneId.CORONAL]


@pytest.fixture
def without_folder(tmp_path, monkeypatch):
    """A folder of plug-ins is listed and not there."""
    gone = tmp_path / "gone_claw"
    monkeypatch.setenv("ACUS_PLUGINS", str(gone))
    plugin_folders.folders.cache_clear()
    plugin_folders.refused.clear()
    yield gone
    monkeypatch.undo()
    plugin_folders.folders.cache_clear()
    plugin_folders.refused.clear()


def test_a_folder_of_plugins_that_is_missing_is_told_as_a_folder_when_the_window_opens(
    application, services, without_folder, destroy
):
    window = MainWindow(services)
    destroy(window)
    words = "A folder of plug-ins cannot be used"
    assert window.message_bar.text == f"{words}: {without_folder}: there is no such folder"
    assert not window.message_bar.isHidden()
    assert not services.prepared.is_set(), "before anything is loaded"


def test_the_files_that_cannot_be_used_do_not_name_the_folder_once_more(without_folder):
    assert plugin_folders.refused_folders() == (f"{without_folder}: there is no such folder",)
    told = [file for file in refused_files() if file.path == without_folder]
    assert [file.kind for file in told] == ["folder"]
    assert [one for one in unusable_files() if "gone_claw" in one] == []


def test_that_the_needle_is_withdrawn_is_not_said_once_it_waits_for_the_student(window):
    note = window.workspace.exercise_panel.withdrawal
    tell_pause(window.message_bar, Event(0.0, KIND, WORDS[Start.SIMULATED], {}))
    note.show_snapshot(SimpleNamespace(withdrawal=WORDS[Start.SIMULATED], may_confirm=False))
    assert window.message_bar.text == WORDS[Start.SIMULATED]
    note.show_snapshot(SimpleNamespace(withdrawal="", may_confirm=False))
    assert window.message_bar.isHidden()
