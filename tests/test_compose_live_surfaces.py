"""Surfaces for other programs, against closed forms: volume, place, and that they are closed."""

from types import SimpleNamespace

import numpy as np
import pytest

from app.compose.live_surfaces import STRUCTURE_TRIANGLES, live_surfaces
from app.session.risks import Risk

RADIUS_MM = 20.0
CENTRE_MM = np.array([-31.0, 5.0, 209.0])


def ball(half_mm, step_mm=1.5):
    """Distances to a ball on a grid that reaches so far to every side of its centre."""
    start = CENTRE_MM - half_mm
    count = int(2 * half_mm / step_mm) + 1
    k, j, i = np.meshgrid(*(range(count),) * 3, indexing="ij")
    places = start + step_mm * np.stack([i, j, k], axis=-1)
    off = np.linalg.norm(places - CENTRE_MM, axis=-1) - RADIUS_MM
    field = SimpleNamespace(values=off.astype(np.float32), start_mm=start, step_mm=step_mm)
    return Risk("kidney", 5.0, field)


def volume_mm3(surface):
    """Volume inside, by the divergence theorem; below 0 where the inside lies outside."""
    a, b, c = np.moveaxis(1e3 * surface.points[surface.triangles], 1, 0)
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


def is_closed(surface):
    t = surface.triangles
    edges = np.concatenate([t[:, [0, 1]], t[:, [1, 2]], t[:, [2, 0]]])
    there = {tuple(edge) for edge in edges.tolist()}
    return there == {(b, a) for a, b in there}


def test_a_structure_is_closed_seen_from_outside_in_its_place_and_of_its_volume():
    (surface,) = live_surfaces(None, [ball(30.0)])
    assert (surface.name, surface.skin) == ("kidney", False)
    assert 200 < len(surface.triangles) <= STRUCTURE_TRIANGLES
    assert is_closed(surface)
    assert volume_mm3(surface) == pytest.approx(4.0 / 3.0 * np.pi * RADIUS_MM**3, rel=0.03)
    radii = np.linalg.norm(1e3 * surface.points - CENTRE_MM, axis=1)
    assert radii == pytest.approx(RADIUS_MM, abs=0.6)


def test_what_reaches_the_edge_of_the_grid_is_closed_there():
    (surface,) = live_surfaces(None, [ball(12.0)])
    assert is_closed(surface)
    assert volume_mm3(surface) == pytest.approx(24.0**3, rel=0.3)


def test_nothing_has_no_surface():
    risk = ball(30.0)
    risk.field.values[:] = 9.0
    assert live_surfaces(None, [risk]) == ()
