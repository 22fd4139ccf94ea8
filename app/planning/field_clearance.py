"""How far straight paths stay from what no needle should meet: bone, lung, vessels, gut, heart.

By the labels of a tissue field, and how far within them their boundary lies: the distance is that
of the nearest voxel that should not be met, less its own from its boundary.
What holds the target is kept away from by none: there the needle has to go.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.core.arrays import FloatArray
from app.imaging.field.tissue_field import STEPS_PER_MM, FieldTissue, TissueField
from app.planning.tissues import avoided_codes


@dataclass(frozen=True, slots=True, eq=False)
class PathsClear:
    """Room of paths, arrays of shape (n,).

    Attributes:
        clear_mm: smallest distance of each from what it should not meet; infinite without any.
        step: number of the place on it where that is.
        code: of the tissue that is nearest there; -1 without any.
    """

    clear_mm: FloatArray
    step: NDArray[np.intp]
    code: NDArray[np.intp]


@dataclass(frozen=True, eq=False)
class ClearField:
    """Distances from what should not be met, within a box of a tissue field.

    Attributes:
        field: of the patient.
        first: voxel (k, j, i) in the field at which the box begins.
        labels: its codes, shape (nk, nj, ni).
        within_mm: distance of each voxel from its tissue's boundary, same shape.
        codes: of what should not be met.
    """

    field: TissueField
    first: NDArray[np.intp]
    labels: NDArray[np.uint8]
    within_mm: FloatArray
    codes: tuple[int, ...]

    @classmethod
    def about(
        cls, field: TissueField, target_mm: FloatArray, points_mm: FloatArray, room_mm: float
    ) -> ClearField:
        """Return the box about some places, and `room_mm` more on every side.

        Args:
            field: of the patient.
            target_mm: LPS, shape (3,), which says what has to be met.
            points_mm: LPS, shape (n, 3), one at least.
            room_mm: distances are known up to this.
        """
        codes = avoided_codes(field, target_mm)
        ijk = points_mm @ field.inverse_mm[:3, :3].T + field.inverse_mm[:3, 3]
        room = np.ceil(room_mm / field.spacing_mm)
        low, high = np.floor(ijk.min(axis=0) - room), np.ceil(ijk.max(axis=0) + room) + 1.0
        size = np.array(field.labels.shape)
        first = np.clip(low[::-1], 0, size - 1).astype(np.intp)
        last = np.clip(high[::-1], first + 1, size).astype(np.intp)
        box = tuple(slice(a, b) for a, b in zip(first.tolist(), last.tolist(), strict=True))
        within = field.distance[box] / STEPS_PER_MM
        return cls(field, first, field.labels[box], within, codes)

    @cached_property
    def _away(self) -> tuple[FloatArray, NDArray[np.intp]]:
        """Distance of each voxel from the nearest that should not be met [mm], and which it is."""
        free = ~np.isin(self.labels, self.codes)
        if free.all():
            return np.full(free.shape, np.inf), np.zeros((3, *free.shape), np.intp)
        found = ndimage.distance_transform_edt(
            free, sampling=self.field.spacing_mm[::-1], return_indices=True
        )
        k, j, i = nearest = np.asarray(found[1])
        return np.maximum(0.0, found[0] - self.within_mm[k, j, i]), nearest

    def of(self, points_mm: FloatArray) -> PathsClear:
        """Return the room of paths, given by places on each, LPS, shape (n, steps, 3)."""
        count, steps, _ = points_mm.shape
        inverse = self.field.inverse_mm
        ijk = np.rint(points_mm.reshape(-1, 3) @ inverse[:3, :3].T + inverse[:3, 3])
        place = np.clip(ijk[:, ::-1].astype(np.intp) - self.first, 0, self._last)
        k, j, i = place.T
        away, nearest = self._away
        all_mm = away[k, j, i].reshape(count, steps)
        step = all_mm.argmin(axis=1)
        rows = np.arange(count)
        at = rows * steps + step
        where = nearest[:, k[at], j[at], i[at]]
        clear = all_mm[rows, step]
        codes = self.labels[where[0], where[1], where[2]].astype(np.intp)
        return PathsClear(clear, np.asarray(step), np.where(np.isfinite(clear), codes, -1))

    @property
    def _last(self) -> NDArray[np.intp]:
        return np.array(self.labels.shape) - 1

    def tissue(self, code: int) -> FieldTissue:
        """Return the tissue of a code."""
        return self.field.tissues[code]
