"""Distances of voxels' centres from the boundaries of their tissue, to 3 mm, from places on edges.

Where two neighbours along an axis have different labels, the boundary crosses the edge between
them at a known share of it. A voxel with such crossings at h_x, h_y, h_z lies 1 / sqrt(sum 1 / h^2)
from the plane through them (Sethian, Fast marching methods, SIAM Review 41 (1999) 199). Voxels
further in take the nearest of their neighbours' planes, ring by ring.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.imaging.field.tissue_field import FARTHEST, FARTHEST_MM, STEPS_PER_MM

Indices = NDArray[np.intp]
Crossing = Callable[[Indices, Indices], NDArray[np.float32]]
"""Share of the way at which the boundary lies between voxels (flat indices), 0 to 1."""

_LEAST: Final = 1e-3  # a crossing no nearer to a centre than this share of an edge
_AROUND: Final = [offset for offset in product((-1, 0, 1), repeat=3) if any(offset)]
_FLIPPED: Final = [offset for offset in _AROUND if sum(map(abs, offset)) == 1]


def distances(
    labels: NDArray[Any], spacing_mm: Any, crossing: Crossing, within_mm: float = FARTHEST_MM
) -> NDArray[np.int8]:
    """Return the distance of every voxel's centre in 1/40 mm, at most 127, int8.

    Args:
        labels: shape (nz, ny, nx).
        spacing_mm: between voxels along i, j and k, at right angles.
        crossing: see there.
        within_mm: what is further off than this, or than the rings reach, is told 127.
    """
    shape = labels.shape
    flat = labels.ravel()
    nearest, normals, voxels = _first_ring(labels, flat, spacing_mm, crossing)
    result = np.full(labels.size, FARTHEST, np.int8)
    result[voxels] = _stored(nearest)
    ring, depth, way = voxels, nearest, normals
    reach = min(within_mm, FARTHEST_MM)
    known = np.zeros(labels.size, bool)
    known[voxels] = True
    # The first step goes to all 26 neighbours: cells that a boundary cuts have such corners.
    for offsets in (_AROUND, *[_FLIPPED] * round(reach / min(spacing_mm))):
        ring, depth, way = _next_ring(
            flat, shape, spacing_mm, ring, depth, way, known, offsets, reach
        )
        if not len(ring):
            break
        known[ring] = True
        result[ring] = _stored(depth)
    return result.reshape(shape)


def _stored(distance_mm: NDArray[Any]) -> NDArray[np.int8]:
    return np.minimum(np.rint(distance_mm * STEPS_PER_MM), FARTHEST).astype(np.int8)


def _first_ring(
    labels: NDArray[Any], flat: NDArray[Any], spacing_mm: Any, crossing: Crossing
) -> tuple[NDArray[np.float32], NDArray[np.float32], Indices]:
    """Distances [mm], unit normals towards the boundary (i, j, k) and indices of cut voxels."""
    touched = np.zeros(labels.size, bool)
    edges = []
    for axis in range(3):
        stride = int(np.prod(labels.shape[axis + 1 :], dtype=np.intp))
        differ = np.zeros(labels.shape, bool)
        low = tuple(slice(None, -1) if a == axis else slice(None) for a in range(3))
        high = tuple(slice(1, None) if a == axis else slice(None) for a in range(3))
        np.not_equal(labels[low], labels[high], out=differ[low])
        first = np.flatnonzero(differ)
        second = first + stride
        share = np.clip(crossing(first, second), _LEAST, 1.0 - _LEAST)
        edges.append((2 - axis, first, second, share))
        touched[first] = True
        touched[second] = True
    voxels = np.flatnonzero(touched)
    row = np.full(labels.size, -1, np.int32)
    row[voxels] = np.arange(len(voxels), dtype=np.int32)
    inverse = np.zeros((len(voxels), 3), np.float32)  # signed 1 / h along i, j, k
    for axis, first, second, share in edges:
        step = float(spacing_mm[axis])
        inverse[row[first], axis] = 1.0 / (share * step)
        behind = row[second]
        back = 1.0 / ((1.0 - share) * step)
        nearer = back > inverse[behind, axis]
        inverse[behind[nearer], axis] = -back[nearer]
    length = np.sqrt((inverse * inverse).sum(axis=1))
    return 1.0 / length, inverse / length[:, None], voxels


def _next_ring(
    flat: NDArray[Any],
    shape: tuple[int, ...],
    spacing_mm: Any,
    ring: Indices,
    depth: NDArray[np.float32],
    way: NDArray[np.float32],
    known: NDArray[np.bool_],
    offsets: list[tuple[int, int, int]],
    reach: float,
) -> tuple[Indices, NDArray[np.float32], NDArray[np.float32]]:
    """Return the voxels next to a ring that are not known yet, their distances and normals."""
    k, j, i = np.unravel_index(ring, shape)
    own = flat[ring]
    at, distances_mm, ways = [], [], []
    for dk, dj, di in offsets:
        inside = np.ones(len(ring), bool)
        for place, step, size in ((k, dk, shape[0]), (j, dj, shape[1]), (i, di, shape[2])):
            if step:
                inside &= (place + step >= 0) & (place + step < size)
        chosen = np.flatnonzero(inside)
        to = ring[chosen] + (dk * shape[1] + dj) * shape[2] + di
        fresh = ~known[to] & (flat[to] == own[chosen])
        chosen, to = chosen[fresh], to[fresh]
        moved = np.array([di, dj, dk], np.float32) * np.asarray(spacing_mm, np.float32)
        distance = depth[chosen] - way[chosen] @ moved
        useful = (distance > 0.0) & (distance <= reach)
        at.append(to[useful])
        distances_mm.append(distance[useful])
        ways.append(way[chosen[useful]])
    every, distance, normal = map(np.concatenate, (at, distances_mm, ways))
    order = np.lexsort((distance, every))
    every = every[order]
    first = np.ones(len(every), bool)
    first[1:] = every[1:] != every[:-1]
    order = order[first]
    return every[first], distance[order], normal[order]
