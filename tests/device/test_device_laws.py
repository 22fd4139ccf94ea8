"""Walls, forbidden regions, impedance, compensation: gradients of potentials, bounded, honest."""

import numpy as np
import pytest
from device.law_rig import (
    FULCRUM,
    GEOMETRY,
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
    with_dynamics,
    with_joints,
)
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control import laws
from app.device.control.laws.forbidden_region import nearest_kernel
from app.device.control.operational_space import velocity_torques
from app.device.errors import LawError
from app.mechanisms.pantograph import dynamic_terms, inverse, jacobian

FEW = settings(RELAXED, max_examples=12)
LIMIT = PROFILE.tilt_limit
UP = {"path_z": -1.0}
SPHERE = {
    f"{end}_{i}": v
    for end in ("from", "to")
    for i, v in zip("xyz", (0.012, 0.17, 0.03), strict=True)
}
RIB = SPHERE | {"to_x": -0.03, "to_y": 0.19, "to_z": 0.035}
REGIONS = st.sampled_from([SPHERE, RIB])
speeds = st.tuples(st.floats(-3.0, 3.0), st.floats(-3.0, 3.0))


# --- the wall ---------------------------------------------------------------------------------


@RELAXED
@given(st.floats(0.5, LIMIT + 0.03), azimuths, directions, depths)
def test_the_walls_force_is_minus_the_gradient_of_its_potential(tilt, azimuth, probe, depth):
    d, law = leaning(tilt, azimuth), OneLaw("cone_wall")
    state, side = pose(d, depth), across(d, probe)
    assert np.dot(law.force(state), side) == pytest.approx(-law.slope(state, side), abs=1e-3)
    done = law.run(state)
    assert 0.0 <= done[sv.POTENTIAL] <= law.bound


@RELAXED
@given(st.floats(0.0, 1.5), azimuths, directions, st.floats(0.0, 2.0))
def test_the_wall_only_pushes_inwards_and_within_its_limit(tilt, azimuth, velocity, speed):
    d = leaning(tilt, azimuth)
    v = speed * across(d, velocity)
    force = OneLaw("cone_wall").force(pose(d, 0.06, v))
    inwards = -(np.array([0.0, 0.0, -1.0]) + d * d[2])  # the hub leans the other way
    assert np.dot(force, inwards) >= 0.0
    assert np.linalg.norm(force) <= PROFILE.limits.hand_force + 1e-9
    if tilt < LIMIT - 0.052:
        assert not force.any()
    still = OneLaw("cone_wall").force(pose(d, 0.06))
    assert np.dot(force - still, v) <= 1e-12, "the damper takes energy"


def test_nothing_jumps_at_the_walls_face_however_fast_the_hand():
    face = LIMIT - 0.052
    law = OneLaw("cone_wall")
    v = np.array([-1.0, 0.0, 0.0])  # the hub outwards: the tip leans to +x
    forces = [
        law.force(pose(leaning(face + s, 0.0), 0.06, v)) for s in np.linspace(-1, 1, 401) * 1e-5
    ]
    assert np.linalg.norm(np.diff(forces, axis=0), axis=1).max() < 1e-4


# --- the forbidden region -----------------------------------------------------------------------


def brute_force(start, axis, d, length):
    t, u = np.meshgrid(np.linspace(0.0, length, 400), np.linspace(0.0, 1.0, 400))
    gap = t[..., None] * d - start - u[..., None] * axis
    return np.linalg.norm(gap, axis=-1).min()


@pytest.mark.long("machine")
@RELAXED
@given(directions, directions, directions, st.floats(0.0, 1.0))
def test_nearest_points_of_two_segments_are_nearest(start, axis, d, length):
    a, b, d = np.array(start), np.array(axis), unit(d)
    t, u = nearest_kernel(*a, *d, length, *b)
    assert 0.0 <= t <= length
    assert 0.0 <= u <= 1.0
    assert np.linalg.norm(t * d - a - u * b) <= brute_force(a, b, d, length) + 1e-12


@RELAXED
@given(REGIONS, st.floats(0.0, 0.5), azimuths, directions, depths)
def test_the_regions_force_is_minus_the_gradient_of_its_potential(
    region, tilt, azimuth, probe, depth
):
    d, law = leaning(tilt, azimuth), OneLaw("forbidden_region", **region, damping=0.0)
    state, side = pose(d, depth), across(d, probe)
    assert np.dot(law.force(state), side) == pytest.approx(-law.slope(state, side), abs=1e-3)


