"""Series to volume: each slice is read into its place, then scaled there to Hounsfield units.

At reduced size voxels are averaged in blocks. A series that cannot be read as it is, is read on
request by a remedy, and the volume says how. Of a single file too, where one of its pixels lies in
the patient, and its value.
"""

import contextlib
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, frozen, read_only
from app.core.messages import counted, joined, sentence
from app.core.progress import Progress
from app.imaging import memory, stack
from app.imaging.errors import (
    FileDamagedError,
    FolderError,
    NotExactError,
    OutsideImageError,
    SeriesAmbiguousError,
    SeriesRefusedError,
    SeriesUnknownError,
    TooLargeError,
)
from app.imaging.filling import filled, padding_of
from app.imaging.header import SliceHeader
from app.imaging.remedies import offered
from app.imaging.remedies import read as read_mended
from app.imaging.rescaling import fresh_array, integral
from app.imaging.scanning import scan_folder
from app.imaging.series import AS_IT_IS, NO_REMEDY, Listing, Recipe, Refusal, Series
from app.imaging.volume import Volume


def reduced_block(
    slices: NDArray[Any], factors: tuple[int, int], padding: NDArray[np.bool_] | None = None
) -> NDArray[Any]:
    """Average a few slices to one of fewer pixels.

    Args:
        slices: shape (n, rows, columns), int16 or float32.
        factors: pixels of a block along i and j, at most as many as there are; what is left over
            at the far ends is left out.
        padding: True where nothing was measured, of the shape of `slices`: that counts only where a
            block has nothing else.

    Returns:
        Means, shape (rows // j, columns // i), rounded to the nearest where the input is whole.
    """
    whole = _blocks(slices, factors)
    mean: NDArray[Any] = whole.mean(axis=(0, 2, 4), dtype=np.float64)
    if padding is not None and padding.any():
        measured = ~_blocks(padding, factors)
        count = measured.sum(axis=(0, 2, 4))
        total = np.where(measured, whole, 0).sum(axis=(0, 2, 4), dtype=np.float64)
        np.divide(total, count, out=mean, where=count > 0)
    return np.rint(mean) if slices.dtype.kind == "i" else mean


def _blocks(slices: NDArray[Any], factors: tuple[int, int]) -> NDArray[Any]:
    """View slices as blocks of pixels, shape (n, rows // j, j, columns // i, i)."""
    i, j = factors
    count, rows, columns = len(slices), slices.shape[1] // j, slices.shape[2] // i
    return slices[:, : rows * j, : columns * i].reshape(count, rows, j, columns, i)


def reduced_affine(affine_mm: FloatArray, factors: tuple[int, int, int]) -> FloatArray:
    """Affine of a volume after averaging: centres of the blocks, shape (4, 4) -> the same."""
    scale = np.diag([*map(float, factors), 1.0])
    scale[:3, 3] = (np.array(factors) - 1.0) / 2.0
    return frozen(affine_mm @ scale, (4, 4), "affine")


