"""Series to volume: each slice is read into its place, then scaled there to Hounsfield units."""

import contextlib
import mmap
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.progress import Progress
from app.imaging import stack
from app.imaging.decoding import read_stored, stored_type
from app.imaging.errors import (
    FileDamagedError,
    FolderError,
    OutsideImageError,
    SeriesAmbiguousError,
    SeriesRefusedError,
    SeriesUnknownError,
)
from app.imaging.header import Rescale, SliceHeader
from app.imaging.scanning import scan_folder
from app.imaging.series import Listing, Series
from app.imaging.volume import Volume

_INT16 = np.iinfo(np.int16)


class _NotExactError(Exception):
    """A value does not fit 16 bits; the volume is read again as float32."""


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
    if all(_integral(header) for header in series.slices):
        try:
            return _filled(series, np.dtype(np.int16), progress)
        except _NotExactError:
            progress.report(0.0, "values beyond 16 bits: reading as float32")
    return _filled(series, np.dtype(np.float32), progress)


def _filled(series: Series, dtype: np.dtype[Any], progress: Progress) -> NDArray[Any]:
    columns, rows, count = series.size
    hu = _fresh((count, rows, columns), dtype)
    stored: dict[np.dtype[Any], NDArray[Any]] = {}
    for k, header in enumerate(series.slices):
        progress.report(k / count, f"slice {k + 1} of {count}")
        wanted = stored_type(header.format)
        _fill(header, hu[k], stored.setdefault(wanted, np.empty((rows, columns), wanted)))
    progress.report(1.0, f"{count} slices read")
    return hu


def _fresh(shape: tuple[int, int, int], dtype: np.dtype[Any]) -> NDArray[Any]:
    """Uninitialised array on ordinary memory pages.

    For large arrays numpy asks for huge pages; on a machine whose memory is full of cached files
    the kernel has to make room for those first, which was measured to take up to ten times as long.
    """
    flags = getattr(mmap, "MAP_PRIVATE", 0) | getattr(mmap, "MAP_ANONYMOUS", 0)
    if not flags:  # no such choice on this system
        return np.empty(shape, dtype)
    memory = mmap.mmap(-1, int(np.prod(shape)) * dtype.itemsize, flags=flags)
    return np.frombuffer(memory, dtype).reshape(shape)


def _fill(header: SliceHeader, out: NDArray[Any], stored: NDArray[Any]) -> None:
    """Read one slice and scale it to Hounsfield units.

    The stored values go through one small array that stays in the processor's cache: reading them
    straight into the fresh pages of the volume costs several times as much.
    """
    read_stored(header, stored)
    if out.dtype == np.float32:
        _scale_float(stored, _rescale(header), out)
    else:
        _scale_exact(header, stored, _rescale(header), out)


def _rescale(header: SliceHeader) -> Rescale:
    if header.rescale is None:
        raise FileDamagedError(f"{header.path} gives no Hounsfield units")
    return header.rescale


def _integral(header: SliceHeader) -> bool:
    rescale = _rescale(header)
    limit = 1 << 20
    return all(v.is_integer() and abs(v) < limit for v in (rescale.slope, rescale.intercept))


def _scale_exact(
    header: SliceHeader, stored: NDArray[Any], rescale: Rescale, out: NDArray[Any]
) -> None:
    slope, intercept = int(rescale.slope), int(rescale.intercept)
    if not _fits(header.format.stored_range, slope, intercept):
        padding = _padding(header, stored)
        if padding is not None and padding.any():  # padding is no measurement: it may saturate
            _scale_padded(stored, padding, slope, intercept, out)
            return
        if not _fits((int(stored.min()), int(stored.max())), slope, intercept):
            raise _NotExactError
    if stored.dtype.itemsize == 1:
        stored = stored.astype(np.int16)
    out = out.view(stored.dtype)  # two's complement: the result fits, so wrapping does no harm
    if slope != 1:
        stored = np.multiply(stored, np.array(slope % 65536, np.uint16).astype(stored.dtype))
    np.add(stored, np.array(intercept % 65536, np.uint16).astype(stored.dtype), out=out)


def _fits(bounds: tuple[int, int], slope: int, intercept: int) -> bool:
    ends = [slope * value + intercept for value in bounds]
    return min(ends) >= _INT16.min and max(ends) <= _INT16.max


def _padding(header: SliceHeader, stored: NDArray[Any]) -> NDArray[np.bool_] | None:
    if header.format.padding is None:
        return None
    low, high = header.format.padding
    result: NDArray[np.bool_] = (stored >= low) & (stored <= high)
    return result


def _scale_padded(
    stored: NDArray[Any], padding: NDArray[np.bool_], slope: int, intercept: int, out: NDArray[Any]
) -> None:
    scaled = stored.astype(np.int64) * slope + intercept  # one slice only
    measured = scaled[~padding]
    if measured.size and not _fits((int(measured.min()), int(measured.max())), 1, 0):
        raise _NotExactError
    np.copyto(out, np.clip(scaled, _INT16.min, _INT16.max).astype(np.int16))


def _scale_float(stored: NDArray[Any], rescale: Rescale, out: NDArray[Any]) -> None:
    scaled = stored.astype(np.float64) * rescale.slope + rescale.intercept  # one slice only
    np.copyto(out, scaled.astype(np.float32))


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
    shape = (header.format.rows, header.format.columns)
    stored = np.empty(shape, stored_type(header.format))
    if _integral(header):
        with contextlib.suppress(_NotExactError):  # then a wider type is needed
            hu: NDArray[Any] = np.empty(shape, np.int16)
            _fill(header, hu, stored)
            return hu
    hu = np.empty(shape, np.float32)
    _fill(header, hu, stored)
    return hu
