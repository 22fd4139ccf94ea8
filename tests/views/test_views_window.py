import threading
from pathlib import Path
from types import MappingProxyType, SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QMimeData, QPointF, Qt, QUrl
from PySide6.QtGui import QDropEvent
from PySide6.QtWidgets import QLabel, QMessageBox, QWidget
from views_robot_fakes import FakeBench

from app.core.disclaimer import DISCLAIMER
from app.core.errors import AcusError
from app.core.events import EventQueue
from app.core.state_vector import empty_state
from app.exercises.library import library
from app.exercises.scene import device_of
from app.imaging import scanning
from app.imaging.body import find_body
from app.imaging.orthogonal import View
from app.imaging.series import Listing
from app.session.curves import Offset
from app.session.machine import State
from app.session.needle import DepthSource, NeedlePose
from app.session.snapshot import Snapshot
from app.views.exercise.run import ExerciseRun
from app.views.grid import FIVE
from app.views.needle_overlay import NeedleOverlay
from app.views.patient import Patient
from app.views.robot.wizard_pages import ConnectionPage
from app.views.series_dialog import SeriesDialog
from app.views.services import RobotPort
from app.views.shortcuts import ShortcutSheet
from app.views.slices.viewing import Tool
from app.views.window import MainWindow


# --- the whole window --------------------------------------------------------------------------
class FakeTrainer:
    def __init__(self, placed):
        self.placed, self.events, self.result, self.state = placed, EventQueue(), None, State.READY

    def snapshot(self):
        placed = self.placed
        axis, tip = placed.axis, placed.p_entry + 0.01 * placed.axis
        pose = NeedlePose(tip, axis, 0.01, 1.0, 0.0, 0.0, DepthSource.TRACKED, True,
                          1e-9 * np.eye(3))  # fmt: skip
        device = SimpleNamespace(tick=9, q=np.array([3.0, 0.1]), hub=tip - 0.2 * axis,
                                 felt=np.zeros(3), fault=0, row=empty_state(),
                                 qd=np.zeros(2), torque=np.zeros(2))  # fmt: skip
        timing = SimpleNamespace(median=8e-5, p99=2e-4, missed=0, ticks=9)
        offset = Offset(*[0.0] * len(Offset.__dataclass_fields__))
        return Snapshot(1.0, self.state, "", 0.0, MappingProxyType({}), pose, offset,
                        placed.p_target, device, timing, None, "valid", 0, 1.0, False, None,
                        ())  # fmt: skip

    def begin(self, student="", hand=""):
        self.state = State.ALIGNING
        return "session-1"

    def heartbeat(self): ...
    def assistance(self, value): ...
    def hand(self, *_): ...
    def arm(self): ...
    def disarm(self): ...


class FakeOpen:
    def __init__(self, setup):
        self.closed, self.setup = threading.Event(), setup
        self.run = ExerciseRun(
            FakeTrainer(setup.placed), setup.placed, device_of(setup.exercise), interactive=True,
            held_arming=setup.robot.held_arming, port=setup.robot.port,
        )  # fmt: skip

    def place(self, placed):
        self.run.trainer.placed = placed
        self.run = ExerciseRun(self.run.trainer, placed, self.run.profile)
        return self.run

    def close(self):
        self.closed.set()


class FakeServices:
    def __init__(self, folder):
        self.folder, self.opened, self.refuses = folder, [], ""
        self.prepared, self.missing = threading.Event(), ""
        self.ports, self.benches = (RobotPort("/dev/ttyACM0", "icube A17 on /dev/ttyACM0"),), []

    def robots(self):
        return self.ports

    def open_robot(self, port, profile, progress):
        if self.refuses:
            raise AcusError(self.refuses)
        self.benches.append(FakeBench())
        return self.benches[-1]

    def exercises(self):
        return tuple(library().exercises)

    def sessions(self):
        return self.folder

    def prepare(self, progress):
        self.prepared.set()
        if self.missing:
            raise ImportError(self.missing)

    def open_run(self, setup, progress):
        if self.refuses:
            raise AcusError(self.refuses)
        self.opened.append(FakeOpen(setup))
        return self.opened[-1]


@pytest.fixture
def services(tmp_path):
    return FakeServices(tmp_path)


@pytest.fixture
def window(application, services, destroy):
    window = MainWindow(services)
    destroy(window)
    window.show()
    yield window
    window.editor.saved(Path("kept"))


@pytest.fixture
def patient(volume):
    return Patient(volume, find_body(volume), "CT-TEST")


def plan(window):
    window.editor.place(Tool.ENTRY, (5.0, -18.0, 140.0), True)
    window.editor.place(Tool.TARGET, (5.0, 5.0, 140.0), True)


