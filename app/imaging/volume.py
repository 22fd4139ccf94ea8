"""A CT volume: Hounsfield values on a grid, and where each voxel lies in the patient."""

import hashlib
import json
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.imaging.interpolation import Interpolation, interpolate
from app.imaging.series import AS_IT_IS, Recipe, Series


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

    @property
    def whole(self) -> str:
        """SHA-256 of all of it, in hexadecimal; places to a tenth of a micrometre count."""
        places = [round(number, 4) + 0.0 for number in self.affine_mm]  # + 0.0: no minus zero
        text = json.dumps([self.values, self.kind, self.size, places])
        return hashlib.sha256(text.encode()).hexdigest()


def digest_of(volume: "Volume") -> VolumeDigest:
    """Return a digest that other programs can compute too: of the values, and the geometry."""
    kind = "<i2" if volume.hu.dtype == np.int16 else "<f4"
    found = hashlib.sha256()
    for plane in volume.hu:
        found.update(np.ascontiguousarray(plane, dtype=kind).tobytes())
    affine = tuple(float(number) for number in volume.affine_mm.ravel())
    return VolumeDigest(found.hexdigest(), kind, volume.size, affine)


SHEAR_MM = 0.01
"""Drift of the slices over the whole volume from which it counts as sheared [mm]."""


@dataclass(frozen=True, eq=False)
class Volume:
    """Hounsfield values and their geometry. Voxel (i, j, k) = (column, row, slice).

    Attributes:
        hu: shape (K, J, I), int16 or float32, read-only; k ascends along the slice normal.
        affine_mm: voxel (i, j, k) -> patient LPS [mm], shape (4, 4), read-only. Integer indices
            are voxel centres.
        series: where it comes from.
        made: what was done to the files' own values to get here, in words; empty where nothing was.
        unit: of the values, "HU"; empty for MR and others without one.
        recipe: what was asked for in reading it; the same asked again gives the same volume.

    The axes of i and j are perpendicular but for what the files themselves say; that of k leaves
    their normal where the gantry was tilted (`tilt_deg`).

    Raises:
        NumericalError: if the affine is not finite or cannot be inverted.
    """

    hu: NDArray[Any]
    affine_mm: FloatArray
    series: Series
    made: tuple[str, ...] = ()
    unit: str = "HU"
    recipe: Recipe = AS_IT_IS

    def __post_init__(self) -> None:
        affine = frozen(self.affine_mm, (4, 4), "affine_mm")
        if abs(np.linalg.det(affine[:3, :3])) < 1e-12:
            raise NumericalError(sentence("affine_mm {affine} is singular", affine=affine.tolist()))
        self.hu.setflags(write=False)
        object.__setattr__(self, "affine_mm", affine)

    @property
    def size(self) -> tuple[int, int, int]:
        """Number of columns, rows and slices (I, J, K)."""
        k, j, i = self.hu.shape
        return i, j, k

    @cached_property
    def spacing_mm(self) -> FloatArray:
        """Distance between voxels along i, j and k, shape (3,)."""
        return frozen(np.linalg.norm(self.affine_mm[:3, :3], axis=0))

    @cached_property
    def direction(self) -> FloatArray:
        """Unit vectors of i, j, k in LPS as columns, shape (3, 3); no rotation where sheared."""
        return frozen(self.affine_mm[:3, :3] / self.spacing_mm)

    @cached_property
    def tilt_deg(self) -> float:
        """Angle between the slices' normal and the direction in which they stack [degrees]."""
        normal = np.cross(self.affine_mm[:3, 0], self.affine_mm[:3, 1])
        along = abs(float(normal @ self.affine_mm[:3, 2]))
        beside = float(np.linalg.norm(np.cross(normal, self.affine_mm[:3, 2])))
        return float(np.degrees(np.arctan2(beside, along)))

    @property
    def is_sheared(self) -> bool:
        """Return whether the slices drift by more than `SHEAR_MM` beside their normal."""
        length = float(self.spacing_mm[2]) * max(self.size[2] - 1, 1)
        return float(np.sin(np.radians(self.tilt_deg))) * length > SHEAR_MM

    @cached_property
    def digest(self) -> str:
        """Return what it is by its geometry and voxels: SHA-256 in hexadecimal; a second per
        gigabyte.
        """
        return digest_of(self).whole

    @property
    def is_left_handed(self) -> bool:
        """Return whether i, j, k form a left-handed frame, as some formats other than DICOM
        allow.
        """
        return float(np.linalg.det(self.affine_mm[:3, :3])) < 0.0

    @property
    def origin_mm(self) -> FloatArray:
        """Centre of voxel (0, 0, 0) in LPS, shape (3,)."""
        origin: FloatArray = self.affine_mm[:3, 3]
        return origin

    @cached_property
    def inverse_mm(self) -> FloatArray:
        """Patient LPS [mm] -> voxel (i, j, k), shape (4, 4)."""
        return frozen(np.linalg.inv(self.affine_mm))

    @cached_property
    def voxels_per_mm(self) -> FloatArray:
        """Return how far i, j and k change at most within a millimetre, sheared or not, shape
        (3,).
        """
        return frozen(np.linalg.norm(self.inverse_mm[:3, :3], axis=1))

    def lps_mm(self, ijk: ArrayLike) -> FloatArray:
        """Patient points of voxel indices, shape (3,) or (n, 3) -> the same [mm]."""
        result: FloatArray = np.asarray(ijk, np.float64) @ self.affine_mm[:3, :3].T
        return result + self.affine_mm[:3, 3]

    def points_m(self, ijk: ArrayLike) -> FloatArray:
        """Patient points of voxel indices in metres, shape (3,) or (n, 3) -> the same."""
        return self.lps_mm(ijk) * MILLIMETRE

    def voxel(self, lps_mm: ArrayLike) -> FloatArray:
        """Voxel indices, as floats, of patient points [mm], shape (3,) or (n, 3) -> the same."""
        offset = np.asarray(lps_mm, np.float64) - self.affine_mm[:3, 3]
        result: FloatArray = offset @ self.inverse_mm[:3, :3].T
        return result

    def contains(self, lps_mm: ArrayLike) -> bool:
        """Return whether a patient point [mm], shape (3,), lies in the volume, voxel edges
        included.
        """
        ijk = self.voxel(lps_mm)
        return bool(((ijk >= -0.5) & (ijk <= np.array(self.size) - 0.5)).all())

    def hu_at(
        self, lps_mm: ArrayLike, interpolation: str = Interpolation.TRILINEAR
    ) -> float | None:
        """Hounsfield value at a patient point [mm], shape (3,); None outside the volume.

        Args:
            lps_mm: the point.
            interpolation: one of `Interpolation`.
        """
        if not self.contains(lps_mm):
            return None
        return float(
            interpolate(self.hu, self.voxel(lps_mm)[None], Interpolation(interpolation))[0]
        )
