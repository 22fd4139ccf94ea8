"""Files of structures, read in the worker process; what a file is, its content says.

Label maps as NIfTI files: each whole number above 0 is a structure. Structures of radiotherapy, RT
Structure Set (PS3.3 C.8.8.6): contours on planes; voxels inside closed lines are found by the
even-odd rule: holes, islands in them, and keyholes.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.progress import Progress
from app.imaging.errors import brief
from app.imaging.header_reading import starts_like_dicom
from app.imaging.series import Series
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.extras import extra
from app.imaging.structures.placing import Found, Labelled, place
from app.imaging.structures.structure import (
    Colour,
    PlacedStructure,
    PlacedStructures,
    StructureKind,
)
from app.imaging.volume import Volume


def even_odd(lines: Sequence[FloatArray], shape: tuple[int, int]) -> NDArray[np.bool_]:
    """Which pixel centres lie inside an odd number of lines.

    A contour inside another one is a hole, one inside that an island; a keyhole (one line that runs
    in to the hole through a channel and back again) gives the same, since the channel has no width.

    Args:
        lines: closed lines of points (column, row) as floats, each of shape (n, 2); the last point
            is joined to the first.
        shape: rows and columns of the picture.

    Returns:
        Shape (rows, columns).
    """
    rows, columns = shape
    toggles = np.zeros((rows, columns + 1), np.uint8)
    for line in lines:
        start, end = line, np.roll(line, -1, axis=0)
        low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
        # rows whose centre lies in [low, high): a corner on a row counts once
        first = np.clip(np.ceil(low), 0, rows).astype(np.intp)
        last = np.clip(np.ceil(high), 0, rows).astype(np.intp)
        count = last - first
        edge = np.repeat(np.arange(len(line)), count)
        row = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + first[edge]
        share = (row - start[edge, 1]) / (end[edge, 1] - start[edge, 1])
        crossing = start[edge, 0] + share * (end[edge, 0] - start[edge, 0])
        column = np.clip(np.ceil(crossing), 0, columns).astype(np.intp)
        np.bitwise_xor.at(toggles, (row, column), 1)
    inside: NDArray[np.bool_] = np.bitwise_xor.accumulate(toggles, axis=1)[:, :-1].astype(bool)
    return inside


CLOSED = ("CLOSED_PLANAR", "CLOSEDPLANAR_XOR")
PLANAR_MM = 0.5
"""A contour whose points lie further than this off one plane is refused."""

LARGEST_CONTOURS = 2**29
"""Most voxels of the box around one region."""

_ONE_PLANE_MM = 0.1
_PARALLEL = 1e-3
_KINDS = {
    "GTV": StructureKind.TARGET,
    "CTV": StructureKind.TARGET,
    "PTV": StructureKind.TARGET,
    "AVOIDANCE": StructureKind.RISK,
}


def read_rtstruct(dataset: Any, path: Path, volume: Volume) -> Found:
    """Read the regions of an RT Structure Set.

    Contours of one plane are taken together by the even-odd rule: one inside another is a hole, as
    is one that is reached through a keyhole. Between planes the nearest one counts.

    Args:
        dataset: the file, read by pydicom.
        path: for messages.
        volume: gives the spacing of the grid on which the contours are filled.

    Raises:
        StructureFileError: if the file is damaged, or holds no closed contour.
    """
    try:
        names = {int(roi.ROINumber): roi for roi in dataset.StructureSetROISequence}
        kinds = {
            int(item.ReferencedROINumber): str(item.get("RTROIInterpretedType", ""))
            for item in dataset.get("RTROIObservationsSequence", ())
        }
        contours = list(dataset.ROIContourSequence)
    except (AttributeError, TypeError, ValueError) as error:
        raise StructureFileError(
            f"{path.name} is no whole RT Structure Set ({brief(error)})"
        ) from error
    found, notes, frames = [], [], set()
    for item in contours:
        try:
            number = int(item.ReferencedROINumber)
            roi = names[number]
            lines, skipped = _lines(item, path)
        except (AttributeError, KeyError, TypeError, ValueError) as error:
            if isinstance(error, StructureFileError):
                raise
            raise StructureFileError(
                f"{path.name}: a region is damaged ({brief(error)})"
            ) from error
        name = str(roi.get("ROIName", "")) or f"region {number}"
        if skipped:
            notes.append(f"{name}: {skipped} contours that are not closed were left out")
        if not lines:
            continue
        mask, affine = _filled(lines, volume, f"{path.name}, {name}")
        frames.add(str(roi.get("ReferencedFrameOfReferenceUID", "")))
        kind = _KINDS.get(kinds.get(number, ""))
        found.append(Labelled(name, mask, affine, kind, _colour(item)))
    if not found:
        raise StructureFileError(f"{path.name} holds no closed contour")
    if len(frames) > 1:
        raise StructureFileError(f"{path.name} mixes regions of {len(frames)} frames of reference")
    return Found(found, len(found), frames.pop(), tuple(notes))


def _lines(item: Any, path: Path) -> tuple[list[FloatArray], int]:
    """Return closed contours in LPS [mm], each of shape (n, 3), and how many others there were."""
    lines, skipped = [], 0
    for contour in item.get("ContourSequence", ()):
        if str(contour.get("ContourGeometricType", "")) not in CLOSED:
            skipped += 1
            continue
        values = np.array([float(value) for value in contour.ContourData], np.float64)
        if values.size < 9 or values.size % 3 or not np.isfinite(values).all():
            raise StructureFileError(
                f"{path.name}: a contour of {values.size} numbers; three points or more are needed"
            )
        lines.append(values.reshape(-1, 3))
    return lines, skipped


def _colour(item: Any) -> Colour | None:
    try:
        r, g, b = (min(255, max(0, int(value))) for value in item.ROIDisplayColor)
    except (AttributeError, TypeError, ValueError):
        return None
    return r, g, b


def _normal(lines: list[FloatArray], what: str) -> FloatArray:
    """Return the normal of the planes, by Newell's rule over all contours."""
    total = np.zeros(3)
    for line in lines:
        centred = line - line.mean(axis=0)
        area = np.cross(centred, np.roll(centred, -1, axis=0)).sum(axis=0)
        total += area if area @ total >= 0.0 else -area
    length = float(np.linalg.norm(total))
    if length < 1e-6:
        raise StructureFileError(f"{what}: its contours enclose no area")
    normal: FloatArray = total / length
    return normal


