"""Skin, bone and organs of a volume as closed, smooth meshes small enough for any machine."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.ndimage import gaussian_filter

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.body import Body, Mask, body_mask
from app.imaging.phantom.anatomy import organ_fields
from app.imaging.volume import Volume
from app.views.scene.mesh import Mesh, coarser, isosurface

SKIN_TRIANGLES, BONE_TRIANGLES = 90_000, 110_000
"""Bounds of the still picture: at most 200 000 in all."""

SKIN_MOVING, BONE_MOVING = 15_000, 45_000
"""Bounds while the picture moves."""

ORGAN_TRIANGLES, ORGAN_MOVING = 14_000, 2_500
"""Bounds of one organ, still and moving; the lungs have twice as many."""

SKIN_STEP_MM, BONE_STEP_MM, LUNG_STEP_MM, ORGAN_STEP_MM = 3.5, 2.4, 3.5, 3.0
BONE_HU = 240.0
"""Above organs with contrast agent, below cancellous bone."""

MOST_CELLS = 3_500_000
"""Of a grid that a surface is taken from: a taller patient has larger cells, not more of them, for
its surfaces have no more triangles either."""

SKIN_SIGMA, BONE_SIGMA = 1.0, 0.7
"""Blur of the grids that surfaces are taken from [cells]."""

AIR = 500.0
"""How far beyond the skin's level values are told apart [HU]."""

LUNG_HU, GAS_HU, LUNG_ML = -400.0, -960.0, 60.0
"""What is darker is air; what is darker still on the mean is gas of the gut; the smallest lung."""

MARROW_MM2, MARROW_HU = 1500.0, BONE_HU + 160.0
"""What bone encloses in a slice is marrow up to this area; the value that it gets."""


@dataclass(frozen=True, slots=True)
class Surfaces:
    """Skin, bone and organs, each for the still and for the moving picture; points in LPS [mm].

    Organs stand under their names: of every CT the lungs, of the built-in patient all it has.
    """

    skin: Mesh
    skin_moving: Mesh
    bone: Mesh
    bone_moving: Mesh
    organs: Mapping[str, tuple[Mesh, Mesh]] = field(default_factory=dict)

    @property
    def count(self) -> int:
        """Triangles of skin and bone in the still picture."""
        return self.skin.count + self.bone.count


def extract_surfaces(
    volume: Volume, body: Body, progress: Progress, phantom_seed: int | None = None
) -> Surfaces:
    """Make the surfaces of a volume; lasts a few seconds, meant for a thread of its own.

    Args:
        volume: the CT.
        body: of it.
        progress: reports, and may be cancelled.
        phantom_seed: of the built-in patient, whose organs are known; None for others.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    progress.report(0.0, sentence("body"))
    mask = body_mask(volume, body)
    progress.report(0.1, sentence("skin"))
    level = body.skin_level
    soft, affine = reduced(
        lambda k: _air_to_tissue(volume.hu[k], mask[k], level),
        volume,
        SKIN_STEP_MM,
        progress.part(0.1, 0.2),
    )
    soft = _blurred(_closed(soft, level - AIR), SKIN_SIGMA)
    skin = isosurface(soft, _shifted(affine), level, SKIN_TRIANGLES, progress.part(0.2, 0.3))
    progress.report(0.3, sentence("bone"))
    bone = bone_surface(volume, mask, progress.part(0.3, 0.8))
    progress.report(0.8, sentence("organs"))
    organs = _organs(volume, mask, phantom_seed, progress.part(0.8, 0.95))
    progress.report(0.95, sentence("coarse versions"))
    moving = (
        coarser(skin, SKIN_MOVING, progress.part(0.95, 0.97)),
        coarser(bone, BONE_MOVING, progress.part(0.97, 1.0)),
    )
    progress.report(1.0, sentence("surfaces"))
    return Surfaces(skin, moving[0], bone, moving[1], organs)


def bone_surface(
    volume: Volume, mask: Mask, progress: Progress, step_mm: float = BONE_STEP_MM
) -> Mesh:
    """Surface of the bones in the body, closed, its marrow filled; by `acus study surfaces`.

    Args:
        volume: the CT.
        mask: the body in it.
        progress: reports, and may be cancelled.
        step_mm: of the grid that it is taken from.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    hard, affine = reduced(
        lambda k: np.where(mask[k], volume.hu[k], -1000), volume, step_mm, progress.part(0.0, 0.3)
    )
    hard = _blurred(without_marrow(_closed(hard, -1000.0), affine), BONE_SIGMA)
    return isosurface(hard, _shifted(affine), BONE_HU, BONE_TRIANGLES, progress.part(0.4, 1.0))


