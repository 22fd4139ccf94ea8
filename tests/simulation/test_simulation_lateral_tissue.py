"""The side stiffness: closed form, potential, memory of the channel, passivity."""

import numpy as np
import pytest
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.simulation.effects import lateral_tissue as effect
from app.simulation.needles import bending_stiffness
from app.simulation.scene import Binding, Needle, Scene, TissueLayer
from app.studies.lateral_tissue import beam_moment

LENGTH = 0.2
LAYERS = (TissueLayer("a", 0.01, 30e3), TissueLayer("b", 0.0, 9e9), TissueLayer("c", 0.19, 20e3))


def tissue(model: str = "winkler") -> FloatArray:
    return memory_of("lateral_tissue", {}, Binding(Scene(layers=LAYERS), model=model))


@pytest.fixture(params=["winkler", "beam"])
def memory(request: pytest.FixtureRequest) -> FloatArray:
    return tissue(request.param)


def leaning(tilt: float, azimuth: float = 0.3) -> FloatArray:
    return np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])


def tick(memory: FloatArray, axis: FloatArray, depth: float, source: float = 1.0) -> FloatArray:
    """Force at the hub [N] after one tick."""
    state = sv.empty_state()
    state[sv.AXIS] = axis
    state[sv.DEPTH], state[sv.L_OUT], state[sv.DEPTH_SOURCE] = depth, LENGTH - depth, source
    effect.step(state, memory)
    return state[sv.FORCE].copy()


def test_the_moment_about_the_fulcrum_is_the_sum_over_layers_of_k_cubes_over_three() -> None:
    memory, depth, turn = tissue(), 0.08, np.deg2rad(5.0)
    tick(memory, leaning(0.0), depth)
    axis = leaning(turn)
    force = tick(memory, axis, depth)
    stiffness = 30e3 * 0.01**3 / 3 + 20e3 * (depth**3 - 0.01**3) / 3
    moment = np.linalg.norm(np.cross(-(LENGTH - depth) * axis, force))
    assert moment == pytest.approx(stiffness * np.sin(turn), rel=1e-12)


def test_one_layer_of_20_kpa_at_100_mm_feels_as_published() -> None:
    memory = memory_of(
        "lateral_tissue", {}, Binding(Scene(layers=(TissueLayer("x", 0.2, 20e3),)), model="winkler")
    )
    assert effect.rotational_stiffness(memory, 0.1) == pytest.approx(6.67, abs=0.01)


def test_the_beam_table_is_that_of_the_closed_form_in_one_layer() -> None:
    scene = Scene(layers=(TissueLayer("x", 0.15, 20e3),), needle=Needle(outer_diameter=0.718e-3))
    memory = memory_of("lateral_tissue", {}, Binding(scene, model="beam"))
    ei = bending_stiffness(0.718e-3)
    for depth in (0.02, 0.05, 0.1, 0.14):
        exact = beam_moment(20e3, ei, depth, 1.0)
        # Linear between the edges of the table: second order in the width of a bin.
        assert effect.rotational_stiffness(memory, depth) == pytest.approx(exact, rel=1e-3)


def test_a_thick_needle_bends_little_where_it_is_shallow() -> None:
    scene = Scene(layers=LAYERS, needle=Needle(outer_diameter=10e-3))
    beam = memory_of("lateral_tissue", {}, Binding(scene, model="beam"))
    assert effect.rotational_stiffness(beam, 0.06) == pytest.approx(
        effect.rotational_stiffness(tissue(), 0.06), rel=2e-3
    )


def test_the_beam_is_never_stiffer_than_the_rigid_needle_and_never_softens_with_depth() -> None:
    beam, rigid = tissue("beam"), tissue()
    depths = np.linspace(0.0, 0.19, 400)
    soft = np.array([effect.rotational_stiffness(beam, d) for d in depths])
    hard = np.array([effect.rotational_stiffness(rigid, d) for d in depths])
    at_edges = 1e-3 * hard.max()  # linear between edges, so above a convex curve by a hair
    assert (soft <= hard + at_edges).all()
    assert (np.diff(soft) >= 0.0).all()


