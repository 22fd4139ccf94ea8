"""The bent needle: force, tip and shape are one solution, checked against a fine beam."""

import numpy as np
import pytest
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.core.bend import CURVE_POINTS, Bend, needle_curve
from app.simulation.effects import lateral_tissue as effect
from app.simulation.needles import OUTER_DIAMETER, bending_stiffness
from app.simulation.scene import DEFAULT_LAYERS, Binding, Needle, Scene, TissueLayer

LENGTH = 0.2


def tissue(
    gauge: int = 18, model: str = "beam", layers: tuple[TissueLayer, ...] = DEFAULT_LAYERS
) -> FloatArray:
    scene = Scene(layers=layers, needle=Needle(outer_diameter=OUTER_DIAMETER[gauge]))
    return memory_of("lateral_tissue", {}, Binding(scene, model=model))


def leaning(tilt: float, azimuth: float = 0.0) -> FloatArray:
    return np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])


def tick(memory: FloatArray, axis: FloatArray, depth: float) -> FloatArray:
    """State after one tick."""
    state = sv.empty_state()
    state[sv.AXIS] = axis
    state[sv.DEPTH], state[sv.L_OUT], state[sv.DEPTH_SOURCE] = depth, LENGTH - depth, 1.0
    effect.step(state, memory)
    return state


