"""Skin and bone of a volume as meshes small enough for any machine."""

from __future__ import annotations

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

SKIN_TRIANGLES, BONE_TRIANGLES = 70_000, 120_000
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
    progress.report(0.2, "skin")
    soft, affine = reduced(mask.astype(np.float32), volume, SKIN_STEP_MM)
    skin = isosurface(_closed(soft, 0.0), _shifted(affine), 0.5, SKIN_TRIANGLES)
    progress.report(0.5, "bone")
    hard, affine = reduced(np.where(mask, volume.hu, -1000), volume, BONE_STEP_MM)
    bone = isosurface(_closed(hard, -1000.0), _shifted(affine), BONE_HU, BONE_TRIANGLES)
    progress.report(0.9, "coarse versions")
    moving = coarser(skin, SKIN_MOVING), coarser(bone, BONE_MOVING)
    progress.report(1.0, "surfaces")
    return Surfaces(skin, moving[0], bone, moving[1])


def reduced(
    values: NDArray[Any], volume: Volume, step_mm: float
) -> tuple[NDArray[np.float32], FloatArray]:
    """Mean over blocks of about `step_mm`, and the affine of the blocks' centres.

    Args:
        values: shape (K, J, I) on the grid of `volume`.
        volume: gives spacing and affine.
        step_mm: wanted spacing.
    """
    factors = [max(1, min(ceil(step_mm / s - 0.5), n // 4 or 1))
               for s, n in zip(volume.spacing_mm, volume.size, strict=True)]  # fmt: skip
    i, j, k = factors
    blocks = values[: values.shape[0] // k * k, : values.shape[1] // j * j,
                    : values.shape[2] // i * i]  # fmt: skip
    depth, height, width = (n // f for n, f in zip(blocks.shape, (k, j, i), strict=True))
    small = blocks.reshape(depth, k, height, j, width, i).mean(axis=(1, 3, 5), dtype=np.float32)
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
