"""The pure functions of safety, over anything that can come in."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.device.control.safety import (
    cap,
    fade,
    inwards,
    ramp,
    slew_factor,
    tilt_kernel,
    torque_factor,
)

anything = st.floats(allow_nan=True, allow_infinity=True)
torque = st.floats(-2.0, 2.0)
many = settings(derandomize=True, deadline=None, max_examples=300)


@many
@given(anything, anything)
def test_torques_are_brought_within_their_limit_in_their_direction(left, right):
    factor = torque_factor(left, right, 0.6)
    assert 0.0 <= factor <= 1.0
    if np.isfinite(left + right):
        assert max(abs(factor * left), abs(factor * right)) <= 0.6 * (1.0 + 1e-12)
        assert factor == 1.0 or max(abs(left), abs(right)) > 0.6
    else:
        assert factor == 0.0 or max(abs(left), abs(right)) <= 1.8e308


@many
@given(torque, torque, torque, torque, st.floats(0.0, 0.5))
def test_torques_grow_no_faster_than_the_slew_limit_and_keep_their_direction(a, b, c, d, step):
    factor = slew_factor(a, b, c, d, step)
    assert 0.0 <= factor <= 1.0
    for wanted, last in ((a, c), (b, d)):
        assert abs(factor * wanted) <= step + abs(last) + 1e-12
        if wanted * last <= 0.0:
            assert abs(factor * wanted) <= step + 1e-12


@many
@given(torque, torque, st.floats(0.0, 1.0), st.floats(0.0, 0.5))
def test_torques_that_fall_are_never_delayed(left, right, share, step):
    assert slew_factor(share * left, share * right, left, right, step) == 1.0


@many
@given(anything, anything, anything, anything, anything)
def test_the_slew_factor_is_a_factor_whatever_comes_in(a, b, c, d, step):
    factor = slew_factor(a, b, c, d, step)
    assert 0.0 <= factor <= 1.0


@pytest.mark.long("machine")
@many
@given(anything, st.floats(0.0, 1.0), st.floats(1.001, 2.0))
def test_the_fade_is_a_factor_that_only_falls_with_age(age, start, end):
    assert 0.0 <= fade(age, start, end) <= 1.0
    if np.isfinite(age):
        assert fade(1.1 * age, start, end) <= fade(age, start, end)


@many
@given(st.floats(0.0, 1.0), anything, st.booleans())
def test_the_arming_ramp_stays_within_0_and_1_and_is_0_disarmed(previous, dt, armed):
    value = ramp(previous, dt, 1.0, armed)
    assert 0.0 <= value <= 1.0
    assert armed or value == 0.0


@many
@given(anything, anything)
def test_the_cap_is_the_smallest_of_the_limits_and_zero_for_no_number(cleared, homed):
    value = cap(5.0, cleared, homed, 0.3)
    assert 0.0 <= value <= 5.0
    if np.isfinite(cleared):
        assert value <= max(cleared, 0.0)
    if not homed >= 1.0:
        assert value <= 0.3
    assert cap(5.0, 0.0, 1.0, 0.3) == 0.0


@pytest.mark.long("machine")
@many
@given(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0), st.floats(-3.0, 3.0), st.floats(0.0, 1.2))
def test_beyond_the_tilt_limit_only_the_outward_part_fades(gx, gy, azimuth, tilt):
    out = np.array([np.cos(azimuth), np.sin(azimuth)])
    side = np.array([-out[1], out[0]])
    direction = np.sin(tilt) * out
    force = np.array([gx, gy])
    passed = np.array(inwards(gx, gy, *direction, tilt, 0.6, 0.035))
    assert passed @ side == pytest.approx(force @ side, abs=1e-9)
    if tilt <= 0.6 or force @ out <= 0.0:
        assert passed == pytest.approx(force, abs=1e-9)
    else:
        assert -1e-9 <= passed @ out <= force @ out + 1e-9
    if tilt >= 0.636:
        assert passed @ out <= 1e-9


def test_the_outward_part_fades_without_a_jump():
    tilts = 0.6 + np.linspace(-0.01, 0.05, 6001)
    force = [inwards(3.0, 1.0, np.sin(t), 0.0, t, 0.6, 0.035)[0] for t in tilts]
    assert np.abs(np.diff(force)).max() < 3.0 * 1e-5 / 0.035 * 1.01


def test_the_tilt_is_exact_for_an_upright_needle_and_defined_for_every_direction():
    assert tilt_kernel(0.0, 0.0, -1.0) == 0.0
    assert tilt_kernel(0.0, 0.0, 0.0) == 0.0
    assert tilt_kernel(1e-12, 0.0, -1.0) == pytest.approx(1e-12)
    assert tilt_kernel(0.0, 0.0, 1.0) == pytest.approx(np.pi)
    assert tilt_kernel(1.0, 0.0, 0.0) == pytest.approx(np.pi / 2)