def test_the_start_page_carries_the_disclaimer_and_the_exercises(window):
    texts = {label.text() for label in window.start_page.findChildren(QLabel)}
    assert DISCLAIMER in texts
    assert window.start_page.exercises.count() == len(window.exercises)
    assert window.pages.currentWidget() is window.start_page


def test_a_patient_comes_up_in_all_panes(window, patient, settle):
    window.show_patient(patient)
    assert window.pages.currentWidget() is window.workspace
    assert all(pane.canvas.plane is not None for pane in window.workspace.panes)
    assert "CT-TEST" in window.windowTitle()
    assert settle(lambda: not window.conductor._surfaces.is_running, 20.0)


def test_a_finished_plan_starts_robot_and_needle(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert window.editor.verdict.placed is not None
    assert settle(lambda: window.workspace.viewing.needle is not None, 10.0)
    needle = window.workspace.viewing.needle
    draft = window.editor.edit.draft
    path = np.subtract(draft.target_mm, draft.entry_mm)
    expected = draft.entry_mm + 10.0 * path / np.linalg.norm(path)
    assert needle.tip_mm == pytest.approx(expected, abs=1e-6)
    assert len(services.opened) == 1


def test_another_plan_moves_the_same_trainer(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    window.editor.place(Tool.TARGET, (6.0, 6.0, 141.0), True)
    assert len(services.opened) == 1
    assert tuple(window.runs.run.placed.plan.target_mm) == (6.0, 6.0, 141.0)


def test_the_plan_is_locked_while_an_attempt_runs(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    window.workspace.exercise_panel.buttons.start.click()
    assert settle(lambda: window.editor.locked, 5.0)
    assert window.workspace.grid.cells == FIVE
    window.editor.undo()
    assert "attempt" in window.message_bar.text


def test_a_trainer_that_cannot_start_is_told_and_the_program_goes_on(
    window, patient, services, settle
):
    services.refuses = "no robot answers on /dev/x: connect it"
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: "no robot answers" in window.message_bar.text, 10.0)
    assert window.workspace.viewing.draft.complete


def test_another_patient_ends_the_trainer_of_the_last(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    window.editor.saved(Path("kept"))
    window.show_patient(patient)
    assert services.opened[0].closed.wait(5.0)
    assert window.workspace.viewing.needle is None


@pytest.mark.parametrize("kind", ["empty", "missing", "text"])
def test_a_folder_that_cannot_be_opened_is_told(window, tmp_path, settle, kind):
    folder = tmp_path / kind
    if kind != "missing":
        folder.mkdir()
    if kind == "text":
        (folder / "notes.dcm").write_text("not an image")
    window.open_ct.open_folder(folder)
    assert settle(lambda: window.message_bar.text != "", 20.0)
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
    assert settle(lambda: bool(window.findChildren(SeriesDialog)), 5.0)
    for dialog in window.findChildren(SeriesDialog):
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


def test_closing_leaves_no_thread_behind(application, services, patient, settle, destroy):
    window = MainWindow(services)
    destroy(window)
    window.show()
    window.show_patient(patient)
    plan(window)
    settle(lambda: window.runs.run is not None, 10.0)
    window.editor.saved(Path("kept"))
    window.close()
    assert services.opened[0].closed.is_set()
    ours = lambda: [t for t in threading.enumerate() if t.name.startswith("acus-")]  # noqa: E731
    assert settle(lambda: not ours(), 10.0), ours()


def test_heavy_parts_load_once_the_window_is_shown(window, services, settle):
    assert not services.prepared.is_set()
    window.show()
    assert settle(services.prepared.is_set, 5.0)


def test_a_part_that_cannot_be_loaded_is_told(window, services, settle):
    services.missing = "no module named 'vtkmodules'"
    window.show()
    assert settle(lambda: "vtkmodules" in window.message_bar.text, 5.0)


def test_every_key_of_the_menus_is_used_once(window):
    keys = [
        key.toString()
        for action in window.findChildren(type(window.menus.undo))
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
    panel = window.workspace.plan_panel
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
    order = [pane.view for pane in window.workspace.panes]
    assert order == [View.AXIAL, View.SAGITTAL, View.CORONAL]


# --- the robot ---------------------------------------------------------------------------------
def test_another_robot_ends_the_run_and_begins_one_on_it(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    window.menus.robot.robots.aboutToShow.emit()
    texts = [action.text() for action in window.menus.robot.robots.actions()]
    assert texts == ["Simulated robot", "icube A17 on /dev/ttyACM0", "", "Other port…"]
    window.menus.robot.robots.actions()[1].trigger()
    assert services.opened[0].closed.wait(5.0)
    assert settle(lambda: window.runs.run is not None, 10.0)
    assert len(services.opened) == 2
    assert services.opened[1].setup.robot.port == "/dev/ttyACM0"
    assert services.opened[1].setup.robot.held_arming
    assert not window.workspace.exercise_panel.enable.isHidden()
    assert window.robot.settings.port == "/dev/ttyACM0"


def test_a_robot_that_was_chosen_is_offered_though_it_is_gone(window, services):
    window.robot.choose("/dev/ttyACM0")
    services.ports = ()
    assert [robot.title for robot in window.robot.ports()] == ["/dev/ttyACM0 – not plugged in"]
    window.robot.choose("")


def test_choosing_a_robot_again_tries_again(window, patient, services, settle):
    services.refuses = "there is no port"
    window.robot.choose("/dev/ttyACM0")
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: "no port" in window.message_bar.text, 10.0)
    empty = window.workspace.health_panel._empty
    assert "No robot is running" in empty.text()
    services.refuses = ""
    window.robot.choose("/dev/ttyACM0")
    assert "starting" in empty.text()
    assert settle(lambda: window.runs.run is not None, 10.0)
    assert window.message_bar.isHidden()
    assert "starting" not in empty.text()
    window.robot.choose("")


def test_a_robot_is_taken_for_once_without_being_remembered(window, patient, services, settle):
    window.robot.choose("/dev/ttyACM0")
    window.robot.take("/tmp/robot")
    assert window.robot.settings.port == "/dev/ttyACM0"
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    assert services.opened[-1].setup.robot.port == "/tmp/robot"
    window.robot.choose("")
    assert window.robot.port == ""


def test_holding_can_be_practised_on_the_simulated_robot(window, patient, services, settle):
    window.robot.set_practise_holding(True)
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    assert services.opened[0].setup.robot.held_arming
    assert window.menus.robot.holding.isChecked()
    window.robot.set_practise_holding(False)
    assert settle(lambda: len(services.opened) == 2, 10.0)


def test_the_robot_stays_while_an_attempt_runs(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    window.workspace.exercise_panel.buttons.start.click()
    assert settle(lambda: window.editor.locked, 5.0)
    window.robot.choose("/dev/ttyACM0")
    window.robot.commission()
    assert "end it first" in window.message_bar.text
    assert window.robot.settings.port == ""
    assert services.benches == []


def test_the_wizard_has_the_robot_for_itself_and_gives_it_back(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    window.robot.choose("/dev/ttyACM0")
    assert settle(lambda: len(services.opened) == 2 and window.runs.run is not None, 10.0)
    window.robot.commission()
    assert settle(lambda: window.robot.wizard is not None, 10.0)
    assert services.opened[1].closed.is_set()
    assert window.runs.run is None
    assert isinstance(window.robot.wizard.page, ConnectionPage)
    window.robot.wizard.reject()
    assert services.benches[0].closed == 1
    assert settle(lambda: window.runs.run is not None, 10.0)
    assert len(services.opened) == 3


def test_the_simulated_robot_needs_no_commissioning(window, patient, services):
    window.show_patient(patient)
    window.robot.commission()
    assert "needs no commissioning" in window.message_bar.text
    assert services.benches == []


def test_a_robot_that_does_not_open_is_told_and_the_run_comes_back(
    window, patient, services, settle
):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None, 10.0)
    window.robot.choose("/dev/ttyACM0")
    assert settle(lambda: len(services.opened) == 2 and window.runs.run is not None, 10.0)
    services.refuses = "nobody answers on /dev/ttyACM0: check cable and power"
    window.robot.commission()
    assert settle(lambda: "nobody answers" in window.message_bar.text, 10.0)
    services.refuses = ""
    assert window.robot.wizard is None


def test_the_robots_health_stands_beside_the_panes(window, patient, services, settle):
    window.show_patient(patient)
    plan(window)
    window.menus._show_health()
    panel = window.workspace.health_panel
    assert settle(lambda: panel.groups != (), 10.0)
    assert window.workspace.side.currentWidget() is panel
    window.editor.saved(Path("kept"))
    window.show_patient(patient)
    assert settle(lambda: panel.groups == (), 10.0)


def test_the_hand_is_remembered(services, window, destroy):
    box = window.workspace.bullseye.source.box
    box.setCurrentIndex(1)
    box.activated.emit(1)
    window.settings.sync()
    again = MainWindow(services)
    destroy(again)
    assert again.workspace.bullseye.source.name == "tablet"
