"""Structures of radiotherapy: RT Structure Set (PS3.3 C.8.8.5, C.8.8.6), contours on planes.

What is good in a file is read, and what is not is named: a contour of two points leaves the region
that it belongs to, and the other regions, as they are.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import counted, sentence
from app.imaging.elements import FURTHEST_MM
from app.imaging.errors import brief
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.placing import Found, Labelled
from app.imaging.structures.regions import ContourRegion, Layers, newell, usual_gap
from app.imaging.structures.structure import Colour, StructureKind
from app.imaging.volume import Volume

CLOSED, CLOSED_XOR = "CLOSED_PLANAR", "CLOSEDPLANAR_XOR"
OPEN = ("POINT", "OPEN_PLANAR", "OPEN_NONPLANAR")

_LEAST_AREA_MM2 = 1e-4
_KINDS = {
    "GTV": StructureKind.TARGET,
    "CTV": StructureKind.TARGET,
    "PTV": StructureKind.TARGET,
    "AVOIDANCE": StructureKind.RISK,
}


def read_rtstruct(dataset: Any, path: Path, volume: Volume) -> Found:
    """Read the regions of an RT Structure Set.

    Args:
        dataset: the file, read by pydicom.
        path: for messages.
        volume: gives the grid on which contours are filled, and the frame of reference.

    Raises:
        StructureFileError: if the file is damaged, or holds no closed contour that can be used.
    """
    regions, notes = _regions(dataset, path)
    regions, told = _of_one_frame(regions, volume.series.frame_of_reference)
    notes += told
    layers = []
    for region in regions:
        try:
            layer = Layers.of(region, volume)
        except StructureFileError as error:
            notes.append(f"{region.name} was left out: {error}")
            layer = None
        notes += region.notes()
        if layer is not None:
            layers.append((region, layer))
    usual = usual_gap([layer for _, layer in layers])
    found = []
    for region, layer in layers:
        try:
            mask, affine, said = layer.filled(usual)
        except StructureFileError as error:
            notes.append(f"{region.name} was left out: {error}")
            continue
        notes += [f"{region.name}: {text}" for text in said]
        found.append(Labelled(region.name, mask, affine, region.kind, region.colour))
    if not found:
        why = f" ({'; '.join(notes)})" if notes else ""
        raise StructureFileError(
            sentence(
                "{path_name} holds no closed contour that can be used{reason}",
                path_name=path.name,
                reason=why,
            )
        )
    return Found(found, len(found), regions[0].frame, tuple(notes), _named_images(dataset))


def _regions(dataset: Any, path: Path) -> tuple[list[ContourRegion], list[str]]:
    """Return the regions that have a name and contours, and what was left out."""
    known, notes = _declared(dataset, path)
    drawn: dict[int, ContourRegion] = {}
    strange: Counter[str] = Counter()
    for item in _needed(dataset, "ROIContourSequence", path):
        number = _number(item, "ReferencedROINumber")
        if number is None or number not in known:
            strange["without a number" if number is None else f"number {number}"] += 1
            continue
        region = drawn.setdefault(number, known[number])
        region.colour = region.colour or _colour(item)
        _take_contours(item, region)
    for what, count in strange.items():
        notes.append(
            counted(
                "{n} region {reason} left out: the file does not say what it is",
                "{n} regions {reason} left out: the file does not say what it is",
                count,
                reason=what,
            )
        )
    bare = [region.name for number, region in known.items() if number not in drawn]
    if bare:
        notes.append(f"without contours: {', '.join(bare)}")
    return list(drawn.values()), notes


def _declared(dataset: Any, path: Path) -> tuple[dict[int, ContourRegion], list[str]]:
    """Return the regions that the file declares by number, without contours."""
    items = _needed(dataset, "StructureSetROISequence", path)
    kinds = {}
    for item in _items(dataset, "RTROIObservationsSequence"):
        number = _number(item, "ReferencedROINumber")
        if number is not None:
            kinds[number] = _KINDS.get(_text(item, "RTROIInterpretedType"))
    general = _general_frame(dataset)
    known: dict[int, ContourRegion] = {}
    notes = []
    for item in items:
        number = _number(item, "ROINumber")
        name = _text(item, "ROIName") or f"region {number}"
        if number is None or number in known:
            what = "has no number" if number is None else f"has the number {number} of another one"
            notes.append(f"{name} {what}: left out")
            continue
        frame = _text(item, "ReferencedFrameOfReferenceUID") or general
        known[number] = ContourRegion(name, None, kinds.get(number), frame)
    return known, notes


def _needed(dataset: Any, keyword: str, path: Path) -> list[Any]:
    """Return the items of a sequence that must be there."""
    try:
        return [item for item in getattr(dataset, keyword) if hasattr(item, "get")]
    except MemoryError:
        raise
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        raise StructureFileError(
            sentence(
                "{path_name} is no whole RT Structure Set ({brief})",
                path_name=path.name,
                brief=brief(error),
            )
        ) from error


def _general_frame(dataset: Any) -> str:
    for item in _items(dataset, "ReferencedFrameOfReferenceSequence"):
        if frame := _text(item, "FrameOfReferenceUID"):
            return frame
    return _text(dataset, "FrameOfReferenceUID")


def _items(dataset: Any, keyword: str) -> list[Any]:
    """Return the items of a sequence; none where it is absent or no sequence."""
    try:
        return [item for item in dataset.get(keyword) or () if hasattr(item, "get")]
    except Exception:  # hostile bytes make the parser raise nearly anything
        return []


def _text(item: Any, keyword: str) -> str:
    try:
        return str(item.get(keyword) or "").strip()
    except Exception:  # as above
        return ""


def _number(item: Any, keyword: str) -> int | None:
    try:
        return int(item[keyword].value)
    except Exception:  # as above
        return None


def _colour(item: Any) -> Colour | None:
    try:
        r, g, b = (min(255, max(0, int(value))) for value in item.ROIDisplayColor)
    except Exception:  # as above
        return None
    return r, g, b


def _take_contours(item: Any, region: ContourRegion) -> None:
    """Sort the contours of an item into usable ones and others."""
    for contour in _items(item, "ContourSequence"):
        kind = _text(contour, "ContourGeometricType")
        if kind not in (CLOSED, CLOSED_XOR):
            region.left_out[f"of type {kind}" if kind in OPEN else "of an unknown type"] += 1
            continue
        line = _line(contour, region.left_out)
        if line is not None:
            region.lines.append(line)
            region.odd.append(kind == CLOSED_XOR)


def _line(contour: Any, left_out: Counter[str]) -> FloatArray | None:
    """Return the points of a contour, LPS [mm], shape (n, 3); None, and why, if it is unusable."""
    try:
        data = contour["ContourData"].value
        data = [] if data is None else [data] if isinstance(data, float | str) else list(data)
        values = np.array([float(value) for value in data], np.float64)
    except Exception:  # not there, or no numbers; pydicom raises whatever the bytes lead it to
        left_out["whose coordinates cannot be read"] += 1
        return None
    if values.size % 3:
        left_out[f"of {values.size} numbers, which are no whole points,"] += 1
    elif values.size < 9:
        points = values.size // 3
        left_out[f"of {points} point{'' if points == 1 else 's'}"] += 1
    elif not np.isfinite(values).all() or np.abs(values).max() > FURTHEST_MM:
        left_out["with coordinates that are no places"] += 1
    elif np.linalg.norm(newell(values.reshape(-1, 3))) < 2.0 * _LEAST_AREA_MM2:
        left_out["that enclose no area"] += 1
    else:
        return values.reshape(-1, 3)
    return None


def _of_one_frame(regions: list[ContourRegion], own: str) -> tuple[list[ContourRegion], list[str]]:
    """Keep the regions of the CT's frame of reference where the file mixes several."""
    frames = list(dict.fromkeys(region.frame for region in regions if region.lines))
    if len(frames) < 2:
        return regions, []
    kept = own if own in frames else frames[0]
    others = [region.name for region in regions if region.frame != kept and region.lines]
    note = f"drawn on another frame of reference, left out: {', '.join(others)}"
    return [region for region in regions if region.frame == kept], [note]


def _named_images(dataset: Any) -> frozenset[str]:
    """UIDs of the series and images that the contours were drawn on, as far as the file says."""
    uids: set[str] = set()
    for frame in _items(dataset, "ReferencedFrameOfReferenceSequence"):
        for study in _items(frame, "RTReferencedStudySequence"):
            for series in _items(study, "RTReferencedSeriesSequence"):
                uids.add(_text(series, "SeriesInstanceUID"))
                uids.update(_images(series))
    for item in _items(dataset, "ROIContourSequence"):
        for contour in _items(item, "ContourSequence"):
            uids.update(_images(contour))
    return frozenset(uids - {""})


def _images(item: Any) -> Iterator[str]:
    for image in _items(item, "ContourImageSequence"):
        yield _text(image, "ReferencedSOPInstanceUID")
