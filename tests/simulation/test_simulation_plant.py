"""The simulated robot: energy, hand, stops, letting go, stiff hands at long steps."""

import numpy as np
import pytest

from app.core import state_vector as sv
from app.core.arrays import FloatArray, angle_between, unit
from app.mechanisms.pantograph import (
    DynamicTerms,
    dynamic_terms,
    force_map,
    forward,
    jacobian,
    joint_torques,
    needle_at,
)
from app.mechanisms.profile import DeviceProfile, load_profile
from app.simulation.errors import SimulationError
from app.simulation.plan import Stage
from app.simulation.plant import PlantSurroundings, SimulatedHand, initial_plant, plant_stage

PROFILE = load_profile("icube")
DOWN = np.array([0.0, 0.0, -1.0])
Q, QD = sv.PLANT_Q, sv.PLANT_QD


def begin(axis: FloatArray = DOWN, depth: float = 0.0) -> FloatArray:
    state = sv.empty_state()
    for name, value in initial_plant(PROFILE, axis, depth).items():
        state[sv.INDEX[name]] = value
    state[sv.DT] = 1e-3
    return state


def run(stage: Stage, state: FloatArray, ticks: int) -> FloatArray:
    rows = np.empty((ticks, len(state)))
    for k in range(ticks):
        stage[1](state, stage[2])
        rows[k] = state
    return rows


def grip(state: FloatArray, axis: FloatArray, depth: float) -> None:
    state[sv.HAND_X], state[sv.HAND_Y], state[sv.HAND_DEPTH] = axis[0], axis[1], depth
    state[sv.HAND_HOLDS] = 1.0


def axis_of(state: FloatArray) -> FloatArray:
    x, y = forward(PROFILE.pantograph, state[Q])
    return unit(np.array([x, y, 0.0]) - PROFILE.fulcrum)


def terms(state: FloatArray, profile: DeviceProfile = PROFILE) -> DynamicTerms:
    depth, rate = float(state[sv.PLANT_DEPTH]), float(state[sv.PLANT_DEPTH_RATE])
    return dynamic_terms(profile.dynamic_model, state[Q], state[QD], depth, rate)


def energy(state: FloatArray, profile: DeviceProfile = PROFILE) -> float:
    """Kinetic energy, and that of the needle's weight above its place with the needle vertical."""
    part = profile.inertia
    inside = float(state[sv.PLANT_DEPTH]) + part.needle_centre - profile.geometry.needle_length
    fall = profile.mounting.gravity[2] * inside * (axis_of(state)[2] + 1.0)
    return 0.5 * float(state[QD] @ terms(state, profile).mass @ state[QD]) - part.needle_mass * fall


def without_friction() -> DeviceProfile:
    friction = PROFILE.friction.model_copy(update={"coulomb": 0.0, "viscous": 0.0})
    return PROFILE.model_copy(update={"friction": friction})


@pytest.mark.parametrize("tilt", [0.0, 10.0, 30.0, 38.0])
def test_the_starting_pose_points_the_needle_where_asked(tilt: float) -> None:
    angle = np.deg2rad(tilt)
    axis = np.array([np.sin(angle) * 0.6, np.sin(angle) * 0.8, -np.cos(angle)])
    np.testing.assert_allclose(axis_of(begin(axis)), axis, atol=1e-12)


def test_a_start_that_cannot_be_reached_is_refused() -> None:
    with pytest.raises(SimulationError, match="does not point down"):
        initial_plant(PROFILE, [0.0, 0.0, 1.0], 0.0)
    with pytest.raises(SimulationError, match="tilt limit is 39 degrees"):
        initial_plant(PROFILE, [0.98, 0.0, -0.1], 0.0)


