"""The bevelled tip: exact arcs, roll, the channel, noise, and what it adds to the bent needle."""

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.core.bend import Bend
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.effects import bevel, lateral_tissue
from app.simulation.needles import OUTER_DIAMETER
from app.simulation.plan import compile
from app.simulation.scene import Binding, EffectRequest, Needle, Scene

DOWN = np.array([0.0, 0.0, -1.0])


def tip(gauge: int = 20, model: str = "arc", **parameters: float) -> FloatArray:
    scene = Scene(needle=Needle(outer_diameter=OUTER_DIAMETER[gauge]))
    return memory_of("bevel", parameters, Binding(scene, model=model))


def tick(
    memory: FloatArray,
    depth: float,
    roll: float = 0.0,
    axis: FloatArray = DOWN,
    source: float = 1.0,
) -> FloatArray:
    """State after one tick."""
    state = sv.empty_state()
    state[sv.AXIS], state[sv.DEPTH], state[sv.NEEDLE_ROLL] = axis, depth, roll
    state[sv.DEPTH_SOURCE] = source
    bevel.step(state, memory)
    return state


@pytest.mark.parametrize("steps", [1, 7, 500, 20_000])
@pytest.mark.parametrize("curvature", [0.0, 1e-6, 1.1, 10.0])
def test_the_tip_is_on_the_circle_at_any_step(steps: int, curvature: float) -> None:
    memory, depth = tip(curvature_thin=curvature), 0.1237
    for s in np.linspace(0.0, depth, steps + 1)[1:]:
        state = tick(memory, s)
    with mpmath.workdps(50):
        k, d = mpmath.mpf(curvature), mpmath.mpf(depth)
        across = float((1 - mpmath.cos(k * d)) / k) if curvature else 0.0
        short = float(d - mpmath.sin(k * d) / k) if curvature else 0.0
    np.testing.assert_allclose(state[sv.TIP_OFFSET], [across, 0.0, short], rtol=1e-9, atol=3e-14)
    turn = curvature * depth
    slope = [np.sin(turn), 0.0, 1.0 - np.cos(turn)]
    np.testing.assert_allclose(state[sv.TIP_SLOPE], slope, atol=1e-12)


def test_published_deflections_come_out() -> None:
    for curvature, mm in ((1.28, (2.3, 6.4, 9.2)), (1.97, (3.5, 9.8, 14.1))):
        memory = tip(curvature_thin=curvature)
        for depth, expected in zip((0.06, 0.1, 0.12), mm, strict=True):
            assert 1e3 * tick(memory, depth)[sv.TIP_OFFSET_X] == pytest.approx(expected, abs=0.06)


def test_a_thick_needle_bends_less_than_a_thin_one() -> None:
    thick, thin = (tick(tip(gauge), 0.1)[sv.TIP_OFFSET_X] for gauge in (18, 20))
    assert thin / thick == pytest.approx(1.1 / 0.3, rel=1e-2)


@pytest.mark.parametrize("tilt", [0.0, 0.3, 0.7])
@pytest.mark.parametrize("azimuth", [0.0, 2.1, -1.3])
def test_the_roll_turns_the_path_clockwise_seen_from_the_hub(tilt: float, azimuth: float) -> None:
    axis = np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])
    bent = []
    for roll in (0.0, 0.5 * np.pi, np.pi):
        state = tick(tip(), 0.08, roll, axis)
        bent.append(state[sv.TIP_OFFSET] - axis * (axis @ state[sv.TIP_OFFSET]))
        assert state[sv.TIP_SLOPE] @ bent[-1] > 0.0
        assert state[sv.ROOT_CURVATURE] @ bent[-1] > 0.0
        assert abs(state[sv.ROOT_CURVATURE] @ axis) < 1e-12
    size = np.linalg.norm(bent[0])
    np.testing.assert_allclose(bent[2], -bent[0], atol=1e-12)
    # Seen along the axis, from the hub, clockwise is right-handed about it.
    np.testing.assert_allclose(np.cross(axis, unit(bent[0])), unit(bent[1]), atol=1e-9)
    assert size == pytest.approx((1.0 - np.cos(0.088)) / 1.1, rel=1e-9)


def test_turning_about_vertical_makes_no_jump() -> None:
    memory = tip()
    tick(memory, 0.1)
    near = [tick(memory, 0.1, axis=unit(DOWN + 1e-6 * np.array([np.cos(a), np.sin(a), 0.0])))
            for a in np.linspace(0.0, 6.0, 30)]  # fmt: skip
    offsets = np.array([state[sv.TIP_OFFSET] for state in near])
    assert np.ptp(offsets, axis=0).max() < 1e-7


def test_turning_at_rest_moves_nothing_and_half_a_turn_half_way_comes_back() -> None:
    memory = tip()
    before = tick(memory, 0.05)[sv.TIP_OFFSET].copy()
    for roll in np.linspace(0.0, np.pi, 40):
        np.testing.assert_array_equal(tick(memory, 0.05, roll)[sv.TIP_OFFSET], before)
    end = tick(memory, 0.1, np.pi)
    assert np.abs(end[sv.TIP_SLOPE][:2]).max() < 1e-12  # straight again, beside the axis
    one = (1.0 - np.cos(1.1 * 0.05)) / 1.1
    assert end[sv.TIP_OFFSET_X] == pytest.approx(2.0 * one, rel=1e-9)


