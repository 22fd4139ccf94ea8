"""Encapsulated pixel data: which bytes of the file are which frame (PS3.5 A.4)."""

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import BinaryIO

from app.imaging.errors import FileDamagedError

_ITEM = (0xFFFE, 0xE000)
_END = (0xFFFE, 0xE0DD)
_UNDEFINED = 0xFFFFFFFF

Place = tuple[int, int]
"""Byte in the file, and number of bytes."""
_STARTS = (b"\xff\xd8\xff", b"\xff\x4f\xff\x51", b"\x00\x00\x00\x0cjP")


@dataclass(frozen=True, slots=True)
class Fragments:
    """The items of encapsulated pixel data.

    Attributes:
        offsets: basic offset table; empty where the file has none.
        places: byte in the file and length of each fragment, the offset table left out.
    """

    offsets: tuple[int, ...]
    places: tuple[Place, ...]


def walk(stream: BinaryIO, start: int, size: int) -> Fragments:
    """Walk the items to their end.

    Args:
        stream: the file.
        start: byte at which the first item, the offset table, starts.
        size: of the file in bytes.

    Raises:
        FileDamagedError: if they do not end, or something else stands between them.
    """
    stream.seek(start)
    places: list[Place] = []
    while len(head := stream.read(8)) == 8:
        group, element, length = struct.unpack("<HHL", head)
        if (group, element) == _END:
            return _with_table(stream, places)
        if (group, element) != _ITEM or length == _UNDEFINED:
            raise FileDamagedError("its compressed pixels are damaged")
        at = stream.tell()
        if at + length > size:
            break
        places.append((at, length))
        stream.seek(length, 1)
    raise FileDamagedError("truncated: its compressed pixels do not end")


def _with_table(stream: BinaryIO, places: list[Place]) -> Fragments:
    if len(places) < 2:
        raise FileDamagedError("its compressed pixels are empty")
    at, length = places[0]
    stream.seek(at)
    count = length // 4
    return Fragments(struct.unpack(f"<{count}L", stream.read(4 * count)), tuple(places[1:]))


def frame_places(
    stream: BinaryIO, fragments: Fragments, frames: int
) -> tuple[tuple[Place, ...], ...]:
    """Group fragments by frame: one each, by the offset table, or by what starts a code stream.

    Raises:
        FileDamagedError: if that does not make `frames` frames.
    """
    places = fragments.places
    if frames == 1:
        return (places,)
    if len(places) == frames:
        return tuple((place,) for place in places)
    for starts in (_by_table(fragments), _by_start(stream, places)):
        if len(starts) == frames and starts[0] == 0:
            ends = (*starts[1:], len(places))
            return tuple(places[a:b] for a, b in zip(starts, ends, strict=True))
    raise FileDamagedError(f"its {len(places)} compressed fragments are not {frames} frames")


def _by_table(fragments: Fragments) -> list[int]:
    first = fragments.places[0][0] - 8
    number = {at - 8 - first: index for index, (at, _) in enumerate(fragments.places)}
    starts = [number.get(offset, -1) for offset in fragments.offsets]
    return starts if starts == sorted(set(starts)) else []


def _by_start(stream: BinaryIO, places: Sequence[Place]) -> list[int]:
    starts = []
    for index, (at, _) in enumerate(places):
        stream.seek(at)
        if stream.read(8).startswith(_STARTS):
            starts.append(index)
    return starts


def frame_bytes(stream: BinaryIO, places: Sequence[Place]) -> bytes:
    """Read one frame: its fragments, joined.

    Raises:
        FileDamagedError: if the file has become shorter.
    """
    parts = []
    for at, length in places:
        stream.seek(at)
        parts.append(stream.read(length))
        if len(parts[-1]) < length:
            raise FileDamagedError("it ends within its compressed pixels; read it again")
    return parts[0] if len(parts) == 1 else b"".join(parts)
