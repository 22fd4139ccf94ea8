"""The grid of a field: evenly spaced cubes along a CT's own axes, over what a needle can reach."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.imaging.body import GRID_MM, Body
from app.imaging.field.errors import FieldError
from app.imaging.volume import Volume

SPACINGS_MM: Final = (0.5, 1.0, 2.0, 3.0)
"""Named choices of the distance between voxels [mm]."""

_AIR_MM: Final = 4.0  # of air around the body
_MARGIN_MM: Final = 3.0  # around the reach, so that its end is no end of a tissue


@dataclass(frozen=True, eq=False)
class FieldGrid:
    """Where the voxels of a field lie.

    Attributes:
        shape: (nz, ny, nx).
        affine_mm: voxel (i, j, k) -> LPS [mm], shape (4, 4); its axes are at right angles.
        spacing_mm: edge of a voxel.
        entry_mm: middle of what can be reached, LPS, shape (3,); None for all of the CT.
        reach_mm: from the entry.
    """

    shape: tuple[int, int, int]
    affine_mm: FloatArray
    spacing_mm: float
    entry_mm: FloatArray | None
    reach_mm: float

    @property
    def voxels(self) -> int:
        """Return their number."""
        return self.shape[0] * self.shape[1] * self.shape[2]

    def axes(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return the places along k, j and i in millimetres from the first voxel."""
        k, j, i = (np.arange(size, dtype=np.float64) * self.spacing_mm for size in self.shape)
        return k, j, i

    @cached_property
    def beyond_reach(self) -> NDArray[np.bool_] | None:
        """Voxels that lie further from the entry than the needle reaches; None without an entry."""
        if self.entry_mm is None:
            return None
        inverse = np.linalg.inv(self.affine_mm)
        middle = (inverse[:3, :3] @ self.entry_mm + inverse[:3, 3]) * self.spacing_mm
        k, j, i = (
            ((axis - middle[2 - number]) ** 2).astype(np.float32)
            for number, axis in enumerate(self.axes())
        )
        square = np.float32((self.reach_mm + _MARGIN_MM) ** 2)
        return k[:, None, None] + j[:, None] + i > square

    def from_volume(self, values: NDArray[Any], to_lps_mm: FloatArray) -> NDArray[np.float32]:
        """Values of another grid on this one, linear between its voxels, its edges carried on.

        Args:
            values: shape (K, J, I).
            to_lps_mm: voxel (i, j, k) of it -> LPS [mm].
        """
        to = np.linalg.inv(to_lps_mm) @ self.affine_mm  # of this grid -> of the other
        linear = to[:3, :3]
        straight = np.abs(linear - np.diag(np.diag(linear))).max() < 1e-9
        if not straight:  # a sheared CT, or a structure of another one
            flip = np.eye(3)[::-1]
            turned = ndimage.affine_transform(
                values, flip @ linear @ flip, to[:3, 3][::-1], self.shape, np.float32, 1, "nearest"
            )
            return np.asarray(turned, np.float32)
        places = [
            np.clip(to[a, 3] + linear[a, a] * np.arange(self.shape[2 - a]), 0, n - 1)
            for a, n in enumerate(values.shape[::-1])
        ]
        (i0, i1, u), (j0, j1, v), (k0, k1, w) = (
            _between(place, n) for place, n in zip(places, values.shape[::-1], strict=True)
        )
        result = np.empty(self.shape, np.float32)
        rows = slice(int(j0.min()), int(j1.max()) + 1)
        columns = slice(int(i0.min()), int(i1.max()) + 1)
        j0, j1, i0, i1 = j0 - rows.start, j1 - rows.start, i0 - columns.start, i1 - columns.start
        v = v[:, None]
        planes: dict[int, NDArray[np.float32]] = {}
        for k in range(self.shape[0]):
            needed = (int(k0[k]), int(k1[k]))
            planes = {n: plane for n, plane in planes.items() if n in needed}
            for n in needed:
                if n not in planes:
                    plane = values[n, rows, columns].astype(np.float32)
                    plane = plane[j0] * (1.0 - v) + plane[j1] * v
                    planes[n] = plane[:, i0] * (1.0 - u) + plane[:, i1] * u
            if w[k] == 0.0:
                result[k] = planes[needed[0]]
            else:
                np.multiply(planes[needed[0]], 1.0 - w[k], out=result[k])
                result[k] += w[k] * planes[needed[1]]
        return result


