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
_BESIDE = _AROUND[np.abs(_AROUND).sum(axis=1) == 1]


def distances(
    labels: NDArray[Any], spacing_mm: Any, crossing: Crossing, rounds: int = _ROUNDS
) -> NDArray[np.int8]:
    """Return the distance of every voxel's centre in 1/40 mm, at most 127, int8.

    Args:
        labels: uint8, shape (nz, ny, nx).
        spacing_mm: between voxels along i, j and k, at right angles.
        crossing: see there.
        rounds: how often the planes are turned to what lies around.
    """
    spacing = np.asarray(spacing_mm, np.float64)
    voxels, inverse, row = _cut(labels, spacing, crossing)
    flat, shape = np.ascontiguousarray(labels).ravel(), np.array(labels.shape)
    if not len(voxels):
        return np.full(labels.shape, FARTHEST, np.int8)
    depth = _planes(flat, shape, spacing, voxels, row, inverse, rounds)
    stored = np.minimum(np.rint(depth * STEPS_PER_MM), FARTHEST).astype(np.int8)
    return _completed(labels.shape, flat, shape, spacing, voxels, row, stored)


def ring_of(labels: NDArray[Any]) -> Indices:
    """Return the voxels with a neighbour along an axis that has another label, flat, ascending."""
    touched = np.zeros(labels.shape, bool)
    for axis in range(3):
        here, cut = np.moveaxis(labels, axis, 0), np.moveaxis(touched, axis, 0)
        differ = here[:-1] != here[1:]
        cut[:-1] |= differ
        cut[1:] |= differ
    return np.flatnonzero(touched)


def completed(labels: NDArray[Any], spacing_mm: Any, stored: NDArray[np.int8]) -> NDArray[np.int8]:
    """Return the distances of all voxels from those of `ring_of`, as `distances` does.

    Args:
        labels: uint8, shape (nz, ny, nx).
        spacing_mm: between voxels along i, j and k.
        stored: distances of the voxels of `ring_of` in 1/40 mm, in its order.
    """
    voxels = ring_of(labels)
    if not len(voxels):
        return np.full(labels.shape, FARTHEST, np.int8)
    row = np.full(labels.size, -1, np.int32)
    row[voxels] = np.arange(len(voxels), dtype=np.int32)
    flat, shape = np.ascontiguousarray(labels).ravel(), np.array(labels.shape)
    spacing = np.asarray(spacing_mm, np.float64)
    return _completed(labels.shape, flat, shape, spacing, voxels, row, stored)


def _completed(
    sizes: tuple[int, ...],
    flat: NDArray[Any],
    shape: NDArray[Any],
    spacing: NDArray[Any],
    voxels: Indices,
    row: NDArray[np.int32],
    stored: NDArray[np.int8],
) -> NDArray[np.int8]:
    """Fill in the voxels behind the ring, from its stored distances alone."""
    result = np.full(flat.size, FARTHEST, np.int8)
    depth = (stored / np.float32(STEPS_PER_MM)).astype(np.float32)
    way = _normals(flat, shape, spacing, voxels, row, depth)
    rings = int(np.ceil(FARTHEST_MM / float(spacing.min())))
    _spread(
        flat,
        shape,
        spacing,
        voxels,
        stored,
        depth,
        way,
        _AROUND,
        _BESIDE,
        rings,
        FARTHEST_MM,
        STEPS_PER_MM,
        result,
    )
    return result.reshape(sizes)


