"""The DICOM elements that a series is made by, as plain values.

Quick: without pydicom's conversions and their warnings. `element_reading` reads them.
"""

import math
import re
import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, BinaryIO, Final

from app.core.messages import sentence
from app.imaging.errors import FileDamagedError

TAGS: Final = {
    "SOPClassUID": 0x00080016,
    "SOPInstanceUID": 0x00080018,
    "ImageType": 0x00080008,
    "AcquisitionDateTime": 0x0008002A,
    "AcquisitionTime": 0x00080032,
    "ContentTime": 0x00080033,
    "Modality": 0x00080060,
    "SeriesDescription": 0x0008103E,
    "PatientName": 0x00100010,
    "PatientID": 0x00100020,
    "IssuerOfPatientID": 0x00100021,
    "PatientBirthDate": 0x00100030,
    "ContrastBolusAgent": 0x00180010,
    "BodyPartExamined": 0x00180015,
    "SliceThickness": 0x00180050,
    "KVP": 0x00180060,
    "EchoNumbers": 0x00180086,
    "TriggerTime": 0x00181060,
    "ConvolutionKernel": 0x00181210,
    "MultienergyCTAcquisition": 0x00189361,
    "StudyInstanceUID": 0x0020000D,
    "SeriesInstanceUID": 0x0020000E,
    "StudyID": 0x00200010,
    "SeriesNumber": 0x00200011,
    "AcquisitionNumber": 0x00200012,
    "ImagePositionPatient": 0x00200032,
    "ImageOrientationPatient": 0x00200037,
    "FrameOfReferenceUID": 0x00200052,
    "TemporalPositionIdentifier": 0x00200100,
    "ImageComments": 0x00204000,
    "SamplesPerPixel": 0x00280002,
    "PhotometricInterpretation": 0x00280004,
    "NumberOfFrames": 0x00280008,
    "Rows": 0x00280010,
    "Columns": 0x00280011,
    "PixelSpacing": 0x00280030,
    "BitsAllocated": 0x00280100,
    "BitsStored": 0x00280101,
    "HighBit": 0x00280102,
    "PixelRepresentation": 0x00280103,
    "PixelPaddingValue": 0x00280120,
    "PixelPaddingRangeLimit": 0x00280121,
    "WindowCenter": 0x00281050,
    "WindowWidth": 0x00281051,
    "RescaleIntercept": 0x00281052,
    "RescaleSlope": 0x00281053,
    "RescaleType": 0x00281054,
}
"""Keyword -> tag."""

TAG_LIST: Final = list(TAGS.values())

