"""Skin and structures of a run as a few thousand triangles, for programs that draw them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import ceil, sqrt
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.ndimage import gaussian_filter

from app.core.arrays import FloatArray, IntArray, read_only
from app.core.identifiers import without_identifiers
from app.core.units import MILLIMETRE
from app.exchange.moment import LiveSurface
from app.imaging.body import find_body
from app.session.risks import Risk

if TYPE_CHECKING:
    from app.imaging.volume import Volume

_AROUND = ((1, 1), (0, 1), (0, 0), (1, 0))
"""Cells round an edge, as steps back along the two other axes, counter-clockwise about it."""


@dataclass(frozen=True, slots=True, eq=False)
class CoarseSurface:
    """A closed surface.

    Attributes:
        points_mm: LPS [mm], shape (n, 3).
        triangles: corners, counter-clockwise seen from outside, shape (m, 3).
    """

    points_mm: FloatArray
    triangles: IntArray


def coarse_surface(
    values: NDArray[Any], affine_mm: ArrayLike, level: float, most: int = 4000
) -> CoarseSurface:
    """Return the surface at a level; what lies beyond the grid is outside.

    Args:
        values: shape (K, J, I); inside is what is greater than `level`.
        affine_mm: index (i, j, k) to LPS [mm], shape (4, 4).
        level: value on the surface.
        most: bound of the number of triangles: so many values are left out as it takes.

    Returns:
        No points and triangles where nothing is inside.
    """
    v = np.asarray(values, np.float64).transpose(2, 1, 0) - level
    affine, step = np.asarray(affine_mm, np.float64), 1
    while True:
        points, corners = _net(v[::step, ::step, ::step])
        if len(corners) <= most:
            break
        step = max(step + 1, ceil(0.95 * step * sqrt(len(corners) / most)))
    if np.linalg.det(affine[:3, :3]) < 0.0:
        corners = corners[:, ::-1]
    placed = step * points @ affine[:3, :3].T + affine[:3, 3]
    return CoarseSurface(read_only(placed), read_only(corners))


def _net(v: FloatArray) -> tuple[FloatArray, IntArray]:
    """Points [indices], shape (n, 3), and triangles, shape (m, 3), round what is above 0."""
    v = np.pad(v, 1, constant_values=-float(np.abs(v).max(initial=0.0)) or -1.0)
    inside, shape = v > 0.0, v.shape
    crossings, cells = [], []
    for a in range(3):
        b, c = (a + 1) % 3, (a + 2) % 3
        along = [slice(None)] * 3
        along[a] = slice(1, None)
        low = tuple(slice(None, -1) if axis == a else slice(None) for axis in range(3))
        edge = np.argwhere(inside[low] != inside[tuple(along)])
        beyond = edge + np.eye(3, dtype=np.int64)[a]
        first, second = v[tuple(edge.T)], v[tuple(beyond.T)]
        crossing = edge.astype(np.float64)
        crossing[:, a] += first / (first - second)
        around = np.empty((len(edge), 4), np.int64)
        for corner, (back_b, back_c) in enumerate(_AROUND):
            cell = edge.copy()
            cell[:, b] -= back_b
            cell[:, c] -= back_c
            around[:, corner] = np.ravel_multi_index(tuple(cell.T), shape)
        around[first <= 0.0] = around[first <= 0.0, ::-1]  # the inside lies beyond
        crossings.append(crossing)
        cells.append(around)
    crossing, quads = np.concatenate(crossings), np.concatenate(cells)
    names, corners = np.unique(quads, return_inverse=True)
    corners = corners.reshape(-1, 4)
    counts = np.bincount(corners.ravel(), minlength=len(names))
    points = np.stack(
        [
            np.bincount(corners.ravel(), np.repeat(crossing[:, axis], 4), len(names)) / counts
            for axis in range(3)
        ],
        axis=1,
    )
    triangles = np.concatenate([corners[:, :3], corners[:, [0, 2, 3]]])
    return points - 1.0, triangles.astype(np.int64)


SKIN: Final = "skin"
SKIN_TRIANGLES: Final = 6000
STRUCTURE_TRIANGLES: Final = 1500


def live_surfaces(volume: Volume | None, risks: Iterable[Risk]) -> tuple[LiveSurface, ...]:
    """Return the skin, where a CT is open, and the structures of risk.

    Takes some tenths of a second on a large CT, of a thread that nobody waits for.
    """
    found = []
    if volume is not None:
        body = find_body(volume)
        affine = np.array(volume.affine_mm, np.float64)
        affine[:3, :3] *= body.factors
        smooth = gaussian_filter(np.asarray(body.coarse, np.float32), 0.7, mode="nearest")
        found.append(_surface(SKIN, coarse_surface(smooth, affine, 0.5, SKIN_TRIANGLES), True))
    for risk in risks:
        field = risk.field
        affine = np.diag([field.step_mm, field.step_mm, field.step_mm, 1.0])
        affine[:3, 3] = field.start_mm
        surface = coarse_surface(-field.values, affine, 0.0, STRUCTURE_TRIANGLES)
        found.append(_surface(without_identifiers(risk.name), surface, False))
    return tuple(one for one in found if len(one.triangles))


def _surface(name: str, surface: CoarseSurface, skin: bool) -> LiveSurface:
    return LiveSurface(name, surface.points_mm * MILLIMETRE, surface.triangles, skin)
