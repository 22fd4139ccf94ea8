"""The two scripts at the window: what they see of the breath, when, and when they act."""

from dataclasses import fields, replace

import numpy as np
import pytest
from virtual_student import Student

from app.compose.pointer_hands import (
    LATE,
    LOOK,
    PAD_PX,
    STROKE_MM,
    Desk,
    Eyes,
    Sight,
    careful_hand,
)
from app.core import state_vector as sv
from app.core.units import MILLIMETRE
from app.exercises.parts import ViewName
from app.planning.off_path import offset
from app.session.needle import DepthSource
from app.session.pad.geometry import path_frame
from app.session.pad.hand import HandPose
from app.session.pad.readings import needle_line
from app.session.pad.view import NeedleLine, PadScene
from app.session.shown_views import Shown
from app.session.snapshot import NextSteps, Snapshot, StepKind, excursion

GATE = 2e-3
"""Half width of the breath strip's band [m]."""


@pytest.fixture
def student(tmp_path):
    made = Student(tmp_path)
    yield made
    made.close()


def scene_of(student: Student) -> PadScene:
    return PadScene.of(student.trainer._placed, student.rig.profile, (2e-3, 5e-3), 2e-3)


def eyes_of(student: Student, shown: Shown | None = None) -> Eyes:
    placed = student.trainer._placed
    steps = NextSteps(placed, 2e-3, 2e-3)
    return Eyes(shown or Shown(), placed, scene_of(student), steps, GATE)


def test_the_breath_is_seen_as_the_strip_shows_it(student: Student) -> None:
    eyes = eyes_of(student)
    student.trainer.begin()
    for _ in range(60):
        snapshot = student.trainer.step(20)
    sight = eyes.read(snapshot)
    assert sight is not None
    assert sight.rests, "nothing breathes here"
    row = snapshot.device.row.copy()
    row[[sv.BREATH_X, sv.BREATH_Y, sv.BREATH_Z]] = [0.0, 3e-3, 4e-3]
    away = replace(snapshot, device=replace(snapshot.device, row=row))
    assert excursion(away) == pytest.approx(5e-3)
    assert not eyes.read(away).rests
    row[[sv.BREATH_X, sv.BREATH_Y, sv.BREATH_Z]] = [0.0, 0.3 * GATE, 0.4 * GATE]
    assert eyes.read(replace(snapshot, device=replace(snapshot.device, row=row))).rests


def sight(time: float, remaining: float, rests: bool) -> Sight:
    return Sight(time, np.zeros(2), remaining, StepKind.LOOK, rests)


def test_what_is_on_the_screen_now_is_seen_a_fifth_of_a_second_later(student: Student) -> None:
    hand = scene_of(student).hand(HandPose(student.trainer._placed.axis, 0.0, True))
    desk = Desk(hand, 0.3, None)
    for number in range(40):
        desk.show(sight(0.02 * number, 100.0 - number, True))
        if number >= 10:
            assert desk.seen.remaining == pytest.approx(100.0 - (number - 10))


def bent_beside_a_moved_target(student: Student) -> tuple[Snapshot, NeedleLine]:
    """A needle in the body, its tip bent off its line, the target moved by the breath."""
    student.trainer.begin()
    for _ in range(60):
        snapshot = student.trainer.step(20)
    placed = student.trainer._placed
    frame = path_frame(placed.axis, placed.T_world_patient.rotation)
    axis = placed.axis + 0.05 * frame.right - 0.03 * frame.up
    axis /= np.linalg.norm(axis)
    tip = placed.p_entry + 0.04 * axis + 3e-3 * frame.up
    pose = replace(snapshot.pose, p_tip=tip, axis=axis, depth=0.04, valid=True,
                   depth_source=DepthSource.TRACKED)  # fmt: skip
    target = placed.p_target + np.array([2e-3, 1e-3, -4e-3])
    away = offset(tip, axis, placed, target)
    moved = replace(snapshot, pose=pose, p_target=target, offset=away)
    view = needle_line(moved)
    assert view is not None
    return moved, view


