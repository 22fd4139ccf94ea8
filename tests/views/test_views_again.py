"""Between two attempts and two people: an attempt begins as the first one of its exercise does."""

from dataclasses import replace
from pathlib import Path
from threading import Event
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox
from window_rig import choose, plan, press, state

from app.core import state_vector as sv
from app.exercises.guidance import GuidanceMode, GuidancePart, StartingDial
from app.exercises.library import load_exercise
from app.exercises.locks import Lock
from app.session.machine import State
from app.session.people import Person
from app.views.debrief.feature import DebriefFeature
from app.views.exercise.beginning import BeginWish
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.access import ACCESS, Known
from app.views.plan.feature import PlanFeature
from app.views.plan.paths import PathsFeature
from app.views.slices.camera import SliceCamera
from app.views.slices.viewing import Tool

ENTRY = (5.0, -18.0, 140.0)
OWN = "plan-it-yourself"


@pytest.fixture
def lesion(monkeypatch):
    """Lesion of the phantom, in the tests' own patient."""
    found = SimpleNamespace(lesion_mm=(5.0, 5.0, 140.0))
    monkeypatch.setattr("app.exercises.scene._phantom_of", lambda _: found)


@pytest.fixture
def somebody():
    yield
    ACCESS.learn(Known())
    ACCESS.sign_in(None)


def line(window):
    """Return what the line says while the exercise is in front, not the plan."""
    if not window.workspace.side.is_shown(window.workspace.exercise_panel):
        window.workspace.show_exercise()
    return window.workspace.next_step.text()


def told(window):
    return "" if window.message_bar.isHidden() else window.message_bar.text


def start(window):
    return window.workspace.exercise_panel.buttons.start


def place_entry(window):
    window.editor.place(Tool.ENTRY, ENTRY, True)


def attempted(window, settle, name):
    """Do an exercise from the start page on, placing the entry where it is the student's to choose,
    and stand before its debrief."""
    choose(window, name)
    press(window, Qt.Key.Key_Return)
    assert settle(lambda: window.pages.currentWidget() is window.workspace)
    if name == OWN:
        assert settle(lambda: window.feature(ExerciseFeature).beginning.wish is BeginWish.NOTHING)
        place_entry(window)
        assert settle(lambda: start(window).isEnabled())
        press(window, Qt.Key.Key_F5)
    assert settle(lambda: state(window) is State.ALIGNING)
    end(window, settle)


def end(window, settle):
    window.conductor.controller.run.trainer.state = State.ENDED
    debrief = window.feature(DebriefFeature)
    debrief._controller.exercise = window.conductor.exercise.id
    debrief.show()
    assert settle(lambda: not window.editor.locked)


def choose_answer(monkeypatch, name):
    """Answer questions by the button of this name; returns their words."""
    asked = []

    def press_button(box):
        asked.append(box.text())
        next(one for one in box.buttons() if one.text() == name).click()

    monkeypatch.setattr(QMessageBox, "exec", press_button)
    return asked


@pytest.mark.long("journey")
def test_the_plan_of_an_exercise_is_called_by_its_title_and_a_file_by_its_name(
    window, patient, lesion
):
    title = window.feature(PlanFeature).panel.title
    window.conductor.set_exercise(load_exercise(OWN))
    window.show_patient(replace(patient, phantom_seed=6))  # the exercise's
    assert title.text() == "Plan it yourself"
    place_entry(window)
    assert title.text() == "Plan it yourself •"
    window.editor.saved(Path("mine.json"))
    assert title.text() == "mine.json"


# --- where the needle begins ------------------------------------------------------------------
@pytest.mark.long("journey")
def test_again_begins_off_the_path_like_the_first_wherever_the_hand_was_left(real, settle):
    controller, bullseye = real.conductor.controller, real.workspace.bullseye
    panel = real.workspace.exercise_panel
    real.workspace.show_exercise()

    def off_deg():
        """Angle between the needle and the path."""
        x, y = controller.run.trainer.snapshot().device.row[[sv.GRIP_X, sv.GRIP_Y]]
        needle = np.array([x, y, -np.sqrt(1.0 - x * x - y * y)])
        return float(np.degrees(np.arccos(abs(needle @ controller.run.placed.axis))))

    def ready():
        return controller.run.trainer.snapshot().ready

    def going():
        return controller.run.trainer.snapshot().state is State.ALIGNING

    assert settle(panel.buttons.start.isEnabled)
    panel.buttons.start.click()
    assert settle(ready)
    assert settle(lambda: bullseye.hand is not None and bullseye._view is not None)
    results, starts = [], [off_deg()]
    controller.finished.connect(results.append)
    for number in (1, 2):
        bullseye.source.moved.emit(lambda hand: hand.tilt(0.15, 0.1))
        bullseye.source.moved.emit(lambda hand: hand.advance(0.008))
        assert settle(going)  # the first movement begins it
        controller.end()
        assert settle(lambda number=number: len(results) == number)
        real.show_workspace()
        assert settle(panel.buttons.start.isEnabled)
        panel.buttons.start.click()
        assert settle(ready)
        starts.append(off_deg())
        x, y = controller.run.trainer.snapshot().device.row[[sv.GRIP_X, sv.GRIP_Y]]
        assert bullseye.hand.direction[:2] == pytest.approx([x, y], abs=5e-3)  # nothing will jump
    assert 7.0 < min(starts) < max(starts) < 15.0
    assert len({round(one, 2) for one in starts}) == 3, "each time elsewhere"


