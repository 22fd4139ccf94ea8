"""A whole exercise on a pen: simulated webcam, no robot, no force."""

import numpy as np
import pytest

from app.compose.needle_sources import needle_source
from app.compose.pen import Pen, joint_angles, without_force
from app.compose.recomputed import replay_recording
from app.compose.trainer import TrainerSetup, build_rig
from app.core import state_vector as sv
from app.core.arrays import unit
from app.core.clock import VirtualClock
from app.device.errors import LinkError
from app.device.links.pen import HOLD, PenLink, pen_stage
from app.exercises.scene import device_of, placed_plan_of
from app.mechanisms.pantograph import system_forward
from app.planning.plan import Plan
from app.session.machine import State
from app.session.recording import read_recording
from app.tracking.fix import FixStatus
from app.tracking.pen.settings import PenSettings
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")


class Bench:
    """A rig in virtual time whose webcam delivers when a picture is due."""

    def __init__(self, folder, skill=None, seed=3):
        exercise = layered("first-insertion")
        self.clock = VirtualClock(100.0)
        placed = placed_plan_of(exercise, device_of(exercise), PLAN)
        setup = TrainerSetup(
            exercise, placed, skill=skill, seed=seed, sessions=folder, clock=self.clock,
            source=needle_source("pen", "simulated"),
        )  # fmt: skip
        self.rig = build_rig(setup)
        self.trainer, self.tracker = self.rig.trainer, self.rig.tracker
        self.camera = self.tracker._reader._camera
        self.hidden = False
        self._next = 100.0
        self.rig.loop.open()
        self.camera.open()

    def step(self, seconds=0.02):
        end = self.clock.now() + seconds - 1e-9
        while self.clock.now() < end:
            snapshot = self.trainer.step()
            if self.clock.now() >= self._next and not self.hidden:
                self.tracker.process(self.camera.read())
                self._next += 1.0 / 15.0
        return snapshot

    def close(self):
        self.camera.close()
        self.rig.close()


@pytest.fixture
def bench(tmp_path):
    made = Bench(tmp_path)
    yield made
    made.close()


def test_joint_angles_are_those_of_a_robot_whose_needle_points_that_way():
    profile = device_of(layered("first-insertion"))
    for lean in ((0.0, 0.0), (0.3, 0.1), (-0.2, 0.4)):
        axis = unit([*lean, -1.0])
        needle = system_forward(profile.pantograph, joint_angles(profile, axis), 0.15)
        np.testing.assert_allclose(needle.axis, axis, atol=1e-9)
    assert joint_angles(profile, np.array([0.0, 0.0, 1.0])) is None
    assert joint_angles(profile, unit([1.0, 0.0, -0.02])) is None


def test_the_link_holds_a_direction_for_a_tenth_of_a_second_and_then_lets_it_grow_stale():
    link, state = PenLink((1.0, 2.0)), sv.empty_state()
    _, _, parameters = link.stage()
    state[sv.TIME] = 50.0
    pen_stage(state, parameters)
    assert state[sv.Q_TIME] == 0.0, "nothing measured yet"
    link.write(np.array([1.1, 2.2]), 50.0)
    for age, stamp in ((0.0, 50.0), (0.08, 50.08), (0.3, 50.0 + HOLD)):
        state[sv.TIME] = 50.0 + age
        pen_stage(state, parameters)
        assert state[sv.Q_TIME] == pytest.approx(stamp)
        assert (state[sv.Q_LEFT], state[sv.Q_RIGHT]) == (1.1, 2.2)
    link.write(np.array([9.0, 9.0]), 49.0)  # older
    pen_stage(state, parameters)
    assert state[sv.Q_LEFT] == 1.1
    with pytest.raises(LinkError, match="finite"):
        link.write(np.array([np.nan, 0.0]), 51.0)


@pytest.mark.long("machine")
def test_the_loop_shows_the_needle_where_the_pen_is(bench):
    bench.trainer.hand(0.15, -0.1, 0.03)
    snapshot = bench.step(2.5)  # half a second of a hand's movement; then the rate has settled
    assert snapshot.pose.valid
    row = bench.rig.loop.latest().row
    truth = bench.rig.source.scene(bench.rig.loop)(bench.clock.now())
    assert np.linalg.norm(snapshot.pose.p_tip - truth.p_tip) < 3e-3
    shaft = truth.T_world_body.rotation[:, 2]
    assert np.linalg.norm(np.cross(snapshot.pose.axis, shaft)) < 0.02
    assert row[sv.TORQUE_LEFT] == row[sv.TORQUE_RIGHT] == 0.0
    assert np.abs(row[sv.FELT]).max() == 0.0  # tissue bends the needle that is shown, no more


def test_a_pen_that_is_lost_makes_the_pose_invalid_within_a_quarter_of_a_second(bench):
    assert bench.step(0.4).pose.valid
    bench.hidden = True
    assert bench.step(0.1).pose.valid
    assert not bench.step(0.2).pose.valid
    bench.hidden = False
    assert bench.step(0.3).pose.valid


@pytest.mark.long("machine")
def test_a_whole_exercise_runs_on_simulated_pictures_and_is_scored_recorded_and_replayed(tmp_path):
    bench = Bench(tmp_path, skill="expert")
    bench.step(0.3)
    bench.trainer.begin("tester")
    states = set()
    while bench.clock.now() < 145.0:
        snapshot = bench.step(0.02)
        states.add(snapshot.state)
        if snapshot.device.row[sv.TRAINEE_PHASE] == 9.0:
            break
    result = bench.trainer.end()
    bench.close()
    assert {State.ALIGNING, State.INSERTING, State.HOLDING} <= states
    assert result.state is State.ENDED
    assert result.score is not None
    assert result.score.row("lateral_error").value < 6.0
    counts = bench.tracker.statistics().counts
    assert counts[FixStatus.VALID] > 0.95 * sum(counts.values())
    (path,) = tmp_path.glob("*.mcap")
    recording = read_recording(path)
    assert recording.metadata["device"] == {"name": "pen", "simulated": "no", "pen": "yes"}
    assert result.score.row("peak_force").value is None
    assert recording.trajectory().felt is None
    assert recording.metadata["cameras"]["tip"] == "drawn"
    assert "pen.json" in recording.attachments
    report = replay_recording(recording)
    assert report.first_difference is None


def test_the_tracker_says_once_that_the_tip_is_not_measured(bench):
    bench.step(0.5)
    told = [e.message for e in bench.trainer.events.drain() if e.kind == "pen"]
    told += [e.message for e in bench.tracker.events.drain() if e.kind == "pen"]
    assert sum("not measured" in message for message in told) <= 1


def test_the_effects_of_an_exercise_are_those_that_no_hand_must_feel():
    exercise = layered("thick-tissue")
    profile = device_of(exercise)
    placed = placed_plan_of(exercise, profile, PLAN)
    table = Pen.of(PenSettings(), profile).table(exercise, placed, None, 1)
    names = [stage.name for stage in table]
    assert names[0] == "pen"
    assert not {"fixture", "transmission", "governor", "safety"} & set(names)
    assert "lateral_tissue" in names  # it bends the needle that is shown; nobody is pushed
    assert without_force(profile).renders == ()