def _organs(
    volume: Volume, mask: Mask, phantom_seed: int | None, progress: Progress
) -> dict[str, tuple[Mesh, Mesh]]:
    """Fine and coarse surfaces of what is known of organs, by name."""
    fields = {}
    if volume.unit == "HU":
        fields["lungs"] = _lungs(volume, mask, progress.part(0.0, 0.4))
    if phantom_seed is not None:
        fields |= organ_fields(phantom_seed, ORGAN_STEP_MM)
    found = {}
    for number, (name, (values, affine)) in enumerate(fields.items()):
        share = 2 if name == "lungs" else 1
        part = progress.part(
            0.4 + 0.6 * number / len(fields), 0.4 + 0.6 * (number + 1) / len(fields)
        )
        if values.max() > 0.0:
            mesh = isosurface(values, affine, 0.0, share * ORGAN_TRIANGLES, part)
            found[name] = mesh, coarser(mesh, share * ORGAN_MOVING)
    return found


def _lungs(
    volume: Volume, mask: Mask, progress: Progress
) -> tuple[NDArray[np.float32], FloatArray]:
    """Field above 0 in the lungs, vessels and airways filled; and its affine."""
    air, affine = reduced(
        lambda k: np.where(mask[k], np.minimum(volume.hu[k], 0), 0), volume, LUNG_STEP_MM, progress
    )
    pieces, count = ndimage.label(air < LUNG_HU)
    numbers = np.arange(count + 1)
    cell_ml = abs(float(np.linalg.det(affine[:3, :3]))) / 1000.0
    is_lung = np.bincount(pieces.ravel(), minlength=count + 1) * cell_ml >= LUNG_ML
    is_lung &= np.nan_to_num(ndimage.mean(air, pieces, numbers), nan=GAS_HU) > GAS_HU
    is_lung[0] = False
    filled = np.pad(is_lung[pieces], 3)
    filled = _eroded(_eroded(_dilated(_dilated(filled))))[2:-2, 2:-2, 2:-2]
    values = gaussian_filter(filled.astype(np.float32), 1.0) - np.float32(0.5)
    return values, _shifted(affine)


