"""Skin and bone of a volume as meshes small enough for any machine."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import ceil
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.imaging.body import Body, body_mask
from app.imaging.volume import Volume
from app.views.scene.mesh import Mesh, coarser, isosurface

SKIN_TRIANGLES, BONE_TRIANGLES = 90_000, 110_000
"""Bounds of the still picture: at most 200 000 in all."""

SKIN_MOVING, BONE_MOVING = 15_000, 45_000
"""Bounds while the picture moves."""

SKIN_STEP_MM, BONE_STEP_MM = 3.5, 2.4
BONE_HU = 240.0
"""Above organs with contrast agent, below cancellous bone."""


@dataclass(frozen=True, slots=True)
class Surfaces:
    """Skin and bone, each for the still and for the moving picture; points in LPS [mm]."""

    skin: Mesh
    skin_moving: Mesh
    bone: Mesh
    bone_moving: Mesh

    @property
    def count(self) -> int:
        """Triangles of the still picture."""
        return self.skin.count + self.bone.count


def extract_surfaces(volume: Volume, body: Body, progress: Progress) -> Surfaces:
    """Make the surfaces of a volume; lasts a few seconds, meant for a thread of its own.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    progress.report(0.0, "body")
    mask = body_mask(volume, body)
    progress.report(0.1, "skin")
    soft, affine = reduced(lambda k: mask[k], volume, SKIN_STEP_MM, progress.part(0.1, 0.25))
    skin = isosurface(
        _closed(soft, 0.0), _shifted(affine), 0.5, SKIN_TRIANGLES, progress.part(0.25, 0.4)
    )
    progress.report(0.4, "bone")
    hard, affine = reduced(
        lambda k: np.where(mask[k], volume.hu[k], -1000), volume, BONE_STEP_MM,
        progress.part(0.4, 0.55),
    )  # fmt: skip
    bone = isosurface(
        _closed(hard, -1000.0), _shifted(affine), BONE_HU, BONE_TRIANGLES, progress.part(0.55, 0.9)
    )
    progress.report(0.9, "coarse versions")
    moving = (
        coarser(skin, SKIN_MOVING, progress.part(0.9, 0.95)),
        coarser(bone, BONE_MOVING, progress.part(0.95, 1.0)),
    )
    progress.report(1.0, "surfaces")
    return Surfaces(skin, moving[0], bone, moving[1])


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
        step_mm: wanted spacing.
        progress: reports, and may be cancelled.

    Raises:
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    factors = [max(1, min(ceil(step_mm / s - 0.5), n // 4 or 1))
               for s, n in zip(volume.spacing_mm, volume.size, strict=True)]  # fmt: skip
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
    return ndimage.gaussian_filter(small, 0.6), affine


def _closed(values: NDArray[np.float32], outside: float) -> NDArray[np.float32]:
    """One layer of `outside` around, so that surfaces cut by the scan's edge are closed."""
    return np.pad(values, 1, constant_values=outside)


def _shifted(affine: FloatArray) -> FloatArray:
    """Affine of a grid with one more layer around."""
    shifted = affine.copy()
    shifted[:3, 3] -= affine[:3, :3].sum(axis=1)
    return shifted