def pixel_lps_mm(
    path: Path | str,
    sop_uid: str,
    column: int,
    row: int,
    progress: Progress | None = None,
    frame: int = 0,
) -> tuple[FloatArray, float | None]:
    """Return where one pixel of one file lies, by that file's own position and orientation.

    Works for files of refused series too (tilted, gapped, single).

    Args:
        path: the folder that holds the file.
        sop_uid: its SOPInstanceUID.
        column: of the pixel, from 0.
        row: of the pixel, from 0.
        progress: told how far the search is; cancels it.
        frame: of a multi-frame file, from 0.

    Returns:
        The point [mm, LPS], shape (3,), and the Hounsfield value; None for it where the pixel is
        padding: nothing was measured there.

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
            sentence(
                "pixel ({column}, {row}) is outside {header_path_name}: columns 0 to "
                "{form_columns}, rows 0 to {form_rows}",
                column=column,
                row=row,
                header_path_name=header.path.name,
                form_columns=form.columns - 1,
                form_rows=form.rows - 1,
            )
        )
    if header.damage:
        raise FileDamagedError(
            sentence(
                "{header_path}: {header_damage}",
                header_path=header.path,
                header_damage=header.damage,
            )
        )
    if header.plane is None or header.rescale is None or form.samples > 1:
        raise SeriesRefusedError(
            sentence(
                "{header_path_name} is no CT image with position, orientation, spacing and "
                "rescale; choose a file that is",
                header_path_name=header.path.name,
            )
        )
    affine = stack.plane_affine(header.plane, stack.normal(header.plane))
    picture = _single(header)
    padding = padding_of(header, picture)
    padded = padding is not None and bool(padding[row, column])
    value = None if padded else float(picture[row, column])
    return affine[:3, :3] @ (column, row, 0.0) + affine[:3, 3], value


def is_padding(volume: Volume, ijk: tuple[int, int, int]) -> bool:
    """Return whether nothing was measured at a voxel of a volume that was read as it is.

    Raises:
        FileDamagedError: if its file has changed since.
    """
    i, j, k = ijk
    if volume.recipe != AS_IT_IS or not volume.series.slices:
        return False
    padding = padding_of(volume.series.slices[k], volume.hu[k])
    return padding is not None and bool(padding[j, i])


def _instance(listing: Listing, sop_uid: str, frame: int) -> SliceHeader:
    if not listing.series:
        raise FolderError(nothing_in(listing))
    for series in listing.series:
        for header in series.slices:
            if header.identity.sop_uid == sop_uid and header.frame == frame:
                return header
    which = f" and frame {frame + 1}" if frame else ""
    raise SeriesUnknownError(
        sentence(
            "no file with SOPInstanceUID {sop_uid}{which} in {listing_path}",
            sop_uid=sop_uid,
            which=which,
            listing_path=listing.path,
        )
    )


def _single(header: SliceHeader) -> NDArray[Any]:
    if integral(header):
        with contextlib.suppress(NotExactError):  # then a wider type is needed
            return filled((header,), np.dtype(np.int16))[0]
    return filled((header,), np.dtype(np.float32))[0]


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


def choose(listing: Listing, series_uid: str | None = None, remedy: str = NO_REMEDY) -> Series:
    """Pick the series named (UID, or UID#part), or the only usable one.

    Args:
        listing: what the folder holds.
        series_uid: which series; may be None where only one is usable.
        remedy: what will be asked for in reading it: then those that it mends count as usable too.

    Raises:
        SeriesUnknownError: if the folder has no such series.
        SeriesAmbiguousError: if none was named and several are usable.
        SeriesRefusedError: if it, or everything in the folder, is not usable; says why.
        FolderError: if the folder has no DICOM series.
    """
    if not listing.series:
        raise FolderError(nothing_in(listing))
    if series_uid is not None:
        return _named(listing, series_uid, remedy)
    usable = tuple(s for s in listing.series if s.usable or remedy in s.remedies)
    if len(usable) > 1:
        uids = ", ".join(f"{series.key} ({series.label})" for series in usable)
        raise SeriesAmbiguousError(
            sentence(
                "{listing_path} holds {usable} usable CT series; name one: {uids}",
                listing_path=listing.path,
                usable=len(usable),
                uids=uids,
            ),
            usable,
        )
    if not usable:
        reasons = joined(
            "; ",
            (
                sentence(
                    "{label}: {reason}{offer}",
                    label=series.label,
                    reason=series.reason,
                    offer=offer(series),
                )
                for series in listing.series[:4]
            ),
        )
        raise SeriesRefusedError(
            sentence(
                "no usable CT series in {listing_path}. {reasons}",
                listing_path=listing.path,
                reasons=reasons,
            )
        )
    return usable[0]


def nothing_in(listing: Listing) -> str:
    """Say that a place holds no series, and what it does hold."""
    if not listing.ignored:
        return sentence(
            "{listing_path} is empty; name a folder with DICOM files", listing_path=listing.path
        )
    first = listing.ignored[0]
    count = len(listing.ignored)
    return counted(
        "no DICOM series in {listing_path}: {n} file ignored ({first_path_name}: {first_reason})",
        "no DICOM series in {listing_path}: {n} files ignored ({first_path_name}: {first_reason})",
        count,
        listing_path=listing.path,
        first_path_name=first.path.name,
        first_reason=first.reason,
    )


def _named(listing: Listing, series_uid: str, remedy: str) -> Series:
    named = [s for s in listing.series if series_uid in (s.uid, s.key)]
    exact = [s for s in named if s.key == series_uid]
    found = exact or [s for s in named if s.usable] or named[:1]
    if not found:
        valid = ", ".join(series.key for series in listing.series)
        raise SeriesUnknownError(
            sentence(
                "no series {series_uid} in {listing_path}; it holds {valid}",
                series_uid=series_uid,
                listing_path=listing.path,
                valid=valid,
            )
        )
    if len(found) > 1:
        parts = ", ".join(series.key for series in found)
        raise SeriesAmbiguousError(
            sentence(
                "series {series_uid} holds {count} passes over the same places; name one: {parts}",
                series_uid=series_uid,
                count=len(found),
                parts=parts,
            ),
            tuple(found),
        )
    if remedy == NO_REMEDY and not found[0].usable:
        raise SeriesRefusedError(_refusal(found[0]))
    return found[0]


def _refusal(series: Series) -> str:
    """Return why a series is not read as it is, and what could be asked for instead."""
    return sentence(
        "series {series_key} cannot be used: {series_reason}{offer}",
        series_key=series.key,
        series_reason=series.reason,
        offer=offer(series),
    )


def offer(series: Series) -> str:
    """Say with which `--remedy` a refused series can be read; nothing where there is none."""
    if series.usable or not series.remedies:
        return ""
    ways = (
        sentence("ask to {remedy} (--remedy {remedy})", remedy=remedy) for remedy in series.remedies
    )
    return sentence("; it can be read if you {ways}", ways=" or ".join(ways))


def read_series(series: Series, progress: Progress | None = None) -> Volume:
    """Read a usable series into a volume: int16 where every value fits exactly, else float32.

    Raises:
        SeriesRefusedError: if the series is not usable.
        TooLargeError: if it does not fit the memory that is free now.
        FileDamagedError: if a file has changed since the scan or cannot be decoded; names it.
        Cancelled: if `progress` was cancelled.
    """
    if not series.usable:
        raise SeriesRefusedError(_refusal(series))
    if series.volume_file is not None:
        from app.imaging.nifti import read_nifti

        return read_nifti(series, progress)
    if too_large := memory.need(series.slices).reason:  # less is free than at the scan
        raise _too_large(series, too_large)
    hu = read_pixels(series, progress)
    return Volume(read_only(hu), grid_of(series).affine_mm, series, unit=series.unit)


def read_with(
    series: Series,
    remedy: str = NO_REMEDY,
    progress: Progress | None = None,
    spacing_mm: float | None = None,
    factors: tuple[int, int, int] = (1, 1, 1),
) -> Volume:
    """Read a series as it is, or mended in the way asked for.

    Args:
        series: usable, or one for which the remedy that is asked for is offered.
        remedy: name of what is asked for.
        progress: told how far it is; cancels.
        spacing_mm: of resampled slices; the usual distance of the series' own where None.
        factors: voxels along i, j and k that halving averages to one; as the memory needs where
            all are 1.

    Raises:
        SeriesRefusedError: if the series cannot be read that way; says why.
        ImagingError: if there is no such remedy; names those that there are.
        FileDamagedError: if a file has changed since the scan or cannot be decoded; names it.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    if remedy == NO_REMEDY:
        return read_series(series, progress)
    if not series.slices or not (series.usable or remedy in series.remedies):
        reason = series.reason or "it is one file that holds a whole volume"
        raise SeriesRefusedError(
            sentence(
                "the remedy {remedy!r} does not help series {series_key}: {reason}{instead}",
                remedy=remedy,
                series_key=series.key,
                reason=reason,
                instead=_instead(series),
            )
        )
    return read_mended(series, Recipe(remedy, factors, spacing_mm), progress)


def _instead(series: Series) -> str:
    """Say what helps a series that a remedy does not help."""
    if series.usable:
        return sentence("; read it as it is (--remedy {no_remedy})", no_remedy=NO_REMEDY)
    return offer(series) or sentence("; no remedy does")


def read_again(series: Series, recipe: Recipe, progress: Progress | None = None) -> Volume:
    """Read a series in the way in which it was read before; raises as `read_with` does."""
    return read_with(series, recipe.remedy, progress, recipe.spacing_mm, recipe.factors)


def grid_of(series: Series) -> stack.Stack:
    """Grid of the slices of a series, in their order."""
    planes = [header.plane for header in series.slices if header.plane]
    return stack.stack(planes, (series.size[0], series.size[1]))


def read_pixels(
    series: Series, progress: Progress | None = None, factors: tuple[int, int, int] = (1, 1, 1)
) -> NDArray[Any]:
    """Values of all slices in their order, whatever lies between them.

    Args:
        series: usable, or refused for the places of its slices only.
        progress: told how far it is; cancels.
        factors: so many voxels along i, j and k are averaged to one; what is left over at the far
            ends is left out.

    Returns:
        Shape (K, J, I), int16 where every value fits exactly, else float32. Averages are rounded
        where int16 is used.

    Raises:
        FileDamagedError: if a file has changed since the scan or cannot be decoded; names it.
        TooLargeError: if its values turn out to need more memory than there is.
        SeriesRefusedError: if the memory does not suffice.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    if memory.voxel_bytes(series.slices) == 2:
        try:
            return _filled(series, np.dtype(np.int16), progress, factors)
        except NotExactError:
            progress.report(0.0, sentence("values beyond 16 bits: reading as float32"))
        _check_room(series, factors)
    return _filled(series, np.dtype(np.float32), progress, factors)


def _check_room(series: Series, factors: tuple[int, int, int]) -> None:
    """See that there is room for twice the memory that was counted on."""
    i, j, k = (max(1, n // f) for n, f in zip(series.size, factors, strict=True))
    if too_large := memory.need_of((i, j, k), 4).reason:
        raise _too_large(
            series, sentence("has values beyond 16 bits and {too_large}", too_large=too_large)
        )


def _too_large(series: Series, reason: str) -> TooLargeError:
    """Make an error that holds the series as the scan would have found it, had it known."""
    known = replace(series, usable=False, reason=reason, refusal=Refusal.TOO_LARGE)
    known = replace(known, remedies=offered(known).names)
    ask = (
        sentence("; ask to {known_remedy} it", known_remedy=known.remedy) if known.remedies else ""
    )
    return TooLargeError(
        sentence(
            "series {series_key} {reason}{ask}", series_key=series.key, reason=reason, ask=ask
        ),
        known,
    )


def _padding(headers: tuple[SliceHeader, ...], whole: NDArray[Any]) -> NDArray[np.bool_] | None:
    """Find what was not measured in a few slices, of the shape of `whole`; None if all was."""
    found = [padding_of(header, picture) for header, picture in zip(headers, whole, strict=True)]
    if all(padding is None for padding in found):
        return None
    return np.stack([np.zeros(whole.shape[1:], bool) if p is None else p for p in found])


def _filled(
    series: Series, dtype: np.dtype[Any], progress: Progress, factors: tuple[int, int, int]
) -> NDArray[Any]:
    if factors == (1, 1, 1):
        return filled(series.slices, dtype, progress)
    columns, rows, count = series.size
    i, j, k = (max(1, min(f, n)) for f, n in zip(factors, series.size, strict=True))
    hu = fresh_array((count // k, rows // j, columns // i), dtype)
    memory.hold(hu)
    for block in range(len(hu)):  # never more than a few slices at full size in memory
        progress.report(
            block / len(hu),
            sentence("slice {current} of {count}", current=block * k + 1, count=count),
        )
        slices = series.slices[block * k : (block + 1) * k]
        whole = filled(slices, dtype)
        hu[block] = reduced_block(whole, (i, j), _padding(slices, whole))
    progress.report(
        1.0,
        sentence(
            "{count} slices read, {i} × {j} × {k} voxels taken together", count=count, i=i, j=j, k=k
        ),
    )
    return hu
