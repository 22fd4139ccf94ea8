"""Lever and force relations: virtual work, the printed law, torques."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.mechanisms.pantograph import (
    felt_force,
    force_map,
    inverse,
    jacobian,
    joint_torques,
    lever_map,
    needle_at,
    printed_force,
    tool_force,
)
from app.mechanisms.profile import load_profile

GEOMETRY = load_profile("icube").pantograph
RELAXED = settings(derandomize=True, deadline=None, max_examples=60)
components = st.floats(-5.0, 5.0)
tilts = st.floats(0.0, np.radians(45.0))
azimuths = st.floats(-np.pi, np.pi)


def tool_point(tilt: float, azimuth: float) -> np.ndarray:
    reach = GEOMETRY.fulcrum[2] * np.tan(tilt)
    return GEOMETRY.fulcrum[:2] + reach * np.array([np.cos(azimuth), np.sin(azimuth)])


def needle(tilt: float, azimuth: float, l_out: float = 0.1):
    return needle_at(GEOMETRY, tool_point(tilt, azimuth), l_out)


def across(state, force: np.ndarray) -> np.ndarray:
    return force - state.axis * np.dot(state.axis, force)


@RELAXED
@given(tilts, azimuths, st.floats(0.02, 0.2))
def test_the_lever_map_is_the_derivative_of_the_hub_across_the_needle(tilt, azimuth, l_out):
    p3, step = tool_point(tilt, azimuth), 1e-6
    columns = [
        (
            needle_at(GEOMETRY, p3 + step * e, l_out).hub
            - needle_at(GEOMETRY, p3 - step * e, l_out).hub
        )
        / (2.0 * step)
        for e in np.eye(2)
    ]
    assert lever_map(needle_at(GEOMETRY, p3, l_out)) == pytest.approx(
        np.column_stack(columns), abs=1e-8
    )


@RELAXED
@given(tilts, azimuths, st.tuples(components, components, components))
def test_force_and_torque_do_the_same_work_as_the_hand(tilt, azimuth, force):
    state = needle(tilt, azimuth)
    j = jacobian(GEOMETRY, inverse(GEOMETRY, state.p3))
    torques = joint_torques(j, force_map(state, force))
    for rate in np.eye(2):
        hand = np.dot(lever_map(state) @ (j @ rate), force)
        assert np.dot(torques, rate) == pytest.approx(hand, abs=1e-14)


@RELAXED
@given(tilts, azimuths, st.tuples(components, components, components))
def test_what_is_felt_is_the_part_of_the_wanted_force_across_the_needle(tilt, azimuth, force):
    state = needle(tilt, azimuth)
    felt = felt_force(state, force_map(state, force))
    assert felt == pytest.approx(across(state, np.array(force)), abs=1e-14)


@RELAXED
@given(tilts, azimuths, st.tuples(components, components))
def test_torques_give_the_tool_force_back(tilt, azimuth, gamma):
    j = jacobian(GEOMETRY, inverse(GEOMETRY, tool_point(tilt, azimuth)))
    assert tool_force(j, joint_torques(j, gamma)) == pytest.approx(gamma, abs=1e-13)


@pytest.mark.parametrize(("tilt_deg", "gain"), [(0, 1.0), (30, 4 / 3), (39, 1.6558), (45, 2.0)])
def test_the_printed_law_delivers_more_than_wanted_in_the_tilt_plane(tilt_deg, gain):
    for azimuth in np.linspace(0.0, 6.0, 7):
        state = needle(np.radians(tilt_deg), azimuth)
        outwards = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        wanted = across(state, outwards)
        felt = felt_force(state, printed_force(state, wanted))
        assert np.linalg.norm(felt) / np.linalg.norm(wanted) == pytest.approx(gain, abs=1e-4)


@pytest.mark.parametrize("tilt_deg", [0, 30, 39, 45])
def test_the_printed_law_is_right_sideways(tilt_deg):
    for azimuth in np.linspace(0.0, 6.0, 7):
        state = needle(np.radians(tilt_deg), azimuth)
        sideways = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
        felt = felt_force(state, printed_force(state, sideways))
        assert felt == pytest.approx(sideways, abs=1e-12)


def test_the_vector_form_of_the_printed_law_equals_equation_4_12():
    """4.12: F_guide L_out/L_in / sqrt(1 - (cos φ cos(θ - α))²), φ elevation, α force direction."""
    tilt, theta = np.radians(33.0), 0.7
    state = needle(tilt, theta + np.pi)
    phi = np.pi / 2 - tilt
    for alpha in np.linspace(0.1, 3.0, 5):
        horizontal = np.array([np.cos(alpha), np.sin(alpha), 0.0])
        wanted = across(state, horizontal)
        wanted /= np.linalg.norm(wanted)
        factor = state.l_out / state.l_in / np.sqrt(1 - (np.cos(phi) * np.cos(theta - alpha)) ** 2)
        assert printed_force(state, wanted) == pytest.approx(-factor * horizontal[:2], abs=1e-12)


def test_five_newtons_at_the_hand_need_less_than_the_torque_limit_anywhere():
    limit = load_profile("icube").limits.joint_torque
    for tilt in np.radians([0.0, 20.0, 39.0, 45.0]):
        for azimuth in np.linspace(0.0, 6.0, 9):
            state = needle_at(GEOMETRY, tool_point(tilt, azimuth))
            j = jacobian(GEOMETRY, inverse(GEOMETRY, state.p3))
            for turn in np.linspace(0.0, 6.0, 13):
                force = across(state, np.array([np.cos(turn), np.sin(turn), 0.0]))
                force *= 5.0 / np.linalg.norm(force)
                assert np.abs(joint_torques(j, force_map(state, force))).max() < limit
