"""Tissue that breathing moves drags the needle: force, tip, energy and who consumes it."""

import numpy as np
import pytest
from simulation.effect_rig import memory_of
from simulation.test_simulation_bent_needle import fine_beam

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, scene_of
from app.simulation.consumers import DevicePort
from app.simulation.effects import lateral_tissue as effect
from app.simulation.errors import SimulationError
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.plan import compile
from app.simulation.scene import (
    DEFAULT_LAYERS,
    Binding,
    EffectRequest,
    Needle,
    Scene,
    TissueLayer,
)

LENGTH = 0.2
BREATH = EffectRequest("breathing")
NOTHING = (0.0, 0.0, 0.0)


def tissue(
    model: str = "beam", gauge: int = 18, layers: tuple[TissueLayer, ...] = DEFAULT_LAYERS
) -> FloatArray:
    scene = Scene((BREATH,), layers, Needle(outer_diameter=OUTER_DIAMETER[gauge]))
    return memory_of("lateral_tissue", {}, Binding(scene, model=model))


@pytest.fixture(params=["winkler", "beam"])
def memory(request: pytest.FixtureRequest) -> FloatArray:
    return tissue(request.param)


def leaning(tilt: float, azimuth: float = 0.3) -> FloatArray:
    return np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])


def tick(memory: FloatArray, axis: FloatArray, depth: float, shift: object = NOTHING) -> FloatArray:
    """State after one tick."""
    state = sv.empty_state()
    state[sv.AXIS], state[sv.TARGET_SHIFT] = axis, shift
    state[sv.DEPTH], state[sv.L_OUT], state[sv.DEPTH_SOURCE] = depth, LENGTH - depth, 1.0
    effect.step(state, memory)
    return state


def test_a_rigid_needle_is_pushed_by_the_sum_over_moving_layers_of_k_times_the_lever() -> None:
    layers = (
        TissueLayer("a", 0.0113, 30e3, moves=0.25),  # no bin's edge
        TissueLayer("b", 0.05, 20e3, moves=0.0),
        TissueLayer("c", 0.12, 15e3, moves=1.0),
    )
    memory, down, depth = tissue("winkler", layers=layers), leaning(0.0), 0.0937
    tick(memory, down, depth)
    force = tick(memory, down, depth, (0.004, 0.003, 0.0))[sv.FORCE]
    levers = 0.25 * 30e3 * 0.0113**2 / 2 + 15e3 * (depth**2 - 0.0613**2) / 2
    # Forwards: tissue that goes one way takes the hub the other way. A bin of two layers moves with
    # their mean share: 1e-3 of the force.
    expected = -levers * np.array([0.004, 0.003, 0.0]) / (LENGTH - depth)
    np.testing.assert_allclose(force, expected, rtol=2e-3, atol=1e-12)


def test_layers_whose_edges_are_those_of_bins_move_the_rigid_needle_exactly() -> None:
    bins = effect.BIN
    layers = (TissueLayer("a", 20 * bins, 30e3), TissueLayer("b", 100 * bins, 20e3, moves=0.7))
    memory, depth = tissue("winkler", layers=layers), 0.0811
    tick(memory, leaning(0.0), depth)
    force = tick(memory, leaning(0.0), depth, (0.004, 0.0, 0.0))[sv.FORCE]
    levers = 0.7 * 20e3 * (depth**2 - (20 * bins) ** 2) / 2
    assert force[0] == pytest.approx(-levers * 0.004 / (LENGTH - depth), rel=1e-12)


@pytest.mark.parametrize("gauge", [18, 22])
def test_the_bent_needle_is_that_of_a_fine_beam_on_tissue_that_has_moved(gauge: int) -> None:
    memory, down, depth, shift = tissue(gauge=gauge), leaning(0.0), 0.08, np.array([0.008, 0, 0])
    tick(memory, down, depth)
    state = tick(memory, down, depth, shift)
    wall, edge = 0.032, np.array([0.0, 0.0, 0.032])
    deep = np.array([0.0, 0.0, 1.0])
    places = [np.zeros(3), -edge, shift - edge, shift - deep]
    rest = np.column_stack([[0.0, wall, wall + 1e-9, 1.0], places])
    place, slope, moment = fine_beam(down, depth, rest, gauge)
    np.testing.assert_allclose(state[sv.TIP_OFFSET][:2], place[-1, :2], atol=3e-5)
    np.testing.assert_allclose(state[sv.TIP_SLOPE][:2], slope[-1, :2], atol=1e-3)
    force = moment[:2] / (LENGTH - depth)
    np.testing.assert_allclose(state[sv.FORCE][:2], force, atol=5e-3 * np.linalg.norm(force))
    assert state[sv.TIP_OFFSET_X] > 0.006  # the tip goes with the liver


