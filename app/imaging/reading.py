"""Series to volume: each slice is read into its place, then scaled there to Hounsfield units."""

import contextlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.progress import Progress
from app.imaging import stack
from app.imaging.errors import (
    FileDamagedError,
    FolderError,
    OutsideImageError,
    SeriesAmbiguousError,
    SeriesRefusedError,
    SeriesUnknownError,
)
from app.imaging.filling import filled
from app.imaging.header import SliceHeader
from app.imaging.rescaling import NotExactError, integral
from app.imaging.scanning import scan_folder
from app.imaging.series import Listing, Series
from app.imaging.volume import Volume


def load_ct(
    path: Path | str, series_uid: str | None = None, progress: Progress | None = None
) -> Volume:
    """Find a CT series in a folder and read it.

    Args:
        path: the folder.
        series_uid: which series; may be None where only one is usable.
        progress: told how far it is; cancels.

    Raises:
        FolderError: if the folder cannot be read or holds no DICOM.
        SeriesUnknownError, SeriesAmbiguousError, SeriesRefusedError: see `choose`.
        FileDamagedError: if a file cannot be decoded.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    listing = scan_folder(path, progress.part(0.0, 0.4))
    return read_series(choose(listing, series_uid), progress.part(0.4, 1.0))


def choose(listing: Listing, series_uid: str | None = None) -> Series:
    """Pick the series named, or the only usable one.

    Raises:
        SeriesUnknownError: if the folder has no such series.
        SeriesAmbiguousError: if none was named and several are usable.
        SeriesRefusedError: if it, or everything in the folder, is not usable; says why.
        FolderError: if the folder has no DICOM series.
    """
    if not listing.series:
        raise FolderError(_nothing(listing))
    if series_uid is not None:
        return _named(listing, series_uid)
    if len(listing.usable) > 1:
        uids = ", ".join(f"{series.uid} ({series.label})" for series in listing.usable)
        raise SeriesAmbiguousError(
            f"{listing.path} holds {len(listing.usable)} usable CT series; name one: {uids}",
            listing.usable,
        )
    if not listing.usable:
        reasons = "; ".join(f"{series.label}: {series.reason}" for series in listing.series[:4])
        raise SeriesRefusedError(f"no usable CT series in {listing.path}. {reasons}")
    return listing.usable[0]


def _nothing(listing: Listing) -> str:
    if not listing.ignored:
        return f"{listing.path} is empty; name a folder with DICOM files"
    first = listing.ignored[0]
    count = len(listing.ignored)
    return (
        f"no DICOM series in {listing.path}: {count} file{'s' * (count > 1)} ignored "
        f"({first.path.name}: {first.reason})"
    )


def _named(listing: Listing, series_uid: str) -> Series:
    for series in listing.series:
        if series.uid == series_uid:
            if not series.usable:
                raise SeriesRefusedError(f"series {series_uid} cannot be used: {series.reason}")
            return series
    valid = ", ".join(series.uid for series in listing.series)
    raise SeriesUnknownError(f"no series {series_uid} in {listing.path}; it holds {valid}")


def read_series(series: Series, progress: Progress | None = None) -> Volume:
    """Read a usable series into a volume: int16 where every value fits exactly, else float32.

    Raises:
        SeriesRefusedError: if the series is not usable.
        FileDamagedError: if a file has changed since the scan or cannot be decoded; names it.
        Cancelled: if `progress` was cancelled.
    """
    if not series.usable:
        raise SeriesRefusedError(f"series {series.uid} cannot be used: {series.reason}")
    progress = progress or Progress()
    slices = stack.stack([header.plane for header in series.slices if header.plane])
    return Volume(read_only(_hounsfield(series, progress)), slices.affine_mm, series)


def _hounsfield(series: Series, progress: Progress) -> NDArray[Any]:
    if all(integral(header) for header in series.slices):
        try:
            return filled(series.slices, np.dtype(np.int16), progress)
        except NotExactError:
            progress.report(0.0, "values beyond 16 bits: reading as float32")
    return filled(series.slices, np.dtype(np.float32), progress)


def pixel_lps_mm(
    path: Path | str, sop_uid: str, column: int, row: int, progress: Progress | None = None
) -> tuple[FloatArray, float]:
    """Where one pixel of one file lies, by that file's own position and orientation.

    Works for files of refused series too (tilted, gapped, single).

    Args:
        path: the folder that holds the file.
        sop_uid: its SOPInstanceUID.
        column: of the pixel, from 0.
        row: of the pixel, from 0.
        progress: told how far the search is; cancels it.

    Returns:
        The point [mm, LPS], shape (3,), and the Hounsfield value.

    Raises:
        SeriesUnknownError: if no file has this UID.
        OutsideImageError: if the pixel is not in the image.
        SeriesRefusedError: if the file has no position or no Hounsfield units.
        FileDamagedError: if its pixels cannot be read.
    """
    listing = scan_folder(path, progress)
    header = _instance(listing, sop_uid)
    form = header.format
    if not (0 <= column < form.columns and 0 <= row < form.rows):
        raise OutsideImageError(
            f"pixel ({column}, {row}) is outside {header.path.name}: columns 0 to "
            f"{form.columns - 1}, rows 0 to {form.rows - 1}"
        )
    if header.damage:
        raise FileDamagedError(f"{header.path}: {header.damage}")
    if header.plane is None or header.rescale is None or form.samples > 1 or form.frames > 1:
        raise SeriesRefusedError(
            f"{header.path.name} is no single CT image with position, orientation, spacing and "
            "rescale; choose a file that is"
        )
    affine = stack.plane_affine(header.plane, stack.normal(header.plane))
    value = _single(header)[row, column]
    return affine[:3, :3] @ (column, row, 0.0) + affine[:3, 3], float(value)


def _instance(listing: Listing, sop_uid: str) -> SliceHeader:
    if not listing.series:
        raise FolderError(_nothing(listing))
    for series in listing.series:
        for header in series.slices:
            if header.identity.sop_uid == sop_uid:
                return header
    raise SeriesUnknownError(f"no file with SOPInstanceUID {sop_uid} in {listing.path}")


def _single(header: SliceHeader) -> NDArray[Any]:
    if integral(header):
        with contextlib.suppress(NotExactError):  # then a wider type is needed
            return filled((header,), np.dtype(np.int16))[0]
    return filled((header,), np.dtype(np.float32))[0]
