from dataclasses import replace
from itertools import combinations
from math import inf, nan, radians
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import QCoreApplication, QEvent, Qt
from PySide6.QtGui import QFont, QFontMetrics, QImage, QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QLineEdit, QWidget
from views_exercise_fakes import snapshot, statistics

from app.core import state_vector as sv
from app.device.state import Limiter
from app.exercises.guidance import GuidancePart
from app.planning.plan import Plan
from app.session.machine import State
from app.tracking.cameras.watch import CameraHealth, CameraState
from app.tracking.fix import FixStatus
from app.views.exercise.depth_bar import DepthBar
from app.views.exercise.felt import guidance_limit
from app.views.exercise.live import LiveFigures
from app.views.exercise.panel import HOLD_MS, ExercisePanel, HoldKey
from app.views.exercise.readings import figures, problem, status_items, tracker_figures
from app.views.exercise.readouts import ForceBar
from app.views.exercise.status import StatusStrip
from app.views.exercise.status_items import (
    LoopFigures,
    age_text,
    depth_item,
    encoder_item,
    heartbeat_item,
    loop_item,
    recorder_item,
    robot_item,
    tracker_item,
)
from app.views.exercise.tracker_panel import TrackerFigures, _Figures, residual_text
from app.views.kit import theme
from app.views.kit.verdict import Verdict


@pytest.fixture
def panel(qt):
    widget = ExercisePanel()
    widget.set_ready(True)
    widget.show()
    yield widget
    widget.close()
    widget.deleteLater()


def live(state, **changes):
    values = {
        "state": state, "elapsed": 67.0, "depth": 0.0523, "measured": True,
        "angle_error": radians(3.31), "lateral": 0.0029, "to_target": 0.032, "force": 4.3,
        "force_measured": False, "force_limit": 5.0, "scans": 2,
    }  # fmt: skip
    return LiveFigures(**(values | changes))


@pytest.mark.parametrize("state", list(State))
def test_only_what_the_state_allows_is_enabled(panel, state):
    panel.show_figures(live(state))
    counts = state in (State.ALIGNING, State.INSERTING, State.HOLDING, State.PAUSED)
    running = counts or state is State.WITHDRAWING
    assert panel.buttons.start.isEnabled() is not running
    assert panel.buttons.scan.isEnabled() is counts
    for button in (panel.buttons.end, panel.buttons.abort):
        assert button.isEnabled() is running


def test_nothing_starts_before_everything_is_ready_and_the_reason_is_shown(panel):
    panel.set_ready(False, "The path needs 42° of tilt")
    assert not panel.buttons.start.isEnabled()
    assert panel._note.text() == "The path needs 42° of tilt"


def test_the_readouts_carry_their_units(panel):
    panel.show_figures(live(State.INSERTING))
    texts = [panel.readouts.text(k) for k in ("elapsed", "depth", "angle", "lateral", "to_target")]
    assert texts == ["1:07", "52.3 mm", "3.3°", "2.9 mm", "32.0 mm"]
    panel.show_figures(live(State.INSERTING, measured=False))
    assert panel.readouts.text("depth").endswith("◇")


def test_the_readouts_say_how_well_the_tip_is_known_and_whether_the_needle_bends(panel):
    panel.show_figures(live(State.INSERTING))
    assert panel.readouts.text("radius") == "–"
    assert panel.readouts.text("bending") == "–"
    for deflection, text in ((1.6e-3, "1.6 mm"), (0.2e-3, "< 0.6 mm")):
        moment = replace(
            live(State.INSERTING), radius=0.43e-3, deflection=deflection, deflection_sigma=0.2e-3
        )
        panel.show_figures(moment)
        assert panel.readouts.text("radius") == "± 0.4 mm"
        assert panel.readouts.text("bending") == text


def test_keys_end_and_scan_only_while_the_attempt_runs(panel):
    ended, scanned = [], []
    panel.buttons.end_requested.connect(lambda: ended.append(1))
    panel.buttons.scan_requested.connect(lambda: scanned.append(1))
    panel.activateWindow()
    assert QTest.qWaitForWindowActive(panel)
    for state, count in ((State.READY, 0), (State.INSERTING, 1)):
        panel.show_figures(live(state))
        QTest.keyClick(panel, Qt.Key.Key_Return)
        QTest.keyClick(panel, Qt.Key.Key_S)
        assert (len(ended), len(scanned)) == (count, count)


