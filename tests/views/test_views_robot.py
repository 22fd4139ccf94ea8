"""Health of the robot in words, what is remembered of it, and the key that arms."""

from datetime import datetime
from math import nan

import pytest
from PySide6.QtCore import QEvent, QSettings, Qt
from PySide6.QtGui import QGuiApplication, QKeyEvent, QKeySequence
from views_exercise_fakes import run, snapshot

from app.core import state_vector as sv
from app.device.faults import Fault
from app.device.links.link import BoardError, BoardInfo, LinkStatus
from app.device.readiness import ForceClearance, Readiness
from app.device.wire_watch import WireWatch
from app.mechanisms.profile import load_profile
from app.views.exercise.energy_gauge import GaugeMode
from app.views.kit.verdict import Verdict
from app.views.robot.feature import KeyDialog, refusal
from app.views.robot.health import Rates, health, let_go_item, link_item
from app.views.robot.health_panel import SPAN, HealthPanel, Trace
from app.views.robot.settings import RobotSettings

BOARD = BoardInfo("icube", "A17-0042", "1.2.0", "1", 7)
WIRE = {"link_replies": 1000.0, "round_trip": 8e-4, "let_go_scale": 1.0}


def lines(board=None, slots=WIRE, fault=Fault.NONE, **changes):
    """Health as title -> item."""
    state = snapshot(slots=slots)
    state.device.fault = fault
    figures = WireWatch().read(state.device.row, 1.0)
    groups = health(run(board=board, **changes), state, Rates(1000.0, 0.0, figures))
    return {item.title: item for group in groups for item in group.items}


def test_a_simulated_robot_needs_no_commissioning():
    items = lines()
    assert items["Robot"].text == "icube, simulated"
    assert items["Simulated"].text == "nothing to commission"
    assert "Answers" not in items
    assert all(i.verdict in (Verdict.GOOD, Verdict.IDLE) for i in items.values())


def test_a_real_robot_that_is_not_homed_is_told_with_what_to_do():
    readiness = Readiness()
    real = lines(BOARD, port="/dev/ttyACM0", readiness=readiness,
                 clearance=readiness.clearance(BOARD, run().profile))  # fmt: skip
    assert real["Robot"].text == "icube, real, /dev/ttyACM0"
    assert real["Board"].text == "A17-0042"
    assert real["Force limit"].verdict is Verdict.BAD
    assert "was not homed since it was switched on" in real["Force limit"].help
    assert real["Homed"].verdict is Verdict.BAD
    assert real["Force scale"].text == "never measured"


def test_a_cap_names_its_reason_and_a_verified_scale_its_date():
    held = Readiness(7, 7, True)
    items = lines(BOARD, readiness=held, clearance=held.clearance(BOARD, run().profile))
    assert items["Force limit"].text == "1 N"
    assert items["Force limit"].verdict is Verdict.WARNING
    free = Readiness(7, 7, True, 1.003, "2026-11-21T10:15:00+01:00", "icube")
    items = lines(BOARD, readiness=free, clearance=free.clearance(BOARD, run().profile))
    assert items["Force limit"].verdict is Verdict.GOOD
    assert items["Force scale"].text == "1.003 on 2026-11-21"
    assert items["Homed"].verdict is Verdict.GOOD


def test_a_force_scale_from_another_power_cycle_still_counts_but_homing_does_not():
    old = Readiness(6, 6, True, 1.003, "2026-11-20T10:15:00+01:00", "icube")
    items = lines(BOARD, readiness=old, clearance=old.clearance(BOARD, run().profile))
    assert items["Homed"].verdict is Verdict.BAD
    assert items["Force scale"].text.startswith("1.003")
    assert items["Force scale"].verdict is Verdict.GOOD


def test_the_clearance_of_this_moment_counts():
    now = snapshot(slots=WIRE, clearance=Readiness(7, 7, True).clearance(BOARD, run().profile))
    free = ForceClearance(1.0, 5.0)
    groups = health(run(board=BOARD, clearance=free), now, Rates(1000.0, 0.0, None))
    assert [i.text for g in groups for i in g.items if i.title == "Force limit"] == ["1 N"]


@pytest.mark.long("journey")
@pytest.mark.parametrize("status", [*LinkStatus, 77])
def test_every_state_of_the_link_has_words_and_what_to_do(status):
    item = link_item(int(status), True)
    assert item.text
    assert item.help
    assert (item.verdict is Verdict.GOOD) is (status == LinkStatus.FINE)


@pytest.mark.parametrize("fault", list(Fault)[1:])
def test_every_fault_is_told_with_its_message(fault):
    item = lines(fault=fault)["Fault"]
    assert (item.verdict, item.text) == (Verdict.BAD, fault.message)


def test_a_governor_and_an_error_of_the_board_are_told():
    items = lines(BOARD, WIRE | {"let_go_scale": 0.3, "arming": 1.0, "board_error": 4.0})
    assert items["Speed governor"].text == "force at 30 %"
    assert items["Board's error"].verdict is Verdict.BAD
    assert items["Board's error"].text == f"{BoardError.AMPLIFIER.message} (code 4)"
    assert "does not know" in lines(BOARD, WIRE | {"board_error": 99.0})["Board's error"].text


