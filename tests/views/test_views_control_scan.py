"""Where control scans guide, no widget tells where the needle is; the scan's slices do."""

from dataclasses import replace
from types import MappingProxyType, SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QAbstractButton, QLabel, QListWidget, QProgressBar, QWidget
from views_exercise_fakes import FakeTrainer as Recorder
from views_exercise_fakes import pose as pose_of
from views_exercise_fakes import snapshot as snapshot_of
from window_rig import plan

from app.core.events import Event
from app.exercises.guidance import GuidanceMode, GuidancePart
from app.imaging.scan_order import ScanNeedle, ScanOrder
from app.imaging.series import Recipe
from app.imaging.structures.distance import SignedDistance
from app.imaging.structures.edit import brushed
from app.planning.patient import Patient
from app.session.attempt_clock import AttemptClock
from app.session.control_scan import ControlScan
from app.session.ct_facts import CtFacts
from app.session.machine import State
from app.session.shown_views import Shown, without_needle
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.feature import ExerciseFeature
from app.views.exercise.readouts import clock_text
from app.views.exercise.run import ExerciseRun
from app.views.exercise.scan_view import ScanView
from app.views.exercise.status import MessageList
from app.views.robot.feature import RobotFeature
from app.views.structures.feature import StructuresFeature


def scan_event(number=1, tip=(5.0, 0.0, 140.0), order=None, time=3.0):
    """What a trainer says of a scan."""
    order = order or ScanOrder(140.0, 3, 4.0)
    needle = ScanNeedle(np.array([5.0, -150.0, 140.0]), np.array(tip))
    scan = ControlScan(number, time, order, needle, np.zeros(3), 11.55)
    return Event(time, "scan", f"control scan {number}", {"number": number} | scan.data())


@pytest.fixture
def guided(window, patient: Patient, settle, services):
    """A window with a run in which control scans guide, and its trainer."""
    window.conductor.set_exercise(next(iter(window.feature(ExerciseFeature).exercises.values())))
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None and window.conductor.settled)
    placed = window.runs.run.placed
    trainer = Recorder(placed, now=snapshot_of(placed))
    run = ExerciseRun(trainer, placed, window.runs.run.profile, guidance=GuidancePart(streak=True),
                      shown=Shown(live=False), inspect=lambda *_: pytest.fail("asked"))  # fmt: skip
    window.conductor._attach(run)
    window.workspace.show_bullseye(True)
    return window, trainer


def telling(window: QWidget) -> dict[str, object]:
    """Everything that the widgets of a window say, in words, numbers and pictures."""
    told: dict[str, object] = {}
    for number, widget in enumerate(window.findChildren(QWidget)):
        name = f"{number} {type(widget).__name__}"
        if isinstance(widget, QLabel | QAbstractButton):
            told[f"{name} text"] = widget.text()
        if isinstance(widget, QProgressBar):
            told[f"{name} value"] = widget.value()
        if isinstance(widget, QListWidget):
            told[f"{name} lines"] = [widget.item(i).text() for i in range(widget.count())]
        told[f"{name} help"] = (widget.toolTip(), widget.accessibleName())
        if widget.isVisible() and widget.width() > 0 and widget.height() > 0:
            picture = widget.grab().toImage()
            told[f"{name} picture"] = bytes(picture.constBits())
    return told


def shown_with(window, trainer, snapshot) -> dict[str, object]:
    trainer.now = snapshot
    controller = window.conductor.controller
    controller._clock = SimpleNamespace(now=lambda: 5.0)  # ages are no truth about the needle
    controller._display._status_time = -1.0
    window.feature(RobotFeature).panel._shown = -1e9
    window.workspace.tracker_panel._shown = -1e9
    controller.poll()
    return telling(window)


