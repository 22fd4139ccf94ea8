"""Reading the header of one DICOM image file: one image, or one for each frame."""

import contextlib
from collections.abc import Sequence
from pathlib import Path
from typing import BinaryIO, Final

from app.imaging import elements
from app.imaging.element_walk import OddError
from app.imaging.elements import Elements
from app.imaging.errors import FileDamagedError, brief
from app.imaging.header import MULTI_FRAME, Plane, Rescale, SliceHeader
from app.imaging.header_identity import identity_of
from app.imaging.header_tags import TAG_LIST, TAGS
from app.imaging.pixel_data import PixelFormat
from app.imaging.pixel_finding import find_pixels

_MARKS: Final = {
    "acquisition": "AcquisitionNumber",
    "time-position": "TemporalPositionIdentifier",
    "trigger": "TriggerTime",
    "echo": "EchoNumbers",
    "image-type": "ImageType",
    "kernel": "ConvolutionKernel",
    "acquisition-time": "AcquisitionTime",
}
_AS_STORED: Final = Rescale(1.0, 0.0)


def read_headers(
    path: Path, stream: BinaryIO, forced: bool, sound: bool = False
) -> tuple[SliceHeader, ...]:
    """Read the header of one file up to its pixels; nothing if it is no instance of a series.

    Args:
        path: the file, for messages.
        stream: the file, opened for reading at its start.
        forced: read although the DICOM preamble is missing.
        sound: only if it can be done without pydicom.

    Returns:
        One header for each image: one, or for a multi-frame file that says where its frames lie
        one for each.

    Raises:
        FileDamagedError: if the header cannot be parsed.
        OddError: if only what is sound was asked for, and this is not.
    """
    header = _elements(stream, TAG_LIST, forced, sound)
    if not elements.text(header, TAGS["SeriesInstanceUID"]):
        return ()
    found = _slice_header(path, stream, header)
    if found.identity.sop_class not in MULTI_FRAME or found.damage:
        return (found,)
    if sound:
        raise OddError
    from app.imaging.enhanced import frames_of

    return frames_of(found, stream)


def _elements(
    stream: BinaryIO, wanted: Sequence[int], forced: bool, sound: bool = False
) -> Elements:
    """Read the wanted elements before the pixels; the stream then stands at the pixels.

    Args:
        stream: the file, at its start.
        wanted: tags.
        forced: read although the DICOM preamble is missing.
        sound: only if it can be done without pydicom.

    Raises:
        FileDamagedError: if the header cannot be parsed.
        OddError: if only what is sound was asked for, and this is not.
    """
    if not forced:
        with contextlib.suppress(OddError):
            return elements.read_sound(stream, frozenset(wanted))
    if sound:
        raise OddError
    try:
        from app.imaging.odd_elements import read_odd

        return read_odd(stream, wanted, forced)
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        raise FileDamagedError(f"its header cannot be read ({brief(error)})") from error


def _slice_header(path: Path, stream: BinaryIO, header: Elements) -> SliceHeader:
    problems: list[str] = []
    identity = identity_of(header)
    pixel_format = _guarded(_format, header, problems) or PixelFormat.unknown()
    pixels = find_pixels(stream, header, pixel_format)
    plane = _guarded(_plane, header, problems)
    rescale = _guarded(_rescale, header, problems)
    damage = "; ".join([*problems, *([pixels.damage] if pixels.damage else [])])
    if identity.modality == "MR" and rescale is None:
        rescale = _AS_STORED  # MR has no unit to be scaled to
    return SliceHeader(
        path,
        identity,
        pixel_format,
        plane,
        rescale,
        _windows(header),
        pixels,
        damage,
        thickness_mm=_thickness(header),
        marks=_marks(header),
    )


def _thickness(header: Elements) -> float | None:
    """SliceThickness, which nothing is placed by; one that cannot be read is none."""
    try:
        return next(iter(elements.numbers(header, TAGS["SliceThickness"], "SliceThickness")), None)
    except FileDamagedError:
        return None


def _marks(header: Elements) -> tuple[tuple[str, str], ...]:
    values = ((mark, elements.text(header, TAGS[name])) for mark, name in _MARKS.items())
    return tuple((mark, value) for mark, value in values if value)


def _guarded(read, header: Elements, problems: list[str]):  # type: ignore[no-untyped-def]
    try:
        return read(header)
    except FileDamagedError as error:
        problems.append(str(error))
        return None


def _format(header: Elements) -> PixelFormat:
    def get(name: str, default: int) -> int:
        value = elements.integer(header, TAGS[name], name)
        return default if value is None else value

    signed = get("PixelRepresentation", 0) == 1
    allocated = get("BitsAllocated", 0)
    stored = get("BitsStored", allocated)
    frames = elements.integer_string(header, TAGS["NumberOfFrames"], "NumberOfFrames")
    padding = elements.integer(header, TAGS["PixelPaddingValue"], "PixelPaddingValue", signed)
    limit = elements.integer(
        header, TAGS["PixelPaddingRangeLimit"], "PixelPaddingRangeLimit", signed
    )
    return PixelFormat(
        rows=get("Rows", 0),
        columns=get("Columns", 0),
        samples=get("SamplesPerPixel", 1),
        frames=1 if frames is None else frames,
        bits_allocated=allocated,
        bits_stored=stored,
        high_bit=get("HighBit", stored - 1),
        signed=signed,
        photometric=elements.text(header, TAGS["PhotometricInterpretation"]),
        padding=None if padding is None else _range(padding, padding if limit is None else limit),
    )


def _range(a: int, b: int) -> tuple[int, int]:
    return min(a, b), max(a, b)


def _plane(header: Elements) -> Plane | None:
    def get(name: str, count: int) -> tuple[float, ...]:
        return elements.numbers(header, TAGS[name], name, count)

    position = get("ImagePositionPatient", 3)
    orientation = get("ImageOrientationPatient", 6)
    spacing = get("PixelSpacing", 2)
    if not (position and orientation and spacing):
        return None
    if min(spacing) <= 0.0:
        raise FileDamagedError(f"PixelSpacing is {spacing}; both must be above zero")
    elements.check_orientation(orientation)
    return Plane(position, orientation, spacing)  # type: ignore[arg-type]  # counts were checked


def _rescale(header: Elements) -> Rescale | None:
    slope = elements.numbers(header, TAGS["RescaleSlope"], "RescaleSlope", 1)
    intercept = elements.numbers(header, TAGS["RescaleIntercept"], "RescaleIntercept", 1)
    kind = elements.text(header, TAGS["RescaleType"]).upper()
    is_mr = elements.text(header, TAGS["Modality"]) == "MR"
    if not (slope and intercept) or (kind not in ("", "HU") and not is_mr):
        return None
    if slope[0] == 0.0:
        raise FileDamagedError("RescaleSlope is 0; every pixel would have the same value")
    return Rescale(slope[0], intercept[0])


def _windows(header: Elements) -> tuple[tuple[float, float], ...]:
    """Width and level pairs; a window that cannot be used is no reason to refuse a file."""
    try:
        levels = elements.numbers(header, TAGS["WindowCenter"], "WindowCenter")
        widths = elements.numbers(header, TAGS["WindowWidth"], "WindowWidth")
    except FileDamagedError:
        return ()
    pairs = zip(widths, levels, strict=False)
    return tuple(dict.fromkeys((width, level) for width, level in pairs if width >= 1.0))
