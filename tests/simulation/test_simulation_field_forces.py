"""Forces in a field of tissue: bins that keep what they were cut in, and bone at its surface."""

import numpy as np
import pytest
from simulation.effect_rig import memory_of
from simulation.field_rig import field_of, go, layered, scene_in, slab, stages_in, straight

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.simulation.effects import lateral_tissue
from app.simulation.effects.lateral_tissue import BIN
from app.simulation.scene import Binding, Scene, TissueLayer

SOFT = TissueLayer("soft", 0.0, side_stiffness=3e3)
STIFF = TissueLayer("stiff", 0.0, side_stiffness=30e3)
AIR = TissueLayer("air", 0.0, 0.0, 0.0, 0.0, 0.0)
LENGTH = 0.2


def in_layers(*layers: TissueLayer) -> FloatArray:
    return memory_of("lateral_tissue", {}, Binding(Scene((), layers), sv.PLANT_DEPTH, "beam"))


def leaning(tilt: float, azimuth: float = 0.3) -> FloatArray:
    return np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])


def test_through_flat_tissue_the_field_gives_the_force_and_bend_of_layers() -> None:
    edge = 20 * BIN  # of a bin, so that both have the same tissue to the last micrometre
    field = field_of(layered(("fat", 1e3 * edge), ("organ", 100.0)))
    stages = stages_in(
        scene_in(field, "tissue_field", "lateral_tissue", values=(AIR, AIR, SOFT, STIFF))
    )
    layers = in_layers(
        TissueLayer("soft", edge, side_stiffness=3e3),
        TissueLayer("stiff", 0.2, side_stiffness=30e3),
    )
    tips = np.concatenate([straight(-0.005, 0.06, 2e-4), straight(0.06, 0.03, 2e-4)])
    tips = np.concatenate([tips, straight(0.03, 0.07, 3e-4)])
    turn = np.linspace(0.0, 0.08, len(tips))
    tips[:, 0] = tips[:, 2] * -np.tan(turn)
    rows = go(stages, tips)
    most = 0.0
    for row in rows:
        state = row.copy()
        state[sv.SUMS,] = 0.0
        lateral_tissue.step(state, layers)
        np.testing.assert_allclose(row[sv.FORCE], state[sv.FORCE], atol=2e-3)
        np.testing.assert_allclose(row[sv.TIP_OFFSET], state[sv.TIP_OFFSET], atol=2e-5)
        most = max(most, float(np.linalg.norm(row[sv.FORCE])))
    assert most > 0.1


def test_a_bin_keeps_the_tissue_of_its_middle_until_the_needle_has_left_it() -> None:
    field = field_of(layered(("fat", 20.3), ("organ", 100.0)))
    stages = stages_in(
        scene_in(field, "tissue_field", "lateral_tissue", values=(AIR, AIR, SOFT, STIFF))
    )
    memory = next(s.parameters for s in stages if s.name == "lateral_tissue")
    state = sv.empty_state()
    go(stages, straight(-0.004, 0.05, 1e-4), state=state)

    def stiffness(depth: float) -> float:
        return lateral_tissue._tissue(memory, int(depth / BIN), 0.0, BIN)[0] / BIN

    assert [stiffness(d) for d in (0.005, 0.0195, 0.0211, 0.045)] == [3e3, 3e3, 30e3, 30e3]
    other = straight(0.05, -0.004, 1e-3)
    go(stages, other, state=state)
    shifted = straight(-0.004, 0.05, 5e-3)  # 5 m/s: bins are laid by what was met in their middle
    go(stages, shifted, state=state)
    assert stiffness(0.045) == 30e3


