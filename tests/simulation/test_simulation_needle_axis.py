"""Effects along the needle: puncture, cutting, relaxation, bone, dimpling, laws of friction."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from simulation.axial_rig import ALL, MOTION, SIMULATED, follow, given_out, stages_of
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import unit
from app.core.parameters import Stage
from app.device.control.table import machine_stages
from app.device.links.simulated import simulated_link
from app.mechanisms.profile import load_profile
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.effects import bone_contact, declaration, implementation, puncture, relaxation
from app.simulation.errors import SimulationError
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.plan import compile
from app.simulation.plant import SimulatedHand, initial_plant, plant_stage
from app.simulation.scene import (
    FAT,
    LIVER,
    SKIN,
    Binding,
    EffectRequest,
    Needle,
    Scene,
    TissueLayer,
    check_order,
)

GEL = TissueLayer("gel", 0.2, toughness=100.0)
CAPSULE = TissueLayer(
    "capsule",
    0.2,
    puncture_force=1.0,
    indentation_stiffness=100.0,
    indentation_hardening=20e3,
    relaxation_share=0.4,
    relaxation_time=0.2,
)
BONE = TissueLayer("rib", 0.02, rigid=True)
STEP = 20e-6
PROFILE = load_profile("icube")


def inwards(end: float, begin: float = -0.001, step: float = STEP) -> np.ndarray:
    return np.arange(begin, end, step)


# --- puncture -------------------------------------------------------------------------------------
def test_a_membrane_is_a_quadratic_spring_until_it_is_punctured() -> None:
    depths = inwards(0.02)
    found = follow(stages_of("puncture", layers=[CAPSULE]), depths)
    force, x = found.force["puncture"], np.maximum(depths, 0.0)
    first = int(np.argmax(force >= 1.0 - 1e-12))
    np.testing.assert_allclose(force[:first], (100.0 * x + 20e3 * x * x)[:first], rtol=1e-9)
    assert depths[first] == pytest.approx(CAPSULE.indentation(1.0), abs=STEP)
    assert (force[first + 1 :] == 0.0).all()
    assert found.states[-1, sv.PUNCTURES] == 1.0
    np.testing.assert_allclose(found.states[:first, sv.INDENTATION], x[:first], atol=1e-15)


def test_the_force_of_a_membrane_is_the_slope_of_what_it_stores() -> None:
    stages = stages_of("puncture", layers=[CAPSULE])
    memory = stages[-1].parameters
    energies, forces, depths = [], [], inwards(0.0049, 0.0, 1e-6)
    for depth in depths:
        forces.append(follow(stages, [depth]).force["puncture"][0])
        energies.append(puncture.stored_energy(memory))
    slope = (np.array(energies)[2:] - np.array(energies)[:-2]) / 2e-6
    np.testing.assert_allclose(slope, forces[1:-1], rtol=1e-6, atol=1e-8)


def test_a_puncture_takes_force_in_proportion_to_the_diameter() -> None:
    peaks = {
        gauge: follow(stages_of("puncture", layers=[LIVER], diameter=d), inwards(0.04))
        .force["puncture"]
        .max()
        for gauge, d in OUTER_DIAMETER.items()
    }
    assert peaks[18] == pytest.approx(0.6)
    assert peaks[22] == pytest.approx(0.6 * 0.718 / 1.270)


def test_a_membrane_behind_one_that_gave_way_begins_at_zero_force() -> None:
    stiff = TissueLayer("stiff", 0.2, puncture_force=3.0, indentation_hardening=1e6)
    soft = TissueLayer("soft", 0.002, puncture_force=0.5, indentation_hardening=2300.0)
    depths = inwards(0.03)
    force = follow(stages_of("puncture", layers=[soft, stiff]), depths).force["puncture"]
    drop = int(np.argmax(force >= 0.5))
    assert depths[drop] > 0.01  # far beyond where the stiff one lies at rest
    assert force[drop + 1] < 1e-3  # one step of the tip beyond where it met it
    assert force.max() == pytest.approx(3.0)


def test_a_punctured_membrane_is_a_hole_when_entered_again_and_counts_once() -> None:
    there = inwards(0.01)
    depths = np.concatenate([there, there[::-1], there, there[::-1]])
    found = follow(stages_of("puncture", layers=[CAPSULE]), depths)
    again = found.force["puncture"][2 * len(there) : 3 * len(there)]
    assert again.max() == pytest.approx(0.3)
    assert found.states[-1, sv.PUNCTURES] == 1.0


def test_grazing_a_punctured_membrane_does_not_close_it() -> None:
    x = CAPSULE.indentation(1.0)
    depths = [*inwards(x + 1e-4), *([x, x + 1e-4, 1e-4, x] * 50)]
    found = follow(stages_of("puncture", layers=[CAPSULE]), depths)
    assert (found.force["puncture"][-199:] == 0.0).all()
    assert found.states[-1, sv.PUNCTURES] == 1.0


def test_a_snapping_dimple_springs_back_in_its_time() -> None:
    x = CAPSULE.indentation(1.0)
    depths = [*inwards(x + STEP), *([x + STEP] * 100)]
    stages = stages_of("puncture", layers=[CAPSULE], models={"puncture": "snap"})
    dimple = follow(stages, depths).states[:, sv.INDENTATION]
    first = int(np.argmax(dimple))
    after = dimple[first : first + 50]
    np.testing.assert_allclose(after, after[0] * np.exp(-np.arange(50) / 10.0), rtol=1e-9)


# --- cutting --------------------------------------------------------------------------------------
@pytest.mark.parametrize("model", ["displacement", "speed", "switched"])
def test_cutting_costs_toughness_times_diameter_ahead_and_nothing_back(model: str) -> None:
    ahead = inwards(0.03, 0.0, 1e-4)
    stages = stages_of("cutting", layers=[GEL], models={"cutting": model})
    force = follow(stages, [*ahead, *ahead[::-1]]).force["cutting"]
    wanted = 100.0 * 1.270e-3 * (0.1 / 0.102 if model == "speed" else 1.0)
    assert force[len(ahead) - 1] == pytest.approx(wanted, rel=1e-4)
    assert force[-1] == pytest.approx(0.0, abs=1e-6)
    assert force.min() >= 0.0


def test_a_published_table_of_cutting_forces_follows_from_one_toughness() -> None:
    """Liver 164 J/m²: 0.24, 0.21, 0.15, 0.12 N with 17, 18, 20 and 22 G."""
    for gauge, wanted in {17: 0.24, 18: 0.21, 20: 0.15, 22: 0.12}.items():
        layer = TissueLayer("liver", 0.2, toughness=164.0)
        stages = stages_of("cutting", layers=[layer], diameter=OUTER_DIAMETER[gauge])
        assert round(follow(stages, inwards(0.02)).force["cutting"][-1], 2) == wanted


def test_a_tip_that_only_dimples_cuts_nothing() -> None:
    layer = TissueLayer("x", 0.2, toughness=1000.0, puncture_force=5.0, indentation_hardening=1e4)
    found = follow(stages_of("puncture", "cutting", layers=[layer]), inwards(0.02))
    assert found.states[-1, sv.INDENTATION] > 0.019
    assert np.abs(found.force["cutting"]).max() < 1e-9


# --- relaxation -----------------------------------------------------------------------------------
def test_relaxation_solves_the_standard_linear_solid_exactly_at_any_step() -> None:
    tau, change, h, begin = 0.2, 3e-3, 0.7, 1e-3
    solved = solve_ivp(
        lambda _, e: change / h - e / tau, (0.0, h), [begin], rtol=1e-12, atol=1e-15
    ).y[0, -1]
    assert relaxation.exact(begin, change, h, tau) == pytest.approx(solved, rel=1e-9)
    halves = relaxation.exact(
        relaxation.exact(begin, change / 2, h / 2, tau), change / 2, h / 2, tau
    )
    assert halves == pytest.approx(relaxation.exact(begin, change, h, tau), rel=1e-13)


def test_both_models_of_relaxation_agree_at_the_loops_step() -> None:
    held = [*inwards(0.004, step=1e-4), *([0.004] * 400)]
    forces = [
        follow(
            stages_of("puncture", "relaxation", layers=[CAPSULE], models={"relaxation": model}),
            held,
        ).force["relaxation"]
        for model in ("exact", "midpoint")
    ]
    assert np.abs(forces[0] - forces[1]).max() < 1e-5
    peak = int(np.argmax(forces[0]))
    assert forces[0][peak + 200] == pytest.approx(forces[0][peak] * np.exp(-1.0), rel=1e-2)


def test_explicit_euler_explodes_where_relaxation_does_not() -> None:
    """Negative control: a step of three time constants."""
    tau, h, e = 0.05, 0.15, 1e-3
    for _ in range(50):
        e += h * (-e / tau)
    assert abs(e) > 1e6
    assert 0.0 < relaxation.exact(1e-3, 0.0, h, tau) < 1e-3


def test_a_quick_push_relaxes_by_its_share() -> None:
    tau = CAPSULE.relaxation_time
    found = follow(
        stages_of("puncture", "relaxation", layers=[CAPSULE]),
        [0.0, 0.0045, *([0.0045] * int(10 * tau * 1e3))],
    )
    quick = found.force["puncture"][1] + found.force["relaxation"][1]
    slow = found.force["puncture"][-1] + found.force["relaxation"][-1]
    assert 1.0 - slow / quick == pytest.approx(0.4, abs=0.03)  # the membrane is not quite linear


# --- bone -----------------------------------------------------------------------------------------
def test_bone_pushes_from_where_its_layer_begins_and_says_so() -> None:
    found = follow(stages_of("bone_contact", layers=[GEL, BONE]), [0.199, 0.2, 0.2005, 0.2005])
    np.testing.assert_array_equal(found.states[:, sv.BONE_CONTACT], [0.0, 0.0, 1.0, 1.0])
    stiffness, _ = bone_contact.coefficients("exact", 40e3, 10.0, 0.05, 1e-3)
    assert found.force["bone_contact"][3] == pytest.approx(stiffness * 5e-4)
    assert (found.force["bone_contact"][:2] == 0.0).all()


@pytest.mark.parametrize("stiffness", [1.0, 1e3, 4e4])
def test_the_mean_force_of_a_tick_is_what_the_exact_motion_feels(stiffness: float) -> None:
    m, b, h, x, v = 0.05, 10.0, 1e-3, 2e-4, 0.05
    a, c = bone_contact.coefficients("exact", stiffness, b, m, h)
    solved = solve_ivp(
        lambda _, y: (y[1], -(stiffness * y[0] + b * y[1]) / m),
        (0.0, h),
        (x, v),
        rtol=1e-12,
        atol=1e-15,
    ).y[1, -1]
    assert a * x + c * v == pytest.approx(m * (v - solved) / h, rel=1e-7)


@pytest.mark.parametrize("model", ["exact", "implicit"])
def test_bone_is_never_stiffer_than_a_tick_can_tell(model: str) -> None:
    for stiffness in (1e5, 5e5):
        a, b = bone_contact.coefficients(model, stiffness, 0.0, 0.05, 1e-3)
        assert 0.0 < a <= 0.05 / 1e-3**2
        assert b > 0.0


@pytest.mark.parametrize("model", ["exact", "implicit"])
@pytest.mark.parametrize("hand", [SimulatedHand(), SimulatedHand(strongest=30.0, axial_speed=0.5)])
def test_the_simulated_hand_cannot_push_through_a_rib(model: str, hand: SimulatedHand) -> None:
    rows = pushed(0.1, layers=[FAT, BONE], models={"bone_contact": model}, hand=hand)
    depth, late = rows[:, sv.PLANT_DEPTH], rows[-200:, sv.AXIAL_FORCE]
    assert depth.max() < FAT.thickness + 0.002
    assert rows[-1, sv.BONE_CONTACT] == 1.0
    assert np.ptp(late) < 0.01 * late.mean()  # it rests there, and does not chatter


# --- the whole tick -------------------------------------------------------------------------------
def pushed(
    depth: float,
    *names: str,
    ticks: int = 3000,
    hand: SimulatedHand | None = None,
    **asked: object,
) -> np.ndarray:
    """States of a simulated robot whose hand pushes straight in; without a hand from `start`."""
    stages, state = whole(*(names or ("bone_contact",)), hand=hand, **asked)
    rows = []
    for k in range(ticks):
        state[sv.HAND_HOLDS], state[sv.HAND_DEPTH] = 1.0, depth
        tick(stages, state, k)
        rows.append(state.copy())
    return np.array(rows)


def whole(
    *names: str, hand: SimulatedHand | None = None, **asked: object
) -> tuple[list[Stage], np.ndarray]:
    effects = stages_of(*names, **asked)  # type: ignore[arg-type]
    link = simulated_link(PROFILE, [plant_stage(PROFILE, depth=-0.005, hand=hand)])
    state = sv.empty_state()
    for name, value in initial_plant(PROFILE, (0.0, 0.0, -1.0), -0.005).items():
        state[sv.INDEX[name]] = value
    state[sv.PATH] = unit(np.array([0.0, 0.0, -1.0]))
    state[sv.HOMED], state[sv.FORCE_CAP], state[sv.DT] = 1.0, PROFILE.limits.hand_force, 1e-3
    return list(machine_stages(PROFILE, [], effects, link)), state


def tick(stages: list[Stage], state: np.ndarray, k: int) -> None:
    state[sv.TIME] = state[sv.HEARTBEAT] = 10.0 + 1e-3 * k
    state[sv.TICK] = k
    if k % 33 == 0:
        state[sv.TRACKED_DEPTH], state[sv.TRACKED_TIME] = state[sv.PLANT_DEPTH], state[sv.TIME]
    for _, function, parameters in stages:
        function(state, parameters)


def test_all_effects_together_run_in_the_whole_tick_and_puncture_layer_by_layer() -> None:
    rows = pushed(0.07, *(name for name in ALL if name != "bone_contact"), ticks=4000)
    assert np.isfinite(rows).all()
    assert rows[-1, sv.PUNCTURES] == 3.0
    assert rows[-1, sv.PLANT_DEPTH] == pytest.approx(0.07, abs=2e-3)
    assert np.abs(rows[:, sv.TARGET_SHIFT_Z]).max() > 1e-4
    assert rows[:, sv.AXIAL_FORCE].max() < 5.0


@pytest.mark.parametrize("model", ["instant", "snap"])
def test_a_needle_let_go_on_a_dimple_flies_out_with_no_more_than_was_stored(model: str) -> None:
    stages, state = whole("puncture", layers=[CAPSULE], models={"puncture": model})
    memory = next(stage.parameters for stage in stages if stage.name == "puncture")
    k, stored, fastest = 0, 0.0, 0.0
    for k in range(1500):
        state[sv.HAND_HOLDS], state[sv.HAND_DEPTH] = 1.0, 0.004
        tick(stages, state, k)
    stored = puncture.stored_energy(memory)
    for k in range(1500, 2000):
        state[sv.HAND_HOLDS] = 0.0
        tick(stages, state, k)
        fastest = min(fastest, state[sv.PLANT_DEPTH_RATE])
    assert stored > 1e-4
    assert 0.5 * 0.05 * fastest**2 <= stored
    assert fastest < 0.0


# --- dimpling -------------------------------------------------------------------------------------
def test_the_target_moves_with_the_dimple_and_less_the_further_it_is() -> None:
    held = [*inwards(0.004), *([0.004] * 300)]
    found = follow(stages_of("puncture", "dimpling", layers=[CAPSULE]), held)
    shift = found.states[-1, sv.TARGET_SHIFT]
    wanted = 0.7 * np.exp(-(0.08 - 0.004) / 0.04) * 0.004
    np.testing.assert_allclose(shift, [0.0, 0.0, -wanted], rtol=1e-3)
    jump = np.abs(np.diff(found.states[:, sv.TARGET_SHIFT_Z])).max()
    assert jump < 0.05 * wanted


def test_drag_follows_the_whole_force_in_both_directions() -> None:
    ahead = inwards(0.05, step=1e-4)
    depths = [*ahead, *ahead[::-1][:200]]
    stages = stages_of("shaft_friction", "dimpling", layers=[GEL], models={"dimpling": "drag"})
    shift = follow(stages, depths).states[:, sv.TARGET_SHIFT_Z]
    assert shift[len(ahead) - 1] < -1e-3
    assert shift[-1] > 1e-3
    assert np.abs(shift).max() <= 0.7 * 0.01


# --- friction laws --------------------------------------------------------------------------------
def still_hand(law: str, stiffness: float = 1e5, naive: bool = False) -> tuple[int, float]:
    """Sign changes and rms force of 2 s on the edge of a count of 33 µm, tremor 5 µm, level 1 N."""
    layer = TissueLayer("x", 0.3, friction=10.0, static_friction=10.0, viscous_friction=0.0)
    values = {"presliding_stiffness": stiffness}
    memory = memory_of("shaft_friction", values, Binding(Scene(layers=(layer,)), model=law))
    step, state = implementation("shaft_friction").step, sv.empty_state()
    count, random = 33e-6, np.random.default_rng(4)
    edge = count * round(0.1 / count)
    moved = np.concatenate([np.linspace(0.095, edge, 500), edge + random.normal(0, 5e-6, 2000)])
    seen = count * np.floor(moved / count)
    forces = []
    for depth in seen:
        state[sv.DEPTH], state[sv.DT], state[sv.AXIAL_FORCE] = depth, 1e-3, 0.0
        step(state, memory)
        forces.append(state[sv.AXIAL_FORCE])
    if naive:
        forces = list(np.sign(np.diff(seen, prepend=seen[0])))
    still = np.array(forces[500:])
    return int(np.count_nonzero(np.diff(np.sign(still)))), float(np.sqrt(np.mean(still**2)))


def test_a_still_hand_on_the_edge_of_a_count_feels_no_sign_change() -> None:
    default = declaration("shaft_friction").model("")
    for stiffness in (1e4, 1e5, 0.99 * 1.0 / 0.1 / 33e-6):  # up to σ Δ = F_c
        assert still_hand(default, stiffness)[0] <= 4
    assert still_hand(default, naive=True)[0] > 1200
    for law in ("dahl", "lugre"):
        assert still_hand(law)[0] > 500


def test_a_still_hand_beyond_that_is_warned_of() -> None:
    real = DevicePort("axial", frozenset({"axial"}))

    def said(model: str, stiffness: float) -> tuple[str, ...]:
        request = EffectRequest("shaft_friction", {"presliding_stiffness": stiffness}, model)
        return compile(Scene((request,)), real).warnings()["shaft_friction"]

    assert said("", 1e5) == ()
    assert "a still hand feels it change sign" in said("", 1e6)[0]
    assert "changes sign with every count" in said("dahl", 1e4)[0]
    assert "changes sign with every count" in said("lugre", 1e4)[0]
    request = EffectRequest("shaft_friction", {}, "dahl")
    assert compile(Scene((request,)), SIMULATED).warnings()["shaft_friction"] == ()


@pytest.mark.parametrize("law", ["kikuuwe", "dahl", "lugre"])
def test_every_law_slides_at_its_level_and_holds_at_rest(law: str) -> None:
    layer = TissueLayer("x", 0.3, friction=10.0, static_friction=15.0, viscous_friction=0.0)
    stages = stages_of("shaft_friction", layers=[layer], models={"shaft_friction": law})
    ahead = inwards(0.1, 0.05, 1e-4)
    force = follow(stages, [*ahead, *([ahead[-1]] * 300)]).force["shaft_friction"]
    assert force[len(ahead) - 1] == pytest.approx(10.0 * 0.1, rel=1e-2)
    assert force[-1] > 0.5
    assert np.ptp(force[-299:]) < 1e-12


# --- consumers, needs, refusals -------------------------------------------------------------------
AXIAL = [name for name in ALL if name != "dimpling"]
LAYERS = (SKIN, FAT, LIVER, BONE)


def kept(*names: str, device: DevicePort, views: tuple[Consumer, ...] = ()) -> set[str]:
    scene = Scene(tuple(EffectRequest(name) for name in names), LAYERS)
    return {one.name for one in compile(scene, device, views).kept}


def test_axial_forces_are_computed_for_a_consumer_only() -> None:
    real = DevicePort("icube")
    gauge = Consumer("view force_gauge shows it", ("axial_force",))
    score = Consumer("metric punctures scores it", ("punctures",))
    sound = Consumer("the sound of bone", ("bone_contact",))
    assert kept(*ALL, device=real) == set()
    assert kept(*AXIAL, device=real, views=(gauge,)) == set(AXIAL)
    assert kept(*AXIAL, device=SIMULATED) == set(AXIAL)
    assert kept(*AXIAL, device=DevicePort("three", frozenset({"axial"}))) == set(AXIAL)
    assert kept(*ALL, device=real, views=(MOTION,)) == set(ALL)
    assert kept(*ALL, device=real, views=(score,)) == {"puncture"}
    assert kept(*ALL, device=real, views=(sound,)) == {"bone_contact"}


def test_what_the_layers_lack_drops_an_effect_and_says_so() -> None:
    scene = Scene(tuple(EffectRequest(name) for name in ALL), (GEL,))
    dropped = {one.name: one.why for one in compile(scene, SIMULATED, [MOTION]).dropped}
    assert dropped["puncture"] == "dropped: it needs membranes, and the scene has none"
    assert dropped["bone_contact"] == "dropped: it needs bones, and the scene has none"
    assert set(dropped) == {"puncture", "relaxation", "bone_contact"}


def test_each_effect_has_two_models_published_ranges_that_hold_its_defaults_and_a_bound() -> None:
    for name in ALL:
        declared = declaration(name)
        assert len(declared.models) >= 2
        assert declared.unpublished(declared.checked({})) == ()
        if name != "dimpling":
            memory = memory_of(name, {}, Binding(Scene(layers=LAYERS, needle=Needle())))
            assert 0.0 <= implementation(name).axial_energy_bound(memory) < 1.0


def test_layers_that_cannot_be_are_refused() -> None:
    with pytest.raises(SimulationError, match="'fat' lies below 'rib', which is rigid"):
        check_order([SKIN, BONE, FAT])
    with pytest.raises(SimulationError, match="'skin' lies below 'fat'"):
        Scene(layers=(FAT, SKIN))
    with pytest.raises(SimulationError, match="toughness is -1"):
        TissueLayer("x", 0.1, toughness=-1.0)
    with pytest.raises(SimulationError, match="needs an indentation_stiffness"):
        TissueLayer(
            "x", 0.1, puncture_force=1.0, indentation_stiffness=0.0, indentation_hardening=0.0
        )
    with pytest.raises(SimulationError, match="relaxation_share is 1"):
        TissueLayer("x", 0.1, relaxation_share=1.0)


def test_no_effect_gives_out_energy_going_in_and_out_through_all_layers() -> None:
    there = inwards(0.06)
    depths = np.concatenate([there, there[::-1]])
    found = follow(stages_of(*ALL, layers=(SKIN, FAT, CAPSULE, BONE)), depths)
    for name in AXIAL:
        assert given_out(found.force[name], depths).max() <= 1e-6, name


def test_another_model_goes_on_from_where_the_needle_is() -> None:
    """Exchanged in the middle, and back again at once: the same forces as without."""
    depths = np.concatenate([inwards(0.03, step=1e-4), inwards(0.05, 0.03, 1e-4)])
    half, layers = len(depths) // 2, (SKIN, FAT, CAPSULE)
    whole_way = follow(stages_of(*AXIAL[:-1], layers=layers), depths)
    first, then = stages_of(*AXIAL[:-1], layers=layers), stages_of(*AXIAL[:-1], layers=layers)
    follow(first, depths[:half])
    for old, new in zip(first[1:], then[1:], strict=True):
        implementation(old.name).carry(old.parameters, new.parameters)
    second = follow(then, depths[half:])
    for name in AXIAL[:-1]:
        np.testing.assert_array_equal(second.force[name], whole_way.force[name][half:], name)