@RELAXED
@given(REGIONS, tilts, azimuths, depths, directions, st.floats(0.0, 0.12))
def test_the_regions_force_and_energy_stay_within_their_bounds(region, a, b, depth, v, ahead):
    law = OneLaw("forbidden_region", **region, ahead=0.1 * (ahead > 0.06))
    d = leaning(a, b)
    done = law.run(pose(d, depth, np.linalg.norm(v) * across(d, v)))
    force = done[sv.FORCE]
    assert np.linalg.norm(force) <= 3.0 + 1e-9
    assert np.dot(force, d) == pytest.approx(0.0, abs=1e-12)
    assert 0.0 <= done[sv.POTENTIAL] <= law.bound


def test_the_region_pushes_the_tip_away_from_itself_and_the_hub_the_other_way():
    centre = np.array([SPHERE[f"from_{i}"] for i in "xyz"])
    aim = unit(centre - FULCRUM)
    beside = unit(aim + 0.08 * across(aim, (1.0, 0.0, 0.0)))
    state = pose(beside, 0.06)
    force = OneLaw("forbidden_region", **SPHERE).force(state)
    assert np.linalg.norm(force) > 1.0
    turned = unit(beside - 1e-3 * force / state[sv.L_OUT])
    nearest = lambda d: np.linalg.norm(np.cross(centre - FULCRUM, d))  # noqa: E731
    assert nearest(turned) > nearest(beside)
    assert np.dot(force, beside - aim) < 0.0


def test_the_region_is_felt_only_once_the_needle_comes_near():
    centre = np.array([SPHERE[f"from_{i}"] for i in "xyz"])
    beside = unit(unit(centre - FULCRUM) + [0.05, 0.0, 0.0])
    law, sizes = OneLaw("forbidden_region", **SPHERE), []
    for depth in np.linspace(-0.03, 0.1, 1301):
        sizes.append(np.linalg.norm(law.force(pose(beside, depth))))
    assert sizes[0] == 0.0
    assert sizes[-1] > 0.5
    assert np.abs(np.diff(sizes)).max() < 0.05, "no jump as the needle slides"


@pytest.mark.parametrize(
    ("ends", "message"),
    [
        ((*FULCRUM, *FULCRUM), "the entry lies 0.0 mm from it"),
        ((*FULCRUM - [0, 0, 0.02], *FULCRUM - [0, 0, 0.06]), "axis points at the entry"),
    ],
)
def test_a_region_that_no_needle_can_avoid_is_refused(ends, message):
    names = [f"{end}_{i}" for end in ("from", "to") for i in "xyz"]
    with pytest.raises(LawError, match=message):
        laws.stages_of({"forbidden_region": dict(zip(names, ends, strict=True))}, PROFILE)


def test_a_region_needs_its_place():
    with pytest.raises(LawError, match=r"'forbidden_region' needs from_x \[m\]"):
        laws.stages_of({"forbidden_region": {}}, PROFILE)


# --- impedance ----------------------------------------------------------------------------------


def settled(law: OneLaw, state, ticks: int = 1500):
    for _ in range(ticks):
        done = law.run(state)
    return done


@FEW
@given(tilts, azimuths, st.floats(10.0, 3000.0))
def test_at_rest_the_impedance_is_two_springs_in_series(tilt, azimuth, stiffness):
    law = OneLaw("impedance", stiffness=stiffness, coupling=500.0, limit=10.0)
    state = with_joints(pose(leaning(tilt, azimuth), **UP))
    force = settled(law, state)[sv.FORCE]
    away = state[[sv.P3_X, sv.P3_Y]] - FULCRUM[:2]
    series = stiffness * 500.0 / (stiffness + 500.0)
    wanted = min(series * np.linalg.norm(away), 10.0)
    ratio = state[sv.L_IN] / state[sv.L_OUT]
    at_tool = -(force - 0.0)[:2] / ratio  # felt = -(L_in/L_out) γ in the plane
    assert np.linalg.norm(at_tool) == pytest.approx(wanted, rel=1e-3, abs=1e-6)
    assert np.dot(at_tool, away) <= 1e-9


