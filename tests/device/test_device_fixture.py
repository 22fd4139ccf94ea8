"""The virtual fixture: guides, does nothing, repels; the gradient of its potential, bounded."""

from itertools import pairwise

import numpy as np
import pytest
from device.law_rig import (
    PROFILE,
    RELAXED,
    OneLaw,
    across,
    azimuths,
    depths,
    directions,
    leaning,
    pose,
    tilts,
    unit,
)
from hypothesis import given
from hypothesis import strategies as st
from virtual_fixture import VirtualFixture

from app.core import state_vector as sv
from app.core.arrays import angle_between
from app.device.control.laws.fixture import DEAD_ZONE, dial_gain

DOWN = (0.0, 0.0, -1.0)
dials = st.floats(-1.0, 1.0)


def at(d, path, dial=1.0, depth=0.06, velocity=(0.0, 0.0, 0.0)):
    x, y, z = path
    return pose(d, depth, velocity, path_x=x, path_y=y, path_z=z, assistance=dial)


def guide(fixture, axis, path, velocity=(0.0, 0.0, 0.0), dial=1.0):
    state = at(axis, path, dial, velocity=velocity)
    _, function, parameters = fixture.stage()
    function(state, parameters)
    return state[sv.FORCE].copy()


@RELAXED
@given(directions, directions, directions, dials, depths)
def test_the_force_is_minus_the_gradient_of_the_potential(axis, path, probe, dial, depth):
    d, p = unit(axis), unit(path)
    if angle_between(d, p) > 3.1:
        return
    state, side, law = at(d, p, dial, depth), across(d, probe), OneLaw("fixture", damping=0.0)
    slope = law.slope(state, side)
    assert np.dot(law.force(state), side) == pytest.approx(-slope, abs=1e-4)


@RELAXED
@given(tilts, azimuths, tilts, azimuths, dials, depths)
def test_force_and_energy_stay_within_their_bounds_all_over_the_workspace(a, b, c, e, dial, depth):
    state = at(leaning(a, b), leaning(c, e), dial, depth, (0.3, -0.2, 0.1))
    law = OneLaw("fixture")
    done = law.run(state)
    assert np.linalg.norm(done[sv.FORCE]) <= PROFILE.limits.hand_force + 1e-9
    assert 0.0 <= done[sv.POTENTIAL] <= law.bound


@RELAXED
@given(directions, directions, dials)
def test_the_force_is_across_the_needle_and_in_its_plane_with_the_path(axis, path, dial):
    d, p = unit(axis), unit(path)
    force = OneLaw("fixture").force(at(d, p, dial))
    assert np.dot(force, d) == pytest.approx(0.0, abs=1e-12)
    assert np.dot(force, np.cross(d, p)) == pytest.approx(0.0, abs=1e-12)
    # Guiding pushes the hub away from the path's direction: the tip follows it. Repelling pulls.
    assert np.dot(force, p) * np.sign(dial) <= 1e-12


@RELAXED
@given(directions, directions, directions, dials)
def test_the_damper_takes_energy_out_whichever_way_the_dial_stands(axis, path, velocity, dial):
    d, p = unit(axis), unit(path)
    v = 0.03 * (np.array(velocity) - d * np.dot(d, velocity))  # slower than the repulsion fades
    still = OneLaw("fixture").force(at(d, p, dial))
    moving = OneLaw("fixture").force(at(d, p, dial, velocity=v))
    assert np.dot(moving - still, v) <= 1e-12


@RELAXED
@given(directions, directions, directions)
def test_within_the_limit_the_damper_is_full_and_beyond_it_only_the_damper_gives_way(
    axis, path, velocity
):
    d = unit(axis)
    v = np.array(velocity) - d * np.dot(d, velocity)
    if np.linalg.norm(v) < 1e-3:
        return
    spring = guide(VirtualFixture(100.0, 0.0, 5.0), d, path)
    both = guide(VirtualFixture(100.0, 50.0, 5.0), d, path, v)
    assert np.linalg.norm(both) <= 5.0 + 1e-9
    assert np.linalg.norm(np.cross(both - spring, v)) <= 1e-9
    share = np.dot(spring - both, v) / (50.0 * np.dot(v, v))
    assert -1e-9 <= share <= 1.0 + 1e-9
    assert share >= 1.0 - 1e-9 or np.linalg.norm(both) == pytest.approx(5.0)


def test_the_dial_has_a_dead_zone_and_is_continuous_outside():
    for dial in (0.0, DEAD_ZONE, -DEAD_ZONE, 0.0499, -1e-300, np.nan):
        assert dial_gain(dial) == 0.0
    turns = np.linspace(-1.0, 1.0, 4001)
    gains = np.array([dial_gain(turn) for turn in turns])
    assert gains[0] == -1.0
    assert gains[-1] == 1.0
    assert np.diff(gains).min() >= 0.0
    assert np.diff(gains).max() <= 0.0005 / 0.95 + 1e-12
    assert dial_gain(7.0) == 1.0


def test_the_blend_is_continuous_in_the_dial():
    d, p = np.array(DOWN), leaning(0.1, 0.4)
    forces = [OneLaw("fixture").force(at(d, p, dial)) for dial in np.linspace(-1.0, 1.0, 401)]
    assert np.linalg.norm(np.diff(forces, axis=0), axis=1).max() < 0.005 * 5.0 / 0.95 + 1e-9
    assert not np.any(forces[195:206])
    assert np.dot(forces[0], forces[-1]) < 0.0


