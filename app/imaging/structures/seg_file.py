"""A DICOM Segmentation (PS3.3 A.51), written by highdicom in the worker process.

It repeats what the files of its CT say, so those are read; and they are foreign files.
"""

import hashlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydicom import dcmread

from app.core.progress import Progress
from app.imaging.errors import brief
from app.imaging.structures.cielab import lab_of
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.extras import extra
from app.imaging.structures.placed import PlacedStructure
from app.imaging.structures.segment_codes import CODES


def write_seg_file(
    to: Path,
    sources: tuple[Path, ...],
    structures: tuple[PlacedStructure, ...],
    size: tuple[int, int, int],
    series_uid: str,
    progress: Progress,
) -> None:
    """Job of the worker: write structures as a binary DICOM Segmentation.

    Args:
        to: file to write.
        sources: files of the CT, one for each slice, in their order.
        structures: on its grid.
        size: columns, rows, slices.
        series_uid: SeriesInstanceUID of the CT.
        progress: told how far it is.

    Raises:
        StructureFileError: if a file of the CT cannot be read or lacks what has to be repeated.
        ExtraMissingError: without the extra `structures`.
        OSError: if it cannot be written.
    """
    highdicom = extra("highdicom", "DICOM SEG files")
    from pydicom.sr.coding import Code

    headers = []
    for number, path in enumerate(sources, 1):
        progress.report(0.5 * number / len(sources), f"file {number} of {len(sources)}")
        headers.append(_header(path, number))
    names = repr([(one.name, one.corner, one.mask.tobytes()) for one in structures])
    try:
        segmentation = highdicom.seg.Segmentation(
            source_images=headers,
            pixel_array=np.stack([_whole(one, size) for one in structures], axis=-1),
            segmentation_type="BINARY",
            segment_descriptions=[
                _description(highdicom, Code, number, one)
                for number, one in enumerate(structures, start=1)
            ],
            series_instance_uid=_uid("series", series_uid, names),
            series_number=300,
            sop_instance_uid=_uid("instance", series_uid, names),
            instance_number=1,
            manufacturer="Acus",
            manufacturer_model_name="Acus trainer",
            software_versions="1",
            device_serial_number="0",
            content_label="STRUCTURES",
        )
    except (AttributeError, TypeError, ValueError) as error:
        lacking = getattr(error, "name", None) or brief(error)
        raise StructureFileError(
            f"this CT lacks what a DICOM segmentation has to repeat of it ({lacking}); "
            "write a .seg.nrrd instead"
        ) from error
    segmentation.save_as(to)


def _header(path: Path, number: int) -> Any:
    try:
        return dcmread(path, stop_before_pixels=True)
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        raise StructureFileError(
            f"file {number} of this CT is gone or damaged ({brief(error)})"
        ) from error


def _whole(one: PlacedStructure, size: tuple[int, int, int]) -> NDArray[np.uint8]:
    """Mask on the whole grid, shape (K, J, I)."""
    mask = np.zeros(size[::-1], np.uint8)
    i, j, k = one.corner
    depth, height, width = one.mask.shape
    mask[k : k + depth, j : j + height, i : i + width] = one.mask
    return mask


def _description(highdicom: Any, code: Any, number: int, structure: PlacedStructure) -> Any:
    category, kind = (code(value, "SCT", meaning) for value, meaning in CODES[structure.kind])
    lightness, a, b = lab_of(structure.colour)
    return highdicom.seg.SegmentDescription(
        segment_number=number,
        segment_label=structure.name,
        segmented_property_category=category,
        segmented_property_type=kind,
        algorithm_type="MANUAL",
        display_color=highdicom.color.CIELabColor(float(lightness), float(a), float(b)),
    )


def _uid(*parts: object) -> str:
    """UID under 2.25 (PS3.5 B.2) of what it stands for."""
    digest = hashlib.sha256(repr(parts).encode()).digest()[:16]
    return f"2.25.{int.from_bytes(digest, 'big')}"
