"""DICOM Segmentation (PS3.3 A.51), read in the worker process: binary, fractional, label map."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydicom.pixels.decoders.base import get_decoder
from pydicom.uid import UID

from app.core.messages import sentence
from app.imaging.errors import brief
from app.imaging.structures import seg_frames
from app.imaging.structures.dicom_seg import CODES, rgb_of
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.placing import Found, Labelled, guessed_kind
from app.imaging.structures.seg_frames import FrameStack, Pixels, SegFrame
from app.imaging.structures.structure import Colour, StructureKind
from app.imaging.volume import Volume

SHARE = 0.5
"""A voxel of a fractional segment belongs to it from this value."""

_KINDS = {codes[1][0]: kind for kind, codes in CODES.items() if kind is not StructureKind.OTHER}
_TYPES = ("BINARY", "FRACTIONAL", "LABELMAP")
_BITS = (1, 8, 16)


@dataclass(frozen=True, slots=True, eq=False)
class Segmentation:
    """A file that was looked through.

    Attributes:
        dataset: the file.
        kind: one of BINARY, FRACTIONAL, LABELMAP.
        rows, columns: of a frame.
        frames: those that say where they lie.
        stacks: of the frames, where they are not voxels of the CT.
        pixels: of each segment, by its number: which pixels of which frame it holds.
    """

    dataset: Any
    kind: str
    rows: int
    columns: int
    frames: list[SegFrame]
    stacks: list[FrameStack]
    pixels: dict[int, list[tuple[SegFrame, Pixels]]]


def read_seg(dataset: Any, path: Path, volume: Volume, own: frozenset[str]) -> Found:
    """Read the segments of a DICOM Segmentation, frame by frame.

    Args:
        dataset: the file, read by pydicom.
        path: for messages.
        volume: the CT; its grid is enough.
        own: UIDs of the CT's series and images.

    Raises:
        StructureFileError: if the file is damaged, or no frame of it says where it lies.
    """
    if dataset.original_encoding[1] is False:
        raise StructureFileError(
            sentence(
                "{path_name} is big endian; DICOM segmentations are read in little endian only",
                path_name=path.name,
            )
        )
    with _named(path):
        drawn_on = _named_images(dataset)
        segmentation, notes = _looked_through(dataset, volume, bool(drawn_on & own))
        count = len(_described(segmentation))
        frame = str(dataset.get("FrameOfReferenceUID", "") or "")
    structures = _segments(segmentation, path, volume)
    return Found(structures, count, frame, tuple(notes), drawn_on)


@contextmanager
def _named(path: Path) -> Iterator[None]:
    try:
        yield
    except MemoryError:
        raise
    except StructureFileError as error:
        raise StructureFileError(
            sentence("{path_name} {error}", path_name=path.name, error=error)
        ) from error
    except Exception as error:  # pydicom raises whatever the file leads it to
        raise StructureFileError(
            sentence(
                "{path_name} cannot be read as a DICOM segmentation ({brief})",
                path_name=path.name,
                brief=brief(error),
            )
        ) from error


def _named_images(dataset: Any) -> frozenset[str]:
    """UIDs of the series and images that the file says it was drawn on."""
    uids: set[str] = set()
    for series in dataset.get("ReferencedSeriesSequence") or ():
        uids.add(str(series.get("SeriesInstanceUID", "") or ""))
        for image in series.get("ReferencedInstanceSequence") or ():
            uids.add(str(image.get("ReferencedSOPInstanceUID", "") or ""))
    for image in dataset.get("SourceImageSequence") or ():
        uids.add(str(image.get("ReferencedSOPInstanceUID", "") or ""))
    return frozenset(uids - {""})


def _looked_through(dataset: Any, volume: Volume, names_ct: bool) -> tuple[Segmentation, list[str]]:
    kind = str(dataset.get("SegmentationType", "") or "").strip()
    if kind not in _TYPES:
        raise StructureFileError(
            sentence("has no SegmentationType that is read: {types}", types=", ".join(_TYPES))
        )
    if int(dataset.BitsAllocated) not in _BITS:
        raise StructureFileError(
            sentence(
                "has {dataset_bits_allocated} bits per pixel; 1, 8, 16 are read",
                dataset_bits_allocated=dataset.BitsAllocated,
            )
        )
    rows, columns = int(dataset.Rows), int(dataset.Columns)
    count = int(dataset.get("NumberOfFrames", 1) or 1)
    frames, left_out = seg_frames.frames_of(dataset, count, kind == "LABELMAP")
    if not frames:
        raise StructureFileError(sentence("holds no frame that says where it lies"))
    notes = []
    if kind == "FRACTIONAL":
        notes.append("fractional segments: a voxel belongs to one from 50 %")
    if note := seg_frames.spacing_note(frames):
        notes.append(note)
    exact = seg_frames.on_voxels(frames, (columns, rows), volume) and (
        names_ct or seg_frames.is_thin(frames, volume)
    )
    stacks = [] if exact else seg_frames.stacks_of(frames, volume)
    segmentation = Segmentation(dataset, kind, rows, columns, frames, stacks, {})
    undescribed = _sort_pixels(segmentation, left_out)
    notes += [f"{n} frame{'s' if n > 1 else ''} {what} left out" for what, n in left_out.items()]
    if undescribed:
        names = ", ".join(str(number) for number in sorted(undescribed)[:8])
        notes.append(f"segments that the file does not describe left out: {names}")
    return segmentation, notes


def _sort_pixels(segmentation: Segmentation, left_out: Counter[str]) -> set[int]:
    """Find the pixels of every segment.

    Args:
        segmentation: takes them up.
        left_out: takes up why frames are left out.

    Returns:
        Values of a label map that stand for no segment of the file.
    """
    described = {int(item.SegmentNumber) for item in segmentation.dataset.SegmentSequence}
    least = SHARE * float(segmentation.dataset.get("MaximumFractionalValue", 255) or 255)
    undescribed: set[int] = set()
    whole = 0
    for frame in segmentation.frames:
        values = _values(segmentation, frame.index)
        whole += values is not None
        if values is None:
            left_out["without pixels that can be read (cut short or damaged)"] += 1
        elif frame.segment is not None:
            inside = values >= least if segmentation.kind == "FRACTIONAL" else values != 0
            _add(segmentation, frame.segment, frame, inside)
        else:
            numbers = set(np.unique(values).tolist()) - {0}
            undescribed |= numbers - described
            for number in numbers & described:
                _add(segmentation, number, frame, values == number)
    if not whole:
        raise StructureFileError(
            sentence("holds no pixels that can be read: it is cut short or damaged")
        )
    return undescribed


def _add(
    segmentation: Segmentation, number: int, frame: SegFrame, inside: NDArray[np.bool_]
) -> None:
    pixels = np.flatnonzero(inside).astype(np.int32)
    segmentation.pixels.setdefault(number, []).append((frame, pixels))


def _values(segmentation: Segmentation, index: int) -> NDArray[Any] | None:
    """Return the values of a frame, shape (rows, columns); None if they cannot be read."""
    dataset, shape = segmentation.dataset, (segmentation.rows, segmentation.columns)
    syntax = UID(dataset.file_meta.TransferSyntaxUID)
    if syntax.is_compressed and not syntax.is_deflated:
        try:
            decoded = get_decoder(syntax).as_array(dataset, index=index, raw=True)[0]
            values: NDArray[Any] = np.asarray(decoded).reshape(shape)
        except MemoryError:
            raise
        except Exception:  # decoders raise whatever the bytes lead them to
            return None
        return values
    data = dataset.get("PixelData") or b""
    bits, count = int(dataset.BitsAllocated), shape[0] * shape[1]
    if len(data) * 8 < (index + 1) * count * bits:
        return None
    if bits > 1:
        raw = np.frombuffer(data, f"<u{bits // 8}", count, index * count * bits // 8)
        return raw.reshape(shape)
    first = index * count
    part = np.frombuffer(data, np.uint8, (first + count + 7) // 8 - first // 8, first // 8)
    return np.unpackbits(part, bitorder="little")[first % 8 :][:count].reshape(shape)


def _described(segmentation: Segmentation) -> list[Any]:
    """Return the descriptions of the segments; 0 of a label map is what belongs to none."""
    items = list(segmentation.dataset.SegmentSequence)
    if segmentation.kind != "LABELMAP":
        return items
    return [item for item in items if int(item.SegmentNumber)]


def _segments(segmentation: Segmentation, path: Path, volume: Volume) -> Iterator[Labelled]:
    """Yield the segments one after the other: each has the size of a whole CT."""
    for description in _described(segmentation):
        with _named(path):
            labelled = _segment(segmentation, description, volume)
        yield labelled


def _segment(segmentation: Segmentation, description: Any, volume: Volume) -> Labelled:
    number = int(description.SegmentNumber)
    name = str(description.get("SegmentLabel", "") or "") or f"segment {number}"
    pieces = segmentation.pixels.pop(number, [])
    columns = segmentation.columns
    if segmentation.stacks:
        found = [seg_frames.stack_part(stack, pieces, columns) for stack in segmentation.stacks]
    else:
        found = [seg_frames.voxel_part(pieces, columns, volume)]
    parts = [part for part in found if part is not None]
    mask, affine = parts[0] if parts else (np.zeros((1, 1, 1), bool), np.eye(4))
    kind = _kind(description) or guessed_kind(name)
    colour = _colour(description)
    return Labelled(name, mask, affine, kind, colour, others=tuple(parts[1:]))


def _kind(description: Any) -> StructureKind | None:
    codes = description.get("SegmentedPropertyTypeCodeSequence")
    return _KINDS.get(str(codes[0].get("CodeValue", ""))) if codes else None


def _colour(description: Any) -> Colour | None:
    value = description.get("RecommendedDisplayCIELabValue")
    if value is None:
        return None
    lightness, a, b = (int(v) for v in value)
    lab = np.array(
        [lightness * 100.0 / 65535.0, a * 255.0 / 65535.0 - 128.0, b * 255.0 / 65535.0 - 128.0]
    )
    return rgb_of(lab)
