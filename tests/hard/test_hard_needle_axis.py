"""Hard cases along the needle: energy over any closed path, any input, jumps, rest, speed."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simulation.axial_rig import ALL, follow, given_out, stages_of
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.simulation.effects import declaration, implementation
from app.simulation.scene import FAT, MUSCLE, SKIN, Binding, Scene, TissueLayer

QUICK = settings(derandomize=True, deadline=None, max_examples=25)
ANY = st.floats(allow_nan=True, allow_infinity=True)
ORGAN = TissueLayer(
    "organ", 0.02, puncture_force=0.6, toughness=164.0, relaxation_share=0.6, relaxation_time=0.05
)
LAYERS = (SKIN, FAT, MUSCLE, ORGAN, TissueLayer("bone", 0.03, rigid=True))
FORCES = [name for name in ALL if name != "dimpling"]
CASES = [(name, model) for name in FORCES for model in declaration(name).models]
LONGEST = 0.3e-3
"""Way in a tick [m]: 0.3 m/s at 1 ms."""


@st.composite
def closed_paths(draw: st.DrawFn) -> tuple[np.ndarray, np.ndarray]:
    """Depths from outside back to outside, at any pace within `LONGEST`, and the ticks' lengths."""
    turns = draw(st.lists(st.floats(-0.002, 0.056), min_size=1, max_size=12))
    seed = draw(st.integers(0, 2**32 - 1))
    random = np.random.default_rng(seed)
    depths, now = [-0.002], -0.002
    for turn in (*turns, -0.002):
        pace = LONGEST * 10.0 ** -random.uniform(0.0, 1.5)
        while now != turn:
            now += float(np.clip(turn - now, -pace, pace)) * float(random.choice([1.0, 1.0, 0.3]))
            if abs(now - turn) < 1e-6:
                now = turn
            depths.append(now)
        depths += [now] * int(random.integers(0, 30))  # the hand rests
    return np.array(depths), random.choice([0.25e-3, 1e-3, 5e-3], len(depths))


@pytest.mark.long("statistics")
@pytest.mark.parametrize(("name", "model"), CASES)
@QUICK
@given(closed_paths())
def test_none_gives_out_more_than_its_declared_stored_energy(
    name: str, model: str, path: tuple[np.ndarray, np.ndarray]
) -> None:
    depths, steps = path
    before = ("puncture",) if name in ("cutting", "relaxation") else ()
    models = {name: model, **({"puncture": "snap"} if before else {})}
    found = follow(stages_of(*before, name, layers=LAYERS, models=models), depths, steps)
    bound = implementation(name).axial_energy_bound(found.stages[name].parameters)
    out = given_out(found.force[name], depths)
    assert out.max() <= bound
    assert out[-1] <= 0.1 * bound  # back outside, and nothing gained


@pytest.mark.long("statistics")
@pytest.mark.parametrize(("name", "model"), CASES)
@QUICK
@given(st.lists(st.tuples(ANY, ANY), max_size=30))
def test_any_depth_and_step_leave_a_bounded_force(
    name: str, model: str, ticks: list[tuple[float, float]]
) -> None:
    stages = stages_of(name, layers=LAYERS, models={name: model})
    viscous = 250.0 * 0.08 * 10.0  # at the fastest that a depth is believed to go
    for depth, dt in [*ticks, (0.03, 1e-3), (0.03, 1e-3)]:
        with np.errstate(all="ignore"):
            found = follow(stages, [depth], [dt])
        assert abs(found.force[name][0]) <= 60.0 + viscous
    assert np.isfinite(found.states).all()


