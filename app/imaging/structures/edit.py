"""Marking structures by hand: a threshold, growing from a point, and a round brush."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from app.core.messages import sentence
from app.imaging.structures.errors import StructureError
from app.imaging.structures.structure import Index, Mask, Structure, cropped
from app.imaging.volume import Volume

GROW_MM = 60.0
"""Growing goes no further than this from its point."""


def threshold(
    volume: Volume, low: float, high: float, within: Mask | None = None
) -> tuple[Mask, Index]:
    """Box and corner of all voxels from `low` to `high` HU.

    Args:
        volume: the CT.
        low: lower limit [HU], included.
        high: upper limit [HU], included.
        within: only these voxels, shape (K, J, I), such as the body's.

    Raises:
        StructureError: if no voxel is.
    """
    mask = (volume.hu >= low) & (volume.hu <= high)
    if within is not None:
        mask &= within
    if not mask.any():
        raise StructureError(
            sentence("no voxel has {low:g} to {high:g} HU: widen the threshold", low=low, high=high)
        )
    return cropped(mask)


def grown(
    volume: Volume, seed_mm: ArrayLike, low: float, high: float, reach_mm: float = GROW_MM
) -> tuple[Mask, Index]:
    """Box and corner of the voxels that hang together with a point, all from `low` to `high` HU.

    Neighbours share a face. What narrow bridges (one voxel) connect grows too: set the limits so
    that the structure is apart, or erase with the brush.

    Args:
        volume: the CT.
        seed_mm: the point, LPS, shape (3,).
        low: lower limit [HU], included.
        high: upper limit [HU], included.
        reach_mm: it grows no further than this from the point.

    Raises:
        StructureError: if the point lies outside the CT or its own value outside the limits.
    """
    span, corner = _span(volume, seed_mm, reach_mm)
    hu = volume.hu[span]
    at = np.rint(volume.voxel(seed_mm)).astype(int) - corner
    inside = np.asarray(volume.contains(seed_mm))
    if not inside:
        raise StructureError(sentence("the point to grow from lies outside the CT"))
    own = float(hu[at[2], at[1], at[0]])
    if not low <= own <= high:
        raise StructureError(
            sentence(
                "the point has {own:.0f} HU, which is not from {low:g} to {high:g}: click inside "
                "the structure, or move the limits",
                own=own,
                low=low,
                high=high,
            )
        )
    within = (hu >= low) & (hu <= high) & _ball(volume, seed_mm, reach_mm, span, corner)
    labels, _ = ndimage.label(within)
    mask, offset = cropped(labels == labels[at[2], at[1], at[0]])
    return mask, _moved(corner, offset)


def brushed(
    structure: Structure | None,
    volume: Volume,
    centres_mm: ArrayLike,
    radius_mm: float,
    add: bool,
    limits: tuple[float, float] | None = None,
) -> tuple[Mask, Index] | None:
    """Box and corner of a structure after dabs of a round brush; None if nothing is left.

    Args:
        structure: so far; None for nothing.
        volume: the CT.
        centres_mm: of the balls, LPS, shape (n, 3) or (3,) for one.
        radius_mm: of the balls.
        add: whether their voxels are added or taken away.
        limits: only voxels of these HU, both included, are touched.
    """
    stroke = _stroke(volume, np.reshape(centres_mm, (-1, 3)), radius_mm, limits)
    if stroke is None:
        return None if structure is None else (structure.mask, structure.corner)
    dabs, corner = stroke
    if structure is None:
        return stroke if add else None
    return _joined(structure, dabs, corner) if add else _erased(structure, dabs, corner)


def _joined(structure: Structure, dabs: Mask, corner: Index) -> tuple[Mask, Index]:
    """Box and corner with the dabs; both boxes fit closely, and so does theirs."""
    low, high = _united(structure, corner, dabs.shape)
    mask = np.zeros(tuple((np.array(high) - low)[::-1]), bool)
    mask[_slices(structure.corner, structure.mask.shape, low)] = structure.mask
    mask[_slices(corner, dabs.shape, low)] |= dabs
    return mask, low


def _erased(structure: Structure, dabs: Mask, corner: Index) -> tuple[Mask, Index] | None:
    """Box and corner without the dabs; None if nothing is left."""
    shape = np.array(structure.mask.shape)
    start = np.subtract(corner, structure.corner)[::-1]
    first, last = np.clip(start, 0, shape), np.clip(start + dabs.shape, 0, shape)
    if (first >= last).any():
        return structure.mask, structure.corner
    mask = structure.mask.copy()
    part = mask[tuple(map(slice, first, last))]
    part &= ~dabs[tuple(map(slice, first - start, last - start))]
    if (first > 0).all() and (last < shape).all():  # the outermost voxels are still there
        return mask, structure.corner
    if not mask.any():
        return None
    box, offset = cropped(mask)
    return box, _moved(structure.corner, offset)


def _stroke(
    volume: Volume,
    centres_mm: NDArray[np.float64],
    radius_mm: float,
    limits: tuple[float, float] | None,
) -> tuple[Mask, Index] | None:
    """Box and corner of all dabs together; None where there is no voxel."""
    dabs = [_span(volume, centre, radius_mm) for centre in centres_mm]
    whole = tuple(
        slice(min(one[0][axis].start for one in dabs), max(one[0][axis].stop for one in dabs))
        for axis in range(3)
    )
    k, j, i = (span.start for span in whole)
    mask = np.zeros([span.stop - span.start for span in whole], bool)
    for centre, (span, corner) in zip(centres_mm, dabs, strict=True):
        dab = _ball(volume, centre, radius_mm, span, corner)
        mask[_slices(corner, dab.shape, (i, j, k))] |= dab
    if limits is not None:
        mask &= (volume.hu[whole] >= limits[0]) & (volume.hu[whole] <= limits[1])
    if not mask.any():
        return None
    box, offset = cropped(mask)
    return box, _moved((i, j, k), offset)


def _span(
    volume: Volume, centre_mm: ArrayLike, radius_mm: float
) -> tuple[tuple[slice, slice, slice], Index]:
    """Slices (k, j, i) of the box around a ball, and its corner (i, j, k)."""
    reach = radius_mm * np.linalg.norm(volume.inverse_mm[:3, :3], axis=1)
    centre = volume.voxel(centre_mm)
    low = np.clip(np.floor(centre - reach), 0, np.array(volume.size) - 1).astype(int)
    high = np.clip(np.ceil(centre + reach) + 1, low + 1, volume.size).astype(int)
    i, j, k = (slice(int(a), int(b)) for a, b in zip(low, high, strict=True))
    return (k, j, i), (i.start, j.start, k.start)


def _ball(
    volume: Volume,
    centre_mm: ArrayLike,
    radius_mm: float,
    span: tuple[slice, slice, slice],
    corner: Index,
) -> NDArray[np.bool_]:
    axes = [np.arange(s.start, s.stop) for s in span]
    k, j, i = np.meshgrid(*axes, indexing="ij", sparse=True)
    away = np.asarray(centre_mm, np.float64)
    linear, origin = volume.affine_mm[:3, :3], volume.affine_mm[:3, 3]
    square = sum(
        (linear[a, 0] * i + linear[a, 1] * j + linear[a, 2] * k + origin[a] - away[a]) ** 2
        for a in range(3)
    )
    inside: Mask = np.asarray(square <= radius_mm**2)
    return inside


def _united(
    structure: Structure, corner: Index, shape: Sequence[int]
) -> tuple[Index, tuple[int, int, int]]:
    ends = [
        (min(a, b), max(a + n, b + m))
        for a, n, b, m in zip(
            structure.corner, structure.mask.shape[::-1], corner, shape[::-1], strict=True
        )
    ]
    (i, x), (j, y), (k, z) = ends
    return (i, j, k), (x, y, z)


def _slices(corner: Index, shape: Sequence[int], low: Index) -> tuple[slice, ...]:
    return tuple(
        slice(c - o, c - o + n) for c, o, n in zip(corner[::-1], low[::-1], shape, strict=True)
    )


def _moved(corner: Index, offset: Index) -> Index:
    i, j, k = (a + b for a, b in zip(corner, offset, strict=True))
    return i, j, k
