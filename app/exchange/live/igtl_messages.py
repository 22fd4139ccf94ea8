"""OpenIGTLink messages as bytes, versions 1 to 3 of the protocol: header, body, metadata, CRC.

Everything is big-endian. A header has 58 bytes: version, type (12), device name (20), time stamp
(32.32 seconds since 1970), size of the body, CRC-64 of the body (ECMA-182). Header version 2, of
protocol 3, puts an extended header of 12 bytes before the content and metadata behind it.
Written after the protocol's documents (openigtlink.org, "Protocol"); tested by the messages that
the protocol's own library keeps as its standard, and against `pyigtl`.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.exchange.errors import LinkMessageError

PORT: Final = 18944
"""The protocol's port."""

HEADER: Final = struct.Struct(">H12s20sQQQ")
EXTENDED: Final = struct.Struct(">HHII")
VERSIONS: Final = (1, 2, 3)
"""Header versions that are read; 1 and 2 are written."""

ASCII, UTF8 = 3, 106
"""IANA's numbers of character sets."""

_TEXT_CODECS: Final = {ASCII: "ascii", 4: "latin-1", UTF8: "utf-8"}
_POINT: Final = struct.Struct(">64s32s4B4f20s")
_STATUS: Final = struct.Struct(">Hq20s")
_IMAGE: Final = struct.Struct(">HBBBB3H12f3H3H")
_INT16, _LITTLE, _RAS = 4, 2, 1

STATUS_OK, STATUS_NOT_READY, STATUS_NOT_PRESENT, STATUS_ENDS = 1, 13, 16, 19
"""Codes of a STATUS message."""


@dataclass(frozen=True, slots=True)
class Message:
    """A message that was read.

    Attributes:
        kind: its type, `TRANSFORM`, `GET_STATUS`, …
        device: name of the device.
        time: time stamp [s since 1970]; 0 where none is given.
        version: of its header.
        content: body without extended header and metadata.
        metadata: by key; empty in version 1.
    """

    kind: str
    device: str
    time: float
    version: int
    content: bytes
    metadata: Mapping[str, str] = field(default_factory=dict)


def checksum(body: bytes) -> int:
    """Return the CRC-64 of ECMA-182: polynomial 0x42F0E1EBA9EA3693, most significant bit first,
    from zero, not inverted.
    """
    return int(_crc64(np.frombuffer(body, dtype=np.uint8), _table()))


@lru_cache(1)
def _table() -> NDArray[np.uint64]:
    rows = []
    for byte in range(256):
        value = byte << 56
        for _ in range(8):
            value = (value << 1) ^ (0x42F0E1EBA9EA3693 if value >> 63 else 0)
            value &= 0xFFFFFFFFFFFFFFFF
        rows.append(value)
    return np.array(rows, dtype=np.uint64)


@njit
def _crc64(data: NDArray[np.uint8], table: NDArray[np.uint64]) -> np.uint64:
    crc = np.uint64(0)
    for byte in data:
        place = (crc >> np.uint64(56)) ^ np.uint64(byte)
        crc = table[place & np.uint64(255)] ^ (crc << np.uint64(8))
    return crc


# --- writing ------------------------------------------------------------------------------------
def packed(
    kind: str,
    device: str,
    time: float,
    content: bytes,
    version: int = 1,
    metadata: Mapping[str, str] | None = None,
    number: int = 0,
) -> bytes:
    """Return a whole message.

    Args:
        kind: its type, at most 12 characters.
        device: its name; what does not fit into 20 bytes is cut off.
        time: [s since 1970].
        content: of the body.
        version: of the header; in version 1 metadata are left out.
        metadata: keys and values.
        number: of the message, in the extended header.
    """
    body = content
    if version >= 2:
        index, texts = _index(metadata or {})
        extended = EXTENDED.pack(EXTENDED.size, len(index), len(texts), number & 0xFFFFFFFF)
        body = extended + content + index + texts
    stamp = int(time) << 32 | int((time - int(time)) * 2**32) if time > 0.0 else 0
    name = device.encode()[:20]
    crc = checksum(body)
    return HEADER.pack(version, kind.encode(), name, stamp, len(body), crc) + body


