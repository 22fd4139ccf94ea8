"""Hard cases of tissue as it was measured: any field, any closed path, two at one place."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from simulation.axial_rig import follow, given_out, stages_of
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation import tissues
from app.simulation.effects import implementation, lateral_tissue
from app.simulation.scene import Binding, Scene, TissueLayer

QUICK = settings(derandomize=True, deadline=None, max_examples=40)
ANY = st.floats(allow_nan=True, allow_infinity=True)
CODE = st.one_of(st.integers(-1, 6).map(float), ANY)
AIR = TissueLayer("air", 0.0, friction=0.0, static_friction=0.0, viscous_friction=0.0)
TABLE = (tissues.MUSCLE, AIR, tissues.SKIN, tissues.FAT, tissues.LIVER)
SCENE = Scene(tissues=TABLE, field=object())
LAWS = {
    name: tissues.MODELS[tissues.PUBLISHED][name]
    for name in ("puncture", "relaxation", "cutting", "shaft_friction")
}
MOST = 60.0 + 250.0 * 0.25 * 10.0
"""Stated force of every law [N], and viscous friction at the fastest that a depth is believed."""

TICKS = st.lists(
    st.fixed_dictionaries(
        {
            "plant_depth": st.one_of(st.floats(-0.01, 0.2), ANY),
            "dt": st.one_of(st.floats(1e-4, 5e-3), ANY),
            "tissue": CODE,
            "wall": st.one_of(st.floats(-0.01, 0.01), ANY),
            "channel": st.sampled_from([0.0, 1.0]),
            "carried_x": st.one_of(st.floats(-0.02, 0.02), ANY),
            "carried_z": st.one_of(st.floats(-0.02, 0.02), ANY),
            "indentation": st.one_of(st.just(0.0), ANY),
        }
    ),
    max_size=30,
)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", LAWS)
@QUICK
@given(TICKS)
def test_any_field_and_depth_leave_a_bounded_force(
    name: str, ticks: list[dict[str, float]]
) -> None:
    step = implementation(name).step
    memory = memory_of(name, {}, Binding(SCENE, sv.PLANT_DEPTH, LAWS[name]))
    state = sv.empty_state()
    last = {"plant_depth": 0.03, "dt": 1e-3, "tissue": 4.0, "wall": 1.0, "indentation": 0.0}
    for slots in (*ticks, last, last):
        state[:] = 0.0
        state[sv.AXIS_Z] = -1.0
        for slot, value in slots.items():
            state[sv.INDEX[slot]] = value
        with np.errstate(all="ignore"):
            step(state, memory)
        assert abs(state[sv.AXIAL_FORCE]) <= MOST
    assert np.isfinite(state).all()


@st.composite
def closed_paths(draw: st.DrawFn) -> FloatArray:
    """Draw depths from outside back to outside, with rests, at any pace up to 0.3 m/s."""
    turns = draw(st.lists(st.floats(-0.002, 0.07), min_size=1, max_size=10))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    depths = [np.array([-0.002])]
    for turn in (*turns, -0.002):
        ticks = max(int(abs(turn - depths[-1][-1]) / (3e-4 * 10.0 ** -random.uniform(0, 1.5))), 1)
        depths.append(np.linspace(depths[-1][-1], turn, ticks + 1)[1:])
        depths.append(np.full(int(random.integers(1, 200)), turn))
    return np.concatenate(depths)


@pytest.mark.long("statistics")
@QUICK
@given(closed_paths())
def test_the_whole_gives_out_no_more_than_it_holds_and_nothing_in_the_end(
    path: FloatArray,
) -> None:
    layers = [
        replace(tissues.tissue(name), thickness=thickness)
        for name, thickness in (("skin", 0.002), ("fat", 0.01), ("muscle", 0.01), ("liver", 0.2))
    ]
    found = follow(stages_of(*LAWS, layers=layers, models=LAWS), path)
    out = given_out(found.states[:, sv.AXIAL_FORCE], path)
    bound = sum(
        implementation(name).axial_energy_bound(found.stages[name].parameters) for name in LAWS
    )
    assert out.max() <= bound
    assert out[-1] <= 0.05 * bound  # what a tick that leaves a dimple whole cannot tell


@pytest.mark.long("statistics")
@QUICK
@given(
    st.lists(st.tuples(st.floats(0.0, 0.15), st.floats(-0.3, 0.3), CODE), min_size=1, max_size=25)
)
def test_the_shaft_in_any_field_gives_out_no_more_than_it_holds(
    moves: list[tuple[float, float, float]],
) -> None:
    """What the hub was given is no more than what was put in; the potential keeps its bound."""
    memory = memory_of("lateral_tissue", {}, Binding(SCENE, model="field"))
    bound, state = lateral_tissue.energy_bound(memory), sv.empty_state()
    given_back, depth, tilt = 0.0, 0.0, 0.0

    def moment(there: float, turned: float, code: float) -> float:
        state[:] = 0.0
        state[sv.AXIS_X], state[sv.AXIS_Z] = np.sin(turned), -np.cos(turned)
        state[sv.DEPTH], state[sv.L_OUT], state[sv.TISSUE] = there, 0.1, code
        state[sv.DEPTH_SOURCE] = 1.0
        lateral_tissue.step(state, memory)
        assert 0.0 <= state[sv.POTENTIAL] <= bound
        assert np.isfinite([*state[sv.FORCE], *state[sv.TIP_OFFSET], *state[sv.TIP_SLOPE]]).all()
        return -0.1 * float(state[sv.FORCE_X] * np.cos(turned) + state[sv.FORCE_Z] * np.sin(turned))

    for to_depth, to_tilt, code in moves:
        for there in np.linspace(depth, to_depth, 20):
            last = moment(there, tilt, code)
        turns = np.linspace(tilt, to_tilt, 60)
        for turned in turns[1:]:
            now = moment(to_depth, turned, code)
            given_back += 0.5 * (last + now) * (turns[1] - turns[0])
            last = now
        assert given_back + state[sv.POTENTIAL] <= 1e-5 * max(bound, 1.0)
        depth, tilt = to_depth, to_tilt


def test_two_membranes_at_one_place_are_punctured_one_after_the_other() -> None:
    thin = TissueLayer("a", 0.0, puncture_force=0.5, indentation_hardening=5e4)
    behind = TissueLayer("b", 0.2, puncture_force=1.0, indentation_hardening=5e4)
    path = np.arange(-0.001, 0.03, 1e-5)
    found = follow(stages_of("puncture", layers=[thin, behind], models=LAWS), path)
    counts = found.states[:, sv.PUNCTURES]
    assert counts[-1] == 2.0
    assert (np.diff(counts) <= 1.0).all()
    assert np.isfinite(found.states).all()


def test_ten_idle_minutes_leave_no_subnormals_in_any_of_them() -> None:
    stages = stages_of(*LAWS, layers=[tissues.LIVER], models=LAWS)
    follow(stages, np.arange(-0.001, 0.03, 1e-4))
    follow(stages, np.full(10_000, 0.03), 1.0)
    for stage in stages:
        values = np.abs(stage.parameters[np.isfinite(stage.parameters)])
        assert not ((values > 0.0) & (values < 1e-300)).any(), stage.name
