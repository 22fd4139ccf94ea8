"""DICOM Segmentation (PS3.3 A.51), read by highdicom."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from app.imaging.errors import brief
from app.imaging.structures.cielab import rgb_of
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.extras import extra
from app.imaging.structures.placing import Found, Labelled, guessed_kind
from app.imaging.structures.segment_codes import CODES
from app.imaging.structures.structure import Colour, Kind

SHARE = 0.5
"""A voxel of a fractional segment belongs to it from this value."""

_KINDS = {codes[1][0]: kind for kind, codes in CODES.items() if kind is not Kind.OTHER}


def read_seg(dataset: Any, path: Path) -> Found:
    """Read the segments of a DICOM Segmentation: binary, fractional (from one half) or label map.

    Raises:
        StructureFileError: if the file is damaged, or its frames make no volume.
        ExtraMissingError: without the extra `structures`.
    """
    highdicom = extra("highdicom", "DICOM SEG files")
    if dataset.original_encoding[1] is False:
        raise StructureFileError(
            f"{path.name} is big endian; DICOM segmentations are read in little endian only"
        )
    with _named(path):
        segmentation = highdicom.seg.Segmentation.from_dataset(dataset, copy=False)
        numbers = [int(number) for number in segmentation.segment_numbers]
        frame = str(dataset.get("FrameOfReferenceUID", ""))
        kind = str(segmentation.segmentation_type.value)
    notes: tuple[str, ...] = ()
    if kind == "FRACTIONAL":
        notes = ("fractional segments: a voxel belongs to one from 50 %",)
    return Found(_segments(segmentation, numbers, path), len(numbers), frame, notes)


def _segments(segmentation: Any, numbers: list[int], path: Path) -> Iterator[Labelled]:
    """Yield the segments one after the other: each has the size of a whole CT."""
    for number in numbers:
        with _named(path):
            found = _segment(segmentation, number)
        yield found


@contextmanager
def _named(path: Path) -> Iterator[None]:
    try:
        yield
    except MemoryError:
        raise
    except Exception as error:  # highdicom and pydicom raise whatever the file leads them to
        raise StructureFileError(
            f"{path.name} cannot be read as a DICOM segmentation ({brief(error)})"
        ) from error


def _segment(segmentation: Any, number: int) -> Labelled:
    volume = segmentation.get_volume(segment_numbers=[number], combine_segments=False)
    values = volume.array[..., 0]
    affine = np.array(volume.affine, np.float64)[:, [2, 1, 0, 3]]  # (k, j, i) -> (i, j, k)
    description = segmentation.get_segment_description(number)
    name = str(description.segment_label) or f"segment {number}"
    kind = _KINDS.get(str(description.segmented_property_type.value)) or guessed_kind(name)
    return Labelled(name, values >= SHARE, affine, kind, _colour(description))


def _colour(description: Any) -> Colour | None:
    value = description.get("RecommendedDisplayCIELabValue")
    if value is None:
        return None
    lightness, a, b = (int(v) for v in value)
    lab = np.array([lightness * 100.0 / 65535.0, a * 255.0 / 65535.0 - 128.0,
                    b * 255.0 / 65535.0 - 128.0])  # fmt: skip
    return rgb_of(lab)
