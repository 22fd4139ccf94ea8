"""A tissue field as bytes: small for the record, quick for the cache. Patient data, like its CT.

For the record only the distances of voxels beside a boundary are kept; those behind them follow,
to the last bit, by what made them (`band.completed`). The digest says whether they did.
"""

from __future__ import annotations

import json
import lzma
import struct
import zlib
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core.files import write_atomically
from app.core.messages import sentence
from app.imaging.field.errors import FieldError
from app.imaging.field.tissue_field import TissueField, tissue_of

MAGIC: Final = b"ACUSFIELD1\n"
LARGEST_BYTES: Final = 512 << 20
"""No field that is read is larger, unpacked."""

_HEAD: Final = struct.Struct("<I")
_PACKED, _PLAIN = "xz", "none"
_FILTERS: Final = [{"id": lzma.FILTER_LZMA2, "preset": 1, "dict_size": 1 << 22}]


def to_bytes(field: TissueField, small: bool = True) -> bytes:
    """Pack a field.

    Args:
        field: what.
        small: as small as a second makes it, for the record; else as it lies in memory.
    """
    way, distance = (_PACKED if small else _PLAIN), field.distance
    if small:
        from app.imaging.field import band  # compiled code

        distance = distance.ravel()[band.ring_of(field.labels)]
    parts = [_packed(array.tobytes(), way) for array in (field.labels, distance)]
    header = field.header() | {
        "patient_data": True,
        "digest": field.digest,
        "packed": way,
        "bytes": [len(part) for part in parts],
        "check": [zlib.crc32(part) for part in parts],
    }
    text = json.dumps(header).encode()
    return b"".join([MAGIC, _HEAD.pack(len(text)), text, *parts])


def from_bytes(content: bytes, check: bool = True) -> TissueField:
    """Unpack a field.

    Args:
        content: of `to_bytes`.
        check: compute its digest again; the cache of this computer compares checksums alone.

    Raises:
        FieldError: if it is none, damaged, or another than its digest says.
    """
    if not content.startswith(MAGIC):
        raise FieldError(sentence("this is no tissue field: it does not begin as one"))
    try:
        return _unpacked(content, check)
    except (LookupError, TypeError, ValueError, struct.error, lzma.LZMAError) as error:
        if isinstance(error, FieldError):
            raise
        raise FieldError(
            sentence("the tissue field is damaged ({error_name})", error_name=type(error).__name__)
        ) from error


def write(field: TissueField, path: Path, small: bool = True) -> None:
    """Write a field as one file, whole or not at all."""
    write_atomically(path, to_bytes(field, small))


def read(path: Path, check: bool = True) -> TissueField:
    """Read a field's file; see `from_bytes`.

    Raises:
        FieldError: if it is none or damaged.
        OSError: if it cannot be read.
    """
    return from_bytes(path.read_bytes(), check)


def _unpacked(content: bytes, check: bool) -> TissueField:
    start = len(MAGIC) + _HEAD.size
    (length,) = _HEAD.unpack_from(content, len(MAGIC))
    header: dict[str, Any] = json.loads(content[start : start + length])
    shape = tuple(int(size) for size in header["shape"])
    voxels = int(np.prod(shape))
    if len(shape) != 3 or min(shape) < 2 or 2 * voxels > LARGEST_BYTES:
        raise FieldError(
            sentence("a tissue field of {shape} voxels is none that can be read", shape=shape)
        )
    place, parts = start + length, []
    for size, checksum in zip(header["bytes"], header["check"], strict=True):
        part = memoryview(content)[place : place + size]
        if len(part) != size or zlib.crc32(part) != checksum:
            raise FieldError(
                sentence("the tissue field is damaged: a part of it is not what was written")
            )
        parts.append(_plain(part, header["packed"], voxels))
        place += size
    labels = (
        np.frombuffer(parts[0], np.uint8).reshape(shape).copy()
    )  # kernels take what can be written
    distance = np.frombuffer(parts[1], np.int8).copy()
    affine = np.array(header["affine_mm"], np.float64).reshape(4, 4)
    if header["packed"] == _PACKED:
        from app.imaging.field import band  # compiled code

        distance = band.completed(labels, np.linalg.norm(affine[:3, :3], axis=0), distance)
    distance = distance.reshape(shape)
    tissues = tuple(tissue_of(row) for row in header["tissues"])
    field = TissueField(labels, distance, affine, tissues, tuple(map(str, header["notes"])))
    if check and field.digest != header["digest"]:
        raise FieldError(sentence("the tissue field is another than its digest says"))
    return field


def _packed(raw: bytes, way: str) -> bytes:
    return lzma.compress(raw, lzma.FORMAT_XZ, filters=_FILTERS) if way == _PACKED else raw


def _plain(part: memoryview, way: str, most: int) -> bytes | memoryview:
    if way == _PLAIN:
        return part
    plain = lzma.LZMADecompressor().decompress(part, max_length=most + 1)
    if len(plain) > most:
        raise FieldError(sentence("the tissue field holds more than its {most} voxels", most=most))
    return plain
