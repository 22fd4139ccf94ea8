"""The menu Pen and its page: choose, print, see, measure, use, and go back to the robot."""

import dataclasses

import numpy as np
import pytest
from pen_rig import ENTRY, PEN, camera, picture, renderer, scene, step
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLabel, QMessageBox
from window_rig import FakePen, plan

from app.session.machine import State
from app.tracking.cameras.settings import CameraSettings, OneCamera
from app.tracking.cameras.watch import CameraState
from app.tracking.errors import CameraError
from app.tracking.pen.calibrating import SIDES, Lean
from app.tracking.pen.needle import PenTip
from app.tracking.pen.settings import (
    PenSettings,
    calibrated_path,
    can_undo,
    load_settings,
    save_settings,
)
from app.tracking.pen.webcam import guessed_webcam
from app.tracking.simulated.pen_scene import rocked
from app.views.kit.verdict import Verdict
from app.views.pen.feature import PenFeature
from app.views.pen.tip_step import DirectionsView, TipStep
from app.views.pen.words import accuracy_line, status_lines
from app.views.robot.feature import RobotFeature
from app.views.shell.shortcuts import groups
from app.views.slices.bindings import OHIF

MODEL = camera()


@pytest.fixture(scope="module")
def seen():
    return step(MODEL).observe(picture(renderer(MODEL), scene()[0]))


@pytest.fixture(scope="module")
def blank():
    image = np.full((480, 640, 3), 128, np.uint8)
    return step(MODEL).observe(
        dataclasses.replace(picture(renderer(MODEL), scene()[0]), image=image)
    )


@pytest.fixture(scope="module")
def looks():
    """Positions of a pen that is rocked to all sides."""
    known, moves, draw = step(MODEL), rocked(ENTRY, PenTip.of(PEN.tip)), renderer(MODEL)
    times = np.arange(2.5, 7.5, 0.125)
    return [known.observe(picture(draw, moves(t), k, time=t)) for k, t in enumerate(times)]


@pytest.fixture
def page(window, services, settle, seen):
    """The page with a pen before a webcam."""
    services.seen = seen
    save_settings(PenSettings(source="usb:1-1"))
    window.feature(PenFeature).menu.page.trigger()
    opened = window.feature(PenFeature).dialog
    assert settle(lambda: opened.tip.begin.isEnabled())
    yield opened
    opened.tip.end()
    opened.tip.found = None
    opened.reject()


def rock(page, services, looks, count=None):
    page.tip.begin.click()
    for one in looks[:count]:
        services.pens[-1].collect(one)
    page.tip.poll()


# --- words ----------------------------------------------------------------------------------------
def test_the_accuracy_is_one_sentence_with_the_radius_that_holds_95_percent(seen):
    line = accuracy_line(seen)
    radius = f"{1e3 * seen.needle.tip_radius():.1f} mm (95 %)"
    assert line.text.startswith("The tip is known to ±")
    assert radius in line.text
    assert accuracy_line(None).verdict is Verdict.IDLE


def test_a_pen_that_is_lost_is_said_with_the_reason_and_what_to_do(blank):
    assert "out of view" in accuracy_line(blank).text
    assert accuracy_line(blank).verdict is Verdict.BAD
    told = [line.text for line in status_lines(blank, PEN, None, 0.0)]
    assert told[0].startswith("0 of 5 faces")
    assert any("show a whole face" in text for text in told)


def test_faces_stillness_tip_and_lens_are_said_with_their_verdicts(seen):
    lines = status_lines(seen, PEN, guessed_webcam((640, 480)), 0.3)
    words = "\n".join(line.text for line in lines)
    assert "2 of 5 faces" in words or "3 of 5 faces" in words
    assert "hold still: at 300 mm/s" in words
    assert "where the drawing has it" in words
    assert "lens is guessed" in words
    measured = PEN.model_copy(update={"tip": PEN.tip.model_copy(update={"calibrated": True})})
    lines = status_lines(seen, measured, None, 0.0)
    assert all(line.verdict is Verdict.GOOD for line in lines)


