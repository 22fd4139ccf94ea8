"""A digest of a volume that other programs can compute too: of its values, and of its geometry."""

import hashlib
from dataclasses import dataclass

import numpy as np

from app.imaging.volume import Volume


@dataclass(frozen=True, slots=True)
class VolumeDigest:
    """What a volume is, by its content.

    Attributes:
        values: SHA-256 of the values as they are told by `kind`, k slowest, i fastest.
        kind: `<i2`, or `<f4` where a value is no whole number or does not fit 16 bits.
        size: columns, rows, slices (I, J, K).
        affine_mm: voxel (i, j, k) -> LPS [mm], row by row, 16 numbers.
    """

    values: str
    kind: str
    size: tuple[int, int, int]
    affine_mm: tuple[float, ...]


def digest_of(volume: Volume) -> VolumeDigest:
    """Return the digest of a volume."""
    kind = "<i2" if volume.hu.dtype == np.int16 else "<f4"
    found = hashlib.sha256()
    for plane in volume.hu:
        found.update(np.ascontiguousarray(plane, dtype=kind).tobytes())
    affine = tuple(float(number) for number in volume.affine_mm.ravel())
    return VolumeDigest(found.hexdigest(), kind, volume.size, affine)
