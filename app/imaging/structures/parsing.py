"""Files of structures, read in the worker process; what a file is, its content says."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from app.core.progress import Progress
from app.imaging.errors import brief
from app.imaging.examining import starts_like_dicom
from app.imaging.series import Series
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.placed import Placed, PlacedStructure
from app.imaging.structures.placing import Found, place
from app.imaging.volume import Volume

SEG, RTSTRUCT = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.481.3"
LABEL_SEG = "1.2.840.10008.5.1.4.1.1.66.7"

_NIFTI = (b"n+1\0", b"ni1\0")


def parse_structures(
    path: Path,
    size: tuple[int, int, int],
    affine_mm: tuple[float, ...],
    frame_of_reference: str,
    progress: Progress,
) -> Placed:
    """Job of the worker: read a file of structures onto the grid of a CT.

    Args:
        path: the file.
        size: columns, rows, slices of the CT.
        affine_mm: its voxel (i, j, k) -> LPS [mm], row by row, 16 numbers.
        frame_of_reference: its FrameOfReferenceUID.
        progress: told of each structure.

    Raises:
        StructureFileError, FrameOfReferenceError, StructureError, ExtraMissingError: see
            `read_structures`.
    """
    volume = _grid(size, affine_mm, frame_of_reference)
    found = place(_read(path, volume), volume, progress)
    return Placed(
        tuple(
            PlacedStructure(
                one.name, one.kind, one.colour, one.mask, one.corner, float(one.warn_mm)
            )
            for one in found
        ),
        found.notes,
    )


def _grid(size: tuple[int, int, int], affine_mm: tuple[float, ...], frame: str) -> Volume:
    """Return a CT of this grid, whose values are nowhere: structures are placed by geometry."""
    values = np.broadcast_to(np.int16(0), size[::-1])
    series = Series(
        "", "CT", "", size, None, None, None, True, "", (), "", frame, windows=(),
    )  # fmt: skip
    return Volume(values, np.array(affine_mm, np.float64).reshape(4, 4), series)


def _read(path: Path, volume: Volume) -> Found:
    if path.exists() and not path.is_file():  # opening a pipe would wait for ever
        raise StructureFileError(f"{path.name} is not a regular file")
    try:
        with path.open("rb") as file:
            head = file.read(352)
    except OSError as error:
        raise StructureFileError(f"{path} cannot be read: {error.strerror or error}") from error
    if head[:4] == b"NRRD":
        from app.imaging.structures.seg_nrrd import read_nrrd

        return read_nrrd(path)
    if head[:2] == b"\x1f\x8b" or head[344:348] in _NIFTI or head[:4] in (
        b"\x5c\x01\0\0", b"\0\0\x01\x5c", b"\x1c\x02\0\0", b"\0\0\x02\x1c",
    ):  # fmt: skip
        from app.imaging.structures.labels import read_labels

        return read_labels(path)
    if head[128:132] != b"DICM" and not starts_like_dicom(head):
        raise _unknown(path, "no file of structures")
    return _read_dicom(path, volume)


def _read_dicom(path: Path, volume: Volume) -> Found:
    from pydicom import dcmread

    try:
        dataset: Any = dcmread(path, force=True)
        kind, name = str(dataset.get("SOPClassUID", "")), str(dataset.get("Modality", ""))
    except MemoryError:
        raise
    except Exception as error:  # pydicom raises whatever the bytes lead it to
        raise StructureFileError(f"{path.name} cannot be read ({brief(error)})") from error
    if kind in (SEG, LABEL_SEG):
        from app.imaging.structures.dicom_seg import read_seg

        return read_seg(dataset, path)
    if kind == RTSTRUCT:
        from app.imaging.structures.rtstruct import read_rtstruct

        return read_rtstruct(dataset, path, volume)
    raise _unknown(path, f"a DICOM file of modality {name[:16]}" if kind else "no structures")


def _unknown(path: Path, what: str) -> StructureFileError:
    return StructureFileError(
        f"{path.name} is {what}; DICOM SEG, RTSTRUCT, .seg.nrrd and NIfTI labels are read"
    )