@FEW
@given(tilts, azimuths, directions)
def test_the_coupling_force_is_minus_the_gradient_of_what_is_stored(tilt, azimuth, probe):
    law = OneLaw("impedance", coriolis=0.0)
    d = leaning(tilt, azimuth)
    settled(law, with_joints(pose(leaning(0.97 * tilt, azimuth + 0.02), **UP)), 300)
    frozen = with_joints(pose(d, **UP))
    frozen[sv.DT] = 0.0  # the virtual mass stands still
    kept = law.memory.copy()
    kept[11:13] = 0.0  # and is at rest, so that the coupling's damper is silent
    side = across(d, probe)

    def energy(s):
        turned = frozen.copy()
        turned[sv.AXIS] = unit(d - s / frozen[sv.L_OUT] * side)
        law.memory[:] = kept
        return law.energy(with_joints(turned))

    slope = (energy(1e-6) - energy(-1e-6)) / 2e-6
    law.memory[:] = kept
    force = law.force(frozen)
    stretch = kept[9:11] - frozen[[sv.P3_X, sv.P3_Y]]
    if np.linalg.norm(stretch) < 0.0049:  # below the coupling's saturation, 3 N / 600 N/m
        assert np.dot(force, side) == pytest.approx(-slope, abs=2e-4)


@FEW
@given(st.integers(0, 10_000), st.floats(0.02, 3.0), st.floats(0.0, 3000.0))
def test_force_and_energy_of_the_impedance_are_bounded_on_any_motion(seed, inertia, stiffness):
    rng = np.random.default_rng(seed)
    law = OneLaw("impedance", inertia=inertia, stiffness=stiffness)
    for _ in range(60):
        d = leaning(rng.uniform(0.0, LIMIT), rng.uniform(-4.0, 4.0))
        state = with_joints(
            pose(d, rng.uniform(*PROFILE.depth_range), **UP), rng.normal(size=2) * 9
        )
        state[sv.DT] = rng.choice([1e-3, 0.02, 0.1])
        done = law.run(state)
        felt = np.linalg.norm(done[[sv.FORCE_X, sv.FORCE_Y, sv.FORCE_Z]])
        most = 3.0 * state[sv.L_IN] / state[sv.L_OUT] / np.cos(LIMIT)
        assert felt <= most + 1e-9
        assert np.abs(done[[sv.JOINT_LEFT, sv.JOINT_RIGHT]]).max() <= 0.05 + 1e-12
        assert 0.0 <= done[sv.POTENTIAL] <= law.bound + 1e-12


@pytest.mark.long("machine")
@FEW
@given(st.integers(0, 10_000))
def test_the_impedance_gives_out_no_more_than_it_was_given(seed):
    """Over smooth motions from rest: work on the hand plus what is stored is not positive."""
    rng = np.random.default_rng(seed)
    law = OneLaw("impedance", coriolis=0.0, stiffness=300.0, limit=10.0)
    rates, phases = rng.uniform(2.0, 25.0, 2), rng.uniform(0.0, 6.0, 2)
    h, given_out, base = 1e-3, 0.0, np.array([0.02, 0.01])
    for k in range(1500):
        grow = min(1.0, k / 300.0)
        sines, cosines = np.sin(rates * k * h + phases), np.cos(rates * k * h + phases)
        p3 = FULCRUM[:2] + grow * base * sines
        v = grow * base * rates * cosines + (base * sines / 0.3 if k < 300 else 0.0)
        d = unit([*(p3 - FULCRUM[:2]), -FULCRUM[2]])
        state = with_joints(
            pose(d, **UP), np.linalg.solve(jacobian(GEOMETRY, inverse(GEOMETRY, p3)), v)
        )
        done = law.run(state)
        given_out += h * np.dot(done[[sv.FORCE_X, sv.FORCE_Y, sv.FORCE_Z]], state[sv.HUB_V])
        given_out -= done[sv.GAIN_WORK]
        assert given_out + done[sv.POTENTIAL] <= 3e-4


@pytest.mark.long("machine")
@RELAXED
@given(st.floats(0.0, 0.6), azimuths, speeds, depths)
def test_with_the_velocity_torques_the_tool_obeys_its_own_inertia(tilt, azimuth, qd, depth):
    state = with_joints(pose(leaning(tilt, azimuth), depth), qd)
    model = PROFILE.dynamic_model
    q = state[[sv.Q_LEFT, sv.Q_RIGHT]]
    terms = dynamic_terms(model, q, qd, depth)
    matrix = jacobian(GEOMETRY, q)
    gamma = np.array([0.7, -0.4])
    tau = matrix.T @ gamma + velocity_torques(state)
    qdd = np.linalg.solve(terms.mass, tau - terms.velocity)
    step = 1e-6
    rate = (
        jacobian(GEOMETRY, q + step * np.array(qd)) - jacobian(GEOMETRY, q - step * np.array(qd))
    ) / (2.0 * step)
    acceleration = matrix @ qdd + rate @ np.array(qd)
    inverse_inertia = matrix @ np.linalg.solve(terms.mass, matrix.T)
    assert acceleration == pytest.approx(inverse_inertia @ gamma, rel=1e-5, abs=1e-5)