def test_one_tick_without_hand_follows_the_equations_of_motion() -> None:
    profile = without_friction()
    state = begin()
    state[QD] = (0.3, -0.2)
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = 0.05, -0.02
    state[sv.DT] = 1e-6
    before = state.copy()
    run(plant_stage(profile), state, 1)
    rate = (state[QD] - before[QD]) / 1e-6
    found = terms(before, profile)
    free = np.array([0.05, -0.02]) - found.velocity - found.gravity
    np.testing.assert_allclose(rate, np.linalg.solve(found.mass, free), rtol=1e-6)


@pytest.mark.parametrize("profile", [PROFILE, without_friction()], ids=["friction", "frictionless"])
def test_energy_does_not_grow_when_let_go(profile: DeviceProfile) -> None:
    state = begin()
    state[QD] = (1.0, -0.6)
    start = energy(state)
    energies = [energy(row, profile) for row in run(plant_stage(profile), state, 1000)]
    assert np.max(energies) <= start * 1.002  # velocity terms are explicit: two parts in a thousand
    assert energies[-1] < start


def test_friction_brings_it_to_rest_exactly() -> None:
    state = begin()
    state[QD] = (0.5, 0.5)
    rows = run(plant_stage(PROFILE), state, 5000)
    assert not rows[-1, QD].any()


def test_the_hand_turns_the_needle_to_where_it_wants() -> None:
    state, wanted = begin(), unit(np.array([0.3, -0.1, -1.0]))
    grip(state, wanted, 0.03)
    rows = run(plant_stage(PROFILE), state, 3000)
    # Coulomb friction of the joints and the seal leave a small part of the way.
    assert angle_between(axis_of(state), wanted) < np.deg2rad(0.3)
    assert state[sv.PLANT_DEPTH] == pytest.approx(0.03, abs=0.3e-3)
    pull = rows[0, sv.PULL]
    assert abs(pull @ axis_of(rows[0])) < 1e-9


def test_the_pull_of_the_hand_balances_the_robot_in_rest() -> None:
    profile, state = without_friction(), begin(depth=0.02)
    grip(state, DOWN, 0.02)
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = 0.06, 0.02
    run(plant_stage(profile), state, 4000)
    pull, axis = state[sv.PULL], axis_of(state)
    geometry, depth = profile.pantograph, float(state[sv.PLANT_DEPTH])
    needle = needle_at(geometry, forward(geometry, state[Q]), geometry.needle_length - depth)
    torque = joint_torques(jacobian(geometry, state[Q]), force_map(needle, pull))
    assert abs(pull @ axis) < 1e-9
    weight = terms(state, profile).gravity
    np.testing.assert_allclose(torque - weight, [-0.06, -0.02], atol=1e-9)


def test_a_hand_that_wants_beyond_the_tilt_limit_is_stopped_without_a_jump() -> None:
    state = begin()
    grip(state, unit(np.array([0.95, 0.0, -0.3])), 0.0)
    rows = run(plant_stage(PROFILE, hand=SimulatedHand(stiffness=2000.0)), state, 3000)
    tilts = np.array([angle_between(axis_of(row), DOWN) for row in rows[::10]])
    assert np.rad2deg(tilts.max()) < PROFILE.tilt_limit_deg + 2.0
    peak = int(tilts.argmax())
    assert tilts[peak] - tilts[peak:].min() < np.deg2rad(1.5)  # no bouncing off


def test_the_depth_ends_at_its_range() -> None:
    state = begin()
    grip(state, DOWN, 9.0)
    rows = run(plant_stage(PROFILE), state, 3000)
    low, high = PROFILE.depth_range
    assert rows[:, sv.PLANT_DEPTH].max() == high
    assert state[sv.PLANT_DEPTH_RATE] == 0.0
    grip(state, DOWN, -9.0)
    assert run(plant_stage(PROFILE), state, 3000)[:, sv.PLANT_DEPTH].min() == low


def test_a_needle_that_is_let_go_stays_in_the_seal() -> None:
    state = begin(depth=0.05)
    state[sv.PLANT_DEPTH_RATE] = 0.02
    rows = run(plant_stage(PROFILE), state, 500)
    assert rows[-1, sv.PLANT_DEPTH_RATE] == 0.0
    assert rows[-1, sv.PLANT_DEPTH] == pytest.approx(0.05, abs=1e-3)
    assert not rows[:, sv.PUSH].any()