def test_guidance_grows_with_the_angle_up_to_the_limit():
    fixture = VirtualFixture(stiffness=10.0, damping=0.0, limit=2.0)
    for angle in (1e-9, 1e-4, 0.1, 0.19, 0.3, 1.0):
        for dial in (0.25, 1.0):
            force = guide(fixture, DOWN, leaning(angle, 0.0), dial=dial)
            wanted = dial_gain(dial) * min(10.0 * angle, 2.0)
            assert np.linalg.norm(force) == pytest.approx(wanted, rel=1e-6)


def test_repulsion_is_nothing_on_the_path_largest_at_a_quarter_of_its_reach_and_then_ends():
    law = OneLaw("fixture", repulsion=1.5, reach=0.4, damping=0.0)
    angles = np.linspace(0.0, 0.5, 501)
    sizes = np.array([law.force(at(DOWN, leaning(a, 1.0), -1.0)) for a in angles])
    sizes = np.linalg.norm(sizes, axis=1)
    assert sizes[0] == 0.0
    assert angles[np.argmax(sizes)] == pytest.approx(0.1, abs=1e-9)
    assert sizes.max() == pytest.approx(1.5, rel=1e-6)
    assert not sizes[angles >= 0.4].any()
    assert np.abs(np.diff(sizes)).max() < 0.001 * 1.5 / 0.4 * 256.0 / 27.0


@RELAXED
@given(tilts, azimuths, azimuths, st.floats(0.0, 0.1))
def test_repulsion_has_ended_at_the_edge_of_the_workspace(tilt, azimuth, around, beyond):
    d = leaning(PROFILE.tilt_limit + beyond, around)
    force = OneLaw("fixture").force(at(d, leaning(tilt, azimuth), -1.0))
    assert np.linalg.norm(force) < 1e-30


def test_repulsion_fades_with_the_speed_along_it_and_never_against_it():
    d, p = np.array(DOWN), leaning(0.1, 0.0)
    law = OneLaw("fixture", damping=0.0)
    full = law.force(at(d, p, -1.0))
    for speed, share in ((0.05, 1.0), (0.125, 0.5), (0.2, 0.0), (3.0, 0.0), (-3.0, 1.0)):
        moving = law.force(at(d, p, -1.0, velocity=speed * unit(full)))
        assert moving == pytest.approx(share * full, abs=1e-12)


@pytest.mark.long("machine")
@RELAXED
@given(st.integers(0, 10_000))
def test_around_any_closed_motion_the_repulsion_gives_nothing_away(seed):
    """Work on the hand over a closed motion of the needle, at any speeds, is not positive."""
    rng = np.random.default_rng(seed)
    law, path = OneLaw("fixture", damping=0.0), leaning(0.2, 0.3)
    phase = np.linspace(0.0, 2.0 * np.pi, 400)
    shape = rng.normal(size=(2, 3)) * 0.2
    xy = [sum(c * np.sin((k + 1) * phase + k) for k, c in enumerate(row)) for row in shape]
    axes = [unit((x, y, -1.0)) for x, y in zip(*xy, strict=True)]
    work, l_out = 0.0, 0.14
    for before, after in pairwise(axes):
        middle, moved = unit(before + after), -l_out * (after - before)
        v = moved * 10.0 ** rng.uniform(-1.0, 3.0)
        work += np.dot(law.force(at(middle, path, -1.0, velocity=v)), moved)
    assert work <= 2e-4


@RELAXED
@given(st.lists(st.tuples(dials, tilts, azimuths, depths), min_size=2, max_size=30))
def test_every_change_of_the_potential_is_work_across_the_needle_or_counted_as_gain(turns):
    """With the direction at rest, all that the potential changes by is in GAIN_WORK."""
    law, d, before = OneLaw("fixture"), leaning(0.2, 0.0), 0.0
    for dial, tilt, azimuth, depth in turns:
        done = law.run(at(d, leaning(tilt, azimuth), dial, depth))
        assert done[sv.POTENTIAL] - before == pytest.approx(done[sv.GAIN_WORK], abs=1e-15)
        before = done[sv.POTENTIAL]
    held = law.run(at(leaning(0.25, 0.1), leaning(tilt, azimuth), dial, depth))
    assert held[sv.GAIN_WORK] == pytest.approx(0.0, abs=1e-15)


def test_while_armed_the_force_follows_the_dial_at_a_limited_rate():
    law, forces = OneLaw("fixture", dial_rate=4.0), []
    state = at(DOWN, leaning(0.1, 0.0), 1.0)
    state[sv.ARMING] = 1.0
    for _ in range(600):
        forces.append(law.force(state))
    steps = np.linalg.norm(np.diff(forces, axis=0), axis=1)
    assert steps.max() <= 4.0 * 1e-3 * 5.0 / 0.95
    assert np.linalg.norm(forces[-1]) == pytest.approx(0.1 * PROFILE.fixture.stiffness)


def test_the_path_needs_no_unit_length():
    one = guide(VirtualFixture(0.7, 0.0, 5.0), DOWN, (0.3, 0.1, -1.0))
    more = guide(VirtualFixture(0.7, 0.0, 5.0), DOWN, (30.0, 10.0, -100.0))
    assert more == pytest.approx(one)
