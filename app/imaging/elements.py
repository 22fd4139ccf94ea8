"""Raw DICOM elements as plain values: quick, without pydicom's conversions and their warnings."""

import math
import struct

from pydicom.dataelem import RawDataElement
from pydicom.dataset import Dataset

from app.imaging.errors import FileDamagedError


def text(header: Dataset, tag: int) -> str:
    """Value of a text element, trimmed; empty where absent."""
    element = header.get_item(tag)
    value = getattr(element, "value", None)
    if value is None:
        return ""
    if isinstance(value, bytes):
        return value.decode("latin-1").strip(" \0")
    return str(value).strip(" \0")


def parts(header: Dataset, tag: int) -> tuple[str, ...]:
    """Values of a multi-valued text element."""
    whole = text(header, tag)
    return tuple(part.strip(" \0") for part in whole.split("\\")) if whole else ()


def numbers(header: Dataset, tag: int, name: str, count: int | None = None) -> tuple[float, ...]:
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
        raise FileDamagedError(f"{name} is {text(header, tag)[:80]!r}: not finite numbers{wanted}")
    return values


def integer(header: Dataset, tag: int, name: str, signed: bool = False) -> int | None:
    """Value of an unsigned or signed 16-bit element, or of an integer string; None where absent.

    Raises:
        FileDamagedError: if it has another length; names the element.
    """
    element = header.get_item(tag)
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


def integer_string(header: Dataset, tag: int, name: str) -> int | None:
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
        raise FileDamagedError(f"{name} is {string[:40]!r}: not an integer") from None
