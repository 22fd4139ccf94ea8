"""Points all over the skin with its outward direction: where a needle might enter."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.body import SKIN_HU, Body
from app.imaging.errors import InvalidEntryError
from app.imaging.interpolation import interpolate

SPACING_MM = 4.0
"""Usual distance between neighbouring points: `acus study planning_budget`."""

REFINE_MM, STEP_MM = 6.0, 0.5
"""Skin is looked for this far to both sides of its coarse cell, in such steps."""

_SMOOTH_CELLS = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class SkinPatch:
    """Points on the skin.

    Attributes:
        points_mm: LPS, shape (n, 3), read-only.
        outward: unit vectors out of the body, shape (n, 3), read-only.
        spacing_mm: distance between neighbours, about.
    """

    points_mm: FloatArray
    outward: FloatArray
    spacing_mm: float

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.points_mm)


def skin_points(
    body: Body, spacing_mm: float = SPACING_MM, progress: Progress | None = None
) -> SkinPatch:
    """Spread points evenly over the skin, to a fraction of a voxel; faces cut by the CT have none.

    Args:
        body: of the CT.
        spacing_mm: between neighbours, about.
        progress: reports, and may be cancelled.

    Raises:
        InvalidEntryError: if the volume holds no body.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    progress.report(0.0, sentence("looking for the skin"))
    coarse = body.coarse
    shell = coarse & ~ndimage.binary_erosion(coarse, border_value=1)
    cells = np.argwhere(shell)[:, ::-1]
    if not len(cells):
        raise InvalidEntryError(
            sentence("there is no body in this CT, so there is no skin"), np.inf
        )
    places = body.volume.lps_mm(cells * body.factors)
    _, first = np.unique(np.floor(places / spacing_mm).astype(np.int64), axis=0, return_index=True)
    cells, places = cells[np.sort(first)], places[np.sort(first)]
    progress.report(0.3)
    outward = _outward(body, cells)
    progress.report(0.6)
    points, found = _refined(body, places, outward)
    keep = found & np.isfinite(outward).all(axis=1)
    progress.report(1.0, sentence("skin found"))
    return SkinPatch(read_only(points[keep]), read_only(outward[keep]), spacing_mm)


def _outward(body: Body, cells: np.ndarray[tuple[int, ...], np.dtype[np.int64]]) -> FloatArray:
    """Out of the body at coarse cells, unit vectors; NaN where there is no direction."""
    soft = ndimage.gaussian_filter(body.coarse.astype(np.float32), _SMOOTH_CELLS, mode="nearest")
    k, j, i = cells[:, 2], cells[:, 1], cells[:, 0]
    slopes = np.stack([np.gradient(soft, axis=axis)[k, j, i] for axis in (2, 1, 0)], axis=1)
    # a gradient of index coordinates becomes one of places by the inverse transposed
    linear = body.volume.affine_mm[:3, :3] * body.factors
    out: FloatArray = -slopes @ np.linalg.inv(linear)
    length = np.linalg.norm(out, axis=1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(length > 1e-9, out / length, np.nan)


def _refined(
    body: Body, places: FloatArray, outward: FloatArray
) -> tuple[FloatArray, np.ndarray[tuple[int, ...], np.dtype[np.bool_]]]:
    """Skin on the normal through each place, nearest to it, and where there is one."""
    offsets = np.arange(REFINE_MM, -REFINE_MM - STEP_MM, -STEP_MM)  # from outside inwards
    normals = np.nan_to_num(outward)
    samples = places[:, None, :] + offsets[None, :, None] * normals[:, None, :]
    values = interpolate(body.volume.hu, body.volume.voxel(samples.reshape(-1, 3)))
    values = values.reshape(len(places), len(offsets)) - SKIN_HU
    rising = (values[:, :-1] <= 0.0) & (values[:, 1:] > 0.0)
    cost = np.where(rising, np.abs(offsets[:-1]), np.inf)
    best = np.argmin(cost, axis=1)
    rows = np.arange(len(places))
    found = np.isfinite(cost[rows, best])
    low, high = values[rows, best], values[rows, best + 1]
    share = np.where(found, -low / np.where(found, high - low, 1.0), 0.0)
    at = offsets[best] - share * STEP_MM
    return places + at[:, None] * normals, found
