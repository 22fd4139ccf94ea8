"""Raw DICOM elements as plain values: quick, without pydicom's conversions and their warnings."""

import math
import struct
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, BinaryIO, Final

import pydicom
from pydicom.dataelem import RawDataElement
from pydicom.dataset import Dataset
from pydicom.filereader import data_element_generator
from pydicom.tag import BaseTag

from app.imaging.deflated import inflated_head
from app.imaging.errors import FileDamagedError
from app.imaging.pixel_data import (
    DECODERS,
    DEFLATED,
    EXPLICIT_BIG,
    EXPLICIT_LITTLE,
    IMPLICIT_LITTLE,
    RAW,
)

_PREAMBLE: Final = 132
_TRANSFER_SYNTAX: Final = 0x00020010
_FIRST_PIXEL_TAG: Final = 0x7FE00008


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


def read_elements(stream: BinaryIO, wanted: Sequence[int], forced: bool) -> Elements:
    """Read the wanted elements before the pixels; the stream then stands at the pixels.

    Args:
        stream: the file, at its start.
        wanted: tags.
        forced: read although the DICOM preamble is missing.

    Raises:
        FileDamagedError: if the header cannot be parsed.
    """
    try:
        quick = None if forced else _quick(stream, wanted)
        return quick or _thorough(stream, wanted, forced)
    except Exception as error:  # hostile bytes make the parser raise nearly anything
        brief = " ".join(f"{type(error).__name__}: {error}".split())[:120]
        raise FileDamagedError(f"its header cannot be read ({brief})") from error


def _quick(stream: BinaryIO, wanted: Sequence[int]) -> Elements | None:
    """Read a file that is what it says; None for one that needs pydicom's whole care."""
    stream.seek(_PREAMBLE)
    meta = data_element_generator(
        stream, False, True, _after_meta, None, "iso8859", [_TRANSFER_SYNTAX]
    )
    syntax = text(Elements({int(e.tag): e for e in meta}, ""), _TRANSFER_SYNTAX)
    if syntax == DEFLATED:
        return _inflate(stream, wanted)
    if syntax not in DECODERS and syntax not in RAW:
        return None
    start = stream.read(6)
    stream.seek(-len(start), 1)
    implicit, little = syntax == IMPLICIT_LITTLE, syntax != EXPLICIT_BIG
    if (start[4:6].isalpha() and start[4:6].isupper()) == implicit:
        return None
    found = data_element_generator(
        stream, implicit, little, _at_pixels, None, "iso8859", list(wanted)
    )
    return Elements({int(element.tag): element for element in found}, syntax)


def _inflate(stream: BinaryIO, wanted: Sequence[int]) -> Elements:
    """Read the elements of a deflated data set, which is explicit and little endian (PS3.5 A.5)."""
    start = stream.tell()
    body = inflated_head(stream)
    found = data_element_generator(body, False, True, _at_pixels, None, "iso8859", list(wanted))
    return Elements({int(element.tag): element for element in found}, DEFLATED, body, start)


def _after_meta(tag: BaseTag, vr: str | None, length: int) -> bool:
    return tag >> 16 != 2


def _at_pixels(tag: BaseTag, vr: str | None, length: int) -> bool:
    return tag >= _FIRST_PIXEL_TAG


def _thorough(stream: BinaryIO, wanted: Sequence[int], forced: bool) -> Elements:
    stream.seek(0)
    with warnings.catch_warnings():  # what is wrong with a file is said by name, by us
        warnings.simplefilter("ignore")
        header = pydicom.dcmread(
            stream, stop_before_pixels=True, specific_tags=list(wanted), force=forced
        )
    values = {tag: header.get_item(tag) for tag in wanted if tag in header}
    meta: Dataset = getattr(header, "file_meta", Dataset())
    syntax = str(meta.get("TransferSyntaxUID", "") or "")
    return Elements(values, syntax or _assumed_syntax(header))


def _assumed_syntax(header: Dataset) -> str:
    implicit, little = header.original_encoding
    if little is False:
        return EXPLICIT_BIG
    return IMPLICIT_LITTLE if implicit else EXPLICIT_LITTLE


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


def numbers(header: Elements, tag: int, name: str, count: int | None = None) -> tuple[float, ...]:
    """Values of a decimal string; empty where absent.

    Raises:
        FileDamagedError: if one is not a finite number, or there are not `count` of them.
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
        raise FileDamagedError(f"{name} does not hold finite numbers{wanted}")
    return values


def integer(header: Elements, tag: int, name: str, signed: bool = False) -> int | None:
    """Value of an unsigned or signed 16-bit element, or of an integer string; None where absent.

    Raises:
        FileDamagedError: if it has another length; names the element.
    """
    element = header.values.get(tag)
    value = getattr(element, "value", None)
    if value is None or value == b"":
        return None
    if isinstance(element, RawDataElement) and isinstance(value, bytes):
        if element.VR == "IS":
            return _integer_string(value, name)
        if len(value) < 2:
            raise FileDamagedError(f"{name} has {len(value)} bytes; 2 are needed")
        order = "<" if element.is_little_endian else ">"
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
        raise FileDamagedError(f"{name} is not an integer") from None
