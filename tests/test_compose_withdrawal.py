"""An attempt begins with the tip outside the skin, whatever the student does before."""

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from virtual_student import Student

from app.core import state_vector as sv
from app.mechanisms.hand_motion import FASTEST_ALONG
from app.session.errors import IllegalTransitionError
from app.session.machine import State
from app.session.recording import read_recording

TARGET = 0.065


@pytest.fixture
def student(tmp_path: Path):
    made = Student(tmp_path)
    yield made
    made.close()


def depth(student: Student) -> float:
    return float(student.rig.loop.latest().row[sv.PLANT_DEPTH])


def insert(student: Student) -> None:
    """Align with the path, insert to the target, hold."""
    path = student.trainer._placed.axis
    student.hand.follow(path, -0.015)
    student.pause(1500)
    student.hand.follow(path, student.trainer._placed.length)
    student.pause(3000)


def wait_until_begun(student: Student) -> list[float]:
    """Let time pass until the attempt counts; the depths on the way."""
    depths = []
    for _ in range(600):
        depths.append(depth(student))
        if student.trainer.snapshot().state is not State.WITHDRAWING:
            return depths
        student.trainer.step(20)
    raise AssertionError("the needle never came out")


@pytest.mark.long("machine")
def test_an_attempt_after_one_that_ended_at_the_target_begins_outside(student: Student) -> None:
    student.trainer.begin()
    insert(student)
    first = student.trainer.end()
    assert first.score.total is not None
    assert depth(student) > 0.05, "the needle stays where the attempt ended"
    student.trainer.begin()
    student.pause(3000)  # what was done on base: hold still, and be scored
    second = student.trainer.end()
    assert second.score.total is None
    assert "never crossed the skin" in second.score.void_reason


@pytest.mark.long("machine")
def test_the_needle_goes_back_at_a_hands_speed_and_the_window_says_so(student: Student) -> None:
    student.trainer.begin()
    insert(student)
    student.trainer.end()
    student.trainer.begin()
    snapshot = student.trainer.snapshot()
    assert snapshot.state is State.WITHDRAWING
    assert "being withdrawn" in snapshot.messages[0]
    assert not snapshot.armed
    assert snapshot.elapsed == 0.0
    depths = wait_until_begun(student)
    steps = [a - b for a, b in pairwise(depths)]
    assert max(steps) <= 1.2 * FASTEST_ALONG * 0.02
    assert depth(student) <= -0.009
    snapshot = student.trainer.snapshot()
    assert snapshot.state is State.ALIGNING
    assert snapshot.armed
    assert snapshot.withdrawal == ""


def start(student: Student) -> tuple[float, float]:
    """Tilt of the needle from straight down [°], and its depth [mm]."""
    row = student.rig.loop.latest().row
    return float(np.degrees(np.hypot(*row[sv.AXIS][:2]))), 1e3 * depth(student)


@pytest.mark.long("machine")
def test_every_attempt_begins_where_the_first_one_did_wherever_the_last_one_ended(
    student: Student,
) -> None:
    student.trainer.begin()
    assert student.trainer.snapshot().state is State.ALIGNING, "it waits there already"
    first = start(student)
    for inserts in (True, False, True):
        if inserts:
            insert(student)
        else:  # only leans over the skin, and is ended there
            student.hand.follow(student.trainer._placed.axis, -0.004)
            student.pause(1500)
        assert start(student)[0] > 10.0
        student.trainer.end()
        student.trainer.begin()
        assert student.trainer.snapshot().state is State.WITHDRAWING
        wait_until_begun(student)
        assert start(student) == pytest.approx(first, abs=0.5)


def test_a_hand_that_moved_before_the_attempt_begins_at_its_start_too(student: Student) -> None:
    student.hand.follow(student.trainer._placed.axis, -0.015)
    student.pause(1500)
    student.trainer.begin()
    for _ in range(300):
        if student.trainer.snapshot().state is State.ALIGNING:
            break
        student.wish()
    assert start(student)[0] < 0.3
    assert student.hand.pose.direction[2] == pytest.approx(-1.0, abs=1e-4), "it has come along"


def test_who_leads_the_needle_to_his_own_beginning_is_left_there(student: Student) -> None:
    student.hand.follow(student.trainer._placed.axis, -0.010)
    student.pause(1500)
    student.trainer.begin(hand="arm")
    assert student.trainer.snapshot().state is State.ALIGNING
    assert start(student)[0] > 10.0