def wander(ticks: int, seed: int) -> tuple[float, float, float, float]:
    """Push, pull and tilt at random in a breathing field; energy given, supplied, stored; worst."""
    ball = lambda p: 12.0 - np.linalg.norm(p - [0.0, 0.0, -45.0], axis=1)  # noqa: E731
    field = field_of(
        [
            ("air", "", slab(100.0, 0.0)),
            ("fat", "", lambda p: np.minimum(slab(0.0, -20.0)(p), -ball(p))),
            ("organ", "liver", lambda p: np.minimum(slab(-20.0, -200.0)(p), -ball(p))),
            ("vessel", "", ball),
        ],
        low=(-60.0, -60.0, -120.0),
        high=(60.0, 60.0, 20.0),
        spacing=1.0,
    )
    values = (AIR, AIR, SOFT, STIFF, TissueLayer("v", 0.0, 10e3))
    stages = stages_in(scene_in(field, "tissue_field", "lateral_tissue", values=values))
    memory = next(s.parameters for s in stages if s.name == "lateral_tissue")
    by_name = {s.name: s for s in stages}
    rng = np.random.default_rng(seed)
    axis, depth, breath, state = leaning(0.1), 0.0, np.zeros(3), sv.empty_state()
    given = supplied = worst = 0.0

    def tick(axis: FloatArray, depth: float) -> FloatArray:
        state[sv.SUMS,] = 0.0
        state[sv.AXIS], state[sv.TIP] = axis, depth * axis
        state[sv.DEPTH] = state[sv.PLANT_DEPTH] = depth
        state[sv.DEPTH_SOURCE], state[sv.L_OUT], state[sv.DT] = 1.0, LENGTH - depth, 1e-3
        for name in ("clear_effects", "tissue_field", "lateral_tissue", "keep_bend"):
            by_name[name].function(state, by_name[name].parameters)
            if name == "clear_effects":
                state[sv.BREATH] = breath
        return state

    force = tick(axis, depth)[sv.FORCE].copy()
    for _ in range(ticks):
        choice = rng.random()
        if choice < 0.4:
            goal = unit(axis + rng.normal(0.0, 2e-3, 3))
            middle = tick(unit(axis + goal), depth)[sv.FORCE].copy()
            end = tick(goal, depth)[sv.FORCE].copy()
            mean = (force + 4.0 * middle + end) / 6.0
            given += float(mean @ (goal - axis) * -(LENGTH - depth))
            axis = goal if goal[2] < -0.8 else leaning(0.1)
            force = end if goal[2] < -0.8 else tick(axis, 0.0)[sv.FORCE].copy()
            if goal[2] >= -0.8:
                depth = 0.0
        elif choice < 0.6:
            breath = np.clip(breath + rng.normal(0.0, 1e-3, 3), -0.012, 0.012)
            row = tick(axis, depth)
            supplied += row[sv.GAIN_WORK]
            force = row[sv.FORCE].copy()
        else:
            depth = float(np.clip(depth + rng.normal(0.0004, 3e-3), -0.01, 0.11))
            row = tick(axis, depth)
            worst = max(worst, row[sv.GAIN_WORK])  # advancing adds nothing, retreating loses
            force = row[sv.FORCE].copy()
        stored = lateral_tissue.stored_energy(memory, axis)
        worst = max(worst, given + stored - supplied - 1e-5)
    return given, supplied, stored, worst


@pytest.mark.long("machine")
def test_a_hundred_thousand_pushes_and_tilts_give_out_no_more_than_was_supplied() -> None:
    given, supplied, _, worst = wander(100_000, 3)
    assert worst < 1e-6
    assert supplied > 1e-2
    assert given < supplied


@pytest.mark.long("statistics")
def test_a_million_pushes_and_tilts_give_out_no_more_than_was_supplied() -> None:
    assert wander(1_000_000, 4)[3] < 1e-6


def rib(tilt: float = 0.0) -> object:
    """Bone of 8 mm below 12 mm of muscle, tilted."""
    into = np.array([np.sin(tilt), 0.0, -np.cos(tilt)])

    def bone(p: FloatArray) -> FloatArray:
        along = p @ into
        return np.minimum(along - 12.0, 20.0 - along)

    def lung(p: FloatArray) -> FloatArray:
        return p @ into - 20.0

    muscle = lambda p: np.minimum(-p[:, 2], 12.0 - p @ into)  # noqa: E731
    return field_of(
        [
            ("air", "", lambda p: p[:, 2]),
            ("muscle", "", muscle),
            ("bone", "rib", bone),
            ("lung", "", lung),
        ]
    )


def test_bone_stops_the_tip_at_its_surface_with_the_spring_that_layers_have() -> None:
    stages = stages_in(scene_in(rib(), "tissue_field", "bone_contact", "bone_slide"))
    rows = go(stages, straight(0.005, 0.0125, 2e-6))
    touched = rows[rows[:, sv.BONE_CONTACT] > 0.0]
    assert touched[0, sv.DEPTH] == pytest.approx(0.012, abs=3e-5)
    beyond = touched[:, sv.DEPTH] - 0.012
    from app.simulation.effects.bone_contact import coefficients

    stiffness, damping = coefficients("exact", 40e3, 10.0, 0.05, 1e-3)
    expected = stiffness * beyond + damping * 2e-3
    np.testing.assert_allclose(touched[5:, sv.AXIAL_FORCE], expected[5:], atol=1.3)  # 0.03 mm
    np.testing.assert_allclose(touched[:, sv.BONE_CROSSED], beyond, atol=4e-5)
    assert not touched[:, sv.BONE_PUSH].any()