def test_the_limit_of_a_needle_let_go_is_told_and_whether_the_profile_states_it():
    profile = load_profile("icube")
    stated = let_go_item(profile)
    assert (stated.verdict, stated.text) == (Verdict.GOOD, "0.45 m/s, 8 mJ")
    limits = profile.limits.model_copy(update={"let_go": None})
    default = let_go_item(profile.model_copy(update={"limits": limits}))
    assert default.verdict is Verdict.WARNING
    assert default.text == "0.25 m/s, 10 mJ (by default)"
    assert "states none" in default.help


def test_a_robot_that_says_nothing_is_told():
    groups = health(run(), snapshot(device=None), Rates(0.0, 0.0, None))
    assert groups[0].items[0].verdict is Verdict.BAD


def test_the_wire_is_watched_over_ten_seconds():
    watch, row = WireWatch(), snapshot(slots=WIRE).device.row.copy()
    for i in range(200):
        row[sv.LINK_REPLIES], row[sv.LINK_ERRORS] = 50.0 * i, i // 50
        row[sv.ROUND_TRIP] = 1e-3 if i % 40 else 9e-3
        figures = watch.read(row, 0.05 * i)
    assert figures.replies == pytest.approx(1000.0)
    assert figures.errors == pytest.approx(0.3, abs=0.05)
    assert figures.median == pytest.approx(1e-3)
    assert figures.p99 > 1e-3
    row[sv.ROUND_TRIP] = nan
    assert watch.read(row, 10.0).median == pytest.approx(1e-3)


# --- panel --------------------------------------------------------------------------------------
def test_the_panel_shows_every_part_and_copies_it_as_text(application, destroy):
    panel = HealthPanel()
    destroy(panel)
    panel.show()
    assert not panel.copy.isEnabled()
    panel.show_snapshot(run(board=BOARD), snapshot(slots=WIRE), (1000.0, 0.0), 1.0)
    assert panel.copy.isEnabled()
    assert not panel.grab().isNull()
    text = panel.report(datetime(2026, 11, 21, 10, 15))
    assert "2026-11-21 10:15" in text
    for group in panel.groups:
        assert group.title in text
        assert all(item.text in text for item in group.items)
    panel.copy.click()
    assert "A17-0042" in QGuiApplication.clipboard().text()
    panel.clear()
    assert panel.groups == ()


def test_a_curve_grows_with_its_values_keeps_ten_seconds_and_survives_gaps(application, destroy):
    trace = Trace("Torque", "N·m", 0.05, None)
    destroy(trace)
    assert trace.scale == 0.05
    for i in range(400):
        trace.add(0.1 * i, 0.2 if i == 395 else nan, -0.01)
    assert trace.scale == 0.2
    assert trace._points[0][0] >= 39.9 - SPAN - 1e-6
    assert not trace.grab().isNull()
    trace.add(0.0, 0.0, 0.0)
    assert len(trace._points) == 1


# --- settings and key ---------------------------------------------------------------------------
def test_what_was_chosen_is_remembered_and_nonsense_counts_as_not_set(tmp_path):
    file = str(tmp_path / "window.ini")
    settings = RobotSettings(QSettings(file, QSettings.Format.IniFormat))
    assert (settings.port, settings.hand, settings.practise_holding) == ("", "", False)
    assert (settings.enable_key, settings.gauge) == (Qt.Key.Key_H, GaugeMode.AUTO)
    settings.port, settings.hand, settings.practise_holding = "COM3", "tablet", True
    settings.enable_key, settings.gauge = Qt.Key.Key_F9, GaugeMode.SHOWN
    settings._settings.sync()
    again = RobotSettings(QSettings(file, QSettings.Format.IniFormat))
    assert (again.port, again.hand, again.practise_holding) == ("COM3", "tablet", True)
    assert (again.enable_key, again.gauge) == (Qt.Key.Key_F9, GaugeMode.SHOWN)
    for key in ("robot/enable-key", "robot/energy-gauge"):
        again._settings.setValue(key, "nonsense")
    assert (again.enable_key, again.gauge) == (Qt.Key.Key_H, GaugeMode.AUTO)


def test_a_key_that_means_something_else_is_refused():
    taken = [QKeySequence("F"), QKeySequence("Ctrl+G")]
    assert refusal(Qt.Key.Key_H, taken) == refusal(Qt.Key.Key_G, taken) == ""
    assert "another meaning" in refusal(Qt.Key.Key_F, taken)
    assert "another meaning" in refusal(Qt.Key.Key_Escape, taken)
    assert "modifier" in refusal(Qt.Key.Key_Shift, taken)


def test_the_dialog_takes_the_next_key_that_is_free(application, destroy):
    dialog = KeyDialog(Qt.Key.Key_H, [QKeySequence("F")])
    destroy(dialog)
    chosen = []
    dialog.chosen.connect(chosen.append)
    for key in (Qt.Key.Key_F9, Qt.Key.Key_F):
        dialog.keyPressEvent(QKeyEvent(QEvent.Type.KeyPress, key, Qt.KeyboardModifier.NoModifier))
    assert "another meaning" in dialog._note.text()
    dialog._take()
    assert chosen == [Qt.Key.Key_F9]
