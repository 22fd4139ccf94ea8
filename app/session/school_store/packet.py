"""What stations put into the school's store: small signed files, each about one thing.

Packets of this station: attempts, remarks, who was erased, and the course if it gives one.
"""

from __future__ import annotations

import hashlib
import io
import json
import zipfile
from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final, NamedTuple

from app.core.progress import Progress
from app.session.people import People
from app.session.results_file import pack_attempt, pack_course, sender_of
from app.session.school_file import RESULTS, SchoolManifest, write_manifest
from app.session.school_tables import Tombstone
from app.session.station import StationKey
from app.session.station_results import (
    CountedAttempt,
    SignedRemark,
    counted_attempts,
    counter_of,
    signed_remarks,
    tombstones,
)
from app.session.stations import KnownStation
from app.session.store import SUFFIX

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


@dataclass(frozen=True)
class OwnThings:
    """What this station could put into the store, read at one moment.

    Attributes:
        folder: of the records.
        key: of this station.
        sender: this station, as packets name it.
        attempts: of all stations, by id.
        remarks: of this station, by the student whom they are about.
        stones: of all erased people.
    """

    folder: Path
    key: StationKey
    sender: KnownStation
    attempts: Mapping[str, CountedAttempt]
    remarks: Mapping[str, tuple[SignedRemark, ...]]
    stones: tuple[Tombstone, ...]

    @classmethod
    def read(cls, folder: Path, people: People, key: StationKey) -> OwnThings:
        """Read them; what is new must be signed already."""
        with people.database.read() as connection:
            attempts = counted_attempts(connection)
            latest = signed_remarks(connection)
            stones, counter = tombstones(connection), counter_of(connection)
        remarks: dict[str, list[SignedRemark]] = defaultdict(list)
        for _, one in sorted(latest.items()):
            if one.station == key.station:
                remarks[one.student].append(one)
        return cls(
            folder,
            key,
            sender_of(people, key, counter),
            attempts,
            {student: tuple(some) for student, some in remarks.items()},
            tuple(stones),
        )

    def own_attempts(self) -> list[CountedAttempt]:
        """Return the attempts of this station whose records are here, in their order."""
        mine = [one for one in self.attempts.values() if one.station == self.key.station]
        there = [one for one in mine if (self.folder / f"{one.attempt}{SUFFIX}").exists()]
        return sorted(there, key=lambda one: one.number)

    def marks(self) -> dict[tuple[str, str], str]:
        """Return the marks of all but the course, by kind and item."""
        marks = {(STATION, ""): self._introduction}
        marks |= {(ATTEMPT, one.attempt): one.record for one in self.own_attempts()}
        marks |= {(REMARKS, whose): _mark(some) for whose, some in self.remarks.items()}
        return marks | {(ERASED, one.digest): one.digest for one in self.stones}

    @property
    def _introduction(self) -> str:
        return _digest([self.key.public, self.sender.name])

    def packet(self, kind: str, item: str) -> Packet | None:
        """Return a packet; None of an attempt that was altered after it was signed."""
        if kind == ATTEMPT:
            attempt = self.attempts[item]
            data = self._signed(
                lambda archive: (
                    SchoolManifest(RESULTS, self.sender, attempts=(attempt,), files=files)
                    if (files := pack_attempt(archive, self.folder, attempt, self.key))
                    else None
                )
            )
            mark, student = attempt.record, attempt.student
        elif kind == REMARKS:
            some = self.remarks[item]
            data = self._signed(lambda _: SchoolManifest(RESULTS, self.sender, remarks=some))
            mark, student = _mark(some), item
        elif kind == STATION:  # so that it can be let in before it has made anything
            data = self._signed(lambda _: SchoolManifest(RESULTS, self.sender))
            mark, student = self._introduction, ""
        else:
            (stone,) = (one for one in self.stones if one.digest == item)
            data = self._signed(lambda _: SchoolManifest(RESULTS, self.sender, tombstones=(stone,)))
            mark, student = item, ""
        return Packet(self.key.station, kind, item, student, mark, data) if data else None

    def course(self, people: People, names: bool, pins: bool) -> Packet:
        """Return the course that this station gives: people, courses, exercises, stations."""
        told: list[SchoolManifest] = []

        def fill(archive: zipfile.ZipFile) -> SchoolManifest:
            told.append(pack_course(archive, people, self.key, names, pins, Progress()))
            return told[0]

        data = self._signed(fill)
        (manifest,) = told
        stations = [one.document() | {"counter": 0} for one in manifest.stations]
        mark = _digest(
            [
                dict(manifest.files),
                [one.document() for one in manifest.people],
                sorted(stations, key=lambda one: str(one["public"])),
                manifest.sender.name,
            ]
        )
        return Packet(self.key.station, COURSE, "", "", mark, data)

    def _signed(self, fill: Callable[[zipfile.ZipFile], SchoolManifest | None]) -> bytes:
        out = io.BytesIO()
        with zipfile.ZipFile(out, "w", zipfile.ZIP_STORED) as archive:
            manifest = fill(archive)
            if manifest is None:
                return b""
            succession = tuple(self.key.succession())
            write_manifest(archive, replace(manifest, succession=succession), self.key)
        return out.getvalue()


def missing(own: OwnThings, there: Mapping[tuple[str, str], str]) -> Iterator[tuple[str, str]]:
    """Return kind and item of what the store has not, erasures first."""
    marks = own.marks()
    for kind in (STATION, ERASED, ATTEMPT, REMARKS):
        for (which, item), mark in marks.items():
            if which == kind and there.get((which, item)) != mark:
                yield which, item


def _mark(remarks: tuple[SignedRemark, ...]) -> str:
    return _digest([list(one) for one in remarks])


def _digest(document: Any) -> str:
    text = json.dumps(document, sort_keys=True, ensure_ascii=True)
    return hashlib.sha256(text.encode()).hexdigest()
