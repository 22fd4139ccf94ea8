"""Targets that a long tool touches, as the widgets show them; and the hand at its handle."""

from dataclasses import replace
from time import monotonic
from types import SimpleNamespace

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QVBoxLayout, QWidget
from views_exercise_attempts import review
from views_exercise_fakes import FakeTrainer, pose, snapshot

from app.core.events import Event
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.session.curves import offset
from app.session.machine import State
from app.session.pad.hand import HandPose
from app.session.pad.readings import needle_line
from app.session.pad.view import depth_tolerance_of, rings_of
from app.session.snapshot import NextStep, StepKind
from app.session.touching import TargetMarks, TouchState
from app.views.debrief.curves import curves_of
from app.views.exercise.briefing import BriefingPage, aid_words, scored_words
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.controller import ExerciseDisplay
from app.views.exercise.depth_bar import DepthBar
from app.views.exercise.hands.chooser import HandChooser
from app.views.exercise.offer import BriefingOffer
from app.views.exercise.pad_canvas import PadCanvas
from app.views.exercise.panel import TouchNote, hand_words
from app.views.exercise.run import ExerciseRun
from app.views.exercise.steps import PADDING, NextStepLine, touch_words
from app.views.kit import theme
from app.views.kit.roles import Role
from app.views.kit.theme import LARGE
from app.views.reading.workspace import SIDE_WIDTH
from app.views.sounds.feature import _OF_EVENTS, CueKind, Cues

EXERCISE = load_exercise("laparoscopic-tool")
PROFILE = device_of(EXERCISE)
PLACED = placed_plan_of(EXERCISE, PROFILE)
TASK = EXERCISE.touch_task(PLACED)


def moment(touched=0, tip=None, **changes):
    """A snapshot with so many targets touched, the tip at a place in the world [m]."""
    touch = TouchState(TASK, touched)
    tip = TASK.p_targets[0] + [0.01, 0.0, 0.0] if tip is None else tip
    way = tip - PLACED.p_entry
    depth = float(np.linalg.norm(way))
    where = pose(PLACED, depth=depth, axis=way / depth, p_tip=tip)
    return snapshot(PLACED, pose=where, state=State.INSERTING, touch=touch,
                    p_target=touch.aim.p_target,
                    offset=offset(where, touch.aim.p_target, touch.aim), **changes)  # fmt: skip


def the_run(trainer=None):
    return ExerciseRun(
        trainer or FakeTrainer(PLACED), PLACED, PROFILE, touches=True,
        rings=rings_of(EXERCISE), depth_tolerance=depth_tolerance_of(EXERCISE),
    )  # fmt: skip


def test_the_panel_counts_and_says_how_the_hand_moves_the_tip(qt):
    note = TouchNote()
    note.show_touch(moment(2), PROFILE.needle_length)
    assert note.text().startswith("2 of 6 touched  ·  ")
    assert "mm to target 3" in note.text()
    assert "1 mm of hand moves the tip 0.2 mm, the other way" in note.text()
    unmeasured = moment(2)
    lost = replace(unmeasured.pose, valid=False)
    note.show_touch(replace(unmeasured, pose=lost), PROFILE.needle_length)
    assert note.text() == "2 of 6 touched"
    note.show_touch(replace(unmeasured, touch=None), PROFILE.needle_length)
    assert note.isHidden()
    assert "not through the trocar" in hand_words(0.05)


def test_the_line_says_where_the_tip_goes_and_the_hand_the_other_way(qt):
    touch = TouchState(TASK, 2)
    far = NextStep(StepKind.TOUCH, towards="LS", distance=-0.006, across=0.012, touch=touch)
    assert touch_words(far, touch) == (
        "Target 3 of 6: tip 12 mm towards the patient's left and the head (hand the other way), "
        "pull 6 mm"
    )
    deep = NextStep(StepKind.TOUCH, distance=0.02, touch=touch)
    assert touch_words(deep, touch) == "Target 3 of 6: push 20 mm"
    assert touch_words(NextStep(StepKind.STAY, touch=touch), touch) == "Stay on target 3 of 6"
    done = TouchState(TASK, 6)
    assert "press Enter" in touch_words(NextStep(StepKind.FINISH, touch=done), done)


