"""Models of tissue as it was measured: potential, layers and fields alike, one hole, rest."""

from dataclasses import replace

import numpy as np
import pytest
from simulation.axial_rig import ALL, follow, given_out, stages_of
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation import rupture, standing, tissues
from app.simulation.consumers import DevicePort
from app.simulation.effects import bevel, cutting, implementation, lateral_tissue, puncture
from app.simulation.errors import SimulationError
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.plan import compile
from app.simulation.scene import Binding, EffectRequest, Needle, Scene, TissueLayer

MODELS = {
    name: model
    for name, model in tissues.MODELS[tissues.PUBLISHED].items()
    if name in ALL and name != "bone_contact"
}
ALONG = tuple(MODELS)
BIN = 2.0**-10
WALL = tuple(
    replace(tissues.tissue(name), thickness=bins * BIN)
    for name, bins in (("skin", 2), ("fat", 15), ("muscle", 15), ("liver", 160))
)
AIR = TissueLayer(
    "air", 0.0, side_stiffness=0.0, friction=0.0, static_friction=0.0, viscous_friction=0.0
)
KEPT = ("skin", "fat", "liver", "bone")
TABLE = (tissues.MUSCLE, AIR, *WALL)
"""Values by code: nobody's, air, and the four of the wall."""


def ramp(begin: float, end: float, speed: float = 0.01) -> FloatArray:
    ticks = round(abs(end - begin) / speed * 1e3)
    return np.linspace(begin, end, ticks + 1)


FORMER = {
    ("ball_joint", "kikuuwe"): 16,
    ("ball_joint", "dahl"): 16,
    ("ball_joint", "lugre"): 16,
    ("bevel", "arc"): 2582,
    ("bevel", "drifting"): 2582,
    ("bone_contact", "exact"): 7,
    ("bone_contact", "implicit"): 7,
    ("breathing", "lujan"): 10,
    ("breathing", "on_command"): 52,
    ("breathing", "varying"): 522,
    ("cutting", "displacement"): 18,
    ("cutting", "speed"): 18,
    ("cutting", "switched"): 18,
    ("dimpling", "membrane"): 20,
    ("dimpling", "drag"): 20,
    ("lateral_tissue", "beam"): 4464,
    ("lateral_tissue", "winkler"): 4464,
    ("puncture", "instant"): 21,
    ("puncture", "snap"): 21,
    ("relaxation", "exact"): 22,
    ("relaxation", "midpoint"): 22,
    ("shaft_friction", "kikuuwe"): 26,
    ("shaft_friction", "dahl"): 24,
    ("shaft_friction", "lugre"): 26,
}
"""Numbers in the arrays of former models, in skin, fat, liver and bone: records hold them."""


@pytest.mark.parametrize(("name", "model"), FORMER)
def test_records_of_before_find_as_many_numbers_as_they_hold(name: str, model: str) -> None:
    scene = Scene(layers=tuple(tissues.TISSUES["first"][key] for key in KEPT))
    memory = memory_of(name, {}, Binding(scene, sv.PLANT_DEPTH, model))
    assert len(memory) == FORMER[name, model]


def test_a_target_is_dragged_along_by_the_tissue_that_the_field_has_at_the_tip() -> None:
    shifts = []
    for code in (2.0, 5.0):  # skin, liver
        scene, state = Scene(tissues=TABLE, field=object()), sv.empty_state()
        memory = memory_of("dimpling", {}, Binding(scene, sv.PLANT_DEPTH, "drag"))
        state[sv.AXIS_Z], state[sv.DT], state[sv.PLANT_DEPTH] = -1.0, 1e-3, 0.05
        state[sv.AXIAL_FORCE], state[sv.TISSUE] = 0.5, code
        for _ in range(200):
            state[sv.TARGET_SHIFT] = 0.0
            implementation("dimpling").step(state, memory)
        shifts.append(-state[sv.TARGET_SHIFT_Z])
    stiff, soft = (TABLE[code].indentation(0.5) for code in (2, 5))
    assert shifts[0] / shifts[1] == pytest.approx(stiff / min(soft, 0.01), rel=1e-3)


