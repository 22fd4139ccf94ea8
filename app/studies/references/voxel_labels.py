"""Labels of a CT on its own voxels, looked up by the nearest: what a field of the CT is judged by.

Tissue is told apart by the field's own criteria on cubes as wide as the CT's pixels; each voxel of
the CT takes the label at its centre. So boundaries are steps of whole voxels: a reference without
a rule between voxels, and no finer than the CT.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.imaging.body import Body
from app.imaging.field.from_ct import field_of_ct
from app.imaging.field.grid import FieldGrid
from app.imaging.volume import Volume


class VoxelLabels:
    """Labels of the voxels about an entry.

    Args:
        volume: the CT.
        body: of it.
        entry_mm: LPS, shape (3,).
        reach_mm: how far from there voxels are labelled.
        progress: reports, and may be cancelled.
    """

    def __init__(
        self, volume: Volume, body: Body, entry_mm: FloatArray, reach_mm: float, progress: Progress
    ) -> None:
        self.spacing_mm = np.linalg.norm(volume.affine_mm[:3, :3], axis=0)
        cube = float(self.spacing_mm.min())
        axes = np.array(volume.direction)
        corners = np.array(list(np.ndindex(2, 2, 2))) * (np.array(volume.size) - 1)
        along = volume.lps_mm(corners) @ axes
        middle = entry_mm @ axes
        low = np.maximum(along.min(axis=0), middle - reach_mm)
        high = np.minimum(along.max(axis=0), middle + reach_mm)
        nx, ny, nz = (np.floor((high - low) / cube).astype(int) + 1).tolist()
        affine = np.eye(4)
        affine[:3, :3], affine[:3, 3] = axes * cube, axes @ low
        grid = FieldGrid((nz, ny, nx), affine, cube, None, 0.0)
        field = field_of_ct(volume, (), grid, progress, body)
        self.tissues = field.tissues
        self._inverse = np.linalg.inv(volume.affine_mm)
        first = np.ceil(self._voxels(affine[:3, 3][None])[0] - 1e-6).astype(int)
        opposite = affine[:3, 3] + axes @ ((np.array((nx, ny, nz)) - 1) * cube)
        ends = np.stack([first, np.floor(self._voxels(opposite[None])[0] + 1e-6).astype(int)])
        self._first, last = ends.min(axis=0), ends.max(axis=0)
        to = np.linalg.inv(affine) @ volume.affine_mm  # voxel of the CT -> cube
        picks = [
            np.clip(
                np.rint(to[a, 3] + to[a, a] * np.arange(self._first[a], last[a] + 1)), 0, n - 1
            ).astype(np.intp)
            for a, n in enumerate((nx, ny, nz))
        ]
        self._labels = field.labels[np.ix_(picks[2], picks[1], picks[0])]

    def _voxels(self, points: FloatArray) -> FloatArray:
        return np.asarray(points @ self._inverse[:3, :3].T + self._inverse[:3, 3])

    def codes_at(self, points_mm: ArrayLike) -> NDArray[np.intp]:
        """Return the codes of the nearest voxels, shape (n, 3) -> (n,); 0 beyond them."""
        points = np.asarray(points_mm, np.float64).reshape(-1, 3)
        at = np.rint(self._voxels(points)).astype(np.intp) - self._first
        size = np.array(self._labels.shape[::-1])
        inside = ((at >= 0) & (at < size)).all(axis=1)
        i, j, k = np.where(inside[:, None], at, 0).T
        return np.where(inside, self._labels[k, j, i], 0).astype(np.intp)
