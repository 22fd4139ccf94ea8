"""The menu Cameras: chosen, set up, aimed, measured; a run's cameras are let go first."""

import time

import pytest
from PySide6.QtWidgets import QApplication
from window_rig import plan

from app.session.machine import State
from app.tracking.cameras.settings import CameraSettings, OneCamera, load_settings, save_settings
from app.tracking.cameras.watch import CameraState
from app.tracking.errors import CameraError
from app.views.cameras.feature import CamerasFeature

REAL = CameraSettings(left=OneCamera(source="usb:1-1"), right=OneCamera(source="usb:1-2"))


@pytest.fixture
def running(window, patient, services, settle):
    """A window with a run on the real cameras."""
    save_settings(REAL)
    window.feature(CamerasFeature).use_real(True)
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    return window


@pytest.mark.long("journey")
def test_without_a_choice_the_cameras_are_simulated_and_real_ones_are_asked_for(window, settle):
    menu = window.feature(CamerasFeature).menu
    assert menu.simulated.isChecked()
    assert menu.real.text() == "Real cameras: choose…"
    menu.real.trigger()
    assert window.equipment.dialog is not None
    assert menu.simulated.isChecked()
    window.equipment.dialog.reject()


@pytest.mark.long("journey")
def test_choosing_real_cameras_begins_a_run_on_them_and_is_remembered(running, services):
    assert services.opened[-1].setup.cameras == REAL
    assert running.feature(CamerasFeature).menu.real.isChecked()
    assert running.feature(CamerasFeature).menu.real.text() == "Real cameras: usb:1-1, usb:1-2"
    assert str(running.settings.value("cameras/real")).lower() == "true"


@pytest.mark.long("journey")
def test_simulated_cameras_can_be_taken_for_this_start_only(running, services, settle):
    running.equipment.take_cameras(CameraSettings())
    assert settle(lambda: services.opened[-1].setup.cameras is None)
    assert str(running.settings.value("cameras/real")).lower() == "true"


@pytest.mark.long("journey")
def test_the_cameras_stay_while_an_attempt_runs(running):
    running.runs.run.trainer.state = State.INSERTING
    running.feature(CamerasFeature).use_real(False)
    assert "An attempt is running" in running.message_bar.text
    running.feature(CamerasFeature).menu.set_up.trigger()
    assert running.equipment.dialog is None
    assert running.equipment.uses_real_cameras


@pytest.mark.long("journey")
def test_what_was_refused_in_an_attempt_goes_when_the_attempt_is_over(running):
    running.runs.run.trainer.state = State.INSERTING
    running.feature(CamerasFeature).use_real(False)
    assert "An attempt is running" in running.message_bar.text
    running.runs.run.trainer.state = State.READY
    running.feature(CamerasFeature).use_real(False)
    assert running.message_bar.isHidden()


@pytest.mark.long("journey")
def test_what_kept_the_cameras_away_goes_with_the_choice_of_others(window, services, settle):
    services.refuses = "no camera at usb:1-1; none is plugged in"
    save_settings(REAL)
    window.feature(CamerasFeature).use_real(True)
    window.runs.failed.emit(CameraError(services.refuses))
    assert "none is plugged in" in window.message_bar.text
    window.feature(CamerasFeature).use_real(False)
    assert window.message_bar.isHidden()


@pytest.mark.long("journey")
def test_asking_for_real_cameras_where_none_are_chosen_is_over_once_they_are(window, services):
    window.feature(CamerasFeature).aim()
    assert "Only simulated cameras are chosen" in window.message_bar.text
    window.feature(CamerasFeature).set_up()
    assert window.message_bar.isHidden()
    window.equipment.dialog.reject()


