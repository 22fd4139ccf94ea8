"""How far points are from a structure: positive outside, negative inside.

Of many points at once: the structure is resampled to a cubic grid (its edge where its share of the
voxels passes one half) and the exact distances of its cells are computed (Maurer et al. 2003, in
scipy); beyond the grid the nearest of its surface cells counts. Of a line: exactly to the
structure's boundary, at whatever size.

The boundary of a structure as triangles, and exact distances to it.

The boundary passes half-way between each voxel centre inside and its neighbour outside: where the
share of the structure, linear between the two centres, is one half. In each cell of eight centres
the half-way points on its faces are joined to segments (marching squares; of two corners inside
across from each other, the structure holds together), and the segments to the cell's middle. The
true boundary crosses the line between the two centres too, so at these points it is never further
off than half of that distance.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from app.core.arrays import FloatArray, crosses, read_only
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.structures.inside import meeting, spans_inside
from app.imaging.structures.structure import Structure

Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class Boundary:
    """Triangles of a structure's boundary, LPS [mm].

    Attributes:
        triangles: shape (m, 3, 3), those of one cell after the other; the last corner of each is
            the cell's middle.
        first: where those of each cell begin, shape (cells + 1,).
        reach_mm: no corner is further from the middle of its cell.
        accuracy_mm: half of the largest edge of a voxel; see above.
    """

    triangles: FloatArray
    first: Indices
    reach_mm: float
    accuracy_mm: float
    _middles: Any
    _structure: Structure

    @classmethod
    def of(cls, structure: Structure) -> Boundary:
        """Find the boundary; a tenth of a second for each 100 000 voxels of its surface."""
        segments, cells = _segments(np.pad(structure.mask, 1))
        names, cell = np.unique(
            np.ravel_multi_index(tuple(cells.T), _shape(structure)), return_inverse=True
        )
        order = np.argsort(cell, kind="stable")
        segments, cell = segments[order], cell[order]
        counts = np.bincount(cell, minlength=len(names))
        middles = np.stack(
            [np.bincount(cell, segments.sum(axis=1)[:, a]) / (2.0 * counts) for a in range(3)],
            axis=1,
        )  # every half-way point of a cell ends two segments of it
        triangles = np.concatenate([segments, middles[cell][:, None, :]], axis=1)
        grid = structure.grid_mm
        placed = (triangles[..., ::-1] - 1.0) @ grid[:3, :3].T + grid[:3, 3]
        reach = float(np.linalg.norm(placed[:, :2] - placed[:, 2:], axis=2).max())
        first = np.concatenate([[0], np.cumsum(counts)]).astype(np.intp)
        spacing = np.linalg.norm(structure.affine_mm[:3, :3], axis=0)
        tree = cKDTree(placed[first[:-1], 2])
        return cls(placed, first, reach, 0.5 * float(spacing.max()), tree, structure)

    def bounds_mm(self, points_mm: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Between which values the signed distances of points lie, shape (n, 3) -> (n,) twice."""
        most = np.asarray(self._middles.query(points_mm)[0], np.float64)
        least = np.maximum(most - self.reach_mm, 0.0)
        inside = self.inside(points_mm)
        return np.where(inside, -most, least), np.where(inside, -least, most)

    def at(self, points_mm: FloatArray) -> FloatArray:
        """Signed distances [mm], negative inside, shape (n, 3) -> (n,)."""
        near = np.asarray(self._middles.query(points_mm)[0], np.float64) + self.reach_mm * 1.0001
        found = np.array(
            [
                _to_triangles(point, self._of_cells(self._middles.query_ball_point(point, radius)))
                for point, radius in zip(points_mm, near, strict=True)
            ]
        )
        result: FloatArray = np.where(self.inside(points_mm), -found, found)
        return result

    def inside(self, points_mm: FloatArray) -> NDArray[np.bool_]:
        """Return whether the structure's share at points, linear between voxel centres, is one
        half.
        """
        at = self._in_voxels(points_mm)
        share = ndimage.map_coordinates(
            self._structure.mask, at[:, ::-1].T, np.float32, order=1, mode="grid-constant"
        )
        result: NDArray[np.bool_] = share >= 0.5
        return result

    def spans(self, start_mm: FloatArray, end_mm: FloatArray) -> FloatArray:
        """Find the parts of a straight line inside: shares of it, ascending, shape (n, 2)."""
        start, end = self._in_voxels(np.stack([start_mm, end_mm]))
        return spans_inside(self._structure.mask, start, end)

    def meets(self, lines_mm: FloatArray) -> NDArray[np.bool_]:
        """Tell which lines of straight pieces are inside anywhere, (n, corners, 3) -> (n,)."""
        lines = self._in_voxels(lines_mm.reshape(-1, 3)).reshape(lines_mm.shape)
        return meeting(self._structure.mask, lines)

    def _in_voxels(self, points_mm: FloatArray) -> FloatArray:
        inverse = np.linalg.inv(self._structure.grid_mm)
        result: FloatArray = points_mm @ inverse[:3, :3].T + inverse[:3, 3]
        return result

    def _of_cells(self, cells: list[int]) -> FloatArray:
        numbers = np.concatenate([np.arange(self.first[c], self.first[c + 1]) for c in cells])
        result: FloatArray = self.triangles[numbers]
        return result


