"""Mouse, pen tablet and gamepad as sources of the simulated hand."""

import builtins
from dataclasses import replace
from math import degrees, inf, nan, pi, radians
from types import MappingProxyType, SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPoint, QPointF, Qt
from PySide6.QtGui import (
    QFocusEvent,
    QInputDevice,
    QKeyEvent,
    QPointingDevice,
    QPointingDeviceUniqueId,
    QTabletEvent,
    QWheelEvent,
)
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from views_exercise_fakes import FakeTrainer, run, snapshot

from app.session.pad.geometry import path_frame
from app.session.pad.hand import HandPose
from app.session.pad.readings import needle_line
from app.session.snapshot import NextStep, StepKind
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.hands import chooser
from app.views.exercise.hands import source as gamepad_module
from app.views.exercise.hands.feed import (
    HELD,
    LONGEST,
    SOFT,
    SPEED,
    FeedButton,
    feed_speed,
)
from app.views.exercise.hands.source import (
    DEAD_ZONE,
    FASTEST,
    FASTEST_DEPTH,
    FASTEST_TILT,
    RESTING_PRESSURE,
    STEP_MS,
    GamepadError,
    GamepadHand,
    PygamePads,
    Sticks,
    deflection,
    pressed_speed,
)
from app.views.exercise.pad_canvas import PadCanvas
from app.views.exercise.steps import step_words
from app.views.kit.theme import apply_theme
from tests.careless.texts import cut_texts

LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
NONE = Qt.MouseButton.NoButton
STEP = 1e-3 * STEP_MS


@pytest.fixture
def pad(qt):
    widget = Bullseye()
    widget.resize(560, 470)
    widget.set_scene(run(FakeTrainer()).scene(), interactive=True)
    widget.show_view(needle_line(snapshot()))
    widget.show()
    widget.source.gain.setCurrentIndex(2)
    qt.processEvents()
    yield widget
    widget.close()
    widget.deleteLater()


def pen(tilts=True):
    can = QInputDevice.Capability.Position | QInputDevice.Capability.Pressure
    if tilts:
        can |= QInputDevice.Capability.XTilt | QInputDevice.Capability.YTilt
    return QPointingDevice(
        "pen", 7, QInputDevice.DeviceType.Stylus, QPointingDevice.PointerType.Pen, can, 1, 2, "",
        QPointingDeviceUniqueId(),
    )  # fmt: skip


@pytest.fixture
def tablet(pad):
    pad.source.set_source("tablet")
    device = pen()

    def send(kind, tilt=(0.0, 0.0), pressure=0.2, button=NONE, buttons=LEFT, at=(100, 100),
             using=None):  # fmt: skip
        place = QPointF(*at)
        event = QTabletEvent(
            kind, using or device, place, place, pressure, tilt[0], tilt[1], 0.0, 0.0, 0.0,
            Qt.KeyboardModifier.NoModifier, button, buttons,
        )  # fmt: skip
        QApplication.sendEvent(pad.pad, event)
        return event

    return SimpleNamespace(send=send, bullseye=pad, source=pad.source.source)


DOWN, MOVE, UP = QEvent.Type.TabletPress, QEvent.Type.TabletMove, QEvent.Type.TabletRelease


def tilts(bullseye):
    return bullseye._hand.tilts.copy()


# --- tablet -------------------------------------------------------------------------------------
def test_a_hovering_pen_moves_nothing(tablet):
    before, depth = tilts(tablet.bullseye), tablet.bullseye.hand.depth
    tablet.send(MOVE, (30.0, -20.0), pressure=0.0, buttons=NONE)
    tablet.source.step()
    assert tilts(tablet.bullseye) == pytest.approx(before)
    assert tablet.bullseye.hand.depth == depth


def test_putting_the_pen_down_makes_no_jump_and_leaning_it_turns_the_tip_the_other_way(tablet):
    before = tilts(tablet.bullseye)
    tablet.send(DOWN, (20.0, 10.0), button=LEFT)
    assert tilts(tablet.bullseye) == pytest.approx(before)
    tablet.send(MOVE, (23.0, 14.0))
    leaned = tilts(tablet.bullseye) - before
    assert degrees(leaned[0]) == pytest.approx(-3.0, abs=0.05)
    assert degrees(leaned[1]) == pytest.approx(4.0, abs=0.05)
    tablet.send(UP, button=LEFT, buttons=NONE)
    tablet.send(MOVE, (50.0, 14.0), buttons=NONE)
    assert tilts(tablet.bullseye) - before == pytest.approx(leaned)