# --- compensation -------------------------------------------------------------------------------

TILTED = PROFILE.model_copy(
    update={"mounting": PROFILE.mounting.model_copy(update={"gravity": (3.0, -4.0, -8.4)})}
)


def compensate(state, profile=TILTED, **parameters):
    ((_, function, memory),) = laws.stages_of({"compensation": parameters}, profile)
    done = with_dynamics(state.copy(), profile)
    function(done, memory)
    return done


@RELAXED
@given(tilts, azimuths, depths)
def test_gravity_is_carried_exactly_and_is_the_gradient_of_what_is_stored(tilt, azimuth, depth):
    state = with_joints(pose(leaning(tilt, azimuth), depth))
    q = state[[sv.Q_LEFT, sv.Q_RIGHT]]
    done = compensate(state)
    torque = done[[sv.JOINT_LEFT, sv.JOINT_RIGHT]]
    assert torque == pytest.approx(
        dynamic_terms(TILTED.dynamic_model, q, (0.0, 0.0), depth).gravity, abs=1e-12
    )
    bound = laws.energy_bound({"compensation": {}}, TILTED)
    assert 0.0 <= done[sv.POTENTIAL] <= bound
    d = state[sv.AXIS]
    side = across(d, (1.0, 2.0, 3.0))
    moved = []
    for s in (1e-6, -1e-6):
        other = pose(unit(d + s * side), depth)
        moved.append(with_joints(other))
    turned = [(m[sv.Q] - q) for m in moved]
    work = np.dot(torque, turned[0] - turned[1])
    energies = [compensate(m)[sv.POTENTIAL] for m in moved]
    assert work == pytest.approx(-(energies[0] - energies[1]), abs=1e-12)


@RELAXED
@given(st.floats(-50.0, 50.0), st.floats(-50.0, 50.0), st.floats(0.0, 0.9))
def test_friction_is_never_made_up_for_entirely(v1, v2, share):
    state = with_joints(pose(leaning(0.2, 0.3)))
    state[[sv.QD_LEFT, sv.QD_RIGHT]] = v1, v2
    done = compensate(state, gravity=0.0, friction=share)
    given_out = done[[sv.JOINT_LEFT, sv.JOINT_RIGHT]]
    q = state[[sv.Q_LEFT, sv.Q_RIGHT]]
    taken = dynamic_terms(TILTED.dynamic_model, q, (v1, v2), 0.06).friction
    assert np.all(given_out * (v1, v2) >= 0.0)
    assert np.all(np.abs(given_out) <= np.abs(taken) * share * (1.0 + 1e-7))
    assert done[sv.FRICTION_WORK] == pytest.approx(1e-3 * np.dot(given_out, (v1, v2)))


def test_near_rest_no_friction_is_made_up_for_and_nothing_jumps():
    state, torques = with_joints(pose(leaning(0.2, 0.3))), []
    law = OneLaw("compensation", gravity=0.0)
    for speed in np.linspace(-0.5, 0.5, 2001):
        state[sv.QD_LEFT] = speed
        torques.append(law.run(state)[sv.JOINT_LEFT])
        if abs(speed) <= 0.1:
            assert torques[-1] == 0.0
    assert np.abs(np.diff(torques)).max() < 3e-5


@pytest.mark.long("machine")
@RELAXED
@given(st.sampled_from(["cone_wall", "forbidden_region", "compensation"]), st.integers(0, 999))
def test_sliding_the_needle_counts_as_gain_and_turning_it_does_not(name, seed):
    rng = np.random.default_rng(seed)
    parameters = SPHERE if name == "forbidden_region" else {}
    law, before = OneLaw(name, **parameters), 0.0
    d = leaning(0.65, 0.4) if name == "cone_wall" else leaning(0.25, 0.5)
    for _ in range(5):
        done = law.run(with_joints(pose(d, rng.uniform(*PROFILE.depth_range))))
        assert done[sv.POTENTIAL] - before == pytest.approx(done[sv.GAIN_WORK], abs=1e-12)
        before = done[sv.POTENTIAL]
    depth = rng.uniform(*PROFILE.depth_range)
    law.run(with_joints(pose(d, depth)))
    turned = law.run(with_joints(pose(leaning(0.66, 0.42), depth)))
    assert turned[sv.GAIN_WORK] == pytest.approx(0.0, abs=1e-15)
