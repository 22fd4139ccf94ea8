"""Frames of a DICOM Segmentation (PS3.3 C.8.20), each at the place that it names itself.

A frame is one segment (or, in a label map, all of them) in one plane. How thick a plane is, a file
says in several ways that contradict each other in practice; the frames' own places come first.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.imaging.elements import FURTHEST_MM
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.structure import Mask
from app.imaging.volume import Volume

LARGEST_BOX = 2**31
"""Most voxels of the box around one segment."""

_ON_VOXELS = 0.1
"""Frames whose pixels lie this near to voxels of the CT [voxels] are taken voxel for voxel."""

_THICKER = 1.5
_LAYER = 0.05
_STRAIGHT_MM = 0.1
_SAME_TURN = 1e-4

Pixels = NDArray[np.int32]
"""Numbers of pixels of a frame, row by row."""
Part = tuple[Mask, FloatArray]


@dataclass(frozen=True, slots=True, eq=False)
class SegFrame:
    """Place of one frame.

    Attributes:
        index: in the file, from 0.
        segment: its number; None in a label map.
        position_mm: centre of the first pixel, LPS.
        turn: direction of growing column index, then of growing row index, shape (3, 2).
        pixel_mm: distance of columns, then of rows.
        between_mm, thickness_mm: SpacingBetweenSlices and SliceThickness; None where absent.
    """

    index: int
    segment: int | None
    position_mm: FloatArray
    turn: FloatArray
    pixel_mm: tuple[float, float]
    between_mm: float | None
    thickness_mm: float | None

    @property
    def steps_mm(self) -> FloatArray:
        """Step along columns, and along rows, shape (3, 2)."""
        return self.turn * np.asarray(self.pixel_mm)

    @property
    def normal(self) -> FloatArray:
        """Unit vector across the frame."""
        return np.cross(self.turn[:, 0], self.turn[:, 1])


def frames_of(dataset: Any, count: int, labels: bool) -> tuple[list[SegFrame], Counter[str]]:
    """Return the frames that say where they lie, and why others were left out.

    Args:
        dataset: the file.
        count: frames that it has.
        labels: whether it is a label map, whose frames belong to no segment.
    """
    shared = _first(dataset, "SharedFunctionalGroupsSequence")
    items = list(dataset.get("PerFrameFunctionalGroupsSequence") or ())
    numbers = {int(item.SegmentNumber) for item in dataset.SegmentSequence}
    frames, left_out = [], Counter[str]()
    for index in range(count):
        item = items[index] if index < len(items) else None
        groups = [group for group in (item, shared) if group is not None]
        try:
            frame = _frame(index, groups, numbers, labels)
        except (AttributeError, IndexError, KeyError, TypeError, ValueError):
            left_out["without a place"] += 1
            continue
        if frame.segment is not None and frame.segment not in numbers:
            left_out[f"of a segment {frame.segment} that the file does not describe"] += 1
        else:
            frames.append(frame)
    return frames, left_out


def _first(item: Any, keyword: str) -> Any:
    found = item.get(keyword)
    return found[0] if found else None


def _group(groups: Iterable[Any], keyword: str) -> Any:
    """Functional group of a frame: its own comes before the one that all share."""
    return next((g for g in (_first(group, keyword) for group in groups) if g is not None), None)


def _frame(index: int, groups: Sequence[Any], numbers: set[int], labels: bool) -> SegFrame:
    measures = _group(groups, "PixelMeasuresSequence")
    place = _group(groups, "PlanePositionSequence")
    position = np.array([float(v) for v in place.ImagePositionPatient])
    cosines = _group(groups, "PlaneOrientationSequence").ImageOrientationPatient
    turn = np.array([float(v) for v in cosines]).reshape(2, 3).T
    row, column = (float(v) for v in measures.PixelSpacing)
    lengths = np.linalg.norm(turn, axis=0)
    if position.shape != (3,) or not (
        np.abs(position).max() < FURTHEST_MM  # NaN is not
        and np.abs(lengths - 1.0).max() < 0.01
        and abs(float(turn[:, 0] @ turn[:, 1])) < 0.01
        and 0.0 < min(row, column) < max(row, column) + 1.0 < 1e4
    ):
        raise ValueError
    identity = _group(groups, "SegmentIdentificationSequence")
    segment = None
    if not labels:
        alone = identity is None and len(numbers) == 1
        segment = next(iter(numbers)) if alone else int(identity.ReferencedSegmentNumber)
    between, thick = (_length(measures, k) for k in ("SpacingBetweenSlices", "SliceThickness"))
    return SegFrame(index, segment, position, turn / lengths, (column, row), between, thick)


def _length(measures: Any, keyword: str) -> float | None:
    value = measures.get(keyword)
    return None if value in (None, "") else float(value)


@dataclass(frozen=True, slots=True, eq=False)
class FrameStack:
    """Frames that lie on one another, and how thick each is.

    Attributes:
        frames: numbers of the frames.
        start_mm: first pixel of the lowest one, LPS.
        axes: steps along columns, rows and layers [mm], shape (3, 3).
        layers: for each frame, the layers that it fills: the first, and how many.
    """

    frames: tuple[int, ...]
    start_mm: FloatArray
    axes: FloatArray
    layers: dict[int, tuple[int, int]]


def on_voxels(frames: Sequence[SegFrame], size: tuple[int, int], volume: Volume) -> bool:
    """Tell whether every pixel of every frame is one voxel of the CT.

    Args:
        frames: of the file.
        size: columns and rows.
        volume: the CT.
    """
    ends = np.array([(0, 0), (size[0] - 1, 0), (0, size[1] - 1), (size[0] - 1, size[1] - 1)])
    for frame in frames:
        steps, start = _in_voxels(frame, volume)
        whole = np.rint(steps)
        units = (
            np.abs(whole).sum(axis=0).tolist() == [1.0, 1.0]
            and not (np.abs(whole).sum(axis=1) > 1.0).any()
        )
        if not units:
            return False
        off = ends @ (steps - whole).T + start - np.rint(start)
        if np.abs(off).max() > _ON_VOXELS:
            return False
    return True


def _in_voxels(frame: SegFrame, volume: Volume) -> tuple[FloatArray, FloatArray]:
    """Return steps along columns and rows, and the first pixel, in voxels of a CT."""
    inverse = volume.inverse_mm
    start: FloatArray = inverse[:3, :3] @ frame.position_mm + inverse[:3, 3]
    return inverse[:3, :3] @ frame.steps_mm, start


def thickness_mm(frames: Sequence[SegFrame], volume: Volume) -> float:
    """Return how thick a frame is: no thicker than frames lie apart [mm].

    SpacingBetweenSlices where frames lie whole numbers of it apart; else their distance, where it
    is nearly always the same; else SliceThickness; else the distance of the CT's slices.
    """
    gaps = _gaps(frames)
    least = float(gaps.min()) if len(gaps) else np.inf
    between, thick = frames[0].between_mm, frames[0].thickness_mm
    if between is not None and between > 0.0:
        counts = gaps / between
        if (np.abs(counts - np.rint(counts)) <= 0.1).all() and least > 0.5 * between:
            return between
    if len(gaps) > 1 and (gaps <= 1.1 * least).mean() > 0.5:
        return float(np.median(gaps[gaps <= 1.1 * least]))
    if thick is not None and thick > 0.0:
        return min(thick, least)
    return min(float(volume.spacing_mm[2]), least)


def spacing_note(frames: Sequence[SegFrame]) -> str:
    """Say that a file's SpacingBetweenSlices contradicts its frames; empty where it does not."""
    between, gaps = frames[0].between_mm, _gaps(frames)
    if between is None or not len(gaps):
        return ""
    counts = gaps / between if between > 0.0 else np.array([0.5])
    if (np.abs(counts - np.rint(counts)) <= 0.1).all() and counts.min() > 0.5:
        return ""
    return sentence(
        "its SpacingBetweenSlices ({between:g} mm) contradicts its frames (at least "
        "{least_gap_mm:.3g} mm apart): each frame was placed where it says itself",
        between=between,
        least_gap_mm=gaps.min(),
    )