@pytest.mark.long("machine")
def test_twice_in_a_row_the_needle_can_be_inserted_anew(student: Student) -> None:
    for _ in range(2):
        student.trainer.begin()
        wait_until_begun(student)
        insert(student)
        result = student.trainer.end()
        assert result.score.void_reason == ""
        assert result.phases[State.ALIGNING] > 0.5
        states = read_recording(result.record).samples.state
        assert (states == "inserting").any()


@pytest.mark.long("machine")
def test_the_record_holds_the_way_out_and_the_score_leaves_it_out(student: Student) -> None:
    student.trainer.begin()
    insert(student)
    student.trainer.end()
    student.trainer.begin()
    depths = wait_until_begun(student)
    insert(student)
    result = student.trainer.end()
    recording = read_recording(result.record)
    withdrawing = recording.samples.state == "withdrawing"
    assert withdrawing.sum() > 0.5 * len(depths)
    (told,) = (e for e in recording.events if e.kind == "withdrawal" and "how" in e.data)
    assert told.data["how"] == "simulated"
    assert told.data["duration_s"] > 0.5
    assert result.duration == pytest.approx(
        sum(v for k, v in result.phases.items() if k is not State.WITHDRAWING), abs=0.05
    )
    assert not recording.trajectory().running[withdrawing[: len(recording.trajectory())]].any()


@pytest.mark.long("machine")
def test_ended_at_once_it_was_never_begun(student: Student) -> None:
    student.trainer.begin()
    insert(student)
    student.trainer.end()
    student.trainer.begin()
    result = student.trainer.end()
    assert result.state is State.ENDED
    assert result.score is None or result.score.total is None
    why = result.unscored or result.score.void_reason
    assert "never begun" in why


@pytest.mark.long("machine")
def test_start_twice_and_a_scan_meanwhile_are_refused(student: Student) -> None:
    student.trainer.begin()
    insert(student)
    student.trainer.end()
    student.trainer.begin()
    with pytest.raises(IllegalTransitionError, match="withdrawing"):
        student.trainer.begin()
    with pytest.raises(IllegalTransitionError, match="withdrawing"):
        student.trainer.scan()
    wait_until_begun(student)
    assert student.trainer.scan() == 1


@pytest.mark.long("machine")
def test_broken_off_on_the_way_out_the_next_goes_on_outwards(student: Student) -> None:
    student.trainer.begin()
    insert(student)
    student.trainer.end()
    student.trainer.begin()
    student.trainer.step(200)
    inside = depth(student)
    student.trainer.abort("by the user")
    assert inside > 0.0
    student.trainer.begin()
    assert student.trainer.snapshot().state is State.WITHDRAWING
    wait_until_begun(student)
    assert depth(student) < 0.0


@pytest.mark.long("machine")
def test_the_hand_obeys_nobody_while_it_brings_the_needle_out(student: Student) -> None:
    student.trainer.begin()
    insert(student)
    student.trainer.end()
    student.trainer.begin()
    x, y, _ = student.trainer._placed.axis
    for _ in range(400):
        student.trainer.hand(x, y, TARGET)  # still wants the target
        student.trainer.step(10)
        if student.trainer.snapshot().state is State.ALIGNING:
            break
    assert student.trainer.snapshot().state is State.ALIGNING
    assert depth(student) < 0.0


@pytest.mark.long("machine")
def test_a_scripted_trainee_is_withdrawn_too_and_inserts_again(tmp_path: Path) -> None:
    student = Student(tmp_path, skill="expert")
    try:
        scores = []
        for _ in range(2):
            student.trainer.begin()
            wait_until_begun(student)
            for _ in range(2000):
                if student.trainer.step(20).device.row[sv.TRAINEE_PHASE] == 9.0:
                    break
            scores.append(student.trainer.end().score)
        assert all(score.passed for score in scores)
    finally:
        student.close()


@pytest.mark.promise("docs/sessions.md: it never has 0 points for that")
def test_without_an_insertion_there_is_no_score_but_a_reason(student: Student) -> None:
    student.trainer.begin()
    student.pause(2000)
    score = student.trainer.end().score
    assert score.total is None
    assert "never crossed the skin" in score.void_reason


def test_without_a_measured_depth_there_is_no_score_but_a_reason(student: Student) -> None:
    student.blind = True
    student.pause(500)
    student.trainer.begin()
    insert(student)
    score = student.trainer.end().score
    assert score.total is None
    assert "nothing measured how deep" in score.void_reason