def fine_beam(
    axis: FloatArray, depth: float, rest: FloatArray, gauge: int, n: int = 800
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Place [m] and slope of the needle at n + 1 depths, and the moment of each coordinate.

    Cubic elements on the layers' foundation, at rest at `rest`, (m, 4): depth and place, in between
    straight; clamped along `axis` at the fulcrum, free at the tip.
    """
    h, ei = depth / n, bending_stiffness(OUTER_DIAMETER[gauge])
    bending = (
        ei
        / h**3
        * np.array(
            [
                [12, 6 * h, -12, 6 * h],
                [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                [-12, -6 * h, 12, -6 * h],
                [6 * h, 2 * h * h, -6 * h, 4 * h * h],
            ]
        )
    )
    ends = np.cumsum([layer.thickness for layer in DEFAULT_LAYERS])
    rows, columns, values = [], [], []
    load = np.zeros((2 * n + 2, 3))
    points, weights = np.polynomial.legendre.leggauss(4)
    for e in range(n):
        index = np.arange(2 * e, 2 * e + 4)
        matrix = bending.copy()
        for point, weight in zip(points, weights, strict=True):
            t = 0.5 * (point + 1.0)
            s = (e + t) * h
            shape = np.array([1 - 3 * t**2 + 2 * t**3, h * (t - 2 * t**2 + t**3),
                              3 * t**2 - 2 * t**3, h * (t**3 - t**2)])  # fmt: skip
            k = DEFAULT_LAYERS[int(np.searchsorted(ends, s))].side_stiffness * 0.5 * weight * h
            matrix += k * np.outer(shape, shape)
            at = np.array([np.interp(s, rest[:, 0], rest[:, 1 + i]) for i in range(3)])
            load[index] += k * np.outer(shape, at)
        rows.append(np.repeat(index, 4))
        columns.append(np.tile(index, 4))
        values.append(matrix.ravel())
    parts = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    a = coo_matrix(parts).tocsc()
    state = np.zeros((2 * n + 2, 3))
    state[1] = axis
    state[2:] = np.column_stack(
        [spsolve(a[2:, 2:], load[2:, i] - a[2:, [1]].toarray()[:, 0] * axis[i]) for i in range(3)]
    )
    return state[0::2], state[1::2], (a[[1]] @ state)[0] - load[1]


@pytest.mark.parametrize(
    ("gauge", "depth", "straight", "bent"),
    [(18, 0.100, 5.2, 0.2), (18, 0.060, 3.1, 1.5), (22, 0.060, 3.1, 0.03)],
)
def test_a_needle_that_is_tilted_after_a_straight_insertion_bends_back_to_its_channel(
    gauge: int, depth: float, straight: float, bent: float
) -> None:
    memory, axis = tissue(gauge), leaning(np.radians(3.0))
    tick(memory, leaning(0.0), depth)
    state = tick(memory, axis, depth)
    assert 1e3 * depth * axis[0] == pytest.approx(straight, abs=0.05)
    tip = depth * axis + state[sv.TIP_OFFSET]
    assert 1e3 * tip[0] == pytest.approx(bent, abs=0.03)
    rest = np.array([[0.0, 0, 0, 0], [1.0, 0, 0, -1.0]])
    place, slope, moment = fine_beam(axis, depth, rest, gauge)
    across = np.eye(3) - np.outer(axis, axis)
    np.testing.assert_allclose(state[sv.TIP_OFFSET], across @ place[-1], atol=1e-5)
    np.testing.assert_allclose(state[sv.TIP_SLOPE], across @ slope[-1], atol=3e-4)
    force = across @ moment / (LENGTH - depth)
    np.testing.assert_allclose(state[sv.FORCE], force, atol=2e-3 * np.linalg.norm(force))
    ei = bending_stiffness(OUTER_DIAMETER[gauge])
    np.testing.assert_allclose(
        state[sv.ROOT_CURVATURE], -state[sv.FORCE] * (LENGTH - depth) / ei, rtol=1e-9, atol=1e-12
    )


@pytest.mark.parametrize("gauge", [18, 22])
def test_a_wandering_channel_is_remembered_where_the_bent_tip_cut_it(gauge: int) -> None:
    memory, rest = tissue(gauge), [[0.0, 0.0, 0.0, 0.0]]
    for depth in np.arange(0.0002, 0.0801, 0.0002):
        axis = leaning(0.06 * np.sin(40.0 * depth), 0.5)
        state = tick(memory, axis, depth)
        rest.append([depth, *(depth * axis + state[sv.TIP_OFFSET])])
    axis = leaning(0.12, 1.4)
    state = tick(memory, axis, 0.08)
    place, _, moment = fine_beam(axis, 0.08, np.array(rest), gauge)
    across = np.eye(3) - np.outer(axis, axis)
    np.testing.assert_allclose(state[sv.TIP_OFFSET], across @ place[-1], atol=3e-5)
    force = across @ moment / (LENGTH - 0.08)
    np.testing.assert_allclose(state[sv.FORCE], force, atol=5e-3 * np.linalg.norm(force))
    assert np.linalg.norm(state[sv.TIP_OFFSET]) > 1e-3


@pytest.mark.long("machine")
@pytest.mark.parametrize(("gauge", "limit"), [(18, 2e-5), (20, 2e-5), (22, 5e-5)])
def test_the_shape_from_ten_numbers_is_that_of_the_fine_beam(gauge: int, limit: float) -> None:
    for depth in (0.02, 0.06, 0.1):
        memory, axis = tissue(gauge), leaning(np.radians(3.0))
        tick(memory, leaning(0.0), depth)
        bend = Bend.of_row(tick(memory, axis, depth))
        rest = np.array([[0.0, 0, 0, 0], [1.0, 0, 0, -1.0]])
        place, _, _ = fine_beam(axis, depth, rest, gauge)
        across = np.eye(3) - np.outer(axis, axis)
        depths = np.linspace(0.0, depth, len(place))
        beside = (place - depths[:, None] * axis) @ across
        assert np.abs(bend.at(depths) - beside).max() < limit
        again = Bend.of_numbers(bend.numbers())
        np.testing.assert_array_equal(again.at(depths), bend.at(depths))


def test_the_shape_meets_its_ends_and_goes_on_straight() -> None:
    bend = Bend([1e-3, 0, 0], [-0.02, 0, 0], [3.0, 0, 0], 0.08)
    assert not bend.at(0.0).any()
    assert not bend.slope_at(0.0).any()
    np.testing.assert_allclose(bend.at(0.08), bend.offset, rtol=1e-12)
    np.testing.assert_allclose(bend.slope_at(0.08), bend.slope, rtol=1e-12)
    np.testing.assert_allclose(bend.at(0.1), bend.offset + 0.02 * bend.slope, rtol=1e-12)
    step = 1e-6
    slope = (bend.at(0.05 + step) - bend.at(0.05 - step)) / (2 * step)
    np.testing.assert_allclose(bend.slope_at(0.05), slope, rtol=1e-6)
    curvature = (bend.at(2e-5) - 2 * bend.at(1e-5)) / 1e-10
    np.testing.assert_allclose(curvature, bend.curvature, rtol=1e-2, atol=1e-9)
    tip = 0.08 * leaning(0.0) + bend.offset
    points = needle_curve(tip, leaning(0.0), 0.08, bend)
    assert len(points) == CURVE_POINTS
    np.testing.assert_allclose(points[0], 0.0, atol=1e-15)
    np.testing.assert_allclose(points[-1], tip, atol=1e-15)


def test_a_rigid_needle_and_one_outside_have_no_bend() -> None:
    rigid = tissue(model="winkler")
    tick(rigid, leaning(0.0), 0.08)
    assert Bend.of_row(tick(rigid, leaning(0.1), 0.08)) is None
    assert Bend.of_row(tick(tissue(), leaning(0.1), -0.01)) is None


def test_the_bent_needles_energy_is_what_its_force_takes_along_any_turn() -> None:
    memory = tissue(22)
    for depth in np.arange(0.0, 0.07, 0.0005):
        tick(memory, leaning(2.0 * depth, 30.0 * depth), depth)
    axis = leaning(0.2, 0.8)
    force = tick(memory, axis, 0.07)[sv.FORCE]
    for direction in (np.cross(axis, [1.0, 0, 0]), np.cross(axis, [0, 1.0, 0])):
        turned = [unit(axis + s * 1e-5 * direction) for s in (1.0, -1.0)]
        rise, fall = (effect.stored_energy(memory, n) for n in turned)
        moved = (turned[0] - turned[1]) * -(LENGTH - 0.07)  # of the hub
        assert fall - rise == pytest.approx(force @ moved, rel=1e-6)


def test_passing_the_edge_of_a_bin_moves_neither_force_nor_tip_by_a_jump() -> None:
    memory = tissue(22)
    for depth in np.arange(0.0, 0.061, 0.0007):
        tick(memory, leaning(0.1 * np.sin(60.0 * depth)), depth)
    edge = 58 * effect.BIN
    for near, far in ((edge + 1e-9, edge - 1e-9), (edge - 1e-9, edge + 1e-9)):
        before, after = (tick(memory, leaning(0.15), depth) for depth in (near, far))
        assert np.abs(before[sv.FORCE] - after[sv.FORCE]).max() < 1e-6
        assert np.abs(before[sv.TIP_OFFSET] - after[sv.TIP_OFFSET]).max() < 1e-7
