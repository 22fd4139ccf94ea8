"""Coarse surfaces, against closed forms: volume, Euler number, and how far off they lie."""

import numpy as np
import pytest

from app.compose.live_surfaces import coarse_surface

AFFINE = np.eye(4)
AFFINE[:3] = [[0.0, 2.0, 0.0, -31.0], [1.5, 0.0, 0.0, 5.0], [0.0, 0.0, -2.5, 9.0]]
"""Axes that change places, one of them against LPS: determinant above 0."""

MIRRORED = AFFINE @ np.diag([1.0, 1.0, -1.0, 1.0])


def grid(affine, size=(44, 40, 36)):
    """Places [mm] of a grid of size (I, J, K), shape (K, J, I, 3)."""
    k, j, i = np.meshgrid(*(range(n) for n in size[::-1]), indexing="ij")
    return np.stack([i, j, k], axis=-1) @ affine[:3, :3].T + affine[:3, 3]


def middle(places):
    return places.reshape(-1, 3).mean(axis=0)


def volume(surface):
    """Volume inside [mm³], by the divergence theorem; below 0 where the inside lies outside."""
    a, b, c = np.moveaxis(surface.points_mm[surface.triangles], 1, 0)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


def euler(surface):
    """Euler number; fails where an edge does not join two triangles, once in each direction."""
    t = surface.triangles
    edges = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    there = {tuple(edge) for edge in edges.tolist()}
    assert len(there) == len(edges)
    assert there == {(b, a) for a, b in there}
    return len(surface.points_mm) - len(edges) // 2 + len(t)


@pytest.mark.parametrize("affine", [AFFINE, MIRRORED])
def test_a_ball_is_closed_seen_from_outside_and_of_its_volume(affine):
    places = grid(affine)
    centre = middle(places)
    off = np.linalg.norm(places - centre, axis=-1)
    surface = coarse_surface(-off, affine, -25.0, most=100_000)
    assert euler(surface) == 2
    assert volume(surface) == pytest.approx(4.0 / 3.0 * np.pi * 25.0**3, rel=0.01)
    radii = np.linalg.norm(surface.points_mm - centre, axis=1)
    assert radii == pytest.approx(25.0, abs=0.2)


def test_a_ring_keeps_its_hole():
    places = grid(AFFINE)
    x, y, z = np.moveaxis(places - middle(places), -1, 0)
    off = np.hypot(np.hypot(x, y) - 18.0, z)
    surface = coarse_surface(-off, AFFINE, -7.0, most=100_000)
    assert euler(surface) == 0
    assert volume(surface) == pytest.approx(2.0 * np.pi**2 * 18.0 * 7.0**2, rel=0.06)


def test_fewer_triangles_are_of_the_same_ball():
    places = grid(AFFINE)
    off = np.linalg.norm(places - middle(places), axis=-1)
    surface = coarse_surface(-off, AFFINE, -25.0, most=900)
    assert 200 < len(surface.triangles) <= 900
    assert euler(surface) == 2
    assert volume(surface) == pytest.approx(4.0 / 3.0 * np.pi * 25.0**3, rel=0.08)


def test_what_reaches_the_edge_of_the_grid_is_closed_there():
    surface = coarse_surface(np.ones((6, 5, 4)), np.eye(4), 0.5)
    assert euler(surface) == 2
    assert volume(surface) == pytest.approx(4.0 * 5.0 * 6.0, rel=0.35)
    assert surface.points_mm.min() >= -1.0


def test_nothing_has_no_surface():
    surface = coarse_surface(np.zeros((4, 4, 4)), np.eye(4), 0.5)
    assert (surface.points_mm.shape, surface.triangles.shape) == ((0, 3), (0, 3))
