"""How far points are from a structure: positive outside, negative inside.

Of many points at once: the structure is resampled to a cubic grid (its edge where its share of the
voxels passes one half) and the exact distances of its cells are computed (Maurer et al. 2003, in
scipy); beyond the grid the nearest of its surface cells counts. Of a line: exactly to the
structure's boundary, at whatever size.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from app.core.arrays import FloatArray, read_only
from app.core.progress import Progress
from app.imaging.structures.boundary import Boundary
from app.imaging.structures.structure import Structure

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
        through_mm: length of the line inside the structure [mm].
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
        progress.report(0.0, f"distances of {structure.name}")
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
        """Where a straight line comes nearest to the structure, or deepest into it.

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
        through = float(self.boundary.inside(points).mean()) * length
        least, most = self.boundary.bounds_mm(points)
        if least.min() > within_mm:
            best = int(np.argmin(most))
            return Nearest(float(self.at(points[best])[0]), points[best],
                           float(shares[best]) * length, through)  # fmt: skip
        candidates = np.flatnonzero(least <= most.min())
        rough = shares[candidates[np.argmin(self.boundary.at(points[candidates]))]]
        step = shares[1] - shares[0]
        fine = np.clip(rough + step * np.linspace(-1.0, 1.0, 2 * REFINED + 1), 0.0, 1.0)
        distances = self.boundary.at(start + fine[:, None] * (end - start))
        nearest = int(np.argmin(distances))
        share = float(fine[nearest])
        return Nearest(
            float(distances[nearest]), start + share * (end - start), share * length, through
        )


def _resampled(structure: Structure, low: FloatArray, step: float, size: Any) -> Any:
    """Which cells of a cubic grid along L, P, S lie inside, shape (S, P, L)."""
    to_mask = np.linalg.inv(structure.grid_mm)
    flip = np.eye(3)[::-1]
    matrix = flip @ (to_mask[:3, :3] * step) @ flip
    offset = (to_mask[:3, :3] @ low + to_mask[:3, 3])[::-1] + 1.0  # one layer around
    share = ndimage.affine_transform(
        structure.occupancy, matrix, offset, output_shape=tuple(size[::-1]), order=1
    )
    inside = share >= 0.5
    if not inside.any():  # thinner than a cell: the cells that hold its voxels' centres
        centres = np.argwhere(structure.mask)[:, ::-1] @ structure.grid_mm[:3, :3].T
        cells = np.floor((centres + structure.grid_mm[:3, 3] - low) / step + 0.5).astype(int)
        inside[tuple(cells[:, ::-1].T)] = True
    return inside
