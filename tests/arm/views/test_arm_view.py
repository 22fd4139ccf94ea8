"""Watching the arm: asked for, refused, led, stopped, taken over; recorded as nobody's attempt."""

import csv
import io
import json
from datetime import UTC, datetime

import numpy as np
import pytest
from performance_rig import OUTSIDE, performance_of
from PySide6.QtWidgets import QDialog
from window_rig import plan

from app.arm.features.arm import ArmFeature
from app.arm.scene.carrying import CarryError, CarryFailure
from app.arm.views.play import STEP_S, STILL_S, PlayState
from app.arm.views.shape import ArmPart, arm_shape
from app.exchange.csv_export import score_table
from app.exercises.guidance import Purpose
from app.exercises.library import load_exercise
from app.scoring.conditions import Conditions, comparable
from app.session.board import progress_board
from app.session.course import CourseItem, attempts_used
from app.session.index import Index, totals_of
from app.session.machine import State
from app.session.people import Person
from app.session.recording import open_recording
from app.session.review import review
from app.session.shown_views import Shown
from app.session.sidecar import fresh_summary, sidecar
from app.session.store import records
from app.simulation.errors import SimulationError
from app.views.debrief.feature import DebriefFeature
from app.views.debrief.score_words import short_words, whose_words
from app.views.exercise.feature import ExerciseFeature
from app.views.shell.services import RobotChoice
from app.views.slices.viewing import Tool


@pytest.fixture
def planned(window, patient, settle):
    """A window with a plan, and what the arm's feature says."""
    window.show_patient(patient)
    plan(window)
    assert settle(lambda: window.runs.run is not None)
    arm = window.feature(ArmFeature)
    arm.said = []
    arm.failed.connect(lambda what: arm.said.append(str(what)))
    return window, arm


def fetched(planned, settle):
    """Lead it to where the attempt has begun."""
    window, arm = planned
    arm.watch()
    assert settle(lambda: arm.play is not None and arm.play.state is PlayState.INSERTING)
    return window, arm, window.conductor.controller.run.trainer


# --- asked for, and refused ---------------------------------------------------------------------
@pytest.mark.long("journey")
def test_without_a_plan_it_says_what_to_do_first(window, patient, settle) -> None:
    arm, said = window.feature(ArmFeature), []
    arm.failed.connect(said.append)
    arm.watch()
    window.show_patient(patient)
    arm.watch()
    assert "Choose an exercise first" in said[0]
    assert "Place entry and target first" in said[1]
    assert not arm.is_busy


@pytest.mark.long("journey")
def test_an_attempt_that_runs_is_not_taken_away(planned) -> None:
    window, arm = planned
    window.conductor.controller.run.trainer.state = State.INSERTING
    arm.watch()
    assert "An attempt is running" in arm.said[0]
    assert not arm.is_busy


@pytest.mark.long("journey")
def test_why_it_was_not_done_is_said_no_longer_than_it_is_true(window, patient, settle) -> None:
    window.show_patient(patient)
    arm, bar = window.feature(ArmFeature), window.message_bar
    arm.watch()
    assert "Place entry and target first" in bar.text
    plan(window)
    assert bar.isHidden()
    assert settle(lambda: window.runs.run is not None)
    window.conductor.controller.run.trainer.state = State.INSERTING
    arm.watch()
    assert "An attempt is running" in bar.text
    window.conductor.controller.began.emit("")
    assert bar.isHidden()


@pytest.mark.long("journey")
def test_an_assessment_is_done_by_the_student(planned) -> None:
    window, arm = planned
    taken = window.conductor.exercise
    window.conductor.exercise = taken.model_copy(update={"purpose": Purpose.ASSESSMENT})
    arm.watch()
    assert "assessment" in arm.said[0]
    assert not arm.is_busy


@pytest.mark.long("journey")
def test_a_missing_extra_is_named(planned, carrying, settle) -> None:
    _window, arm = planned
    carrying.cannot = SimulationError("MuJoCo is not installed: make extra NAME=arm")
    arm.watch()
    assert settle(lambda: arm.said)
    assert "make extra NAME=arm" in arm.said[0]
    assert not arm.is_busy
    assert arm.bar.isHidden()


