"""What one file holds: the headers of its images, or why it belongs to no series."""

import hashlib
import importlib
import os
import stat
import struct
import sys
from functools import lru_cache
from pathlib import Path
from typing import BinaryIO, Final

from app.core.messages import listed, sentence
from app.core.progress import Progress
from app.imaging import elements
from app.imaging.element_reading import PREAMBLE, NotStandardError, read_elements
from app.imaging.elements import TAG_LIST, TAGS, Elements
from app.imaging.errors import FileDamagedError
from app.imaging.header import CT_IMAGE, MULTI_FRAME, Identity, ImagePlane, Rescale, SliceHeader
from app.imaging.pixel_data import PixelFormat
from app.imaging.pixel_finding import TRUNCATED, find_pixels
from app.imaging.privacy.key import derived, installation_key
from app.imaging.privacy.known_words import body_parts, is_kernel
from app.imaging.privacy.pseudonyms import pseudonym
from app.imaging.series import Ignored
from app.imaging.units import another_unit

_WITH_PYDICOM: Final = ("pydicom", "pydicom.filereader", "app.imaging.enhanced")
"""What reads headers with pydicom, which takes half a second to load."""

_FIRST_GROUPS: Final = (0x0002, 0x0008)
NOT_DICOM: Final = sentence("not a DICOM file")

_DICOMDIR: Final = b"1.2.840.10008.1.3.10"

_MARKS: Final = {
    "acquisition": "AcquisitionNumber",
    "time-position": "TemporalPositionIdentifier",
    "trigger": "TriggerTime",
    "echo": "EchoNumbers",
    "image-type": "ImageType",
    "kernel": "ConvolutionKernel",
    "tube-voltage": "KVP",
    "thickness": "SliceThickness",
    "contrast": "ContrastBolusAgent",
    "number": "SeriesNumber",
    "description": "SeriesDescription",
    "comments": "ImageComments",
    "acquisition-moment": "AcquisitionDateTime",
    "acquisition-time": "AcquisitionTime",
    "content-time": "ContentTime",
}
_TYPED: Final = ("contrast", "description", "comments")
"""Marks that are free text: kept as a digest, which tells them apart as well."""

_OWNER: Final = (
    "PatientID",
    "IssuerOfPatientID",
    "PatientBirthDate",
    "PatientName",
    "StudyInstanceUID",
)
_TYPE_1: Final = (
    "SamplesPerPixel",
    "PhotometricInterpretation",
    "Rows",
    "Columns",
    "BitsAllocated",
    "BitsStored",
    "HighBit",
    "PixelRepresentation",
)
"""What says how a pixel is stored; all of them must be given (PS3.3 C.7.6.3.1, Type 1)."""
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
        progress.report(0.0, sentence("pydicom is loaded"))  # its time is not the file's
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
            return Ignored(path, sentence("not a regular file"))
        with path.open("rb") as stream:
            return _read(path, stream, without_pydicom)
    except OSError as error:
        return Ignored(path, sentence("cannot be read: {why}", why=_why(error)))
    except FileDamagedError as error:
        return Ignored(path, sentence("damaged DICOM file: {error}", error=error))


def _read(path: Path, stream: BinaryIO, without_pydicom: bool) -> tuple[SliceHeader, ...] | Ignored:
    head = stream.read(512)
    preamble = head[PREAMBLE - 4 : PREAMBLE] == b"DICM"
    if not preamble and not starts_like_dicom(head):
        return Ignored(path, sentence("empty file") if not head else NOT_DICOM)
    if _DICOMDIR in head:
        return Ignored(path, sentence("DICOM directory (DICOMDIR), not an image"))
    stream.seek(0)
    headers = _headers(path, stream, not preamble, without_pydicom)
    if not headers:
        what = sentence("DICOM, but truncated or of no series (no SeriesInstanceUID)")
        return Ignored(path, what if preamble else NOT_DICOM)
    return headers


def starts_like_dicom(head: bytes) -> bool:
    """Return whether bytes without a preamble start like a data set: a low group, a VR or a
    length.
    """
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

    return frames_of(found, stream, is_multi_energy(header))


def _slice_header(path: Path, stream: BinaryIO, header: Elements) -> SliceHeader:
    problems: list[str] = []
    identity = _identity(header)
    pixel_format = _guarded(_format, header, problems) or PixelFormat.unknown()
    pixels = find_pixels(stream, header, pixel_format)
    plane = _guarded(_plane, header, problems)
    rescale = _guarded(_rescale, header, problems)
    missing = _missing(header)
    damage = "; ".join(filter(None, (*problems, missing, pixels.damage)))
    if pixels.damage.startswith(TRUNCATED):  # then what is missing was cut off
        damage = pixels.damage
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
        obstacle="" if identity.sop_class in MULTI_FRAME else _obstacle(header, identity),
    )


def _obstacle(header: Elements, identity: Identity) -> str:
    """Return why the values of a CT image are no Hounsfield units, whatever its rescale makes of
    them.
    """
    if (identity.modality, identity.sop_class) != ("CT", CT_IMAGE):
        return ""
    kind = elements.text(header, TAGS["RescaleType"])
    return another_unit(identity.image_type, kind, is_multi_energy(header))