# --- parts ----------------------------------------------------------------------------------------
def test_the_disc_fills_the_sides_that_are_covered(application):
    view = DirectionsView()
    view.resize(view.sizeHint())
    empty = view.grab().toImage()
    view.show_leans(frozenset({0}), Lean(0.0, 0.4))
    filled = view.grab().toImage()
    right, left = (view.width() - 32, view.height() // 2), (32, view.height() // 2)
    assert filled.pixelColor(*right) != empty.pixelColor(*right)
    assert filled.pixelColor(*left) == empty.pixelColor(*left)


def test_what_is_chosen_is_read_and_what_cannot_be_is_refused(page):
    choice = page.choice
    assert choice.settings() == PenSettings(source="usb:1-1")
    choice.edge.setValue(30.0)
    assert choice.settings().edge_mm == 30.0
    choice.body.setCurrentIndex(choice.body.findData("ring"))
    assert choice.settings().pen == "ring"
    assert choice.settings().edge_mm is None, "another pen comes in its own size"
    choice.source.setEditText("phone")
    with pytest.raises(CameraError, match="usb"):
        choice.settings()
    page.reopen()
    assert "phone" in page.status.accuracy.text()
    assert not page.use.isEnabled()


@pytest.mark.long("journey")
def test_the_net_is_written_and_a_size_that_fits_no_paper_is_said(page, tmp_path):
    page.choice.write(tmp_path / "pen.pdf")
    assert (tmp_path / "pen.pdf").read_bytes().startswith(b"%PDF")
    assert "print it at 100 %" in page.choice.written.text()
    page.choice.edge.setValue(90.0)
    page.choice.write(tmp_path / "large.pdf")
    assert "does not fit" in page.choice.written.text()


@pytest.mark.long("journey")
def test_size_and_lens_of_a_simulated_webcam_are_not_asked_for(page):
    page.choice.source.show_source("simulated")
    assert not page.choice.lens.isEnabled()
    page.choice.source.show_source("usb:1-1")
    assert page.choice.lens.isEnabled()


@pytest.mark.long("journey")
def test_the_page_says_one_thing_of_a_simulated_webcam_s_lens(page, settle):
    def words():
        told = [one.text() for one in page.status.lines.findChildren(QLabel)]
        return [text for text in (page.choice.lens.currentText(), *told) if "lens" in text]

    page.choice.source.show_source("simulated")
    assert settle(lambda: any("known exactly" in text for text in words()))
    known = "known exactly: the webcam is simulated"
    assert page.choice.lens.currentText() == known
    assert page.choice.lens.chosen()[0] is None
    assert [text for text in words() if "lens" in text] == [f"✔ the lens is {known}"]
    page.choice.source.show_source("usb:1-1")
    assert page.choice.lens.currentText() == "guessed from the pictures' size"
    assert page.choice.lens.count() == 2
    assert settle(lambda: any("the lens is guessed" in text for text in words()))


def test_the_lens_of_either_camera_of_a_pair_can_be_chosen(page, tmp_path):
    lens = page.choice.lens
    assert lens.chosen()[0] is None
    pair = tmp_path / "pair.yaml"
    pair.write_text("cameras: [{name: left}, {name: right}]", encoding="utf-8")
    lens.take(pair)
    assert lens.chosen() == (pair, "left")
    lens.setCurrentIndex(lens.count() - 1)
    lens.activated.emit(lens.count() - 1)
    assert page.choice.settings().camera == "right"


# --- the live picture -----------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_the_page_shows_the_picture_the_accuracy_and_what_is_seen(page, settle):
    assert settle(lambda: page.preview.picture.has_image)
    assert settle(lambda: "known to ±" in page.status.accuracy.text())
    assert "faces of the cube" in page.status.lines.text


@pytest.mark.long("journey")
def test_a_webcam_that_stops_is_said_and_the_pen_is_shown_again_when_it_comes_back(
    page, services, settle
):
    live = services.pens[-1]
    live.state = CameraState.STALLED
    assert settle(lambda: "check its cable" in page.status.accuracy.text())
    assert page.preview.picture._dimmed
    live.state = CameraState.LIVE
    assert settle(lambda: "known to ±" in page.status.accuracy.text())


@pytest.mark.long("journey")
def test_a_fault_of_the_tracker_is_said(page, services, settle):
    services.pens[-1].fault = "the pictures are 640x480, the calibration is of 1280x720"
    assert settle(lambda: "1280x720" in page.status.accuracy.text())


@pytest.mark.long("journey")
def test_a_webcam_that_is_missing_is_said_and_can_be_tried_again(window, services, settle):
    services.refuses = "no camera at usb:1-1; none is plugged in"
    window.feature(PenFeature).open()
    page = window.feature(PenFeature).dialog
    assert settle(lambda: "none is plugged in" in page.preview.note.text())
    assert "could not be opened" in page.status.accuracy.text()
    assert not page.tip.begin.isEnabled()
    services.refuses = ""
    page.again.click()
    assert settle(lambda: page.tip.begin.isEnabled())
    page.reject()


@pytest.mark.long("journey")
def test_another_webcam_is_opened_a_moment_after_it_was_chosen_and_the_first_is_closed(
    page, services, settle
):
    first = services.pens[-1]
    page.choice.source.setEditText("folder:/pictures")
    assert settle(lambda: services.pens[-1].opened_with.source == "folder:/pictures")
    assert first.closed.wait(30.0)


# --- the tip --------------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_a_rocked_pen_is_measured_with_progress_sides_and_positions_held_back(
    page, services, settle, looks
):
    rock(page, services, looks)
    assert 0 < page.tip.bar.value() < 1000
    assert f"{len(page.tip.rocking.collector.poses)} of 80 positions" in page.tip.state.text()
    assert len(page.tip.directions.covered) == len(SIDES)
    page.tip.compute.click()
    assert services.pens[-1].collect is None, "nothing is collected any more"
    assert settle(lambda: page.tip.found is not None)
    assert "standard deviation" in page.tip.lines.text
    assert "positions held back" in page.tip.lines.text
    assert "not saved" in page.tip.state.text()


