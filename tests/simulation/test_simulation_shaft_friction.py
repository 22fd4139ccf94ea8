"""Shaft friction: level, sign, exactness at any step, energy."""

import numpy as np
import pytest
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.dry_friction import dahl
from app.simulation.effects import shaft_friction as effect
from app.simulation.scene import Binding, Scene, TissueLayer

LAYERS = (TissueLayer("a", 0.2, friction=10.0, static_friction=18.0, viscous_friction=200.0),)


def friction(**parameters: float) -> FloatArray:
    return memory_of("shaft_friction", parameters, Binding(Scene(layers=LAYERS), sv.PLANT_DEPTH))


def tick(memory: FloatArray, depth: float, dt: float = 1e-3) -> float:
    state = sv.empty_state()
    state[sv.PLANT_DEPTH], state[sv.DT] = depth, dt
    effect.step(state, memory)
    return float(state[sv.AXIAL_FORCE])


def test_sliding_costs_the_kinetic_level_and_the_viscous_part_per_inserted_length() -> None:
    memory = friction()
    for k in range(200):
        force = tick(memory, 0.06 + 0.02e-3 * k)  # 20 mm/s
    depth = 0.06 + 0.02e-3 * 199
    # f trails its growing level by the presliding distance, a thousandth of it here.
    assert force == pytest.approx(depth * (10.0 + 200.0 * 0.02), rel=2e-3)


def test_it_opposes_the_motion_both_ways() -> None:
    memory = friction()
    inward = [tick(memory, 0.05 + 1e-4 * k) for k in range(20)]
    outward = [tick(memory, 0.0519 - 1e-4 * k) for k in range(1, 20)]
    assert inward[-1] > 0.0 > outward[-1]


def test_a_needle_at_rest_holds_its_force() -> None:
    memory = friction()
    for k in range(50):
        tick(memory, 0.05 + 1e-5 * k)
    rest = [tick(memory, 0.05049) for _ in range(1000)]
    assert np.ptp(rest[1:]) == 0.0
    assert rest[-1] > 0.0


@pytest.mark.parametrize("pieces", [1, 7, 100])
def test_the_update_is_exact_over_any_split_of_a_displacement(pieces: int) -> None:
    force = -0.3
    for _ in range(pieces):
        force = dahl(force, 2e-4 / pieces, 1.0, 1e4)
    assert force == pytest.approx(1.0 + (-0.3 - 1.0) * np.exp(-2.0), rel=1e-12)


def test_it_agrees_with_a_fine_integration_of_dahls_equation() -> None:
    force, travel, level, stiffness = 0.2, 3e-4, 0.9, 8e3
    steps = 200_000
    reference = force
    for _ in range(steps):
        reference += travel / steps * stiffness * (1.0 - reference / level)
    assert dahl(force, travel, level, stiffness) == pytest.approx(reference, rel=1e-5)


def test_a_cycle_dissipates_all_but_the_presliding_energy() -> None:
    memory = friction()
    depths = 0.05 + 0.01 * np.sin(np.linspace(0.0, 20.0 * np.pi, 20_000))
    forces = np.array([tick(memory, d) for d in depths])
    work = np.cumsum(0.5 * (forces[1:] + forces[:-1]) * np.diff(depths))  # put in by the hand
    sigma = 1e5 * 0.06
    assert work.min() > -((18.0 * 0.06) ** 2) / (2.0 * sigma)
    assert work[-1] > 0.4 * 10 * 4 * 0.01 * 10.0 * 0.05


def test_a_measured_depth_has_its_speed_smoothed() -> None:
    scene = Scene(layers=LAYERS)
    memory = memory_of("shaft_friction", {}, Binding(scene))
    assert memory[effect._AT.smoothing] == pytest.approx(0.03)
    assert friction()[effect._AT.smoothing] == 0.0


def test_outside_the_skin_there_is_none() -> None:
    memory = friction()
    assert [tick(memory, -0.01 + 1e-4 * k) for k in range(100)] == [0.0] * 100
