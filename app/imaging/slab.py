"""Thick slices: mean, maximum or minimum of what lies within a slab about a plane, compiled.

A slab of thickness T is sampled at n places along its normal, T / n apart and half of that from its
faces, n being the smallest number for which they are no farther apart than the finest voxels. Only
samples in the volume count; a pixel without any gets the outside value.
"""

from enum import StrEnum
from math import ceil
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.imaging.oblique import OUTSIDE_HU, Plane, _outside, _trilinear_at, picture_of
from app.imaging.volume import Volume

THICKEST_MM: Final = 100.0
"""Thickest slab that is drawn; thicker ones are no slices any more."""


class Projection(StrEnum):
    """What a pixel of a slab shows of the values behind it."""

    MEAN = "mean"
    MIP = "mip"
    MINIP = "minip"


_CODES: Final = {Projection.MEAN: 0, Projection.MIP: 1, Projection.MINIP: 2}


def slab_samples(volume: Volume, thickness_mm: float) -> int:
    """Return how many samples along the normal a slab of this thickness takes.

    Raises:
        NumericalError: if the thickness is not above 0 and at most `THICKEST_MM`.
    """
    if not 0.0 < thickness_mm <= THICKEST_MM:
        raise NumericalError(
            sentence(
                "a slab of {thickness_mm} mm cannot be shown; it must be above 0 and at most "
                "{thickest_mm:g} mm",
                thickness_mm=thickness_mm,
                thickest_mm=THICKEST_MM,
            )
        )
    return max(1, ceil(thickness_mm / float(np.min(volume.spacing_mm)) - 1e-9))


def slab_image(
    volume: Volume,
    plane: Plane,
    thickness_mm: float,
    way: Projection = Projection.MEAN,
    outside_hu: float = OUTSIDE_HU,
    out: NDArray[np.float32] | None = None,
) -> NDArray[np.float32]:
    """Project a slab of any direction onto its middle plane, trilinear samples.

    Args:
        volume: the CT.
        plane: which pixels, in the middle of the slab.
        thickness_mm: of the slab, above 0, at most `THICKEST_MM`.
        way: mean, maximum or minimum.
        outside_hu: value of pixels without a sample in the volume.
        out: picture to write into, float32, shape (rows, columns); made if None.

    Returns:
        Hounsfield values, float32, shape (rows, columns).

    Raises:
        NumericalError: if the thickness is out of range, or `out` has another shape or type.
    """
    count = slab_samples(volume, thickness_mm)
    picture = picture_of(plane, out)
    normal = np.cross(plane.across_mm, plane.down_mm)
    step_mm = normal / np.linalg.norm(normal) * (thickness_mm / count)
    linear = volume.inverse_mm[:3, :3]
    start = volume.voxel(plane.corner_mm - 0.5 * (count - 1) * step_mm)
    hu = np.ascontiguousarray(volume.hu)  # as it is read: no copy
    _project(
        hu,
        start,
        linear @ plane.across_mm,
        linear @ plane.down_mm,
        linear @ step_mm,
        count,
        _CODES[Projection(way)],
        outside_hu,
        picture,
    )
    return picture


def slices_image(block: NDArray[Any], way: Projection) -> NDArray[Any]:
    """Project whole slices of a volume, shape (slices, rows, columns), onto one picture.

    Returns:
        The type of `block` for maximum and minimum, float32 for the mean; shape (rows, columns).
    """
    if way is Projection.MIP:
        return np.asarray(block.max(axis=0))
    if way is Projection.MINIP:
        return np.asarray(block.min(axis=0))
    wide = np.int32 if block.dtype.kind in "iu" else np.float32
    return (block.sum(axis=0, dtype=wide) / np.float32(len(block))).astype(np.float32, copy=False)


@njit
def _project(
    hu: NDArray[Any],
    start: FloatArray,
    across: FloatArray,
    down: FloatArray,
    along: FloatArray,
    count: int,
    code: int,
    outside: float,
    out: NDArray[np.float32],
) -> None:
    size_k, size_j, size_i = hu.shape
    flat, slab = hu.ravel(), size_i * size_j
    first = np.float32(0.0 if code == 0 else (-1e30 if code == 1 else 1e30))
    hits = np.empty(out.shape[1], np.int32)
    for row in range(out.shape[0]):
        hits[:] = 0
        out[row, :] = first
        for sample in range(count):
            i0 = start[0] + row * down[0] + sample * along[0]
            j0 = start[1] + row * down[1] + sample * along[1]
            k0 = start[2] + row * down[2] + sample * along[2]
            for column in range(out.shape[1]):
                i, j, k = i0 + column * across[0], j0 + column * across[1], k0 + column * across[2]
                if 0.0 <= i < size_i - 1 and 0.0 <= j < size_j - 1 and 0.0 <= k < size_k - 1:
                    a, b, c = int(i), int(j), int(k)
                    value = _mixed(
                        flat,
                        c * slab + b * size_i + a,
                        size_i,
                        slab,
                        np.float32(i - a),
                        np.float32(j - b),
                        np.float32(k - c),
                    )
                elif _outside(i, j, k, hu):
                    continue
                else:
                    value = np.float32(_trilinear_at(hu, i, j, k))
                hits[column] += 1
                if code == 0:
                    out[row, column] += value
                elif code == 1:
                    out[row, column] = max(out[row, column], value)
                else:
                    out[row, column] = min(out[row, column], value)
        for column in range(out.shape[1]):
            if hits[column] == 0:
                out[row, column] = outside
            elif code == 0:
                out[row, column] /= np.float32(hits[column])


@njit
def _mixed(
    flat: NDArray[Any],
    at: int,
    row: int,
    slab: int,
    fi: np.float32,
    fj: np.float32,
    fk: np.float32,
) -> Any:
    """Trilinear value of the cell whose first voxel is `at`, all of it in the volume."""
    near = _edge(flat, at, fi)
    near += fj * (_edge(flat, at + row, fi) - near)
    far = _edge(flat, at + slab, fi)
    far += fj * (_edge(flat, at + slab + row, fi) - far)
    return near + fk * (far - near)


@njit
def _edge(flat: NDArray[Any], at: int, fraction: np.float32) -> Any:
    low = np.float32(flat[np.uint64(at)])
    return low + fraction * (np.float32(flat[np.uint64(at + 1)]) - low)
