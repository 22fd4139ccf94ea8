"""The force path at its worst: fuzzed inputs, antipodes, huge forces, subnormals, dial changes."""

from dataclasses import replace

import numpy as np
import pytest
from device.device_rig import HAND_LIMIT, PROFILE, TORQUE_LIMIT, Rig
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control import Fault
from app.device.control.governor import SpeedGovernor
from app.device.control.law_kernels import across_kernel, spring_kernel


def attraction(*vectors: float) -> tuple[float, ...]:
    """Force at the hub of a spring of 1 N/rad without limit: (needle, path) in."""
    *part, angle = across_kernel(*vectors)
    return tuple(-spring_kernel(angle, 1.0, 1e9)[0] * x for x in part)


anything = st.floats(allow_nan=True, allow_infinity=True)
FORCE_PATH = [sv.FELT_X, sv.FELT_Y, sv.FELT_Z, sv.TORQUE_LEFT, sv.TORQUE_RIGHT]


def assert_safe(rows: np.ndarray) -> None:
    assert np.isfinite(rows[..., FORCE_PATH]).all()
    felt = np.linalg.norm(rows[..., sv.FELT], axis=-1)
    assert (felt <= rows[..., sv.FELT_MOST] + 1e-9).all()
    assert rows[..., sv.FELT_MOST].max() <= HAND_LIMIT + 1e-9
    assert np.abs(rows[..., [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]).max() <= TORQUE_LIMIT
    assert set(rows[..., sv.FAULT].ravel().astype(int)) <= {int(fault) for fault in Fault}


@pytest.mark.long("statistics")
@pytest.mark.promise("README.md: at most 5 N at the hand")
@settings(derandomize=True, deadline=None, max_examples=150)
@given(
    st.lists(st.tuples(st.sampled_from(range(sv.INPUTS)), anything), max_size=6),
    st.tuples(anything, anything),
    st.tuples(anything, anything, anything),
    st.booleans(),
)
def test_whatever_comes_in_the_force_is_finite_and_within_its_limits(inputs, q, force, wild):
    rig = Rig()
    with rig.loop:
        rig.arm()
        names = {slot: name for name, slot in sv.INDEX.items()}
        rig.write(**{names[slot]: value for slot, value in inputs})
        if wild:
            rig.loop._state[[sv.PLANT_Q_LEFT, sv.PLANT_Q_RIGHT]] = q
        rig.force[:] = force
        rig.step(30)
        assert_safe(rig.loop.rows())


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=100)
@given(st.floats(-4.0, 4.0), st.floats(-4.0, 4.0), st.floats(-0.5, 0.5))
def test_in_any_pose_of_the_motors_the_force_stays_within_its_limits(q1, q2, depth):
    rig = Rig(force=(3.0, -9.0, 2.0))
    with rig.loop:
        rig.arm()
        rig.loop._state[[sv.PLANT_Q_LEFT, sv.PLANT_Q_RIGHT]] = q1, q2
        rig.write(tracked_depth=depth, tracked_time=rig.clock.now())
        rig.step(50)
        rows = rig.loop.rows()
    assert_safe(rows)
    assert np.isfinite(rows).all()


def test_on_the_path_the_force_is_exactly_zero():
    for path in np.eye(3):
        assert attraction(*path, *path) == (0.0, 0.0, 0.0)
    rig = Rig(tilt=0.0)
    with rig.loop:
        rig.arm()
        path = rig.loop.latest().axis
        rig.write(path_x=path[0], path_y=path[1], path_z=path[2])
        rig.step(200)
        assert not rig.loop.latest().guide.any()


@pytest.mark.parametrize("offset", [1e-300, 1e-200, 1e-100, 1e-16, 1e-9, 1e-3])
def test_near_the_path_the_force_is_proportional_to_the_error(offset):
    force = np.array(attraction(0.0, 0.0, -1.0, offset, 0.0, -1.0))
    assert force == pytest.approx([-offset, 0.0, 0.0], rel=1e-3, abs=0.0)


def test_against_the_path_the_force_goes_to_zero_without_a_jump():
    previous = None
    for angle in np.linspace(np.pi - 1e-3, np.pi + 1e-3, 2001):
        force = np.array(attraction(0.0, 0.0, -1.0, np.sin(angle), 0.0, -np.cos(angle)))
        assert np.isfinite(force).all()
        assert np.linalg.norm(force) <= np.pi
        assert previous is None or np.linalg.norm(force - previous) < 1e-5
        previous = force


def test_the_spring_is_smooth_where_its_two_forms_meet():
    angles = np.pi / 2 + np.linspace(-1e-6, 1e-6, 201)
    forces = [
        np.linalg.norm(attraction(0.0, 0.0, -1.0, np.sin(a), 0.0, -np.cos(a))) for a in angles
    ]
    assert np.diff(forces) == pytest.approx(np.full(200, 1e-8), abs=1e-13)


@pytest.mark.parametrize("size", [1e3, 1e100, 1e160, 1e300])
def test_a_huge_force_is_limited_and_keeps_its_direction(size):
    rig = Rig(force=(size, 0.5 * size, 0.0), laws=[])
    with rig.loop:
        rig.arm()
        state = rig.loop.latest()
    wanted = np.array([1.0, 0.5, 0.0])
    wanted -= state.axis * np.dot(state.axis, wanted)
    felt = np.linalg.norm(state.felt)
    assert state.felt_most == pytest.approx(HAND_LIMIT)
    assert state.felt == pytest.approx(felt * wanted / np.linalg.norm(wanted))


