import threading
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from views_exercise_attempts import placed_plan
from views_exercise_fakes import pose, row, run, snapshot

from app.core.rate_meter import RateMeter
from app.device.errors import LoopError
from app.device.state import DeviceState
from app.session.errors import IllegalTransitionError
from app.session.machine import State
from app.session.pad.hand import HandPose
from app.session.transitions import PauseCause
from app.tracking.inspection import InspectedPicture, Inspection
from app.tracking.markers.extractor import MarkerFix
from app.tracking.tracked_picture import TrackedPicture
from app.views.exercise.camera_view import CameraView
from app.views.exercise.status import LONGEST, MessageList
from app.views.exercise.status_items import tracker_item
from app.views.exercise.tracker_panel import TrackerFigures, TrackerPanel


def until(holds, seconds=30.0):
    """Let the window live until something holds; returns whether it does."""
    end = time.monotonic() + seconds
    while not holds() and time.monotonic() < end:
        QTest.qWait(10)
    return holds()


def test_every_look_sends_a_heartbeat_and_passes_the_needle_on(desk):
    poses = []
    desk.controller.needle_moved.connect(poses.append)
    desk.controller.poll()
    desk.controller.poll()
    assert len(desk.trainer.told("heartbeat")) == 2
    assert poses == [desk.trainer.now.pose] * 2


def test_a_pose_that_is_not_valid_moves_no_needle_and_keeps_the_pad(desk):
    poses = []
    desk.controller.needle_moved.connect(poses.append)
    broken = pose(placed_plan(), valid=False, reason="the robot gives no needle direction")
    desk.trainer.now = snapshot(pose=broken, device=None, timing=None, tracker=None)
    desk.controller.poll()
    assert poses == []


def test_the_attempt_is_begun_with_the_pseudonym_and_buttons_follow_its_state(desk):
    panel = desk.views.panel
    desk.controller.poll()
    assert panel.buttons.start.isEnabled()
    assert not panel.buttons.end.isEnabled()
    panel.set_student("student-07")
    panel.buttons.start.click()
    desk.controller.poll()
    assert desk.trainer.told("begin") == [("begin", "student-07", "mouse")]
    assert not panel.buttons.start.isEnabled()
    assert panel.buttons.end.isEnabled()
    assert not panel.student.isEnabled()
    assert desk.views.messages.item(0).text().endswith("aligning")


def test_a_refused_begin_is_said_in_words_and_nothing_breaks(desk, monkeypatch):
    def refuse(*_):
        raise IllegalTransitionError("this is not possible now")

    said = []
    desk.controller.failed.connect(said.append)
    monkeypatch.setattr(desk.trainer, "begin", refuse)
    desk.controller.begin("x")
    assert "not possible" in said[0]
    assert "not possible" in desk.views.messages.item(0).text()


def test_who_asks_twice_has_it_begun_once(desk):
    begun = []
    desk.controller.beginning.connect(lambda: begun.append(1))
    desk.controller.begin("x")
    desk.controller.begin("x")  # as fast as the keyboard repeats, before anything is shown
    assert begun == [1]


def test_ending_tells_of_the_result_once(desk):
    results = []
    desk.controller.finished.connect(results.append)
    desk.controller.begin("x")
    desk.controller.end()
    desk.controller.end()
    for _ in range(50):
        QTest.qWait(10)
        desk.controller.poll()
    assert results == [desk.trainer.result]
    assert len(desk.trainer.told("end")) == 1


def test_an_attempt_that_a_fault_aborted_is_told_of_as_well(desk):
    results = []
    desk.controller.finished.connect(results.append)
    desk.controller.begin("x")
    desk.trainer.abort("heartbeat lost")
    desk.controller.poll()
    desk.controller.poll()
    assert results == [desk.trainer.result]


def test_a_result_from_before_is_not_told_of_again(desk):
    results = []
    desk.controller.finished.connect(results.append)
    desk.trainer.result = SimpleNamespace(state=State.ENDED)
    desk.controller.attach(run(desk.trainer))
    desk.controller._timer.stop()
    desk.controller.poll()
    assert results == []


