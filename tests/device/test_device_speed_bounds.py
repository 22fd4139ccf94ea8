"""What torques can do to a free needle: the bounds hold for every inertia and depth possible."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control.governor import SpeedGovernor
from app.device.control.speed_bounds import BODY, HEAVIEST, needle_inertias, stoppable, turning
from app.mechanisms.pantograph import dynamic_terms, inverse, jacobian, needle_at
from app.mechanisms.profile import load_profile

PROFILES = {name: load_profile(name) for name in ("icube", "haply-2diy")}


def heavier(profile, needle):
    """The profile with a needle `needle` times as heavy."""
    part = profile.inertia
    changed = {"needle_mass": needle * part.needle_mass}
    return profile.model_copy(update={"inertia": part.model_copy(update=changed)})


def scaled(profile, factors):
    """The profile with proximal links and rotors, distal links, tool, needle times a factor."""
    names = (
        ("proximal_mass", "proximal_inertia", "rotor_inertia"),
        ("distal_mass", "distal_inertia"),
        ("tool_mass",),
        ("needle_mass", "needle_inertia"),
    )
    part = profile.inertia
    changed = {
        n: f * getattr(part, n) for f, group in zip(factors, names, strict=True) for n in group
    }
    return profile.model_copy(update={"inertia": part.model_copy(update=changed)})


def pose(profile, tilt, azimuth):
    """State at a pose, joint angles, and the needle's turning per joint angle R, shape (3, 2)."""
    geometry = profile.pantograph
    away = geometry.fulcrum[2] * np.tan(tilt) * np.array([np.cos(azimuth), np.sin(azimuth)])
    needle = needle_at(geometry, geometry.fulcrum[:2] + away)
    q = inverse(geometry, needle.p3)
    j = jacobian(geometry, q)
    state = sv.empty_state()
    state[[sv.Q_LEFT, sv.Q_RIGHT]], state[[sv.P3_X, sv.P3_Y]] = q, needle.p3
    state[[sv.J_XL, sv.J_XR, sv.J_YL, sv.J_YR]] = j.ravel()
    state[sv.AXIS], state[sv.L_IN] = needle.axis, needle.l_in
    _, function, parameters = profile.machine.stages().pose
    function(state, parameters)
    across = np.eye(3) - np.outer(needle.axis, needle.axis)
    return state, q, -(across[:, :2] @ j) / needle.l_in


@pytest.mark.long("machine")
@settings(derandomize=True, deadline=None, max_examples=150)
@given(
    name=st.sampled_from(sorted(PROFILES)),
    needle=st.sampled_from([0.2, 1.0, 1.0, 8.0]),
    tilt=st.floats(0.0, 1.0),
    azimuth=st.floats(-3.1, 3.1),
    torque=st.tuples(st.floats(-0.6, 0.6), st.floats(-0.6, 0.6)),
    factors=st.tuples(*[st.sampled_from([0.7, 1.0, 1.3])] * 4),
    ends=st.tuples(st.floats(0.0, 1.0), st.floats(0.0, 1.0)),
    inside=st.floats(0.0, 1.0),
)
def test_no_inertia_and_no_depth_within_the_bounds_gets_faster_or_more_energetic(
    name, needle, tilt, azimuth, torque, factors, ends, inside
):
    profile = heavier(PROFILES[name], needle)
    low, high = profile.depth_range
    shallow, deep = (low + e * (high - low) for e in sorted(ends))
    state, q, turns = pose(profile, tilt * profile.tilt_limit, azimuth)
    p = SpeedGovernor.of(profile).stage()[2]
    size, *_, inertia = turning(state, p, *torque, shallow, deep)
    depth = shallow + inside * (deep - shallow)
    model = scaled(profile, factors).dynamic_model
    mass = dynamic_terms(model, q, (0.0, 0.0), depth).mass
    length = profile.geometry.needle_length
    hub = (length - depth) * np.linalg.norm(turns @ np.linalg.solve(mass, torque))
    assert hub <= (length - shallow) * size * (1.0 + 1e-9) + 1e-6
    speed = 0.01 * np.linalg.solve(mass, torque)  # after 10 ms under this torque
    energy = 0.5 * speed @ mass @ speed
    rate = np.linalg.norm(turns @ speed)
    assert energy <= 0.5 * HEAVIEST * inertia * rate**2 * (1.0 + 1e-9) + 1e-15


@pytest.mark.parametrize("name", PROFILES)
def test_the_bounds_are_met_by_the_lightest_and_the_heaviest_robot(name):
    profile = PROFILES[name]
    state, q, turns = pose(profile, 0.3, 1.0)
    p = SpeedGovernor.of(profile).stage()[2]
    light = dynamic_terms(scaled(profile, (0.7,) * 4).dynamic_model, q, (0.0, 0.0), 0.01).mass
    closest = 0.0
    for angle in np.linspace(0.0, np.pi, 181):
        torque = 0.1 * np.array([np.cos(angle), np.sin(angle)])
        size, *_ = turning(state, p, *torque, 0.01, 0.01)
        closest = max(closest, np.linalg.norm(turns @ np.linalg.solve(light, torque)) / size)
    assert closest == pytest.approx(1.0, abs=1e-3)


def test_a_light_needle_is_fastest_drawn_out_and_a_heavy_one_may_not_be():
    profile = PROFILES["icube"]
    low, high = profile.depth_range
    for needle, drawn_out in ((1.0, True), (30.0, False)):
        p = SpeedGovernor.of(heavier(profile, needle)).stage()[2]
        light, heavy = needle_inertias(low, high, 1.7e-3, p)
        centre = low + p[BODY.needle_centre] - p[BODY.needle_length]
        farthest = p[BODY.needle_inertia] + p[BODY.needle_mass] * centre**2
        assert heavy == pytest.approx(farthest)
        assert light == pytest.approx(farthest if drawn_out else p[BODY.needle_inertia])


@settings(derandomize=True, deadline=None)
@given(st.floats(0.0, 5.0), st.floats(1e-6, 1e-2), st.floats(1e-4, 5e-3))
def test_the_strongest_acceleration_that_can_be_stopped_uses_all_the_room(room, doubt, step):
    a = stoppable(room, doubt, step)
    assert 2.0 * np.sqrt(doubt * a) + a * step == pytest.approx(room, rel=1e-6, abs=1e-9)
    assert stoppable(-room, doubt, step) == 0.0
