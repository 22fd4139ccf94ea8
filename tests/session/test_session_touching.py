"""What counts as a touch, by what the program can know: alone, and through the whole trainer."""

import json
from dataclasses import replace

import numpy as np
import pytest

from app.compose.recomputed import replay_recording
from app.core import state_vector as sv
from app.core.events import Event
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.session.curves import offset
from app.session.fusion import TRACKER_HOLD
from app.session.machine import State
from app.session.pad.hand import HandPose
from app.session.recording import read_recording
from app.session.review import review
from app.session.shown_views import Shown
from app.session.touching import KIND, TASK, Touching, marks_at, touches_of
from app.session.verify import verify
from tests.virtual_student import Student

EXERCISE = load_exercise("laparoscopic-tool")
TASK_OF_IT = EXERCISE.touch_task(placed_plan_of(EXERCISE, device_of(EXERCISE)))
FIRST, SECOND = TASK_OF_IT.p_targets[:2]
FRAME = 1.0 / 30.0


@pytest.fixture
def touching():
    return Touching(TASK_OF_IT)


def stay(touching, at, begin, seconds, off=0.0):
    """Measure the tip at a place for so long; returns whether it touched."""
    tips = [at + np.array([off, 0.0, 0.0])] * (round(seconds / FRAME) + 1)
    touched = [touching.take(tip, begin + k * FRAME) for k, tip in enumerate(tips)]
    return any(touched)


def test_a_target_is_touched_after_the_dwell_within_its_radius(touching):
    assert not stay(touching, FIRST, 1.0, 0.4, off=0.0039)
    assert touching.state.dwelt == pytest.approx(0.4)
    assert stay(touching, FIRST, 1.4, 0.1)
    assert touching.state.touched == 1
    assert touching.state.number == 2
    assert touching.state.aim is TASK_OF_IT.plans[1]


def test_the_wrong_target_is_none(touching):
    assert not stay(touching, SECOND, 1.0, 5.0)
    assert touching.state.touched == 0
    assert stay(touching, FIRST, 7.0, 1.0)
    assert stay(touching, SECOND, 9.0, 1.0)
    assert touching.state.touched == 2


def test_a_dwell_that_is_broken_off_begins_anew(touching):
    assert not stay(touching, FIRST, 1.0, 0.4)
    assert not stay(touching, FIRST, 1.5, 0.0, off=0.0041)
    assert touching.state.dwelt == 0.0
    assert not stay(touching, FIRST, 1.6, 0.4)
    assert stay(touching, FIRST, 2.1, 0.1)


def test_a_held_or_lost_depth_adds_nothing(touching):
    assert not stay(touching, FIRST, 1.0, 0.4)
    assert not any(touching.take(FIRST, 1.4) for _ in range(500))  # held: the same measurement
    assert touching.state.dwelt == pytest.approx(0.4)
    assert not touching.take(FIRST, None)
    assert touching.state.dwelt == 0.0
    assert not any(touching.take(FIRST, None) for _ in range(500))
    assert not touching.take(np.full(3, np.nan), 2.0)


def test_after_the_last_target_nothing_is_touched(touching):
    for number, target in enumerate(TASK_OF_IT.p_targets):
        assert stay(touching, target, 10.0 * number, 1.0)
    assert touching.state.done
    assert touching.state.number == len(TASK_OF_IT)
    assert not stay(touching, TASK_OF_IT.p_targets[-1], 100.0, 2.0)
    touching.begin()
    assert touching.state.touched == 0


def test_events_of_a_damaged_record_give_no_touch_that_was_not():
    begin = Event(1.0, TASK, "", {"of": 3, "targets_lps_mm": [[1, 2, 3]] * 3})
    ones = [Event(2.0, KIND, "", {"touched": 1}), Event(3.0, KIND, "", {"touched": 3})]
    assert touches_of([begin, *ones]).times == (2.0,)
    assert touches_of(ones) is None
    assert touches_of([Event(1.0, TASK, "", {"of": "many"})]) is None
    assert touches_of([begin, Event(float("nan"), KIND, "", {"touched": 1})]).times == ()
    assert marks_at([replace(begin, data={"of": 3})], 9.0) is None
    assert marks_at([begin, *ones], 2.5).touched == 1