def _cut(
    labels: NDArray[Any], spacing: NDArray[Any], crossing: Crossing
) -> tuple[Indices, NDArray[np.float32], NDArray[np.int32]]:
    """Find the voxels that a boundary cuts an edge of: where, and signed 1 / h along i, j, k."""
    voxels = ring_of(labels)
    row = np.full(labels.size, -1, np.int32)
    row[voxels] = np.arange(len(voxels), dtype=np.int32)
    inverse = np.zeros((len(voxels), 3), np.float32)
    flat = labels.ravel()
    for axis in range(3):
        stride = int(np.prod(labels.shape[axis + 1 :], dtype=np.intp))
        place = (voxels // stride) % labels.shape[axis]
        mine = np.flatnonzero(place < labels.shape[axis] - 1)
        mine = mine[flat[voxels[mine]] != flat[voxels[mine] + stride]]
        first = voxels[mine]
        second = first + stride
        share = np.clip(crossing(first, second), _LEAST, 1.0 - _LEAST).astype(np.float32)
        step = np.float32(spacing[axis if axis == 1 else 2 - axis])
        inverse[mine, 2 - axis] = 1.0 / (share * step)
        behind = row[second]
        back = 1.0 / ((1.0 - share) * step)
        nearer = back > inverse[behind, 2 - axis]
        inverse[behind[nearer], 2 - axis] = -back[nearer]
    return voxels, inverse, row


@njit
def _slope(
    labels: Any,
    strides: Any,
    sizes: Any,
    spacing: Any,
    row: Any,
    depth: Any,
    way: Any,
    n: int,
    at: int,
    slope: Any,
) -> float:
    """Gradient of the distances around a voxel, towards its boundary, in `slope`; its length."""
    for a in range(3):
        place = (at // strides[a]) % sizes[a]
        total, known = 0.0, 0
        for side in range(2):
            sign = 2 * side - 1
            if (place == 0 and side == 0) or (place == sizes[a] - 1 and side == 1):
                continue
            to = at + sign * strides[a]
            other = row[to]
            if other >= 0:
                value = depth[other] if labels[to] == labels[at] else -depth[other]
                total += sign * (depth[n] - value)
                known += 1
        slope[a] = total / (known * spacing[a]) if known else way[n, a]
    return np.sqrt(slope[0] ** 2 + slope[1] ** 2 + slope[2] ** 2)


@njit
def _planes(
    labels: Any, shape: Any, spacing: Any, voxels: Any, row: Any, inverse: Any, rounds: int
) -> Any:
    """Distance [mm] of each cut voxel from the plane of its boundary, shape (n,)."""
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
            length = _slope(labels, strides, sizes, spacing, row, depth, way, n, voxels[n], slope)
            new_depth[n] = depth[n]
            for a in range(3):
                new_way[n, a] = way[n, a]
            if length < 1e-6:
                continue
            total, weights = 0.0, 0.0
            for a in range(3):
                part = slope[a] / length
                if inverse[n, a] * part > 0.0:
                    total += part * part * part / inverse[n, a]
                    weights += part * part
            if weights > 0.05:
                new_depth[n] = total / weights
                for a in range(3):
                    new_way[n, a] = slope[a] / length
        depth, new_depth = new_depth, depth
        way, new_way = new_way, way
    return depth


@njit
def _normals(labels: Any, shape: Any, spacing: Any, voxels: Any, row: Any, depth: Any) -> Any:
    """Return the unit normal towards the boundary of each cut voxel from the distances around.

    Returns:
        Along i, j and k, shape (n, 3).
    """
    count = len(voxels)
    way = np.zeros((count, 3), np.float32)
    strides = np.array([1, shape[2], shape[1] * shape[2]])
    sizes = np.array([shape[2], shape[1], shape[0]])
    slope = np.zeros(3)
    for _ in range(2):  # once to begin with, once with what goes on further in
        for n in range(count):
            length = _slope(labels, strides, sizes, spacing, row, depth, way, n, voxels[n], slope)
            if length > 1e-6:
                for a in range(3):
                    way[n, a] = slope[a] / length
    return way


@njit
def _spread(
    labels: Any,
    shape: Any,
    spacing: Any,
    voxels: Any,
    stored: Any,
    depth: Any,
    way: Any,
    every: Any,
    beside_only: Any,
    rings: int,
    most: float,
    steps: float,
    result: Any,
) -> None:
    """Store the distances of cut voxels and of those behind them, ring by ring."""
    beside = np.zeros(labels.size, np.float32)  # 0 where not known, negative where known
    for n in range(len(voxels)):
        beside[voxels[n]] = -1.0
        result[voxels[n]] = stored[n]
    ring, ring_depth, ring_way = voxels, depth, way
    for number_of_ring in range(rings):
        # cells that a boundary cuts have corners that only touch the ring: all 26 around, at first
        around = every if number_of_ring == 0 else beside_only
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
