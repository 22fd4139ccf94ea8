"""The two scripts at the window: what they see of the breath, when, and when they act."""

from dataclasses import replace

import numpy as np
import pytest
from virtual_student import Student

from app.compose.pointer_hands import LATE, LOOK, STROKE_MM, Desk, Eyes, Sight, careful_hand
from app.core import state_vector as sv
from app.core.units import MILLIMETRE
from app.session.pad.geometry import PadScale, path_frame
from app.session.pad.hand import HandLimits, HandPose, PadHand
from app.session.shown_views import Shown
from app.session.snapshot import NextSteps, StepKind, excursion

GATE = 2e-3
"""Half width of the breath strip's band [m]."""


@pytest.fixture
def student(tmp_path):
    made = Student(tmp_path)
    yield made
    made.close()


def eyes_of(student: Student) -> tuple[Eyes, PadScale]:
    placed = student.trainer._placed
    frame = path_frame(placed.axis, placed.T_world_patient.rotation)
    scale = PadScale(placed.length, 2e-3)
    steps = NextSteps(placed, 2e-3, 2e-3)
    return Eyes(Shown(), placed, frame, scale, steps, GATE), scale


def test_the_breath_is_seen_as_the_strip_shows_it(student: Student) -> None:
    eyes, _ = eyes_of(student)
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
    return Sight(time, np.zeros(2), np.zeros(2), remaining, StepKind.LOOK, rests)


def test_the_careful_hand_pushes_only_while_the_strip_is_in_its_band(student: Student) -> None:
    """A needle that follows at once, a breath of 4 s that rests for 1.7 s, the screen seen late."""
    _, scale = eyes_of(student)
    placed = student.trainer._placed
    frame = path_frame(placed.axis, placed.T_world_patient.rotation)
    hand = PadHand(frame, scale, HandLimits(0.6, -0.05, 0.15), HandPose(placed.axis, 0.0, True))
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
