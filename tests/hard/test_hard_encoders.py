"""Any encoder readings: bounded torque, no NaN, none after 20 ms of unbelievable ones."""

from math import radians

import numpy as np
from device.wire_rig import free_arms, joint_angles
from hypothesis import given, settings
from hypothesis import strategies as st
from virtual_fixture import VirtualFixture

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.core.parameters import Stage
from app.device.control import Loop, machine_stages
from app.device.links.link import Link
from app.device.links.simulated import simulated_link
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
START = joint_angles(PROFILE)
TICKS = 60


@stage
def tampered(state, p):
    """Add p[1 + k] to the left reading of the k-th tick after p[0] was set to 1."""
    if p[0] > 0.0 and p[0] < len(p):
        state[sv.Q_LEFT] += p[int(p[0])]
        p[0] += 1.0


OFF = st.one_of(
    st.just(0.0),
    st.floats(-1e4, 1e4),
    st.floats(radians(3.2), radians(6.0)),
    st.sampled_from([np.nan, np.inf, -np.inf, 2.0 * np.pi, 65536.0 * 2.0 * np.pi / 20_000, 1e300]),
)


def run(offsets):
    """Rows of a loop under force whose left encoder is off by `offsets`, tick by tick."""
    wrong = np.array([0.0, *offsets])
    link = simulated_link(PROFILE, [Stage("plant", free_arms, np.array(START))])
    link = Link.of([*link.read, Stage("tampered", tampered, wrong)], link.write)
    table = machine_stages(PROFILE, [VirtualFixture.of(PROFILE).stage()], [], link)
    initial = {"plant_q_left": float(START[0]), "plant_q_right": float(START[1])}
    clock = VirtualClock(10.0)
    with Loop(table, 1000.0, clock, initial=initial) as loop:
        loop.inbox.write(enabled=1.0, assistance=1.0, path_x=0.3, path_z=-0.95)
        loop.inbox.write(homed=1.0, force_cap=5.0)
        for _ in range(12):
            loop.inbox.write(heartbeat=clock.now())
            loop.step(100)
        assert np.abs(loop.latest().row[sv.TORQUE]).max() > 0.0
        wrong[0] = 1.0
        first = loop.latest().tick
        loop.inbox.write(heartbeat=clock.now())
        loop.step(len(offsets))
        return loop.rows(first)


@settings(max_examples=30, deadline=None, derandomize=True)
@given(st.lists(OFF, min_size=TICKS, max_size=TICKS))
def test_whatever_is_read_the_torque_is_bounded_and_a_number(offsets):
    rows = run(offsets)
    torques = rows[:, sv.TORQUE]
    assert np.isfinite(torques).all()
    assert np.abs(torques).max() <= PROFILE.limits.joint_torque * (1.0 + 1e-12)
    assert np.isfinite(rows[:, [*range(sv.TIP_X, sv.TIP_Z + 1)]]).all()


@settings(max_examples=20, deadline=None, derandomize=True)
@given(st.floats(radians(3.2), 1e4), st.sampled_from([-1.0, 1.0]))
def test_after_20_ms_of_a_jump_that_stays_there_is_no_torque(jump, sign):
    rows = run([sign * jump] * TICKS)
    assert not rows[21:, sv.TORQUE].any()
    assert (rows[21:, sv.FAULT] >= 17).all()
