"""Files of structures, read in the worker process; what a file is, its content says.

Label maps as NIfTI files: each whole number above 0 is a structure.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.elements import FURTHEST_MM
from app.imaging.errors import brief
from app.imaging.header_reading import starts_like_dicom
from app.imaging.privacy.key import installation_key
from app.imaging.privacy.uids import UidMap
from app.imaging.series import Series
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.extras import extra
from app.imaging.structures.placing import Found, Labelled, place
from app.imaging.structures.structure import PlacedStructure, PlacedStructures
from app.imaging.volume import Volume

LARGEST = 2_000_000_000
MOST_LABELS = 256
_UNITS_MM = {"mm": 1.0, "unknown": 1.0, "meter": 1000.0, "micron": 0.001}


def read_labels(path: Path) -> Found:
    """Read the labels of a NIfTI file, placed by its sform, else its qform.

    Raises:
        StructureFileError: if the file is damaged, has no place in space, or is no label map.
        ExtraMissingError: without the extra `nifti`.
    """
    nibabel = extra("nibabel", "NIfTI files")
    try:
        image: Any = nibabel.load(str(path), mmap=False)
        affine, shape = _affine(image, path), image.shape
        if len(shape) == 4 and shape[3] == 1:
            shape = shape[:3]
        if len(shape) != 3 or min(shape) < 1 or np.prod(shape, dtype=np.float64) > LARGEST:
            raise StructureFileError(
                sentence(
                    "{path_name} has sizes {image_shape}; three are read",
                    path_name=path.name,
                    image_shape=image.shape,
                )
            )
        values = np.asanyarray(image.dataobj).reshape(shape)
    except (StructureFileError, MemoryError):
        raise
    except Exception as error:  # nibabel raises whatever the bytes lead it to
        what = brief(error)
        raise StructureFileError(
            sentence(
                "{path_name} cannot be read as NIfTI ({fault})", path_name=path.name, fault=what
            )
        ) from error
    exact = values.dtype.kind in "iub"
    if not exact and (not np.isfinite(values).all() or (np.rint(values) != values).any()):
        raise StructureFileError(
            sentence(
                "{path_name} holds fractions; a label map holds whole numbers", path_name=path.name
            )
        )
    labels = [int(label) for label in np.unique(values) if label > 0]
    if not labels or len(labels) > MOST_LABELS:
        raise StructureFileError(
            sentence(
                "{path_name} holds {labels} labels above 0; a label map holds 1 to {most_labels}",
                path_name=path.name,
                labels=len(labels),
                most_labels=MOST_LABELS,
            )
        )
    stem = path.name.split(".")[0]
    names = [stem] if len(labels) == 1 else [f"{stem} {label}" for label in labels]
    kji = values.transpose(2, 1, 0)
    named = zip(names, labels, strict=True)
    return Found((Labelled(name, kji == label, affine) for name, label in named), len(labels))


def _affine(image: Any, path: Path) -> Any:
    """Voxel (i, j, k) -> LPS [mm]."""
    header = image.header
    if not hasattr(header, "get_sform"):
        raise StructureFileError(
            sentence(
                "{path_name} is {format_name}, not NIfTI",
                path_name=path.name,
                format_name=type(image).__name__,
            )
        )
    sform, s_code = header.get_sform(coded=True)
    qform, q_code = header.get_qform(coded=True)
    if not s_code and not q_code:
        raise StructureFileError(
            sentence(
                "{path_name} does not say where it lies (neither sform nor qform is set)",
                path_name=path.name,
            )
        )
    unit = _UNITS_MM[header.get_xyzt_units()[0]]
    affine = np.array(sform if s_code else qform, np.float64)
    affine[:3] *= unit
    affine[:2] *= -1.0  # RAS -> LPS
    if (np.abs(affine) > FURTHEST_MM).any():
        raise StructureFileError(
            sentence(
                "{path_name} lies further away than {furthest_mm:g} mm",
                path_name=path.name,
                furthest_mm=FURTHEST_MM,
            )
        )
    if not np.isfinite(affine).all() or abs(np.linalg.det(affine[:3, :3])) < 1e-9:
        raise StructureFileError(
            sentence("{path_name}: its axes span no volume", path_name=path.name)
        )
    return affine


SEG, RTSTRUCT = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.481.3"
LABEL_SEG = "1.2.840.10008.5.1.4.1.1.66.7"

_NIFTI = (b"n+1\0", b"ni1\0")


def parse_structures(
    path: Path,
    size: tuple[int, int, int],
    affine_mm: tuple[float, ...],
    frame_of_reference: str,
    uids: tuple[str, ...],
    settings: Path,
    progress: Progress,
) -> PlacedStructures:
    """Job of the worker: read a file of structures onto the grid of a CT.

    Args:
        path: the file.
        size: columns, rows, slices of the CT.
        affine_mm: its voxel (i, j, k) -> LPS [mm], row by row, 16 numbers.
        frame_of_reference: its FrameOfReferenceUID.
        uids: of its series and images.
        settings: folder with the key that gives de-identified copies their UIDs.
        progress: told of each structure.

    Raises:
        StructureFileError, FrameOfReferenceError, StructureError, ExtraMissingError: see
            `read_structures`.
    """
    os.environ["ACUS_SETTINGS"] = str(settings)
    volume = _grid(size, affine_mm, frame_of_reference)
    own = frozenset(uids) - {""}
    read = _of_the_copy(_read(path, volume, own), frame_of_reference)
    found = place(read, volume, progress, own)
    return PlacedStructures(
        tuple(
            PlacedStructure(
                one.name, one.kind, one.colour, one.mask, one.corner, float(one.warn_mm)
            )
            for one in found
        ),
        found.notes,
    )


def _of_the_copy(result: Found, own: str) -> Found:
    """Name a file's frame of reference as the de-identified copy of its CT does, if this is it."""
    named = result.frame_of_reference
    if not named or not own or named == own:
        return result
    new = UidMap(installation_key()).new
    drawn_on = result.drawn_on | {new(uid) for uid in result.drawn_on}
    frame = own if new(named) == own else named
    return replace(result, frame_of_reference=frame, drawn_on=drawn_on)