@pytest.mark.long("journey")
def test_no_widget_tells_where_the_needle_is(guided, settle) -> None:
    window, trainer = guided
    controller, placed = window.conductor.controller, trainer.placed
    controller._timer.stop()
    assert window.workspace.side.count() == 7
    add_structure(window, placed.plan)
    window.view_menu.follow.trigger()
    near = snapshot_of(placed, state=State.INSERTING, pose=pose_of(placed, 0.01, 0.02))
    far = snapshot_of(
        placed, state=State.HOLDING, pose=pose_of(placed, 0.4, 0.055, deflection=0.004,
                                                  deflection_sigma=1e-4, snapped=False),
        phases=MappingProxyType({State.HOLDING: 3.0}), p_target=placed.p_target + 0.01,
        messages=("the needle bends: its tip is 4.0 mm off its line",),
        slots={"potential": 0.4, "energy_bound": 1.0, "gauge": 1.0, "gauge_force": 4.0},
    )  # fmt: skip
    far = replace(far, tracker=replace(far.tracker, discrepancy="the cameras see it 9 mm deeper"))
    for tab, name in enumerate(window.workspace.side.names()):
        window.workspace.side.setCurrentIndex(tab)
        settle(timeout=0.3)
        shown_with(window, trainer, near)  # what is drawn once is drawn
        settle(timeout=0.2)
        first, second = (shown_with(window, trainer, moment) for moment in (near, far))
        different = [key for key in first if first[key] != second.get(key)]
        assert different == [], [(name, first[key], second.get(key)) for key in different
                                 if "picture" not in key]  # fmt: skip
    assert window.workspace.viewing.needle is None
    assert window.feature(StructuresFeature).panel.live.text() == ""


@pytest.mark.long("journey")
def test_structures_are_said_nothing_of_while_scans_guide(guided, settle) -> None:
    window, trainer = guided
    add_structure(window, trainer.placed.plan)
    breaches = []
    window.feature(StructuresFeature).watch.breached.connect(breaches.append)
    for depth in (0.0, 0.01, 0.02):
        trainer.now = snapshot_of(trainer.placed, pose=pose_of(trainer.placed, 0.0, depth))
        window.conductor.controller.poll()
        settle(timeout=0.08)
    assert breaches == []
    assert window.feature(StructuresFeature).watch.needle is None
    assert window.feature(StructuresFeature).watch.items(trainer.now) == ()
    window.conductor._attach(replace(window.conductor.controller.run, shown=Shown(), inspect=None))
    settle(lambda: bool(breaches))
    assert breaches  # the same needle, shown live


def add_structure(window, path) -> None:
    """Mark a ball of risk in the middle of the path."""
    book = window.editors.structures
    volume = window.conductor.patient.volume
    middle = 0.5 * (np.asarray(path.entry_mm) + np.asarray(path.target_mm))
    book.put("vessel", *brushed(None, volume, middle, 6.0, True))
    for one in book.unmeasured:
        book.set_field(one, SignedDistance.of(one))


@pytest.mark.long("journey")
def test_the_same_walk_notices_a_needle_that_is_shown(guided, settle) -> None:
    window, trainer = guided
    window.conductor._attach(replace(window.conductor.controller.run, shown=Shown(), inspect=None))
    window.conductor.controller._timer.stop()
    settle(timeout=0.2)
    placed = trainer.placed
    near, far = (
        shown_with(window, trainer, snapshot_of(placed, pose=pose_of(placed, tilt, depth)))
        for tilt, depth in ((0.01, 0.02), (0.4, 0.055))
    )
    assert any(near[key] != far.get(key) for key in near)
    assert window.workspace.viewing.needle is not None


def test_a_snapshot_without_the_needle_says_how_the_robot_is_and_nothing_of_the_needle() -> None:
    snapshot = snapshot_of(slots={"arming": 0.7, "potential": 0.2, "hand_x": 0.3, "time": 5.0})
    hidden = without_needle(snapshot)
    assert not hidden.pose.valid
    assert hidden.measured_pose is None
    assert hidden.device is not None
    assert hidden.device.tick == snapshot.device.tick
    assert np.isnan(hidden.device.q).all()
    from app.core import state_vector as sv

    assert hidden.device.row[sv.ARMING] == 0.7
    assert hidden.device.row[sv.POTENTIAL] == hidden.device.row[sv.HAND_X] == 0.0
    assert without_needle(replace(snapshot, state=State.READY)).state is State.READY


@pytest.mark.long("journey")
def test_states_that_are_read_from_the_needle_are_not_listed(guided) -> None:
    window, trainer = guided
    controller, messages = window.conductor.controller, window.workspace.messages
    for kind, state in (("state", "aligning"), ("state", "holding"), ("abort", "aborted")):
        trainer.events.put(Event(1.0, kind, f"{state}!", {"state": state}))
    trainer.events.put(Event(1.0, "depth", "depth measured again"))
    controller.poll()
    lines = " ".join(messages.item(i).text() for i in range(messages.count()))
    assert "aligning!" in lines
    assert "aborted!" in lines
    assert "holding" not in lines
    assert "depth" not in lines