@pytest.mark.long("journey")
def test_a_measured_tip_is_saved_used_and_taken_back(page, services, settle, looks):
    rock(page, services, looks)
    page.tip.finish()
    assert settle(lambda: page.tip.found is not None)
    assert not can_undo("cube")
    page.tip.save.click()
    assert PenSettings().profile().tip.calibrated
    assert settle(lambda: len(services.pens) == 2 and page.tip.begin.isEnabled())
    assert "the tip is measured" in page.tip.state.text()
    page.tip.undo.click()
    assert not PenSettings().profile().tip.calibrated
    assert settle(lambda: len(services.pens) == 3 and page.tip.undo.isEnabled())
    page.tip.undo.click()
    assert PenSettings().profile().tip.calibrated


@pytest.mark.long("journey")
def test_escape_stops_a_measurement_and_leaves_the_page_open(page, services, looks):
    rock(page, services, looks, 5)
    QTest.keyClick(page, Qt.Key.Key_Escape)
    assert page.isVisible()
    assert not page.tip.running
    assert "nothing is changed" in page.tip.state.text()
    assert not calibrated_path("cube").is_file()


@pytest.mark.long("journey")
def test_too_few_positions_cannot_be_computed_and_a_pen_held_still_is_refused_by_name(
    page, services, settle, looks
):
    rock(page, services, looks, 5)
    assert not page.tip.compute.isEnabled()
    page.tip.rocking.collector.poses = page.tip.rocking.collector.poses[:1] * 30
    page.tip.finish()
    assert settle(lambda: "held still" in page.tip.state.text())
    assert page.tip.begin.isEnabled()


@pytest.mark.long("journey")
def test_another_pen_stops_the_measurement(page, services, looks, settle):
    rock(page, services, looks, 5)
    page.choice.body.setCurrentIndex(page.choice.body.findData("ring"))
    assert settle(lambda: not page.tip.running)
    assert settle(lambda: services.pens[-1].opened_with.pen == "ring")


def test_a_simulated_pen_is_practice_and_is_not_kept(application, settle, looks):
    tip, live = TipStep(), FakePen(PenSettings())
    tip.set_pen(PenSettings(), live)
    tip.start()
    for one in looks:
        live.collect(one)
    tip.finish()
    assert settle(lambda: tip.found is not None)
    assert "practice" in tip.state.text()
    assert not tip.save.isEnabled()


@pytest.mark.long("journey")
@pytest.mark.parametrize(("answer", "stays"), [("Save", True), ("Discard", False)])
def test_a_tip_that_is_not_saved_is_asked_about_when_the_page_is_left(
    page, services, settle, looks, answer, stays
):
    rock(page, services, looks)
    page.tip.finish()
    assert settle(lambda: page.tip.found is not None)
    page.reject()
    (box,) = page.findChildren(QMessageBox)
    assert page.isVisible()
    box.button(QMessageBox.StandardButton[answer]).click()
    assert settle(lambda: not page.isVisible())
    assert calibrated_path("cube").is_file() == stays


