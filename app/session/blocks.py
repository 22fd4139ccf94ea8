"""Binary blocks of the loop's ticks: what a replay needs and checks, at the loop's own rate.

Layout (all little-endian): magic `ACUB`, version u16, columns u16, rows u32, lost u32, first tick
u64; the columns as `session.columns` stores them; a digest u32 per row; number of slots u16, and of
each row whose tick is a multiple of `STATE_EVERY` the whole state as float64.
"""

import struct
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core import state_vector as slots
from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.session import columns
from app.session.budget import ReadingBudget
from app.session.digest import digests
from app.session.errors import BrokenRecordingError

MAGIC: Final = b"ACUB"
VERSION: Final = 2
STATE_EVERY: Final = 500
"""The whole state is stored after every tick whose number is a multiple of this."""

_HEADER: Final = struct.Struct("<4sHHIIQ")

SLOT_NAMES: Final = tuple(
    {index: name for name, index in slots.INDEX.items()}.get(k, "") for k in range(slots.SLOTS)
)
"""Name of every slot of the state in its order."""


INPUTS: Final = tuple(name for name in SLOT_NAMES[: slots.INPUTS] if name)
"""What other threads give a tick through the inbox."""

CLOCK: Final = ("time", "dt", "tick", "lateness", "missed", "input_fault")
"""What the loop itself gives a tick."""

WIRE: Final = (
    *("link_status", "link_replies", "link_errors", "link_lost", "round_trip", "board_error"),
    *("gauge", "gauge_force", "q_left", "q_right", "q_time"),
)
"""What a robot gives a tick."""

OUTPUTS: Final = ("kinematics", "depth", "depth_source", "torque_left", "torque_right", "fault")
"""What a tick computes and every row of a record holds; all else is in its digest."""

LATER: Final = ("hold_breath", "needle_roll")
"""Inputs that records did not always have: behind all others, so that those blocks read alike."""

CABLES: Final = (*slots.VECTORS["cable"], *slots.VECTORS["reel"])
"""What a robot with cables gives a tick beside them: later than all, and zeros of one without."""

JUDGED: Final = ("encoder_fault", "unbelieved")
"""What was made of a robot's readings when they came; later than all, and zeros before."""

UNSTEADY: Final = ("hand_level", "hand_seed")
"""Inputs that make the simulated hand unsteady; later than all, and zeros before: it was steady."""

COLUMNS: Final = (
    *(n for n in INPUTS if n not in (*LATER, *UNSTEADY)),
    *(*CLOCK, *WIRE, *OUTPUTS, *LATER, *CABLES, *JUDGED, *UNSTEADY),
)
"""Slot names of a block's columns."""

TRAINEE: Final = ("hand_x", "hand_y", "hand_depth", "hand_holds")
"""Inputs that the scripted trainee writes while it acts: recomputed, so stored as NaN."""

_INDICES: Final = np.array([slots.INDEX[name] for name in COLUMNS])
_TICK: Final = COLUMNS.index("tick")
_TRAINEE: Final = np.array([COLUMNS.index(name) for name in TRAINEE])


@dataclass(frozen=True, slots=True, eq=False)
class TickBlock:
    """One block.

    Attributes:
        values: rows of the record's columns, shape (n, m), read-only.
        first_tick: tick of the first row.
        lost: ticks between the block before and this one that were overwritten unread.
        digests: of the state after each row, shape (n,).
        state_rows: rows whose whole state is stored, shape (k,).
        states: these states, shape (k, slots), read-only.
    """

    values: FloatArray
    first_tick: int
    lost: int
    digests: NDArray[np.uint32]
    state_rows: NDArray[np.int64]
    states: FloatArray


def pack(rows: FloatArray, lost: int) -> bytes:
    """Pack rows of the whole state, shape (n, SLOTS), into a block."""
    first = int(rows[0, slots.TICK]) if len(rows) else 0
    lost = min(lost, 0xFFFFFFFF)
    head = _HEADER.pack(MAGIC, VERSION, len(COLUMNS), len(rows), lost, first)
    if not len(rows):
        return head
    values = rows[:, _INDICES]
    acts = (rows[:, slots.TRAINEE_PHASE] > 0.0) & (rows[:, slots.ENABLED] > 0.0)
    values[np.ix_(acts, _TRAINEE)] = np.nan
    whole = rows[_state_rows(rows[:, slots.TICK])].astype("<f8").tobytes()
    checks = digests(rows).tobytes() + struct.pack("<H", slots.SLOTS) + whole
    return head + columns.encode(values) + checks


def unpack(data: bytes, budget: ReadingBudget) -> TickBlock:
    """Read a block.

    Raises:
        BrokenRecordingError: if magic, version or length are not those of a block, or it holds more
            than may be taken.
    """
    if len(data) < _HEADER.size or data[:4] != MAGIC:
        raise BrokenRecordingError(
            sentence(
                "a block of {block_bytes} bytes does not begin with {magic}",
                block_bytes=len(data),
                magic=MAGIC.decode(),
            )
        )
    _, version, count, rows, lost, first = _HEADER.unpack_from(data)
    if version != VERSION:
        raise BrokenRecordingError(
            sentence(
                "block version {version}; this program reads {known_version}",
                version=version,
                known_version=VERSION,
            )
        )
    body = data[_HEADER.size :]
    if rows == 0:
        return _empty(body, count, lost, first)
    if rows > len(body):  # a digest alone takes four bytes a row
        raise BrokenRecordingError(
            sentence(
                "a block of {rows} rows has {block_bytes} bytes", rows=rows, block_bytes=len(data)
            )
        )
    values, place = columns.decode(body, rows, count, budget)
    if count <= _TICK:
        raise BrokenRecordingError(
            sentence("a block of {count} columns has no tick numbers", count=count)
        )
    where = _state_rows(values[:, _TICK])
    hashes, states = _checks(body[place:], rows, len(where))
    return TickBlock(read_only(values), first, lost, hashes, where, states)


def _state_rows(tick: FloatArray) -> NDArray[np.int64]:
    return np.flatnonzero(np.mod(tick, STATE_EVERY) == 0.0)


def _empty(body: bytes, count: int, lost: int, first: int) -> TickBlock:
    if body:
        raise BrokenRecordingError(
            sentence("a block of 0 rows has {body_bytes} bytes of numbers", body_bytes=len(body))
        )
    none, nowhere = np.zeros(0, dtype=np.uint32), np.zeros(0, dtype=np.int64)
    nothing = read_only(np.zeros((0, count)))
    return TickBlock(nothing, first, lost, none, nowhere, read_only(np.zeros((0, 0))))


def _checks(data: bytes, rows: int, states: int) -> tuple[NDArray[np.uint32], FloatArray]:
    end = 4 * rows
    size = struct.unpack_from("<H", data, end)[0] if len(data) >= end + 2 else 0
    if len(data) != end + 2 + 8 * size * states or size == 0:
        raise BrokenRecordingError(
            sentence(
                "a block of {rows} rows has {check_bytes} bytes of checks",
                rows=rows,
                check_bytes=len(data),
            )
        )
    whole = np.frombuffer(data, dtype="<f8", offset=end + 2).reshape(states, size)
    hashes = np.frombuffer(data[:end], dtype="<u4").astype(np.uint32)
    return hashes, read_only(np.array(whole, dtype=np.float64))
