"""Bone of a CT, its holes filled, and what is as bright without being bone: contrast in vessels."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.imaging.field.morphology import (
    Mask,
    closed,
    counts_by,
    filled,
    pieces,
    pooled,
    shrunk,
    spread,
)

BONE_HU: Final = 250.0
CORTEX_HU: Final = 500.0
"""A piece of bone has voxels above this; contrast in vessels seldom has."""

_LEAST_ML = 0.1  # a brighter piece that is smaller is a speck
_MARROW_HU = 80.0  # the canal of the spine is darker, marrow seldom
_COARSE_MM = 2.0
_BRIGHT_SHARE = 0.02  # of a bone's voxels that are as bright as cortex
_LONG = 1.8  # a vessel is so many times as long as wide


@dataclass(frozen=True, slots=True, eq=False)
class Bones:
    """Masks of one grid.

    Attributes:
        bone: with its marrow.
        contrast: bright, long, brightest in the middle, nowhere as bright as cortex.
        unsure: the same, but not long.
    """

    bone: Mask
    contrast: Mask
    unsure: Mask


def find_bones(hu: NDArray[np.float32], inner: Mask, spacing_mm: float, axis: int) -> Bones:
    """Find bone and contrast.

    Args:
        hu: Hounsfield values, shape (nz, ny, nx).
        inner: the body without its skin.
        spacing_mm: between voxels.
        axis: array axis along the patient.
    """
    factor = max(1, round(_COARSE_MM / spacing_mm))
    bright = inner & (hu > BONE_HU)
    if not bright.any():
        empty = np.zeros_like(bright)
        return Bones(empty, empty, empty)
    numbers, count = pieces(pooled(bright, factor))
    where = np.flatnonzero(bright)
    k, j, i = np.unravel_index(where, hu.shape)
    piece = numbers[k // factor, j // factor, i // factor]
    values = hu.ravel()[where]
    size = np.bincount(piece, minlength=count + 1)
    least = _LEAST_ML * 1000.0 / spacing_mm**3
    cortex = np.bincount(piece, values > CORTEX_HU, minlength=count + 1)
    is_bone = (size >= least) & (cortex >= _BRIGHT_SHARE * size)
    others = np.flatnonzero((size >= least) & ~is_bone)
    contrast, unsure = np.zeros(count + 1, bool), np.zeros(count + 1, bool)
    core = shrunk(bright, max(1, round(1.0 / spacing_mm))).ravel()[where]
    for number in others.tolist():
        mine = piece == number
        if not _brightest_within(values[mine], core[mine]):
            is_bone[number] = True
        elif _long(np.stack([k[mine], j[mine], i[mine]], axis=1)):
            contrast[number] = True
        else:
            unsure[number] = True
    masks: list[Mask] = []
    for chosen in (is_bone, contrast, unsure):
        mask = np.zeros(hu.size, bool)
        mask[where[chosen[piece]]] = True
        masks.append(mask.reshape(hu.shape))
    bone, *bright_others = masks
    whole = _with_marrow(bone, hu, inner, spacing_mm, factor, axis)
    return Bones(whole & ~bright_others[0] & ~bright_others[1], *bright_others)


def _brightest_within(values: NDArray[Any], core: NDArray[Any]) -> bool:
    """Return whether a piece is brighter in its middle than at its rim, as blood is."""
    if core.sum() < 8 or core.all():
        return False
    return float(values[core].mean()) > float(values[~core].mean())


def _long(places: NDArray[Any]) -> bool:
    """Return whether voxels, shape (n, 3), lie along a line more than around a point."""
    if len(places) < 3:
        return False
    spread_of = np.linalg.eigvalsh(np.cov(places.T))
    return bool(spread_of[2] > _LONG**2 * max(spread_of[1], 0.25))


def _with_marrow(
    bone: Mask, hu: NDArray[np.float32], inner: Mask, spacing_mm: float, factor: int, axis: int
) -> Mask:
    """Fill what bone encloses in planes across the patient, but for the canal of the spine."""
    coarse = pooled(bone, factor)
    whole = filled(closed(coarse, 2), axis)
    mean = pooled(hu, factor, np.add) / pooled(np.ones(hu.shape, np.float32), factor, np.add)
    holes = whole & ~coarse
    wide = ndimage.binary_opening(holes, iterations=2) & (mean < _MARROW_HU)
    dark, _ = pieces(holes & (mean < _MARROW_HU))
    numbers = np.unique(dark[wide])
    whole &= ~np.isin(dark, numbers[numbers > 0])
    inside = spread(shrunk(whole, 1), factor, hu.shape)
    result = bone | (inside & inner)
    steps = max(1, round(1.5 / spacing_mm))
    result |= closed(result, steps) & inner & (hu > -100.0)
    parts, count = pieces(pooled(result, factor))
    keep = counts_by(parts, count) > 1
    keep[0] = False
    return result & spread(keep[parts], factor, hu.shape)
