"""CT series as volumes, planes through them, and the way between patient and voxels."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.core.errors import ConfigurationError, NumericalError
from app.core.messages import sentence
from app.imaging.interpolation import Interpolation
from app.imaging.volume import Volume as ProgramVolume

__all__ = ["Volume", "phantom_ct", "read_ct", "slice_plane"]


@dataclass(frozen=True, slots=True, eq=False)
class Volume:
    """Hounsfield values on a grid in the patient. Points are DICOM's own: LPS, millimetres.

    Attributes:
        hu: values, shape (K, J, I) = (slices, rows, columns), int16 or float32, read-only.
        affine_mm: voxel (i, j, k) = (column, row, slice) -> LPS [mm], shape (4, 4); integers are
            the centres of voxels.
        spacing_mm: between voxels along i, j and k, shape (3,).
        unit: of the values, `HU`; empty for pictures without one.
        made: what was done to the files' own values, in words; empty where nothing was.
    """

    hu: NDArray[Any]
    affine_mm: FloatArray
    spacing_mm: FloatArray
    unit: str
    made: tuple[str, ...]
    _volume: ProgramVolume = field(repr=False)

    def to_patient(self, ijk: ArrayLike) -> FloatArray:
        """Return LPS points [mm] of voxel indices, whole or between, shape (3,) or (n, 3)."""
        return self._volume.lps_mm(ijk)

    def to_voxel(self, lps_mm: ArrayLike) -> FloatArray:
        """Return voxel indices (i, j, k), as floats, of LPS points [mm], shape (3,) or (n, 3)."""
        return self._volume.voxel(lps_mm)

    def value_at(self, lps_mm: ArrayLike) -> float | None:
        """Return the value at an LPS point [mm], shape (3,), trilinear; None outside the volume."""
        return self._volume.hu_at(lps_mm)


def read_ct(folder: str | Path, series: str | None = None) -> Volume:
    """Read a CT series from a folder at any depth, a zip, a DICOMDIR or a NIfTI file.

    A process of its own decodes the files, and a series of which a slice is missing, uneven or
    tilted is refused.

    Args:
        folder: where it lies.
        series: SeriesInstanceUID; may be None where only one series is usable.

    Raises:
        AcusError: if there is none, several are usable, or a file is damaged; says which and why.
    """
    from app.imaging.reading import load_ct

    volume = load_ct(folder, series)
    return Volume(volume.hu, volume.affine_mm, volume.spacing_mm, volume.unit, volume.made, volume)


def phantom_ct(seed: int = 1, *, slices: int = 300, rows: int = 512) -> Path:
    """Return the folder of the DICOM CT of a made patient; it is made at the first call.

    Args:
        seed: which patient, 0 or more.
        slices: over 300 mm from the iliac crests to the bases of the lungs.
        rows: rows and columns of a slice, over 384 mm.

    Raises:
        AcusError: if a number is out of range.
    """
    from app.imaging.phantom.series import phantom_series

    return phantom_series(seed, slices=slices, rows=rows)


def slice_plane(
    volume: Volume,
    centre_mm: ArrayLike,
    right: ArrayLike,
    down: ArrayLike,
    *,
    pixel_mm: float = 1.0,
    columns: int = 256,
    rows: int = 256,
    interpolation: str = "trilinear",
    outside: float = -1024.0,
) -> NDArray[np.float32]:
    """Cut any plane out of a volume.

    Args:
        volume: the CT.
        centre_mm: middle of the picture, LPS [mm], shape (3,).
        right: direction of a row of pixels in LPS, of any length, shape (3,).
        down: direction of a column; turned within the plane to a right angle with `right`.
        pixel_mm: size of a pixel.
        columns: pixels in a row.
        rows: pixels in a column.
        interpolation: `nearest`, `trilinear` or `cubic`.
        outside: value of pixels outside the volume.

    Returns:
        Values, shape (rows, columns); row 0 is on top.

    Raises:
        AcusError: if the directions are parallel or not finite, a size is not positive, or there is
            no such interpolation.
    """
    from app.imaging.oblique import Plane, oblique_image
    from app.imaging.reformat import Frame

    if interpolation not in set(Interpolation):
        valid = ", ".join(Interpolation)
        raise ConfigurationError(
            sentence(
                "no interpolation {interpolation!r}; valid names: {valid}",
                interpolation=interpolation,
                valid=valid,
            )
        )
    if not (isfinite(pixel_mm) and pixel_mm > 0.0):
        raise NumericalError(
            sentence("pixel_mm is {pixel_mm}; it must be above 0", pixel_mm=pixel_mm)
        )
    frame = Frame.of(centre_mm, right, down)
    plane = Plane.centred(frame.origin_mm, frame.right, frame.down, pixel_mm, columns, rows)
    return oblique_image(
        volume._volume,  # noqa: SLF001  (of this module's own class)
        plane,
        Interpolation(interpolation),
        outside,
    )