@pytest.mark.long("journey")
def test_an_attempt_begins_with_the_exercises_own_view_of_the_ct(window, patient, settle):
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    viewing, controller = window.workspace.viewing, window.conductor.controller
    pane = window.workspace.panes[0]

    def whole():
        fit = SliceCamera.fit(
            pane.canvas.plane.home_mm, (pane.canvas.width(), pane.canvas.height())
        )
        return pane.canvas.camera == fit

    for _ in range(2):  # and again
        pane.canvas.set_camera(pane.canvas.camera.zoomed(4.0, 3.0, 2.0).panned(30.0, 20.0))
        viewing.set_cursor((-15.0, -10.0, 120.0))
        assert not whole()
        controller.begin("")
        settle(lambda: False, 0.1)
        voxel = np.abs(np.array(viewing.cursor_mm) - window.editor.edit.draft.target_mm)
        assert voxel.max() <= 1.0, "the target's voxel"
        assert whole()
        controller.run.trainer.state = State.ENDED
        assert settle(lambda: not window.editor.locked)
        controller.run.trainer.state = State.READY


# --- what is missing is said, and F5 says it ------------------------------------------------------
@pytest.mark.long("journey")
def test_f5_while_robot_and_cameras_are_started_says_so_until_an_attempt_can_begin(
    window, settle, services, monkeypatch
):
    opened, may_open = services.open_run, Event()

    def slowly(*arguments):
        may_open.wait(30.0)
        return opened(*arguments)

    monkeypatch.setattr(services, "open_run", slowly)
    choose(window, "first-insertion")
    press(window, Qt.Key.Key_L)
    try:
        assert settle(lambda: window.conductor.runs._task is not None)
        settle(lambda: False, 0.3)
        press(window, Qt.Key.Key_F5)
        assert settle(lambda: "Robot and cameras are being started" in told(window))
    finally:
        may_open.set()
    assert settle(lambda: start(window).isEnabled())
    assert told(window) == ""
    assert state(window) is State.READY


@pytest.mark.long("journey")
def test_again_where_the_student_plans_is_no_dead_end_after_plan_anew(
    window, beginning, lesion, settle, monkeypatch
):
    attempted(window, settle, OWN)
    asked = choose_answer(monkeypatch, "New plan")
    window.feature(DebriefFeature).page.retry.click()
    assert settle(lambda: window.pages.currentWidget() is window.workspace)
    assert asked == ["Same plan, or a new one?"]
    assert window.editor.edit.draft.entry_mm is None
    assert settle(lambda: beginning.wish is BeginWish.NOTHING)
    assert settle(lambda: "Place the entry" in line(window))
    assert not start(window).isEnabled()
    press(window, Qt.Key.Key_F5)
    assert "Place the entry" in told(window)
    assert state(window) is State.ENDED
    place_entry(window)
    assert settle(lambda: "F5" in line(window))
    assert told(window) == ""
    assert state(window) is State.ENDED, "nothing begins by itself"
    press(window, Qt.Key.Key_F5)
    assert settle(lambda: state(window) is State.ALIGNING)


@pytest.mark.long("journey")
def test_a_plan_that_no_attempt_was_made_with_goes_on_without_a_question(
    window, beginning, lesion, settle, monkeypatch
):
    asked = choose_answer(monkeypatch, "Cancel")
    choose(window, OWN)
    for _ in range(2):
        press(window, Qt.Key.Key_Return)
        assert settle(lambda: window.pages.currentWidget() is window.workspace)
        assert settle(lambda: beginning.wish is BeginWish.NOTHING)
        place_entry(window)
        planned = window.editor.edit
        window.show_start()
        choose(window, OWN)
    assert asked == []
    assert window.editor.edit == planned