@pytest.mark.parametrize("model", ["membrane", "drag"])
@QUICK
@given(st.lists(st.tuples(ANY, ANY, ANY), max_size=30))
def test_the_target_never_leaves_its_bound(
    model: str, ticks: list[tuple[float, float, float]]
) -> None:
    memory = memory_of("dimpling", {}, Binding(Scene(layers=LAYERS), sv.PLANT_DEPTH, model))
    step, state = implementation("dimpling").step, sv.empty_state()
    for indentation, force, target in ticks:
        state[sv.TARGET_SHIFT] = 0.0
        state[sv.AXIS_Z], state[sv.PLANT_DEPTH], state[sv.DT] = -1.0, 0.05, 1e-3
        state[sv.INDENTATION], state[sv.AXIAL_FORCE] = indentation, force
        state[sv.TARGET_X] = target
        with np.errstate(all="ignore"):
            step(state, memory)
        assert np.abs(state[sv.TARGET_SHIFT]).max() <= 0.7 * 0.01


@pytest.mark.parametrize("model", ["instant", "snap"])
def test_a_puncture_in_one_tick_lets_out_no_energy(model: str) -> None:
    """The force falls by more than 80 % in a tick, again and again, at every phase of the tick."""
    layer = TissueLayer("x", 0.2, puncture_force=2.0, indentation_hardening=5e4)
    for phase in np.linspace(0.0, 1.0, 23):
        ahead = np.arange(-0.001 + phase * LONGEST, 0.012, LONGEST)
        depths = np.concatenate([ahead, ahead[::-1]] * 3)
        found = follow(stages_of("puncture", layers=[layer], models={"puncture": model}), depths)
        force = found.force["puncture"]
        drop = int(np.argmax(force)) + 1
        assert model == "snap" or force[drop] < 0.2 * force[drop - 1]
        assert given_out(force, depths).max() <= 0.0
        assert np.abs(force).max() <= 2.0 + 1e-12


def test_a_depth_that_jumps_through_all_layers_punctures_them_one_a_tick() -> None:
    found = follow(stages_of("puncture", layers=LAYERS), [-0.01, *([0.05] * 6)])
    counts = found.states[:, sv.PUNCTURES]
    assert (np.diff(counts) <= 1.0).all()
    assert found.force["puncture"].max() <= 1.5


@pytest.mark.parametrize("stiffness", [1e4, 1e5, 1e6, 1e9])
@pytest.mark.parametrize("law", ["kikuuwe", "dahl", "lugre"])
def test_every_law_of_friction_stays_within_its_level_at_300_mm_per_s(
    law: str, stiffness: float
) -> None:
    layer = TissueLayer("x", 9.0, viscous_friction=0.0)
    given = {"presliding_stiffness": stiffness, "bristle_damping": 1e4}
    stages = stages_of(
        "shaft_friction",
        layers=[TissueLayer("x", 0.9, viscous_friction=0.0)],
        models={"shaft_friction": law},
        parameters={"shaft_friction": given},
    )
    for dt in (0.25e-3, 1e-3, 5e-3):
        depths = 0.05 + 0.3 * dt * np.arange(300)
        force = follow(stages, depths, dt).force["shaft_friction"]
        assert (np.abs(force) <= layer.static_friction * depths).all()
        assert force[-1] == pytest.approx(10.57 * depths[-1], rel=2e-2)


def test_ten_idle_minutes_leave_no_subnormals() -> None:
    stages = stages_of(*ALL, layers=LAYERS, models={"puncture": "snap"})
    follow(stages, np.arange(-0.001, 0.03, 1e-4))
    follow(stages, np.full(10_000, 0.03), 5e-3)
    for stage in stages:
        values = np.abs(stage.parameters[np.isfinite(stage.parameters)])
        assert not ((values > 0.0) & (values < 1e-300)).any(), stage.name


def test_a_needle_without_layers_below_it_is_where_the_last_one_is() -> None:
    found = follow(stages_of("cutting", layers=[ORGAN]), np.arange(0.0, 0.2, 1e-3))
    assert found.force["cutting"][-1] == pytest.approx(164.0 * 1.270e-3, rel=1e-3)
    assert math.isfinite(found.states[-1, sv.AXIAL_FORCE])