@pytest.mark.long("journey")
def test_where_the_arm_could_stand_is_offered(planned, carrying, settle) -> None:
    _window, arm = planned
    carrying.cannot = CarryError(CarryFailure.UNREACHABLE, "it cannot reach the entry", 90.0)
    arm.watch()
    assert settle(arm.bar.offer.isVisible)
    assert "90°" in arm.bar.offer.text()
    assert "it cannot reach" in arm.bar.words.text()
    carrying.cannot = None
    arm.bar.offer.click()
    assert settle(lambda: arm.play is not None)
    assert carrying.carried[-1][2] == 90.0


@pytest.mark.long("journey")
def test_an_offer_may_be_left(planned, carrying, settle) -> None:
    window, arm = planned
    carrying.cannot = CarryError(CarryFailure.COLLIDES, "something stands in the way", -45.0)
    arm.watch()
    assert settle(arm.bar.offer.isVisible)
    arm.bar.stop.click()
    assert arm.bar.isHidden()
    assert window.workspace.next_step.isVisible()


def test_the_arm_is_not_offered_where_it_would_be_refused(window) -> None:
    page = window.feature(ExerciseFeature).beginning.page
    _, button = page.offers["arm"]
    page.show_exercise(load_exercise("laparoscopic-tool"), None)
    assert button.isHidden()
    page.show_exercise(load_exercise("first-insertion"), None)
    assert not button.isHidden()
    assert button.text() == "Watch the arm (W)"


# --- led ------------------------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_while_it_fetches_no_needle_is_shown_but_in_3d(planned, settle) -> None:
    window, arm = planned
    shapes = []
    window.workspace.scene.set_shape = lambda shape, often=False: shapes.append(shape)
    arm.watch()
    assert settle(lambda: arm.play is not None and arm.play.state is PlayState.FETCHING)
    assert settle(lambda: shapes)
    assert settle(lambda: window.workspace.viewing.needle is None)
    assert window.workspace.grid.maximised is window.workspace.scene
    assert not window.workspace.exercise_panel.buttons.start.isEnabled()
    assert not window.workspace.next_step.isVisible()
    assert arm.bar.isVisible()
    assert "Simulated arm" in arm.bar.words.text()


@pytest.mark.long("journey")
def test_its_attempt_is_the_arms_and_led_along_the_plan(planned, settle) -> None:
    window, arm, trainer = fetched(planned, settle)
    assert trainer.begun == ("", "arm")
    assert window.workspace.bullseye.hand is None  # the mouse moves nothing
    window.workspace.bullseye.pad.advanced.emit(0.02)
    assert settle(lambda: arm.play.state is PlayState.HOLDING)
    placed = window.conductor.controller.run.placed
    x, y, depth = trainer.hands[-1][:3]
    np.testing.assert_allclose((x, y), placed.axis[:2], atol=1e-9)
    assert depth == pytest.approx(placed.length)
    depths = np.array([pose[2] for pose in trainer.hands])
    assert (np.diff(depths) >= -1e-6).all()
    assert depths[0] < OUTSIDE


@pytest.mark.long("journey")
def test_a_pause_keeps_the_needle_where_it_is(planned, settle) -> None:
    _window, arm, trainer = fetched(planned, settle)
    assert settle(lambda: trainer.hands[-1][2] > 0.0)
    arm.bar.pause.click()
    depth = trainer.hands[-1][2]
    settle(timeout=0.3)
    assert trainer.hands[-1][2] == depth
    assert "‖" in arm.bar.words.text()
    arm.bar.pause.click()
    assert settle(lambda: trainer.hands[-1][2] > depth)


@pytest.mark.long("journey")
def test_nothing_goes_on_behind_a_question(planned, settle) -> None:
    window, arm, trainer = fetched(planned, settle)
    assert settle(lambda: trainer.hands[-1][2] > 0.0)
    question = QDialog(window)
    question.open()
    depth, t = trainer.hands[-1][2], arm.play.t
    settle(timeout=0.3)
    assert (trainer.hands[-1][2], arm.play.t) == (depth, t)
    question.reject()
    assert settle(lambda: trainer.hands[-1][2] > depth)