def test_aborting_disarms_at_once_and_writes_beside_the_window(desk):
    desk.controller.poll()
    desk.controller.begin("x")
    honest, results = desk.trainer.abort, []
    written = threading.Event()

    def slow(reason=""):
        written.wait(30.0)
        return honest(reason)

    desk.trainer.abort = slow
    desk.controller.finished.connect(results.append)
    desk.controller.abort()
    desk.controller.abort()  # pressed once more while it is written
    assert desk.trainer.told("disarm")
    assert not results
    written.set()
    assert until(lambda: bool(results))
    assert len(desk.trainer.told("abort")) == len(results) == 1


@pytest.mark.parametrize("cause", [PauseCause.WINDOW, PauseCause.COMPUTER, PauseCause.HAND])
def test_what_the_hand_is_given_in_a_pause_is_not_made_up_for_after_it(desk, cause):
    stands = DeviceState.from_row(row(hand_depth=0.03, hand_holds=1.0))
    desk.trainer.now = snapshot(state=State.INSERTING, device=stands)
    desk.controller.poll()
    bullseye = desk.views.bullseye
    bullseye.take_hand(HandPose(np.array([0.0, 0.0, -1.0]), 0.03, True))
    for _ in range(8):  # while the window does not look yet
        bullseye.pad.advanced.emit(1e-3)
    desk.trainer.now = replace(desk.trainer.now, state=State.PAUSED, pause=cause)
    desk.controller.poll()
    for _ in range(8):
        bullseye.pad.advanced.emit(1e-3)
    desk.trainer.now = replace(desk.trainer.now, state=State.INSERTING, pause=None)
    desk.controller.poll()
    assert bullseye.hand.depth == pytest.approx(0.03)
    QTest.qWait(40)
    assert desk.trainer.told("hand")[-1][3] == pytest.approx(0.03)


def test_where_the_cameras_do_not_see_the_needle_the_hand_of_a_pause_may_go_back(desk):
    stands = DeviceState.from_row(row(hand_depth=0.03, hand_holds=1.0))
    desk.trainer.now = snapshot(state=State.PAUSED, pause=PauseCause.CAMERAS, device=stands)
    desk.controller.poll()
    bullseye = desk.views.bullseye
    bullseye.pad.advanced.emit(-1e-3)
    desk.controller.poll()  # before the loop shows it
    QTest.qWait(40)
    assert desk.trainer.told("hand")[-1][3] == pytest.approx(0.029)
    QTest.qWait(250)
    desk.controller.poll()  # and then it stands where the loop has it
    assert bullseye.hand.depth == pytest.approx(0.03)


def test_dial_scan_abort_and_hand_reach_the_trainer(desk):
    desk.controller.poll()
    desk.controller.begin("x")
    desk.controller.poll()
    desk.views.panel.assistance.slider.setValue(40)
    desk.views.panel.buttons.scan.click()
    QTest.qWait(40)
    desk.views.panel.buttons.abort.click()
    assert ("assistance", 0.4) in desk.trainer.calls
    assert desk.trainer.told("scan")
    assert until(lambda: bool(desk.trainer.told("abort")))
    hand = desk.trainer.told("hand")[-1]
    assert np.hypot(hand[1], hand[2]) < 1.0
    assert hand[4] is True


def test_detaching_clears_the_widgets_and_stops_the_looks(desk):
    desk.controller.poll()
    desk.controller.detach()
    before = len(desk.trainer.calls)
    desk.controller.poll()
    assert len(desk.trainer.calls) == before
    assert desk.views.panel.readouts.text("depth") == "–"
    assert not desk.views.panel.buttons.start.isEnabled()


