"""Binary blocks of the loop's inputs: what a replay needs, at the loop's own rate.

Layout (all little-endian): magic `ACUB`, version u16, columns u16, rows u32, lost u32, first tick
u64; then the columns one after the other, each `rows` float64. Column order is preferred to row
order because inputs hardly change: a compressor finds whole columns that repeat.
"""

import struct
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core import state_vector as slots
from app.core.arrays import FloatArray, read_only
from app.session.errors import BrokenRecordingError

MAGIC: Final = b"ACUB"
VERSION: Final = 1
_HEADER: Final = struct.Struct("<4sHHIIQ")

_INPUT_NAMES: Final = tuple(
    name
    for name, index in sorted(slots.INDEX.items(), key=lambda item: item[1])
    if index < slots.INPUTS
)
_MEASURED: Final = ("time", "dt", "tick", "q_left", "q_right", "q_time")
COLUMNS: Final = (*_INPUT_NAMES, *_MEASURED)
"""Slot names of a block's columns: every input, the tick's time and the encoder values."""

_INDICES: Final = np.array([slots.INDEX[name] for name in COLUMNS])


@dataclass(frozen=True, slots=True, eq=False)
class Block:
    """One block.

    Attributes:
        values: rows of `COLUMNS`, shape (n, len(COLUMNS)), read-only.
        first_tick: tick of the first row.
        lost: ticks between the block before and this one that were overwritten unread.
    """

    values: FloatArray
    first_tick: int
    lost: int


def pack(rows: FloatArray, lost: int) -> bytes:
    """Pack rows of the whole state, shape (n, SLOTS), into a block."""
    columns = np.ascontiguousarray(rows[:, _INDICES].T, dtype="<f8")
    first = int(rows[0, slots.TICK]) if len(rows) else 0
    head = _HEADER.pack(MAGIC, VERSION, len(COLUMNS), len(rows), min(lost, 0xFFFFFFFF), first)
    return head + columns.tobytes()


def unpack(data: bytes) -> Block:
    """Read a block.

    Raises:
        BrokenRecordingError: if magic, version or length are not those of a block.
    """
    if len(data) < _HEADER.size or data[:4] != MAGIC:
        raise BrokenRecordingError(
            f"a block of {len(data)} bytes does not begin with {MAGIC.decode()}"
        )
    _, version, columns, rows, lost, first = _HEADER.unpack_from(data)
    if version != VERSION:
        raise BrokenRecordingError(f"block version {version}; this program reads version {VERSION}")
    if len(data) != _HEADER.size + 8 * columns * rows:
        raise BrokenRecordingError(f"a block of {rows} rows has {len(data)} bytes")
    values = np.frombuffer(data, dtype="<f8", offset=_HEADER.size).reshape(columns, rows).T
    return Block(read_only(np.ascontiguousarray(values, dtype=np.float64)), first, lost)