# --- kernels --------------------------------------------------------------------------------------
def test_the_force_of_a_membrane_pushed_at_once_is_the_slope_of_what_it_stores() -> None:
    stages = stages_of("puncture", layers=[tissues.LIVER], models=MODELS)
    memory, forces, energies = stages[-1].parameters, [], []
    for depth in np.arange(0.0, 0.004, 1e-6):  # 1 µm in a tick of no time: nothing relaxes
        forces.append(follow(stages, [depth], 0.0).force["puncture"][0])
        energies.append(puncture.stored_energy(memory))
    slope = (np.array(energies)[2:] - np.array(energies)[:-2]) / 2e-6
    np.testing.assert_allclose(slope, forces[1:-1], rtol=1e-5, atol=1e-7)


@pytest.mark.parametrize("tau", [0.01, 0.5, 50.0])
def test_branches_are_exact_at_any_step(tau: float) -> None:
    steps = (1, 2, 50)
    ends = []
    for n in steps:
        e = f = g = 1e-3
        for _ in range(n):
            e = standing.stretched(e, 2e-3 / n, 0.3 / n, tau)
            f = standing.slipping(f, 2e-6 / n, 0.3 / n, tau, 1.0, 1e3)
            g = standing.pressed(g, 0.7, 2e-3 / n, 1e-3, 0.3 / n, tau)
        ends.append((e, f, g))
    for one in ends[1:]:
        np.testing.assert_allclose(one, ends[0], rtol=1e-9)
    exact = 1e-3 * np.exp(-0.3 / tau) + 2e-3 * tau / 0.3 * (1.0 - np.exp(-0.3 / tau))
    assert ends[0][0] == pytest.approx(exact, rel=1e-12)


def test_the_force_of_rupture_falls_with_speed_to_its_floor() -> None:
    speeds = np.array([0.0, 0.003, 0.02, 0.1, 1.0, 10.0])
    shares = np.array([rupture.falling(v, 0.02, 0.6) for v in speeds])
    assert shares[0] == 1.0
    assert (np.diff(shares) <= 0.0).all()
    assert shares[-1] == pytest.approx(0.6)
    assert rupture.falling(-5.0, 0.02, 0.6) == 1.0


@pytest.mark.parametrize("speed", [0.001, 0.005, 0.05, 0.2])
def test_no_tick_changes_the_force_more_than_the_motion_does(speed: float) -> None:
    """A puncture lets go in its time, not in a tick; the tip's forces come over their ways."""
    found = follow(stages_of(*ALONG, layers=[tissues.LIVER], models=MODELS), ramp(0.0, 0.05, speed))
    total = found.states[:, sv.AXIAL_FORCE]
    assert found.states[-1, sv.PUNCTURES] == 1.0
    travel, freed = 1e-3 * speed, 1e-3  # the tip's way, and the dimple's beside it, in a tick [m]
    tip = 0.208 * (1.0 - np.exp(-travel / 1e-4)) + 0.8 * (1.0 - np.exp(-travel / 3e-4))
    dimple, shaft = 0.1 * 0.6, (travel + freed) * (18.45 + 250.0 * speed)
    assert np.abs(np.diff(total)).max() < tip + dimple + shaft


def test_the_whole_gives_out_nothing_on_the_way_in_and_out_and_in() -> None:
    path = np.concatenate([ramp(-0.002, 0.06), ramp(0.06, -0.002, 0.03), ramp(-0.002, 0.07)])
    found = follow(stages_of(*ALONG, layers=WALL, models=MODELS), path)
    assert given_out(found.states[:, sv.AXIAL_FORCE], path).max() <= 1e-6


# --- one hole, fresh tissue -----------------------------------------------------------------------
def cut(memory: FloatArray, depths: FloatArray, tilt: float = 0.0) -> FloatArray:
    state, forces = sv.empty_state(), []
    state[sv.AXIS_X], state[sv.AXIS_Z], state[sv.DT] = np.sin(tilt), -np.cos(tilt), 1e-3
    for depth in depths:
        state[sv.PLANT_DEPTH], state[sv.AXIAL_FORCE] = depth, 0.0
        cutting.step(state, memory)
        forces.append(state[sv.AXIAL_FORCE])
    return np.array(forces)


