"""DICOM Segmentation (PS3.3 A.51), written by highdicom in the worker process.

One that is written repeats what the files of its CT say, so those are read; and they are foreign
files. Segments carry codes of SNOMED CT (PS3.16 CID 7150, 7159 and below) and colours in CIELab.
"""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydicom import dcmread

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.errors import brief
from app.imaging.structures.errors import StructureFileError
from app.imaging.structures.extras import extra
from app.imaging.structures.structure import Colour, PlacedStructure, StructureKind

CODES = {
    StructureKind.RISK: (("123037004", "Anatomical structure"), ("113343008", "Organ")),
    StructureKind.VESSEL: (("123037004", "Anatomical structure"), ("59820001", "Blood vessel")),
    StructureKind.BONE: (("123037004", "Anatomical structure"), ("272673000", "Bone")),
    StructureKind.TARGET: (
        ("49755003", "Morphologically abnormal structure"),
        ("52988006", "Lesion"),
    ),
    StructureKind.OTHER: (("85756007", "Tissue"), ("85756007", "Tissue")),
}
"""Category and type of a segment by kind."""


_XYZ_TO_RGB = np.array(
    [
        [3.1338561, -1.6168667, -0.4906146],
        [-0.9787684, 1.9161415, 0.0334540],
        [0.0719453, -0.2289914, 1.4052427],
    ]
)
"""From D50 to linear sRGB (Bradford adapted)."""

_WHITE = (0.96422, 1.0, 0.82521)


def rgb_of(lab: Any) -> Colour:
    """Colour of CIELab values, white point D50 as DICOM has it, in sRGB (IEC 61966-2-1)."""
    fy = (lab[0] + 16.0) / 116.0
    f = np.array([fy + lab[1] / 500.0, fy, fy - lab[2] / 200.0])
    xyz = np.where(f > 6 / 29, f**3, 3 * (6 / 29) ** 2 * (f - 4 / 29)) * _WHITE
    linear = _XYZ_TO_RGB @ xyz
    curve = np.where(
        linear <= 0.0031308,
        12.92 * linear,
        1.055 * np.clip(linear, 1e-9, None) ** (1 / 2.4) - 0.055,
    )
    r, g, b = (int(v) for v in np.rint(255.0 * np.clip(curve, 0.0, 1.0)))
    return r, g, b


def lab_of(colour: Colour) -> Any:
    """CIELab of a colour: L* 0 to 100, a*, b*."""
    c = np.array(colour) / 255.0
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    xyz = np.linalg.solve(_XYZ_TO_RGB, linear) / _WHITE
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


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
    extra("highdicom", "DICOM SEG files")
    headers = read_headers(sources, progress.part(0.0, 0.5))
    names = repr([(one.name, one.corner, one.mask.tobytes()) for one in structures])
    uids = _uid("series", series_uid, names), _uid("instance", series_uid, names)
    try:
        found = segmentation(headers, structures, size, uids)
    except (AttributeError, TypeError, ValueError) as error:
        lacking = getattr(error, "name", None) or brief(error)
        raise StructureFileError(
            sentence(
                "this CT lacks what a DICOM segmentation has to repeat of it ({lacking}); "
                "write a .seg.nrrd instead",
                lacking=lacking,
            )
        ) from error
    found.save_as(to)


def read_headers(sources: tuple[Path, ...], progress: Progress) -> list[Any]:
    """Return the headers of a CT's files, in their order.

    Raises:
        StructureFileError: if one cannot be read.
    """
    headers = []
    for number, path in enumerate(sources, 1):
        progress.report(
            number / len(sources),
            sentence("file {current} of {count}", current=number, count=len(sources)),
        )
        headers.append(_header(path, number))
    return headers


def segmentation(
    headers: list[Any],
    structures: tuple[PlacedStructure, ...],
    size: tuple[int, int, int],
    uids: tuple[str, str],
) -> Any:
    """Return a binary segmentation of structures on the grid of a CT.

    Args:
        headers: of the CT's files, in their order.
        structures: on its grid.
        size: columns, rows, slices.
        uids: of its series and of itself.

    Raises:
        AttributeError, TypeError, ValueError: if the CT lacks what has to be repeated of it.
    """
    highdicom = extra("highdicom", "DICOM SEG files")
    from pydicom.sr.coding import Code

    found = highdicom.seg.Segmentation(
        source_images=headers,
        pixel_array=np.stack([_whole(one, size) for one in structures], axis=-1),
        segmentation_type="BINARY",
        segment_descriptions=[
            _description(highdicom, Code, number, one)
            for number, one in enumerate(structures, start=1)
        ],
        series_instance_uid=uids[0],
        series_number=300,
        sop_instance_uid=uids[1],
        instance_number=1,
        manufacturer="Acus",
        manufacturer_model_name="Acus trainer",
        software_versions="1",
        device_serial_number="0",
        content_label="STRUCTURES",
    )
    found.SpecificCharacterSet = "ISO_IR 192"  # that of the CT may lack letters of the names
    return found


def _header(path: Path, number: int) -> Any:
    try:
        return dcmread(path, stop_before_pixels=True)
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        raise StructureFileError(
            sentence(
                "file {file_number} of this CT is gone or damaged ({brief})",
                file_number=number,
                brief=brief(error),
            )
        ) from error


def _whole(item: PlacedStructure, size: tuple[int, int, int]) -> NDArray[np.uint8]:
    """Mask on the whole grid, shape (K, J, I)."""
    mask = np.zeros(size[::-1], np.uint8)
    i, j, k = item.corner
    depth, height, width = item.mask.shape
    mask[k : k + depth, j : j + height, i : i + width] = item.mask
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