def test_they_see_the_dot_that_the_pad_draws_and_nothing_else_of_the_needle(
    student: Student,
) -> None:
    moved, view = bent_beside_a_moved_target(student)
    scene = scene_of(student)
    sight = eyes_of(student).read(moved)
    assert sight is not None
    assert sight.dot == pytest.approx(view.dot(scene), abs=0.5 / PAD_PX + 1e-12)
    frame, across = view.frame(scene), view.offset.across
    beside = np.array([across @ frame.right, across @ frame.up]) / scene.scale.length
    tip = scene.scale.place(beside)
    assert np.hypot(*(tip - sight.dot)) > 5.0 / PAD_PX, "the tip is elsewhere, and not seen"
    assert {one.name for one in fields(Sight)} == {"time", "dot", "remaining", "order", "rests"}
    assert sight.remaining == pytest.approx(view.offset.remaining / MILLIMETRE, abs=0.05)


def test_a_way_left_that_nobody_measures_is_no_figure(student: Student) -> None:
    moved, _ = bent_beside_a_moved_target(student)
    guessed = replace(moved, pose=replace(moved.pose, depth_source=DepthSource.MODEL))
    assert eyes_of(student).read(guessed) is None
    eyes = eyes_of(student)
    before = eyes.read(moved)
    further = replace(guessed, offset=replace(guessed.offset, remaining=0.0))
    assert eyes.read(further).remaining == before.remaining, "the last figure is remembered"


def test_without_a_pad_they_read_dot_and_way_off_the_slices_by_pixels(student: Student) -> None:
    moved, view = bent_beside_a_moved_target(student)
    scene = scene_of(student)
    views = frozenset({ViewName.LIVE_OVERLAY, ViewName.TARGET_MOTION})
    sight = eyes_of(student, Shown(views=views, orders=False)).read(moved)
    assert sight is not None
    assert sight.order is StepKind.LOOK
    assert sight.remaining == round(view.offset.remaining / MILLIMETRE)
    pixels = scene.scale.tilts(sight.dot) * scene.scale.length / MILLIMETRE
    assert pixels == pytest.approx(np.round(pixels), abs=1e-6)
    seen = scene.scale.tilts(view.dot(scene)) * scene.scale.length / MILLIMETRE
    assert pixels == pytest.approx(seen, abs=0.5 + 1e-6)
    assert eyes_of(student, Shown(views=frozenset())).read(moved) is None


def test_the_careful_hand_pushes_only_while_the_strip_is_in_its_band(student: Student) -> None:
    """A needle that follows at once, a breath of 4 s that rests for 1.7 s, the screen seen late."""
    placed = student.trainer._placed
    hand = scene_of(student).hand(HandPose(placed.axis, 0.0, True))
    desk, pushed, last = Desk(hand, 0.3, None), [], 0.0
    moves = careful_hand(desk)

    def rests(time: float) -> bool:
        return time % 4.0 < 1.7

    time, target = 0.0, 40.0
    while time < 200.0:
        desk.show(sight(time, target - hand.pose.depth / MILLIMETRE, rests(time)))
        if next(moves, "over") == "over":
            break
        if hand.pose.depth != last:
            pushed.append((time, hand.pose.depth - last))
            last = hand.pose.depth
        time += LOOK
    assert abs(target - hand.pose.depth / MILLIMETRE) < 0.6, "it came to the target"
    outside = [when for when, _ in pushed if not rests(when) and not rests(when - LATE - 2 * LOOK)]
    assert outside == [], "later than it could have seen that the breath went on"
    assert rests(time - LATE), "and it ended the attempt while the breath rested"
    strokes = np.diff([when for when, _ in pushed]) > 0.3
    assert 40.0 / (strokes.sum() + 1) <= STROKE_MM