# --- through the whole trainer ------------------------------------------------------------------
class Tool(Student):
    """A student whose hand steers the tip of the tool to places."""

    def __init__(self, folder):
        super().__init__(folder, "laparoscopic-tool")
        self.task = self.trainer.snapshot().touch.task
        self.trainer.begin("tester", "mouse")

    def go(self, p_tip, seconds=1.5):
        """Bring the tip to a place in the world [m], and stay there."""
        way = p_tip - self.task.plans[0].p_entry
        pose = self.hand.pose
        depth = float(np.linalg.norm(way))
        steps = round(100.0 * seconds)
        for share in np.linspace(0.0, 1.0, max(1, steps // 2)):
            axis = (1.0 - share) * pose.direction + share * way / depth
            self.hand._pose = HandPose(
                axis / np.linalg.norm(axis), (1.0 - share) * pose.depth + share * depth, True
            )
            self.wish()
        self.pause(500 * round(seconds))

    @property
    def touched(self):
        return self.trainer.snapshot().touch.touched


@pytest.fixture
def tool(tmp_path):
    student = Tool(tmp_path)
    yield student
    student.close()


def record_of(tool, tmp_path):
    tool.trainer.end()
    tool.trainer.close()
    return read_recording(next(tmp_path.rglob("*.mcap")))


def test_targets_are_touched_in_their_order_only_and_everybody_aims_at_the_present_one(tool):
    one, two, three = tool.task.p_targets[:3]
    tool.go(three)
    assert tool.touched == 0
    for number, target in enumerate((one, two), 1):
        np.testing.assert_array_equal(tool.trainer.snapshot().p_target, target)
        tool.go(target, 2.0)
        assert tool.touched == number
    snapshot = tool.trainer.snapshot()
    np.testing.assert_array_equal(snapshot.p_target, three)
    shown = Shown().of(snapshot, tool.rig.setup.placed)
    np.testing.assert_array_equal(shown.p_target, three)
    away = offset(snapshot.pose, three, snapshot.touch.aim)
    assert snapshot.offset.lateral == pytest.approx(away.lateral, abs=1e-12)
    tool.pause(100)
    row = tool.rig.loop.latest().row
    np.testing.assert_allclose(row[sv.TARGET], three, atol=1e-15)  # so do the force laws
    np.testing.assert_allclose(row[sv.PATH], snapshot.touch.aim.axis, atol=1e-15)


@pytest.mark.long("journey")
def test_blind_cameras_touch_nothing(tool):
    tool.go(tool.task.p_targets[0] + np.array([0.01, 0.0, 0.0]), 2.0)
    assert tool.trainer.snapshot().state in (State.INSERTING, State.HOLDING)
    tool.blind = True
    tool.pause(round(1000 * TRACKER_HOLD))
    tool.go(tool.task.p_targets[0], 2.0)
    assert tool.touched == 0
    tool.blind = False
    tool.pause(2000)
    assert tool.touched == 1


@pytest.mark.long("journey")
def test_record_replay_and_score_tell_the_same(tool, tmp_path):
    for target in tool.task.p_targets[:3]:
        tool.go(target, 2.0)
    assert tool.touched == 3
    recording = record_of(tool, tmp_path)
    touches = touches_of(recording.events)
    assert (touches.of, len(touches.times)) == (6, 3)
    values = {row.name: row.value for row in verify(recording).recomputed.rows}
    assert verify(recording).confirmed, verify(recording).sentences()
    assert values["targets_touched"] == 50.0
    assert 1.0 < 2.0 * values["time_per_target"] - 25.0 < 4.0  # three are cut off
    assert 80.0 < 2.0 * values["economy_of_motion"] <= 100.0
    assert not verify(recording).recomputed.passed  # not all were touched
    assert replay_recording(recording).identical
    # What was touched follows from the samples alone, by the same rule.
    again, found = Touching(tool.task), []
    samples = recording.samples
    inside = np.isin(samples.state, (State.INSERTING.value, State.HOLDING.value))
    seen = samples.valid & np.isin(samples.depth_source, ("tracked", "one_camera", "held"))
    for row in range(len(samples.time)):
        at = samples.time[row] - samples.spread[row, 2] if inside[row] and seen[row] else None
        if again.take(samples.tip[row], at):
            found.append(samples.time[row])
    np.testing.assert_allclose(found, touches.times, atol=0.021)
    shown = review(recording)
    assert shown.targets(0).touched == 0
    assert shown.targets(len(samples.time) - 1).touched == 3
    assert len(shown.targets(0).points_mm) == 6
    said = json.loads(recording.attachments["exercise.json"])
    assert said["touch"]["pattern"]["count"] == 6


@pytest.mark.parametrize("way", ["still", "waved"])
def test_who_does_not_touch_the_targets_scores_little(tool, tmp_path, way):
    entry = tool.task.plans[0].p_entry
    for p_tip in tool.task.p_targets if way == "waved" else tool.task.p_targets[:1]:
        depth = float(np.linalg.norm(p_tip - entry))
        tool.hand._pose = HandPose((p_tip - entry) / depth, depth, True)
        tool.wish()
        tool.pause(300 if way == "waved" else 3000)
    assert tool.touched == (0 if way == "waved" else 1)
    again = verify(record_of(tool, tmp_path))
    assert again.confirmed
    assert again.recomputed.total < 25.0
    assert not again.recomputed.passed


def test_another_attempt_begins_with_the_first_target(tool):
    tool.go(tool.task.p_targets[0], 2.0)
    assert tool.touched == 1
    tool.trainer.end()
    assert tool.touched == 1  # as it ended
    tool.trainer.begin("tester", "mouse")
    assert tool.touched == 0
    np.testing.assert_array_equal(tool.trainer.snapshot().p_target, tool.task.p_targets[0])
