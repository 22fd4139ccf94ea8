"""The dot and the order: whatever the needle does, they never speak against each other."""

from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from views_exercise_fakes import FakeTrainer, run, snapshot

from app.planning.off_path import offset
from app.session.machine import State
from app.session.pad.readings import needle_line
from app.session.pad.view import NeedleLine
from app.session.snapshot import NextSteps, StepKind
from app.views.exercise.bullseye import Bullseye, figure_of
from app.views.exercise.steps import OTHER_SIDE

SIDES = {"L": (1, 0, 0), "R": (-1, 0, 0), "P": (0, 1, 0), "A": (0, -1, 0), "S": (0, 0, 1),
         "I": (0, 0, -1)}  # fmt: skip
"""Of LPS, as DICOM has them (PS3.3 C.7.6.2.1.1)."""

SMALL = st.floats(-0.012, 0.012)


def moment(plan, depth, tilt, bend=(0.0, 0.0), breath=(0.0, 0.0, 0.0), measured=True, sigma=0.0):
    """A needle through the entry, its tip bent aside, the target moved by the breath."""
    frame = run(FakeTrainer()).scene().frame
    axis = plan.axis + tilt[0] * frame.right + tilt[1] * frame.up
    axis = axis / np.linalg.norm(axis)
    aside = bend[0] * frame.right + bend[1] * frame.up
    tip = plan.p_entry + depth * axis + (aside if depth > 0.0 else 0.0)
    target = plan.p_target + np.asarray(breath)
    pose = SimpleNamespace(axis=axis, depth=depth, measured=measured, valid=True, p_tip=tip,
                           covariance=sigma**2 * np.eye(3))  # fmt: skip
    return SimpleNamespace(state=State.INSERTING, pose=pose, touch=None, procedure=None,
                           device=None, pause=None, out_of_room=None, p_target=target,
                           offset=offset(tip, axis, plan, target))  # fmt: skip


def view_of(now):
    return NeedleLine(now.pose.axis, now.offset, now.pose.depth, now.pose.measured)


@settings(max_examples=300, deadline=None)
@given(
    depth=st.floats(-0.03, 0.1),
    tilt=st.tuples(st.floats(-0.5, 0.5), st.floats(-0.5, 0.5)),
    bend=st.tuples(SMALL, SMALL),
    breath=st.tuples(SMALL, SMALL, SMALL),
    measured=st.booleans(),
    hub=st.booleans(),
)
def test_who_follows_the_order_brings_the_dot_nearer_to_the_middle(
    depth, tilt, bend, breath, measured, hub
):
    scene = run(FakeTrainer()).scene()
    plan = run(FakeTrainer()).placed
    now = moment(plan, depth, tilt, bend, breath, measured)
    step = NextSteps(plan, 0.002, 0.5).of(now)
    if step.kind is not StepKind.TILT:
        return
    letters = step.towards if hub else step.towards.translate(OTHER_SIDE)
    way = sum(np.array(SIDES[letter], float) for letter in letters)
    view = view_of(now)
    frame = view.frame(scene)
    world = plan.T_world_patient.rotation @ way
    ordered = np.array([world @ frame.right, world @ frame.up])
    dot = view.dot(scene, hub)
    assert float(ordered @ dot) < 0.0  # towards the middle, whichever end is moved
    assert step.across == pytest.approx(float(np.linalg.norm(view.miss(scene))), rel=1e-9)


@given(depth=st.floats(-0.03, 0.09), tilt=st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3)))
@settings(max_examples=100, deadline=None)
def test_the_dot_of_a_straight_needle_is_where_its_line_meets_the_plane_of_the_target(depth, tilt):
    """By plain geometry of a line and a plane; to first order, as the pad's own angles are."""
    scene, plan = run(FakeTrainer()).scene(), run(FakeTrainer()).placed
    now = moment(plan, depth, tilt)
    axis = now.pose.axis
    way = (plan.p_target - plan.p_entry) @ plan.axis / (axis @ plan.axis)
    met = plan.p_entry + way * axis - plan.p_target
    miss = view_of(now).miss(scene)
    np.testing.assert_allclose(miss, met, atol=0.07 * np.linalg.norm(met) + 1e-12)


def test_before_the_skin_the_dot_is_not_where_the_tip_is():
    scene, plan = run(FakeTrainer()).scene(), run(FakeTrainer()).placed
    now = moment(plan, -0.02, (0.1, 0.0))
    assert now.offset.across @ scene.frame.right < 0.0
    assert view_of(now).dot(scene)[0] > 0.0
    assert view_of(now).dot(scene, hub=True)[0] < 0.0


