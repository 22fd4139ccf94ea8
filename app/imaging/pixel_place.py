"""Where one pixel of one file lies in the patient, and its value."""

import contextlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.imaging import stack
from app.imaging.errors import (
    FileDamagedError,
    FolderError,
    NotExactError,
    OutsideImageError,
    SeriesRefusedError,
    SeriesUnknownError,
)
from app.imaging.filling import filled
from app.imaging.header import SliceHeader
from app.imaging.reading import nothing_in
from app.imaging.rescaling import integral
from app.imaging.scanning import scan_folder
from app.imaging.series import Listing


def pixel_lps_mm(
    path: Path | str,
    sop_uid: str,
    column: int,
    row: int,
    progress: Progress | None = None,
    frame: int = 0,
) -> tuple[FloatArray, float]:
    """Where one pixel of one file lies, by that file's own position and orientation.

    Works for files of refused series too (tilted, gapped, single).

    Args:
        path: the folder that holds the file.
        sop_uid: its SOPInstanceUID.
        column: of the pixel, from 0.
        row: of the pixel, from 0.
        progress: told how far the search is; cancels it.
        frame: of a multi-frame file, from 0.

    Returns:
        The point [mm, LPS], shape (3,), and the Hounsfield value.

    Raises:
        SeriesUnknownError: if no file has this UID.
        OutsideImageError: if the pixel is not in the image.
        SeriesRefusedError: if the file has no position or no Hounsfield units.
        FileDamagedError: if its pixels cannot be read.
    """
    listing = scan_folder(path, progress)
    header = _instance(listing, sop_uid, frame)
    form = header.format
    if not (0 <= column < form.columns and 0 <= row < form.rows):
        raise OutsideImageError(
            f"pixel ({column}, {row}) is outside {header.path.name}: columns 0 to "
            f"{form.columns - 1}, rows 0 to {form.rows - 1}"
        )
    if header.damage:
        raise FileDamagedError(f"{header.path}: {header.damage}")
    if header.plane is None or header.rescale is None or form.samples > 1:
        raise SeriesRefusedError(
            f"{header.path.name} is no CT image with position, orientation, spacing and "
            "rescale; choose a file that is"
        )
    affine = stack.plane_affine(header.plane, stack.normal(header.plane))
    value = _single(header)[row, column]
    return affine[:3, :3] @ (column, row, 0.0) + affine[:3, 3], float(value)


def _instance(listing: Listing, sop_uid: str, frame: int) -> SliceHeader:
    if not listing.series:
        raise FolderError(nothing_in(listing))
    for series in listing.series:
        for header in series.slices:
            if header.identity.sop_uid == sop_uid and header.frame == frame:
                return header
    which = f" and frame {frame + 1}" if frame else ""
    raise SeriesUnknownError(f"no file with SOPInstanceUID {sop_uid}{which} in {listing.path}")


def _single(header: SliceHeader) -> NDArray[Any]:
    if integral(header):
        with contextlib.suppress(NotExactError):  # then a wider type is needed
            return filled((header,), np.dtype(np.int16))[0]
    return filled((header,), np.dtype(np.float32))[0]
