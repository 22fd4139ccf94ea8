"""Every view of an exercise is on or off by the exercise, in the real window, at one gate."""

from dataclasses import replace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from views_exercise_fakes import FakeTrainer as Recorder
from views_exercise_fakes import pose as pose_of
from views_exercise_fakes import snapshot as snapshot_of
from window_rig import plan

from app.compose.declared_views import declared_views
from app.exercises.guidance import GuidanceMode, GuidancePart
from app.exercises.library import load_exercise
from app.exercises.locks import Lock
from app.exercises.parts import TELLING, ViewName
from app.exercises.scene import CONTROL_SCAN, compile_exercise, device_of
from app.exercises.schema import Exercise
from app.session.curves import offset
from app.session.machine import State
from app.session.shown_views import Shown
from app.session.snapshot import BreathHold, NextStep, StepKind
from app.session.transitions import PauseCause
from app.views.exercise.feature import ExerciseFeature
from app.views.exercise.run import ExerciseRun
from app.views.exercise.steps import step_words
from app.views.plan.feature import PlanFeature
from app.views.reading.lock_words import view_title

SHIFT = np.array([0.002, 0.006, -0.003])


@pytest.fixture
def shows(window, patient, settle):
    """Show a moment of an attempt whose exercise has these views; returns the window."""

    def show(views, interactive=True, **changes):
        first = load_exercise("first-insertion").showing(views).model_copy(update=changes)
        window.conductor.set_exercise(first)
        window.show_patient(patient)
        plan(window)
        assert settle(lambda: window.runs.run is not None and window.conductor.settled)
        placed = window.runs.run.placed
        where, moved = pose_of(placed, 0.1, 0.03), placed.p_target + SHIFT
        moment = snapshot_of(
            placed, pose=where, slots={"axial_force": 2.34}, p_target=moved,
            offset=offset(where, moved, placed),
        )  # fmt: skip
        run = ExerciseRun(
            Recorder(placed, now=moment), placed, window.runs.run.profile, interactive,
            inspect=lambda *_: window.asked.append(True), shown=Shown.of_exercise(first),
        )  # fmt: skip
        window.asked = []
        window.conductor._attach(run)
        window.conductor.controller._timer.stop()
        window.workspace.show_exercise()
        window.workspace.show_cameras()
        settle(timeout=0.05)
        window.workspace.tracker_panel._shown = -1e9
        window.conductor.controller._display._figures_time = -1.0
        window.conductor.controller.poll()
        window.workspace.show_exercise()
        settle(timeout=0.05)
        return window

    return show


def both(view):
    """Views with and without this one."""
    return frozenset(ViewName), frozenset(ViewName) - {view}


@pytest.mark.long("journey")
def test_the_needle_is_on_the_slices_by_live_overlay(shows):
    on, off = both(ViewName.LIVE_OVERLAY)
    assert shows(on).workspace.viewing.needle is not None
    assert shows(off).workspace.viewing.needle is None


@pytest.mark.long("journey")
def test_the_bullseye_is_empty_without_its_view_and_says_no_offset(shows):
    on, off = both(ViewName.BULLSEYE)
    window = shows(on)
    panel, pad = window.workspace.exercise_panel, window.workspace.bullseye
    assert pad.depth_bar.isVisible()
    assert pad._lateral.text().startswith("off the path")
    assert panel.readouts._values["lateral"].isVisible()
    window = shows(off)
    assert pad.isVisible()  # it moves the simulated hand
    assert not pad.depth_bar.isVisible()
    assert not pad._lateral.isVisible()
    assert pad.pad._view is None
    assert not panel.readouts._values["lateral"].isVisible()
    assert not panel.readouts._values["angle"].isVisible()


@pytest.mark.long("journey")
def test_the_bullseyes_cell_is_gone_where_nothing_would_be_in_it(shows):
    window = shows(frozenset({ViewName.THREE_D}), interactive=False)
    assert not window.workspace.has_bullseye
    window.view_menu.bullseye.trigger()
    assert not window.workspace.has_bullseye
    assert shows(frozenset({ViewName.FORCE_GAUGE}), interactive=False).workspace.has_bullseye


