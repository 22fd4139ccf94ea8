"""Structures in and out of files; what a file is, its content says."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from app.core.progress import Progress
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.placing import Labelled, place
from app.imaging.structures.structure import StructureSet
from app.imaging.volume import Volume

SEG, RTSTRUCT = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.481.3"
LABEL_SEG = "1.2.840.10008.5.1.4.1.1.66.7"

FORMATS = {".seg.nrrd": "3D Slicer segmentation", ".dcm": "DICOM SEG"}
"""Endings of files that can be written, and what they are."""

_NIFTI = (b"n+1\0", b"ni1\0")


def read_structures(path: Path, volume: Volume, progress: Progress | None = None) -> StructureSet:
    """Read DICOM SEG, RTSTRUCT, `.seg.nrrd` or NIfTI labels onto the grid of a CT.

    Args:
        path: the file.
        volume: the CT that they belong to.
        progress: reports, and may be cancelled.

    Raises:
        StructureFileError: if the file is none of these, or damaged.
        FrameOfReferenceError: if it was drawn on another frame of reference.
        StructureError: if none of it lies in this CT.
        ExtraMissingError: if the package that reads it is not installed.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    progress.report(0.0, f"reading {path.name}")
    found, frame, notes = _read(path, volume)
    progress.report(0.6, "placing the structures")
    structures = place(found, frame, volume, notes)
    progress.report(1.0, "structures placed")
    return structures


def _read(path: Path, volume: Volume) -> tuple[list[Labelled], str, tuple[str, ...]]:
    try:
        with path.open("rb") as file:
            head = file.read(352)
    except OSError as error:
        raise StructureFileError(f"{path} cannot be read: {error.strerror or error}") from error
    if head[:4] == b"NRRD":
        from app.imaging.structures.seg_nrrd import read_nrrd

        return read_nrrd(path), "", ()
    if head[:2] == b"\x1f\x8b" or head[344:348] in _NIFTI or head[:4] in (
        b"\x5c\x01\0\0", b"\0\0\x01\x5c", b"\x1c\x02\0\0", b"\0\0\x02\x1c",
    ):  # fmt: skip
        from app.imaging.structures.labels import read_labels

        return read_labels(path), "", ()
    return _read_dicom(path, volume)


def _read_dicom(path: Path, volume: Volume) -> tuple[list[Labelled], str, tuple[str, ...]]:
    from pydicom import dcmread

    try:
        dataset: Any = dcmread(path, force=True)
        kind, name = str(dataset.get("SOPClassUID", "")), str(dataset.get("Modality", ""))
    except Exception as error:  # pydicom raises whatever the bytes lead it to
        raise StructureFileError(f"{path.name} cannot be read: {error}") from error
    if kind in (SEG, LABEL_SEG):
        from app.imaging.structures.dicom_seg import read_seg

        return read_seg(dataset, path)
    if kind == RTSTRUCT:
        from app.imaging.structures.rtstruct import read_rtstruct

        return read_rtstruct(dataset, path, volume)
    what = f"a DICOM file of modality {name[:16]}" if kind else "no file of structures"
    raise StructureFileError(
        f"{path.name} is {what}; DICOM SEG, RTSTRUCT, .seg.nrrd and NIfTI labels are read"
    )


def write_structures(path: Path, structures: StructureSet, volume: Volume) -> None:
    """Write structures, as the ending of the path says: `.seg.nrrd` or `.dcm` (DICOM SEG).

    Raises:
        StructureFileError: for another ending, or if it cannot be written.
        ExtraMissingError: if the package that writes it is not installed.
    """
    if path.name.endswith(".seg.nrrd"):
        from app.imaging.structures.seg_nrrd import write_nrrd

        write_nrrd(path, structures, volume)
    elif path.suffix == ".dcm":
        from app.imaging.structures.dicom_seg import write_seg

        write_seg(path, structures, volume)
    else:
        raise StructureFileError(
            f"{path.name}: structures are written as .seg.nrrd (3D Slicer) or .dcm (DICOM SEG)"
        )