@pytest.mark.long("journey")
def test_again_with_the_same_plan_begins_on_the_plan_that_nobody_saved(
    window, beginning, lesion, settle, monkeypatch
):
    attempted(window, settle, OWN)
    planned = window.editor.edit
    assert window.editor.dirty
    choose_answer(monkeypatch, "Same plan")
    window.feature(DebriefFeature).page.retry.click()
    assert settle(lambda: state(window) is State.ALIGNING)
    assert window.pages.currentWidget() is window.workspace
    assert window.editor.edit == planned
    assert window.editor.dirty, "it is still not in a file"


@pytest.mark.long("journey")
def test_again_twice_and_a_question_that_is_cancelled_leave_the_debrief_as_it_is(
    window, beginning, lesion, settle, monkeypatch
):
    attempted(window, settle, OWN)
    asked = choose_answer(monkeypatch, "Cancel")
    debrief = window.feature(DebriefFeature).page
    debrief.retry.click()
    debrief.retry.click()
    settle(lambda: False, 0.3)
    assert len(asked) == 2
    assert window.pages.currentWidget() is debrief
    assert window.editor.edit.draft.entry_mm is not None
    assert state(window) is State.ENDED


@pytest.mark.long("journey")
def test_the_line_asks_for_f5_exactly_while_start_can_be_pressed(
    window, beginning, lesion, settle, somebody
):
    attempted(window, settle, OWN)
    window.show_workspace()
    controller, panel = window.conductor.controller, window.workspace.exercise_panel
    draft = window.editor.edit.draft

    def agrees(word):
        if not settle(lambda: word in line(window)):
            return False
        press(window, Qt.Key.Key_F5)  # says why, or would begin
        ready = start(window).isEnabled()
        return not ready and word in told(window) and state(window) is State.ENDED

    assert settle(lambda: "F5" in line(window))
    assert start(window).isEnabled()
    controller.set_waiting("Start waits: for the tests.")
    assert agrees("for the tests")
    controller.set_waiting("")
    window.editor.start(None)
    assert agrees("Place the entry")
    window.editor.start(draft)
    ACCESS.learn(Known(guarded=True, assessed={OWN: "Biopsy"}))
    assert agrees("course Biopsy")
    ACCESS.learn(Known())
    assert settle(lambda: "F5" in line(window))
    assert told(window) == ""
    assert panel.may_start
    assert start(window).isEnabled()


@pytest.mark.long("journey")
def test_a_plan_that_is_mended_later_begins_nothing_that_was_wanted_before(
    window, beginning, settle, monkeypatch
):
    attempted(window, settle, "first-insertion")
    far = (-19.0, -5.0, 104.0)
    real_plan = window.editor.edit.draft
    steep = real_plan.with_entry(far)
    monkeypatch.setattr("app.views.exercise.conductor.draft_of", lambda _: steep)
    window.feature(DebriefFeature).page.retry.click()
    assert settle(lambda: window.pages.currentWidget() is window.workspace)
    assert window.editor.verdict.placed is None
    settle(lambda: False, 0.3)
    window.editor.start(real_plan)
    assert settle(start(window).isEnabled)
    settle(lambda: False, 0.3)
    assert state(window) is State.ENDED


# --- how the hand steers -------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_the_long_tools_steering_is_not_remembered_and_the_next_exercise_has_the_students_own(
    window, beginning, settle
):
    source, feature = window.workspace.bullseye.source, window.feature(ExerciseFeature)
    feature.begin("laparoscopic-tool")
    assert settle(lambda: source.moves_hub)
    assert not window.remembered._work()["moves_hub"]
    window.remembered._set_work(window.remembered._work())  # as another window does at its start
    assert source.moves_hub, "the exercise keeps it"
    assert not window.view_menu.hub.isEnabled()
    assert "handle" in window.view_menu.hub.toolTip()
    feature.begin("first-insertion")
    assert settle(lambda: window.conductor.exercise.id == "first-insertion")
    assert not source.moves_hub
    assert window.view_menu.hub.isEnabled()
    assert not window.view_menu.hub.isChecked()
    window.view_menu.hub.trigger()  # who wants it so keeps it, there and back
    feature.begin("laparoscopic-tool")
    feature.begin("first-insertion")
    assert source.moves_hub
    assert window.remembered._work()["moves_hub"]


# --- what helps ----------------------------------------------------------------------------------
def by_scans(assistance):
    exercise = load_exercise("first-insertion")
    part = GuidancePart(mode=GuidanceMode.CONTROL_CT)
    return exercise.model_copy(update={"guidance": part, "assistance": assistance})