_NUMBER_LIKE: Final = re.compile(r"[-+0-9.,eE]{1,16}|[-+]?(nan|inf)", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Elements:
    """Elements of one file's header.

    Attributes:
        values: raw elements by tag.
        syntax: transfer syntax UID.
        inflated: head of a deflated data set, standing at the pixels; None for any other.
        start: byte in the file at which a deflated data set starts.
    """

    values: Mapping[int, Any]
    syntax: str
    inflated: BinaryIO | None = None
    start: int = 0


def text(header: Elements, tag: int) -> str:
    """Value of a text element, trimmed; empty where absent."""
    element = header.values.get(tag)
    value = getattr(element, "value", None)
    if value is None:
        return ""
    if isinstance(value, bytes):
        return value.decode("latin-1").strip(" \0")
    return str(value).strip(" \0")


def parts(header: Elements, tag: int) -> tuple[str, ...]:
    """Values of a multi-valued text element."""
    whole = text(header, tag)
    return tuple(part.strip(" \0") for part in whole.split("\\")) if whole else ()


FURTHEST_MM: Final = 1e5
"""Nothing that is shown lies further from the origin of its coordinates."""

_SIZES: Final[Mapping[str, tuple[float, float, str]]] = {
    "ImagePositionPatient": (0.0, FURTHEST_MM, " mm"),
    "PixelSpacing": (1e-4, 1e3, " mm"),
    "SliceThickness": (0.0, 1e4, " mm"),
    "RescaleSlope": (1e-9, 1e6, ""),
    "RescaleIntercept": (0.0, 1e7, ""),
}
"""Sizes between which a number of a picture lies: no scanner comes near them, and what lies beyond
is finite until something is computed of it."""

_ANY_SIZE: Final = (0.0, 1e12, "")


def require_size(name: str, values: Sequence[float]) -> None:
    """Refuse a number of which nothing can be computed; zeros are judged by who uses them.

    Raises:
        FileDamagedError: naming the field, the value and what would be valid.
    """
    least, most, unit = _SIZES.get(name, _ANY_SIZE)
    for value in values:
        if value != 0.0 and not least <= abs(value) <= most:
            raise FileDamagedError(
                sentence(
                    "{name} is {quantity:g}{unit}; its size must lie between {least:g} and "
                    "{most:g}{unit}",
                    name=name,
                    quantity=value,
                    unit=unit,
                    least=least,
                    most=most,
                )
            )


def numbers(header: Elements, tag: int, name: str, count: int | None = None) -> tuple[float, ...]:
    """Values of a decimal string; empty where absent.

    Raises:
        FileDamagedError: if one is not a finite number, or of no size that can be computed with, or
            there are not `count` of them.
    """
    strings = parts(header, tag)
    if not strings:
        return ()
    try:
        values = tuple(float(string) for string in strings)
    except ValueError:
        values = (math.nan,)
    wanted = f" (needs {count})" if count else ""
    if not all(map(math.isfinite, values)) or (count and len(values) != count):
        raise FileDamagedError(
            sentence(
                "{name} does not hold finite numbers{wanted}{quoted}",
                name=name,
                wanted=wanted,
                quoted=_quoted(strings),
            )
        )
    require_size(name, values)
    return values


def _quoted(strings: tuple[str, ...]) -> str:
    """Quote a mistaken number; any other text may name a person and is left out."""
    if not all(_NUMBER_LIKE.fullmatch(string) for string in strings):
        return ""
    written = "\\".join(strings)
    return f", not '{written}'"


def integer(header: Elements, tag: int, name: str, signed: bool = False) -> int | None:
    """Value of an unsigned or signed 16-bit element, or of an integer string; None where absent.

    Raises:
        FileDamagedError: if it has another length; names the element.
    """
    element = header.values.get(tag)
    value = getattr(element, "value", None)
    if value is None or value == b"":
        return None
    if isinstance(value, bytes):
        if getattr(element, "VR", None) == "IS":
            return _integer_string(value, name)
        if len(value) < 2:
            raise FileDamagedError(
                sentence(
                    "{name} has {byte_length} bytes; 2 are needed",
                    name=name,
                    byte_length=len(value),
                )
            )
        order = "<" if getattr(element, "is_little_endian", True) else ">"
        return int(struct.unpack_from(order + ("h" if signed else "H"), value)[0])
    return int(value)


def integer_string(header: Elements, tag: int, name: str) -> int | None:
    """Value of an integer string; None where absent.

    Raises:
        FileDamagedError: if it is not an integer; names the element.
    """
    string = text(header, tag)
    return _integer_string(string.encode("latin-1"), name) if string else None


def _integer_string(value: bytes, name: str) -> int | None:
    string = value.decode("latin-1").strip(" \0")
    if not string:
        return None
    try:
        return int(float(string))
    except (ValueError, OverflowError):
        raise FileDamagedError(sentence("{name} is not an integer", name=name)) from None


def check_orientation(orientation: tuple[float, ...]) -> None:
    """See that direction cosines are what they should be, to a thousandth.

    Raises:
        FileDamagedError: if they are not two perpendicular unit vectors.
    """
    row, column = orientation[:3], orientation[3:]
    norms = [sum(v * v for v in vector) ** 0.5 for vector in (row, column)]
    dot = sum(a * b for a, b in zip(row, column, strict=True))
    if max(abs(norm - 1.0) for norm in norms) > 1e-3 or abs(dot) > 1e-3:
        raise FileDamagedError(
            sentence(
                "ImageOrientationPatient {orientation} is not two perpendicular unit vectors",
                orientation=orientation,
            )
        )