def test_an_order_does_not_flicker_in_the_noise_of_what_is_measured():
    plan, rng, sigma = run(FakeTrainer()).placed, np.random.default_rng(5), 0.7e-3
    for away in np.linspace(0.0, 5e-3, 26):
        steps, kinds = NextSteps(plan, 0.6e-3, 1.0), []
        for noise in sigma * rng.standard_normal((200, 2)):
            tilt = (away / plan.length + noise[0] / plan.length, noise[1] / plan.length)
            kinds.append(steps.of(moment(plan, 0.5 * plan.length, tilt, sigma=sigma)).kind)
        changes = sum(one is not other for one, other in pairwise(kinds))
        assert changes <= 30, away  # of 200 noisy pictures; was 46


def test_nothing_below_the_measuring_error_is_ordered():
    plan = run(FakeTrainer()).placed
    steps = NextSteps(plan, 0.3e-3, 0.3e-3)
    deep = moment(plan, plan.length + 0.4e-3, (0.0, 0.0), sigma=0.5e-3)
    assert steps.of(deep).kind is StepKind.HOLD
    exact = moment(plan, plan.length + 0.4e-3, (0.0, 0.0))
    assert NextSteps(plan, 0.3e-3, 0.3e-3).of(exact).kind is StepKind.BACK


def test_where_the_attempt_holds_nothing_within_the_tolerance_is_ordered():
    plan = run(FakeTrainer()).placed
    steps = NextSteps(plan, 1e-3, 0.5e-3)
    assert steps.of(moment(plan, plan.length + 0.6e-3, (0.0, 0.0))).kind is StepKind.BACK
    there = moment(plan, plan.length + 0.4e-3, (0.0, 0.0))
    there.state = State.HOLDING
    assert steps.of(there).kind is StepKind.FINISH
    assert figure_of(steps.of(there)) == "✔ hold"


@pytest.fixture
def pad(qt):
    widget = Bullseye()
    widget.resize(300, 430)
    widget.set_scene(run(FakeTrainer()).scene(), interactive=True)
    widget.show_view(needle_line(snapshot()))
    widget.show()
    qt.processEvents()
    yield widget
    widget.close()
    widget.deleteLater()


@pytest.mark.parametrize("hub", [False, True])
@pytest.mark.parametrize("way", [(14, 0), (-9, 11), (0, -13)])
def test_a_needle_that_follows_the_hand_takes_the_dot_as_far_as_the_pointer_goes(pad, way, hub):
    pad.source.set_moves_hub(hub)
    scene, area = pad._scene, pad.pad.area
    start = pad.pad.rect().center()
    view = pad._view
    before = area.point(view.dot(scene, hub))
    QTest.mousePress(pad.pad, Qt.MouseButton.LeftButton, pos=start)
    QTest.mouseMove(pad.pad, start + QPoint(*way))
    axis = pad.hand.direction
    away = replace(view.offset, across=view.depth * (axis - (axis @ view.offset.path)
                   * view.offset.path))  # fmt: skip
    after = area.point(replace(view, direction=axis, offset=away).dot(scene, hub))
    assert (after.x() - before.x(), after.y() - before.y()) == pytest.approx(way, abs=0.5)


def test_in_an_attempt_the_bullseye_says_one_figure_and_no_other_word(pad, qt):
    pad.set_plain(True)
    pad.show_step(SimpleNamespace(kind=StepKind.TILT, across=0.0042, distance=0.0))
    qt.processEvents()
    assert pad._figure.text() == "4 mm off"
    assert pad._figure.isVisible()
    assert not any(label.isVisible() for label in (*pad._words, pad._marks, pad.source))
    before = pad._remaining.text()
    pad.show_view(replace(pad._view, measured=False))
    assert pad._remaining.text() == before, "nobody sees it: nothing is written"
    pad.set_plain(False)
    assert not pad._figure.isVisible()
    assert pad._remaining.isVisible()
    assert pad._remaining.text() == "–" != before


def test_in_a_narrow_pane_the_depth_bar_covers_no_letter_of_the_pad(pad, qt):
    pad.set_plain(True)
    pad.resize(166, 380)
    qt.processEvents()
    assert pad.pad.geometry().right() < pad.depth_bar.geometry().left()
    assert pad.pad.width() >= 65