@pytest.mark.long("journey")
def test_the_3d_pane_says_that_it_is_off_and_draws_nothing(shows, settle):
    on, off = both(ViewName.THREE_D)
    scene = shows(on).workspace.scene
    assert scene.off == ""
    window = shows(off)
    assert "Not shown in this exercise" in scene.off
    given = []
    scene._feed._renderer.request = given.append
    scene.set_orbit(scene.orbit.turned(5.0, 5.0))
    window.conductor.controller.poll()
    settle(timeout=0.5)
    assert given == []
    assert scene.is_settled


@pytest.mark.long("journey")
def test_camera_pictures_are_not_even_asked_for_without_their_view(shows):
    on, off = both(ViewName.CAMERAS)
    assert shows(on).asked
    window = shows(off)
    assert not window.asked
    cameras = window.workspace.tracker_panel.cameras
    assert all("Not shown in this exercise" in camera._instead for camera in cameras)


@pytest.mark.long("journey")
def test_the_force_along_the_needle_is_read_at_arms_length(shows):
    on, off = both(ViewName.FORCE_GAUGE)
    window = shows(on)
    gauge = window.workspace.needle_cell.gauge
    assert gauge.isVisible()
    assert gauge.number == "2.3 N"
    assert "pushes it out" in gauge.words
    assert gauge.height() >= 30
    shows(off)
    assert not gauge.isVisible()


@pytest.mark.long("journey")
def test_the_target_moves_on_slices_and_in_every_number_only_where_its_motion_is_shown(shows):
    on, off = both(ViewName.TARGET_MOTION)
    window = shows(on)
    viewing, run = window.workspace.viewing, window.conductor.controller.run
    moved = np.asarray(viewing.shown_draft.target_mm) - viewing.draft.target_mm
    np.testing.assert_allclose(run.placed.T_world_patient.rotation @ moved, 1e3 * SHIFT, atol=1e-9)
    moving = window.workspace.bullseye._view
    way = run.placed.p_target + SHIFT - run.placed.p_entry
    np.testing.assert_allclose(moving.offset.path, way / np.linalg.norm(way), atol=1e-9)
    window = shows(off)
    run = window.conductor.controller.run
    assert viewing.target_now_mm is None
    still = window.workspace.bullseye._view
    assert still.frame(run.scene()) is run.scene().frame or np.allclose(
        still.offset.path, run.placed.axis
    )
    assert still.offset.lateral != pytest.approx(moving.offset.lateral, abs=1e-5)


def test_where_scans_guide_nothing_that_tells_is_on_whatever_the_exercise_lists():
    exercise = load_exercise("scans-only").showing(frozenset(ViewName))
    shown = Shown.of_exercise(exercise)
    assert not any(shown.shows(view) for view in TELLING)
    assert shown.shows(ViewName.THREE_D)


# --- switched by the student ------------------------------------------------------------------
@pytest.mark.long("journey")
def test_a_student_switches_views_in_practice_and_the_run_is_built_anew_with_them(
    window, patient, settle, services
):
    window.conductor.set_exercise(load_exercise("first-insertion"))
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    action = window.view_menu.shown[ViewName.FORCE_GAUGE]
    assert action.isEnabled()
    assert not action.isChecked()
    before = len(services.opened)
    action.trigger()
    assert settle(lambda: len(services.opened) > before and window.runs.run is not None)
    assert ViewName.FORCE_GAUGE in services.opened[-1].setup.exercise.views
    assert action.isChecked()
    assert window.workspace.needle_cell.gauge.isVisibleTo(window.workspace.needle_cell)


@pytest.mark.long("journey")
def test_locked_views_stay_and_say_why(window, patient, settle):
    locked = load_exercise("first-insertion").model_copy(update={"locks": (Lock.VIEWS,)})
    window.conductor.set_exercise(locked)
    window.show_patient(patient)
    said = []
    window.conductor.failed.connect(lambda error: said.append(str(error)))
    for view, action in window.view_menu.shown.items():
        assert not action.isEnabled()
        assert "First insertion" in action.toolTip()
        action.trigger()
        window.conductor.show_view(view, view not in locked.views)
    assert window.conductor.exercise.views == locked.views
    assert len(said) == len(ViewName)