def is_multi_energy(header: Elements) -> bool:
    """Return whether the image was made of more than one X-ray spectrum (PS3.3 C.8.2.1)."""
    return elements.text(header, TAGS["MultienergyCTAcquisition"]).upper() == "YES"


def _identity(header: Elements) -> Identity:
    """Return which object a file holds; patient and study only inside the pseudonym."""

    def get(name: str) -> str:
        return elements.text(header, TAGS[name])

    name = pseudonym(get("PatientID"), get("StudyInstanceUID"), get("StudyID"))
    return Identity(
        sop_uid=get("SOPInstanceUID"),
        sop_class=get("SOPClassUID"),
        series_uid=get("SeriesInstanceUID"),
        modality=get("Modality"),
        image_type=elements.parts(header, TAGS["ImageType"]),
        label=_label(get("SeriesNumber"), get("BodyPartExamined"), get("ConvolutionKernel")),
        pseudonym=name,
        frame_of_reference=get("FrameOfReferenceUID"),
        owner=_owner(name, tuple(get(name) for name in _OWNER)),
    )


@lru_cache(maxsize=4)
def _owner(pseudonym: str, values: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    """Keyed digests of what says whose image it is; of a name its words in any spelling.

    Args:
        pseudonym: another one if the key changes, as the digests are then.
        values: of `_OWNER`.
    """
    key = installation_key()
    said = dict(zip(_OWNER, values, strict=True))
    said["PatientName"] = _plain_name(said["PatientName"])
    return tuple(
        (name, derived(key, "owner", name, value).hex()[:16])
        for name, value in said.items()
        if value
    )


def _plain_name(name: str) -> str:
    """Words of a person's name without case, order of parts and marks, and other alphabets.

    Letters beyond ASCII are left out: the files of a series may spell them in several encodings.
    """
    first = name.split("=")[0]
    words = "".join(c.lower() if c.isascii() and c.isalnum() else " " for c in first if c < "\x7f")
    return " ".join(sorted(words.split())) or name


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
    return tuple(
        (mark, hashlib.sha256(value.encode()).hexdigest()[:8] if mark in _TYPED else value)
        for mark, value in values
        if value
    )


def _guarded(read, header: Elements, problems: list[str]):  # type: ignore[no-untyped-def]
    try:
        return read(header)
    except FileDamagedError as error:
        problems.append(str(error))
        return None


def _missing(header: Elements) -> str:
    """Say which attributes of the pixels are missing, but for what only one value can be.

    SamplesPerPixel is 1 of grey pixels, and HighBit is one less than BitsStored (PS3.5 8.1.1).
    """
    values = {name: getattr(header.values.get(TAGS[name]), "value", None) for name in _TYPE_1}
    absent = [name for name, value in values.items() if value in (None, b"", "")]
    if elements.text(header, TAGS["PhotometricInterpretation"]).startswith("MONOCHROME"):
        absent = [name for name in absent if name != "SamplesPerPixel"]
    if len({"BitsStored", "HighBit"}.intersection(absent)) == 1:
        absent = [name for name in absent if name not in ("BitsStored", "HighBit")]
    if not absent:
        return ""
    names = listed(absent)
    if len(absent) == 1:
        return sentence("{names} is missing, without which its pixels cannot be told", names=names)
    return sentence("{names} are missing, without which its pixels cannot be told", names=names)


def _format(header: Elements) -> PixelFormat:
    def get(name: str, default: int) -> int:
        value = elements.integer(header, TAGS[name], name)
        return default if value is None else value

    representation = get("PixelRepresentation", 0)
    if representation not in (0, 1):
        raise FileDamagedError(
            sentence(
                "PixelRepresentation is {representation}; it must be 0 or 1",
                representation=representation,
            )
        )
    signed = representation == 1
    allocated = get("BitsAllocated", 0)
    stored = get("BitsStored", get("HighBit", allocated - 1) + 1)
    frames = elements.integer_string(header, TAGS["NumberOfFrames"], "NumberOfFrames")
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
        padding=_padding(header, signed),
    )


def _padding(header: Elements, signed: bool) -> tuple[int, int] | None:
    """Lowest and highest stored value that is no measurement (PS3.3 C.7.5.1.1.2).

    Both are as the pixels are, signed or not, whatever representation their elements name.
    """

    def get(name: str) -> int | None:
        value = elements.integer(header, TAGS[name], name)
        if value is None:
            return None
        return (value & 0xFFFF) - (0x10000 if signed and value & 0x8000 else 0)

    padding, limit = get("PixelPaddingValue"), get("PixelPaddingRangeLimit")
    if padding is None:
        return None
    ends = padding, padding if limit is None else limit
    return min(ends), max(ends)


def _plane(header: Elements) -> ImagePlane | None:
    def get(name: str, count: int) -> tuple[float, ...]:
        return elements.numbers(header, TAGS[name], name, count)

    position = get("ImagePositionPatient", 3)
    orientation = get("ImageOrientationPatient", 6)
    spacing = get("PixelSpacing", 2)
    if not (position and orientation and spacing):
        return None
    if min(spacing) <= 0.0:
        raise FileDamagedError(
            sentence("PixelSpacing is {spacing}; both must be above zero", spacing=spacing)
        )
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
        raise FileDamagedError(sentence("RescaleSlope is 0; every pixel would have the same value"))
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