def test_the_force_is_the_gradient_of_the_stored_energy_at_any_displacement(
    memory: FloatArray,
) -> None:
    rng = np.random.default_rng(3)
    for depth in np.linspace(0.0, 0.0737, 60):
        tick(memory, leaning(0.1 + 2.0 * depth), depth, rng.normal(0.0, 5e-3, 3))
    axis, depth = leaning(0.3, 0.9), 0.0737
    state = tick(memory, axis, depth, (0.006, -0.009, 0.004))
    assert state[sv.POTENTIAL] == effect.stored_energy(memory, axis) > 0.0
    assert abs(state[sv.FORCE] @ axis) < 1e-12
    for direction in (np.cross(axis, [1.0, 0, 0]), np.cross(axis, [0, 1.0, 0])):
        turned = [unit(axis + s * 1e-6 * direction) for s in (1.0, -1.0)]
        rise, fall = (effect.stored_energy(memory, n) for n in turned)
        moved = (turned[0] - turned[1]) * -(LENGTH - depth)  # of the hub
        assert -(rise - fall) == pytest.approx(state[sv.FORCE] @ moved, rel=1e-6)


def test_a_needle_inserted_where_the_organ_is_displaced_feels_nothing_there(
    memory: FloatArray,
) -> None:
    axis, shift = leaning(0.2), (0.005, 0.002, -0.01)
    for depth in np.linspace(0.0, 0.09, 200):
        force = tick(memory, axis, depth, shift)[sv.FORCE]
        assert np.abs(force).max() < 1e-12


def test_a_breath_held_at_another_place_than_where_it_was_pierced_leaves_a_side_force(
    memory: FloatArray,
) -> None:
    axis, first, second = leaning(0.1), (0.002, 0.0, 0.0), (-0.003, 0.0, 0.0)
    tick(memory, axis, 0.08, first)
    left = [tick(memory, axis, 0.08, second)[sv.FORCE] for _ in range(5)]
    np.testing.assert_array_equal(left[0], left[-1])
    assert left[0][0] > 0.1
    assert np.abs(tick(memory, axis, 0.08, first)[sv.FORCE]).max() < 1e-12


def test_over_any_wandering_no_more_comes_out_than_breathing_supplied(memory: FloatArray) -> None:
    rng = np.random.default_rng(8)
    axis, depth, shift = leaning(0.1), 0.0, np.zeros(3)
    given = supplied = changed = 0.0
    for _ in range(3000):
        goal = unit(axis + rng.normal(0.0, 2e-3, 3))
        forces = [tick(memory, n, depth, shift)[sv.FORCE] for n in (axis, unit(axis + goal), goal)]
        mean = (forces[0] + 4.0 * forces[1] + forces[2]) / 6.0
        given += float(mean @ (goal - axis) * -(LENGTH - depth))  # the tissue's work on the hub
        axis = goal
        if rng.random() < 0.5:
            shift = np.clip(shift + rng.normal(0.0, 2e-3, 3), -0.02, 0.02)
            gain = tick(memory, axis, depth, shift)[sv.GAIN_WORK]
            supplied += gain
        else:
            depth = float(np.clip(depth + rng.normal(0.0005, 4e-3), -0.01, 0.12))
            gain = tick(memory, axis, depth, shift)[sv.GAIN_WORK]
            assert gain < 1e-9  # advancing adds nothing, retreating loses
        changed += gain
        stored = effect.stored_energy(memory, axis)
        assert given + stored <= supplied + 1e-6
        assert given + stored == pytest.approx(changed, abs=2e-6)  # nothing is forgotten
    assert supplied > 1e-3