def _shape(structure: Structure) -> tuple[int, ...]:
    return tuple(size + 2 for size in structure.mask.shape)


def _segments(inside: NDArray[np.bool_]) -> tuple[FloatArray, Indices]:
    """Segments on the faces of cells, each for both cells of its face.

    Args:
        inside: shape (K, J, I), False all around.

    Returns:
        Ends (k, j, i), shape (m, 2, 3), and the cell (its first corner), shape (m, 3).
    """
    parts, cells = [], []
    for normal, a, b in ((0, 1, 2), (1, 0, 2), (2, 0, 1)):
        one, two, across = (np.eye(3, dtype=np.intp)[axis] for axis in (a, b, normal))
        corners = [
            inside[
                tuple(
                    slice(o, s - 1 + o if axis != normal else s)
                    for axis, (o, s) in enumerate(zip(offset, inside.shape, strict=True))
                )
            ]
            for offset in (0 * one, one, one + two, two)
        ]
        mixed = np.argwhere(
            (corners[0] != corners[1]) | (corners[1] != corners[2]) | (corners[2] != corners[3])
        )
        held = np.stack([corner[tuple(mixed.T)] for corner in corners], axis=1)
        halves = 0.5 * np.array([one, 2 * one + two, one + 2 * two, two])  # of its four edges
        for first, second, chosen in _joined(held):
            ends = np.stack([mixed[chosen] + halves[first], mixed[chosen] + halves[second]], axis=1)
            parts += [ends, ends]
            cells += [mixed[chosen], mixed[chosen] - across]
    return np.concatenate(parts), np.concatenate(cells)


def _joined(held: NDArray[np.bool_]) -> list[tuple[int, int, NDArray[np.bool_]]]:
    """Return which two edges of a face a segment joins, and in which faces.

    Edge e lies between corners e and e + 1. A corner that differs from both its neighbours is cut
    off by the edges on either side; two corners against two others by opposite edges.
    """
    before, after, far = (np.roll(held, shift, axis=1) for shift in (1, -1, 2))
    alone = (held != before) & (held != after)
    diagonal = alone & (held == far)  # then the outside corners are cut off
    cut = (alone & ~diagonal) | (diagonal & ~held)
    pairs = [((corner - 1) % 4, corner, cut[:, corner]) for corner in range(4)]
    split = (held[:, 0] != held[:, 1]) & (held[:, 2] != held[:, 3]) & ~alone.any(axis=1)
    other = (held[:, 1] != held[:, 2]) & (held[:, 3] != held[:, 0]) & ~alone.any(axis=1)
    return [*pairs, (0, 2, split), (1, 3, other)]