def test_a_needle_that_passes_through_the_vertical_feels_no_jump():
    rig = Rig(tilt=0.0)
    with rig.loop:
        rig.arm(path_x=0.1)
        forces = []
        base = rig.loop._state[[sv.PLANT_Q_LEFT, sv.PLANT_Q_RIGHT]].copy()
        for k in range(200):
            shift = 1e-6 * (k - 100)
            rig.loop._state[[sv.PLANT_Q_LEFT, sv.PLANT_Q_RIGHT]] = base + shift
            rig.step(1)
            forces.append(rig.loop.latest().felt)
    assert np.abs(np.diff(forces, axis=0)).max() < 0.02


def test_turning_the_dial_never_moves_the_force_faster_than_the_dial_may_turn():
    rig = Rig()
    rng = np.random.default_rng(5)
    with rig.loop:
        rig.arm()
        previous = rig.loop.latest().felt
        for _ in range(400):
            rig.write(assistance=float(rng.uniform(-1.0, 1.0)))
            rig.step(1)
            felt = rig.loop.latest().felt
            assert np.linalg.norm(felt - previous) <= 4.0 * 1e-3 * HAND_LIMIT / 0.95 + 1e-9
            previous = felt


def test_a_dial_that_is_clicked_to_its_end_does_not_jerk_the_hand():
    rig = Rig(tilt=0.3)
    with rig.loop:
        rig.arm(tracked_depth=0.03)
        rig.write(assistance=0.0)
        rig.step(300)
        assert rig.felt == 0.0
        rig.write(assistance=1.0)
        rig.step(300)
        largest = rig.felt
        felt = rig.loop.rows()[-600:, sv.FELT]
    steps = np.linalg.norm(np.diff(felt, axis=0), axis=1)
    assert largest == pytest.approx(HAND_LIMIT)
    assert steps.max() < 0.04, "N per millisecond"


@pytest.mark.parametrize("reading", [1e308, -1e308, 1e200])
def test_one_absurd_reading_of_an_encoder_is_forgotten(reading):
    rig = Rig()
    with rig.loop:
        rig.arm()
        home = rig.loop._state[sv.PLANT_Q_LEFT]
        rig.loop._state[sv.PLANT_Q_LEFT] = reading
        rig.step()
        rig.loop._state[sv.PLANT_Q_LEFT] = home
        rig.step(1500)
        state = rig.loop.latest()
        assert_safe(rig.loop.rows())
    assert state.fault is Fault.NONE
    assert np.isfinite(state.row).all()
    assert np.abs(state.qd).max() < 1.0


def test_losing_the_marker_does_not_make_the_force_jump():
    rig = Rig(force=(0.0, 0.0, 0.0))
    with rig.loop:
        rig.arm()
        for _ in range(3):
            rig.write(tracked_depth=0.03, tracked_time=rig.clock.now())
            rig.step(100)
        rig.step(500)
        rows = rig.loop.rows()[-800:]
    assert {0.0, 1.0, 2.0} == set(rows[:, sv.DEPTH_SOURCE])
    torques = rows[:, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]
    assert np.abs(np.diff(torques, axis=0)).max() < 0.02 * TORQUE_LIMIT


@pytest.mark.parametrize(
    ("slot", "value"), [(sv.AXIS_X, np.nan), (sv.J_XL, np.inf), (sv.L_OUT, np.nan)]
)
def test_a_torque_whose_acceleration_cannot_be_told_does_not_pass_the_governor(slot, value):
    rig = Rig()
    with rig.loop:
        rig.arm()
        state = rig.loop._state.copy()
    _, govern, parameters = SpeedGovernor.of(PROFILE).stage()
    for tick in range(3):
        state[sv.TIME] = state[sv.Q_TIME] = 100.0 + tick * 1e-3
        state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = 0.1, -0.1
        good, state[slot] = state[slot], value
        govern(state, parameters)
        state[slot] = good
        assert state[sv.TORQUE_LEFT] == state[sv.TORQUE_RIGHT] == state[sv.LET_GO_SCALE] == 0.0
    for tick in range(3, 40):  # and once it can be told, it passes again
        state[sv.TIME] = state[sv.Q_TIME] = 100.0 + tick * 1e-3
        state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = 0.1, -0.1
        govern(state, parameters)
    assert state[sv.TORQUE_LEFT] > 0.0
    assert np.isfinite(parameters).all()


def test_a_robot_without_inertia_gets_no_torque():
    nothing = replace(SpeedGovernor.of(PROFILE), needle=(0.0, 0.0, 0.0))
    rig = Rig()
    with rig.loop:
        rig.arm()
        state = rig.loop._state.copy()
    state[sv.TORQUE_LEFT], state[sv.INERTIA] = 0.1, 0.0
    _, govern, parameters = nothing.stage()
    govern(state, parameters)
    assert not state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]].any()


@pytest.mark.long("statistics")
def test_a_rig_at_rest_for_ten_minutes_stays_finite():
    rig = Rig()
    with rig.loop:
        rig.arm()
        rig.write(enabled=0.0)
        rig.loop.step(600_000)
        row = rig.loop.latest().row
    assert np.isfinite(row).all()
    assert_safe(row)