@pytest.mark.long("journey")
def test_aiming_lets_the_run_go_shows_the_cone_and_gives_the_cameras_back(
    running, services, settle
):
    run = services.opened[-1]
    running.feature(CamerasFeature).menu.aim.trigger()
    dialog = running.equipment.dialog
    assert run.closed.wait(30.0)
    assert settle(lambda: len(services.lives) == 2 and "51 %" in dialog.share.text())
    assert "everything at -30 to 25 mm" in dialog.losses.text()
    assert settle(lambda: dialog.previews[0].picture.has_image)
    assert dialog.previews[0].picture._outline.shape == (3, 2)
    dialog.reject()
    assert settle(lambda: running.runs.run is not None)
    assert all(live.closed.is_set() for live in services.lives)
    assert len(services.opened) == 2


@pytest.mark.long("journey")
def test_a_cone_that_nobody_measured_is_not_told_as_seen(running, services, settle, monkeypatch):
    found = services.aim(None, "icube", None)
    found.assumed, found.cone.share = True, 1.0
    monkeypatch.setattr(services, "aim", lambda *_: found)
    running.feature(CamerasFeature).menu.aim.trigger()
    dialog = running.equipment.dialog
    assert settle(lambda: "would see 100 %" in dialog.share.text())
    assert dialog.share.text().startswith("▲")
    assert dialog.titles[0].text() == "Left: would see 100 %"
    dialog.reject()


@pytest.mark.long("journey")
def test_a_camera_that_stops_is_said_below_its_darkened_picture(running, services, settle):
    running.feature(CamerasFeature).aim()
    preview = running.equipment.dialog.previews[1]
    assert settle(lambda: preview.camera is not None)
    preview.camera.state = CameraState.STALLED
    assert settle(lambda: "check its cable" in preview.note.text())
    assert preview.picture._dimmed
    running.equipment.dialog.reject()


@pytest.mark.long("journey")
def test_a_camera_that_cannot_be_opened_is_said_where_its_picture_would_be(
    running, services, settle
):
    services.refuses = "no camera at usb:1-1; none is plugged in"
    running.feature(CamerasFeature).set_up()
    editor = running.equipment.dialog.sides[0]
    assert settle(lambda: "none is plugged in" in editor.preview.note.text())
    services.refuses = ""
    running.equipment.dialog.reject()


@pytest.mark.long("journey")
def test_the_settings_take_what_is_chosen_and_refuse_what_cannot_work(window, services, settle):
    window.feature(CamerasFeature).set_up()
    dialog = window.equipment.dialog
    left, right = dialog.sides
    left.source.setCurrentIndex(0)
    assert left.camera().source == "usb:1-1"
    with pytest.raises(CameraError, match="one camera is real"):
        dialog.settings()
    right.source.setEditText("folder:/pictures")
    right.exposure.setValue(5.0)
    dialog.size_box.setCurrentText("1280x720")
    assert settle(lambda: {live.side for live in services.lives} == {"left", "right"})
    assert settle(lambda: "did not accept" in left.preview.note.text())
    dialog.swap.click()
    assert dialog.settings().left.source == "folder:/pictures"
    dialog.save()
    saved = load_settings()
    assert saved.size == (1280, 720)
    assert saved.left.exposure_ms == 5.0
    assert saved.right.source == "usb:1-1"
    assert window.feature(CamerasFeature).menu.real.isChecked()
    assert settle(lambda: all(live.closed.is_set() for live in services.lives))


@pytest.mark.long("journey")
def test_what_was_measured_goes_with_its_camera(window):
    save_settings(REAL.model_copy(update={"left": OneCamera(source="usb:1-1", latency_ms=40.0)}))
    window.feature(CamerasFeature).set_up()
    dialog = window.equipment.dialog
    dialog.swap.click()
    assert dialog.settings().right.latency_ms == 40.0
    dialog.sides[1].source.setEditText("usb:9-9")
    assert dialog.settings().right.latency_ms is None
    dialog.reject()


