"""Distances of voxels' centres from the boundaries of their tissue, to 3 mm, from places on edges.

Where two neighbours along an axis have different labels, the boundary crosses the edge between
them at a known share of it. A plane through the crossings of a voxel begins (h_x, h_y, h_z away,
1 / sqrt(sum 1 / h^2): Sethian, Fast marching methods, SIAM Review 41 (1999) 199); its normal is
then taken from the distances around, its place from the crossings by that normal, a few times.
Voxels further in take the plane of the neighbour that lies most behind them, ring by ring.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.compiled import njit
from app.imaging.field.tissue_field import FARTHEST, FARTHEST_MM, STEPS_PER_MM

Indices = NDArray[np.intp]
Crossing = Callable[[Indices, Indices], NDArray[Any]]
"""Share of the way at which the boundary lies between voxels (flat indices), 0 to 1."""

_LEAST = 0.01  # a boundary is no nearer to a centre than this share of an edge
_ROUNDS = 4
_AROUND = np.array([offset for offset in product((-1, 0, 1), repeat=3) if any(offset)], np.intp)


def distances(
    labels: NDArray[Any], spacing_mm: Any, crossing: Crossing, rings: int | None = None
) -> NDArray[np.int8]:
    """Return the distance of every voxel's centre in 1/40 mm, at most 127, int8.

    Args:
        labels: shape (nz, ny, nx).
        spacing_mm: between voxels along i, j and k, at right angles.
        crossing: see there.
        rings: how many voxels from the boundaries to go; as far as a distance reaches where None.
    """
    spacing = np.asarray(spacing_mm, np.float64)
    shape = labels.shape
    voxels, inverse, row = _cut(labels, spacing, crossing)
    result = np.full(labels.size, FARTHEST, np.int8)
    if not len(voxels):
        return result.reshape(shape)
    flat = np.ascontiguousarray(labels).ravel()
    depth, way = _planes(flat, np.array(shape), spacing, voxels, row, inverse, _ROUNDS)
    wanted = int(np.ceil(FARTHEST_MM / spacing.min())) if rings is None else rings
    del row, inverse
    _spread(
        flat, np.array(shape), spacing, voxels, depth, way, _AROUND, wanted, FARTHEST_MM,
        STEPS_PER_MM, result,
    )  # fmt: skip
    return result.reshape(shape)


def _cut(
    labels: NDArray[Any], spacing: NDArray[Any], crossing: Crossing
) -> tuple[Indices, NDArray[np.float32], NDArray[np.int32]]:
    """Find the voxels that a boundary cuts an edge of: where, and signed 1 / h along i, j, k."""
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
        share = np.clip(crossing(first, second), _LEAST, 1.0 - _LEAST).astype(np.float32)
        edges.append((2 - axis, first, second, share))
        touched[first] = True
        touched[second] = True
    voxels = np.flatnonzero(touched)
    row = np.full(labels.size, -1, np.int32)
    row[voxels] = np.arange(len(voxels), dtype=np.int32)
    inverse = np.zeros((len(voxels), 3), np.float32)
    for axis, first, second, share in edges:
        step = float(spacing[axis])
        inverse[row[first], axis] = 1.0 / (share * step)
        behind = row[second]
        back = 1.0 / ((1.0 - share) * step)
        nearer = back > inverse[behind, axis]
        inverse[behind[nearer], axis] = -back[nearer]
    return voxels, inverse, row


@njit
def _planes(
    labels: Any, shape: Any, spacing: Any, voxels: Any, row: Any, inverse: Any, rounds: int
) -> tuple[Any, Any]:
    """Distance [mm] and unit normal towards the boundary of each cut voxel, (n,) and (n, 3)."""
    count = len(voxels)
    depth = np.empty(count, np.float32)
    way = np.empty((count, 3), np.float32)
    for n in range(count):
        length = np.sqrt(inverse[n, 0] ** 2 + inverse[n, 1] ** 2 + inverse[n, 2] ** 2)
        depth[n] = 1.0 / length
        for a in range(3):
            way[n, a] = inverse[n, a] / length
    new_depth, new_way = depth.copy(), way.copy()
    strides = np.array([1, shape[2], shape[1] * shape[2]])
    sizes = np.array([shape[2], shape[1], shape[0]])
    slope = np.zeros(3)
    for _ in range(rounds):
        for n in range(count):
            at = voxels[n]
            label = labels[at]
            for a in range(3):
                place = (at // strides[a]) % sizes[a]
                values = np.empty(2)
                for side in range(2):
                    sign = 2 * side - 1
                    if (place == 0 and side == 0) or (place == sizes[a] - 1 and side == 1):
                        values[side] = depth[n] - way[n, a] * sign * spacing[a]
                        continue
                    to = at + sign * strides[a]
                    other = row[to]
                    if other < 0:
                        values[side] = depth[n] - way[n, a] * sign * spacing[a]
                    elif labels[to] == label:
                        values[side] = depth[other]
                    else:
                        values[side] = -depth[other]
                slope[a] = (values[0] - values[1]) / (2.0 * spacing[a])
            length = np.sqrt(slope[0] ** 2 + slope[1] ** 2 + slope[2] ** 2)
            if length < 1e-6:
                continue
            total, weights = 0.0, 0.0
            for a in range(3):
                part = slope[a] / length
                new_way[n, a] = part
                if inverse[n, a] * part > 0.0:
                    weight = part * part
                    total += weight * part / inverse[n, a]
                    weights += weight
            if weights > 0.05:
                new_depth[n] = total / weights
            else:
                new_depth[n] = depth[n]
                for a in range(3):
                    new_way[n, a] = way[n, a]
        depth, new_depth = new_depth, depth
        way, new_way = new_way, way
    return depth, way


@njit
def _spread(
    labels: Any,
    shape: Any,
    spacing: Any,
    voxels: Any,
    depth: Any,
    way: Any,
    around: Any,
    rings: int,
    most: float,
    steps: float,
    result: Any,
) -> None:
    """Store the distances of cut voxels and of those behind them, ring by ring."""
    beside = np.zeros(labels.size, np.float32)  # 0 where not known, negative where known
    for n in range(len(voxels)):
        beside[voxels[n]] = -1.0
        result[voxels[n]] = min(np.rint(depth[n] * steps), 127.0)
    ring, ring_depth, ring_way = voxels, depth, way
    for _ in range(rings):
        count = 0
        for n in range(len(ring)):  # how far beside its plane each neighbour lies
            at = ring[n]
            i, j, k = at % shape[2], (at // shape[2]) % shape[1], at // (shape[1] * shape[2])
            for m in range(len(around)):
                dk, dj, di = around[m, 0], around[m, 1], around[m, 2]
                if not (0 <= k + dk < shape[0] and 0 <= j + dj < shape[1]):
                    continue
                if not 0 <= i + di < shape[2]:
                    continue
                to = at + (dk * shape[1] + dj) * shape[2] + di
                if labels[to] != labels[at] or beside[to] < 0.0:
                    continue
                x, y, z = di * spacing[0], dj * spacing[1], dk * spacing[2]
                along = x * ring_way[n, 0] + y * ring_way[n, 1] + z * ring_way[n, 2]
                if ring_depth[n] - along > most or along > 0.0:
                    continue
                off = x * x + y * y + z * z - along * along + 1e-3
                if beside[to] == 0.0:
                    count += 1
                    beside[to] = off
                elif off < beside[to]:
                    beside[to] = off
        found = np.empty(count, np.intp)
        found_depth = np.empty(count, np.float32)
        found_way = np.empty((count, 3), np.float32)
        number = 0
        for n in range(len(ring)):
            at = ring[n]
            i, j, k = at % shape[2], (at // shape[2]) % shape[1], at // (shape[1] * shape[2])
            for m in range(len(around)):
                dk, dj, di = around[m, 0], around[m, 1], around[m, 2]
                if not (0 <= k + dk < shape[0] and 0 <= j + dj < shape[1]):
                    continue
                if not 0 <= i + di < shape[2]:
                    continue
                to = at + (dk * shape[1] + dj) * shape[2] + di
                if labels[to] != labels[at] or beside[to] <= 0.0:
                    continue
                x, y, z = di * spacing[0], dj * spacing[1], dk * spacing[2]
                along = x * ring_way[n, 0] + y * ring_way[n, 1] + z * ring_way[n, 2]
                if ring_depth[n] - along > most or along > 0.0:
                    continue
                off = x * x + y * y + z * z - along * along + 1e-3
                if off <= beside[to] * 1.000001:
                    beside[to] = -1.0
                    found[number] = to
                    found_depth[number] = ring_depth[n] - along
                    for a in range(3):
                        found_way[number, a] = ring_way[n, a]
                    result[to] = min(np.rint(found_depth[number] * steps), 127.0)
                    number += 1
        ring, ring_depth, ring_way = found[:number], found_depth[:number], found_way[:number]
        if number == 0:
            break