@pytest.mark.long("journey")
def test_escape_aborts_only_when_it_is_held(panel):
    aborted = []
    panel.buttons.abort_requested.connect(lambda: aborted.append(1))
    panel.buttons.watch(panel)
    panel.show_figures(live(State.INSERTING))
    QTest.keyPress(panel, Qt.Key.Key_Escape)
    QTest.keyRelease(panel, Qt.Key.Key_Escape)
    QTest.qWait(HOLD_MS + 100)
    assert not aborted
    QTest.keyPress(panel, Qt.Key.Key_Escape)
    QTest.qWait(HOLD_MS + 100)
    QTest.keyRelease(panel, Qt.Key.Key_Escape)
    assert aborted == [1]


def test_escape_held_while_the_window_stood_still_aborts_by_the_events_own_clock(panel):
    aborted = []
    panel.buttons.abort_requested.connect(lambda: aborted.append(1))
    panel.buttons.watch(panel)
    panel.show_figures(live(State.INSERTING))
    for down, up, count in ((1000, 1000 + HOLD_MS - 1, 0), (5000, 5000 + HOLD_MS, 1)):
        for kind, time in ((QEvent.Type.KeyPress, down), (QEvent.Type.KeyRelease, up)):
            event = QKeyEvent(kind, Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier)
            event.setTimestamp(time)
            QCoreApplication.sendEvent(panel, event)  # both at once, as after a standstill
        assert len(aborted) == count


def test_escape_is_heard_where_another_part_of_the_window_keeps_its_keys_to_itself(panel):
    """As the menu bar does with the keys of a button in its corner that has the focus."""

    class Deaf(QLineEdit):
        def event(self, event):
            event.accept()
            return True

    aborted = []
    panel.buttons.abort_requested.connect(lambda: aborted.append(1))
    panel.buttons.watch(panel)
    panel.show_figures(live(State.INSERTING))
    deaf = Deaf(panel)
    deaf.show()
    deaf.setFocus()
    for kind, time in ((QEvent.Type.KeyPress, 1000), (QEvent.Type.KeyRelease, 1000 + HOLD_MS)):
        event = QKeyEvent(kind, Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier)
        event.setTimestamp(time)
        QCoreApplication.sendEvent(panel.windowHandle(), event)
    assert aborted == [1]
    deaf.deleteLater()


def escape(widget, *events):
    """Send presses and releases of Esc at times [ms] of the events' own clock."""
    kinds = {"down": QEvent.Type.KeyPress, "up": QEvent.Type.KeyRelease}
    for kind, time, again in events:
        event = QKeyEvent(
            kinds[kind], Qt.Key.Key_Escape, Qt.KeyboardModifier.NoModifier, "", again, 1
        )
        event.setTimestamp(time)
        QCoreApplication.sendEvent(widget, event)


def test_a_window_that_is_watched_before_it_is_shown_hears_its_keys_first_as_well(qt):
    window, heard = QWidget(), []
    key = HoldKey(Qt.Key.Key_Escape, window)
    key.held.connect(lambda: heard.append(1))
    key.watch(window)
    assert window.windowHandle() is None
    window.show()
    # a widget of it that takes all keys is passed by: only the display's window hears of this
    window.removeEventFilter(key)
    escape(window.windowHandle(), ("down", 1000, False), ("up", 1000 + HOLD_MS, False))
    assert heard == [1]
    window.close()
    window.deleteLater()


def test_a_key_that_repeats_itself_is_held_and_one_that_the_window_lost_is_not(panel):
    aborted = []
    panel.buttons.abort_requested.connect(lambda: aborted.append(1))
    panel.buttons.watch(panel)
    panel.show_figures(live(State.INSERTING))
    repeats = [(kind, 1400, True) for kind in ("up", "down")]
    escape(panel, ("down", 1000, False), *repeats, ("up", 1000 + HOLD_MS, False))
    assert aborted == [1]
    escape(panel, ("down", 5000, False))
    QCoreApplication.sendEvent(panel, QEvent(QEvent.Type.WindowDeactivate))
    escape(panel, ("up", 5000 + HOLD_MS, False))
    assert aborted == [1]


