"""Dial, force, energy and enabling switch: what stands between a hand and a robot."""

from math import inf, nan
from types import SimpleNamespace

import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QFocusEvent, QKeyEvent, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QWidget
from views_exercise_fakes import FakeTrainer, run, snapshot

from app.core.clock import VirtualClock
from app.device.faults import Fault
from app.device.links.link import BoardInfo
from app.session.machine import State
from app.views.exercise import assistance_dial
from app.views.exercise.assistance_dial import AssistanceDial, share_words
from app.views.exercise.axial_gauge import AxialGauge
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.controller import ExerciseController, ExerciseViews
from app.views.exercise.enable_switch import EnableSwitch, Enabling, enable_words, enabling
from app.views.exercise.energy_gauge import (
    EnergyGauge,
    GaugeMode,
    energy_figures,
    guard_words,
    millijoules,
)
from app.views.exercise.felt import felt, force_limit
from app.views.exercise.panel import ExercisePanel
from app.views.exercise.readings import figures
from app.views.exercise.status import MessageList, StatusStrip
from app.views.exercise.tracker_panel import TrackerPanel
from app.views.kit.verdict import Verdict

ENERGY = {
    "potential": 0.004, "energy_tank": 0.012, "energy_bound": 0.02, "guard_scale": 1.0,
    "guard_loss": 0.001,
}  # fmt: skip
KEY = Qt.Key.Key_H
NO_MODIFIER = Qt.KeyboardModifier.NoModifier


# --- dial ---------------------------------------------------------------------------------------
@pytest.fixture
def dial(qt):
    widget = AssistanceDial()
    yield widget
    widget.deleteLater()


@pytest.mark.parametrize(
    ("share", "words"),
    [
        (1.0, "▶◀ guides 100 %"), (0.7, "▶◀ guides 70 %"), (0.05, "▶◀ guides 5 %"),
        (0.04, "○ off"), (0.0, "○ off"), (-0.04, "○ off"), (-0.4, "◀▶ repels 40 %"),
        (-1.0, "◀▶ repels 100 %"),
    ],
)  # fmt: skip
def test_the_dial_says_in_words_what_it_does(dial, share, words):
    dial.set_share(share)
    assert dial.words.text() == words == share_words(share)
    assert dial.share == pytest.approx(share)


def test_the_dial_is_silent_when_it_is_set_from_outside_and_takes_no_nonsense(dial):
    shares = []
    dial.changed.connect(shares.append)
    for share in (-0.25, nan, inf, 7.0):
        dial.set_share(share)
    assert shares == []
    assert dial.share == 1.0
    dial.slider.setValue(-40)
    assert shares == [-0.4]


def test_home_switches_the_dial_off_instead_of_jumping_to_full_repulsion(dial):
    dial.set_share(0.3)
    QTest.keyClick(dial.slider, Qt.Key.Key_Home)
    assert dial.share == 0.0
    QTest.keyClick(dial.slider, Qt.Key.Key_Left)
    assert dial.share == -0.01