def _gaps(frames: Sequence[SegFrame]) -> FloatArray:
    """Distances of neighbouring planes [mm], of frames that are parallel to the first."""
    normal = frames[0].normal
    parallel = [f for f in frames if np.abs(f.normal - normal).max() < 1e-2]
    heights = np.sort([float(f.position_mm @ normal) for f in parallel])
    gaps = np.diff(heights)
    result: FloatArray = gaps[gaps > 0.02]
    return result


def is_thin(frames: Sequence[SegFrame], volume: Volume) -> bool:
    """Tell whether frames are no thicker than the CT's slices that they lie on."""
    axis = int(np.argmin(np.abs(np.rint(_in_voxels(frames[0], volume)[0])).sum(axis=1)))
    step = volume.affine_mm[:3, axis] @ frames[0].normal
    return thickness_mm(frames, volume) <= _THICKER * abs(float(step))


def stacks_of(frames: Sequence[SegFrame], volume: Volume) -> list[FrameStack]:
    """Part frames into stacks: same turn and pixels, and starts on one straight line."""
    groups: list[list[SegFrame]] = []
    for frame in frames:
        for group in groups:
            if _alike(group[0], frame):
                group.append(frame)
                break
        else:
            groups.append([frame])
    return [stack for group in groups for stack in _straight(group, volume)]