def _index(metadata: Mapping[str, str]) -> tuple[bytes, bytes]:
    index, texts = struct.pack(">H", len(metadata)), b""
    for key, value in metadata.items():
        name, text = key.encode(), value.encode()
        charset = ASCII if value.isascii() else UTF8
        index += struct.pack(">HHI", len(name), charset, len(text))
        texts += name + text
    return index, texts


def transform(matrix: FloatArray) -> bytes:
    """Return the content of a TRANSFORM: a matrix [mm], shape (4, 4), column by column."""
    return np.ascontiguousarray(matrix[:3].T, dtype=">f4").tobytes()


def status(code: int, name: str, words: str = "", subcode: int = 0) -> bytes:
    """Return the content of a STATUS."""
    return _STATUS.pack(code, subcode, name.encode()[:20]) + words.encode() + b"\0"


def string(text: str) -> bytes:
    """Return the content of a STRING; what is longer than 65535 bytes is cut off."""
    encoded = text.encode()[:65535]
    return struct.pack(">HH", ASCII if text.isascii() else UTF8, len(encoded)) + encoded


@dataclass(frozen=True, slots=True)
class NamedPoint:
    """One of a POINT: name, place [mm], colour, diameter [mm], group."""

    name: str
    place_mm: tuple[float, float, float]
    rgba: tuple[int, int, int, int] = (255, 255, 0, 255)
    diameter_mm: float = 0.0
    group: str = "Fiducial"
    owner: str = ""


def points(places: tuple[NamedPoint, ...]) -> bytes:
    """Return the content of a POINT."""
    return b"".join(
        _POINT.pack(
            one.name.encode()[:64],
            one.group.encode()[:32],
            *one.rgba,
            *one.place_mm,
            one.diameter_mm,
            one.owner.encode()[:20],
        )
        for one in places
    )


def image(voxels: NDArray[np.int16], ijk_to_ras_mm: FloatArray) -> bytes:
    """Return the content of an IMAGE of one signed number of 16 bits a voxel.

    The protocol places a picture by its middle, and each axis by its step.

    Args:
        voxels: shape (slices, rows, columns).
        ijk_to_ras_mm: (column, row, slice) to RAS [mm], shape (4, 4).
    """
    size = voxels.shape[::-1]
    middle = ijk_to_ras_mm @ [*((n - 1) / 2.0 for n in size), 1.0]
    axes = ijk_to_ras_mm[:3, :3].T.ravel()
    places = (*axes, *middle[:3])
    head = _IMAGE.pack(1, 1, _INT16, _LITTLE, _RAS, *size, *places, 0, 0, 0, *size)
    return head + np.ascontiguousarray(voxels, dtype="<i2").tobytes()


# --- reading ------------------------------------------------------------------------------------
@dataclass(frozen=True, slots=True)
class Head:
    """A header: type, device, time [s since 1970], version, size and CRC of the body."""

    kind: str
    device: str
    time: float
    version: int
    size: int
    crc: int


def head_of(data: bytes, largest: int) -> Head:
    """Read 58 bytes of a header.

    Args:
        data: the bytes.
        largest: size of a body [bytes] that is taken.

    Raises:
        LinkMessageError: if it is none, of another version, or announces more than `largest`.
    """
    version, kind, device, stamp, size, crc = HEADER.unpack(data)
    if version not in VERSIONS:
        raise LinkMessageError(
            sentence(
                "it begins with {first_bytes}, which is no header of version 1 to 3",
                first_bytes=data[:8].hex(" "),
            )
        )
    names = []
    for raw in (kind, device):
        text = raw.partition(b"\0")[0]
        if not text.isascii() or not text.decode("ascii").isprintable():
            raise LinkMessageError(
                sentence("type or device name {raw} is no text", raw=repr(bytes(raw)))
            )
        names.append(text.decode("ascii").strip())
    if not names[0]:
        raise LinkMessageError(sentence("a message has no type"))
    if size > largest:
        raise LinkMessageError(
            sentence(
                "{kind} announces {size} bytes; at most {largest} are taken",
                kind=names[0],
                size=size,
                largest=largest,
            )
        )
    time = (stamp >> 32) + (stamp & 0xFFFFFFFF) / 2**32
    return Head(names[0], names[1], time, version, size, crc)