@pytest.mark.long("journey")
def test_a_step_goes_on_for_its_time_then_stands(planned, settle) -> None:
    _window, arm, _trainer = fetched(planned, settle)
    arm.play.pause()
    t = arm.play.t
    arm.bar.step.click()
    assert settle(lambda: not arm.play.playing)
    assert arm.play.t == pytest.approx(t + STEP_S)


@pytest.mark.long("journey")
def test_a_step_of_a_fast_insertion_is_as_long_as_it_is_watched(planned, settle) -> None:
    _window, arm, _trainer = fetched(planned, settle)
    arm.play.pause()
    t, arm.play._pace = arm.play.t, 0.25  # a deep path that is gone along slowly
    arm.bar.step.click()
    assert settle(lambda: not arm.play.playing)
    assert arm.play.t == pytest.approx(t + 0.25 * STEP_S)


@pytest.mark.long("journey")
def test_the_fetching_may_be_left_out(planned, settle) -> None:
    _window, arm = planned
    arm.watch()
    assert settle(lambda: arm.play is not None and arm.play.state is PlayState.FETCHING)
    arm.play.pause()
    arm.bar.skip.click()
    assert settle(lambda: arm.play.state is PlayState.INSERTING)


@pytest.mark.long("journey")
def test_taken_over_the_mouse_goes_on_from_exactly_there(planned, settle) -> None:
    window, arm, trainer = fetched(planned, settle)
    assert settle(lambda: trainer.hands[-1][2] > 0.003)
    arm.bar.take.click()
    before = trainer.hands[-1]
    assert trainer.taken_over == "mouse"
    settle(timeout=0.2)
    np.testing.assert_allclose(trainer.hands[-1][:3], before[:3], atol=1e-9)
    bullseye = window.workspace.bullseye
    np.testing.assert_allclose(bullseye.hand.depth, before[2], atol=1e-12)
    bullseye.pad.advanced.emit(0.002)
    assert settle(lambda: trainer.hands[-1][2] == pytest.approx(before[2] + 0.002))
    assert arm.bar.isHidden()
    assert window.workspace.rail.isVisible()  # it gives the orders in an attempt
    assert not arm._keys[-1].isEnabled()  # Esc is the attempt's own again
    trainer.state = State.ENDED
    window.conductor.controller.finished.emit(None)
    assert not arm.is_busy


@pytest.mark.long("journey")
@pytest.mark.parametrize(
    "at", [PlayState[name] for name in ("WAITING", "FETCHING", "INSERTING", "HOLDING")]
)
def test_it_is_stopped_at_any_time_and_all_is_as_before(planned, settle, at, carrying) -> None:
    window, arm = planned
    window.workspace.bullseye.source.set_source("tablet")
    if at is PlayState.WAITING:
        carrying.waits.clear()
    arm.watch()
    if at is PlayState.WAITING:
        assert settle(lambda: "50 %" in arm.bar.words.text())
    else:
        assert settle(lambda: arm.play is not None and arm.play.state is at)
    trainer = window.conductor.controller.run.trainer
    arm.bar.stop.click()
    assert settle(lambda: not arm.is_busy)
    carrying.waits.set()
    assert trainer.state is (
        State.READY if at in (PlayState.WAITING, PlayState.FETCHING) else State.ABORTED
    )
    assert arm.bar.isHidden()
    assert settle(window.workspace.next_step.isVisible)
    assert window.workspace.scene.is_home
    assert window.workspace.bullseye.source.name == "tablet"
    assert window.workspace.bullseye.source.source is not None  # it moves the hand again
    settle(timeout=0.1)
    assert window.workspace.bullseye.hand is not None
    trainer.state = State.READY
    assert not window.conductor.controller.is_absent


@pytest.mark.long("journey")
def test_started_twice_it_goes_on_with_the_first(planned, carrying, settle) -> None:
    _window, arm, _ = fetched(planned, settle)
    play = arm.play
    arm.watch()
    assert arm.play is play
    assert len(carrying.carried) == 1


