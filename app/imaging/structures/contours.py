"""Outlines of a structure in any plane: closed lines by marching squares (Lorensen, Cline 1987)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.interpolation import interpolate
from app.imaging.structures.structure import Structure

# From which edge of a cell to which a line runs, for each set of corners inside (1 upper left,
# 2 upper right, 4 lower right, 8 lower left); what is inside lies on its left. 0 top, 1 right,
# 2 bottom, 3 left. Two corners across from each other are kept apart.
_LINES = {
    1: ((3, 0),), 2: ((0, 1),), 3: ((3, 1),), 4: ((1, 2),), 5: ((3, 0), (1, 2)), 6: ((0, 2),),
    7: ((3, 2),), 8: ((2, 3),), 9: ((2, 0),), 10: ((0, 1), (2, 3)), 11: ((2, 1),), 12: ((1, 3),),
    13: ((1, 0),), 14: ((0, 3),),
}  # fmt: skip


def outlines(values: NDArray[np.floating], level: float = 0.5) -> list[FloatArray]:
    """Return the closed lines at which an array passes `level`; beyond its edges counts as below.

    Args:
        values: shape (rows, columns).
        level: of the lines.

    Returns:
        Lines of points (column, row) as floats, each of shape (n, 2), the last joined to the first.
    """
    padded = np.pad(np.asarray(values, np.float64), 1, constant_values=level - 1.0)
    inside = padded >= level
    if not inside.any():
        return []
    rows, columns = padded.shape
    a, b, c, d = inside[:-1, :-1], inside[:-1, 1:], inside[1:, 1:], inside[1:, :-1]
    case = a + 2 * b + 4 * c + 8 * d
    after: dict[int, int] = {}
    for number, lines in _LINES.items():
        row, column = np.nonzero(case == number)
        here = row * columns + column
        edges = (here, rows * columns + here + 1, here + columns, rows * columns + here)
        for start, end in lines:
            after.update(zip(edges[start].tolist(), edges[end].tolist(), strict=True))
    return [_points(np.array(ring), padded, level) - 1.0 for ring in _rings(after)]


def _rings(after: dict[int, int]) -> list[list[int]]:
    rings = []
    while after:
        start, at = after.popitem()
        ring = [start]
        while at != start:
            ring.append(at)
            at = after.pop(at)
        rings.append(ring)
    return rings


def _points(edges: NDArray[np.intp], values: FloatArray, level: float) -> FloatArray:
    """Points (column, row) on edges, numbered row by row: first the flat, then the upright ones."""
    columns = values.shape[1]
    upright, place = np.divmod(edges, values.size)
    row, column = np.divmod(place, columns)
    first = values[row, column]
    second = values[row + upright, column + 1 - upright]
    share = (level - first) / (second - first)
    return np.column_stack([column + (1 - upright) * share, row + upright * share])


def contours(
    structure: Structure,
    origin_mm: FloatArray,
    right: FloatArray,
    down: FloatArray,
    pixel_mm: float = 0.7,
) -> list[FloatArray]:
    """Outlines of a structure in a plane.

    Args:
        structure: what.
        origin_mm: point of the plane with the coordinates (0, 0), LPS, shape (3,).
        right: where x of the plane runs: LPS per millimetre, shape (3,).
        down: the same for y.
        pixel_mm: the structure is looked at in steps of this.

    Returns:
        Closed lines of points (x, y) [mm] in the plane, each of shape (n, 2).
    """
    frame = np.column_stack([right, down, np.cross(right, down)])
    box = (structure.box_mm - origin_mm) @ np.linalg.inv(frame).T
    if box[:, 2].min() > 0.0 or box[:, 2].max() < 0.0:
        return []
    to_mask = np.linalg.inv(structure.grid_mm)
    steps = np.column_stack([to_mask[:3, :3] @ right, to_mask[:3, :3] @ down])
    start = to_mask[:3, :3] @ origin_mm + to_mask[:3, 3]
    low, high = box[:, :2].min(axis=0), box[:, :2].max(axis=0)
    pixel = np.full(2, pixel_mm)
    if _along_voxels(steps):  # then look at centres of voxels only
        axes = np.abs(steps).argmax(axis=0)
        last = np.array(structure.mask.shape[::-1])[axes] - 1.0
        along = steps[axes, [0, 1]]
        ends = np.array([-start[axes] / along, (last - start[axes]) / along])
        low, high, pixel = ends.min(axis=0), ends.max(axis=0) - 1e-9, 1.0 / np.abs(along)
    columns, rows = (np.ceil((high - low) / pixel).astype(int) + 1).tolist()
    y, x = np.mgrid[:rows, :columns]
    plane = np.stack([x.ravel(), y.ravel()], axis=1) * pixel + low
    places = start + plane @ steps.T + 1.0  # one layer around
    inside = ((places > 0.0) & (places < np.array(structure.occupancy.shape[::-1]) - 1.0)).all(1)
    values = np.zeros(len(places))
    values[inside] = interpolate(structure.occupancy, places[inside])
    return [line * pixel + low for line in outlines(values.reshape(rows, columns))]


def _along_voxels(steps: FloatArray) -> bool:
    """Whether x and y of the plane both run along axes of the grid."""
    size = np.abs(steps)
    along = size.max(axis=0)
    return bool((size.sum(axis=0) - along <= 1e-6 * along).all())