def test_keys_go_on_to_whoever_has_the_focus(panel):
    panel.buttons.watch(panel)
    panel.show_figures(live(State.INSERTING))
    field = QLineEdit(panel)
    field.show()
    panel.activateWindow()
    assert QTest.qWaitForWindowActive(panel)
    field.setFocus()
    QTest.keyClick(panel.windowHandle(), Qt.Key.Key_A)
    assert field.text() == "a"
    field.deleteLater()


def test_a_pseudonym_cannot_hold_what_a_file_name_must_not(panel):
    for text, good in (("student-07", True), ("", True), ("../x", False), ("Jane Doe", True)):
        panel.student.setText(text)
        assert panel.student.hasAcceptableInput() is good
        assert " " not in panel.student.text()
    panel.student.show_known("Jane Doe")
    assert panel.student.text() == "Jane Doe", "on a list it is as it is"


@pytest.mark.parametrize("force", [0.0, 3.9, 4.3, 5.0, 9.0, nan, inf, -1.0])
def test_the_force_bar_takes_any_number(panel, force):
    panel.readouts.force.show_force(force, 5.0)
    assert not panel.readouts.force.grab().isNull()
    assert panel.readouts.force.verdict in ("good", "warning", "bad")


def test_a_force_at_a_depth_that_nobody_measures_is_said_as_a_bound(panel):
    bar = panel.readouts.force
    panel.show_figures(live(State.ALIGNING, measured=False, force_at_most=True))
    assert bar.words == "at most 4.3 N"
    assert "depth is not measured" in bar.toolTip()
    assert not bar.grab().isNull()
    panel.show_figures(live(State.ALIGNING))
    assert bar.words == "4.3 N estimated"


def limited(panel, **slots):
    """The bar at a moment of a robot whose loop says what holds the guidance back."""
    row = sv.empty_state()
    for name, value in slots.items():
        row[sv.INDEX[name]] = value
    device = SimpleNamespace(row=row)
    here = guidance_limit(SimpleNamespace(device=device), 5.0)
    panel.readouts.force.show_force(1.0, 5.0, False, here)
    assert not panel.readouts.force.grab().isNull()
    return panel.readouts.force


@pytest.mark.parametrize(
    ("by", "source", "reason"),
    [
        (Limiter.TORQUE, 1.0, "motors cannot push harder"),
        (Limiter.LETTING_GO, 1.0, "could not be stopped in time if you let go"),
        (Limiter.LETTING_GO, 0.0, "the depth is not measured"),
        (Limiter.DEPTH, 0.0, "the depth is not measured"),
        (Limiter.DEPTH, 1.0, "known only to ± 12 mm"),
    ],
)
def test_the_force_bar_says_how_much_guidance_there_is_here_and_why(panel, by, source, reason):
    bar = limited(
        panel,
        guidance_limit=1.76,
        guidance_limited_by=by,
        depth_source=source,
        depth_least=0.020,
        depth_most=0.044,
    )
    assert bar.guidance.startswith("Guidance limited to 1.8 N here: ")
    assert reason in bar.guidance
    assert bar.guidance in bar.toolTip()


def test_a_force_bar_whose_guidance_is_whole_or_unknown_says_nothing_of_it(panel):
    for limit in (5.0, 4.95, 0.0, nan):
        assert limited(panel, guidance_limit=limit).guidance == ""
    height = panel.readouts.force.sizeHint().height()
    limited(panel, guidance_limit=1.0)
    assert panel.readouts.force.sizeHint().height() == height  # nothing below it moves


def test_the_line_on_guidance_is_not_cut_off_in_the_panel(panel):
    bar = limited(panel, guidance_limit=1.76, guidance_limited_by=Limiter.TORQUE, depth_source=1.0)
    font = QFont(bar.font())
    font.setPixelSize(theme.SMALL_PX)
    assert QFontMetrics(font).horizontalAdvance(bar.words_of_guidance) <= bar.sizeHint().width()


def test_a_bar_without_a_limit_is_drawn(panel):
    panel.readouts.force.show_force(1.0, 0.0)
    assert panel.readouts.force.verdict == "bad"
    assert not panel.readouts.force.grab().isNull()