@pytest.mark.long("journey")
def test_another_patient_ends_it(planned, patient, settle) -> None:
    window, arm, trainer = fetched(planned, settle)
    window.show_patient(patient)
    assert not arm.is_busy
    assert arm.bar.isHidden()
    assert settle(lambda: trainer.state is State.ABORTED)


@pytest.mark.long("journey")
def test_another_patient_while_it_works_out_its_way_ends_that(
    planned, carrying, patient, settle
) -> None:
    window, arm = planned
    carrying.waits.clear()
    arm.watch()
    window.show_patient(patient)
    carrying.waits.set()
    settle(timeout=0.2)
    assert not arm.is_busy
    assert arm.bar.isHidden()
    assert arm.said == []


@pytest.mark.long("journey")
def test_the_window_may_close_meanwhile(planned, settle) -> None:
    window, arm, _ = fetched(planned, settle)
    window.editor.saved(None)
    window.feature(ExerciseFeature).may_quit = lambda: True  # an attempt runs: it would ask
    window.close()
    assert not arm.is_busy


@pytest.mark.long("journey")
def test_a_plan_that_changed_meanwhile_is_not_the_one_to_show(planned, carrying, settle) -> None:
    from app.views.slices.viewing import Tool

    window, arm = planned
    carrying.waits.clear()
    arm.watch()
    window.editor.place(Tool.TARGET, (6.0, 6.0, 142.0), True)
    assert settle(lambda: not arm.is_busy)  # at once: nobody waits for a way that is not wanted
    assert "changed meanwhile" in window.message_bar.text
    assert arm.bar.isHidden()
    carrying.waits.set()
    settle(timeout=0.1)
    assert not arm.is_busy


@pytest.mark.long("journey")
def test_no_place_is_offered_for_a_plan_that_changed(planned, carrying, settle) -> None:
    from app.views.slices.viewing import Tool

    window, arm = planned
    carrying.cannot = CarryError(CarryFailure.UNREACHABLE, "it cannot reach the entry", 90.0)
    arm.watch()
    assert settle(arm.bar.offer.isVisible)
    window.editor.place(Tool.TARGET, (6.0, 6.0, 142.0), True)
    assert settle(arm.bar.isHidden)


@pytest.mark.long("journey")
@pytest.mark.promise("docs/arm.md: It is a simulation only and never drives a real arm")
def test_a_real_robot_is_left_alone_and_comes_back(planned, services, settle) -> None:
    window, arm = planned
    window.conductor.set_robot(RobotChoice(port="/dev/ttyACM0"))
    assert settle(lambda: services.opened[-1].setup.robot.port == "/dev/ttyACM0")
    assert settle(lambda: window.runs.run is not None)
    arm.watch()
    assert settle(lambda: arm.play is not None and arm.play.state is PlayState.FETCHING)
    assert services.opened[-1].setup.robot == RobotChoice()
    arm.bar.stop.click()
    assert settle(lambda: services.opened[-1].setup.robot.port == "/dev/ttyACM0")


@pytest.mark.long("journey")
def test_what_nobody_sees_does_not_happen(planned, settle) -> None:
    window, arm, _ = fetched(planned, settle)
    window.show_start()
    assert not arm.play.playing
    window.show_workspace()
    assert arm.play is not None


@pytest.mark.long("journey")
def test_the_same_plan_is_not_worked_out_twice(planned, carrying, settle) -> None:
    _window, arm, _ = fetched(planned, settle)
    arm.bar.stop.click()
    assert settle(lambda: not arm.is_busy)
    fetched(planned, settle)
    assert len(carrying.carried) == 1


@pytest.mark.long("journey")
def test_who_begins_by_himself_meanwhile_is_not_disturbed(planned, carrying, settle) -> None:
    window, arm = planned
    carrying.waits.clear()
    arm.watch()
    window.conductor.controller.intercepted = bool
    window.conductor.controller.begin("S1")
    carrying.waits.set()
    settle(timeout=0.2)
    assert window.conductor.controller.run.trainer.begun == ("S1", "mouse")
    assert not arm.is_busy
    assert arm.bar.isHidden()