# --- declared, and compiled -------------------------------------------------------------------
def test_every_view_and_the_control_scans_declare_what_they_read():
    assert set(declared_views()) == {view.value for view in ViewName} | {CONTROL_SCAN}
    assert all(view_title(view) for view in ViewName)


def fate(exercise: Exercise, simulated: bool = False) -> dict[str, str]:
    plan_ = compile_exercise(exercise, device_of(exercise), declared_views(), simulated)
    kept = {kept.name: kept.why for kept in plan_.kept}
    return kept | {dropped.name: dropped.why for dropped in plan_.dropped}


REST = {"planned_target_error": load_exercise("thick-tissue").tolerances["planned_target_error"]}


@pytest.mark.parametrize("view", ViewName)
def test_with_a_view_off_an_effect_that_only_it_consumes_is_dropped(view):
    effects = {"breathing": {}, "shaft_friction": {}}
    everything = Exercise.model_validate(
        {"id": "a", "title": "A", "effects": effects, "tolerances": REST}
    )
    on, off = (fate(everything.showing(views)) for views in both(view))
    for effect, consumer in (
        ("shaft_friction", ViewName.FORCE_GAUGE),
        ("breathing", ViewName.TARGET_MOTION),
    ):
        assert on[effect].startswith("simulated")
        assert off[effect].startswith("dropped" if view is consumer else "simulated")
        words = declared_views()[consumer.value].label
        assert words in on[effect]
        assert (declared_views()[view.value].label in on[effect]) == (view is consumer)


def test_the_control_scans_consume_the_motion_of_the_target_themselves():
    exercise = Exercise.model_validate(
        {"id": "a", "title": "A", "effects": ["breathing"], "tolerances": REST}
    )
    assert fate(exercise)["breathing"].startswith("dropped")
    guided = replace_mode(exercise, GuidanceMode.CONTROL_CT)
    assert "“Control scans” shows it" in fate(guided)["breathing"]


def replace_mode(exercise: Exercise, mode: GuidanceMode) -> Exercise:
    return exercise.model_copy(update={"guidance": GuidancePart(mode=mode)})


def test_a_declaration_that_is_not_one_is_refused_by_file(tmp_path):
    from app.core.errors import ConfigurationError

    good = '"""View."""\nDECLARATION = {"view": "a", "title": "A", "reads": ("axial_force",)}\n'
    (tmp_path / "a.py").write_text(good)
    assert declared_views(tmp_path)["a"].reads == ("axial_force",)
    for number, (text, says) in enumerate((
        (good, "declared twice"), (good.replace("axial_force", "axial"), "slots"),
        (good.replace('"a"', '""'), "not empty"), (good.replace('"title"', '"name"'), "exactly"),
    )):  # fmt: skip
        folder = tmp_path / str(number)
        folder.mkdir()
        (folder / "b.py").write_text(text)
        if number == 0:
            (folder / "a.py").write_text(good)
        with pytest.raises(ConfigurationError, match=says):
            declared_views(folder)


@pytest.mark.long("journey")
def test_a_snapshot_without_the_targets_motion_has_all_distances_to_the_target_at_rest(shows):
    window = shows(frozenset(ViewName))
    run = window.conductor.controller.run
    snapshot = replace(run.trainer.snapshot(), p_target=run.placed.p_target + SHIFT)
    still = Shown(True, frozenset(ViewName) - {ViewName.TARGET_MOTION}).of(snapshot, run.placed)
    np.testing.assert_array_equal(still.p_target, run.placed.p_target)
    np.testing.assert_allclose(still.offset.path, run.placed.axis, atol=1e-12)
    assert Shown().of(snapshot, run.placed) is snapshot


@pytest.mark.long("journey")
def test_one_line_over_the_views_always_says_the_next_step(shows, settle):
    on, _ = both(ViewName.LIVE_OVERLAY)
    window = shows(on)
    line = window.workspace.next_step
    assert line.isVisible()
    run = window.conductor.controller.run
    window.workspace.show_exercise()
    assert settle(lambda: line.text() == "Press F5 to start the attempt")
    moment = replace(run.trainer.snapshot(), state=State.INSERTING)
    window.conductor.controller.snapshot_taken.emit(moment)
    assert settle(lambda: line.text() == "Pull back 2 mm (wheel towards you)")
    assert line.fontMetrics().horizontalAdvance(line.text()) < line.width()
    line.begin(replace(run, shown=Shown(live=False)))
    assert line.text() == "One moment: the robot is starting"
    line.show_snapshot(moment)
    assert settle(lambda: line.text() == "Push by the scans: S takes one, Enter ends the attempt")
    window.conductor._detach()
    assert not line.isVisible()