def test_deadlines_missed_long_ago_are_told_but_no_warning():
    item = loop_item(LoopFigures(1000, 8e-5, 2e-4, 0.0, 1880, 60_000))
    assert item.verdict is Verdict.GOOD
    assert "1880 of 60000" in item.help
    assert "0.0 % missed" in item.text


def test_each_health_has_its_verdict():
    assert loop_item(LoopFigures(1000, 8e-5, 2e-4, 0.0, 0, 1000)).verdict is Verdict.GOOD
    assert loop_item(LoopFigures(1000, 3e-4, 2e-3, 0.0, 0, 1000)).verdict is Verdict.WARNING
    assert loop_item(LoopFigures(1000, 8e-5, 2e-3, 0.01, 10, 1000)).verdict is Verdict.WARNING
    assert loop_item(LoopFigures(1000, 8e-5, 2e-3, 0.1, 100, 1000)).verdict is Verdict.BAD
    assert encoder_item(0.001).verdict is Verdict.GOOD
    assert encoder_item(0.05).verdict is Verdict.WARNING
    assert encoder_item(0.15).verdict is Verdict.BAD
    assert encoder_item(nan).verdict is Verdict.BAD
    assert encoder_item(0.001, "singular").verdict is Verdict.BAD
    assert tracker_item(30, 0.98, 0.03, "").verdict is Verdict.GOOD
    assert tracker_item(30, 0.5, 0.03, "").verdict is Verdict.WARNING
    assert tracker_item(30, 0.98, inf, "").verdict is Verdict.BAD
    assert [depth_item(s, 0.1).verdict for s in ("tracked", "held", "model", "none", "?")] == [
        Verdict.GOOD, Verdict.WARNING, Verdict.BAD, Verdict.BAD, Verdict.BAD,
    ]  # fmt: skip
    assert heartbeat_item(0.02).verdict is Verdict.GOOD
    assert heartbeat_item(2.0).verdict is Verdict.BAD
    assert recorder_item(False).verdict is Verdict.IDLE
    assert recorder_item(True, 3).verdict is Verdict.WARNING
    assert recorder_item(False, failure="disk full").verdict is Verdict.BAD


def test_no_verdict_is_told_by_colour_alone():
    symbols = [verdict.colour_and_symbol[1] for verdict in Verdict]
    assert len(set(symbols)) == len(symbols)


def test_ages_are_said_in_words():
    assert age_text(0.0123) == "12 ms"
    assert age_text(2.5) == "2.5 s"
    assert age_text(inf) == age_text(nan) == "never"


def test_the_camera_that_does_not_see_the_marker_is_named():
    blind = statistics(status=FixStatus.ONE_CAMERA, missing=("left",))
    assert problem(blind) == "marker out of view (left camera)"
    both = statistics(status=FixStatus.OUT_OF_VIEW, missing=("left", "right"))
    assert problem(both) == "marker out of view (both cameras)"
    assert problem(statistics()) == ""
    assert problem(statistics(discrepancy="the needle bends")) == "the needle bends"
    assert problem(statistics(status=FixStatus.NOT_YET_VISIBLE)) == "marker still in the tube"
    dead = CameraHealth("left", CameraState.FAILED, 1.0, "gone")
    broken = replace(blind, cameras=(dead,), reason="camera left: gone")
    assert problem(broken) == "camera left: gone"


def test_the_residual_is_shown_only_where_there_is_one():
    assert tracker_figures(snapshot()).residual_px == 0.3
    blind = statistics(status=FixStatus.OUT_OF_VIEW)
    assert tracker_figures(snapshot(tracker=blind)).residual_px is None
    assert tracker_figures(snapshot(tracker=None)).item.text == "no cameras"


def test_the_strip_shows_every_part_of_a_snapshot(qt):
    strip = StatusStrip()
    items = status_items(snapshot(), 1000.0, 0.0, 0.02)
    strip.show_items(items)
    assert [item.title for item in items] == [
        "Robot loop", "Encoders", "Cameras", "Depth", "Heartbeat", "Recorder",
    ]  # fmt: skip
    assert all(item.verdict is Verdict.GOOD for item in items)
    assert items[0].help in strip._cells[0].toolTip()
    strip.show_items(items[:2])
    assert [cell.isVisibleTo(strip) for cell in strip._cells] == [True, True, *[False] * 4]