def _filled(lines: list[FloatArray], volume: Volume, what: str) -> tuple[Any, FloatArray]:
    """Mask and affine of a grid whose slices are the planes of the contours."""
    normal = _normal(lines, what)
    i, j, k = volume.affine_mm[:3, :3].T
    own = np.cross(i, j) / np.linalg.norm(np.cross(i, j))
    if np.linalg.norm(np.cross(own, normal)) < _PARALLEL:  # on slices of the CT, as usual
        normal = own if own @ k > 0.0 else -own
        origin, frame = volume.origin_mm, np.column_stack([i, j, k])
    else:
        side = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
        side /= np.linalg.norm(side)
        pixel = float(volume.spacing_mm.min())
        origin = lines[0][0]
        frame = np.column_stack([pixel * side, pixel * np.cross(normal, side), normal])
    back = np.linalg.inv(frame)
    places = [(line - origin) @ back.T for line in lines]
    step_mm = abs(float(frame[:, 2] @ normal))
    heights = np.array([line[:, 2].mean() for line in places])
    for line in places:
        if np.ptp(line[:, 2]) * step_mm > 2.0 * PLANAR_MM:
            raise StructureFileError(f"{what}: a contour is not flat")
    planes = _planes(heights, _ONE_PLANE_MM / step_mm)
    gap = float(np.median(np.diff(planes))) if len(planes) > 1 else 1.0
    low = np.floor(np.min([p[:, :2].min(axis=0) for p in places], axis=0)).astype(int) - 1
    high = np.ceil(np.max([p[:, :2].max(axis=0) for p in places], axis=0)).astype(int) + 2
    shape = (int(high[1] - low[1]), int(high[0] - low[0]))
    if shape[0] * shape[1] > 2**25:
        raise StructureFileError(f"{what}: contours over {shape[1]} × {shape[0]} voxels")
    reach = max(gap, 1.0) / 2 + 1e-6  # a CT coarser than the contours keeps its nearest one
    first, last = int(np.ceil(planes[0] - reach)), int(np.floor(planes[-1] + reach))
    if (last - first + 1) * shape[0] * shape[1] > LARGEST_CONTOURS:
        raise StructureFileError(f"{what}: contours over {last - first + 1} slices")
    pictures = [
        even_odd(
            [
                p[:, :2] - low
                for p, h in zip(places, heights, strict=True)
                if abs(h - plane) * step_mm <= _ONE_PLANE_MM
            ],
            shape,
        )
        for plane in planes
    ]
    mask = np.zeros((last - first + 1, *shape), bool)
    for number in range(len(mask)):
        nearest = int(np.argmin(np.abs(planes - (first + number))))
        if abs(planes[nearest] - (first + number)) <= reach:
            mask[number] = pictures[nearest]
    affine = np.eye(4)
    affine[:3, :3] = frame
    affine[:3, 3] = origin + frame @ [low[0], low[1], first]
    return mask, affine


