"""Hard cases of effects, plant and trainee: bounded or a named error, never NaN, never a jump."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.mechanisms.profile import load_profile
from app.simulation.consumers import DevicePort
from app.simulation.effects import bevel, breathing, lateral_tissue, shaft_friction
from app.simulation.errors import SimulationError
from app.simulation.plan import compile
from app.simulation.plant import SimulatedHand, initial_plant, plant_stage
from app.simulation.scene import Binding, EffectRequest, Scene, TissueLayer
from app.simulation.trainee import trainee_stage

PROFILE = load_profile("icube")
ANY = st.floats(allow_nan=True, allow_infinity=True)
FORCES = sv.FORCE
PLANT = [k for name, k in sv.INDEX.items() if name.startswith(("plant_", "pull_", "push"))]
QUICK = settings(derandomize=True, deadline=None, max_examples=60)


def friction(layer: TissueLayer, **parameters: float) -> FloatArray:
    binding = Binding(Scene(layers=(layer,)), sv.PLANT_DEPTH)
    return memory_of("shaft_friction", parameters, binding)


def rub(memory: FloatArray, depth: float, dt: float = 1e-3) -> float:
    state = sv.empty_state()
    state[sv.PLANT_DEPTH], state[sv.DT] = depth, dt
    shaft_friction.step(state, memory)
    return float(state[sv.AXIAL_FORCE])


def press(memory: FloatArray, tilt: float, depth: float, l_out: float = 0.1) -> FloatArray:
    state = sv.empty_state()
    state[sv.AXIS_X], state[sv.AXIS_Z] = math.sin(tilt), -math.cos(tilt)
    state[sv.DEPTH], state[sv.L_OUT], state[sv.DEPTH_SOURCE] = depth, l_out, 1.0
    lateral_tissue.step(state, memory)
    return state[FORCES].copy()


def plant(hand: SimulatedHand | None = None) -> tuple[FloatArray, FloatArray, object]:
    _, step, parameters = plant_stage(PROFILE, hand=hand)
    state = sv.empty_state()
    for name, value in initial_plant(PROFILE, (0.0, 0.0, -1.0), 0.0).items():
        state[sv.INDEX[name]] = value
    state[sv.DT] = 1e-3
    return state, parameters, step


# --- friction -------------------------------------------------------------------------------------
@pytest.mark.parametrize("dt", [0.25e-3, 1e-3, 2e-3, 0.1])
@pytest.mark.parametrize("stiffness", [1e4, 1e5, 1e6, 1e9])
def test_friction_at_300_mm_per_s_is_bounded_for_any_stiffness_and_step(
    dt: float, stiffness: float
) -> None:
    memory = friction(TissueLayer("x", 9.0, viscous_friction=0.0), presliding_stiffness=stiffness)
    force = 0.0
    for k in range(300):
        depth = 0.05 + 0.3 * dt * k
        force = rub(memory, depth, dt)
        assert 0.0 <= force <= 18.45 * depth
    # It trails the level, which grows with depth, by one presliding distance at most.
    assert force == pytest.approx(10.57 * depth, rel=2e-2)


def test_a_still_needle_on_an_encoder_edge_does_not_chatter() -> None:
    memory = memory_of("shaft_friction", {}, Binding(Scene(layers=(TissueLayer("x", 0.2),))))
    state, forces, count = sv.empty_state(), [], 33e-6
    for k in range(2000):
        state[sv.DEPTH], state[sv.DT], state[sv.AXIAL_FORCE] = 0.051 + count * (k % 2), 1e-3, 0.0
        shaft_friction.step(state, memory)
        forces.append(state[sv.AXIAL_FORCE])
    elastic = 2.0 * 1e5 * 0.0511 * count  # the slope doubles where the motion turns
    viscous = 250.0 * 0.0511 * count / 0.03
    assert np.abs(np.diff(forces[10:])).max() <= elastic + 2.0 * viscous


@QUICK
@given(st.lists(st.tuples(ANY, ANY), max_size=30))
def test_friction_survives_any_depth_and_step(ticks: list[tuple[float, float]]) -> None:
    memory = friction(TissueLayer("x", 0.1, viscous_friction=0.0))
    for depth, dt in ticks:
        assert abs(rub(memory, depth, dt)) <= 18.45 * 0.1 + 1e-9


# --- lateral tissue -------------------------------------------------------------------------------
def tissue(*layers: TissueLayer, model: str = "winkler") -> FloatArray:
    return memory_of("lateral_tissue", {}, Binding(Scene(layers=layers), model=model))


def test_a_stiffness_of_a_million_is_finite_and_still_perpendicular() -> None:
    memory = tissue(TissueLayer("x", 0.2, 1e6))
    press(memory, 0.0, 0.12)
    force = press(memory, 0.1, 0.12, l_out=0.08)
    assert np.isfinite(force).all()
    assert abs(force @ [math.sin(0.1), 0.0, -math.cos(0.1)]) < 1e-9 * np.linalg.norm(force)


@pytest.mark.parametrize("model", ["winkler", "beam"])
@QUICK
@given(st.lists(st.tuples(ANY, st.floats(-1.5, 1.5), st.floats(0.0, 0.2)), max_size=30))
def test_the_tissue_survives_any_depth_and_holds_its_bound(
    model: str,
    ticks: list[tuple[float, float, float]],
) -> None:
    memory = tissue(TissueLayer("x", 0.1, 2e4), model=model)
    most = 2e4 * 0.1**3 / 3.0 / 0.02
    for depth, tilt, l_out in ticks:
        assert np.linalg.norm(press(memory, tilt, depth, l_out)) <= most * (1.0 + 1e-9)


def test_layers_thicker_than_a_metre_are_refused() -> None:
    with pytest.raises(SimulationError, match="at most 1 m"):
        tissue(TissueLayer("x", 1e3))


# --- breathing ------------------------------------------------------------------------------------
@pytest.mark.parametrize("period", [0.0, -4.0, math.nan, math.inf])
def test_a_breath_without_a_period_is_refused(period: float) -> None:
    scene = Scene(effects=(EffectRequest("breathing", {"period": period}),))
    with pytest.raises(SimulationError, match=r"period is .*; give 0.5 to 60 s"):
        compile(scene, DevicePort("icube"), views=("target_motion",))


@QUICK
@given(st.lists(ANY, max_size=20))
def test_breathing_stays_within_its_amplitudes_at_any_time(times: list[float]) -> None:
    memory = memory_of("breathing", {}, Binding(Scene()))
    state = sv.empty_state()
    for time in times:
        state[sv.TARGET_SHIFT] = 0.0
        state[sv.TIME] = time
        breathing.step(state, memory)
        shift = state[sv.TARGET_SHIFT]
        assert np.linalg.norm(shift) < 0.0127


# --- plant and hand -------------------------------------------------------------------------------
@QUICK
@given(st.lists(st.tuples(ANY, ANY, ANY, ANY, ANY, ANY, ANY), max_size=20))
def test_the_plant_survives_any_input(ticks: list[tuple[float, ...]]) -> None:
    state, parameters, step = plant()
    for x, y, depth, left, right, tissue_force, dt in ticks:
        state[sv.HAND_X], state[sv.HAND_Y], state[sv.HAND_DEPTH] = x, y, depth
        state[sv.HAND_HOLDS] = 1.0
        state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = left, right
        state[sv.AXIAL_FORCE], state[sv.DT] = tissue_force, dt
        before = state[PLANT].copy()
        step(state, parameters)  # type: ignore[operator]
        assert np.isfinite(state[PLANT]).all()
        assert np.abs(state[PLANT] - before)[:2].max() <= 50.0 * 5e-3 + 1e-9


def test_a_hand_that_is_not_a_number_lets_go() -> None:
    state, parameters, step = plant()
    state[sv.HAND_X], state[sv.HAND_HOLDS] = 0.3, 1.0
    for _ in range(20):  # it takes hold at rest, then moves
        step(state, parameters)  # type: ignore[operator]
    assert state[sv.PULL_X] != 0.0
    for slot in (sv.HAND_X, sv.HAND_Y, sv.HAND_DEPTH, sv.HAND_HOLDS):
        kept, state[slot] = state[slot], math.nan
        step(state, parameters)  # type: ignore[operator]
        assert not state[[sv.PULL_X, sv.PULL_Y, sv.PULL_Z, sv.PUSH]].any()
        state[slot] = kept


def test_a_plant_in_an_impossible_state_goes_back_to_its_start() -> None:
    state, parameters, step = plant()
    start = state[PLANT].copy()
    start[sv.PLANT_DEPTH - sv.PLANT_Q_LEFT] = -0.015  # where `plant_stage` starts by default
    for q in ((math.nan, 0.5), (0.0, math.inf), (math.acos(0.425), math.pi - math.acos(0.425))):
        state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT] = q
        state[sv.PLANT_DEPTH] = math.nan
        step(state, parameters)  # type: ignore[operator]
        np.testing.assert_array_equal(state[PLANT], start)


@pytest.mark.parametrize("dt", [1e-3, 5e-3])
def test_a_stiff_hand_against_a_stiff_spring_at_the_motors_stays_bounded(dt: float) -> None:
    """Deep tissue as the device renders it: 1500 N/m at the hub, sampled once a tick."""
    state, parameters, step = plant(SimulatedHand(stiffness=2000.0, damping=5.0))
    state[sv.HAND_X], state[sv.HAND_HOLDS], state[sv.DT] = 0.2, 1.0, dt
    rest = state[sv.PLANT_Q].copy()
    rows = []
    for _ in range(2000):
        # 1500 N/m at the hub is about 1500 (L_out/L_in)² (0.1 m/rad)² = 74 N·m/rad at the joints...
        torque = -74.0 * (state[sv.PLANT_Q] - rest)
        # ... within the limit of the motors.
        state[sv.TORQUE] = np.clip(torque, -0.6, 0.6)
        step(state, parameters)  # type: ignore[operator]
        rows.append(state[PLANT].copy())
    assert np.isfinite(rows).all()
    assert np.abs(np.array(rows)[:, :2] - rest).max() < 1.0


def test_a_robot_at_rest_for_ten_minutes_has_no_subnormals() -> None:
    state, parameters, step = plant()
    state[sv.PLANT_QD_LEFT], state[sv.PLANT_DEPTH_RATE], state[sv.DT] = 1e-3, 1e-3, 5e-3
    for _ in range(20_000):
        step(state, parameters)  # type: ignore[operator]
    for value in state[PLANT]:
        assert value == 0.0 or abs(value) > 1e-300


# --- trainee --------------------------------------------------------------------------------------
@QUICK
@given(st.lists(ANY, max_size=20))
def test_the_trainee_wants_a_direction_at_any_time(times: list[float]) -> None:
    axis = unit(np.array([0.0, 0.6, -0.8]))
    _, step, parameters = trainee_stage(axis, 0.08, "novice", 5)
    state = sv.empty_state()
    state[sv.ENABLED] = 1.0
    for time in times:
        state[sv.TIME] = time
        step(state, parameters)
        hand = state[[sv.HAND_X, sv.HAND_Y, sv.HAND_DEPTH, sv.HAND_HOLDS]]
        assert np.isfinite(hand).all()
        assert math.hypot(hand[0], hand[1]) < 0.98


# --- tissue that moves ----------------------------------------------------------------------------
@pytest.mark.parametrize("model", ["winkler", "beam"])
@QUICK
@given(st.lists(st.tuples(ANY, st.floats(-1.5, 1.5), ANY, ANY, ANY), max_size=30))
def test_tissue_that_moves_survives_any_displacement_and_holds_its_bound(
    model: str, ticks: list[tuple[float, float, float, float, float]]
) -> None:
    scene = Scene((EffectRequest("breathing"),), (TissueLayer("x", 0.1, 2e4),))
    memory = memory_of("lateral_tissue", {}, Binding(scene, model=model))
    most = 2e4 * (0.1**3 / 3.0 + 2.0 * lateral_tissue.FURTHEST * 0.1**2 / 2.0) / 0.02
    state = sv.empty_state()
    for depth, tilt, *shift in ticks:
        for slot in sv.SUMS:
            state[slot] = 0.0
        state[sv.AXIS_X], state[sv.AXIS_Z] = math.sin(tilt), -math.cos(tilt)
        state[sv.DEPTH], state[sv.L_OUT], state[sv.DEPTH_SOURCE] = depth, 0.1, 1.0
        state[sv.TARGET_SHIFT] = shift
        lateral_tissue.step(state, memory)
        assert np.linalg.norm(state[FORCES]) <= most * (1.0 + 1e-9)
        assert np.isfinite(state[list(sv.SUMS)]).all()
        assert state[sv.POTENTIAL] >= 0.0


def test_a_moving_boundary_makes_no_jump_while_the_needle_grazes_it() -> None:
    layers = (TissueLayer("a", 0.0503, 1e4, moves=0.0), TissueLayer("b", 0.1, 1e5, moves=1.0))
    memory = memory_of("lateral_tissue", {}, Binding(Scene(layers=layers), model="beam"))
    state, forces = sv.empty_state(), []
    state[sv.AXIS_Z], state[sv.L_OUT], state[sv.DEPTH_SOURCE] = -1.0, 0.1, 1.0
    for k in range(4000):
        state[list(sv.SUMS)] = 0.0
        state[sv.DEPTH] = 0.0505 + 2e-3 * math.sin(0.01 * k)
        state[sv.TARGET_SHIFT_X] = 0.01 * math.sin(0.003 * k)
        lateral_tissue.step(state, memory)
        forces.append(state[sv.FORCE_X])
    assert np.abs(np.diff(forces)).max() < 2e-2  # N in a tick
    assert np.abs(forces).max() > 0.01


# --- bevel ----------------------------------------------------------------------------------------
@pytest.mark.parametrize("model", ["arc", "drifting"])
@QUICK
@given(st.lists(st.tuples(ANY, ANY, ANY, ANY, ANY), max_size=30))
def test_the_bevel_survives_any_depth_roll_and_axis_and_never_leaves_its_length(
    model: str, ticks: list[tuple[float, ...]]
) -> None:
    memory = memory_of("bevel", {"curvature_thick": 10.0}, Binding(Scene(), model=model))
    state = sv.empty_state()
    for depth, roll, *axis in ticks:
        state[list(sv.SUMS)] = 0.0
        with np.errstate(all="ignore"):
            length = float(np.linalg.norm(axis))
        sensible = 0.1 < length < 1e6
        state[sv.AXIS] = np.array(axis) / length if sensible else (0.0, 0.0, -1.0)
        state[sv.DEPTH], state[sv.NEEDLE_ROLL], state[sv.DEPTH_SOURCE] = depth, roll, 1.0
        bevel.step(state, memory)
        assert np.isfinite(state[list(sv.SUMS)]).all()
        assert np.linalg.norm(state[sv.TIP_OFFSET]) <= 2.0 * (state[sv.BENT_LENGTH] + 1e-9)
        assert np.linalg.norm(state[sv.TIP_SLOPE]) <= 2.0 + 1e-9


@pytest.mark.parametrize("depth", [5e-324, 1e-300, 1e-15, 1e-9])
def test_a_bevel_that_has_hardly_gone_in_has_hardly_bent(depth: float) -> None:
    memory, state = memory_of("bevel", {}, Binding(Scene())), sv.empty_state()
    state[sv.AXIS_Z], state[sv.DEPTH], state[sv.DEPTH_SOURCE] = -1.0, depth, 1.0
    bevel.step(state, memory)
    assert np.isfinite(state).all()
    assert np.linalg.norm(state[sv.TIP_OFFSET]) <= depth


def test_a_needle_that_points_straight_up_has_a_frame_too() -> None:
    memory, state = memory_of("bevel", {}, Binding(Scene())), sv.empty_state()
    state[sv.AXIS_Z], state[sv.DEPTH], state[sv.DEPTH_SOURCE] = 1.0, 0.1, 1.0
    bevel.step(state, memory)
    assert state[sv.TIP_OFFSET_X] == pytest.approx((1.0 - math.cos(0.03)) / 0.3)