def settle(qt, there):
    """Let the window go on until something is there."""
    end = monotonic() + 5.0
    while not there():
        assert monotonic() < end
        qt.processEvents()


def test_the_first_word_of_a_run_is_said_at_once_whatever_was_set_before(qt):
    line = NextStepLine()
    line.begin(the_run())
    line.set_moves_hub(True)
    line.show_snapshot(moment(0))
    assert "Target 1 of 6" in line.text()
    line.begin(the_run())  # another run at once
    line.show_snapshot(moment(0))
    assert "Target 1 of 6" in line.text()


@pytest.mark.long("journey")
def test_a_touch_is_told_in_another_colour_and_then_what_comes(qt):
    line = NextStepLine()
    line.begin(the_run())
    line.show_snapshot(moment(0))
    settle(qt, lambda: "Target 1 of 6" in line.text())
    before = line.styleSheet()
    line.show_snapshot(moment(1))
    settle(qt, lambda: line.text() == "✔ Target 1 of 6 touched")
    assert line.styleSheet() != before
    settle(qt, lambda: "Target 2 of 6" in line.text())
    assert line.styleSheet() == before


def test_the_bullseye_has_the_present_target_in_its_middle_and_the_hand_goes_on(qt):
    run, widget = the_run(), Bullseye()
    now = moment(0)
    widget.set_scene(run.scene(), interactive=True)
    widget.retarget(run.scene(now.touch.aim))
    widget.take_hand(HandPose(now.pose.axis, now.pose.depth, True))
    hand = widget.hand
    later = moment(1, tip=TASK.p_targets[1])
    scene = run.scene(later.touch.aim)
    widget.retarget(scene)
    view = needle_line(later)
    widget.show_view(view)
    assert view.frame(scene) is scene.frame
    np.testing.assert_allclose(view.dot(scene), 0.0, atol=1e-9)
    np.testing.assert_allclose(widget.hand.direction, hand.direction, atol=1e-12)
    assert scene.target_depth == pytest.approx(TASK.plans[1].length)
    assert scene.rings == (0.004, 0.012)


def test_the_narrow_depth_bar_names_the_depth_of_the_present_target(qt):
    run, bar = the_run(), DepthBar()
    bar.set_scene(run.scene(TASK.plans[0]))
    bar.set_narrow(True)
    scene = run.scene(TASK.plans[1])
    bar.retarget(scene)
    assert f"Target {1e3 * scene.target_depth:.0f} " in bar.toolTip()


def test_the_mouse_moves_the_handle_and_the_tip_goes_the_other_way(qt):
    run, widget = the_run(), Bullseye()
    scene = run.scene(TASK.plans[0])
    widget.set_scene(scene, interactive=True)
    widget.source.fix_sense(True, "because")
    axis = TASK.plans[0].axis
    widget.take_hand(HandPose(axis, 0.05, True))
    widget.show_view(needle_line(moment(0)))
    widget.pad.dragged.emit(0.5, 0.0)  # to the right, half the pad's radius, at a gain of 1
    turn = widget.hand.direction - axis
    assert turn @ scene.frame.right < 0.0
    assert np.linalg.norm(turn) == pytest.approx(0.5 * 0.12 / 0.25, rel=0.05)
    assert widget.hand.depth == 0.05
    widget.pad.tilted.emit(0.0, 0.01)
    assert (widget.hand.direction - axis) @ scene.frame.up < 0.0


def test_the_exercise_keeps_the_sense_and_gives_it_back(qt):
    chooser = HandChooser(PadCanvas())
    chooser.set_interactive(True)
    chooser.set_moves_hub(False)
    chooser.fix_sense(True, "the handle")
    chooser.fix_sense(True, "the handle")
    assert chooser.moves_hub
    assert chooser.source.sense == -1.0
    assert chooser.sense.isHidden()
    assert "handle" in chooser.words
    chooser.release_sense()
    chooser.release_sense()
    assert not chooser.moves_hub
    assert chooser.source.sense == 1.0
    assert "handle" not in chooser.words