def test_pressing_pushes_with_the_pressure_and_the_side_button_pulls(tablet):
    start = tablet.bullseye.hand.depth
    tablet.send(DOWN, pressure=RESTING_PRESSURE, button=LEFT)
    tablet.source.step()
    assert tablet.bullseye.hand.depth == start
    tablet.send(MOVE, pressure=1.0)
    tablet.source.step()
    assert tablet.bullseye.hand.depth - start == pytest.approx(FASTEST * STEP)
    tablet.send(DOWN, pressure=1.0, button=RIGHT, buttons=LEFT | RIGHT)
    for _ in range(2):
        tablet.source.step()
    assert tablet.bullseye.hand.depth - start == pytest.approx(-FASTEST * STEP)


@pytest.mark.parametrize("kind", [QEvent.Type.Hide, QEvent.Type.WindowDeactivate])
def test_a_pen_that_presses_while_the_pad_goes_away_stops_pushing(tablet, kind):
    tablet.send(DOWN, pressure=1.0, button=LEFT)
    QApplication.sendEvent(tablet.bullseye.pad, QEvent(kind))
    before = tablet.bullseye.hand.depth
    tablet.source.step()
    assert tablet.bullseye.hand.depth == before
    assert not tablet.source._timer.isActive()


def test_a_pen_without_tilt_drags_as_the_mouse_does_and_says_so(tablet):
    flat = pen(tilts=False)
    before = tilts(tablet.bullseye)
    tablet.send(DOWN, button=LEFT, using=flat)
    tablet.send(MOVE, at=(130, 100), using=flat)
    assert tilts(tablet.bullseye)[0] > before[0]
    assert "no tilt" in tablet.bullseye.source._help.text()


@pytest.mark.parametrize("nonsense", [nan, inf])
def test_a_drivers_nonsense_moves_nothing(tablet, nonsense):
    before, depth = tilts(tablet.bullseye), tablet.bullseye.hand.depth
    tablet.send(DOWN, (nonsense, 0.0), pressure=nonsense, button=LEFT)
    tablet.send(MOVE, (nonsense, nonsense), pressure=nonsense)
    tablet.source.step()
    assert tilts(tablet.bullseye) == pytest.approx(before)
    assert tablet.bullseye.hand.depth == depth


def test_the_pens_events_become_no_mouse_events(tablet):
    assert tablet.send(DOWN, button=LEFT).isAccepted()
    tablet.bullseye.source.set_source("mouse")
    before = tilts(tablet.bullseye)
    tablet.send(MOVE, (40.0, 0.0))
    assert tilts(tablet.bullseye) == pytest.approx(before)


@pytest.mark.parametrize("width", [40, 85, 300])
def test_a_narrow_button_to_push_shows_its_arrow_and_no_half_word(pad, width):
    button = FeedButton(pad.pad.feed, True, pad)
    button.resize(width, 28)
    button.show()
    assert cut_texts(button) == []
    assert button.text() == ("▼" if width < 85 else "▼ push")
    assert button.accessibleName() == "▼ push"


def test_the_speed_rises_from_rest_without_a_step():
    assert pressed_speed(RESTING_PRESSURE, False) == pressed_speed(0.0, True) == 0.0
    assert 0.0 < pressed_speed(RESTING_PRESSURE + 0.01, False) < 0.001 * FASTEST
    assert pressed_speed(5.0, False) == pytest.approx(FASTEST)


# --- gamepad ------------------------------------------------------------------------------------
class FakePads:
    def __init__(self):
        self.sticks, self.is_open = None, False

    def open(self):
        self.is_open = True

    def close(self):
        self.is_open = False

    def read(self):
        return self.sticks


@pytest.fixture
def gamepad(pad, monkeypatch):
    pads = FakePads()
    sources = chooser.SOURCES | {"gamepad": lambda where: GamepadHand(where, pads)}
    monkeypatch.setattr("app.views.exercise.hands.chooser.SOURCES", sources)
    pad.source.set_source("gamepad")
    pad.source.source._timer.stop()
    yield SimpleNamespace(pads=pads, bullseye=pad, step=pad.source.source.step)
    pad.source.set_source("mouse")


