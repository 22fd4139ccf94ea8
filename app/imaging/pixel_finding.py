"""Finding the pixels of a file, and what is wrong with them, without decoding any.

Encapsulated pixel data: which bytes of the file are which frame (PS3.5 A.4).
"""

import struct
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import BinaryIO

from app.core.messages import sentence
from app.imaging import codestream
from app.imaging.deflated import HEAD_BYTES
from app.imaging.elements import Elements
from app.imaging.errors import FileDamagedError
from app.imaging.pixel_data import (
    DECODERS,
    DEFLATED,
    EXPLICIT_BIG,
    EXPLICIT_LITTLE,
    IMPLICIT_LITTLE,
    RAW,
    PixelData,
    PixelFormat,
    Stamp,
)

_ITEM = (0xFFFE, 0xE000)
_END = (0xFFFE, 0xE0DD)
_UNDEFINED = 0xFFFFFFFF

TRUNCATED = "truncated"
"""What is said of a file that ends too early begins with this."""

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
            raise FileDamagedError(sentence("its compressed pixels are damaged"))
        at = stream.tell()
        if at + length > size:
            break
        places.append((at, length))
        stream.seek(length, 1)
    raise FileDamagedError(
        sentence("{truncated}: its compressed pixels do not end", truncated=TRUNCATED)
    )


def _with_table(stream: BinaryIO, places: list[Place]) -> Fragments:
    if len(places) < 2:
        raise FileDamagedError(sentence("its compressed pixels are empty"))
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
    raise FileDamagedError(
        sentence(
            "its {fragments} compressed fragments are not {frames} frames",
            fragments=len(places),
            frames=frames,
        )
    )


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
            raise FileDamagedError(sentence("it ends within its compressed pixels; read it again"))
    return parts[0] if len(parts) == 1 else b"".join(parts)


_PIXEL_DATA = (0x7FE0, 0x0010)
_PIXEL_VRS = (b"OB", b"OW", b"UN")
_RAW_NAMES = {
    IMPLICIT_LITTLE: "Implicit VR Little Endian",
    EXPLICIT_LITTLE: "Explicit VR Little Endian",
    EXPLICIT_BIG: "Explicit VR Big Endian",
    DEFLATED: "Deflated Explicit VR Little Endian",
}


def find_pixels(stream: BinaryIO, header: Elements, form: PixelFormat) -> PixelData:
    """Find the pixel data, `stream` standing where the header ended.

    Args:
        stream: the file.
        header: its elements.
        form: as they give it.
    """
    stamp = Stamp.of(stream)
    found = _find(stream, stamp.size, header, form)
    return replace(found, stamp=stamp)


def _find(stream: BinaryIO, size: int, header: Elements, form: PixelFormat) -> PixelData:
    syntax = header.syntax
    if syntax not in RAW and syntax not in DECODERS and syntax != DEFLATED:
        return PixelData(
            syntax, None, sentence("no decoder for transfer syntax {named}", named=_named(syntax))
        )
    body = header.inflated or stream
    length, missing = _element_length(body, syntax != EXPLICIT_BIG)
    if missing:
        return PixelData(syntax, None, missing.format(size=size))
    if length == _UNDEFINED and syntax not in DECODERS:
        return PixelData(
            syntax,
            None,
            sentence(
                "its pixels are of undefined length, as only compressed ones may be (PS3.5 A.4), "
                "and its transfer syntax is {raw_names}; have it sent again",
                raw_names=_RAW_NAMES[syntax],
            ),
        )
    if header.inflated is not None:
        return _deflated(header.inflated, header.start, length, form)
    if syntax in RAW:
        return _raw(syntax, stream, size, length, form)
    return _encoded(syntax, stream, size, length, form)


def _named(syntax: str) -> str:
    """Name of a transfer syntax; one that is no UID may say anything, and is not repeated."""
    from pydicom import config
    from pydicom.uid import UID

    if not set(syntax) <= set("0123456789."):
        return sentence("(what stands there is no UID)")
    name = UID(syntax, config.IGNORE).name
    return repr(syntax[:64]) if name == syntax else f"{syntax} ({name})"


def _element_length(stream: BinaryIO, little: bool) -> tuple[int, str]:
    """Length of the pixels, `stream` then standing at them; or what to say if there are none.

    Whether the element names its representation is seen by itself, whatever the transfer syntax
    says: read as a length, the name of one would be odd, which no length is.
    """
    head = stream.read(8)
    order = "<" if little else ">"
    if len(head) < 8:
        return 0, sentence("{truncated}: {{size}} bytes and no pixels in them", truncated=TRUNCATED)
    if struct.unpack(order + "HH", head[:4]) != _PIXEL_DATA:
        return 0, sentence("no pixels in it (PixelData is missing)")
    if head[4:6] not in _PIXEL_VRS:
        return int(struct.unpack(order + "L", head[4:])[0]), ""
    tail = stream.read(4)
    if len(tail) < 4:
        return 0, sentence("{truncated}: {{size}} bytes and no pixels in them", truncated=TRUNCATED)
    return int(struct.unpack(order + "L", tail)[0]), ""


