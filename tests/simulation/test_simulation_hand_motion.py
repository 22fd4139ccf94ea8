"""The simulated hand moves as hands do: bounded speed and acceleration, however it is driven."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.mechanisms import hand_motion
from app.mechanisms.profile import load_profile
from app.simulation.plant import SimulatedHand, initial_plant, plant_stage

PROFILE = load_profile("icube")
LENGTH = PROFILE.geometry.needle_length
QUICK = settings(max_examples=40, deadline=None)
WISH = st.tuples(
    st.floats(-2.0, 2.0), st.floats(-2.0, 2.0), st.floats(-0.5, 0.5), st.integers(1, 200)
)
"""x, y of the direction, depth [m], ticks."""


def played(wishes: list[tuple[float, float, float, int]], dt: float = 1e-3) -> FloatArray:
    """Rows of a plant whose hand is wanted here and there; the needle starts upright."""
    state = sv.empty_state()
    for name, value in initial_plant(PROFILE, (0.0, 0.0, -1.0), -0.015).items():
        state[sv.INDEX[name]] = value
    state[sv.DT], state[sv.HAND_HOLDS] = dt, 1.0
    _, step, parameters = plant_stage(PROFILE)
    rows = []
    for x, y, depth, ticks in wishes:
        state[sv.HAND_X], state[sv.HAND_Y], state[sv.HAND_DEPTH] = x, y, depth
        for _ in range(ticks):
            step(state, parameters)
            rows.append(state.copy())
    return np.array(rows)


def motion(rows: FloatArray, dt: float) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Speeds and accelerations of the hand: across at the hub, then along the needle."""
    x, y = rows[:, sv.GRIP_X], rows[:, sv.GRIP_Y]
    grip = np.stack([x, y, -np.sqrt(1.0 - x * x - y * y)], axis=1)
    lever = LENGTH - rows[:-1, sv.PLANT_DEPTH, None]
    across = np.diff(grip, axis=0) / dt * lever
    along = np.diff(rows[:, sv.GRIP_DEPTH]) / dt
    turned = np.linalg.norm(np.diff(across, axis=0), axis=1) / dt
    return np.linalg.norm(across, axis=1), turned, np.abs(along), np.abs(np.diff(along)) / dt


@QUICK
@given(st.lists(WISH, min_size=1, max_size=12), st.sampled_from([0.5e-3, 1e-3, 5e-3]))
def test_no_wish_makes_the_hand_faster_than_a_hand(
    wishes: list[tuple[float, float, float, int]], dt: float
) -> None:
    rows = played(wishes, dt)
    assert np.isfinite(rows).all()
    if len(rows) < 3:
        return
    across, turned, along, pushed = motion(rows, dt)
    assert across.max() <= hand_motion.FASTEST * 1.01
    assert along.max() <= hand_motion.FASTEST_ALONG * 1.01
    # A direction's own curvature v²/L and a lever that changes with the depth come on top.
    own = hand_motion.FASTEST**2 / 0.05 + hand_motion.FASTEST * hand_motion.FASTEST_ALONG / 0.05
    assert turned.max() <= hand_motion.STRONGEST + own + 1e-6 / dt
    assert pushed.max() <= hand_motion.STRONGEST * 1.01


@pytest.mark.parametrize("dt", [1e-3, 5e-3])
def test_it_arrives_without_running_past_and_rests_there(dt: float) -> None:
    rows = played([(0.4, -0.3, 0.04, round(3.0 / dt))], dt)
    assert rows[-1, sv.GRIP_X] == 0.4
    assert rows[-1, sv.GRIP_Y] == -0.3
    assert rows[-1, sv.GRIP_DEPTH] == 0.04
    assert rows[:, sv.GRIP_DEPTH].max() <= 0.04 + 1e-5
    angle = np.hypot(rows[:, sv.GRIP_X], rows[:, sv.GRIP_Y])
    assert angle.max() <= 0.5 + 1e-4
    late = round(1.7 / dt)
    assert not np.diff(rows[late:, sv.GRIP_DEPTH]).any()


def test_a_slow_movement_is_followed_within_a_tenth_of_a_millimetre() -> None:
    rows = played([(0.0, 0.0, -0.015 + 1e-5 * k, 1) for k in range(4000)])  # 10 mm/s
    late = rows[200:, sv.HAND_DEPTH] - rows[200:, sv.GRIP_DEPTH]
    assert 0.0 < late.min()
    assert late.max() < 1e-4


def test_a_tremor_of_ten_hertz_passes() -> None:
    time = 1e-3 * np.arange(2000)
    rows = played([(1e-3 * np.sin(2.0 * np.pi * 10.0 * t), 0.0, -0.015, 1) for t in time])
    assert np.ptp(rows[1000:, sv.GRIP_X]) > 1.6e-3


def test_a_hand_takes_hold_where_the_needle_is() -> None:
    state = sv.empty_state()
    leaning = (0.3, 0.1, -np.sqrt(0.9))
    for name, value in initial_plant(PROFILE, leaning, 0.03).items():
        state[sv.INDEX[name]] = value
    _, step, parameters = plant_stage(PROFILE)
    state[sv.DT] = 1e-3
    step(state, parameters)
    assert state[sv.GRIP_X] == pytest.approx(0.3, abs=1e-3)
    assert state[sv.GRIP_DEPTH] == pytest.approx(0.03)
    state[sv.HAND_HOLDS], state[sv.HAND_X], state[sv.HAND_DEPTH] = 1.0, -0.6, 0.1
    step(state, parameters)
    assert state[sv.GRIP_X] == pytest.approx(0.3, abs=2e-3)
    pull = np.linalg.norm(state[sv.PULL_X : sv.PULL_Z + 1])
    assert pull < 0.3, "taking hold of a needle pulls at nothing"


def test_a_hand_beside_a_real_robot_moves_its_depth_like_a_hand() -> None:
    _, step, parameters = hand_motion.hand_stage(LENGTH)
    state = sv.empty_state()
    state[sv.DT], state[sv.HAND_HOLDS], state[sv.HAND_DEPTH] = 1e-3, 1.0, -0.015
    step(state, parameters)
    assert state[sv.GRIP_DEPTH] == -0.015
    state[sv.HAND_DEPTH] = 0.1
    depths = []
    for _ in range(2000):
        step(state, parameters)
        depths.append(state[sv.GRIP_DEPTH])
    assert np.diff(depths).max() <= hand_motion.FASTEST_ALONG * 1e-3 * 1.001
    assert depths[-1] == 0.1


def test_the_hand_of_a_plant_can_be_another() -> None:
    assert SimulatedHand(speed=0.3).speed == 0.3
