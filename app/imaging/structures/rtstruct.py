"""Structures of radiotherapy, RT Structure Set (PS3.3 C.8.8.6): contours on planes.

Voxels inside closed lines are found by the even-odd rule: holes, islands in them, and keyholes.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.errors import brief
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.placing import Found, Labelled
from app.imaging.structures.structure import Colour, StructureKind
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

LARGEST = 2**29
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
    heights = np.array([place[:, 2].mean() for place in places])
    for place in places:
        if np.ptp(place[:, 2]) * step_mm > 2.0 * PLANAR_MM:
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
    if (last - first + 1) * shape[0] * shape[1] > LARGEST:
        raise StructureFileError(f"{what}: contours over {last - first + 1} slices")
    pictures = [
        even_odd([p[:, :2] - low for p, h in zip(places, heights, strict=True)
                  if abs(h - plane) * step_mm <= _ONE_PLANE_MM], shape)
        for plane in planes
    ]  # fmt: skip
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