def _needed(form: PixelFormat) -> int:
    return form.frame_bytes * max(form.frames, 1)


def _raw(syntax: str, stream: BinaryIO, size: int, length: int, form: PixelFormat) -> PixelData:
    offset, needed = stream.tell(), _needed(form)
    if _starts_with_item(stream, length):
        what = sentence(
            "its pixels are compressed, and its transfer syntax is {raw_names}",
            raw_names=_RAW_NAMES[syntax],
        )
        return PixelData(
            syntax, None, sentence("{contradiction}; have it sent again", contradiction=what)
        )
    if size - offset < min(length, needed):
        missing = needed - (size - offset)
        what = sentence(
            "{truncated}: the last {missing} bytes of pixels are missing",
            truncated=TRUNCATED,
            missing=missing,
        )
        return PixelData(syntax, None, what)
    wrong = _wrong_length(length, needed) or _wrong_bits(stream, needed, syntax, form)
    behind = _behind(min(length, size - offset), needed)
    return PixelData(syntax, offset, wrong, behind=behind)


def _starts_with_item(stream: BinaryIO, length: int) -> bool:
    """Return whether what stands there are items to their end, as compressed pixels are."""
    offset = stream.tell()
    head = stream.read(8)
    starts = len(head) == 8 and struct.unpack("<HH", head[:4]) == _ITEM
    if starts:
        try:
            walk(stream, offset, offset + length)
        except FileDamagedError:
            starts = False
    stream.seek(offset)
    return starts


def _wrong_bits(stream: BinaryIO, needed: int, syntax: str, form: PixelFormat) -> str:
    """Say whether bits are in use that HighBit and BitsStored leave empty; looked at if they do."""
    below = form.bits_below
    if below < 1 or form.bits_stored < 1 or form.bits_allocated not in (8, 16):
        return ""
    data, mask = stream.read(needed), (1 << below) - 1
    step = form.bits_allocated // 8
    lowest = step - 1 if syntax == EXPLICIT_BIG else 0
    used = any(value & mask for value in set(data[lowest::step]))
    if step == 2:
        used = used or any(value & (mask >> 8) for value in set(data[1 - lowest :: step]))
    return form.bits_below_used if used else ""


def _wrong_length(length: int, needed: int) -> str:
    """Too few bytes, or several times as many: then frames or bits are not as the header says."""
    if length < needed:
        return sentence(
            "{length} bytes of pixels where {needed} are needed", length=length, needed=needed
        )
    times, rest = divmod(length, needed) if needed else (1, 0)
    if times > 1 and rest <= 1:
        return sentence(
            "{length} bytes of pixels where {needed} are needed, {times} times as many: "
            "NumberOfFrames or BitsAllocated is not what it should be",
            length=length,
            needed=needed,
            times=times,
        )
    return ""


def _behind(length: int, needed: int) -> int:
    return max(length - needed - needed % 2, 0)


def _deflated(body: BinaryIO, start: int, length: int, form: PixelFormat) -> PixelData:
    """Judge as far as the data set was inflated; what is behind shows when it is read."""
    offset, needed = body.tell(), _needed(form)
    inflated = body.seek(0, 2)
    damage = _wrong_length(length, needed)
    if inflated < HEAD_BYTES and inflated - offset < min(length, needed):
        missing = needed - (inflated - offset)
        damage = sentence(
            "{truncated}: the last {missing} bytes of pixels are missing",
            truncated=TRUNCATED,
            missing=missing,
        )
    return PixelData(DEFLATED, offset, damage, start, behind=_behind(length, needed))


def _encoded(syntax: str, stream: BinaryIO, size: int, length: int, form: PixelFormat) -> PixelData:
    start = stream.tell()
    if length != _UNDEFINED and struct.unpack("<HH", stream.read(4).ljust(4)) != _ITEM:
        return PixelData(
            syntax,
            None,
            sentence(
                "its {length} bytes of pixels are not compressed, and its transfer syntax is "
                "{named}; have it sent again",
                length=length,
                named=_named(syntax),
            ),
        )
    try:
        places = frame_places(stream, walk(stream, start, size), max(form.frames, 1))
        wrong = codestream.contradiction(_head(stream, places[0]), syntax, form)
    except FileDamagedError as error:
        wrong = str(error)
    return PixelData(syntax, start, wrong)


def _head(stream: BinaryIO, places: tuple[Place, ...]) -> bytes:
    """First bytes of a frame, whose fragments may be as short as they like."""
    wanted, parts = codestream.HEAD, []
    for at, length in places:
        parts.append((at, min(length, wanted)))
        wanted -= parts[-1][1]
        if not wanted:
            break
    return frame_bytes(stream, parts)