def _to_triangles(point: FloatArray, triangles: FloatArray) -> float:
    """Distance of a point from the nearest of some triangles, shape (m, 3, 3)."""
    a, b, c = (triangles[:, corner] for corner in range(3))
    edges = [_to_segments(point, *ends) for ends in ((a, b), (b, c), (c, a))]
    nearest = float(np.min(edges))
    normal = crosses(b - a, c - a)
    length = np.linalg.norm(normal, axis=1)
    real = length > 1e-12  # what is no triangle is its edges
    normal = normal / np.where(real, length, 1.0)[:, None]
    height = ((point - a) * normal).sum(axis=1)
    foot = point - height[:, None] * normal
    over = real
    for start, end in ((a, b), (b, c), (c, a)):
        over = over & ((crosses(end - start, foot - start) * normal).sum(axis=1) >= 0.0)
    return min(nearest, float(np.abs(height[over]).min())) if over.any() else nearest


def _to_segments(point: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    along = end - start
    length2 = np.maximum((along * along).sum(axis=1), 1e-24)
    share = np.clip(((point - start) * along).sum(axis=1) / length2, 0.0, 1.0)
    result: FloatArray = np.linalg.norm(point - start - share[:, None] * along, axis=1)
    return result


MARGIN_MM = 16.0
"""The grid reaches this far around the structure [mm]."""

FINEST_MM, COARSEST_MM = 0.5, 1.0
MOST_CELLS = 4_000_000
"""Edges of the cells [mm]; large structures get larger ones, so that none has more cells."""

SAMPLE_MM = 0.5
"""A path is looked at in steps of this [mm]."""


@dataclass(frozen=True, slots=True, eq=False)
class Nearest:
    """Where a line comes nearest to a structure.

    Attributes:
        distance_mm: there; negative where the line runs through it.
        at_mm: the point of the line, LPS [mm], shape (3,).
        depth_mm: its distance from the line's start [mm].
        through_mm: length of the line inside the structure [mm], exact to its boundary.
    """

    distance_mm: float
    at_mm: FloatArray
    depth_mm: float
    through_mm: float


REFINED = 20
"""Parts of a step in which the nearest place of a line is looked for."""


@dataclass(frozen=True, slots=True, eq=False)
class SignedDistance:
    """Distance field of one structure.

    Attributes:
        start_mm: LPS [mm] of the first cell's centre, shape (3,); the grid runs along L, P, S.
        step_mm: edge of a cell.
        values: shape (S, P, L) [mm], float32, read-only.
        accuracy_mm: bound of the error against the structure's voxels with their corners rounded
            off: half a diagonal of a cell, and half an edge of the CT's largest voxel edge where
            that rounding differs from the stairs. Of `at` alone.
        boundary: of the structure; its `accuracy_mm` is that of `along`.
    """

    start_mm: FloatArray
    step_mm: float
    values: NDArray[np.float32]
    accuracy_mm: float
    boundary: Boundary
    _surface: Any

    @classmethod
    def of(cls, structure: Structure, progress: Progress | None = None) -> SignedDistance:
        """Compute the field; up to a few seconds for a large structure.

        Raises:
            Cancelled: if `progress` was cancelled.
        """
        progress = progress or Progress()
        progress.report(0.0, sentence("distances of {name}", name=structure.name))
        low = structure.box_mm.min(axis=0) - MARGIN_MM
        extent = structure.box_mm.max(axis=0) + MARGIN_MM - low
        spacing = np.linalg.norm(structure.affine_mm[:3, :3], axis=0)
        step = float(np.clip(spacing.min(), FINEST_MM, COARSEST_MM))
        step = max(step, float((extent.prod() / MOST_CELLS) ** (1.0 / 3.0)))
        inside = _resampled(structure, low, step, np.ceil(extent / step).astype(int) + 1)
        progress.report(0.3)
        values: Any = ndimage.distance_transform_edt(~inside, step).astype(np.float32)
        progress.report(0.6)
        values -= ndimage.distance_transform_edt(inside, step).astype(np.float32)
        values -= np.where(inside, -0.5 * step, 0.5 * step).astype(np.float32)
        progress.report(0.9)
        edge = np.argwhere(inside & ~ndimage.binary_erosion(inside))[:, ::-1] * step + low
        accuracy = 0.5 * (np.sqrt(3.0) * step + float(spacing.max()))
        boundary = Boundary.of(structure)
        return cls(low, step, read_only(values), accuracy, boundary, cKDTree(edge))

    def at(self, points_mm: ArrayLike) -> FloatArray:
        """Distances [mm] of patient points [mm], shape (n, 3) -> (n,)."""
        points = np.atleast_2d(np.asarray(points_mm, np.float64))
        cells = ((points - self.start_mm) / self.step_mm)[:, ::-1]
        result: FloatArray = ndimage.map_coordinates(
            self.values, cells.T, order=1, mode="nearest", output=np.float64
        )
        beyond = ((cells < 0.0) | (cells > np.array(self.values.shape) - 1.0)).any(axis=1)
        if beyond.any():
            result[beyond] = self._surface.query(points[beyond])[0] - 0.5 * self.step_mm
        return result

    def along(self, start_mm: ArrayLike, end_mm: ArrayLike, within_mm: float = np.inf) -> Nearest:
        """Return where a straight line comes nearest to the structure, or deepest into it.

        Args:
            start_mm: of the line, LPS [mm], shape (3,).
            end_mm: of the line.
            within_mm: a line that is surely further off is told the distance of the grid, which is
                quicker.
        """
        start, end = np.asarray(start_mm, np.float64), np.asarray(end_mm, np.float64)
        length = float(np.linalg.norm(end - start))
        shares = np.linspace(0.0, 1.0, max(2, int(np.ceil(length / SAMPLE_MM)) + 1))
        points = start + shares[:, None] * (end - start)
        spans = self.boundary.spans(start, end)
        through = float((spans[:, 1] - spans[:, 0]).sum()) * length
        least, most = self.boundary.bounds_mm(points)
        if least.min() > within_mm and not len(spans):
            best = int(np.argmin(most))
            return Nearest(
                float(self.at(points[best])[0]), points[best], float(shares[best]) * length, through
            )
        candidates = np.flatnonzero(least <= most.min())
        rough = shares[candidates[np.argmin(self.boundary.at(points[candidates]))]]
        step = shares[1] - shares[0]
        fine = np.clip(rough + step * np.linspace(-1.0, 1.0, 2 * REFINED + 1), 0.0, 1.0)
        fine = np.concatenate([fine, spans.mean(axis=1)])  # thinner than a step too
        distances = self.boundary.at(start + fine[:, None] * (end - start))
        nearest = int(np.argmin(distances))
        share = float(fine[nearest])
        return Nearest(
            float(distances[nearest]), start + share * (end - start), share * length, through
        )

    def nearer(self, start_mm: ArrayLike, end_mm: ArrayLike, than_mm: float) -> float | None:
        """Return how near a straight line comes [mm]; None where that is surely no nearer than so.

        Args:
            start_mm: of the line, LPS [mm], shape (3,).
            end_mm: of the line.
            than_mm: distance that is known already.
        """
        start, end = np.asarray(start_mm, np.float64), np.asarray(end_mm, np.float64)
        length = float(np.linalg.norm(end - start))
        shares = np.linspace(0.0, 1.0, max(2, int(np.ceil(length / SAMPLE_MM)) + 1))
        least, _ = self.boundary.bounds_mm(start + shares[:, None] * (end - start))
        # Between two samples the line may be nearer by half of their distance.
        if least.min() - 0.5 * length / (len(shares) - 1) >= than_mm:
            return None
        return self.along(start, end).distance_mm


def _resampled(structure: Structure, low: FloatArray, step: float, size: Any) -> Any:
    """Return which cells of a cubic grid along L, P, S lie inside, shape (S, P, L)."""
    to_mask = np.linalg.inv(structure.grid_mm)
    flip = np.eye(3)[::-1]
    matrix = flip @ (to_mask[:3, :3] * step) @ flip
    offset = (to_mask[:3, :3] @ low + to_mask[:3, 3])[::-1]
    share = ndimage.affine_transform(
        structure.mask, matrix, offset, tuple(size[::-1]), np.float32, 1, "grid-constant"
    )
    inside = share >= 0.5
    if not inside.any():  # thinner than a cell: the cells that hold its voxels' centres
        centres = np.argwhere(structure.mask)[:, ::-1] @ structure.grid_mm[:3, :3].T
        cells = np.floor((centres + structure.grid_mm[:3, 3] - low) / step + 0.5).astype(int)
        inside[tuple(cells[:, ::-1].T)] = True
    return inside
