"""Mouse, pen tablet and gamepad as sources of the simulated hand."""

import builtins
from math import degrees, inf, nan, pi, radians
from types import MappingProxyType, SimpleNamespace

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QInputDevice, QPointingDevice, QPointingDeviceUniqueId, QTabletEvent
from PySide6.QtWidgets import QApplication
from views_exercise_fakes import FakeTrainer, run, snapshot

from app.views.exercise.bullseye import Bullseye
from app.views.exercise.hands import chooser
from app.views.exercise.hands import source as gamepad_module
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
from app.views.exercise.readings import pad_view

LEFT, RIGHT = Qt.MouseButton.LeftButton, Qt.MouseButton.RightButton
NONE = Qt.MouseButton.NoButton
STEP = 1e-3 * STEP_MS


@pytest.fixture
def pad(qt):
    widget = Bullseye()
    widget.resize(560, 470)
    widget.set_scene(run(FakeTrainer()).scene(), interactive=True)
    widget.show_view(pad_view(snapshot(), 0.2, 5.0))
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
    assert "pip install 'acus[gamepad]'" in said[0]
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