def _between(place: FloatArray, count: int) -> tuple[Any, Any, Any]:
    """Voxels before and behind places, and shares between them."""
    before = np.minimum(np.floor(place).astype(np.intp), max(count - 2, 0))
    behind = np.minimum(before + 1, count - 1)
    return before, behind, (place - before).astype(np.float32)


def grid_over(
    volume: Volume, body: Body, entry_mm: Any, reach_mm: float, spacing_mm: float
) -> tuple[FieldGrid, str]:
    """Return the grid over what a needle can reach in a CT, and a note where the CT ends before.

    Args:
        volume: the CT.
        body: of it; the air further off is left out.
        entry_mm: LPS, shape (3,); None for the whole CT.
        reach_mm: how far a needle comes from there.
        spacing_mm: one of `SPACINGS_MM`.

    Raises:
        FieldError: if the entry lies outside the CT, or a number is none that can be.
    """
    if spacing_mm not in SPACINGS_MM:
        named = ", ".join(f"{one:g}" for one in SPACINGS_MM)
        raise FieldError(
            sentence(
                "a field of {spacing_mm:g} mm: {named} mm can be chosen",
                spacing_mm=spacing_mm,
                named=named,
            )
        )
    if not 0.0 < reach_mm < 2000.0:
        raise FieldError(
            sentence(
                "a reach of {reach_mm:g} mm: more than 0 and less than 2000 mm are",
                reach_mm=reach_mm,
            )
        )
    axes = np.eye(3) if volume.is_sheared else np.array(volume.direction)
    corners = np.array(list(np.ndindex(2, 2, 2))) * _last(volume)
    whole = _ends(volume.lps_mm(corners) @ axes, 0.0)
    spans = [np.flatnonzero(body.coarse.any(axis=axes_of)) for axes_of in ((0, 1), (0, 2), (1, 2))]
    held = whole
    if all(span.size for span in spans):
        low_cell, size = np.array([[span[0], np.ptp(span)] for span in spans]).T
        cells = (low_cell + np.array(list(np.ndindex(2, 2, 2))) * size) * body.factors
        held = _ends(volume.lps_mm(cells) @ axes, _AIR_MM + GRID_MM)
    low, high = np.maximum(whole[0], held[0]), np.minimum(whole[1], held[1])
    note: str = ""
    entry = None
    if entry_mm is not None:
        entry = frozen(entry_mm, (3,), "entry")
        if not volume.contains(entry):
            raise FieldError(
                sentence(
                    "entry {entry_mm} mm lies outside the CT: move it",
                    entry_mm=entry.round(1).tolist(),
                )
            )
        middle = entry @ axes
        to_end = np.stack([middle - whole[0], whole[1] - middle])
        cut = np.stack([held[0] < whole[0], held[1] > whole[1]]) & (to_end < reach_mm)
        if cut.any():
            note = sentence(
                "the CT ends {to_end_mm:.0f} mm from the entry, within the body, and the "
                "needle reaches {reach_mm:.0f} mm: what lies beyond is unknown",
                to_end_mm=float(to_end[cut].min()),
                reach_mm=reach_mm,
            )
        reach = reach_mm + _MARGIN_MM
        low, high = np.maximum(low, middle - reach), np.minimum(high, middle + reach)
    counts = np.floor((high - low) / spacing_mm + 1e-6).astype(int) + 1
    if counts.min() < 2:
        raise FieldError(
            sentence(
                "the CT is {thickness_mm:.1f} mm thick: no field of {spacing_mm:g} mm fits",
                thickness_mm=(high - low).min(),
                spacing_mm=spacing_mm,
            )
        )
    affine = np.eye(4)
    affine[:3, :3] = axes * spacing_mm
    affine[:3, 3] = axes @ (low + 0.5 * ((high - low) - (counts - 1) * spacing_mm))
    nx, ny, nz = counts.tolist()
    return FieldGrid((nz, ny, nx), frozen(affine), spacing_mm, entry, reach_mm), note


def _ends(along: FloatArray, around_mm: float) -> tuple[FloatArray, FloatArray]:
    """Least and largest of places along axes, shape (n, 3) -> (3,) twice, with room around."""
    return along.min(axis=0) - around_mm, along.max(axis=0) + around_mm


def _last(volume: Volume) -> NDArray[np.intp]:
    return np.array(volume.size, np.intp) - 1