def test_sticks_tilt_and_push_at_their_own_speed(gamepad):
    before, depth = tilts(gamepad.bullseye), gamepad.bullseye.hand.depth
    gamepad.pads.sticks = Sticks(1.0, 0.0, 0.0)
    gamepad.step()
    gamepad.pads.sticks = Sticks(0.0, 0.0, 1.0)
    gamepad.step()
    moved = tilts(gamepad.bullseye) - before
    assert moved[0] == pytest.approx(FASTEST_TILT * STEP, rel=0.02)
    assert moved[1] == pytest.approx(0.0, abs=1e-3)
    assert gamepad.bullseye.hand.depth - depth == pytest.approx(FASTEST_DEPTH * STEP)


def test_sticks_that_rest_beside_their_middle_move_nothing(gamepad):
    before = tilts(gamepad.bullseye)
    gamepad.pads.sticks = Sticks(0.9 * DEAD_ZONE, 0.0, -0.9 * DEAD_ZONE)
    for _ in range(50):
        gamepad.step()
    assert tilts(gamepad.bullseye) == pytest.approx(before)


def test_the_deflection_is_bounded_and_rises_from_the_dead_zone_without_a_step():
    assert deflection(DEAD_ZONE) == (0.0, 0.0)
    assert deflection(DEAD_ZONE + 1e-6)[0] < 1e-9
    assert deflection(2.0, 2.0) == pytest.approx((0.5**0.5, 0.5**0.5))
    assert deflection(nan, 0.2) == deflection(inf, 0.0) == (0.0, 0.0)
    x, y = deflection(0.3, 0.4)
    assert y / x == pytest.approx(4 / 3)


def test_a_gamepad_may_come_and_go(gamepad):
    words = gamepad.bullseye.source._help.text
    assert "plug one in" in words()
    gamepad.pads.sticks = Sticks(0.0, 0.0, 0.0)
    gamepad.step()
    assert "Left stick" in words()
    gamepad.pads.sticks = None
    before = tilts(gamepad.bullseye)
    gamepad.step()
    assert "plug one in" in words()
    assert tilts(gamepad.bullseye) == pytest.approx(before)


def test_the_home_button_acts_once_per_press(gamepad):
    homed = []
    gamepad.bullseye.source.homed.connect(lambda: homed.append(1))
    gamepad.pads.sticks = Sticks(0.0, 0.0, 0.0, home=True)
    for _ in range(3):
        gamepad.step()
    assert homed == [1]


def test_another_source_closes_the_gamepad(gamepad):
    assert gamepad.pads.is_open
    gamepad.bullseye.source.set_source("mouse")
    assert not gamepad.pads.is_open


def test_without_pygame_the_extra_is_named_and_the_mouse_takes_over(pad, monkeypatch):
    real = builtins.__import__

    def missing(name, *arguments, **named):
        if name.startswith("pygame"):
            raise ImportError(name)
        return real(name, *arguments, **named)

    monkeypatch.setattr(builtins, "__import__", missing)
    said = []
    pad.source.refused.connect(said.append)
    pad.source.set_source("gamepad")
    assert "make extra NAME=gamepad" in said[0]
    assert pad.source.name == "mouse"
    with pytest.raises(GamepadError):
        PygamePads().open()


class FakeController:
    """One pad of pygame's: three sticks, a button, and whether it is still there."""

    axes = MappingProxyType({})
    there = True

    def __init__(self, index):
        self.index = index

    def attached(self):
        return FakeController.there

    def get_axis(self, axis):
        return self.axes.get(axis, 0)

    def get_button(self, button):
        return False


