"""What stations put into the school's store: small signed files, each about one thing."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import Final, NamedTuple

STATION: Final = "station"
ATTEMPT: Final = "attempt"
REMARKS: Final = "remarks"
ERASED: Final = "erased"
COURSE: Final = "course"


@dataclass(frozen=True, slots=True)
class Packet:
    """A small file of one station, as it is put into the store.

    Attributes:
        station: id.
        kind: `station`, `attempt`, `remarks`, `erased` or `course`.
        item: id of the attempt, key of the student of remarks, digest of a tombstone; empty of a
            station and a course.
        student: random key; empty of what is about nobody alone.
        mark: digest of what it says: of one station, kind and item another mark is something new.
        data: the signed file.
    """

    station: str
    kind: str
    item: str
    student: str
    mark: str
    data: bytes

    @property
    def digest(self) -> str:
        """Return the SHA-256 of the file."""
        return hashlib.sha256(self.data).hexdigest()


class PacketRow(NamedTuple):
    """A packet as the store lists it, without its data."""

    seq: int
    station: str
    kind: str
    item: str
    student: str
    mark: str
    digest: str
    size: int