def test_on_the_way_to_targets_only_a_touch_is_heard():
    cues = Cues(0.07, 0.012, 0.004, 0.004)
    found = [cue.kind for k in range(6) for cue in cues.of(moment(k), TASK.p_targets[k])]
    assert found == []
    assert _OF_EVENTS["touch"] is CueKind.TOUCHED
    assert "touch_task" not in _OF_EVENTS


def test_the_briefing_says_what_is_steered_and_what_counts(qt):
    assert any("the tip goes the other way" in line for line in aid_words(EXERCISE, Role.STUDENT))
    said = "\n".join(scored_words(EXERCISE))
    assert "Targets touched" in said
    assert "Time per target" in said
    assert "Economy of motion" in said


def test_marks_are_alike_only_with_the_same_points_and_touches():
    marks = TouchState(TASK, 2).marks
    assert marks.same(TouchState(TASK, 2).marks)
    assert not marks.same(TouchState(TASK, 3).marks)
    assert not marks.same(None)
    assert not marks.same(TargetMarks(marks.points_mm + 1.0, 2))
    assert (marks.present, TouchState(TASK, 6).marks.present) == (3, 6)


@pytest.mark.parametrize("size", [1.0, LARGE])
def test_the_whole_line_can_be_read_on_a_small_screen_and_keeps_its_height(qt, size):
    theme.apply_theme(qt, size=size)
    try:
        line = NextStepLine()
        line.begin(the_run())
        page = QWidget()
        column = QVBoxLayout(page)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(line)
        column.addWidget(QWidget(), 1)
        page.resize(1366 - round(size * SIDE_WIDTH), 300)
        page.show()
        qt.processEvents()
        height = line.height()
        # Aside by both of two ways, and beyond it: the longest order.
        tip = TASK.p_targets[0] + [0.008, 0.009, -0.012]
        line.show_snapshot(moment(0, tip=tip))
        settle(qt, lambda: " and " in line.text() and "pull" in line.text())
        qt.processEvents()
        room = line.width() - 2 * PADDING
        assert line.fontMetrics().horizontalAdvance(line.text()) <= room
        assert line.height() == height
        page.close()
    finally:
        theme.apply_theme(qt)


def test_the_steps_of_one_insertion_are_not_told_where_many_targets_are_touched(qt):
    class Panel:
        """Keeps what it is told."""

        def __init__(self):
            self.is_brief = None
            breath = SimpleNamespace(begin=lambda gate, breathes: None)
            self.rail = SimpleNamespace(breath=breath)

        def set_brief(self, brief):
            self.is_brief = brief

        def set_guidance(self, guidance, plan):
            pass

        def set_forceful(self, forceful):
            pass

        set_offsets = set_forceful

    views = SimpleNamespace(bullseye=Bullseye(), panel=Panel())
    ExerciseDisplay(views).show_run(the_run())
    assert views.panel.is_brief
    ExerciseDisplay(views).show_run(replace(the_run(), touches=False))
    assert not views.panel.is_brief


def test_no_curve_claims_one_target_where_many_are_touched(qt):
    assert curves_of(review())[0].line is not None
    touched = Event(0.0, "touched", {"target": 1})
    depth = curves_of(review(touches=(touched,)))[0]
    assert depth.line is None
    assert not depth.line_name


def test_a_way_to_watch_is_offered_where_it_suits_and_pressed_by_its_key(qt):
    page, wanted = BriefingPage(), []
    offer = BriefingOffer("x", "Watch (W)", "", Qt.Key.Key_W, lambda one: one.touch is None, bool)
    page.offer_wanted.connect(wanted.append)
    page.add_offer(offer)
    _, shown = page.offers["x"]
    page.show_exercise(EXERCISE, None)
    assert shown.isHidden()
    page.show_exercise(load_exercise("first-insertion"), None)
    assert not shown.isHidden()
    page.show()
    QTest.keyClick(page, Qt.Key.Key_W)
    page.close()
    assert wanted == [offer]
