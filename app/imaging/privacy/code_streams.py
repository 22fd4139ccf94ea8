"""Encoded frames with what decodes to pixels and nothing else, still in their own encoding.

Comments, application segments, index tables, what stands behind the end and between the parts:
anything that a decoder passes over can hold text and is left out. A frame that is built in a way
that is not known here is not guessed at.
"""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from itertools import pairwise
from typing import Final

from app.imaging.pixel_data import RLE

_JPEG, _J2K = b"\xff\xd8", b"\xff\x4f\xff\x51"
_SOF: Final = (0xC0, 0xC1, 0xC2, 0xC3, 0xC9, 0xCA, 0xCB, 0xF7)
_DHT, _DAC, _EOI, _SOS, _DQT, _DNL, _DRI, _LSE = 0xC4, 0xCC, 0xD9, 0xDA, 0xDB, 0xDC, 0xDD, 0xF8
_APP0, _APP15, _COM = 0xE0, 0xEF, 0xFE
_JFIF: Final = re.compile(rb"JFIF\0\x01[\0-\x02][\0-\x02].{4}\0\0", re.DOTALL)
"""Version, density and no thumbnail."""

_SOT, _SOD, _EOC, _J2K_COM = 0xFF90, 0xFF93, 0xFFD9, 0xFF64
_TLM, _PLM, _PLT, _CRG = 0xFF55, 0xFF57, 0xFF58, 0xFF63
_KEPT_IN_J2K: Final = (
    0xFF50,  # CAP
    0xFF51,  # SIZ
    0xFF52,  # COD
    0xFF53,  # COC
    0xFF59,  # CPF
    0xFF5C,  # QCD
    0xFF5D,  # QCC
    0xFF5E,  # RGN
    0xFF5F,  # POC
)
_ENCODERS: Final = re.compile(
    rb"\0\x01(Created by (GDCM/)?OpenJPEG version [0-9.]{1,12}|Kakadu-v?[0-9.]{1,12})\0?"
)
"""Comments that name the program that encoded, and nothing else, may stay."""


class NotKnownError(Exception):
    """A frame is not built as this module knows it."""


def only_pixels(frame: bytes, syntax: str, pixels: int) -> bytes:
    """Return a frame without anything that is not decoded to pixels; of even length.

    Args:
        frame: its fragments, joined.
        syntax: transfer syntax.
        pixels: of a frame, by the file's header.

    Raises:
        NotKnownError: if it is built in another way than is known here.
    """
    try:
        if syntax == RLE:
            kept = _rle(frame, pixels)
        elif frame.startswith(_JPEG):
            kept = _jpeg(frame)
        elif frame.startswith(_J2K):
            kept = _jpeg_2000(frame)
        else:
            raise NotKnownError
    except (struct.error, IndexError) as error:
        raise NotKnownError from error
    return kept + b"\0" * (len(kept) % 2)


def _jpeg(frame: bytes) -> bytes:
    """JPEG (ITU-T T.81 annex B) and JPEG-LS (T.87 annex C)."""
    parts, at, ls = [_JPEG], 2, False
    while True:
        if frame[at] != 0xFF:
            raise NotKnownError
        while frame[at + 1] == 0xFF:  # a fill byte: says nothing, and makes lengths even
            parts.append(b"\xff")
            at += 1
        marker = frame[at + 1]
        if marker == _EOI:
            return b"".join([*parts, frame[at : at + 2]])
        (length,) = struct.unpack_from(">H", frame, at + 2)
        body = frame[at + 4 : at + 2 + length]
        if len(body) != length - 2:
            raise NotKnownError
        ls |= marker == 0xF7
        if _is_whole(marker, body):
            parts.append(b"\xff" + frame[at + 1 : at + 2 + length])
        elif not (_APP0 <= marker <= _APP15 or marker == _COM):
            raise NotKnownError
        at += 2 + length
        if marker == _SOS:
            end = _scan_end(frame, at, ls)
            parts.append(frame[at:end])
            at = end


