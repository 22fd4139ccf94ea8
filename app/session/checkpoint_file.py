"""A checkpoint of the loop as a message of the record.

Layout (little-endian): magic `ACUC`, version u16, length of a JSON text u32, the text (`tick`,
`slots`: names of the state's slots, `stages`: name and size of each), then the state and the
stages' arrays as float64.
"""

import json
import struct
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from app.core.arrays import read_only
from app.core.messages import sentence
from app.device.checkpoint import Checkpoint
from app.session.blocks import SLOT_NAMES
from app.session.errors import BrokenRecordingError

MAGIC: Final = b"ACUC"
VERSION: Final = 1
_HEADER: Final = struct.Struct("<4sHI")
_BY_SLOT: Final = frozenset(
    {
        "shaft_friction",
        "puncture",
        "cutting",
        "dimpling",
        "relaxation",
        "bone_contact",
        "bone_slide",
    }
)
"""Stages whose first number is the place of a slot, the depth that they take."""


@dataclass(frozen=True, slots=True, eq=False)
class RecordedCheckpoint:
    """A checkpoint, and the slots of the program that recorded it.

    Attributes:
        checkpoint: the loop at the beginning of the record.
        slots: names of its state's slots.
    """

    checkpoint: Checkpoint
    slots: tuple[str, ...]

    def in_order_of(self, slots: tuple[str, ...]) -> Checkpoint:
        """Return the checkpoint with its state in another order; slots it has not are zero.

        What names a slot by its place in a stage's array names it by its new place.
        """
        state, parameters = self.checkpoint.state, np.array(self.checkpoint.parameters)
        ordered = [state[self.slots.index(name)] if name in self.slots else 0.0 for name in slots]
        start = 0
        for stage, size in zip(self.checkpoint.names, self.checkpoint.sizes, strict=True):
            if stage in _BY_SLOT and size > 0:
                named = self.slots[int(parameters[start])]
                parameters[start] = slots.index(named)
            start += size
        return replace(
            self.checkpoint, state=read_only(np.array(ordered)), parameters=read_only(parameters)
        )


def pack(checkpoint: Checkpoint) -> bytes:
    """Return the message."""
    c = checkpoint
    text = json.dumps(
        {
            "tick": c.tick,
            "slots": SLOT_NAMES,
            "stages": list(zip(c.names, c.sizes, strict=True)),
        }
    ).encode()
    numbers = np.concatenate((c.state, c.parameters)).astype("<f8")
    return _HEADER.pack(MAGIC, VERSION, len(text)) + text + numbers.tobytes()


def unpack(data: bytes) -> RecordedCheckpoint:
    """Read the message.

    Raises:
        BrokenRecordingError: if it is not a checkpoint; says what is wrong.
    """
    if len(data) < _HEADER.size or data[:4] != MAGIC:
        raise BrokenRecordingError(
            sentence("a checkpoint does not begin with {magic}", magic=MAGIC.decode())
        )
    _, version, length = _HEADER.unpack_from(data)
    if version != VERSION:
        raise BrokenRecordingError(
            sentence(
                "checkpoint version {version}; this program reads {known_version}",
                version=version,
                known_version=VERSION,
            )
        )
    body = data[_HEADER.size + length :]
    try:
        document = json.loads(data[_HEADER.size : _HEADER.size + length])
        return _read(document, body)
    except (ValueError, LookupError, TypeError, RecursionError) as error:
        raise BrokenRecordingError(
            sentence("the checkpoint cannot be read: {error}", error=error)
        ) from error


def _read(document: dict[str, Any], body: bytes) -> RecordedCheckpoint:
    names = tuple(str(name) for name, _ in document["stages"])
    sizes = tuple(int(size) for _, size in document["stages"])
    slots = tuple(str(name) for name in document["slots"])
    numbers = read_only(np.frombuffer(body, dtype="<f8").astype(np.float64))
    if min(sizes, default=0) < 0 or len(numbers) != len(slots) + sum(sizes):
        raise ValueError(
            sentence(
                "{numbers_given} numbers for {slots} slots and {sizes} more",
                numbers_given=len(numbers),
                slots=len(slots),
                sizes=sum(sizes),
            )
        )
    state, parameters = numbers[: len(slots)], numbers[len(slots) :]
    tick = int(document["tick"])
    return RecordedCheckpoint(Checkpoint(tick, state, parameters, sizes, names), slots)