def _planes(heights: FloatArray, tolerance: float) -> FloatArray:
    """Heights of the planes, ascending; contours nearer than the tolerance share one."""
    ordered = np.sort(heights)
    new = np.concatenate([[True], np.diff(ordered) > tolerance])
    planes: FloatArray = ordered[new]
    return planes


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
            raise StructureFileError(f"{path.name} has sizes {image.shape}; three are read")
        values = np.asanyarray(image.dataobj).reshape(shape)
    except (StructureFileError, MemoryError):
        raise
    except Exception as error:  # nibabel raises whatever the bytes lead it to
        what = brief(error)
        raise StructureFileError(f"{path.name} cannot be read as NIfTI ({what})") from error
    exact = values.dtype.kind in "iub"
    if not exact and (not np.isfinite(values).all() or (np.rint(values) != values).any()):
        raise StructureFileError(f"{path.name} holds fractions; a label map holds whole numbers")
    labels = [int(label) for label in np.unique(values) if label > 0]
    if not labels or len(labels) > MOST_LABELS:
        raise StructureFileError(
            f"{path.name} holds {len(labels)} labels above 0; a label map holds 1 to {MOST_LABELS}"
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
        raise StructureFileError(f"{path.name} is {type(image).__name__}, not NIfTI")
    sform, s_code = header.get_sform(coded=True)
    qform, q_code = header.get_qform(coded=True)
    if not s_code and not q_code:
        raise StructureFileError(
            f"{path.name} does not say where it lies (neither sform nor qform is set)"
        )
    unit = _UNITS_MM[header.get_xyzt_units()[0]]
    affine = np.array(sform if s_code else qform, np.float64)
    affine[:3] *= unit
    affine[:2] *= -1.0  # RAS -> LPS
    if not np.isfinite(affine).all() or abs(np.linalg.det(affine[:3, :3])) < 1e-9:
        raise StructureFileError(f"{path.name}: its axes span no volume")
    return affine


SEG, RTSTRUCT = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.481.3"
LABEL_SEG = "1.2.840.10008.5.1.4.1.1.66.7"

_NIFTI = (b"n+1\0", b"ni1\0")


def parse_structures(
    path: Path,
    size: tuple[int, int, int],
    affine_mm: tuple[float, ...],
    frame_of_reference: str,
    progress: Progress,
) -> PlacedStructures:
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
    return PlacedStructures(
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
        from app.imaging.structures.parsing import read_rtstruct

        return read_rtstruct(dataset, path, volume)
    raise _unknown(path, f"a DICOM file of modality {name[:16]}" if kind else "no structures")


def _unknown(path: Path, what: str) -> StructureFileError:
    return StructureFileError(
        f"{path.name} is {what}; DICOM SEG, RTSTRUCT, .seg.nrrd and NIfTI labels are read"
    )