@pytest.mark.long("journey")
def test_who_is_at_the_plan_is_not_told_to_start_and_the_views_do_not_move(shows, settle):
    on, _ = both(ViewName.LIVE_OVERLAY)
    window = shows(on)
    line, side, run = window.workspace.next_step, window.workspace.side, window.conductor.controller
    window.workspace.show_exercise()
    assert settle(lambda: line.text() == "Press F5 to start the attempt")
    place, loud = line.geometry(), line.styleSheet()
    side.setCurrentWidget(window.feature(PlanFeature).panel)
    assert settle(lambda: line.text() == "")
    assert settle(lambda: line.geometry() == place)
    assert line.styleSheet() != loud
    # an order of an attempt that runs is given whatever panel is open
    run.snapshot_taken.emit(replace(run.run.trainer.snapshot(), state=State.INSERTING))
    assert settle(lambda: line.text() == "Pull back 2 mm (wheel towards you)")


@pytest.mark.long("journey")
def test_an_attempt_that_waits_for_the_computer_blames_the_computer_in_large_letters(shows, settle):
    on, _ = both(ViewName.LIVE_OVERLAY)
    window = shows(on)
    line, run = window.workspace.next_step, window.conductor.controller.run
    window.workspace.show_exercise()
    assert settle(lambda: line.text() == "Press F5 to start the attempt")
    waits = replace(
        run.trainer.snapshot(),
        state=State.PAUSED,
        pause=PauseCause.COMPUTER,
        breath=BreathHold(asked=True, held=True, left=3.0),
    )
    window.conductor.controller.snapshot_taken.emit(waits)
    words = "Paused: this computer is too busy. Close other programs to go on."
    assert settle(lambda: line.text() == words)
    assert line.fontMetrics().horizontalAdvance(words) < line.width()
    window.conductor.controller.snapshot_taken.emit(replace(waits, pause=PauseCause.CAMERAS))
    assert settle(lambda: line.text().endswith("Let both cameras see the marker"))


@pytest.mark.parametrize("kind", list(StepKind))
@pytest.mark.parametrize("by_mouse", [True, False])
def test_every_step_is_an_order_in_words(kind, by_mouse):
    words = step_words(NextStep(kind, "IL", 0.012, 0.003), by_mouse)
    assert words
    assert "{" not in words
    if kind is StepKind.TILT:
        where = "the feet and the patient's left"
        assert words == f"Tilt the hub towards {where}: 3 mm off the target"
    assert ("wheel" in words) <= by_mouse


@pytest.mark.long("journey")
def test_begin_means_begin_and_the_key_starts_beside_any_panel(window, patient, settle):
    window.conductor.set_exercise(load_exercise("first-insertion"))
    exercises = window.feature(ExerciseFeature)
    exercises._waiting = load_exercise("first-insertion")
    window.show_patient(patient)
    side, panel = window.workspace.side, window.workspace.exercise_panel
    assert panel.isVisible()
    exercises._waiting = load_exercise("plan-it-yourself")
    window.show_patient(patient)
    window.conductor.set_exercise(load_exercise("first-insertion"))
    plan(window)
    assert settle(lambda: window.runs.run is not None and panel.buttons.start.isEnabled())
    side.setCurrentIndex(0)
    assert not panel.isVisible()
    window.activateWindow()
    QTest.keyClick(window.workspace, Qt.Key.Key_F5)
    assert settle(lambda: window.runs.run.trainer.state is State.ALIGNING)


@pytest.mark.long("journey")
def test_an_exercise_whose_plan_is_the_students_begins_with_planning(window, patient):
    window.workspace.side.setCurrentIndex(0)
    before = window.workspace.side.currentIndex()
    window.feature(ExerciseFeature)._waiting = load_exercise("plan-it-yourself")
    window.show_patient(patient)
    assert window.workspace.side.currentIndex() == before
    assert not window.workspace.exercise_panel.isVisible()