# --- the desk -------------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_using_the_pen_begins_a_run_on_it_is_remembered_and_the_robot_comes_back(
    window, patient, services, settle
):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.feature(PenFeature).open()
    page = window.feature(PenFeature).dialog
    page.choice.source.setEditText("usb:1-1")
    page.use.click()
    assert settle(lambda: services.opened[-1].setup.robot.pen == "usb:1-1")
    assert settle(lambda: window.runs.run is not None)
    assert load_settings().source == "usb:1-1"
    assert window.feature(PenFeature).menu.pen.isChecked()
    assert "usb:1-1" in window.feature(PenFeature).menu.pen.text()
    assert "The pen is the needle now" in window.message_bar.text
    window.feature(PenFeature).menu.robot.trigger()
    assert settle(lambda: services.opened[-1].setup.robot.pen == "")
    assert window.feature(PenFeature).menu.robot.isChecked()
    window.feature(PenFeature).menu.pen.trigger()
    assert settle(lambda: services.opened[-1].setup.robot.pen == "usb:1-1")


@pytest.mark.long("journey")
def test_the_run_on_the_pen_lets_its_webcam_go_while_the_page_is_open(
    window, patient, services, settle
):
    window.equipment.use_pen("usb:1-1")
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    run = services.opened[-1]
    window.feature(PenFeature).open()
    page = window.feature(PenFeature).dialog
    assert run.closed.wait(30.0)
    assert settle(lambda: bool(services.pens))
    page.close_button.click()
    assert settle(lambda: len(services.opened) == 2 and window.runs.run is not None)
    assert services.pens[-1].closed.is_set()
    assert services.opened[-1].setup.robot.pen == "usb:1-1"


@pytest.mark.long("journey")
def test_the_page_leads_back_to_the_robot(window, patient, services, settle):
    window.equipment.use_pen("usb:1-1")
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.feature(PenFeature).open()
    window.feature(PenFeature).dialog.back.click()
    assert settle(lambda: services.opened[-1].setup.robot.pen == "")
    assert not window.feature(PenFeature).used


@pytest.mark.long("journey")
def test_without_a_pen_of_last_time_the_menu_opens_the_page(window):
    assert window.feature(PenFeature).menu.robot.isChecked()
    window.feature(PenFeature).menu.pen.trigger()
    assert window.feature(PenFeature).dialog is not None
    assert window.feature(PenFeature).menu.robot.isChecked()
    window.feature(PenFeature).dialog.reject()


@pytest.mark.long("journey")
def test_the_robot_s_menu_opens_the_same_page(window):
    window.feature(RobotFeature).menu.robots.aboutToShow.emit()
    entry = next(
        a
        for a in window.feature(RobotFeature).menu.robots.actions()
        if "pen and webcam" in a.text()
    )
    entry.trigger()
    assert window.feature(PenFeature).dialog is not None
    window.feature(PenFeature).dialog.reject()


@pytest.mark.long("journey")
def test_without_a_pen_neither_the_robot_s_menu_nor_the_sheet_of_keys_names_one(window):
    window.equipment.offers_pen = False
    menu = window.feature(RobotFeature).menu.robots
    menu.aboutToShow.emit()
    assert not any("pen" in action.text().split() for action in menu.actions())
    sheets = [str(groups(OHIF, pen=there)) for there in (True, False)]
    assert ["pen and webcam" in sheet for sheet in sheets] == [True, False]


@pytest.mark.long("journey")
def test_pen_and_page_stay_closed_while_an_attempt_runs(window, patient, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.runs.run.trainer.state = State.INSERTING
    window.feature(PenFeature).open()
    assert window.feature(PenFeature).dialog is None
    assert "An attempt is running" in window.message_bar.text
    assert not window.equipment.use_pen("usb:0")


@pytest.mark.long("journey")
def test_real_cameras_are_let_go_for_the_page(window, patient, services, settle):
    one = OneCamera(source="usb:1-1"), OneCamera(source="usb:1-2")
    window.equipment.take_cameras(CameraSettings(left=one[0], right=one[1]))
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    window.feature(PenFeature).open()
    assert services.opened[-1].closed.wait(30.0)
    window.feature(PenFeature).dialog.reject()
    assert settle(lambda: len(services.opened) == 2)
