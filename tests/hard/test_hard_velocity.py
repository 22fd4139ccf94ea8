"""Velocity estimators at their worst: hours of rest, wraps, late and frozen clocks, any input."""

from math import pi
from time import perf_counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control import kernel
from app.device.control.velocity import FASTEST, VelocityMethod, velocity_stage
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
COUNT = 2.0 * pi / PROFILE.encoder.counts_per_turn
SMALLEST = np.finfo(np.float64).tiny
anything = st.floats(allow_nan=True, allow_infinity=True)
every_method = pytest.mark.parametrize("method", VelocityMethod)


def fresh(method):
    _, function, memory = velocity_stage(PROFILE, method)
    return sv.empty_state(), function, memory


def tick(state, function, memory, time, dt, left, right=0.5):
    state[sv.TIME] = state[sv.Q_TIME] = time
    state[sv.DT], state[sv.Q_LEFT], state[sv.Q_RIGHT] = dt, left, right
    function(state, memory)
    return state[[sv.QD_LEFT, sv.QD_RIGHT]]


def repeated(method, ticks, state=None, memory=None):
    """Run ticks without stamps at one reading, compiled; return state, memory and seconds."""
    fresh_state, function, fresh_memory = fresh(method)
    state = fresh_state if state is None else state
    memory = fresh_memory if memory is None else memory
    functions, values = kernel.no_stages(), kernel.no_parameters()
    kernel.append(functions, values, function, memory)
    start = perf_counter()
    kernel.repeat(state, functions, values, ticks)
    return state, memory, perf_counter() - start


@every_method
def test_ten_minutes_at_rest_after_a_movement_leave_no_subnormal_number(method):
    state, function, memory = fresh(method)
    for k in range(300):
        tick(state, function, memory, 1.0 + 1e-3 * k, 1e-3, 2.5 + 1e-4 * k)
    state[sv.Q_TIME] = 0.0  # without stamps each tick counts as a reading
    repeated(method, 600_000, state, memory)
    assert state[sv.QD_LEFT] == state[sv.QD_RIGHT] == 0.0
    live = np.abs(memory[memory != 0.0])
    assert np.isfinite(memory).all()
    assert live.min() > 1e6 * SMALLEST


@every_method
@pytest.mark.parametrize("wrap", [2.0 * pi, -2.0 * pi, 65536 * COUNT, 1e308, -1e308])
def test_an_encoder_that_wraps_is_no_movement(method, wrap):
    state, function, memory = fresh(method)
    found = []
    for k in range(600):
        turned = 2.0 + 0.2e-3 * k + (wrap if k >= 300 else 0.0)
        found.append(tick(state, function, memory, 1.0 + 1e-3 * k, 1e-3, turned).copy())
    assert np.isfinite(found).all()
    assert np.abs(found)[300:].max() < 0.5
    if abs(wrap) < 1e3:
        assert found[-1][0] == pytest.approx(0.2, rel=0.01)


@every_method
def test_a_clock_that_stands_still_keeps_the_velocity_and_then_goes_on(method):
    state, function, memory = fresh(method)
    for k in range(300):
        moving = tick(state, function, memory, 1.0 + 1e-3 * k, 1e-3, 2.0 + 0.2e-3 * k).copy()
    for _ in range(500):
        still = tick(state, function, memory, 1.299, 0.0, 2.0 + 0.2e-3 * 299).copy()
        assert (still == moving).all()
    for k in range(300, 900):
        after = tick(state, function, memory, 1.0 + 1e-3 * k, 1e-3, 2.0 + 0.2e-3 * k)
        assert abs(after[0]) < 0.5
    assert after[0] == pytest.approx(0.2, rel=1e-3)


@every_method
@pytest.mark.parametrize("late", [0.005, 0.020, 0.100])
def test_a_late_tick_never_shows_as_a_burst_of_speed(method, late):
    state, function, memory = fresh(method)
    time, worst = 1.0, 0.0
    for k in range(900):
        gap = late if k in (300, 301, 600) else 1e-3
        time += gap
        angle = np.floor((2.0 + 0.2 * time) / COUNT + 0.5) * COUNT
        dt = min(gap, 5e-3)  # as the loop clamps it
        found = tick(state, function, memory, time, dt, angle)[0]
        worst = max(worst, abs(found)) if k > 250 else worst
    assert worst <= 0.2 + COUNT / 1e-3 + 1e-9


@pytest.mark.long("statistics")
@every_method
@settings(derandomize=True, deadline=None, max_examples=100)
@given(
    st.lists(st.tuples(anything, anything, anything, anything, anything), min_size=1, max_size=40)
)
def test_whatever_comes_in_the_velocity_is_bounded_and_recovers(method, readings):
    state, function, memory = fresh(method)
    for time, stamp, dt, left, right in readings:
        state[sv.TIME], state[sv.Q_TIME], state[sv.DT] = time, stamp, dt
        state[sv.Q_LEFT], state[sv.Q_RIGHT] = left, right
        function(state, memory)
        assert np.abs(state[[sv.QD_LEFT, sv.QD_RIGHT]]).max() <= FASTEST
    for k in range(1500):
        found = tick(state, function, memory, 10.0 + 1e-3 * k, 1e-3, 2.0 + 0.2e-3 * k)
    assert found[0] == pytest.approx(0.2, rel=1e-3)
    assert abs(found[1]) < 1e-6