@pytest.mark.long("journey")
def test_the_pedal_takes_the_slices_that_are_set(guided, settle) -> None:
    window, trainer = guided
    panel = window.workspace.exercise_panel
    window.workspace.show_exercise()
    assert panel.scan.isVisible()
    assert not panel.readouts.force.isVisible()
    trainer.begin()
    window.conductor.controller.poll()
    panel.scan.table.setValue(141.0)
    panel.scan.head.click()
    panel.scan.slices.setValue(5)
    panel.buttons.scan.click()
    assert trainer.told("scan") == [("scan", ScanOrder(146.0, 5, 5.0))]
    window.workspace.viewing.set_cursor((0.0, 0.0, 120.0))
    panel.scan.here.click()
    assert panel.scan.order.centre_mm == pytest.approx(120.0)


@pytest.mark.long("journey")
def test_the_range_of_the_next_scan_stands_on_the_planning_ct(guided, settle) -> None:
    window, _ = guided
    panel = window.workspace.exercise_panel.scan
    axial, sagittal, coronal = window.conductor.scans.ranges
    settle()
    assert axial.lines == ()
    before = [line[0].y() for line in sagittal.lines]
    panel.head.click()
    settle()
    after = [line[0].y() for line in sagittal.lines]
    np.testing.assert_allclose(np.array(before) - after, 5.0)  # the head is up
    assert abs(after[0] - after[1]) == pytest.approx(15.0)
    assert len(coronal.lines) == 2
    window.conductor._detach()
    window.conductor.controller.detach()
    settle()
    assert sagittal.lines == ()


@pytest.mark.long("journey")
def test_the_slices_of_the_last_scan_are_shown_and_counted(guided, settle) -> None:
    window, trainer = guided
    view, panel = window.workspace.scan_view, window.workspace.exercise_panel.scan
    window.conductor.controller.begin("s")
    trainer.events.put(scan_event(1))
    trainer.events.put(scan_event(2, order=ScanOrder(144.0, 5, 2.0)))
    assert settle(lambda: view.scan is not None and view.scan.number == 2)
    volume = view.viewing.volume
    assert volume is not None
    assert volume.size[2] == 5
    assert volume.hu.max() == 3071
    assert len(view._thumbs.buttons()) == 5
    assert "teaching estimate" in view._caption.text()
    assert panel.count.text().startswith("Scans: 2 · 23.1 mGy·cm (teaching estimate)")
    assert not panel.progress.format()
    window.conductor.controller.began.emit("another")
    assert view.scan is None


@pytest.mark.long("journey")
def test_the_scan_pane_draws_nothing_live(guided, settle) -> None:
    window, trainer = guided
    view = window.workspace.scan_view
    trainer.events.put(scan_event())
    assert settle(lambda: view.scan is not None)
    window.conductor.controller.poll()
    assert view.viewing.needle is None
    assert not view.viewing.draft.complete


@pytest.mark.long("journey")
def test_the_scan_follows_window_and_crosshair_of_the_planning_ct(guided, settle) -> None:
    window, trainer = guided
    view, planning = window.workspace.scan_view, window.workspace.viewing
    trainer.events.put(scan_event())
    assert settle(lambda: view.scan is not None)
    view.viewing.set_window(replace(planning.window, width=1234.0))
    assert planning.window.width == 1234.0
    slice_before = float(view.viewing.cursor_mm[2])
    planning.set_cursor((3.0, 4.0, 150.0))
    np.testing.assert_allclose(view.viewing.cursor_mm, (3.0, 4.0, slice_before), atol=1e-6)


@pytest.mark.long("journey")
def test_the_hand_still_moves_where_nothing_is_drawn(guided) -> None:
    window, trainer = guided
    bullseye = window.workspace.bullseye
    window.conductor.controller.poll()
    from app.session.pad.hand import HandPose

    bullseye.take_hand(HandPose(trainer.placed.axis, 0.01, True))
    before = bullseye.hand
    QTest.keyClick(bullseye.pad, Qt.Key.Key_PageDown)
    assert bullseye.hand is not None
    assert before is not None
    assert bullseye.hand.depth == pytest.approx(before.depth + 0.001)
    assert not bullseye.depth_bar.isVisible()