def _alike(item: SegFrame, other: SegFrame) -> bool:
    return bool(
        np.abs(item.turn - other.turn).max() < _SAME_TURN
        and np.allclose(item.pixel_mm, other.pixel_mm, rtol=1e-4)
    )


def _straight(group: Sequence[SegFrame], volume: Volume) -> list[FrameStack]:
    normal = group[0].normal
    thick = thickness_mm(group, volume)
    places = np.array([frame.position_mm for frame in group])
    heights = places @ normal
    low, high = int(np.argmin(heights)), int(np.argmax(heights))
    rise = float(heights[high] - heights[low])
    along = (places[high] - places[low]) / rise if rise > 0.02 else normal
    off = places - places[low] - (heights - heights[low])[:, None] * along
    if np.linalg.norm(off, axis=1).max() <= _STRAIGHT_MM:
        return [_stack(group, places[low], along, thick)]
    sideways = np.rint((places - heights[:, None] * normal) / _STRAIGHT_MM).astype(int)
    columns: dict[tuple[int, ...], list[SegFrame]] = {}
    for frame, key in zip(group, sideways.tolist(), strict=True):
        columns.setdefault(tuple(key), []).append(frame)
    lowest = (min(part, key=lambda f: float(f.position_mm @ normal)) for part in columns.values())
    return [
        _stack(part, first.position_mm, normal, thick)
        for part, first in zip(columns.values(), lowest, strict=True)
    ]


def _stack(
    frames: Sequence[SegFrame], start: FloatArray, along: FloatArray, thick: float
) -> FrameStack:
    """Return a stack of frames whose layers are as thick as they are, or thin enough for all."""
    normal = frames[0].normal
    heights = np.array([float((frame.position_mm - start) @ normal) for frame in frames])
    counts = heights / thick
    step = thick
    if np.abs(counts - np.rint(counts)).max() <= _LAYER:
        layers = [(int(n), 1) for n in np.rint(counts)]
    else:
        step = thick / 4.0
        layers = [(int(n), 4) for n in np.ceil((heights - thick / 2.0) / step - 1e-6)]
    axes = np.column_stack([frames[0].steps_mm, step * along])
    numbers = tuple(frame.index for frame in frames)
    return FrameStack(numbers, start, axes, dict(zip(numbers, layers, strict=True)))


def voxel_part(
    pieces: Sequence[tuple[SegFrame, Pixels]], columns: int, volume: Volume
) -> Part | None:
    """Return pixels that are voxels of the CT, on its grid; None where there are none.

    Args:
        pieces: frames and their pixels.
        columns: of a frame.
        volume: the CT.

    Raises:
        StructureFileError: if they spread too far.
    """
    places = []
    for frame, pixels in pieces:
        steps, start = _in_voxels(frame, volume)
        row, column = np.divmod(pixels, columns)
        whole = np.rint(steps).astype(np.int64)
        flat = np.column_stack([column, row]).astype(np.int64)
        places.append(flat @ whole.T + np.rint(start).astype(np.int64))
    return _boxed(places, volume.affine_mm)


def stack_part(
    stack: FrameStack, pieces: Sequence[tuple[SegFrame, Pixels]], columns: int
) -> Part | None:
    """Return the pixels of a stack's frames on its grid; as `voxel_part`."""
    places = []
    for frame, pixels in pieces:
        if frame.index not in stack.layers:
            continue
        first, count = stack.layers[frame.index]
        row, column = np.divmod(pixels, columns)
        for layer in range(first, first + count):
            places.append(np.column_stack([column, row, np.full(len(row), layer)]))
    affine = np.eye(4)
    affine[:3, :3], affine[:3, 3] = stack.axes, stack.start_mm
    return _boxed(places, affine)


def _boxed(places: Sequence[NDArray[Any]], affine: FloatArray) -> Part | None:
    places = [place for place in places if len(place)]
    if not places:
        return None
    low = np.min([place.min(axis=0) for place in places], axis=0)
    high = np.max([place.max(axis=0) for place in places], axis=0)
    size = (high - low + 1).astype(np.float64)
    if float(size.prod()) > LARGEST_BOX:
        raise StructureFileError(
            sentence("it spreads over ") + " × ".join(f"{n:.0f}" for n in size) + " voxels"
        )
    mask = np.zeros(tuple(int(n) for n in size[::-1]), bool)
    for place in places:
        i, j, k = (place - low).T
        mask[k, j, i] = True
    to_patient = np.array(affine, np.float64)
    to_patient[:3, 3] += to_patient[:3, :3] @ low.astype(np.float64)
    return mask, to_patient