def test_the_force_is_perpendicular_to_the_needle_and_back_to_where_it_was_inserted(
    memory: FloatArray,
) -> None:
    tick(memory, leaning(0.1), 0.05)
    axis = leaning(0.2)
    force = tick(memory, axis, 0.05)
    assert abs(force @ axis) < 1e-12
    # The hub moves against the tip: the force takes the hub where the axis turns back to 0.1 rad.
    hub_then, hub_now = -leaning(0.1), -axis
    assert force @ (hub_then - hub_now) > 0.0


def test_a_straight_insertion_at_any_angle_is_without_side_force(
    memory: FloatArray,
) -> None:
    axis = leaning(0.5)
    forces = [tick(memory, axis, depth) for depth in np.linspace(-0.02, 0.12, 281)]
    assert np.abs(forces).max() < 1e-12


def test_the_force_is_the_gradient_of_the_stored_energy(
    memory: FloatArray,
) -> None:
    for depth, tilt in zip(np.linspace(0, 0.07, 50), np.linspace(0.0, 0.2, 50), strict=True):
        tick(memory, leaning(tilt), depth)
    axis = leaning(0.25, 0.8)
    force = tick(memory, axis, 0.07)
    for direction in (np.cross(axis, [1.0, 0, 0]), np.cross(axis, [0, 1.0, 0])):
        turned = [unit(axis + s * 1e-6 * direction) for s in (1.0, -1.0)]
        rise, fall = (effect.stored_energy(memory, n) for n in turned)
        slope = rise - fall
        moved = (turned[0] - turned[1]) * -(LENGTH - 0.07)  # of the hub
        assert -slope == pytest.approx(force @ moved, rel=1e-7)


def test_withdrawing_forgets_the_channel(
    memory: FloatArray,
) -> None:
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


def test_any_wandering_takes_no_energy_out_of_the_tissue(
    memory: FloatArray,
) -> None:
    random = np.random.default_rng(4)
    axis, depth, given = leaning(0.1), 0.0, 0.0
    for _ in range(4000):
        goal = unit(axis + random.normal(0.0, 2e-3, 3))
        force = tick(memory, axis, depth)
        middle = tick(memory, unit(axis + goal), depth)
        end = tick(memory, goal, depth)
        work = (force + 4.0 * middle + end) / 6.0 @ (goal - axis) * -(LENGTH - depth)
        given += float(work)  # the tissue's work on the hub
        axis = goal
        depth = float(np.clip(depth + random.normal(0.0005, 4e-3), -0.01, 0.12))
        tick(memory, axis, depth)
        assert given <= 1e-6
        assert effect.stored_energy(memory, axis) >= -1e-12


def test_a_bin_edge_makes_no_jump(
    memory: FloatArray,
) -> None:
    tick(memory, leaning(0.0), 0.06)
    before = tick(memory, leaning(0.1), 60 * effect.BIN + 1e-9)
    after = tick(memory, leaning(0.1), 60 * effect.BIN - 1e-9)
    assert np.abs(before - after).max() < 1e-5


def test_a_depth_that_nobody_measured_moves_nothing(
    memory: FloatArray,
) -> None:
    assert not tick(memory, leaning(0.3), 0.11, source=0.0).any()
    tick(memory, leaning(0.1), 0.05)
    held = tick(memory, leaning(0.2), 0.11, source=0.0)
    assert memory[effect.AT.depth] == 0.05
    assert held.any()


def test_nothing_is_added_without_valid_kinematics(
    memory: FloatArray,
) -> None:
    tick(memory, leaning(0.0), 0.06)
    state = sv.empty_state()
    state[sv.AXIS] = leaning(0.2)
    state[sv.DEPTH], state[sv.L_OUT], state[sv.KINEMATICS] = 0.06, 0.14, 1.0
    effect.step(state, memory)
    assert not state[sv.FORCE].any()