def test_figures_split_the_distance_to_the_target_into_across_and_along():
    shown = figures(snapshot(), 5.0)
    assert shown.force == pytest.approx(3.0)
    assert shown.lateral == pytest.approx(0.04 * 0.0499791693, rel=1e-6)
    assert shown.to_target > 0.0


def test_a_guessed_depth_is_not_drawn(qt):
    bar = DepthBar()
    drawn = []
    bar._paint_needle = lambda painter, tip: drawn.append(tip)
    bar._paint_marks = lambda painter, scene: None
    bar._scene = SimpleNamespace(
        limits=SimpleNamespace(shallowest=-0.03), stop_depth=0.09, target_depth=0.08
    )
    for measured in (False, True):
        bar.show_depth(0.05, measured, None)
        bar.grab()
    assert drawn == [bar.pixel(0.05)]


def test_the_strip_keeps_its_height_while_there_is_nothing_to_say(qt):
    strip = StatusStrip()
    empty = max(strip.sizeHint().height(), strip.minimumHeight())
    strip.show_items(status_items(snapshot(), 1000.0, 0.0, 0.02))
    strip.layout().activate()
    assert max(strip.sizeHint().height(), strip.minimumHeight()) == empty


def test_a_radius_without_the_calibrations_error_says_so(qt):
    table = _Figures(None)
    shown = TrackerFigures(30.0, 0.2, None)
    table.show_figures(shown, 0.31e-3)
    assert table.text("radius") == "± 0.31 mm"
    table.show_figures(shown, 0.31e-3, known=False)
    assert table.text("radius") == "± 0.31 mm + calibration (not known)"
    assert "calibrate with pictures of a board" in table._values["radius"].toolTip()
    table.show_figures(shown, 0.31e-3)
    assert "unknown" not in table._values["radius"].toolTip()
    table.deleteLater()


@pytest.mark.parametrize(
    ("residual", "said"),
    [(None, "–"), (0.0, "< 0.01 px"), (0.004, "< 0.01 px"), (0.01, "0.01 px"), (1.234, "1.23 px")],
)
def test_no_measurement_is_said_to_be_nothing(residual, said):
    assert residual_text(residual) == said


def test_without_a_robot_there_is_neither_dial_nor_force(panel):
    dial, bar = panel.assistance, panel.readouts.force
    plan = Plan(np.zeros(3), np.array([0.0, 50.0, 0.0]), "plan")
    panel.show()
    panel.set_forceful(False)
    assert not dial.isVisible()
    assert not bar.isVisible()
    panel.set_guidance(None, plan)  # all is told, but there is nothing to tell of a force
    assert not bar.isVisible()
    panel.set_forceful(True)
    assert dial.isVisible()
    assert bar.isVisible()
    panel.set_guidance(GuidancePart(), plan)  # control scans alone: the force would tell
    assert not bar.isVisible()
    panel.set_forceful(True)
    assert not bar.isVisible()


def test_what_is_to_be_done_before_an_attempt_stands_there_with_its_button(panel):
    asked = []
    panel.withdrawal.confirmed.connect(lambda: asked.append(True))
    assert panel.withdrawal.isHidden()
    panel.withdrawal.show_snapshot(snapshot(withdrawal="take it out", may_confirm=True))
    assert not panel.withdrawal.isHidden()
    assert not panel.withdrawal.button.isHidden()
    panel.withdrawal.button.click()
    assert asked == [True]
    panel.withdrawal.show_snapshot(snapshot(withdrawal="it comes out by itself"))
    assert panel.withdrawal.button.isHidden()
    panel.withdrawal.show_snapshot(snapshot())
    assert panel.withdrawal.isHidden()


# --- one light for the robot --------------------------------------------------------------------
def light_of(**changes):
    loop = LoopFigures(1000.0, 5e-5, 1e-4, 0.0, 0, 9)
    parts = {"loop": loop_item(loop), "encoders": encoder_item(0.001),
             "heartbeat": heartbeat_item(0.01)}  # fmt: skip
    return robot_item(**(parts | changes))


LATE = LoopFigures(700.0, 3e-3, 9e-3, 0.2, 400, 2000)