def test_tissue_that_moves_once_round_and_back_stores_what_it_did_before(
    memory: FloatArray,
) -> None:
    axis, turned = leaning(0.1), leaning(0.15)
    tick(memory, axis, 0.08)
    before, rounds = tick(memory, turned, 0.08), []
    for angle in np.linspace(0.0, 2.0 * np.pi, 50):
        shift = 0.006 * np.array([np.sin(angle), np.cos(angle) - 1.0, 0.0])
        rounds.append(tick(memory, turned, 0.08, shift)[sv.GAIN_WORK])
    after = tick(memory, turned, 0.08)
    np.testing.assert_allclose(after[sv.FORCE], before[sv.FORCE], atol=1e-12)
    assert sum(rounds) + after[sv.GAIN_WORK] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("models", [("beam", "winkler"), ("winkler", "beam")])
def test_another_model_takes_over_the_channel_and_where_the_organ_is(
    models: tuple[str, str],
) -> None:
    old, new = (tissue(model) for model in models)
    axis, shift = leaning(0.1), (0.004, -0.002, 0.003)
    tick(old, axis, 0.0812, shift)
    effect.carry(old, new)
    taken = tick(new, axis, 0.0812, shift)
    assert np.abs(taken[sv.FORCE]).max() < 1e-9
    assert taken[sv.GAIN_WORK] == pytest.approx(0.0, abs=1e-12)
    assert np.abs(tick(new, axis, 0.0812)[sv.FORCE]).max() > 0.1


def test_without_breathing_the_array_has_nothing_of_it_and_a_shift_moves_nothing() -> None:
    scene = Scene(layers=DEFAULT_LAYERS)
    still = memory_of("lateral_tissue", {}, Binding(scene, model="beam"))
    assert len(still) < len(tissue())
    tick(still, leaning(0.0), 0.08)
    assert not tick(still, leaning(0.0), 0.08, (0.01, 0.0, 0.0))[sv.FORCE].any()


def test_layers_move_from_the_breathing_organ_inwards_or_as_they_say() -> None:
    def shares(organ: str, target: str = "", **moves: float) -> tuple[float, ...]:
        names = ("skin", "muscle", "liver capsule", "liver", "fat behind")
        layers = tuple(TissueLayer(n, 0.02, moves=moves.get(n)) for n in names)
        return Scene(
            (EffectRequest("breathing", organ=organ),), layers, target_organ=target
        ).shares_moved

    assert shares("liver") == shares("", "liver") == (0.0, 0.0, 1.0, 1.0, 1.0)
    assert shares("") == (0.0, 0.0, 0.0, 0.0, 1.0)
    assert shares("lung") == (0.0,) * 5
    assert shares("liver", muscle=0.3, liver=0.5) == (0.0, 0.3, 1.0, 0.5, 1.0)
    assert Scene(layers=DEFAULT_LAYERS).shares_moved == (0.0,) * 4
    with pytest.raises(SimulationError, match=r"layer 'x': moves is 1.5; give a share from 0 to 1"):
        TissueLayer("x", 0.1, moves=1.5)


def test_the_device_that_renders_the_drag_is_a_consumer_of_breathing() -> None:
    scene = Scene((BREATH, EffectRequest("lateral_tissue")))
    kept = {k.name: k for k in compile(scene, DevicePort("icube")).kept}
    assert list(kept) == ["breathing", "lateral_tissue"]
    assert any("lateral_tissue" in who for who in kept["breathing"].consumers)


@pytest.mark.long("machine")
def test_shipped_exercises_that_breathe_drag_the_needle_and_no_others_do() -> None:
    def moved(name: str) -> bool:
        chosen = load_exercise(name)
        return any(scene_of(chosen, device_of(chosen)).shares_moved)

    assert moved("hold-the-breath")
    assert moved("breathing-liver")
    assert not any(moved(n) for n in ("first-insertion", "thick-tissue", "scans-only"))


def test_the_energy_bound_holds_what_turning_can_give_back_at_any_displacement(
    memory: FloatArray,
) -> None:
    rng, bound = np.random.default_rng(2), effect.energy_bound(memory)
    for _ in range(200):
        way = unit(rng.normal(size=3)) * effect.FURTHEST
        for depth in (0.0, 0.03, 0.1, 0.18):
            tick(memory, unit(rng.normal(size=3)), depth, way)
        axes = [unit(rng.normal(size=3)) for _ in range(4)]
        energies = [effect.stored_energy(memory, n) for n in axes]
        assert max(energies) - min(energies) <= bound