def test_the_driver_reads_the_first_controller_and_finds_another_after_a_loss(monkeypatch):
    names = SimpleNamespace(
        event=SimpleNamespace(pump=lambda: None, clear=lambda: None),
        CONTROLLER_AXIS_LEFTX=0, CONTROLLER_AXIS_LEFTY=1, CONTROLLER_AXIS_RIGHTY=3,
        CONTROLLER_BUTTON_A=0,
    )  # fmt: skip
    count = [0]
    pads = PygamePads()
    pads._pygame = names
    pads._controllers = SimpleNamespace(
        get_count=lambda: count[0], is_controller=lambda index: True, Controller=FakeController
    )
    assert pads.read() is None
    count[0] = 1
    monkeypatch.setattr(FakeController, "axes", {0: 32767, 1: -32767, 3: 16384})
    sticks = pads.read()
    assert (sticks.right, sticks.up) == (1.0, 1.0)
    assert sticks.along == pytest.approx(-0.5, abs=1e-3)
    monkeypatch.setattr(FakeController, "there", False)
    count[0] = 0
    assert pads.read() is None


def test_the_real_library_opens_and_closes_without_a_gamepad():
    pytest.importorskip("pygame")
    pads = gamepad_module.PygamePads()
    pads.open()
    pads.open()
    assert pads.read() is None or isinstance(pads.read(), Sticks)
    pads.close()
    pads.close()
    assert pads.read() is None


# --- choice -------------------------------------------------------------------------------------
def test_every_source_has_a_name_a_title_and_a_help(qt):
    for name, make in chooser.SOURCES.items():
        assert make.name == name
        assert chooser.source_title(name)
        assert chooser.source_help(name)


def test_only_the_chosen_source_moves_the_hand(pad):
    before = tilts(pad)
    pad.source.set_source("tablet")
    pad.pad.dragged.emit(0.2, 0.1)
    pad.pad.tilted.emit(radians(3.0), 0.0)
    assert tilts(pad) == pytest.approx(before)
    pad.source.set_source("mouse")
    pad.pad.tilted.emit(radians(3.0), 0.0)
    assert tilts(pad)[0] - before[0] == pytest.approx(3.0 * pi / 180, abs=1e-6)


def test_the_source_stays_while_an_attempt_runs_and_a_choice_is_told(pad):
    told = []
    pad.source.chosen.connect(told.append)
    pad.source.set_locked(True)
    assert not pad.source.box.isEnabled()
    pad.source.set_locked(False)
    pad.source.box.setCurrentIndex(1)
    pad.source.box.activated.emit(1)
    assert told == ["tablet"]


def test_with_a_real_robot_the_hand_moves_the_depth_alone_whatever_was_chosen(qt):
    widget = Bullseye()
    widget.source.set_source("gamepad")
    widget.set_scene(run().scene(), interactive=True, depth_only=True)
    assert widget.source.source.name == "mouse"
    assert not widget.source.box.isEnabled()
    assert "cannot see how deep" in widget.source.box.toolTip()
    widget.source.set_locked(False)
    assert not widget.source.box.isEnabled()
    assert widget.source.name == "gamepad"
    widget.set_scene(None, interactive=False)
    widget.deleteLater()


def test_without_a_simulated_hand_nothing_listens(qt):
    widget = Bullseye()
    widget.set_scene(run().scene(), interactive=False)
    assert widget.source.source is None
    assert not widget.source.box.isEnabled()
    widget.deleteLater()


# --- held to push and pull ----------------------------------------------------------------------
PUSH, PULL = Qt.Key.Key_PageDown, Qt.Key.Key_PageUp


@pytest.fixture
def held(pad, monkeypatch):
    """Hold for so many seconds of a clock that the test turns."""
    time = [100.0]
    feed = pad.pad.feed
    monkeypatch.setattr(feed, "_clock", lambda: time[0])
    feed._timer.timeout.disconnect()

    def hold(seconds):
        for _ in range(round(seconds / 0.02)):
            time[0] += 0.02
            if feed._timer.isActive():
                feed.step()

    pad.pad.setFocus()
    return SimpleNamespace(hold=hold, bullseye=pad, pad=pad.pad, feed=feed)


def test_an_insertion_to_the_target_takes_a_few_holds(held):
    target = held.bullseye._scene.target_depth
    held.pad.advanced.emit(-0.02 - held.bullseye.hand.depth)
    holds = 0
    while target - held.bullseye.hand.depth > 0.001:
        QTest.keyPress(held.pad, PUSH)
        away = target - held.bullseye.hand.depth
        held.hold(min(2.5, away / SPEED + 0.3))
        QTest.keyRelease(held.pad, PUSH)
        holds += 1
        assert held.bullseye.hand.depth < target + 0.001
    assert holds <= 6  # it was a hundred notches of the wheel


