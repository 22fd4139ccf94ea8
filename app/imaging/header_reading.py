"""What one file holds: the headers of its images, or why it belongs to no series."""

import importlib
import os
import stat
import struct
import sys
from pathlib import Path
from typing import BinaryIO, Final

from app.core.progress import Progress
from app.imaging import elements
from app.imaging.element_reading import PREAMBLE, NotStandardError, read_elements
from app.imaging.elements import TAG_LIST, TAGS, Elements
from app.imaging.errors import FileDamagedError
from app.imaging.header import MULTI_FRAME, Identity, ImagePlane, Rescale, SliceHeader
from app.imaging.pixel_data import PixelFormat
from app.imaging.pixel_finding import find_pixels
from app.imaging.privacy.known_words import body_parts, is_kernel
from app.imaging.privacy.pseudonyms import former_pseudonym, pseudonym
from app.imaging.series import Ignored

_WITH_PYDICOM: Final = ("pydicom", "pydicom.filereader", "app.imaging.enhanced")
"""What reads headers with pydicom, which takes half a second to load."""

_FIRST_GROUPS: Final = (0x0002, 0x0008)
_DICOMDIR: Final = b"1.2.840.10008.1.3.10"

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


def headers_in(path: Path, settings: Path, progress: Progress) -> tuple[SliceHeader, ...] | Ignored:
    """Job of the worker: `file_headers` with the key of the pseudonyms of these settings."""
    os.environ["ACUS_SETTINGS"] = str(settings)
    if all(module in sys.modules for module in _WITH_PYDICOM):
        return file_headers(path)
    try:
        return file_headers(path, without_pydicom=True)
    except NotStandardError:
        for module in _WITH_PYDICOM:
            importlib.import_module(module)
        progress.report(0.0, "pydicom is loaded")  # its time is not the file's
        return file_headers(path)


def file_headers(path: Path, without_pydicom: bool = False) -> tuple[SliceHeader, ...] | Ignored:
    """Read the headers of one file: an image, or each frame of it; or why it holds none.

    Whatever stands in the file ends in one of the two; nothing else is raised.

    Args:
        path: the file.
        without_pydicom: only if it can be done without it.

    Raises:
        NotStandardError: if it was to be done without pydicom, and cannot.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):  # opening a pipe would wait for ever
            return Ignored(path, "not a regular file")
        with path.open("rb") as stream:
            return _read(path, stream, without_pydicom)
    except OSError as error:
        return Ignored(path, f"cannot be read: {_why(error)}")
    except FileDamagedError as error:
        return Ignored(path, f"damaged DICOM file: {error}")


def _read(path: Path, stream: BinaryIO, without_pydicom: bool) -> tuple[SliceHeader, ...] | Ignored:
    head = stream.read(512)
    preamble = head[PREAMBLE - 4 : PREAMBLE] == b"DICM"
    if not preamble and not starts_like_dicom(head):
        return Ignored(path, "empty file" if not head else "not a DICOM file")
    if _DICOMDIR in head:
        return Ignored(path, "DICOM directory (DICOMDIR), not an image")
    stream.seek(0)
    headers = _headers(path, stream, not preamble, without_pydicom)
    if not headers:
        what = "DICOM, but truncated or of no series (no SeriesInstanceUID)"
        return Ignored(path, what if preamble else "not a DICOM file")
    return headers


def starts_like_dicom(head: bytes) -> bool:
    """Whether bytes without a preamble start like a data set: a low group, a VR or a length."""
    if len(head) < 16:
        return False
    for order in "<>":
        group, element, length = struct.unpack_from(order + "HHL", head)
        if group in _FIRST_GROUPS and element <= 0x0100:
            explicit = head[4:6].isalpha() and head[4:6].isupper()
            if explicit or length < 4096:
                return True
    return False


def _why(error: Exception) -> str:
    return getattr(error, "strerror", None) or str(error)


def _headers(
    path: Path, stream: BinaryIO, forced: bool, without_pydicom: bool
) -> tuple[SliceHeader, ...]:
    """Read the header of one file up to its pixels; nothing if it is no instance of a series.

    Args:
        path: the file, for messages.
        stream: the file, opened for reading at its start.
        forced: read although the DICOM preamble is missing.
        without_pydicom: only if it can be done without it.

    Returns:
        One header for each image: one, or for a multi-frame file that says where its frames lie
        one for each.

    Raises:
        FileDamagedError: if the header cannot be parsed.
        NotStandardError: if it was to be done without pydicom, and cannot.
    """
    header = read_elements(stream, TAG_LIST, forced, without_pydicom)
    if not elements.text(header, TAGS["SeriesInstanceUID"]):
        return ()
    found = _slice_header(path, stream, header)
    if found.identity.sop_class not in MULTI_FRAME or found.damage:
        return (found,)
    if without_pydicom:
        raise NotStandardError
    from app.imaging.enhanced import frames_of

    return frames_of(found, stream)


def _slice_header(path: Path, stream: BinaryIO, header: Elements) -> SliceHeader:
    problems: list[str] = []
    identity = _identity(header)
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


def _identity(header: Elements) -> Identity:
    """Which object a file holds; patient and study only inside the pseudonym."""

    def get(name: str) -> str:
        return elements.text(header, TAGS[name])

    return Identity(
        sop_uid=get("SOPInstanceUID"),
        sop_class=get("SOPClassUID"),
        series_uid=get("SeriesInstanceUID"),
        modality=get("Modality"),
        image_type=elements.parts(header, TAGS["ImageType"]),
        label=_label(get("SeriesNumber"), get("BodyPartExamined"), get("ConvolutionKernel")),
        pseudonym=pseudonym(get("PatientID"), get("StudyInstanceUID"), get("StudyID")),
        former=former_pseudonym(get("PatientID"), get("StudyInstanceUID")),
        frame_of_reference=get("FrameOfReferenceUID"),
    )


def _label(number: str, body_part: str, kernel: str) -> str:
    """Built from coded elements, and of these from known words only: free text may hold a name."""
    number = number if number.isdigit() and len(number) <= 5 else "?"
    body_part = body_part if body_part in body_parts() else ""
    first = kernel.split(chr(92))[0]
    kernel = f"kernel {first}" if first and is_kernel(first) else ""
    return ", ".join(part for part in (f"Series {number}", body_part, kernel) if part)


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


def _plane(header: Elements) -> ImagePlane | None:
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
    return ImagePlane(position, orientation, spacing)  # type: ignore[arg-type]  # counts were checked


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