def test_camera_pictures_are_refreshed_at_most_fifteen_times_a_second(desk, qt):
    asked = []
    image = np.zeros((48, 64, 3), np.uint8)

    def inspect(masks, lines):
        asked.append((masks, lines))
        marker = MarkerFix(np.array([10.0, 5.0]), np.eye(2), 99.0, 1.0)
        curve, mask = np.array([[0.0, 5.0], [60.0, 8.0]]), np.ones((48, 64), np.uint8)
        return Inspection(
            (
                InspectedPicture(
                    TrackedPicture("left", image, 1.0, marker), "", curve, mask, (0, 0, 20, 20)
                ),
                InspectedPicture(
                    TrackedPicture("right", image, 1.0, None), "", np.empty((0, 2)), None, None
                ),
            ),
            None,
        )

    desk.controller.attach(run(desk.trainer, inspect=inspect))
    desk.controller._timer.stop()
    desk.views.tracker.show()
    clock = desk.controller._clock
    for _ in range(40):
        clock.sleep(0.025)
        desk.controller.poll()
    assert 5 <= len(asked) <= 16
    assert set(asked) == {(False, True)}, "a mask that nobody looks at is not computed"
    for name in ("mask", "region"):
        desk.views.tracker.set_overlay(name, True)
    clock.sleep(0.1)
    desk.controller.poll()
    assert asked[-1] == (True, True)
    assert not desk.views.tracker.grab().isNull()


def test_a_pen_has_one_picture_and_nothing_about_a_coloured_marker(qt):
    panel, image = TrackerPanel(), np.zeros((48, 64, 3), np.uint8)
    figures = TrackerFigures(15.0, None, tracker_item(15.0, 1.0, 0.1, ""))
    one = InspectedPicture(
        TrackedPicture("webcam", image, 1.0, None), "", np.empty((0, 2)), None, None, drawn=True
    )
    assert one.found
    panel.show_tracker(Inspection((one,), None, cameras=1), figures, 0.0)
    assert panel.cameras[1].isHidden()
    assert panel.learn.isHidden()
    panel.show_tracker(Inspection((one,), None), figures, 1.0)  # of two cameras, one is missing
    assert not panel.cameras[1].isHidden()
    assert not panel.learn.isHidden()
    panel.deleteLater()


def test_the_marker_s_colour_is_learned_only_when_asked_for(desk):
    told = []

    def learn(camera, pixel):
        told.append(camera)
        raise LoopError("nothing red there")

    desk.controller.attach(run(desk.trainer, learn_colour=learn))
    desk.controller._timer.stop()
    panel, failed = desk.views.tracker, []
    desk.controller.failed.connect(failed.append)
    panel.cameras[1].clicked.emit("right", np.zeros(2))
    assert told == []
    panel.learn.setChecked(True)
    panel.cameras[1].clicked.emit("right", np.zeros(2))
    assert told == ["right"]
    assert failed == ["nothing red there"]
    assert not panel.learn.isChecked()


def test_a_click_into_a_camera_picture_names_its_pixel(qt):
    image = np.zeros((48, 64, 3), np.uint8)
    view, told = CameraView(), []
    view.clicked.connect(lambda name, pixel: told.append((name, pixel)))
    view.resize(640, 520)
    empty = np.empty((0, 2))
    view.show_picture(
        InspectedPicture(TrackedPicture("left", image, 1.0, None), "", empty, None, None)
    )
    QTest.mouseClick(view, Qt.MouseButton.LeftButton, pos=QPoint(105, 20 + 55))
    QTest.mouseClick(view, Qt.MouseButton.LeftButton, pos=QPoint(100, 5))  # above the picture
    assert [name for name, _ in told] == ["left"]
    np.testing.assert_allclose(told[0][1], [10.0, 5.0], atol=0.06)


def test_the_rate_is_the_counter_over_the_time():
    meter = RateMeter()
    assert meter.read(0.0, 0) == 0.0
    rates = [meter.read(0.1 * i, 100 * i) for i in range(1, 40)]
    assert rates[-1] == pytest.approx(1000.0)
    assert meter.read(1.0, 5) == 0.0


@pytest.mark.long("journey")
def test_the_message_list_keeps_its_last_lines(qt):
    from app.core.events import Event

    messages = MessageList()
    for i in range(LONGEST + 20):
        messages.add_event(Event(float(i), "scan", f"control scan {i}"))
    assert messages.count() == LONGEST
    assert messages.item(LONGEST - 1).text().endswith(f"control scan {LONGEST + 19}")


@pytest.mark.parametrize("breathes", [True, False])
def test_the_strip_of_the_breath_is_in_the_rail_where_the_patient_breathes(desk, breathes):
    desk.controller.attach(replace(run(desk.trainer), breathes=breathes))
    desk.controller._timer.stop()
    assert desk.views.panel.rail.breath.isHidden() is not breathes
