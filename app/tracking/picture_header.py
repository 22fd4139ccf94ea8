"""How many pixels a picture file says that it has, told from its first bytes.

A file of a few kilobytes may stand for gigabytes: that is asked before any of it is decoded. Only
the formats that are read by their names are known; whatever else a decoder would take is none.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from typing import Final

Size = tuple[int, int]
"""Columns and rows."""


def size_of(data: bytes) -> Size | None:
    """Return columns and rows of a picture file; None if it is none, or its header is cut off."""
    for begins, read in _FORMATS.items():
        if data.startswith(begins):
            try:
                return read(data)
            except (struct.error, ValueError, IndexError):
                return None
    return None


def _png(data: bytes) -> Size:
    width, height = struct.unpack_from(">II", data, 16)
    return width, height


def _jpeg(data: bytes) -> Size | None:
    """Size in the largest frame header (SOFn of ITU-T T.81, B.1.1.3) before the pixels."""
    at, found = 2, None
    while at + 4 <= len(data):
        if data[at] != 0xFF:
            at += 1
            continue
        mark = data[at + 1]
        if mark in (0xFF, 0x00, 0x01) or 0xD0 <= mark <= 0xD8:
            at += 1 if mark == 0xFF else 2
            continue
        if mark in (0xDA, 0xD9):  # pixels, or the end
            break
        if 0xC0 <= mark <= 0xCF and mark not in (0xC4, 0xC8, 0xCC):
            height, width = struct.unpack_from(">HH", data, at + 5)
            found = max(found or (0, 0), (width, height), key=lambda size: size[0] * size[1])
        at += 2 + struct.unpack_from(">H", data, at + 2)[0]
    return found


def _bmp(data: bytes) -> Size:
    if struct.unpack_from("<I", data, 14)[0] == 12:
        width, height = struct.unpack_from("<HH", data, 18)
    else:
        width, height = struct.unpack_from("<ii", data, 18)
    return abs(width), abs(height)


def _webp(data: bytes) -> Size | None:
    """Size of the canvas or of the first picture (RFC 9649), whichever the file begins with."""
    if data[8:12] != b"WEBP":
        return None
    kind = data[12:16]
    if kind == b"VP8X":
        width, height = data[24:27], data[27:30]  # 24 bits each, less one
        return 1 + int.from_bytes(width, "little"), 1 + int.from_bytes(height, "little")
    if kind == b"VP8L":
        bits = struct.unpack_from("<I", data, 21)[0]
        return 1 + (bits & 0x3FFF), 1 + (bits >> 14 & 0x3FFF)
    width, height = struct.unpack_from("<HH", data, 26)
    return width & 0x3FFF, height & 0x3FFF


def _tiff(data: bytes) -> Size | None:
    """Size of the first picture (tags 256 and 257 of TIFF 6.0), of TIFF (42) or BigTIFF (43)."""
    order = "<" if data[:2] == b"II" else ">"
    big = struct.unpack_from(f"{order}H", data, 2)[0] == 43
    at = struct.unpack_from(f"{order}{'Q' if big else 'I'}", data, 8 if big else 4)[0]
    entries = struct.unpack_from(f"{order}{'Q' if big else 'H'}", data, at)[0]
    size, value, first = (20, 12, at + 8) if big else (12, 8, at + 2)
    found: dict[int, int] = {}
    for place in range(first, first + size * min(entries, 1000), size):
        tag, kind = struct.unpack_from(f"{order}HH", data, place)
        if tag in (256, 257) and kind in _WHOLE:
            found[tag] = struct.unpack_from(f"{order}{_WHOLE[kind]}", data, place + value)[0]
    return (found[256], found[257]) if len(found) == 2 else None


def _netpbm(data: bytes) -> Size | None:
    head = re.match(rb"P[1-6](?:\s|#[^\n]*\n)+(\d{1,9})(?:\s|#[^\n]*\n)+(\d{1,9})\s", data[:4096])
    return None if head is None else (int(head[1]), int(head[2]))


_WHOLE: Final = {3: "H", 4: "I", 16: "Q"}
"""Types of TIFF that hold a whole number: SHORT, LONG, LONG8."""

_FORMATS: Final[dict[bytes, Callable[[bytes], Size | None]]] = {
    b"\x89PNG\r\n\x1a\n": _png,
    b"\xff\xd8\xff": _jpeg,
    b"BM": _bmp,
    b"RIFF": _webp,
    b"II*\0": _tiff,
    b"II+\0": _tiff,
    b"MM\0*": _tiff,
    b"MM\0+": _tiff,
    **{b"P%d" % n: _netpbm for n in range(1, 7)},
}