def test_holding_starts_softly_and_is_never_faster_than_a_hand(held):
    from app.mechanisms.hand_motion import FASTEST_ALONG

    assert SPEED < FASTEST_ALONG
    assert feed_speed(HELD) == feed_speed(0.0) == 0.0
    times = np.linspace(0.0, 3.0, 3001)
    speeds = np.array([feed_speed(time) for time in times])
    assert speeds.max() == SPEED
    assert np.abs(np.diff(speeds)).max() < 2.0 * SPEED / SOFT * 1e-3
    start = held.bullseye.hand.depth
    QTest.keyPress(held.pad, PUSH)
    held.hold(HELD)
    assert held.bullseye.hand.depth - start == pytest.approx(0.001)  # a short press is a step
    held.hold(HELD + SOFT)
    before = held.bullseye.hand.depth
    held.hold(1.0)
    assert held.bullseye.hand.depth - before == pytest.approx(SPEED, rel=1e-6)
    QTest.keyRelease(held.pad, PUSH)


def test_shift_makes_what_is_held_finer_also_on_the_way(held):
    QTest.keyPress(held.pad, PULL)
    held.hold(2.0)
    before = held.bullseye.hand.depth
    QTest.keyPress(held.pad, Qt.Key.Key_Shift)
    held.hold(1.0)
    assert before - held.bullseye.hand.depth == pytest.approx(0.2 * SPEED, rel=1e-6)
    QTest.keyRelease(held.pad, Qt.Key.Key_Shift)
    before = held.bullseye.hand.depth
    held.hold(0.5)
    assert before - held.bullseye.hand.depth == pytest.approx(0.5 * SPEED, rel=1e-6)
    QTest.keyRelease(held.pad, PULL)


@pytest.mark.parametrize(("button", "sign"), [(RIGHT, 1), (Qt.MouseButton.MiddleButton, -1)])
def test_a_mouse_button_held_in_the_pad_feeds_and_its_release_ends_that(held, button, sign):
    before = held.bullseye.hand.depth
    QTest.mousePress(held.pad, button)
    held.hold(1.0)
    QTest.mouseRelease(held.pad, button)
    moved = sign * (held.bullseye.hand.depth - before)
    assert moved > 0.005
    held.hold(1.0)
    assert sign * (held.bullseye.hand.depth - before) == moved


def test_the_buttons_beside_the_depth_feed_while_the_mouse_holds_them(held):
    for button, sign in ((held.bullseye._push, 1), (held.bullseye._pull, -1)):
        before = held.bullseye.hand.depth
        QTest.mousePress(button, LEFT)
        held.hold(1.0)
        QTest.mouseRelease(button, LEFT)
        moved = held.bullseye.hand.depth - before
        assert sign * moved > 0.005
        held.hold(1.0)
        assert held.bullseye.hand.depth - before == moved


@pytest.mark.parametrize("what", ["focus", "window", "hidden", "patient", "controller"])
def test_what_is_held_is_let_go_and_moves_again_only_when_pressed_anew(held, what):
    QTest.keyPress(held.pad, PUSH)
    held.hold(0.5)
    scene = held.bullseye._scene
    {
        "focus": lambda: QApplication.sendEvent(held.pad, QFocusEvent(QEvent.Type.FocusOut)),
        "window": lambda: QApplication.sendEvent(held.pad, QEvent(QEvent.Type.WindowDeactivate)),
        "hidden": lambda: QApplication.sendEvent(held.pad, QEvent(QEvent.Type.Hide)),
        "patient": lambda: held.bullseye.set_scene(scene, interactive=True),
        "controller": held.bullseye.let_go,
    }[what]()
    held.bullseye.show_view(needle_line(snapshot()))
    before = held.bullseye.hand.depth
    held.hold(0.5)
    again = QKeyEvent(QEvent.Type.KeyPress, PUSH, Qt.KeyboardModifier.NoModifier, "", True)
    QApplication.sendEvent(held.pad, again)  # the system repeats a key that is still down
    held.hold(0.5)
    assert held.bullseye.hand.depth == before
    QTest.keyRelease(held.pad, PUSH)
    QTest.keyPress(held.pad, PUSH)
    assert held.bullseye.hand.depth > before
    QTest.keyRelease(held.pad, PUSH)