@pytest.mark.long("journey")
def test_where_control_scans_guide_the_help_is_the_exercises_own_and_the_dial_says_why(
    window, beginning, settle
):
    exercise = by_scans(0.0)
    window.conductor.set_exercise(exercise)
    dial = window.workspace.exercise_panel.assistance
    assert dial.share == 0.0
    assert not dial.slider.isEnabled()
    assert "Control scans guide" in dial.toolTip()
    window.conductor.set_exercise(load_exercise("first-insertion"))
    assert dial.slider.isEnabled()


@pytest.mark.long("journey")
def test_a_probe_is_without_help_to_its_end(window, beginning, settle):
    base = load_exercise("first-insertion")
    window.conductor.set_exercise(base)
    probe = base.beginning_with(StartingDial(0.0, is_probe=True))
    window.conductor.go_on_with(probe)
    dial = window.workspace.exercise_panel.assistance
    assert not dial.slider.isEnabled()
    assert "probe" in dial.toolTip()
    for view in set(base.views) - set(probe.views):
        assert "probe" in window.conductor.why_view_stays(view)
    assert Lock.ASSISTANCE in probe.locked
    assert (
        probe.model_dump()
        == base.model_copy(update={"assistance": 0.0, "views": probe.views}).model_dump()
    ), "the record says of the exercise what it said before"
    window.conductor.go_on_with(base.beginning_with(StartingDial(0.4)))
    assert dial.slider.isEnabled()


# --- what is drawn -------------------------------------------------------------------------------
@pytest.fixture
def mapped(window, beginning, lesion, settle):
    """A map of entries, made by the instructor, before the student's own plan."""
    paths = window.feature(PathsFeature)
    window.feature(ExerciseFeature).begin(OWN)
    assert settle(lambda: window.editor.edit.draft.target_mm is not None)

    def make():
        paths.make()
        assert settle(lambda: paths.scores is not None)
        assert any(layer._map is not None for layer in paths._layers)
        return paths

    return make


def drawn(paths):
    return paths.scores is not None or any(layer._map is not None for layer in paths._layers)


@pytest.mark.long("journey")
def test_the_instructors_map_of_entries_goes_with_the_instructor(window, mapped, settle, somebody):
    ACCESS.sign_in(None, instructor=True)
    paths = mapped()
    ACCESS.learn(Known(guarded=True))  # more is known of people: nobody else has come
    assert drawn(paths)
    ACCESS.sign_in(Person("p-0123456789ab", "Ada"))
    assert not drawn(paths)
    paths.make()  # and one that is being made as the next one comes
    ACCESS.sign_in(None)
    settle(lambda: False, 0.6)
    assert not drawn(paths)
    assert paths.panel.make.isEnabled()


@pytest.mark.long("journey")
def test_a_map_of_entries_is_not_there_for_who_takes_the_exercise_or_begins_the_attempt(
    window, mapped, settle, monkeypatch
):
    paths = mapped()
    window.feature(ExerciseFeature).begin(OWN)
    assert not drawn(paths)
    mapped()
    place_entry(window)
    assert drawn(paths), "another entry to the same target"
    window.feature(ExerciseFeature).beginning.trust(OWN)
    assert settle(start(window).isEnabled)
    press(window, Qt.Key.Key_F5)
    assert settle(lambda: state(window) is State.ALIGNING)
    assert not drawn(paths)


@pytest.mark.long("journey")
def test_who_is_faster_than_the_window_has_begun_and_nothing_more_is_wanted(
    window, beginning, settle
):
    choose(window, "first-insertion")
    beginning._timer.setInterval(1500)
    press(window, Qt.Key.Key_Return)
    assert settle(start(window).isEnabled)
    assert beginning.wish is BeginWish.ATTEMPT
    press(window, Qt.Key.Key_F5)
    press(window, Qt.Key.Key_F5)
    assert state(window) is State.ALIGNING
    assert beginning.wish is BeginWish.NOTHING


def test_a_list_that_is_shown_is_read_again_when_an_attempt_has_ended(window, monkeypatch):
    debrief, read = window.feature(DebriefFeature), []
    monkeypatch.setattr(debrief._controller, "show_result", lambda _: None)
    monkeypatch.setattr(debrief.sessions, "refresh", lambda: read.append("again"))
    debrief.show_result(None)
    assert read == []
    debrief._show_list()
    debrief.show_result(None)
    assert read == ["again", "again"]  # when it was opened, and when the attempt had ended