def test_cutting_costs_where_the_tip_was_not_and_nothing_where_it_was() -> None:
    scene = Scene(layers=(tissues.LIVER,))
    memory = memory_of("cutting", {}, Binding(scene, sv.PLANT_DEPTH, "track"))
    there, back = ramp(0.0, 0.08), ramp(0.08, 0.0)
    whole = 164.0 * 1.270e-3
    assert cut(memory, there)[-1] == pytest.approx(whole, rel=0.02)
    cut(memory, back)
    assert np.abs(cut(memory, there)).max() < 1e-9
    assert cut(memory, ramp(0.08, 0.09))[-1] == pytest.approx(whole, rel=0.02)  # on from its end
    cut(memory, ramp(0.09, 0.0))
    aslant = cut(memory, there, tilt=0.05)  # 1.27 mm away from 25 mm of depth on
    depth = there[int(np.argmax(aslant > 0.5 * whole))]
    assert depth == pytest.approx(1.270e-3 / (2.0 * np.sin(0.025)), abs=1.5e-3)
    cut(memory, back, tilt=0.05)
    assert np.abs(cut(memory, there)).max() < 1e-9  # the first way is remembered
    assert np.abs(cut(memory, there, tilt=0.05)).max() < 1e-9


def test_a_hole_in_a_membrane_is_opened_at_its_share_and_counts_once() -> None:
    path = np.concatenate([ramp(-0.001, 0.03), ramp(0.03, -0.001), ramp(-0.001, 0.03)])
    found = follow(stages_of("puncture", layers=[tissues.LIVER], models=MODELS), path)
    force, third = found.force["puncture"], len(path) // 3
    assert found.states[-1, sv.PUNCTURES] == 1.0
    assert force[2 * third :].max() < 0.4 * force[:third].max()


