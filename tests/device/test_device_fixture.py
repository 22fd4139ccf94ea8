"""The virtual fixture: the gradient of its potential, dissipating, bounded."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.core.arrays import angle_between
from app.device.control.fixture import VirtualFixture, fixture_potential

RELAXED = settings(derandomize=True, deadline=None, max_examples=80)
L_OUT = 0.11
WEAK = VirtualFixture(stiffness=0.7, damping=0.0, limit=5.0)

directions = st.tuples(*(st.floats(-1.0, 1.0),) * 3).filter(
    lambda v: 0.1 < float(np.linalg.norm(v)) < 1.0
)


def guide(fixture: VirtualFixture, axis, path, velocity=(0.0, 0.0, 0.0), assistance=1.0):
    state = sv.empty_state()
    state[sv.ASSISTANCE] = assistance
    state[sv.AXIS_X : sv.AXIS_Z + 1] = axis
    state[sv.PATH_X : sv.PATH_Z + 1] = path
    state[sv.HUB_VX : sv.HUB_VZ + 1] = velocity
    _, function, parameters = fixture.stage()
    function(state, parameters)
    assert (
        state[sv.FORCE_X : sv.FORCE_Z + 1].tolist() == state[sv.GUIDE_X : sv.GUIDE_Z + 1].tolist()
    )
    return state[sv.GUIDE_X : sv.GUIDE_Z + 1].copy()


def unit(v) -> np.ndarray:
    return np.array(v) / np.linalg.norm(v)


@RELAXED
@given(directions, directions, directions)
def test_the_force_is_minus_the_gradient_of_the_potential(axis, path, probe):
    """Moving the hub by s across the needle turns the axis by -s / L_out."""
    d, p = unit(axis), unit(path)
    across = np.array(probe) - d * np.dot(d, probe)
    if np.linalg.norm(across) < 1e-3 or angle_between(d, p) > 3.1:
        return
    across, step = unit(across), 1e-6

    def energy(s: float) -> float:
        turned = -(-L_OUT * d + s * across)
        return fixture_potential(angle_between(turned, p), WEAK.stiffness, L_OUT)

    slope = (energy(step) - energy(-step)) / (2.0 * step)
    assert np.dot(guide(WEAK, d, p), across) == pytest.approx(-slope, abs=2e-6)


@RELAXED
@given(directions, directions)
def test_the_force_is_across_the_needle_and_in_its_plane_with_the_path(axis, path):
    d, p = unit(axis), unit(path)
    force = guide(WEAK, d, p)
    assert np.dot(force, d) == pytest.approx(0.0, abs=1e-12)
    assert np.dot(force, np.cross(d, p)) == pytest.approx(0.0, abs=1e-12)
    assert np.dot(force, p) <= 1e-12  # the hub is pushed away from the path: the tip follows it


@RELAXED
@given(directions, directions, directions, st.floats(0.0, 1.0))
def test_the_damper_takes_energy_out(axis, path, velocity, assistance):
    d = unit(axis)
    v = np.array(velocity) - d * np.dot(d, velocity)
    fixture = VirtualFixture(stiffness=0.7, damping=1.5, limit=1e9)
    still, moving = guide(fixture, d, path, assistance=assistance), None
    moving = guide(fixture, d, path, v, assistance)
    assert np.dot(moving - still, v) <= 1e-15
    assert moving - still == pytest.approx(-assistance * 1.5 * v, abs=1e-12)


def test_the_force_grows_with_the_angle_and_with_the_dial():
    fixture = VirtualFixture(stiffness=10.0, damping=0.0, limit=5.0)
    for angle in (1e-9, 1e-4, 0.1, 0.3):
        path = (np.sin(angle), 0.0, -np.cos(angle))
        for dial in (0.25, 1.0):
            force = guide(fixture, (0.0, 0.0, -1.0), path, assistance=dial)
            assert np.linalg.norm(force) == pytest.approx(dial * 10.0 * angle, rel=1e-6)


def test_the_dial_is_held_between_off_and_full():
    path = (0.1, 0.0, -1.0)
    full = guide(WEAK, (0.0, 0.0, -1.0), path, assistance=1.0)
    assert guide(WEAK, (0.0, 0.0, -1.0), path, assistance=7.0) == pytest.approx(full)
    for off in (0.0, -1.0, np.nan):
        assert not guide(WEAK, (0.0, 0.0, -1.0), path, assistance=off).any()


@RELAXED
@given(directions, directions, directions)
def test_the_limit_keeps_the_direction(axis, path, velocity):
    d = unit(axis)
    v = np.array(velocity) - d * np.dot(d, velocity)
    free = guide(VirtualFixture(100.0, 50.0, 1e9), d, path, v)
    held = guide(VirtualFixture(100.0, 50.0, 5.0), d, path, v)
    assert np.linalg.norm(held) == pytest.approx(min(5.0, np.linalg.norm(free)), abs=1e-9)
    assert np.linalg.norm(np.cross(free, held)) <= 1e-9 * max(1.0, np.linalg.norm(free))


def test_the_path_needs_no_unit_length():
    one = guide(WEAK, (0.0, 0.0, -1.0), (0.3, 0.1, -1.0))
    assert guide(WEAK, (0.0, 0.0, -1.0), (30.0, 10.0, -100.0)) == pytest.approx(one)