def message_of(head: Head, body: bytes) -> Message:
    """Read a body.

    Raises:
        LinkMessageError: if its CRC or its metadata are wrong.
    """
    if checksum(body) != head.crc:
        raise LinkMessageError(
            sentence("{kind} of {device}: its CRC is wrong", kind=head.kind, device=head.device)
        )
    content = body
    metadata: dict[str, str] = {}
    if head.version >= 2:
        content, metadata = _extended(head, body)
    return Message(head.kind, head.device, head.time, head.version, content, metadata)


def _extended(head: Head, body: bytes) -> tuple[bytes, dict[str, str]]:
    try:
        size, index_size, text_size, _ = EXTENDED.unpack_from(body)
        end = len(body) - index_size - text_size
        if size < EXTENDED.size or not size <= end:
            raise ValueError
        index, texts = body[end : end + index_size], body[end + index_size :]
        count = struct.unpack_from(">H", index)[0] if index_size else 0
        metadata, place = {}, 0
        for number in range(count):
            key_size, charset, value_size = struct.unpack_from(">HHI", index, 2 + 8 * number)
            key, value = texts[place : place + key_size], texts[place + key_size :][:value_size]
            if len(key) != key_size or len(value) != value_size:
                raise ValueError
            metadata[key.decode()] = value.decode(_TEXT_CODECS.get(charset, "utf-8"))
            place += key_size + value_size
    except (struct.error, ValueError) as error:
        raise LinkMessageError(
            sentence(
                "{kind} of {device}: extended header or metadata do not fit its {size} bytes",
                kind=head.kind,
                device=head.device,
                size=len(body),
            )
        ) from error
    return body[size:end], metadata


def matrix_of(message: Message) -> FloatArray:
    """Return the matrix of a TRANSFORM [mm], shape (4, 4).

    Raises:
        LinkMessageError: if it has another size, is not finite, scales, shears or mirrors.
    """
    if len(message.content) != 48:
        raise LinkMessageError(
            sentence(
                "TRANSFORM {device} has {size} bytes; 48 are a matrix",
                device=message.device,
                size=len(message.content),
            )
        )
    matrix = np.eye(4)
    matrix[:3] = np.frombuffer(message.content, dtype=">f4").reshape(4, 3).T
    if why := unusable(matrix):
        raise LinkMessageError(
            sentence("TRANSFORM {device} is refused: {why}", device=message.device, why=why)
        )
    return matrix


SKEW: Final = 1e-3
"""A rotation may be off so much: the wire has single precision, and some round to three digits."""

FARTHEST_MM: Final = 10000.0
"""No tracked tool is farther away than this."""


def unusable(matrix: FloatArray) -> str:
    """Say why a matrix [mm], shape (4, 4), is no pose; empty where it is one."""
    if not np.isfinite(matrix).all():
        return sentence("a value of it is not finite")
    rotation = matrix[:3, :3]
    if not np.abs(rotation).max() < 1e3 or not np.abs(matrix[:3, 3]).max() <= FARTHEST_MM:
        return sentence("a value of it is {size:.3g}", size=float(np.abs(matrix[:3]).max()))
    scale = np.linalg.norm(rotation, axis=0)
    if np.abs(scale - 1.0).max() > SKEW:
        x, y, z = scale.tolist()
        return sentence("it scales by {x:.4g}, {y:.4g}, {z:.4g}", x=x, y=y, z=z)
    if np.linalg.det(rotation) < 0.0:
        return sentence("it is left-handed")
    if np.abs(rotation.T @ rotation - np.eye(3)).max() > 2.0 * SKEW:
        return sentence("it is no rotation: its axes are not at right angles")
    return ""


def is_valid(message: Message) -> bool:
    """Return whether a TRANSFORM is said to be valid, by PLUS' metadata; without them it is."""
    said = message.metadata.get("TransformStatus", "OK").upper()
    valid = message.metadata.get("TransformValid", "1").strip().lower()
    return said == "OK" and valid not in ("0", "false")