@pytest.mark.long("journey")
def test_the_latency_is_measured_by_the_blinking_patch_and_kept(running, services, settle):
    running.feature(CamerasFeature).measure_latency("right")
    dialog = running.equipment.dialog
    dialog._seconds = 5.0
    assert settle(lambda: dialog.start.isEnabled())
    dialog.preview.camera.patch = dialog.patch
    dialog.start.click()
    assert dialog.preview.camera.taken
    assert settle(lambda: dialog.latency is not None), dialog.outcome.text()
    assert dialog.latency.median == pytest.approx(0.04, abs=5e-3)
    dialog.keep.click()
    assert load_settings().right.latency_ms == pytest.approx(40.0, abs=5.0)
    assert settle(lambda: running.runs.run is not None)


@pytest.mark.long("journey")
def test_a_settings_file_that_cannot_be_read_is_told_not_replaced(window, services, tmp_path):
    path = save_settings(REAL)
    path.write_text("left: nonsense\n")
    window.feature(CamerasFeature).use_real(True)
    assert "left" in window.message_bar.text
    assert path.read_text() == "left: nonsense\n"
    if window.equipment.dialog is not None:
        window.equipment.dialog.reject()
    QApplication.processEvents()


@pytest.mark.long("journey")
def test_calibrating_lets_the_run_go_searches_both_pictures_and_gives_the_cameras_back(
    running, services, settle
):
    run = services.opened[-1]
    running.feature(CamerasFeature).menu.calibrate.trigger()
    dialog = running.equipment.dialog
    dialog.show_page(1)
    dialog.capture_page.begin_live()
    assert run.closed.wait(30.0)
    assert settle(lambda: dialog.capture_page.search is not None)
    assert settle(lambda: "no ChArUco board" in dialog.capture_page.state.text())
    assert len(services.lives) == 2
    dialog.capture_page.stop.click()
    dialog.reject()
    assert settle(lambda: running.runs.run is not None)
    assert all(live.closed.wait(30.0) for live in services.lives)


@pytest.mark.long("journey")
def test_without_real_cameras_a_calibration_is_made_from_folders(window):
    window.feature(CamerasFeature).menu.calibrate.trigger()
    dialog = window.equipment.dialog
    assert not dialog.capture_page.live.isEnabled()
    assert dialog.capture_page.folder.isEnabled()
    dialog.reject()


@pytest.mark.long("journey")
@pytest.mark.parametrize("which", ["aim", "latency"])
def test_what_a_first_start_waits_for_is_said_in_the_dialog_and_cancel_ends_it(
    running, services, settle, monkeypatch, which
):
    def wait_long(*arguments):
        for _ in range(1000):
            arguments[-1].report(0.0, "waiting 12 s for the program to load")
            time.sleep(0.01)

    monkeypatch.setattr(services, "open_camera", wait_long)
    monkeypatch.setattr(services, "aim", wait_long)
    cameras = running.feature(CamerasFeature)
    cameras.aim() if which == "aim" else cameras.measure_latency("left")
    dialog = running.equipment.dialog
    previews = dialog.previews if which == "aim" else (dialog.preview,)
    assert settle(lambda: "waiting 12 s" in previews[0].note.text())
    row = dialog.waiting.layout().itemAt(0).widget()
    assert settle(lambda: "waiting 12 s" in row._text.text())
    row.cancel.click()
    assert settle(lambda: running.equipment.dialog is None)
    assert settle(lambda: running.runs.run is not None)


@pytest.mark.long("journey")
def test_the_board_chosen_last_is_remembered_between_starts(window):
    window.feature(CamerasFeature).menu.calibrate.trigger()
    window.equipment.dialog.board_page.square.setValue(31.5)
    spec = window.equipment.dialog.job.board.spec
    window.equipment.dialog.reject()
    QApplication.processEvents()
    window.feature(CamerasFeature).menu.calibrate.trigger()
    assert window.equipment.dialog.job.board.spec == spec
    assert "31.5mm" in spec
    window.equipment.dialog.reject()
