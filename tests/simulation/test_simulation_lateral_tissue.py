"""The side stiffness: closed form, potential, memory of the channel, passivity."""

import numpy as np
import pytest

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.simulation.effects import lateral_tissue as effect
from app.simulation.scene import Layer, Scene

LENGTH = 0.2
LAYERS = (Layer("a", 0.01, 30e3), Layer("b", 0.0, 9e9), Layer("c", 0.19, 20e3))


def tissue(**parameters: float) -> FloatArray:
    scene = Scene(layers=LAYERS)
    return effect.LateralTissue(**parameters).parameters(scene, sv.DEPTH)


def leaning(tilt: float, azimuth: float = 0.3) -> FloatArray:
    return np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])


def tick(memory: FloatArray, axis: FloatArray, depth: float, source: float = 1.0) -> FloatArray:
    """Force at the hub [N] after one tick."""
    state = sv.empty_state()
    state[sv.AXIS_X : sv.AXIS_Z + 1] = axis
    state[sv.DEPTH], state[sv.L_OUT], state[sv.DEPTH_SOURCE] = depth, LENGTH - depth, source
    effect.step(state, memory)
    return state[sv.FORCE_X : sv.FORCE_Z + 1].copy()


def test_the_moment_about_the_fulcrum_is_the_sum_over_layers_of_k_cubes_over_three() -> None:
    memory, depth, turn = tissue(), 0.08, np.deg2rad(5.0)
    tick(memory, leaning(0.0), depth)
    axis = leaning(turn)
    force = tick(memory, axis, depth)
    stiffness = 30e3 * 0.01**3 / 3 + 20e3 * (depth**3 - 0.01**3) / 3
    moment = np.linalg.norm(np.cross(-(LENGTH - depth) * axis, force))
    assert moment == pytest.approx(stiffness * np.sin(turn), rel=1e-12)


def test_one_layer_of_20_kpa_at_100_mm_feels_as_published() -> None:
    memory = effect.LateralTissue().parameters(Scene(layers=(Layer("x", 0.2, 20e3),)), sv.DEPTH)
    assert effect.rotational_stiffness(memory, 0.1) == pytest.approx(6.67, abs=0.01)


def test_the_force_is_perpendicular_to_the_needle_and_back_to_where_it_was_inserted() -> None:
    memory = tissue()
    tick(memory, leaning(0.1), 0.05)
    axis = leaning(0.2)
    force = tick(memory, axis, 0.05)
    assert abs(force @ axis) < 1e-12
    # The hub moves against the tip: the force takes the hub where the axis turns back to 0.1 rad.
    hub_then, hub_now = -leaning(0.1), -axis
    assert force @ (hub_then - hub_now) > 0.0


def test_a_straight_insertion_at_any_angle_is_without_side_force() -> None:
    memory, axis = tissue(), leaning(0.5)
    forces = [tick(memory, axis, depth) for depth in np.linspace(-0.02, 0.12, 281)]
    assert np.abs(forces).max() < 1e-12


def test_the_force_is_the_gradient_of_the_stored_energy() -> None:
    memory = tissue()
    for depth, tilt in zip(np.linspace(0, 0.07, 50), np.linspace(0.0, 0.2, 50), strict=True):
        tick(memory, leaning(tilt), depth)
    axis = leaning(0.25, 0.8)
    force = tick(memory, axis, 0.07)
    for direction in (np.cross(axis, [1.0, 0, 0]), np.cross(axis, [0, 1.0, 0])):
        turned = [unit(axis + s * 1e-6 * direction) for s in (1.0, -1.0)]
        slope = np.subtract(*[effect.stored_energy(memory, n) for n in turned])
        moved = (turned[0] - turned[1]) * -(LENGTH - 0.07)  # of the hub
        assert -slope == pytest.approx(force @ moved, rel=1e-7)


def test_withdrawing_forgets_the_channel() -> None:
    memory = tissue()
    tick(memory, leaning(0.1), 0.08)
    tick(memory, leaning(0.1), 0.0)
    force = tick(memory, leaning(0.3), 0.08)
    assert np.abs(force).max() < 1e-12


def test_a_partial_withdrawal_keeps_the_channel_that_is_left() -> None:
    memory, short = tissue(), tissue()
    tick(memory, leaning(0.1), 0.08)
    tick(memory, leaning(0.1), 0.0415)
    tick(short, leaning(0.1), 0.0415)
    np.testing.assert_allclose(
        tick(memory, leaning(0.2), 0.0415), tick(short, leaning(0.2), 0.0415), rtol=1e-9
    )


def test_any_wandering_takes_no_energy_out_of_the_tissue() -> None:
    random = np.random.default_rng(4)
    memory = tissue()
    axis, depth, given = leaning(0.1), 0.0, 0.0
    for _ in range(4000):
        goal = unit(axis + random.normal(0.0, 2e-3, 3))
        force = tick(memory, axis, depth)
        middle = tick(memory, unit(axis + goal), depth)
        end = tick(memory, goal, depth)
        work = (force + 4.0 * middle + end) / 6.0 @ (goal - axis) * -(LENGTH - depth)
        given += work  # the tissue's work on the hub
        axis = goal
        depth = float(np.clip(depth + random.normal(0.0005, 4e-3), -0.01, 0.12))
        tick(memory, axis, depth)
        assert given <= 1e-6
        assert effect.stored_energy(memory, axis) >= -1e-12


def test_a_bin_edge_makes_no_jump() -> None:
    memory = tissue()
    tick(memory, leaning(0.0), 0.06)
    before = tick(memory, leaning(0.1), 60 * effect.BIN + 1e-9)
    after = tick(memory, leaning(0.1), 60 * effect.BIN - 1e-9)
    assert np.abs(before - after).max() < 1e-5


def test_a_depth_that_nobody_measured_moves_nothing() -> None:
    memory = tissue()
    assert not tick(memory, leaning(0.3), 0.11, source=0.0).any()
    tick(memory, leaning(0.1), 0.05)
    held = tick(memory, leaning(0.2), 0.11, source=0.0)
    assert memory[effect.DEPTH] == 0.05
    assert held.any()


def test_nothing_is_added_without_valid_kinematics() -> None:
    memory = tissue()
    tick(memory, leaning(0.0), 0.06)
    state = sv.empty_state()
    state[sv.AXIS_X : sv.AXIS_Z + 1] = leaning(0.2)
    state[sv.DEPTH], state[sv.L_OUT], state[sv.KINEMATICS] = 0.06, 0.14, 1.0
    effect.step(state, memory)
    assert not state[sv.FORCE_X : sv.FORCE_Z + 1].any()
