"""The interval that holds the depth: how it grows, and what force and limits make of it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control.depth_interval import (
    SIGMAS,
    DepthInterval,
    interval_kernel,
    longest_lever,
    shortest_lever,
)
from app.mechanisms.profile import HandSection, load_profile

PROFILE = load_profile("icube")
LOW, HIGH = PROFILE.depth_range
SPEED = PROFILE.hand.depth_speed
DT = 1e-3


def run(ticks, fixes):
    """Rows (least, most) of a stage; `fixes` maps a tick to (depth, variance), now."""
    state = sv.empty_state()
    state[sv.TIME] = 5.0
    _, step, parameters = DepthInterval.of(PROFILE).stage()
    rows = []
    for k in range(ticks):
        state[sv.TIME] += DT
        state[sv.DT] = DT
        if k in fixes:
            state[sv.TRACKED_DEPTH], state[sv.TRACKED_VARIANCE] = fixes[k]
            state[sv.TRACKED_TIME] = state[sv.TIME]
        step(state, parameters)
        rows.append((state[sv.DEPTH_LEAST], state[sv.DEPTH_MOST]))
    return np.array(rows)


def test_without_a_fix_the_depth_is_anywhere_in_the_profiles_range():
    assert run(50, {}) == pytest.approx(np.tile([LOW, HIGH], (50, 1)))


def test_a_measured_depth_is_known_to_four_standard_deviations_of_its_fix():
    fixes = dict.fromkeys(range(0, 2000, 10), (0.05, 0.0005**2))
    least, most = run(2000, fixes)[-1]
    half = SIGMAS * 0.0005
    assert 0.05 - least == pytest.approx(most - 0.05)
    assert half <= most - 0.05 < half + 0.010 * SPEED


def test_a_fix_that_ages_is_known_less_and_less_without_a_step_until_it_says_nothing():
    rows = run(1200, dict.fromkeys(range(0, 801, 5), (0.05, 1e-08)))
    grown = rows[805:]
    assert (np.diff(grown[:, 0]) <= 0.0).all()
    assert (np.diff(grown[:, 1]) >= 0.0).all()
    assert np.abs(np.diff(grown, axis=0)).max() < 1.1 * (HIGH - LOW) * DT / 0.1 + SPEED * DT
    assert grown[96, 1] - 0.05 >= SPEED * 0.100
    assert grown[297] == pytest.approx([LOW, HIGH])


def test_a_fix_that_is_taken_back_leaves_the_whole_range_at_once():
    state = sv.empty_state()
    state[sv.TIME], state[sv.DT] = 5.0, DT
    _, step, parameters = DepthInterval.of(PROFILE).stage()
    state[sv.TRACKED_TIME], state[sv.TRACKED_DEPTH] = 5.0, 0.05
    step(state, parameters)
    assert state[sv.DEPTH_MOST] < 0.06
    state[sv.TRACKED_TIME] = 0.0
    step(state, parameters)
    assert [state[sv.DEPTH_LEAST], state[sv.DEPTH_MOST]] == pytest.approx([LOW, HIGH])


@settings(derandomize=True, deadline=None, max_examples=300)
@given(
    depth=st.floats(-0.2, 0.4),
    variance=st.floats(0.0, 1e-2),
    age=st.floats(0.0, 1.0),
    later=st.floats(0.0, 1.0),
)
def test_the_interval_holds_its_depth_and_only_grows_with_age(depth, variance, age, later):
    first = interval_kernel(depth, variance, age, LOW, HIGH, SPEED, 0.2, 0.1)
    then = interval_kernel(depth, variance, age + later, LOW, HIGH, SPEED, 0.2, 0.1)
    if age < 0.3:
        assert first[0] <= depth <= first[1]
    if age + later < 0.3:
        assert then[0] <= first[0]
        assert then[1] >= first[1]


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
def test_a_depth_that_is_no_number_says_nothing(wrong):
    assert interval_kernel(wrong, 1e-8, 0.0, LOW, HIGH, SPEED, 0.2, 0.1) == (LOW, HIGH)
    assert interval_kernel(0.05, wrong, 0.0, LOW, HIGH, SPEED, 0.2, 0.1) == (LOW, HIGH)
    assert interval_kernel(0.05, 1e-8, wrong, LOW, HIGH, SPEED, 0.2, 0.1) == (LOW, HIGH)


def test_the_levers_are_those_of_the_ends_and_never_leave_out_the_estimate():
    state = sv.empty_state()
    state[sv.L_OUT], state[sv.DEPTH] = 0.110, 0.090
    state[sv.DEPTH_LEAST], state[sv.DEPTH_MOST] = -0.03, 0.12
    assert (shortest_lever(state), longest_lever(state)) == pytest.approx((0.08, 0.23))
    state[sv.DEPTH_LEAST], state[sv.DEPTH_MOST] = 0.095, 0.05
    assert (shortest_lever(state), longest_lever(state)) == pytest.approx((0.11, 0.11))


def test_a_profile_that_does_not_say_how_fast_hands_are_takes_an_estimate():
    assert HandSection().depth_speed == SPEED
    assert HandSection().provenance["depth_speed"] == "estimated"