@pytest.mark.parametrize(
    ("changes", "verdict", "words"),
    [
        ({}, Verdict.GOOD, "Robot ready"),
        ({"loop": None}, Verdict.IDLE, "No robot"),
        ({"fault": "a cable"}, Verdict.BAD, "Robot stopped: a cable"),
        ({"encoders": encoder_item(0.5)}, Verdict.BAD, "Robot stopped: it does not answer"),
        (
            {"heartbeat": heartbeat_item(2.0)},
            Verdict.BAD,
            "Robot stopped: computer busy, close programs",
        ),
        ({"guard_acts": True}, Verdict.WARNING, "Robot held back: it calms the needle"),
        ({"at_most": True}, Verdict.WARNING, "Robot held back: the depth is not certain"),
        (
            {"loop": loop_item(LATE)},
            Verdict.WARNING,
            "Computer busy: close programs",
        ),
    ],
)
def test_one_light_says_in_a_word_how_the_robot_is_and_its_help_how_each_part_is(
    changes, verdict, words
):
    item = light_of(**changes)
    assert (item.verdict, item.title) == (verdict, words)
    parts = [light_of().help.splitlines()[i].split(":")[0][2:] for i in range(3)]
    assert parts == ["Robot loop", "Encoders", "Heartbeat"]
    assert all(part in item.help for part in (*parts[1:], "Energy guard"))


def all_items():
    loop = LoopFigures(1000.0, 5e-5, 1e-4, 0.0, 0, 9)
    return (loop_item(loop), encoder_item(0.001), tracker_item(30.0, 1.0, 0.01, ""),
            depth_item("tracked", 0.01), heartbeat_item(0.01), recorder_item(True))  # fmt: skip


def titles(strip):
    return [cell.item.title for cell in strip._cells if cell.isVisibleTo(strip)]


def test_a_student_sees_one_light_and_a_click_on_it_all_that_was_there_before(qt):
    strip = StatusStrip()
    strip.set_detailed(False)
    strip.show_items(all_items(), light_of())
    strip.show()
    assert titles(strip) == ["Cameras", "Depth", "Recorder"]
    assert [cell._text.whole for cell in strip._cells[:3]] == [
        "see the marker", "measured", "recording"]  # fmt: skip
    assert "30 Hz" not in strip._cells[0].toolTip()
    wanted = []
    strip.detailed.connect(wanted.append)
    QTest.mouseClick(strip.light, Qt.MouseButton.LeftButton)
    assert wanted == [True]
    assert titles(strip) == [item.title for item in all_items()]
    assert "30 Hz" in strip._cells[2]._text.whole  # nothing is lost
    assert "30 Hz" in strip._cells[2].toolTip()
    QTest.mouseClick(strip.light, Qt.MouseButton.LeftButton)
    assert len(titles(strip)) == 3
    strip.close()


def test_what_is_not_well_is_said_in_full_to_a_student_too(qt):
    strip = StatusStrip()
    strip.set_detailed(False)
    strip.show_items((tracker_item(30.0, 0.2, 0.01, "marker out of view"),), light_of())
    assert strip._cells[0]._text.whole == "marker out of view"


def test_the_light_is_told_apart_by_its_shape_without_any_colour(qt):
    """Grey pictures of its states differ by more than a tenth of the light's area."""
    theme.apply_theme(qt)
    strip = StatusStrip()
    strip.show()
    pictures = []
    for changes in ({}, {"guard_acts": True}, {"fault": "x"}, {"loop": None}):
        strip.show_items((), light_of(**changes))
        strip.light.resize(34, 34)
        grey = strip.light.grab().toImage().convertToFormat(QImage.Format.Format_Grayscale8)
        black = np.frombuffer(grey.constBits(), np.uint8).reshape(grey.height(), -1)[:, :34]
        pictures.append(np.abs(black.astype(int) - int(black[0, 33])) > 40)
    for one, other in combinations(pictures, 2):
        assert (one ^ other).mean() > 0.05
    strip.close()


@pytest.mark.parametrize(("width", "is_written"), [(124, False), (216, True)])
def test_the_limit_of_the_force_is_written_where_it_covers_no_other_word(qt, width, is_written):
    bar, pictures = ForceBar(), []
    bar.resize(width, bar.sizeHint().height())
    for limit in (5.0, 8.0):  # its line stands at the same share of the bar
        bar.show_force(0.0, limit, measured=True)
        pictures.append(bar.grab().toImage())
    assert (pictures[0] != pictures[1]) is is_written