@pytest.mark.long("journey")
def test_a_live_exercise_shows_neither_panel_nor_scan(window, patient, settle) -> None:
    window.conductor.set_exercise(next(iter(window.feature(ExerciseFeature).exercises.values())))
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None and window.conductor.settled)
    window.workspace.show_exercise()
    assert not window.workspace.exercise_panel.scan.isVisible()
    assert not window.workspace.scan_view.isVisible()
    assert window.workspace.bullseye.isVisible()


@pytest.mark.long("journey")
def test_a_scan_of_a_live_attempt_is_about_the_tip_and_fills_the_main_view(guided, settle) -> None:
    window, trainer = guided
    workspace, placed = window.workspace, trainer.placed
    run = ExerciseRun(trainer, placed, window.runs.run.profile, guidance=GuidancePart(slices=5))
    window.conductor._attach(run)
    workspace.room.begin(live=True)
    assert not workspace.scan_view.isVisible()
    window.conductor.controller.scan()
    ((_, order),) = trainer.told("scan")
    way = trainer.now.pose.depth / placed.length  # on the path, or nearly: the planned points tell
    entry, target = placed.plan.entry_mm, placed.plan.target_mm
    assert order.slices == 5
    assert order.centre_mm == pytest.approx(entry[2] + way * (target[2] - entry[2]), abs=3.0)
    trainer.events.put(scan_event())
    assert settle(lambda: workspace.scan_view.scan is not None)
    assert workspace.room.shows_scan
    assert settle(workspace.scan_view.isVisible)
    assert not any(pane.isVisible() for pane in workspace.slices)
    workspace.room.toggle_scan()
    assert not workspace.scan_view.isVisible()
    assert any(pane.isVisible() for pane in workspace.slices)
    workspace.room.end()
    assert not workspace.scan_view.isVisible()


@pytest.mark.long("journey")
def test_an_assessment_guides_by_scans_unless_it_says_otherwise(window) -> None:
    exercise = next(iter(window.feature(ExerciseFeature).exercises.values()))
    assert exercise.guidance_mode is GuidanceMode.LIVE
    assessment = type(exercise).model_validate(exercise.model_dump() | {"purpose": "assessment"})
    assert assessment.guidance_mode is GuidanceMode.CONTROL_CT
    assert {view.value for view in assessment.shown_views} == {"three_d"}
    live = assessment.model_copy(update={"guidance": GuidancePart(mode=GuidanceMode.LIVE)})
    assert live.guidance_mode is GuidanceMode.LIVE


def reviewed(**changes):
    """An attempt with two control scans as the debrief gets it."""
    from views_exercise_attempts import review

    events = (scan_event(1), scan_event(2, order=ScanOrder(180.0, 4, 5.0), time=9.0))
    scans = tuple(scan for scan in map(ControlScan.of, events) if scan is not None)
    return review(control_scans=scans, origin=1.0, **changes)


@pytest.mark.long("journey")
def test_the_debrief_lists_every_scan_with_what_it_showed(window) -> None:
    page = window.feature(DebriefFeature).page
    page.show_review(reviewed())
    rows = [
        [page.scans.item(row, column).text() for column in range(page.scans.columnCount())]
        for row in range(page.scans.rowCount())
    ]
    assert rows[0] == ["1", "0:02", "3 × 4 mm, S 134.0 to S 146.0", "● tip",
                       "11.6"]  # fmt: skip
    assert "teaching estimate" in " ".join(page.scans.horizontalHeaderItem(4).text().split())
    assert rows[1][3] == "✖ no needle"
    assert not page.scans.isHidden()
    page.show_review(replace(reviewed(), control_scans=()))
    assert page.scans.isHidden()


@pytest.mark.long("journey")
def test_the_debrief_shows_a_scan_again_beside_the_truth(guided, settle) -> None:
    window, _ = guided
    window.feature(DebriefFeature).page.show_review(reviewed())
    window.feature(DebriefFeature).page.scans.cellActivated.emit(0, 0)
    assert settle(lambda: window.feature(DebriefFeature).scan_pictures.dialog is not None)
    view = window.feature(DebriefFeature).scan_pictures.dialog.findChild(ScanView)
    assert view.viewing.needle is not None
    assert view.viewing.draft.complete
    window.feature(DebriefFeature).scan_pictures.dialog.close()