@pytest.mark.long("journey")
def test_nothing_begins_while_the_needle_is_not_there(planned, settle) -> None:
    window, arm = planned
    arm.watch()
    assert settle(lambda: arm.play is not None and arm.play.state is PlayState.FETCHING)
    window.conductor.controller.set_waiting("")  # as another part might
    window.conductor.controller.begin("S1")
    assert window.conductor.controller.run.trainer.begun is None


@pytest.mark.long("journey")
def test_where_scans_guide_the_arm_takes_them_on_its_way(planned, settle) -> None:
    window, arm, trainer = fetched(planned, settle)
    scans = []
    trainer.scan = lambda *order: scans.append(order)
    trainer.end = lambda: None
    run = window.conductor.controller.run
    object.__setattr__(run, "shown", Shown(live=False))
    assert settle(lambda: arm.play.state is PlayState.HOLDING)
    trainer.state = State.HOLDING
    assert settle(lambda: len(scans) == 1)  # the fake needle never comes in: one at the target


# --- where its parts are --------------------------------------------------------------------------
@pytest.mark.long("journey")
def test_the_tool_is_drawn_along_the_path_through_the_trocar_at_the_entry(planned) -> None:
    window, _ = planned
    placed = window.editor.verdict.placed
    shape = arm_shape(performance_of(placed), 99.0, placed.T_world_patient.inverse())
    entry, target = placed.plan.entry_mm, placed.plan.target_mm
    np.testing.assert_allclose(shape.hoops[0].centre_mm, entry, atol=1e-6)
    tips = [piece.ends_mm[1] for piece in shape.pieces if piece.mark is ArmPart.TOOL.value]
    np.testing.assert_allclose(tips[-1], target, atol=1e-6)


# --- through the whole trainer --------------------------------------------------------------------
def played(window, settle):
    results = []
    window.conductor.controller.finished.connect(results.append)
    window.feature(ArmFeature).watch()
    assert settle(lambda: window.conductor.controller.is_running)
    return results


@pytest.mark.long("journey")
def test_it_plays_to_the_end_is_scored_and_counts_for_nobody(real, settle) -> None:
    real.editor.place(Tool.TARGET, (5.0, -5.0, 140.0), True)  # before the bone
    assert settle(lambda: real.runs.run is not None)
    results = played(real, settle)
    assert settle(lambda: results)
    (result,) = results
    assert result.state is State.ENDED
    rows = {row.name: row.value for row in result.score.rows}
    assert rows["holding_time"] >= STILL_S - 0.5 or result.score.void_reason
    if not result.score.void_reason:  # a busy machine loses the cameras' pictures
        assert abs(rows["depth_error"]) < 2.7
        assert rows["lateral_error"] < 2.7
    folder = real.services.folder
    (path,) = [folder / name for name in records(folder)]
    shown = review(open_recording(path))
    assert shown.conditions.hand == "arm"
    assert not shown.conditions.by_person
    assert json.loads(sidecar(path).read_text())["conditions"]["hand"] == "arm"
    index = Index(folder)
    index.refresh()
    (one,) = index.attempts()
    assert not one.counts
    assert totals_of(folder, "S1", one.exercise, one.version) == []
    item = CourseItem(exercise=one.exercise, version=one.version)
    assert attempts_used([one], item) == []
    student = Person("S1", "Ada", ())
    whole = progress_board([student], [item], [one], {}, datetime.now(UTC))
    cell = whole.cells["S1", one.exercise]
    assert (cell.attempts, cell.best, dict(cell.why)) == (0, None, {"carried out by the arm": 1})
    assert whole.curve("S1", one.exercise) == []
    (row,) = csv.DictReader(io.StringIO(score_table([fresh_summary(path)])))
    assert row["hand"] == "arm"
    assert row["taken_over"] == ""
    debrief = real.feature(DebriefFeature)
    assert settle(lambda: debrief.page.review is not None)
    assert "not by a student" in debrief.page.whose.text()
    assert settle(lambda: "Now you" in debrief.page.proposal.text())
    assert "no student's" in short_words(shown.conditions)
    assert not real.feature(ArmFeature).is_busy


