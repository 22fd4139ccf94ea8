"""Columns of float64 as bytes that compress well, without losing a bit.

Each column is stored in the cheapest of a few ways: times are whole nanoseconds, what grows
steadily differs little from its continuation, and the high bytes of small differences are zeros
that a compressor removes (which is why the bytes stand plane by plane).
"""

import struct
from enum import IntEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.session.budget import ReadingBudget
from app.session.errors import BrokenRecordingError

Bits = NDArray[np.uint64]
_EXACT: Final = 2.0**53
_FEW: Final = 0.25


class ColumnCoding(IntEnum):
    """How a column is stored (its first byte)."""

    CONSTANT = 0
    PLAIN = 1
    SAME = 2
    BITS_1 = 3
    BITS_2 = 4
    NANOSECONDS_1 = 5
    NANOSECONDS_2 = 6


_OF_TIMES: Final = (ColumnCoding.NANOSECONDS_1, ColumnCoding.NANOSECONDS_2)
_ORDER: Final = {
    ColumnCoding.BITS_1: 1,
    ColumnCoding.BITS_2: 2,
    ColumnCoding.NANOSECONDS_1: 1,
    ColumnCoding.NANOSECONDS_2: 2,
}


def encode(values: FloatArray) -> bytes:
    """Store the columns of an array, shape (n, m), n > 0."""
    bits = np.ascontiguousarray(values.T, dtype="<f8").view("<u8")
    seen: dict[bytes, int] = {}
    return b"".join(_encode(column, k, seen) for k, column in enumerate(bits))


def decode(data: bytes, rows: int, columns: int, budget: ReadingBudget) -> tuple[FloatArray, int]:
    """Read columns back: the array, shape (rows, columns), and how many bytes it took.

    Raises:
        BrokenRecordingError: if a way is not known, bytes are missing, or the array is larger than
            what may be taken: nine bytes can stand for a column of any length.
    """
    budget.take(8 * rows * columns)
    read = _Reader(data)
    bits = np.empty((columns, rows), dtype="<u8")
    for k in range(columns):
        bits[k] = _decode(read, rows, bits[:k])
    return np.ascontiguousarray(bits.view("<f8").T, dtype=np.float64), read.place


class _Reader:
    """Bytes that are taken from the front."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self.place = 0

    def take(self, count: int) -> bytes:
        part = self._data[self.place : self.place + count]
        if len(part) < count:
            raise BrokenRecordingError(
                sentence(
                    "a block ends after {block_bytes} bytes in a column",
                    block_bytes=len(self._data),
                )
            )
        self.place += count
        return part


def _encode(column: Bits, index: int, seen: dict[bytes, int]) -> bytes:
    if (column == column[0]).all():
        return bytes([ColumnCoding.CONSTANT]) + column[:1].tobytes()
    plain = column.tobytes()
    if plain in seen:
        return bytes([ColumnCoding.SAME]) + struct.pack("<H", seen[plain])
    seen[plain] = index
    if np.count_nonzero(np.diff(column)) < _FEW * len(column):
        return bytes([ColumnCoding.PLAIN]) + plain
    nanoseconds = _nanoseconds(column)
    ways = (ColumnCoding.BITS_1, ColumnCoding.BITS_2) if nanoseconds is None else _OF_TIMES
    first = _differences(column if nanoseconds is None else nanoseconds)
    found = dict(zip(ways, (_folded(first), _folded(_differences(first))), strict=True))
    way = min(ways, key=lambda way: np.count_nonzero(found[way].view(np.uint8)))
    return bytes([way]) + _planes(found[way]).tobytes()


def _decode(read: _Reader, rows: int, before: Bits) -> Bits:
    code = read.take(1)[0]
    if code not in set(ColumnCoding):
        raise BrokenRecordingError(
            sentence("a column is stored in a way, {code}, that is not known", code=code)
        )
    way = ColumnCoding(code)
    if way is ColumnCoding.CONSTANT:
        return np.repeat(np.frombuffer(read.take(8), dtype="<u8"), rows)
    if way is ColumnCoding.PLAIN:
        return np.frombuffer(read.take(8 * rows), dtype="<u8")
    if way is ColumnCoding.SAME:
        (index,) = struct.unpack("<H", read.take(2))
        if index >= len(before):
            raise BrokenRecordingError(
                sentence("a column repeats column {index}, which is not before it", index=index)
            )
        return np.asarray(before[index])
    planes = np.frombuffer(read.take(8 * rows), dtype=np.uint8).reshape(8, rows)
    bits = _sums(np.ascontiguousarray(planes.T).view("<u8")[:, 0], _ORDER[way])
    if way in (ColumnCoding.BITS_1, ColumnCoding.BITS_2):
        return bits
    return (bits.view("<i8") * 1e-9).view("<u8")


def _nanoseconds(column: Bits) -> Bits | None:
    """Whole nanoseconds that give back the very bits as k · 1e-9, or None."""
    seconds = column.view("<f8")
    if not (np.abs(seconds) < 1e-9 * _EXACT).all():  # also NaN
        return None
    whole = np.rint(seconds * 1e9).astype("<i8")
    exact: bool = ((whole * 1e-9).view("<u8") == column).all()
    return whole.view("<u8") if exact else None


def _differences(bits: Bits) -> Bits:
    """Differences modulo 2⁶⁴, with 0 before the first."""
    differences = np.array(bits)
    differences[1:] -= bits[:-1]
    return differences


def _folded(bits: Bits) -> Bits:
    """Small numbers of either sign as small numbers without a sign."""
    signed = bits.view("<i8")
    return ((signed << 1) ^ (signed >> 63)).view("<u8")


def _sums(folded: Bits, order: int) -> Bits:
    """Inverse of as many `_differences` and of `_folded`."""
    one = np.uint64(1)
    bits = (folded >> one) ^ (np.uint64(0) - (folded & one))
    for _ in range(order):
        bits = np.cumsum(bits, dtype="<u8")
    return bits


def _planes(bits: Bits) -> NDArray[np.uint8]:
    """All lowest bytes, then all second bytes, and so on, shape (8, n)."""
    return np.ascontiguousarray(bits.view(np.uint8).reshape(-1, 8).T)
