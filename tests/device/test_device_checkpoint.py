"""Checkpoints: a run continues from one to the last bit, whoever runs the ticks."""

import time
from typing import Any

import numpy as np
import pytest
from device_rig import PROFILE, pose
from virtual_fixture import VirtualFixture

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import SystemClock, VirtualClock
from app.core.compiled import stage
from app.device.checkpoint import Checkpoint
from app.device.control import Host, Loop, Table, machine_stages
from app.device.control.checkpoints import Rerun
from app.device.errors import LoopError, RerunError
from app.device.links import Link
from app.device.links.simulated import SimulatedEncoders

GIVEN = (
    *(name for name, index in sv.INDEX.items() if index < sv.INPUTS),
    *("input_fault", "time", "dt", "tick", "lateness", "missed"),
)


@stage
def swing(state: FloatArray, p: FloatArray) -> None:
    """A plant with a memory of its own: two joints that swing, pushed by the torques."""
    p[0] += 1.0
    state[sv.PLANT_Q_LEFT] = p[1] + 0.05 * np.sin(0.013 * p[0]) + 0.3 * state[sv.TORQUE_LEFT]
    state[sv.PLANT_Q_RIGHT] = p[2] + 0.05 * np.cos(0.017 * p[0]) + 0.3 * state[sv.TORQUE_RIGHT]


def table() -> Table:
    start = pose(0.2, 0.5)
    plant = ("swing", swing, np.array([0.0, start["plant_q_left"], start["plant_q_right"]]))
    encoders = SimulatedEncoders(20_000, (0.0, 0.0)).stage()
    laws = [VirtualFixture.of(PROFILE).stage()]
    return machine_stages(PROFILE, laws, [], Link.of([encoders], [plant]))


def loop(clock: Any, host: Host) -> Loop:
    made = Loop(table(), 500.0, clock, host, initial=pose(0.2, 0.5))
    made.inbox.write(path_z=-1.0, assistance=1.0, homed=1.0, force_cap=5.0)
    return made


def arm(made: Loop) -> None:
    made.inbox.write(enabled=1.0, heartbeat=made.clock.now())


def columns(rows: FloatArray) -> FloatArray:
    return rows[:, [sv.INDEX[name] for name in GIVEN]]


def without_cost(rows: FloatArray) -> FloatArray:
    """The time that a tick took is measured, not computed."""
    copy = np.array(rows)
    copy[:, sv.TICK_COST] = 0.0
    return copy


def assert_the_same_bits(checkpoint: Checkpoint, rows: FloatArray) -> None:
    again = Rerun(table(), checkpoint, GIVEN).run(columns(rows))
    ours, theirs = (without_cost(r).view(np.uint64) for r in (rows, again))
    np.testing.assert_array_equal(ours, theirs)


def test_a_stepped_loop_continues_from_a_checkpoint_to_the_last_bit() -> None:
    with loop(VirtualClock(10.0), Host.STEPPED) as made:
        arm(made)
        made.step(400)
        checkpoint = made.checkpoint()
        made.step(700)
        rows = made.rows(checkpoint.tick)
    assert checkpoint.tick == 400
    assert np.abs(rows[:, sv.TORQUE_LEFT]).max() > 0.0
    assert_the_same_bits(checkpoint, rows[rows[:, sv.DT] > 0.0])


@pytest.mark.parametrize("host", [Host.COMPILED, Host.THREAD])
def test_a_running_loop_answers_between_two_ticks(host: Host) -> None:
    with loop(SystemClock(), host) as made:
        checkpoint, end = None, time.monotonic() + 60.0
        while made.latest().tick == 0 and time.monotonic() < end:
            time.sleep(0.01)
        for _ in range(8):
            arm(made)
            time.sleep(0.03)
            checkpoint = checkpoint or made.checkpoint()
        assert checkpoint is not None
        rows = made.rows(checkpoint.tick)
    assert rows[0, sv.TICK] == checkpoint.tick + 1
    assert len(rows) > 20
    assert np.abs(rows[:, sv.TORQUE_LEFT]).max() > 0.0
    assert_the_same_bits(checkpoint, rows)


def test_checkpoints_follow_one_another_and_are_values() -> None:
    with loop(VirtualClock(10.0), Host.STEPPED) as made:
        first = made.checkpoint()
        made.step(5)
        second = made.checkpoint()
    assert (first.tick, second.tick) == (0, 5)
    assert second.state[sv.TIME] == pytest.approx(10.01)
    assert first.parameters.sum() != second.parameters.sum()
    assert not second.state.flags.writeable
    assert sum(second.sizes) == len(second.parameters)
    assert second.names == tuple(stage.name for stage in table())


def test_a_closed_loop_has_no_checkpoint() -> None:
    made = loop(VirtualClock(10.0), Host.STEPPED)
    with pytest.raises(LoopError, match="closed"):
        made.checkpoint()


def test_the_row_of_a_loop_that_ends_is_told_from_a_tick_by_its_step_of_zero() -> None:
    with loop(VirtualClock(10.0), Host.STEPPED) as made:
        made.step(3)
    rows = made.rows()
    assert (rows[:3, sv.DT] > 0.0).all()
    assert rows[3, sv.DT] == 0.0


def test_a_table_that_does_not_fit_is_refused_by_the_stage_s_name() -> None:
    with loop(VirtualClock(10.0), Host.STEPPED) as made:
        checkpoint = made.checkpoint()
    other = Table.of([("kinematics", swing, np.zeros(3))])
    with pytest.raises(RerunError, match="'kinematics' has 11 numbers in the record and 3"):
        Rerun(other, checkpoint, GIVEN)
    with pytest.raises(RerunError, match="no stage 'breathing'"):
        Rerun(Table.of([("breathing", swing, np.zeros(3))]), checkpoint, GIVEN)
    with pytest.raises(RerunError, match="no slot 'hand_z'"):
        Rerun(table(), checkpoint, ("hand_z",))