# --- layers and a field, one law ------------------------------------------------------------------
def driven(
    name: str, model: str, path: FloatArray, by_field: bool, tilt: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """Force at each depth, and the last state; a field that has the layers' tissues and walls."""
    scene = Scene(
        layers=WALL,
        tissues=TABLE if by_field else (),
        field=object() if by_field else None,
        needle=Needle(outer_diameter=OUTER_DIAMETER[18]),
    )
    memory = memory_of(name, {}, Binding(scene, sv.PLANT_DEPTH, model))
    step = {"lateral_tissue": lateral_tissue.step}.get(name) or stages_of(name)[-1].function
    ends = np.cumsum([layer.thickness for layer in WALL])
    walls = np.array([0.0, *ends[:-1]])
    deepest, forces = -1.0, []
    state = sv.empty_state()
    for k, depth in enumerate(path):
        state[:] = 0.0
        turned = tilt if k > 0.5 * len(path) else 0.0
        state[sv.AXIS_X], state[sv.AXIS_Z] = np.sin(turned), -np.cos(turned)
        state[sv.DT], state[sv.DEPTH_SOURCE], state[sv.L_OUT] = 1e-3, 1.0, 0.1
        state[sv.PLANT_DEPTH] = state[sv.DEPTH] = depth
        layer = -1 if depth < 0.0 else int(np.searchsorted(ends, depth, side="right"))
        state[sv.TISSUE] = 2 + layer
        state[sv.WALL] = walls[int(np.argmin(np.abs(walls - depth)))] - depth
        state[sv.CHANNEL] = float(depth <= deepest)
        deepest = max(deepest, depth)
        step(state, memory)
        forces.append(state[sv.AXIAL_FORCE] + state[sv.FORCE_X])
    return np.array(forces), state


@pytest.mark.long("machine")
@pytest.mark.parametrize(("name", "model"), MODELS.items())
def test_a_field_of_the_same_walls_is_felt_as_the_layers_are(name: str, model: str) -> None:
    path = np.concatenate([ramp(-0.002, 0.06), ramp(0.06, -0.002), ramp(-0.002, 0.05)])
    layers, _ = driven(name, model, path, by_field=False)
    field, _ = driven(name, model, path, by_field=True)
    assert np.abs(layers).max() > 0.3
    np.testing.assert_allclose(field, layers, atol=2e-3)


def test_the_shaft_keeps_the_tissue_that_its_bins_were_cut_in() -> None:
    path = np.concatenate([ramp(0.0, 0.08, 0.05), np.full(20, 0.08), ramp(0.08, 0.05, 0.05)])
    layers, beam = driven("lateral_tissue", "beam", path, by_field=False, tilt=0.05)
    field, bent = driven("lateral_tissue", "field", path, by_field=True, tilt=0.05)
    assert np.abs(layers).max() > 0.05
    np.testing.assert_allclose(field, layers, atol=1e-3 * np.abs(layers).max())
    np.testing.assert_allclose(bent[sv.TIP_OFFSET], beam[sv.TIP_OFFSET], atol=2e-6)


def test_a_field_without_values_is_refused() -> None:
    with pytest.raises(SimulationError, match="field of tissue and no values"):
        Scene(field=object())


def test_breathing_that_carries_the_tissue_rubs_and_cuts_nothing_by_itself() -> None:
    """A needle that goes with its tissue, to and fro by 5 mm, is at rest in it."""
    scene = Scene(tissues=TABLE, field=object())
    memory = memory_of("shaft_friction", {}, Binding(scene, sv.PLANT_DEPTH, "inserted"))
    step, state, forces = stages_of("shaft_friction")[-1].function, sv.empty_state(), []
    for k in range(4000):
        state[sv.AXIAL_FORCE], state[sv.AXIS_Z], state[sv.DT] = 0.0, -1.0, 1e-3
        carried = 0.005 * np.sin(2e-3 * k) if k > 1000 else 0.0
        state[sv.TISSUE], state[sv.CARRIED_Z] = 5.0, -carried
        state[sv.PLANT_DEPTH] = min(6e-5 * k, 0.06) + carried
        step(state, memory)
        forces.append(state[sv.AXIAL_FORCE])
    moved = np.abs(np.diff(forces[1001:])).max()
    assert forces[1000] > 0.4
    assert moved < 1e-3


# --- rest, gauge, order ---------------------------------------------------------------------------
def test_friction_of_a_needle_at_rest_relaxes_and_takes_more_to_break_away() -> None:
    slide = ramp(0.0, 0.06)
    layer = replace(tissues.LIVER, viscous_friction=0.0, puncture_force=0.0)
    path = np.concatenate([slide, np.full(60_000, 0.06), ramp(0.06, 0.065, 0.001)])
    force = follow(stages_of("shaft_friction", layers=[layer], models=MODELS), path).force[
        "shaft_friction"
    ]
    n = len(slide)
    sliding, rested = force[n - 1], force[n + 59_999]
    assert 0.5 * sliding < rested < 0.8 * sliding
    assert force[n + 60_000 :].max() > 1.2 * sliding
    assert force[-1] == pytest.approx(sliding * 0.065 / 0.06, rel=0.05)


def test_the_order_in_which_effects_of_before_run_is_as_it_was() -> None:
    """What reads more is put behind what it reads; the models of before read what they read."""
    port = DevicePort("icube", simulated=True)
    names = ("puncture", "cutting", "relaxation", "shaft_friction")
    old = compile(Scene(tuple(EffectRequest(name) for name in names)), port)
    assert [kept.name for kept in old.kept] == [
        *("puncture", "shaft_friction", "cutting", "relaxation")
    ]
    new = tuple(EffectRequest(name, model=MODELS[name]) for name in reversed(names))
    assert next(kept.name for kept in compile(Scene(new), port).kept) == "puncture"


def test_a_dimple_that_relaxes_twice_is_warned_of() -> None:
    port = DevicePort("icube", simulated=True)

    def warned(first: str, second: str) -> tuple[str, ...]:
        requests = EffectRequest("puncture", model=first), EffectRequest("relaxation", model=second)
        return compile(Scene(requests), port).warnings()["relaxation"]

    assert warned("rate", "standing") == ()
    assert warned("snap", "exact") == ()
    assert "take the model standing" in warned("rate", "exact")[0]
    assert "does not relax" in warned("snap", "standing")[0]


def test_thinner_needles_bend_more_in_gel_and_less_in_an_organ() -> None:
    bends = [bevel.measured_curvature(d) for _, d in sorted(OUTER_DIAMETER.items())]
    assert (np.diff(bends) > 0.0).all()
    ends = {}
    for model in ("gel", "organ"):
        scene = Scene(needle=Needle(outer_diameter=OUTER_DIAMETER[22]))
        memory, state = memory_of("bevel", {}, Binding(scene, model=model)), sv.empty_state()
        state[sv.AXIS_Z], state[sv.DEPTH], state[sv.DEPTH_SOURCE] = -1.0, 0.08, 1.0
        bevel.step(state, memory)
        ends[model] = 1e3 * np.hypot(state[sv.TIP_OFFSET_X], state[sv.TIP_OFFSET_Y])
    assert ends["gel"] == pytest.approx(8.85, abs=0.05)
    assert ends["organ"] / ends["gel"] == pytest.approx(0.65, abs=0.01)