def _grid(size: tuple[int, int, int], affine_mm: tuple[float, ...], frame: str) -> Volume:
    """Return a CT of this grid, whose values are nowhere: structures are placed by geometry."""
    values = np.broadcast_to(np.int16(0), size[::-1])
    series = Series(
        "",
        "CT",
        "",
        size,
        None,
        None,
        None,
        True,
        "",
        (),
        "",
        frame,
        windows=(),
    )
    return Volume(values, np.array(affine_mm, np.float64).reshape(4, 4), series)


def _read(path: Path, volume: Volume, own: frozenset[str]) -> Found:
    if path.exists() and not path.is_file():  # opening a pipe would wait for ever
        raise StructureFileError(sentence("{path_name} is not a regular file", path_name=path.name))
    try:
        with path.open("rb") as file:
            head = file.read(352)
    except OSError as error:
        raise StructureFileError(
            sentence(
                "{path} cannot be read: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    if head[:4] == b"NRRD":
        from app.imaging.structures.seg_nrrd import read_nrrd

        return read_nrrd(path)
    if (
        head[:2] == b"\x1f\x8b"
        or head[344:348] in _NIFTI
        or head[:4]
        in (
            b"\x5c\x01\0\0",
            b"\0\0\x01\x5c",
            b"\x1c\x02\0\0",
            b"\0\0\x02\x1c",
        )
    ):
        return read_labels(path)
    if head[128:132] != b"DICM" and not starts_like_dicom(head):
        raise _unknown(path, sentence("no file of structures"))
    return _read_dicom(path, volume, own)


def _read_dicom(path: Path, volume: Volume, own: frozenset[str]) -> Found:
    from pydicom import dcmread

    try:
        dataset: Any = dcmread(path, force=True)
        kind, name = str(dataset.get("SOPClassUID", "")), str(dataset.get("Modality", ""))
    except MemoryError:
        raise
    except Exception as error:  # pydicom raises whatever the bytes lead it to
        raise StructureFileError(
            sentence(
                "{path_name} cannot be read ({brief})", path_name=path.name, brief=brief(error)
            )
        ) from error
    if kind in (SEG, LABEL_SEG):
        from app.imaging.structures.seg_reading import read_seg

        return read_seg(dataset, path, volume, own)
    if kind == RTSTRUCT:
        from app.imaging.structures.rtstruct import read_rtstruct

        return read_rtstruct(dataset, path, volume)
    what = f"a DICOM file of modality {name[:16]} ({_class_name(kind)})"
    raise _unknown(path, what if kind else sentence("no structures"))


def _class_name(uid: str) -> str:
    """Name of a SOP class; one that the standard does not know is not repeated."""
    from pydicom import config
    from pydicom.uid import UID

    name = UID(uid, config.IGNORE).name
    return sentence("of an unknown SOP class") if name == uid else name


def _unknown(path: Path, what: str) -> StructureFileError:
    return StructureFileError(
        sentence(
            "{path_name} is {found_format}; DICOM SEG, RTSTRUCT, .seg.nrrd and NIfTI labels are "
            "read",
            path_name=path.name,
            found_format=what,
        )
    )