@pytest.mark.parametrize("model", ["arc", "drifting"])
def test_pulling_back_follows_the_channel(model: str) -> None:
    memory, there = tip(model=model), {}
    depths = np.linspace(0.0, 0.11, 1500)
    for k, depth in enumerate(depths):
        there[k] = tick(memory, depth, 0.02 * k)[sv.TIP_OFFSET].copy()
    for k in range(len(depths) - 1, -1, -7):
        back = tick(memory, depths[k], 3.0)[sv.TIP_OFFSET]
        np.testing.assert_allclose(back, there[k], atol=1e-8)
    assert not tick(memory, 0.0)[[*range(sv.SLOTS)[sv.TIP_OFFSET]]].any()


def test_pushing_again_cuts_anew_with_the_roll_of_then() -> None:
    memory = tip()
    tick(memory, 0.1)
    tick(memory, 0.04)
    steered = tick(memory, 0.1, np.pi)
    assert steered[sv.TIP_OFFSET_X] < 0.5 * tick(tip(), 0.1)[sv.TIP_OFFSET_X]


def test_the_drift_of_a_seed_is_one_path_whatever_the_steps() -> None:
    rng = np.random.default_rng(5)
    steps = {}
    for n in (1, 60, 3000):
        memory = tip(model="drifting")
        for depth in sorted([*rng.uniform(0.0, 0.12, n - 1), 0.12]):
            state = tick(memory, depth)
        steps[n] = state[sv.TIP_OFFSET].copy()
    np.testing.assert_allclose(steps[1], steps[3000], atol=1e-13)
    np.testing.assert_allclose(steps[60], steps[3000], atol=1e-13)
    assert np.linalg.norm(steps[1] - tick(tip(), 0.12)[sv.TIP_OFFSET]) > 1e-4


def test_the_drift_spreads_as_its_noise_says() -> None:
    depth, noise = 0.1, 0.08
    ends = np.array([
        tick(tip(model="drifting", draws=float(seed), curvature_thin=0.0, roll_noise=0.0), depth)[
            sv.TIP_OFFSET
        ]
        for seed in range(400)
    ])  # fmt: skip
    # Heading: a Wiener process over length; its integral has the variance λ² d³ / 3.
    np.testing.assert_allclose(ends[:, :2].std(axis=0), noise * np.sqrt(depth**3 / 3.0), rtol=0.1)


def test_both_bends_add_and_are_as_long_as_the_needle_is_deep() -> None:
    scene = Scene(needle=Needle(outer_diameter=OUTER_DIAMETER[20]))
    tissue = memory_of("lateral_tissue", {}, Binding(scene, model="beam"))
    axis = unit(np.array([0.05, 0.0, -1.0]))
    for order in ((bevel, lateral_tissue), (lateral_tissue, bevel)):
        own = {bevel: tip(), lateral_tissue: tissue.copy()}
        for direction in (DOWN, axis):
            state = sv.empty_state()
            state[sv.AXIS], state[sv.DEPTH], state[sv.L_OUT] = direction, 0.08, 0.12
            state[sv.DEPTH_SOURCE] = 1.0
            for effect in order:
                effect.step(state, own[effect])
        assert state[sv.BENT_LENGTH] == 0.08
        alone = tick(own[bevel], 0.08, axis=axis)[sv.TIP_OFFSET]
        tissue_only = sv.empty_state()
        tissue_only[sv.AXIS], tissue_only[sv.DEPTH], tissue_only[sv.L_OUT] = axis, 0.08, 0.12
        tissue_only[sv.DEPTH_SOURCE] = 1.0
        lateral_tissue.step(tissue_only, own[lateral_tissue])
        both = alone + tissue_only[sv.TIP_OFFSET]
        np.testing.assert_allclose(state[sv.TIP_OFFSET], both, atol=1e-15)
        bend = Bend.of_row(state)
        np.testing.assert_allclose(bend.at(0.08), both, atol=1e-12)


def test_the_drawn_shaft_is_near_the_arc_and_ends_on_it() -> None:
    bend = Bend.of_row(tick(tip(), 0.085))
    s = np.linspace(0.0, 0.085, 50)
    arc = (1.0 - np.cos(1.1 * s)) / 1.1
    assert np.abs(bend.at(s)[:, 0] - arc).max() < 0.04 * 1.1 * 0.085**2
    assert bend.at(0.085)[0] == pytest.approx(arc[-1], rel=1e-9)


def test_a_depth_that_nobody_measured_moves_nothing() -> None:
    memory = tip()
    assert not tick(memory, 0.1, source=0.0)[sv.TIP_OFFSET].any()
    held = tick(memory, 0.05)[sv.TIP_OFFSET].copy()
    np.testing.assert_array_equal(tick(memory, 0.1, source=0.0)[sv.TIP_OFFSET], held)


def test_it_is_kept_for_who_looks_at_the_tip_and_dropped_else() -> None:
    scene = Scene((EffectRequest("bevel"),))
    looks = Consumer("view needle shows it", ("tip_offset_x",))
    assert [k.name for k in compile(scene, DevicePort("icube"), views=(looks,)).kept] == ["bevel"]
    assert compile(scene, DevicePort("icube")).kept == ()