def _is_whole(marker: int, body: bytes) -> bool:
    """Tell whether a segment takes part in decoding and holds no byte too many."""
    if marker in _SOF:
        return len(body) == 6 + 3 * body[5]
    if marker == _SOS:
        return len(body) == 4 + 2 * body[0]
    if marker in (_DRI, _DNL):
        return len(body) == 2
    if marker == _DAC:
        return len(body) % 2 == 0
    if marker == _LSE:
        return len(body) == 11 and body[0] == 1
    if marker == _APP0:
        return _JFIF.fullmatch(body) is not None
    if marker == _DHT:
        return _is_filled(body, lambda at: 17 + sum(body[at + 1 : at + 17]))
    return marker == _DQT and _is_filled(body, lambda at: 1 + 64 * (1 + (body[at] >> 4)))


def _is_filled(body: bytes, size: Callable[[int], int]) -> bool:
    at = 0
    while at < len(body):
        at += size(at)
    return at == len(body)


def _scan_end(frame: bytes, at: int, ls: bool) -> int:
    """Return the byte of the marker behind the coded data that start here."""
    while (at := frame.find(b"\xff", at)) >= 0:
        after = frame[at + 1]
        data = after < 0x80 if ls else after == 0
        if not data and not 0xD0 <= after <= 0xD7:
            return at
        at += 2 if data or after != 0xFF else 1
    raise NotKnownError


def _jpeg_2000(frame: bytes) -> bytes:
    """Code stream of JPEG 2000 (ITU-T T.800 annex A)."""
    head, at = _segments(frame, 2, (_SOT,))
    parts: list[bytes] = []
    changed = False
    while (marker := struct.unpack_from(">H", frame, at)[0]) == _SOT:
        length, tile, size = struct.unpack_from(">HHL", frame, at + 2)
        end = at + size if size else frame.rindex(b"\xff\xd9")
        if length != 10 or not at + 14 <= end <= len(frame):
            raise NotKnownError
        kept, data = _segments(frame, at + 12, (_SOD,))
        tail = frame[data:end]
        shorter = data - (at + 12) - sum(map(len, kept))
        changed |= shorter > 0
        start = struct.pack(">HHHL", _SOT, 10, tile, size - shorter if size else 0)
        parts += [start, frame[at + 10 : at + 12], *kept, tail]
        at = end
    if marker != _EOC or not parts:
        raise NotKnownError
    if changed:  # lengths of the tiles, an index that may be left out
        head = [part for part in head if part[:2] != b"\xff\x55"]
    return b"".join([frame[:2], *head, *parts, b"\xff\xd9"])


def _segments(frame: bytes, at: int, ends: tuple[int, ...]) -> tuple[list[bytes], int]:
    """Return the segments to keep up to an end marker, and where that stands."""
    kept = []
    while (marker := struct.unpack_from(">H", frame, at)[0]) not in ends:
        (length,) = struct.unpack_from(">H", frame, at + 2)
        body = frame[at + 4 : at + 2 + length]
        if len(body) != length - 2:
            raise NotKnownError
        if (
            marker in _KEPT_IN_J2K
            or marker == _TLM
            or (marker == _J2K_COM and _ENCODERS.fullmatch(body))
        ):
            kept.append(frame[at : at + 2 + length])
        elif marker not in (_J2K_COM, _PLM, _PLT, _CRG):
            raise NotKnownError
        at += 2 + length
    return kept, at


def _rle(frame: bytes, pixels: int) -> bytes:
    """Segments of PackBits (PS3.5 annex G), each as long as it decodes to its pixels."""
    count = struct.unpack_from("<L", frame)[0]
    if not 1 <= count <= 15:
        raise NotKnownError
    offsets = [*struct.unpack_from(f"<{count}L", frame, 4), len(frame)]
    parts, places, at = [], [], 64
    for start, stop in pairwise(offsets):
        part = frame[start : start + _packed_bytes(frame, start, stop, pixels)]
        if frame[start + len(part) : stop] != b"":
            part += b"\0" * (len(part) % 2)
        places.append(at)
        parts.append(part)
        at += len(part)
    table = places + [0] * (15 - count)
    return b"".join([struct.pack("<16L", count, *table), *parts])


def _packed_bytes(frame: bytes, start: int, stop: int, pixels: int) -> int:
    """Return how many bytes of a segment are needed for its pixels."""
    at, done = start, 0
    while done < pixels:
        if at >= stop:
            raise NotKnownError
        control = frame[at]
        if control < 128:
            at, done = at + 2 + control, done + 1 + control
        elif control > 128:
            at, done = at + 2, done + 257 - control
        else:
            raise NotKnownError  # it stands for nothing, and nobody needs it
    if done != pixels or at > stop:
        raise NotKnownError
    return at - start
