"""The centre of a bright bead in a CT, finer than a voxel, from a click near it."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.imaging.errors import BeadError, OutsideImageError
from app.imaging.volume import Volume

LEAST_CONTRAST = 150.0
"""A bead is this much brighter than what surrounds it [HU]; soft tissue against air is no bead."""
_STEPS = 20
_CONVERGED = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Bead:
    """A bead as the CT shows it.

    Attributes:
        centre_mm: patient LPS, shape (3,).
        contrast: brightest voxel above the surroundings [HU].
        diameter_mm: of a ball with the volume at half the contrast; blur and metal widen it.
        moved_mm: from the click to the centre.
    """

    centre_mm: FloatArray
    contrast: float
    diameter_mm: float
    moved_mm: float


def find_bead(volume: Volume, near_mm: ArrayLike, diameter_mm: float) -> Bead:
    """Find the bead that was clicked: its intensity-weighted centroid above the surroundings.

    The brightest voxel within one and a half diameters of the click is the seed. Its connected
    part above half the contrast must have the size of the bead; then the centroid of what stands
    above the surroundings is taken in a ball round the centre until the centre stays. The ball
    holds the blur's tails, so that partial volume does not pull the centre to voxels.

    Args:
        volume: the CT.
        near_mm: the click, patient LPS [mm], shape (3,).
        diameter_mm: of the bead.

    Raises:
        OutsideImageError: if the click lies outside the CT.
        BeadError: if there is nothing bright, or what is bright is not a bead of that size, or it
            reaches the edge of the CT.
    """
    click = frozen(near_mm, (3,), "near_mm")
    if not volume.contains(click):
        raise OutsideImageError(f"the point {_text(click)} lies outside the CT: click a slice")
    search = 1.5 * diameter_mm + float(volume.spacing_mm.max())
    reach = 0.5 * diameter_mm + 1.5 * float(volume.spacing_mm.max())
    box = _Crop.around(volume, click, search + reach + 0.5 * diameter_mm)
    distance = np.linalg.norm(box.points - click, axis=-1)
    background = float(np.median(box.hu))
    near = np.where(distance <= search, box.hu, -np.inf)
    seed = np.unravel_index(int(np.argmax(near)), near.shape)
    contrast = float(box.hu[seed]) - background
    if contrast < LEAST_CONTRAST:
        raise BeadError(
            f"no bead within {search:.1f} mm of {_text(click)}: the brightest voxel is "
            f"{contrast:.0f} HU above its surroundings, {LEAST_CONTRAST:.0f} are needed"
        )
    diameter = _diameter(box, seed, background + 0.5 * contrast)
    _require_size(diameter, diameter_mm, float(volume.spacing_mm.max()), click)
    centre = _centroid(box, box.points[seed], background, reach)
    if box.clipped and not _inside(volume, centre, reach):
        raise BeadError(f"the bead at {_text(centre)} reaches the edge of the CT: use another one")
    return Bead(frozen(centre), contrast, diameter, float(np.linalg.norm(centre - click)))


@dataclass(frozen=True, slots=True, eq=False)
class _Crop:
    """Part of a volume: values (k, j, i), patient points (k, j, i, 3) [mm], volume of a voxel."""

    hu: FloatArray
    points: FloatArray
    voxel_mm3: float
    clipped: bool

    @classmethod
    def around(cls, volume: Volume, centre_mm: FloatArray, radius_mm: float) -> "_Crop":
        middle, half = volume.voxel(centre_mm), radius_mm * volume.voxels_per_mm
        wanted = np.floor(middle - half), np.ceil(middle + half) + 1
        low = np.maximum(wanted[0], 0).astype(int)
        high = np.minimum(wanted[1], volume.size).astype(int)
        i, j, k = (np.arange(low[a], high[a]) for a in range(3))
        hu: NDArray[Any] = volume.hu[low[2] : high[2], low[1] : high[1], low[0] : high[0]]
        grid = np.stack(np.meshgrid(k, j, i, indexing="ij")[::-1], axis=-1)
        clipped = bool((low > wanted[0]).any() or (high < wanted[1]).any())
        size = float(abs(np.linalg.det(volume.affine_mm[:3, :3])))
        return cls(hu.astype(np.float64), volume.lps_mm(grid), size, clipped)


def _diameter(box: _Crop, seed: tuple[Any, ...], level: float) -> float:
    """Diameter [mm] of a ball as large as the part above `level` that holds the seed."""
    from scipy.ndimage import label

    parts, _ = label(box.hu >= level)
    count = int(np.count_nonzero(parts == parts[seed]))
    return float((6.0 / np.pi * count * box.voxel_mm3) ** (1.0 / 3.0))


def _require_size(found: float, wanted: float, voxel: float, at: FloatArray) -> None:
    largest = 1.6 * wanted + voxel
    if found > largest:
        raise BeadError(
            f"what is bright at {_text(at)} is {found:.1f} mm across, a bead is {wanted:.1f} mm "
            f"(at most {largest:.1f} mm in this CT): bone, or two beads; click on a bead"
        )


def _centroid(box: _Crop, start: FloatArray, background: float, reach: float) -> FloatArray:
    centre = start
    for _ in range(_STEPS):
        weight = np.where(np.linalg.norm(box.points - centre, axis=-1) <= reach, box.hu, background)
        weight = np.maximum(weight - background, 0.0)
        following = np.tensordot(weight, box.points, axes=3) / weight.sum()
        moved = float(np.linalg.norm(following - centre))
        centre = following
        if moved < _CONVERGED:
            break
    return centre


def _inside(volume: Volume, centre: FloatArray, reach: float) -> bool:
    corners = volume.voxel(centre), reach * volume.voxels_per_mm
    low, high = corners[0] - corners[1], corners[0] + corners[1]
    return bool((low >= -0.5).all() and (high <= np.array(volume.size) - 0.5).all())


def _text(point_mm: FloatArray) -> str:
    return "(" + ", ".join(f"{value:.1f}" for value in point_mm) + ") mm"
