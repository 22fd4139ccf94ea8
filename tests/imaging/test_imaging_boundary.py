"""Exact distances along a path: to the boundary half-way between voxels, at any size."""

import numpy as np
import pytest
from test_imaging_structures import ball, made, middle, turned

from app.imaging.structures.distance import Boundary, SignedDistance, _to_triangles
from app.imaging.structures.structure import Structure


def box(volume, low, high):
    """Voxels low to high (i, j, k), both included, as a structure."""
    mask = np.zeros(volume.hu.shape, bool)
    mask[low[2] : high[2] + 1, low[1] : high[1] + 1, low[0] : high[0] + 1] = True
    return Structure.of("box", mask, volume)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("turn", [None, turned()])
@pytest.mark.parametrize("spacing", [(0.8, 0.8, 2.0), (0.7, 0.7, 0.7), (1.0, 1.0, 5.0)])
def test_a_ball_is_as_far_as_it_is_to_half_a_voxel(spacing, turn):
    volume = made((64, 64, 48), spacing, turn=turn)
    centre = middle(volume) + [0.21, -0.13, 0.34]
    boundary = Boundary.of(Structure.of("b", ball(volume, centre, 14.0), volume))
    assert boundary.accuracy_mm == max(spacing) / 2
    rng = np.random.default_rng(1)
    directions = rng.normal(size=(400, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    radii = rng.uniform(1.0, 60.0, 400)
    error = boundary.at(centre + directions * radii[:, None]) - (radii - 14.0)
    assert np.abs(error).max() <= boundary.accuracy_mm


@pytest.mark.parametrize("seed", range(4))
def test_the_boundary_of_any_mask_is_closed_and_the_nearest_triangle_is_found(seed):
    rng = np.random.default_rng(seed)
    volume = made((9, 8, 7), (0.8, 1.0, 2.0), turn=turned())
    mask = rng.random(volume.hu.shape) < 0.3
    boundary = Boundary.of(Structure.of("noise", mask, volume))
    corners = np.rint(boundary.triangles * 1e6).astype(np.int64)
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    ordered = np.array([sorted(map(tuple, edge)) for edge in edges.tolist()])
    _, counts = np.unique(ordered.reshape(-1, 6), axis=0, return_counts=True)
    assert (counts % 2 == 0).all()
    points = volume.lps_mm(rng.uniform(-4, 12, (40, 3)))
    brute = [_to_triangles(point, boundary.triangles) for point in points]
    np.testing.assert_allclose(np.abs(boundary.at(points)), brute, atol=1e-9)
    least, most = boundary.bounds_mm(points)
    assert (least - 1e-9 <= boundary.at(points)).all()
    assert (boundary.at(points) <= most + 1e-9).all()


@pytest.mark.long("statistics")
def test_a_path_beside_touching_and_through_a_box_is_told_exactly():
    volume = made((60, 60, 40), (0.8, 0.8, 2.0))
    one = box(volume, (20, 20, 10), (39, 39, 29))
    field = SignedDistance.of(one)
    at = volume.lps_mm
    beside = field.along(at([44.5, -5, 20]), at([44.5, 70, 20]))
    assert beside.distance_mm == pytest.approx(5.0 * 0.8, abs=1e-6)
    assert beside.through_mm == 0.0
    touching = field.along(at([39.5, -5, 20]), at([39.5, 70, 20]))
    assert touching.distance_mm == pytest.approx(0.0, abs=1e-6)
    ends_at = field.along(at([30, -5, 20]), at([30, 15.5, 20]))
    assert ends_at.distance_mm == pytest.approx(4 * 0.8, abs=1e-6)
    assert ends_at.depth_mm == pytest.approx(20.5 * 0.8, abs=1e-6)
    through = field.along(at([30, -5, 20]), at([30, 70, 20]))
    assert through.distance_mm == pytest.approx(-7.6, abs=0.4)  # i 30 of 19.5 to 39.5
    assert through.through_mm == pytest.approx(16.0, abs=1.0)


@pytest.mark.long("statistics")
def test_the_distance_of_a_large_structure_is_as_exact_as_that_of_a_small_one():
    volume = made((230, 230, 200), (1.0, 1.0, 1.0))
    one = box(volume, (5, 5, 5), (200, 200, 190))
    field = SignedDistance.of(one)
    assert field.accuracy_mm > 1.4  # of the grid, which has grown with it
    at = volume.lps_mm
    past = field.along(at([203.5, -20, 100]), at([203.5, 260, 100]))
    assert past.distance_mm == pytest.approx(3.0, abs=1e-6)
    assert field.boundary.accuracy_mm == 0.5
    far = field.along(at([300, -20, 100]), at([300, 260, 100]), within_mm=10.0)
    assert far.distance_mm == pytest.approx(99.5, abs=field.accuracy_mm)


def test_one_voxel_and_one_at_the_edge_of_the_ct_have_their_boundaries():
    volume = made((20, 20, 20), (1.0, 1.0, 1.0))
    for where in ((10, 10, 10), (0, 19, 10)):
        field = SignedDistance.of(box(volume, where, where))
        at = volume.lps_mm(where)
        past = field.along(at + [-15.0, 3.0, 0.0], at + [15.0, 3.0, 0.0])
        assert past.distance_mm == pytest.approx(2.5, abs=1e-6)
        assert past.depth_mm == pytest.approx(15.0, abs=0.03)
        through = field.along(at - [0, 15.0, 0], at + [0, 15.0, 0])
        assert -0.5 <= through.distance_mm < 0.0
        assert through.through_mm == pytest.approx(1.0, abs=0.51)


def test_a_line_without_length_is_a_point():
    volume = made((20, 20, 20), (1.0, 1.0, 1.0))
    field = SignedDistance.of(box(volume, (8, 8, 8), (11, 11, 11)))
    at = volume.lps_mm([15.5, 10, 10])
    point = field.along(at, at)
    assert point.distance_mm == pytest.approx(4.0, abs=1e-6)
    assert (point.depth_mm, point.through_mm) == (0.0, 0.0)


@pytest.mark.long("statistics")
def test_the_nearest_place_of_a_path_has_no_better_neighbour():
    volume = made((64, 64, 48), (0.8, 0.8, 2.0), turn=turned())
    centre = middle(volume)
    field = SignedDistance.of(Structure.of("b", ball(volume, centre, 9.0), volume))
    rng = np.random.default_rng(3)
    for _ in range(12):
        start, end = centre + rng.normal(size=(2, 3)) * 30.0
        nearest = field.along(start, end)
        dense = start + np.linspace(0.0, 1.0, 400)[:, None] * (end - start)
        assert nearest.distance_mm <= field.boundary.at(dense).min() + 0.05


@pytest.mark.long("statistics")
def test_a_line_that_is_surely_no_nearer_is_passed_by_and_any_other_is_told_exactly():
    volume = made((60, 60, 40), (0.8, 0.8, 2.0))
    field = SignedDistance.of(box(volume, (20, 20, 10), (39, 39, 29)))
    random = np.random.default_rng(5)
    passed = 0
    for _ in range(60):
        start, end = volume.lps_mm(random.uniform(-10.0, 70.0, (2, 3)))
        exact = field.along(start, end).distance_mm
        for than in (exact - 3.0, exact - 0.01, exact + 0.01, np.inf):
            found = field.nearer(start, end, than)
            assert found in (None, exact)
            assert found is not None or exact >= than
            passed += found is None
    assert passed > 30