def test_a_wheel_over_the_dial_does_not_turn_it_by_a_slip(dial):
    dial.set_share(0.3)
    at = QPointF(20, 5)
    event = QWheelEvent(
        at, at, at.toPoint(), QPointF(0, 120).toPoint(), Qt.MouseButton.NoButton, NO_MODIFIER,
        Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    dial.slider.wheelEvent(event)
    assert dial.share == 0.3
    assert not event.isAccepted()


def test_the_dead_zone_on_the_dial_is_the_force_laws():
    from app.device.control.laws import fixture  # compiled code: the dial keeps its own number

    assert assistance_dial.DEAD_ZONE == fixture.DEAD_ZONE


# --- force --------------------------------------------------------------------------------------
def test_a_force_is_called_estimated_until_a_gauge_measures_it():
    assert felt(snapshot()).measured is False
    assert felt(snapshot()).force == pytest.approx(3.0)
    measured = snapshot(slots={"gauge": 1.0, "gauge_force": -1.25})
    assert figures(measured, 5.0).force_measured is True
    assert figures(measured, 5.0).force == 1.25
    broken = snapshot(slots={"gauge": 1.0, "gauge_force": nan})
    assert felt(broken).force == 0.0


def test_the_bar_names_the_origin_of_its_force(qt):
    panel = ExercisePanel()
    panel.show_figures(figures(snapshot(), 5.0))
    assert panel.readouts.force.words == "3.0 N estimated"
    assert "estimated from the motor torques" in panel.readouts.force.toolTip()
    panel.show_figures(figures(snapshot(slots={"gauge": 1.0, "gauge_force": 1.2}), 5.0))
    assert panel.readouts.force.words == "1.2 N measured"
    assert "gauge" in panel.readouts.force.toolTip()
    panel.deleteLater()


def test_the_limit_is_what_the_device_is_cleared_for():
    assert force_limit(snapshot(), 5.0) == 5.0
    assert force_limit(snapshot(slots={"force_cap": 1.0}), 5.0) == 1.0
    assert force_limit(snapshot(slots={"force_cap": 9.0}), 5.0) == 5.0
    assert force_limit(snapshot(device=None), 5.0) == 5.0
    nothing = SimpleNamespace(homed=0.0, force_cap=0.0, reason="not homed")
    assert force_limit(snapshot(clearance=nothing), 5.0) == 0.0
    assert not enabling(snapshot(clearance=nothing), False).ready
    assert enabling(snapshot(), False).ready


# --- energy -------------------------------------------------------------------------------------
def test_the_gauge_shows_dashes_until_somebody_accounts_for_energy(qt):
    gauge = EnergyGauge()
    gauge.show_energy(energy_figures(snapshot()))
    assert gauge.lines == (
        "stored –",
        "left –",
        "– no energy account",
        "removed by the guard –",
    )
    gauge.show_energy(None)
    assert not gauge.grab().isNull()
    gauge.show_energy(energy_figures(snapshot(slots=ENERGY)))
    assert gauge.lines == (
        "stored 4.0 mJ", "left 12.0 mJ of 20.0 mJ", "✔ guard at rest", "removed 1.0 mJ",
    )  # fmt: skip
    assert not gauge.grab().isNull()
    gauge.deleteLater()


def test_a_guard_that_acts_says_how(qt):
    acting = energy_figures(snapshot(slots=ENERGY | {"guard_scale": 0.4, "guard_damping": 0.01}))
    verdict, words = guard_words(acting)
    assert verdict is Verdict.WARNING
    assert words == "guard acts: force at 40 % and damping added"
    empty = energy_figures(snapshot(slots=ENERGY | {"energy_tank": 0.001}))
    assert guard_words(empty) == (Verdict.WARNING, "tank nearly empty")


def test_the_gauge_is_there_with_a_real_robot_or_once_the_guard_has_acted(qt):
    gauge = EnergyGauge()
    seen = []
    for real, slots in ((False, ENERGY), (True, ENERGY), (False, ENERGY | {"guard_scale": 0.9})):
        gauge.begin(real)
        gauge.show_energy(energy_figures(snapshot(slots=slots)))
        gauge.show_energy(energy_figures(snapshot(slots=ENERGY)))
        seen.append(not gauge.isHidden())
    assert seen == [False, True, True]
    gauge.set_mode(GaugeMode.HIDDEN)
    assert gauge.isHidden()
    gauge.begin(False)
    gauge.set_mode(GaugeMode.SHOWN)
    assert not gauge.isHidden()
    gauge.deleteLater()


def test_energies_that_are_not_finite_are_not_shown():
    assert energy_figures(snapshot(slots=ENERGY | {"potential": nan})) is None
    assert energy_figures(snapshot(device=None)) is None
    assert [millijoules(e) for e in (0.0, 0.0123, 0.456, 1.643, 250.0)] == [
        "0.0 mJ", "12.3 mJ", "456 mJ", "1.64 J", "250 J",
    ]  # fmt: skip


# --- enabling -----------------------------------------------------------------------------------
@pytest.fixture
def window(qt):
    top = QWidget()
    top.switch = EnableSwitch(top)
    top.key = top.switch.key
    top.key.watch(top)
    top.told = []
    top.switch.held.connect(top.told.append)
    top.show()
    top.switch.set_wanted(True)
    top.switch.show_enabling(Enabling(True, False, 0.0))
    qt.processEvents()
    yield top
    top.close()
    top.deleteLater()


def press(window, kind=QEvent.Type.KeyPress, key=KEY, repeat=False, modifiers=NO_MODIFIER):
    event = QKeyEvent(kind, key, modifiers, "", repeat)
    QApplication.sendEvent(window.windowHandle(), event)


def test_the_key_is_held_from_press_to_release_and_repeats_change_nothing(window):
    press(window)
    for _ in range(3):
        press(window, QEvent.Type.KeyRelease, repeat=True)
        press(window, repeat=True)
    assert window.told == [True]
    press(window, key=Qt.Key.Key_G)
    press(window, QEvent.Type.KeyRelease, Qt.Key.Key_G)
    assert window.switch.is_held
    press(window, QEvent.Type.KeyRelease)
    assert window.told == [True, False]


def test_fine_movements_with_shift_do_not_let_go(window):
    press(window, modifiers=Qt.KeyboardModifier.ShiftModifier)
    press(window, QEvent.Type.KeyRelease, Qt.Key.Key_Shift)
    assert window.told == [True]


@pytest.mark.promise(
    "docs/user-guide.md: Another window in front, or anything else that takes the keyboard "
    "away, counts as letting go"
)
@pytest.mark.parametrize(
    "event",
    [
        lambda: QEvent(QEvent.Type.WindowDeactivate),
        lambda: QEvent(QEvent.Type.Hide),
        lambda: QFocusEvent(QEvent.Type.FocusOut),
    ],
)
def test_whatever_takes_the_keyboard_away_lets_go(window, event):
    press(window)
    QApplication.sendEvent(window.windowHandle(), event())
    assert window.told == [True, False]
    press(window, repeat=True)
    assert window.told == [True, False]


def test_the_end_of_the_attempt_lets_go_and_the_key_is_free_again(window):
    press(window)
    window.switch.show_enabling(Enabling(False, True, 1.0))
    assert window.told == [True, False]
    press(window)
    assert window.told == [True, False]


def test_a_switch_that_is_not_wanted_listens_to_nobody(window):
    press(window)
    window.switch.set_wanted(False)
    assert window.told == [True, False]
    window.switch.show_enabling(Enabling(True, False, 0.0))
    press(window)
    assert window.told == [True, False]


def test_the_button_on_the_page_is_held_with_the_mouse(window):
    QTest.mousePress(window.switch, Qt.MouseButton.LeftButton)
    assert window.told == [True]
    press(window)
    QTest.mouseRelease(window.switch, Qt.MouseButton.LeftButton)
    assert window.told == [True]
    press(window, QEvent.Type.KeyRelease)
    assert window.told == [True, False]


def test_another_key_can_be_chosen(window):
    window.switch.set_key(Qt.Key.Key_F8)
    press(window)
    assert window.told == []
    press(window, key=Qt.Key.Key_F8)
    assert window.told == [True]
    assert "F8" in window.switch.toolTip()


@pytest.mark.parametrize(
    ("now", "verdict", "title", "todo"),
    [
        (Enabling(False, False, 0.0), Verdict.IDLE, "forces off", "start the attempt"),
        (Enabling(False, False, 0.0, ready=False), Verdict.BAD, "not ready", "Robot's health"),
        (Enabling(True, False, 0.0), Verdict.IDLE, "forces off", "hold H"),
        (Enabling(True, True, 0.4), Verdict.WARNING, "switching on 40 %", "keep holding"),
        (Enabling(True, True, 1.0), Verdict.GOOD, "FORCES ON", "let go of H: forces off"),
        (Enabling(True, True, 0.0, "ran away"), Verdict.BAD, "no force: let go of H", ""),
        (Enabling(True, False, 0.0, "ran away"), Verdict.BAD, "no force: hold H again", ""),
    ],
)
def test_the_switch_says_whether_there_is_force_and_what_to_do(now, verdict, title, todo, qt):
    found, says, does = enable_words(now, "H")
    assert found is verdict
    assert title in says
    assert todo in does
    assert now.fault in does
    switch = EnableSwitch()
    switch.show_enabling(now)
    assert not switch.grab().isNull()
    switch.deleteLater()


@pytest.mark.parametrize("fault", [Fault.LET_GO, Fault.LINK_LOST, Fault.BOARD_ERROR])
def test_a_latched_fault_is_told_with_its_own_message(fault):
    state = snapshot(state=State.INSERTING, slots={"arming": 1.0})
    state.device.fault = fault
    assert enabling(state, True).fault == fault.message


# --- through the controller ---------------------------------------------------------------------
@pytest.fixture
def desk(qt):
    views = ExerciseViews(
        Bullseye(), ExercisePanel(), StatusStrip(), TrackerPanel(), MessageList(), AxialGauge()
    )  # fmt: skip
    controller = ExerciseController(views, VirtualClock(10.0))
    yield controller, views.panel
    controller.detach()
    for name in ExerciseViews.__slots__:
        getattr(views, name).deleteLater()


def test_a_held_switch_arms_and_letting_go_disarms(desk):
    controller, panel = desk
    trainer = FakeTrainer()
    controller.attach(run(trainer, held_arming=True))
    controller._timer.stop()
    assert not panel.enable.isHidden()
    assert not panel.enable.isEnabled()
    controller.begin("x")
    controller.poll()
    assert trainer.calls.count(("disarm",)) == 1  # nothing is armed by the beginning itself
    panel.enable.pressed.emit()
    panel.enable.released.emit()
    assert [c[0] for c in trainer.calls if c[0] in ("arm", "disarm")] == [
        "disarm", "arm", "disarm",
    ]  # fmt: skip


def test_a_run_that_goes_away_is_disarmed_first(desk):
    controller, panel = desk
    trainer = FakeTrainer()
    controller.attach(run(trainer, held_arming=True))
    controller.begin("x")
    controller.poll()
    panel.enable.pressed.emit()
    controller.detach()
    assert trainer.calls[-1] == ("disarm",)
    assert panel.enable.isHidden()


def test_without_held_arming_the_attempt_arms_by_itself(desk):
    controller, panel = desk
    trainer = FakeTrainer()
    controller.attach(run(trainer))
    controller.begin("x")
    controller.poll()
    assert panel.enable.isHidden()
    assert ("disarm",) not in trainer.calls


def test_a_real_robot_brings_its_gauge(desk):
    controller, panel = desk
    board = BoardInfo("icube", "A1", "1.0", "1", 7)
    controller.attach(run(FakeTrainer(), board=board))
    assert not panel.energy.isHidden()


def test_bone_that_a_hand_cannot_be_stopped_by_is_shown_as_crossed_never_as_a_stop(qt) -> None:
    gauge = AxialGauge()
    gauge.show_force(12.0, 0.4)
    assert "stands on bone" in gauge.words
    gauge.show_force(50.0, 8.53)
    assert gauge.words == "Bone crossed by 8.5 mm"
    assert "8.5 mm" in gauge.accessibleName()
    gauge.show_force(0.2)
    assert "bone" not in gauge.words.casefold()