def reduced(
    slab: Callable[[slice], NDArray[Any]],
    volume: Volume,
    step_mm: float,
    progress: Progress | None = None,
) -> tuple[NDArray[np.float32], FloatArray]:
    """Mean over blocks of about `step_mm`, and the affine of the blocks' centres.

    Few slices are held at a time, so that no second array of the volume's size is filled.

    Args:
        slab: values of some slices, shape (n, J, I), on the grid of `volume`.
        volume: gives size, spacing and affine.
        step_mm: wanted spacing; larger where it would make more than `MOST_CELLS`.
        progress: reports, and may be cancelled.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    extent_mm = np.asarray(volume.spacing_mm) * volume.size
    step_mm = max(step_mm, float(extent_mm.prod() / MOST_CELLS) ** (1.0 / 3.0))
    factors = [
        max(1, min(ceil(step_mm / s - 0.5), n // 4 or 1))
        for s, n in zip(volume.spacing_mm, volume.size, strict=True)
    ]
    i, j, k = factors
    depth, height, width = (n // f for n, f in zip(volume.hu.shape, (k, j, i), strict=True))
    small = np.empty((depth, height, width), np.float32)
    for number in range(depth):
        progress.report(number / depth)
        values = slab(slice(number * k, number * k + k))[:, : height * j, : width * i]
        rows = values.sum(axis=0, dtype=np.int32 if values.dtype.kind in "ib" else np.float32)
        rows = rows.reshape(height, j, -1).sum(axis=1)
        small[number] = sum(rows[:, start::i] for start in range(i))
    small /= np.float32(i * j * k)
    affine = np.array(volume.affine_mm)
    affine[:3, 3] = volume.lps_mm((np.asarray(factors) - 1.0) / 2.0)
    affine[:3, :3] = affine[:3, :3] * factors
    return small, affine


def _air_to_tissue(hu: NDArray[Any], inside: Mask, level: float) -> NDArray[Any]:
    """Slices in which only the skin is an edge, exact to a fraction of a voxel.

    Inside the body no air is left, and outside it no table; between them stand the values of the
    CT, which know how much of a voxel is body.
    """
    values = np.clip(hu, level - AIR, level + AIR)
    tissue = hu > level
    values[inside & ~tissue] = level + AIR
    values[tissue & ~inside] = level - AIR
    return values


def without_marrow(values: NDArray[np.float32], affine: FloatArray) -> NDArray[np.float32]:
    """Fill what bone encloses, so that its surface is one from outside; changes `values`.

    Marrow is what is enclosed in at least two of the three directions of slices (a foramen is
    enclosed in one), and next to it the gaps of its shell that are up to two cells wide.

    Args:
        values: shape (K, J, I), bone above `BONE_HU`.
        affine: voxel (i, j, k) → LPS [mm], shape (4, 4).
    """
    solid = values > BONE_HU
    cell_mm = np.linalg.norm(affine[:3, :3], axis=0)[::-1]
    votes = np.zeros(values.shape, np.uint8)
    for axis in range(3):
        joined = ndimage.generate_binary_structure(3, 1)
        joined[(slice(None),) * axis + ([0, 2],)] = False  # neighbours within a slice only
        pieces, _ = ndimage.label(~solid, joined)
        small = np.bincount(pieces.ravel()) <= MARROW_MM2 * cell_mm[axis] / cell_mm.prod()
        small[0] = False  # bone itself
        for across in {0, 1, 2} - {axis}:  # what reaches the grid's edge is outside
            small[np.moveaxis(pieces, across, 0)[[0, -1]]] = False
        votes += small[pieces]
    marrow = votes >= 2
    marrow |= _dilated(_dilated(marrow)) & _eroded(_dilated(solid | marrow))
    for axis in range(3):  # the layer around stays outside
        np.moveaxis(marrow, axis, 0)[[0, -1]] = False
    np.copyto(values, np.float32(MARROW_HU), where=marrow & ~solid)
    return values


def _dilated(mask: Mask) -> Mask:
    """Grow by one cell to all 26 sides."""
    for axis in range(3):
        grown, along = mask.copy(), np.moveaxis(mask, axis, 0)
        view = np.moveaxis(grown, axis, 0)
        view[1:] |= along[:-1]
        view[:-1] |= along[1:]
        mask = grown
    return mask


def _eroded(mask: Mask) -> Mask:
    """Shrink by one cell from all 26 sides; the grid's edge is not one."""
    return ~_dilated(~mask)


def _closed(values: NDArray[np.float32], outside: float) -> NDArray[np.float32]:
    """One layer of `outside` around, so that surfaces cut by the scan's edge are closed."""
    return np.pad(values, 1, constant_values=outside)


def _blurred(values: NDArray[np.float32], sigma: float) -> NDArray[np.float32]:
    """Blur a closed grid [cells]; its outermost layer stays, so that it stays closed."""
    blurred: NDArray[np.float32] = gaussian_filter(values, sigma)
    for axis in range(3):
        np.moveaxis(blurred, axis, 0)[[0, -1]] = np.moveaxis(values, axis, 0)[[0, -1]]
    return blurred


def _shifted(affine: FloatArray) -> FloatArray:
    """Affine of a grid with one more layer around."""
    shifted = affine.copy()
    shifted[:3, 3] -= affine[:3, :3].sum(axis=1)
    return shifted
