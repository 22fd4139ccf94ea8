"""Structures in and out of files; what a file is, its content says."""

from __future__ import annotations

import os
from pathlib import Path
from uuid import uuid4

from app.core import paths
from app.core.errors import AcusError
from app.core.files import sync
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.errors import FileDamagedError
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.structure import LONGEST_NAME, PlacedStructure, Structure, StructureSet
from app.imaging.volume import Volume
from app.imaging.worker.jobs import STRUCTURES, WRITE_SEG
from app.imaging.worker.limits import MEMORY_BYTES, MOST_SECONDS, Allowance
from app.imaging.worker.pool import shared_worker

FORMATS = {".seg.nrrd": "3D Slicer segmentation", ".dcm": "DICOM SEG"}
"""Endings of files that can be written, and what they are."""

_COPY_BYTES = 16
"""Memory at work for each voxel of the CT, while a structure is placed on it."""


def read_structures(path: Path, volume: Volume, progress: Progress | None = None) -> StructureSet:
    """Read DICOM SEG, RTSTRUCT, `.seg.nrrd` or NIfTI labels onto the grid of a CT, in the worker.

    Args:
        path: the file.
        volume: the CT that they belong to.
        progress: reports, and may be cancelled.

    Raises:
        StructureFileError: if the file is none of these, or damaged.
        FrameOfReferenceError: if it was drawn on another frame of reference.
        StructureError: if none of it lies in this CT.
        ExtraMissingError: if the package that reads it is not installed.
        WorkerError: if the process that reads it cannot be started.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    progress.report(0.0, sentence("reading {name}", name=path.name))
    numbers = tuple(float(number) for number in volume.affine_mm.ravel())
    series = volume.series
    images = dict.fromkeys(header.identity.sop_uid for header in series.slices)
    uids = (series.uid, volume.digest, *images)
    frame = series.frame_of_reference
    arguments = (path.absolute(), volume.size, numbers, frame, uids, paths.settings())
    try:
        parsed = shared_worker().call(STRUCTURES, arguments, _allowed(volume), progress)
        structures = tuple(_structure(one, volume) for one in parsed.structures)
    except FileDamagedError as error:  # WorkerLostError is one too
        raise StructureFileError(
            sentence("{path_name}: {error}", path_name=path.name, error=error)
        ) from error
    except OSError as error:
        if isinstance(error, AcusError):
            raise
        raise StructureFileError(
            sentence(
                "{path} cannot be read: {error_strerror}", path=path, error_strerror=error.strerror
            )
        ) from error
    progress.report(1.0, sentence("structures placed"))
    return StructureSet(structures, parsed.notes)


def _allowed(volume: Volume) -> Allowance:
    i, j, k = volume.size
    return Allowance(MOST_SECONDS, MEMORY_BYTES + _COPY_BYTES * i * j * k)


def _structure(item: PlacedStructure, volume: Volume) -> Structure:
    """Structure on the CT's own grid, of a box that must lie in it."""
    ends = [first + count for first, count in zip(item.corner, item.mask.shape[::-1], strict=True)]
    inside = all(end <= size for end, size in zip(ends, volume.size, strict=True))
    if min(item.corner) < 0 or not inside:
        raise StructureFileError(
            sentence("{item_name} lies outside this CT", item_name=item.name[:LONGEST_NAME])
        )
    return Structure(
        item.name, item.kind, item.colour, item.mask, item.corner, volume.affine_mm, item.warn_mm
    )


def write_structures(
    path: Path, structures: StructureSet, volume: Volume, progress: Progress | None = None
) -> None:
    """Write structures, as the ending of the path says: `.seg.nrrd` or `.dcm` (DICOM SEG).

    Raises:
        StructureFileError: for another ending, or if it cannot be written; for DICOM SEG also if
            the CT's own files are not there or have another grid, or lack what has to be repeated.
        ExtraMissingError: if the package that writes it is not installed.
        WorkerError: if the process that reads the CT's files for it cannot be started.
        Cancelled: if `progress` was cancelled; nothing is left behind.
    """
    if path.name.endswith(".seg.nrrd"):
        from app.imaging.structures.seg_nrrd import write_nrrd

        write_nrrd(path, structures, volume)
    elif path.suffix == ".dcm":
        _write_seg(path, structures, volume, progress or Progress())
    else:
        raise StructureFileError(
            sentence(
                "{path_name}: structures are written as .seg.nrrd (3D Slicer) or .dcm (DICOM SEG)",
                path_name=path.name,
            )
        )


def _write_seg(path: Path, structures: StructureSet, volume: Volume, progress: Progress) -> None:
    """Have it written beside its place: it repeats what foreign files say, so the worker does."""
    if not len(structures):
        raise StructureFileError(sentence("there are no structures to write"))
    headers = volume.series.slices
    if len(headers) != volume.size[2] or len(set(volume.series.files)) != volume.size[2]:
        raise StructureFileError(
            sentence(
                "this volume is not slice for slice that of DICOM files (it was resampled, or "
                "comes from another format); write a .seg.nrrd instead"
            )
        )
    beside = path.absolute().with_name(f".{path.name}.{uuid4().hex}")
    files = tuple(header.path.absolute() for header in headers)
    arguments = (beside, files, tuple(map(_plain, structures)), volume.size, volume.series.uid)
    voxels = _COPY_BYTES * len(structures) * volume.hu.size
    try:
        shared_worker().call(
            WRITE_SEG, arguments, Allowance(MOST_SECONDS, MEMORY_BYTES + voxels), progress
        )
        sync(beside)
        os.replace(beside, path)
    except FileDamagedError as error:
        raise StructureFileError(
            sentence("{path_name}: {error}", path_name=path.name, error=error)
        ) from error
    except OSError as error:
        if isinstance(error, AcusError):
            raise
        raise StructureFileError(
            sentence(
                "{path} cannot be written: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    finally:
        beside.unlink(missing_ok=True)


def _plain(item: Structure) -> PlacedStructure:
    return PlacedStructure(item.name, item.kind, item.colour, item.mask, item.corner, item.warn_mm)
