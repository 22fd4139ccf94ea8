"""Raw DICOM elements as plain values: quick, without pydicom's conversions and their warnings."""

import math
import re
import struct
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, BinaryIO, Final

from app.imaging.deflated import inflated_head
from app.imaging.element_walk import OddError, Walk
from app.imaging.errors import FileDamagedError
from app.imaging.pixel_data import (
    DECODERS,
    DEFLATED,
    EXPLICIT_BIG,
    IMPLICIT_LITTLE,
    RAW,
)

PREAMBLE: Final = 132
TRANSFER_SYNTAX: Final = 0x00020010
FIRST_PIXEL_TAG: Final = 0x7FE00008
_FIRST_META_TAG: Final = 0x00020000
_FIRST_DATA_TAG: Final = 0x00030000
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


def read_sound(stream: BinaryIO, wanted: frozenset[int]) -> Elements:
    """Read a file that is what it says, and says so as the standard does.

    Raises:
        OddError: for any other.
    """
    walk = Walk(stream, PREAMBLE)
    meta = walk.take(frozenset((TRANSFER_SYNTAX,)), False, _FIRST_META_TAG, _FIRST_DATA_TAG)
    syntax = text(Elements(meta, ""), TRANSFER_SYNTAX)
    if syntax == DEFLATED:
        return _deflated(stream, walk.place, wanted)
    if syntax == EXPLICIT_BIG or (syntax not in DECODERS and syntax not in RAW):
        raise OddError
    implicit = syntax == IMPLICIT_LITTLE
    if walk.is_explicit() == implicit:
        raise OddError
    values = walk.take(wanted, implicit, _FIRST_DATA_TAG, FIRST_PIXEL_TAG)
    stream.seek(walk.place)
    return Elements(values, syntax)


def _deflated(stream: BinaryIO, start: int, wanted: frozenset[int]) -> Elements:
    """Read the elements of a deflated data set, which is explicit and little endian (PS3.5 A.5)."""
    stream.seek(start)
    try:
        body = inflated_head(stream)
    except FileDamagedError as error:
        raise OddError from error
    walk = Walk(body, 0)
    values = walk.take(wanted, False, _FIRST_DATA_TAG, FIRST_PIXEL_TAG)
    body.seek(walk.place)
    return Elements(values, DEFLATED, body, start)


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
        raise FileDamagedError(f"{name} does not hold finite numbers{wanted}{_quoted(strings)}")
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
            raise FileDamagedError(f"{name} has {len(value)} bytes; 2 are needed")
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
        raise FileDamagedError(f"{name} is not an integer") from None


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
            f"ImageOrientationPatient {orientation} is not two perpendicular unit vectors"
        )