@pytest.mark.parametrize("tilt", [0.3, 0.9])
def test_a_slanted_surface_turns_the_tip_aside(tilt: float) -> None:
    stages = stages_in(scene_in(rib(tilt), "tissue_field", "bone_contact", "bone_slide"))
    surface = 0.012 / np.cos(tilt)
    rows = go(stages, straight(0.005, surface + 3e-4, 5e-6))
    last = rows[-1]
    beyond = 3e-4 * np.cos(tilt)
    across = last[sv.AXIAL_FORCE] * np.tan(tilt)
    assert last[sv.BONE_CROSSED] == pytest.approx(beyond / np.cos(tilt), abs=4e-5)
    np.testing.assert_allclose(last[sv.BONE_PUSH], [-across, 0.0, 0.0], atol=0.05 * across)
    lever = last[sv.DEPTH] / last[sv.L_OUT]
    assert last[sv.FORCE_X] == pytest.approx(lever * across, rel=0.06)


@pytest.mark.parametrize("tilt", [0.3, 0.9, 1.1])
@pytest.mark.parametrize("turn", [0.02, -0.02])
def test_a_closed_way_on_slanted_bone_gives_out_nothing(tilt: float, turn: float) -> None:
    """In past the surface, turned along it, out, and turned back: both ports are counted."""
    stages = stages_in(scene_in(rib(tilt), "tissue_field", "bone_contact", "bone_slide"))
    deep, high, count = 0.012 / np.cos(tilt) + 1e-4, 0.002, 2000
    angles = np.concatenate(
        [np.zeros(count), np.linspace(0.0, turn, count), np.full(count, turn)]
        + [np.linspace(turn, 0.0, count)]
    )
    depths = np.concatenate(
        [np.linspace(high, deep, count), np.full(count, deep), np.linspace(deep, high, count)]
        + [np.full(count, high)]
    )
    axes = np.column_stack([np.sin(angles), 0.0 * angles, -np.cos(angles)])
    rows = go(stages, depths[:, None] * axes, dt=1e-2)
    along, across = rows[:, sv.AXIAL_FORCE], rows[:, sv.FORCE]
    hub = -(0.2 - depths)[1:, None] * np.diff(axes, axis=0)  # across the needle
    given = -0.5 * (along[1:] + along[:-1]) @ np.diff(depths)
    given += 0.5 * ((across[1:] + across[:-1]) * hub).sum()
    assert np.abs(across).max() > 0.0
    assert given < 2e-5  # of a millijoule and more that went in


def test_a_hand_that_bone_cannot_stop_is_told_how_far_it_has_crossed() -> None:
    from app.simulation.consumers import DevicePort

    real = DevicePort("icube", frozenset({"lateral", "axial"}), simulated=False)
    stages = stages_in(scene_in(rib(), "tissue_field", "bone_contact", "bone_slide"), real)
    rows = go(stages, straight(0.0, 0.04, 1e-4))
    inside = rows[rows[:, sv.DEPTH] > 0.0121]
    assert (inside[:, sv.BONE_CONTACT] == 1.0).all()  # through the rib and 20 mm of lung
    np.testing.assert_allclose(inside[:, sv.BONE_CROSSED], inside[:, sv.DEPTH] - 0.012, atol=5e-5)
    back = go(stages, straight(0.04, 0.0, 1e-3), state=rows[-1].copy())
    assert back[-1, sv.BONE_CONTACT] == back[-1, sv.BONE_CROSSED] == 0.0
    assert not rows[:, sv.FORCE].any()


def test_the_tip_follows_a_round_rib_without_a_jump_of_the_force() -> None:
    radius = 7.0
    tube = lambda p: radius - np.hypot(p[:, 0], p[:, 2] + 20.0)  # noqa: E731
    field = field_of([("muscle", "", lambda p: -tube(p)), ("bone", "rib", tube)], spacing=1.0)
    stages = stages_in(scene_in(field, "tissue_field", "bone_contact", "bone_slide"))
    angle = np.linspace(0.0, 1.0, 4000)
    deep = 1e-3 * (radius - 0.1)
    tips = np.column_stack([deep * np.sin(angle), 0.0 * angle, deep * np.cos(angle) - 0.020])
    lead = np.linspace([0.0, 0.0, -0.008], tips[0], 2000)
    state = sv.empty_state()
    go(stages, lead, axis=(0.0, 0.0, -1.0), state=state)
    rows = go(stages, tips, axis=(0.0, 0.0, -1.0), state=state)
    assert (rows[:, sv.BONE_CONTACT] == 1.0).all()
    normal = np.column_stack([-np.sin(angle), 0.0 * angle, -np.cos(angle)])
    told = np.einsum("ij,ij->i", rows[:, sv.WALL_NORMAL], normal)
    assert (
        np.degrees(np.arccos(np.clip(told, -1.0, 1.0))).max() < 5.0
    )  # a rib of 7 mm on a grid of 1 mm
    force = rows[:, sv.AXIAL_FORCE] / np.cos(angle)
    np.testing.assert_allclose(force, np.median(force), atol=2.2)  # 0.05 mm of place
    assert np.abs(np.diff(rows[:, sv.AXIAL_FORCE])).max() < 0.5
