"""The stages of commissioning: bounded test forces, and readings that are corrected once."""

import numpy as np
import pytest

from app.core import state_vector as sv
from app.device.commissioning.bench import LARGEST_FORCE, LARGEST_TORQUE, Service
from app.device.control.corrections import Corrections
from app.device.errors import DeviceError


def ticked(state, stage, ticks=1):
    for _ in range(ticks):
        for slot in (sv.FORCE_X, sv.FORCE_Y, sv.FORCE_Z, sv.JOINT_LEFT, sv.JOINT_RIGHT):
            state[slot] = 0.0
        stage[1](state, stage[2])
    return state


@pytest.fixture
def state():
    state = sv.empty_state()
    state[sv.DT], state[sv.ENABLED] = 1e-3, 1.0
    return state


def test_the_test_force_comes_up_at_a_limited_rate_and_stops_at_one_newton(state):
    stage = Service().stage()
    state[sv.TEST_X], state[sv.TEST_Y] = 30.0, 40.0
    ticked(state, stage)
    assert np.linalg.norm(state[sv.FORCE]) == pytest.approx(2e-3)
    ticked(state, stage, 1000)
    assert state[sv.FORCE] == pytest.approx([0.6, 0.8, 0.0])
    assert np.linalg.norm(state[sv.FORCE]) <= LARGEST_FORCE + 1e-12


def test_the_test_force_goes_to_zero_at_once(state):
    stage = Service().stage()
    state[sv.TEST_Z] = 1.0
    ticked(state, stage, 600)
    state[sv.TEST_Z] = 0.0
    assert ticked(state, stage)[sv.FORCE_Z] == 0.0


@pytest.mark.parametrize("slot", [sv.TEST_LEFT, sv.TEST_RIGHT])
@pytest.mark.parametrize("wanted", [1.0, -1.0, 1e300, float("nan"), float("inf")])
def test_test_torques_are_bounded_and_finite(state, slot, wanted):
    state[slot] = wanted
    ticked(state, Service().stage())
    joint = state[sv.JOINT_LEFT if slot == sv.TEST_LEFT else sv.JOINT_RIGHT]
    assert abs(joint) == (LARGEST_TORQUE if np.isfinite(wanted) else 0.0)


def test_nothing_is_pushed_while_disarmed_and_the_ramp_begins_anew(state):
    stage = Service().stage()
    state[sv.TEST_X], state[sv.TEST_LEFT] = 1.0, 0.03
    ticked(state, stage, 600)
    state[sv.ENABLED] = 0.0
    ticked(state, stage)
    assert state[sv.FORCE_X] == 0.0
    assert state[sv.JOINT_LEFT] == 0.0
    state[sv.ENABLED] = 1.0
    assert ticked(state, stage)[sv.FORCE_X] == pytest.approx(2e-3)


def test_a_force_that_is_no_number_is_no_force(state):
    stage = Service().stage()
    state[sv.TEST_X] = np.nan
    ticked(state, stage, 10)
    assert not state[sv.FORCE].any()


def test_a_reading_is_corrected_once_whether_or_not_the_link_has_news(state):
    stage = Corrections((0.1, -0.2), (0.5, 2.0)).stage()
    state[sv.GAUGE] = 1.0
    state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.GAUGE_FORCE] = 1.0, 2.0, 1.0
    for tick in range(5):  # no news: the slots stay as the stage left them
        ticked(state, stage)
        assert state[sv.Q] == pytest.approx([1.1, 1.8]), tick
        assert state[sv.GAUGE_FORCE] == pytest.approx(1.0)
    for tick in range(5):  # news in each tick, also where the angles are the same
        state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.Q_TIME] = 1.0, 2.0, 1.0 + tick
        state[sv.GAUGE_FORCE] = 1.5
        ticked(state, stage)
        assert state[sv.Q] == pytest.approx([1.1, 1.8])
        assert state[sv.GAUGE_FORCE] == pytest.approx(2.0)


def test_a_gauge_reading_equal_to_the_corrected_one_before_is_corrected_too(state):
    stage = Corrections(gauge=(0.5, 2.0)).stage()
    state[sv.GAUGE], state[sv.GAUGE_FORCE], state[sv.Q_TIME] = 1.0, 0.5, 1.0
    ticked(state, stage)
    assert state[sv.GAUGE_FORCE] == 0.0
    state[sv.GAUGE_FORCE], state[sv.Q_TIME] = 0.0, 2.0
    ticked(state, stage)
    assert state[sv.GAUGE_FORCE] == -1.0


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_corrections_that_are_no_numbers_are_refused_and_those_in_use_stay(bad):
    corrections = Corrections((0.1, -0.2), (0.5, 2.0))
    with pytest.raises(DeviceError, match="encoder offsets"):
        corrections.set_offsets(0.0, bad)
    with pytest.raises(DeviceError, match="gauge"):
        corrections.set_gauge(bad, 1.0)
    assert corrections.offsets == (0.1, -0.2)
    assert corrections.gauge == (0.5, 2.0)


def test_a_reading_equal_to_the_corrected_one_before_is_corrected_too(state):
    stage = Corrections((0.1, 0.1)).stage()
    state[sv.Q_LEFT] = state[sv.Q_RIGHT] = 0.0
    ticked(state, stage)
    state[sv.Q_LEFT] = state[sv.Q_RIGHT] = 0.1
    state[sv.Q_TIME] = 1e-3
    ticked(state, stage)
    assert state[sv.Q_LEFT] == pytest.approx(0.2)


def test_an_angle_that_is_no_number_stays_none_and_does_no_harm_later(state):
    stage = Corrections((0.1, 0.1)).stage()
    state[sv.Q_LEFT], state[sv.Q_RIGHT] = np.nan, 0.0
    ticked(state, stage)
    assert np.isnan(state[sv.Q_LEFT])
    state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.Q_TIME] = 1.0, 1.0, 1e-3
    ticked(state, stage)
    assert state[sv.Q_LEFT] == pytest.approx(1.1)