def test_a_tissue_force_stops_the_needle_within_a_tick_but_does_not_turn_it_back() -> None:
    state = begin(depth=0.05)
    state[sv.PLANT_DEPTH_RATE], state[sv.AXIAL_FORCE], state[sv.DT] = 0.3, 5.0, 5e-3
    rig = PlantSurroundings(seal_friction=0.0, seal_viscous=0.0)
    run(plant_stage(PROFILE, surroundings=rig), state, 1)
    assert 0.0 <= state[sv.PLANT_DEPTH_RATE] < 0.01  # explicitly it would be -0.2 m/s


@pytest.mark.parametrize("dt", [0.25e-3, 1e-3, 5e-3])
@pytest.mark.parametrize("stiffness", [300.0, 2000.0, 1e5])
def test_any_hand_is_stable_at_any_step(dt: float, stiffness: float) -> None:
    state, wanted = begin(), unit(np.array([0.4, 0.2, -1.0]))
    grip(state, wanted, 0.05)
    state[sv.DT] = dt
    hand = SimulatedHand(
        stiffness=stiffness, damping=0.0, axial_stiffness=stiffness, axial_damping=0.0
    )
    rows = run(plant_stage(PROFILE, hand=hand), state, int(4.0 / dt))
    assert np.isfinite(rows).all()
    tail = rows[-int(0.5 / dt) :]
    assert np.ptp(tail[:, Q], axis=0).max() < 1e-3
    assert angle_between(axis_of(state), wanted) < np.deg2rad(0.5)


def test_a_bad_hand_is_refused() -> None:
    with pytest.raises(SimulationError, match="hand stiffness is -1"):
        SimulatedHand(stiffness=-1.0)


def test_joint_friction_holds_a_leaning_needle_up_to_its_coulomb_torque() -> None:
    """Dry, not smoothed: a needle that its weight cannot tear loose does not creep."""
    leaning = unit(np.array([0.05, 0.02, -1.0]))
    state = begin(leaning)
    assert np.abs(terms(state).gravity).max() < PROFILE.friction.coulomb
    rows = run(plant_stage(PROFILE), state, 2000)
    assert not rows[:, QD].any()
    state = begin(unit(np.array([0.5, 0.2, -1.0])))
    assert np.abs(terms(state).gravity).max() > PROFILE.friction.coulomb
    run(plant_stage(PROFILE), state, 1000)
    assert state[QD].any() or angle_between(axis_of(state), DOWN) > np.deg2rad(35.0)


def test_one_tick_slows_a_needle_by_its_weight_and_turning() -> None:
    rig = PlantSurroundings(
        seal_friction=0.0, seal_viscous=0.0, moving_mass=PROFILE.inertia.needle_mass
    )
    state = begin(unit(np.array([0.2, 0.0, -1.0])))
    state[sv.DT] = 1e-6
    gravity = -9.80665 * axis_of(state)[2]
    run(plant_stage(PROFILE, surroundings=rig), state, 1)
    assert state[sv.PLANT_DEPTH_RATE] / 1e-6 == pytest.approx(gravity, rel=1e-9)


@pytest.mark.parametrize("speeds", [(0.4, 1e-6), (-1e-6, 0.3), (1e-6, 1e-6), (0.2, -0.2)])
def test_dry_friction_never_turns_a_joint_around_and_takes_energy(
    speeds: tuple[float, float],
) -> None:
    friction = PROFILE.friction.model_copy(update={"coulomb": 0.05, "viscous": 0.0})
    profile = PROFILE.model_copy(update={"friction": friction})
    state = begin(depth=0.1)
    state[QD] = speeds
    rows = run(plant_stage(profile), state, 200)
    energies = np.array([energy(row, profile) for row in rows])
    assert np.diff(energies).max() <= 1e-9
    assert not rows[-1, QD].any()