def test_a_dialog_ends_what_is_held(held, monkeypatch):
    QTest.keyPress(held.pad, PUSH)
    held.hold(0.5)
    monkeypatch.setattr(QApplication, "activeModalWidget", staticmethod(lambda: held.pad))
    before = held.bullseye.hand.depth
    held.hold(0.5)
    assert held.bullseye.hand.depth == before
    assert not held.feed.is_held
    QTest.keyRelease(held.pad, PUSH)


def test_the_last_to_press_has_the_needle_and_the_others_release_ends_nothing(held):
    QTest.keyPress(held.pad, PUSH)
    held.hold(0.6)
    QTest.keyPress(held.pad, PULL)
    before = held.bullseye.hand.depth
    QTest.keyRelease(held.pad, PUSH)
    held.hold(1.0)
    assert held.bullseye.hand.depth < before - 0.003
    QTest.keyRelease(held.pad, PULL)
    assert not held.feed.is_held


def test_a_window_that_stood_still_makes_no_leap_when_it_goes_on(held):
    QTest.keyPress(held.pad, PUSH)
    held.hold(2.0)
    before = held.bullseye.hand.depth
    held.feed._last -= 3.0
    held.hold(0.02)
    assert held.bullseye.hand.depth - before <= SPEED * LONGEST + 1e-12
    QTest.keyRelease(held.pad, PUSH)


def test_a_stick_that_is_held_while_the_attempt_pauses_waits_until_it_was_let_go(gamepad):
    gamepad.pads.sticks = Sticks(0.0, 0.0, 1.0)
    gamepad.step()
    gamepad.bullseye.let_go()
    before = gamepad.bullseye.hand.depth
    for _ in range(10):
        gamepad.step()
    assert gamepad.bullseye.hand.depth == before
    gamepad.pads.sticks = Sticks(0.0, 0.0, 0.0)
    gamepad.step()
    gamepad.pads.sticks = Sticks(0.0, 0.0, 1.0)
    gamepad.step()
    assert gamepad.bullseye.hand.depth > before


def test_a_wheel_that_the_system_turns_round_for_pages_still_pushes_away_from_the_user(pad):
    before = pad.hand.depth
    for delta, turned in ((120, False), (-120, True)):
        event = QWheelEvent(
            QPointF(20, 20), QPointF(20, 20), QPoint(), QPoint(0, delta), NONE,
            Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, turned,
        )  # fmt: skip
        pad.pad.wheelEvent(event)
    assert pad.hand.depth - before == pytest.approx(0.002)


# --- which end goes where the hand goes ---------------------------------------------------------
PLACES = {
    "supine": (1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0),
    "prone": (-1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0),
    "left down": (0.0, -1.0, 0.0, 0.0, 0.0, 1.0, -1.0, 0.0, 0.0),
    "right down": (0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0),
}
"""Rotation from patient to world, row by row, of each way to lie on the table."""


def drawn(bullseye):
    """Where the wanted needle's tip and its hub are drawn on the pad, right and up [px]."""
    scene, hand = bullseye._scene, bullseye.hand
    depth = scene.target_depth
    along = [depth * hand.direction, -depth * hand.direction]
    area = bullseye.pad.area
    seen = []
    for point in along:
        across = point - scene.frame.axis * float(point @ scene.frame.axis)
        at = area.point(scene.scale.place_of_offset([across @ scene.frame.right,
                                                     across @ scene.frame.up]))  # fmt: skip
        seen.append(np.array([at.x(), -at.y()]))
    return seen


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("hub", [False, True])
@pytest.mark.parametrize("way", [(60, 0), (-60, 0), (0, 60), (0, -60)])
def test_a_drag_takes_the_end_that_was_chosen_where_the_mouse_goes_however_the_patient_lies(
    qt, pad, place, hub, way
):
    rotation = np.array(PLACES[place]).reshape(3, 3)
    frame = path_frame((0.1, 0.05, -1.0), rotation)
    pad.set_scene(replace(pad._scene, frame=frame), interactive=True)
    pad.take_hand(HandPose(frame.axis, 0.0, True))
    pad.show_view(replace(needle_line(snapshot()), direction=frame.axis))
    pad.source.set_moves_hub(hub)
    middle = pad.pad.rect().center()
    before = drawn(pad)
    QTest.mousePress(pad.pad, LEFT, pos=middle)
    QTest.mouseMove(pad.pad, middle + QPoint(way[0], -way[1]))
    QTest.mouseRelease(pad.pad, LEFT, pos=middle + QPoint(way[0], -way[1]))
    tip, end = (after - was for after, was in zip(drawn(pad), before, strict=True))
    moved, other = (end, tip) if hub else (tip, end)
    size = float(np.hypot(*way))
    assert float(moved @ way) / size > 20.0
    assert abs(float(moved @ [way[1], way[0]])) / size < 2.0
    assert float(other @ way) < 0.0