@pytest.mark.long("journey")
def test_taken_over_there_is_no_jump_and_the_record_says_so(real, settle) -> None:
    results = played(real, settle)
    arm, controller = real.feature(ArmFeature), real.conductor.controller
    trainer, hands = controller.run.trainer, []
    pass_on = trainer.hand
    trainer.hand = lambda *pose: hands.append(pose[:3]) or pass_on(*pose)
    assert settle(lambda: hands and hands[-1][2] > 0.008)
    arm.bar.take.click()
    count = len(hands)
    settle(timeout=0.3)
    assert len(hands) > count  # the mouse's hand leads now
    jump = np.abs(np.diff(hands[count - 1 :], axis=0)).max()
    assert jump < 1e-9
    bullseye = real.workspace.bullseye
    depth = bullseye.hand.depth
    bullseye.pad.advanced.emit(0.001)
    assert settle(lambda: hands[-1][2] == pytest.approx(depth + 0.001))
    controller.end()
    assert settle(lambda: results)
    folder = real.services.folder
    (path,) = [folder / name for name in records(folder)]
    recording = open_recording(path)
    (event,) = [one for one in recording.events if one.kind == "taken_over"]
    assert event.data["hand"] == "mouse"
    assert "taken over by mouse" in event.message
    shown = review(recording)
    assert (shown.conditions.hand, shown.conditions.taken_over) == ("arm", "mouse")
    assert not shown.conditions.by_person
    assert "taken over by mouse" in whose_words(shown.conditions)
    assert not arm.is_busy


@pytest.mark.long("journey")
def test_stopped_in_the_body_the_attempt_is_kept_as_broken_off_and_no_debrief_opens(
    real, settle
) -> None:
    results = played(real, settle)
    arm = real.feature(ArmFeature)
    assert settle(lambda: arm.play.t > arm.play.duration - 1.0)
    arm.bar.stop.click()
    assert settle(lambda: not arm.is_busy)
    settle(timeout=0.3)
    assert results == []
    assert real.context.shell.is_working
    folder = real.services.folder
    (path,) = [folder / name for name in records(folder)]
    shown = review(open_recording(path))
    assert shown.state == State.ABORTED
    assert shown.conditions.hand == "arm"


@pytest.mark.long("journey")
def test_the_arm_of_the_scene_does_it_to_the_end(real, settle, carrying, monkeypatch) -> None:
    for package in ("mujoco", "ompl", "ruckig"):
        pytest.importorskip(package, reason="needs the extra arm: make extra NAME=arm")
    monkeypatch.setattr(ArmFeature, "carry_out", staticmethod(carrying.really))
    arm, said, results = real.feature(ArmFeature), [], []
    arm.failed.connect(said.append)
    real.conductor.controller.finished.connect(results.append)
    arm.watch()
    assert settle(lambda: said or arm.play is not None, timeout=300.0)
    assert said == []
    assert settle(lambda: arm.play.state is PlayState.FETCHING)
    arm.bar.skip.click()
    assert settle(lambda: bool(results), timeout=120.0)
    assert results[0].state is State.ENDED
    rows = {row.name: row.value for row in results[0].score.rows}
    assert rows["lateral_error"] is None or rows["lateral_error"] < 2.7


# --- whose attempt it is ------------------------------------------------------------------------
def test_an_attempt_of_the_arm_meets_none_of_a_student() -> None:
    own = Conditions("one", 1, scoring_version=1, hand="mouse")
    arms = Conditions("one", 1, scoring_version=1, hand="arm")
    over = Conditions("one", 1, scoring_version=1, hand="arm", taken_over="mouse")
    assert own.by_person
    assert not arms.by_person
    assert not over.by_person
    assert comparable(own, arms)
    assert comparable(arms, over)
    assert comparable(own, over)
    assert Conditions.of(over.document()) == over