@pytest.mark.long("journey")
def test_the_debrief_reads_the_ct_again_as_it_was_in_the_attempt(
    guided, settle, monkeypatch
) -> None:
    window, _ = guided
    volume = window.conductor.patient.volume
    asked = []

    def read_again(series, recipe, progress):
        asked.append((series, recipe))
        return volume

    monkeypatch.setattr("app.imaging.reading.read_again", read_again)
    pseudonym = volume.series.pseudonym
    for recipe in (volume.recipe, None, Recipe("halve", (2, 2, 1))):
        window.feature(DebriefFeature).scan_pictures.dialog = None
        window.feature(DebriefFeature).page.show_review(reviewed(ct=CtFacts(pseudonym, (), recipe)))
        window.feature(DebriefFeature).page.scans.cellActivated.emit(0, 0)
        assert settle(lambda: window.feature(DebriefFeature).scan_pictures.dialog is not None)
        window.feature(DebriefFeature).scan_pictures.dialog.close()
    assert asked == [(volume.series, Recipe("halve", (2, 2, 1)))]


@pytest.mark.long("journey")
def test_a_scan_of_another_ct_is_not_made_of_this_one(guided, settle) -> None:
    window, _ = guided
    window.feature(DebriefFeature).page.show_review(reviewed(ct=CtFacts("CT-OTHER")))
    failures = []
    window.conductor.failed.connect(failures.append)
    window.feature(DebriefFeature).page.scans.cellActivated.emit(0, 0)
    assert "CT-OTHER" in str(failures)
    assert window.feature(DebriefFeature).scan_pictures.dialog is None


OUT_S, PAUSE_S = 12.0, 5.0
"""The needle is brought out before the attempt, and the attempt waits once, so long [s]."""


def state_events():
    """What a trainer says of a needle that is brought out first, and of a pause."""
    states = (
        (1000.0, "withdrawing"), (1000.0 + OUT_S, "aligning"), (1050.0, "inserting"),
        (1060.0, "paused"), (1060.0 + PAUSE_S, "inserting"),
    )  # fmt: skip
    return [Event(time, "state", state, {"state": state}) for time, state in states]


@pytest.mark.long("journey")
def test_a_scan_is_told_by_the_clock_on_the_rail(guided, settle) -> None:
    window, trainer = guided
    trainer.begin()
    source = window.conductor.scans
    source._begin()
    for event in (*state_events(), scan_event(2, time=1105.0)):
        source._take(event)
    view = window.workspace.scan_view
    assert settle(lambda: view.scan is not None)
    rail = clock_text(1105.0 - 1000.0 - OUT_S - PAUSE_S)
    assert rail == "1:28"
    assert f"Control scan 2 at {rail} " in view._caption.text()


def test_messages_are_told_by_the_clock_on_the_rail(application) -> None:
    messages = MessageList()
    messages.start_clock()
    for event in (*state_events(), Event(1105.0, "scan", "control scan 2")):
        messages.add_event(event)
    lines = [messages.item(row).text() for row in range(messages.count())]
    assert "0:" not in lines[0]  # before the clock runs
    assert "0:00" in lines[1]
    assert "1:28" in lines[-1]


@pytest.mark.long("journey")
def test_the_debrief_tells_every_time_by_the_clock_of_the_attempt(window) -> None:
    from views_exercise_attempts import review

    page = window.feature(DebriefFeature).page
    scan = ControlScan.of(scan_event(2, time=1060.0 + PAUSE_S + 3.0))
    clock = AttemptClock.of(state_events())
    shown = review(control_scans=(scan,), origin=1000.0, clock=clock)
    page.show_review(shown)
    assert page.scans.item(0, 1).text() == "0:51"
    assert page.curves.read_out(OUT_S + 2.0).startswith("2.0 s")
    page.bar.begin(shown.shown_time)
    page.bar.show_time(OUT_S + 2.0)
    assert page.bar.clock.text().startswith("2.0 / ")
    for _ in range(len(page.curves._curves) + 1):
        page.curves._draw_next()
    axis = page.curves._plots[-1].getAxis("bottom")
    levels = axis.tickValues(0.0, 64.0, 600.0)
    told = [float(text) for step, at in levels for text in axis.tickStrings(at, 1.0, step)]
    assert told
    assert all(number == pytest.approx(round(number)) for number in told)
    assert min(told) == 0.0
    assert max(told) <= 64.0 - OUT_S - (64.0 - 60.0)  # the clock stands in the pause
