"""RT Structure Set (PS3.3 A.19): outlines of structures slice by slice, and the plan's points.

Outlines run half-way between voxels inside and outside. A hole is joined to the outline around it
by a channel of no width (a keyhole, C.8.8.6.3), which every reader of closed contours understands.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.uid import UID, ExplicitVRLittleEndian, RTStructureSetStorage

from app.core.arrays import FloatArray
from app.imaging.results.attempt_facts import AttemptFacts, Point
from app.imaging.structures.structure import PlacedStructure, StructureKind, outlines

Line = tuple[int | None, str, FloatArray]
"""Slice, type and points, LPS [mm], shape (n, 3), of a contour."""

_COPIED: Final = (
    *("PatientName", "PatientID", "PatientBirthDate", "PatientSex"),
    *("StudyInstanceUID", "StudyDate", "StudyTime", "StudyID", "AccessionNumber"),
    *("ReferringPhysicianName", "FrameOfReferenceUID", "PositionReferenceIndicator"),
)
_TYPES: Final = {
    StructureKind.RISK: "AVOIDANCE",
    StructureKind.VESSEL: "AVOIDANCE",
    StructureKind.BONE: "AVOIDANCE",
    StructureKind.TARGET: "GTV",
    StructureKind.OTHER: "ORGAN",
}
_POINT_COLOURS: Final = {"Entry": (0, 158, 115), "Target": (230, 159, 0), "Tip": (213, 94, 0)}


def structure_set(
    headers: Sequence[Any],
    attempt: AttemptFacts,
    structures: Sequence[PlacedStructure],
    affine_mm: FloatArray,
) -> FileDataset:
    """Return the structure set.

    Args:
        headers: of the CT's files, one for each slice, in their order.
        attempt: what is told of it.
        structures: on the CT's grid.
        affine_mm: voxel (i, j, k) -> LPS [mm], shape (4, 4).
    """
    first = headers[0]
    uid = UID(attempt.uid("RTSTRUCT", first.SeriesInstanceUID))
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = RTStructureSetStorage, uid
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    found = FileDataset("", {}, file_meta=meta, preamble=b"\0" * 128)
    for name in _COPIED:
        setattr(found, name, first.get(name, ""))
    found.SOPClassUID, found.SOPInstanceUID = RTStructureSetStorage, uid
    found.SpecificCharacterSet, found.Modality = "ISO_IR 192", "RTSTRUCT"
    found.SeriesInstanceUID = attempt.uid("RTSTRUCT series", first.SeriesInstanceUID)
    found.SeriesNumber, found.InstanceNumber, found.OperatorsName = "301", "1", ""
    found.Manufacturer, found.ManufacturerModelName = "Acus", "Acus trainer"
    found.SoftwareVersions, found.DeviceSerialNumber = "1", "0"
    found.StructureSetLabel, found.StructureSetName = "ACUS PLAN", attempt.title[:64]
    found.StructureSetDate, found.StructureSetTime = attempt.moment[:8], attempt.moment[8:]
    found.ApprovalStatus = "UNAPPROVED"
    found.ReferencedFrameOfReferenceSequence = [_referenced(headers)]
    parts: list[tuple[str, Sequence[int], str, list[Line]]] = []
    for one in structures:
        parts.append((one.name, one.colour, _TYPES[one.kind], list(_lines(one, affine_mm))))
    for name, point in attempt.points.items():
        parts.append((name, _POINT_COLOURS[name], "MARKER", [(None, "POINT", np.array([point]))]))
    sequences: tuple[list[Dataset], list[Dataset], list[Dataset]] = ([], [], [])
    for number, (name, colour, kind, lines) in enumerate(parts, start=1):
        told_of = (number, name, colour, kind, found.FrameOfReferenceUID)
        for items, item in zip(sequences, _items(headers, told_of, lines), strict=True):
            items.append(item)
    found.StructureSetROISequence, found.ROIContourSequence = sequences[0], sequences[1]
    found.RTROIObservationsSequence = sequences[2]
    return found


def _referenced(headers: Sequence[Any]) -> Dataset:
    """Return which pictures the contours lie on (C.8.8.5)."""
    frame, study, series = Dataset(), Dataset(), Dataset()
    series.SeriesInstanceUID = headers[0].SeriesInstanceUID
    series.ContourImageSequence = [_image(header) for header in headers]
    study.ReferencedSOPClassUID = "1.2.840.10008.3.1.2.3.1"  # retired, and asked for all the same
    study.ReferencedSOPInstanceUID = headers[0].StudyInstanceUID
    study.RTReferencedSeriesSequence = [series]
    frame.FrameOfReferenceUID = headers[0].FrameOfReferenceUID
    frame.RTReferencedStudySequence = [study]
    return frame


def _image(header: Any) -> Dataset:
    item = Dataset()
    item.ReferencedSOPClassUID = header.SOPClassUID
    item.ReferencedSOPInstanceUID = header.SOPInstanceUID
    return item


def _lines(structure: PlacedStructure, affine_mm: FloatArray) -> Iterator[Line]:
    """Give each outline of a structure."""
    i, j, k = structure.corner
    for number, layer in enumerate(structure.mask):
        for ring in rings(layer):
            ijk = np.column_stack([ring + np.array([i, j]), np.full(len(ring), k + number)])
            yield k + number, "CLOSED_PLANAR", ijk @ affine_mm[:3, :3].T + affine_mm[:3, 3]


def rings(layer: NDArray[np.bool_]) -> Iterator[FloatArray]:
    """Give a line around each part of a layer, its holes joined to it by keyholes.

    Args:
        layer: shape (rows, columns).

    Returns:
        Lines of points (column, row), each of shape (n, 2), the last joined to the first.
    """
    from scipy.ndimage import label

    parts, count = label(layer)  # neighbours across a corner are apart, as for `outlines`
    for number in range(1, count + 1):
        lines = outlines(parts == number)
        areas = [abs(_area(line)) for line in lines]
        whole = lines.pop(int(np.argmax(areas)))
        while lines:
            whole = _joined(whole, lines)
        yield whole


def _area(line: FloatArray) -> float:
    x, y = line.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def _joined(whole: FloatArray, holes: list[FloatArray]) -> FloatArray:
    """Join the hole that is nearest, at the nearest points: that channel crosses no other hole."""
    from scipy.spatial import KDTree

    tree = KDTree(whole)
    found = [tree.query(hole) for hole in holes]
    which = int(np.argmin([distance.min() for distance, _ in found]))
    distance, places = found[which]
    hole, there = holes.pop(which), int(np.argmin(distance))
    here = int(places[there])
    around = np.roll(hole, -there, axis=0)
    return np.concatenate([whole[: here + 1], around, around[:1], whole[here:]])


def _items(
    headers: Sequence[Any],
    told_of: tuple[int, str, Sequence[int], str, str],
    lines: Sequence[Line],
) -> tuple[Dataset, Dataset, Dataset]:
    """Return what a region is called, its contours, and what it means."""
    number, name, colour, kind, frame = told_of
    called, drawn, meant = Dataset(), Dataset(), Dataset()
    called.ROINumber, called.ROIName = str(number), name
    called.ReferencedFrameOfReferenceUID, called.ROIGenerationAlgorithm = frame, "MANUAL"
    drawn.ReferencedROINumber, drawn.ROIDisplayColor = str(number), [str(c) for c in colour]
    drawn.ContourSequence = [_contour(headers, *line) for line in lines]
    meant.ObservationNumber = meant.ReferencedROINumber = str(number)
    meant.RTROIInterpretedType, meant.ROIInterpreter = kind, ""
    return called, drawn, meant


def _contour(headers: Sequence[Any], k: int | None, kind: str, points: FloatArray) -> Dataset:
    item = Dataset()
    if k is not None:
        item.ContourImageSequence = [_image(headers[k])]
    item.ContourGeometricType, item.NumberOfContourPoints = kind, str(len(points))
    item.ContourData = [decimal(value) for value in points.ravel()]
    return item


def decimal(value: float) -> str:
    """Return a decimal string of at most 16 characters (PS3.5 6.2), to 1e-6 mm."""
    return f"{value:.6f}".rstrip("0").rstrip(".")


def nearest_slice(point: Point, affine_mm: FloatArray) -> tuple[FloatArray, int]:
    """Return a point in voxels (i, j, k), and the slice that is nearest to it."""
    ijk = np.linalg.inv(affine_mm)[:3] @ np.array([*point, 1.0])
    return ijk, int(np.rint(ijk[2]))