@pytest.mark.parametrize("hub", [False, True])
def test_arrow_keys_stick_and_pen_follow_the_same_choice_as_the_mouse(gamepad, hub):
    bullseye, sign = gamepad.bullseye, -1.0 if hub else 1.0
    bullseye.source.set_moves_hub(hub)
    before = tilts(bullseye)
    gamepad.pads.sticks = Sticks(1.0, 0.5, 0.0)
    gamepad.step()
    assert np.all(sign * (tilts(bullseye) - before) > 0.0)
    bullseye.source.set_source("mouse")
    for key, axis, way in ((Qt.Key.Key_Right, 0, 1.0), (Qt.Key.Key_Up, 1, 1.0),
                           (Qt.Key.Key_Left, 0, -1.0), (Qt.Key.Key_Down, 1, -1.0)):  # fmt: skip
        before = tilts(bullseye)
        QTest.keyClick(bullseye.pad, key)
        assert sign * way * (tilts(bullseye) - before)[axis] == pytest.approx(radians(0.2))


@pytest.mark.parametrize("hub", [False, True])
def test_a_pen_without_tilt_follows_the_choice_and_one_that_leans_is_the_needle(tablet, hub):
    tablet.bullseye.source.set_moves_hub(hub)
    flat = pen(tilts=False)
    before = tilts(tablet.bullseye)
    tablet.send(DOWN, button=LEFT, using=flat)
    tablet.send(MOVE, at=(130, 100), using=flat)
    tablet.send(UP, button=LEFT, buttons=NONE, using=flat)
    assert (tilts(tablet.bullseye)[0] > before[0]) is not hub
    before = tilts(tablet.bullseye)
    tablet.send(DOWN, button=LEFT)
    tablet.send(MOVE, (3.0, 0.0))
    assert tilts(tablet.bullseye)[0] < before[0]


def test_the_orders_name_the_end_that_the_hand_moves(pad):
    pad._home()
    pad.source.set_moves_hub(False)
    first = pad._in_plane.text() + pad._out_of_plane.text()
    pad.source.set_moves_hub(True)
    second = pad._in_plane.text() + pad._out_of_plane.text()
    assert "tilt the tip" in first
    assert "tilt the hub" in second
    assert "hub" not in first
    assert "tip" not in second


def test_an_order_for_the_tip_is_the_opposite_of_the_one_for_the_hub():
    step = NextStep(StepKind.TILT, "IL", across=0.003)
    hub = "Tilt the hub towards the feet and the patient's left: 3 mm off the target"
    assert step_words(step, True) == hub
    words = step_words(step, True, tip=True)
    assert words == "Aim 3 mm further towards the head and the patient's right"


@pytest.mark.parametrize("hub", [False, True])
def test_no_choice_is_cut_beside_views_on_a_small_screen(qt, hub):
    apply_theme(QApplication.instance())
    window = QWidget()
    choices = chooser.HandChooser(PadCanvas(window), window)
    choices.set_interactive(True)
    choices.set_moves_hub(hub)
    choices.setGeometry(0, 0, 400, 140)  # what 1280 x 720 leaves it
    window.resize(420, 160)
    window.show()
    QApplication.processEvents()
    assert cut_texts(window) == []
    assert choices._title.isHidden()
    choices.resize(520, 140)
    QApplication.processEvents()
    assert not choices._title.isHidden()
    assert cut_texts(window) == []
