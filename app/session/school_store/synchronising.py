"""Bringing this station and the school's store together: what is new goes there, and comes here.

Nothing is asked of clocks, and each step may be broken off: the next time it goes on. What this
station has is its own files; the store is another way for the packets to travel.
"""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Final, NamedTuple

from app.core.messages import sentence, sentence_of
from app.core.progress import Progress
from app.session.audit import note
from app.session.backup_file import ArchiveError
from app.session.gathering import GatheredFile, gather_opened, reading
from app.session.limits import hold_limits
from app.session.people import People
from app.session.results_file import up_to_date
from app.session.school_file import COURSE as COURSE_FILE
from app.session.school_file import UnknownStationError, read_manifest, stations_with
from app.session.school_store.packet import (
    ATTEMPT,
    COURSE,
    ERASED,
    REMARKS,
    STATION,
    OwnThings,
    PacketRow,
    missing,
)
from app.session.school_store.place import StorePlace
from app.session.school_store.store import ReadPlace, SchoolStore
from app.session.school_tables import ErasedKeys
from app.session.station import StationKey
from app.session.station_results import counted_attempts, tombstones
from app.session.stations import fingerprint, put_setting, stations_of
from app.session.taking_in import OpenedFile

STATE: Final = "school store"
"""Setting that holds how far this station has read."""

_BATCH: Final = 4 << 20
_PACKETS: Final = 100
"""Bytes and packets that travel at once."""


class StrangeStation(NamedTuple):
    """A station that is not known here: its name, and what to compare of its key."""

    name: str
    fingerprint: str


@dataclass(frozen=True, slots=True)
class Synchronised:
    """What came of it.

    Attributes:
        store: its name.
        sent: packets of this station that were not there.
        gathered: what came here, all packets together.
        unknown: stations whose packets wait until they are known here.
        refused: a line for each packet or attempt that is left out.
        erased: packets that were taken out of the store because their student was erased.
    """

    store: str
    sent: int = 0
    gathered: GatheredFile = field(default_factory=GatheredFile)
    unknown: tuple[StrangeStation, ...] = ()
    refused: tuple[str, ...] = ()
    erased: int = 0


@dataclass(frozen=True, slots=True)
class SyncState:
    """How far this station has read.

    Attributes:
        place: in the store.
        left: places of packets that could not be taken yet.
        files: SHA-256 of courses and exercises that came from the store.
        confirmed: attempts of this station that are there.
        held: whether limits were held since the last packet was sent; a meeting that was broken
            off after it has not done so.
    """

    place: ReadPlace = field(default_factory=ReadPlace)
    left: frozenset[int] = frozenset()
    files: frozenset[str] = frozenset()
    confirmed: int = 0
    held: bool = True

    @classmethod
    def of(cls, people: People) -> SyncState:
        """Read it; what is damaged is begun anew."""
        try:
            document = json.loads(people.setting(STATE) or "{}")
            return cls(
                ReadPlace(int(document["seq"]), str(document["chain"])),
                frozenset(map(int, document["left"])),
                frozenset(map(str, document["files"])),
                int(document["confirmed"]),
                bool(document.get("held")),
            )
        except (ValueError, LookupError, TypeError):
            return cls()

    def keep(self, people: People) -> None:
        """Write it."""
        document = {
            "seq": self.place.seq,
            "chain": self.place.chain,
            "left": sorted(self.left),
            "files": sorted(self.files),
            "confirmed": self.confirmed,
            "held": self.held,
        }
        with people.database.write() as connection:
            put_setting(connection, STATE, json.dumps(document))


def synchronise(
    place: StorePlace,
    folder: Path,
    people: People | None = None,
    trust: bool = False,
    progress: Progress | None = None,
    by: str = "",
) -> Synchronised:
    """Send what is new here, take in what is new there.

    Args:
        place: of the store.
        folder: of the records.
        people: of this station.
        trust: let stations in that are not known here.
        progress: reports, and may cancel.
        by: who does it, for the audit trail; whoever is here without it.

    Raises:
        UnreachableStoreError: if the store does not answer; what was done stays done.
        StoreError: if it refuses.
        Cancelled: if that was asked for.
    """
    people, progress = people or People(), progress or Progress()
    key = up_to_date(folder, people, progress.part(0.0, 0.1))
    with closing(place.store()) as store:
        store.open(make=False)
        at = _Synchronising(store, place, folder, people, key, trust, by)
        at.send(progress.part(0.1, 0.4))
        at.state.keep(people)
        at.take(progress.part(0.4, 0.9))
        at.erase()
        if place.gives_course:
            at.give_course()
        if at.result.sent or at.changed or not at.state.held:
            with people.database.write() as connection:
                excess = hold_limits(connection, people.folder)
            at.state = replace(at.state, held=True)
            at.result = replace(at.result, gathered=replace(at.result.gathered, excess=excess))
        at.state.keep(people)
    if at.result.sent or at.changed:
        note("store synchronised", folder=people.folder, who=by)
    return at.result


def read_again(people: People) -> None:
    """Let the next meeting look at all that the store has: what was left out may be taken now."""
    state = SyncState.of(people)
    if state.place.seq:
        replace(state, place=ReadPlace()).keep(people)


def waiting(people: People, key: StationKey) -> int:
    """Return how many attempts of this station the store does not have yet, as far as is known."""
    with people.database.read() as connection:
        mine = sum(one.station == key.station for one in counted_attempts(connection).values())
    return max(mine - SyncState.of(people).confirmed, 0)


class _Synchronising:
    """One meeting with the store."""

    def __init__(
        self,
        store: SchoolStore,
        place: StorePlace,
        folder: Path,
        people: People,
        key: StationKey,
        trust: bool,
        by: str,
    ) -> None:
        self.store, self.place, self.folder, self.people = store, place, folder, people
        self.key, self.trust, self.by = key, trust, by
        self.result, self.changed = Synchronised(store.name), False
        self.state = SyncState.of(people)
        self.strange: set[str] = set()

    def send(self, progress: Progress) -> None:
        """Put there what is not."""
        own = OwnThings.read(self.folder, self.people, self.key)
        there = self.store.own(self.key.station)
        wanted = list(missing(own, there))
        if wanted:  # whatever breaks this off, limits are held the next time
            self.state = replace(self.state, held=False)
            self.state.keep(self.people)
        for number, some in enumerate(_parts(wanted)):
            progress.report(number * _PACKETS / len(wanted), sentence("sending"))
            packets = [(item, own.packet(kind, item)) for kind, item in some]
            for item, packet in packets:
                if packet is None:
                    self._refuse(sentence("{name} is not sent: it was altered", name=item))
            sent = self.store.put([packet for _, packet in packets if packet is not None])
            self.result = replace(self.result, sent=self.result.sent + sent)
        mine = sum(one.station == self.key.station for one in own.attempts.values())
        self.state = replace(self.state, confirmed=mine)

    def take(self, progress: Progress) -> None:
        """Take in what came there since."""
        rows, head = self.store.after(self.state.place)
        again = self.state.left - {row.seq for row in rows}
        rows = [*self.store.at(again), *rows]
        own = OwnThings.read(self.folder, self.people, self.key)
        marks = own.marks()
        wanted = [row for row in rows if not self._is_here(row, own, marks)]
        wanted.sort(key=lambda row: row.seq)
        left: set[int] = set()
        done = 0
        for kind in (STATION, ERASED, COURSE, ATTEMPT, REMARKS):
            for batch in _batches([row for row in wanted if row.kind == kind]):
                progress.report(done / len(wanted), sentence("taking in"))
                left |= self._take(batch)
                done += len(batch)
        self.state = replace(self.state, place=head, left=frozenset(left))

    def erase(self) -> None:
        """Let nothing stay in the store of who was erased."""
        with self.people.database.read() as connection:
            stones = tombstones(connection)
        if not stones:
            return
        erased = ErasedKeys(stones)
        whose = {one: erased.of(one) for one in self.store.students()}
        deleted = {one for one, kind in whose.items() if kind == "deleted"}
        anonymous = {one for one, kind in whose.items() if kind == "kept"}
        courses = []
        rows = self.store.courses()
        for seq, data in self.store.data(rows).items():
            manifest = _opened(seq, data).manifest
            if any(erased.of(person.key) for person in manifest.people):
                courses.append(seq)
        if deleted or anonymous or courses:
            gone = self.store.take_out(deleted, anonymous, courses)
            self.result = replace(self.result, erased=gone)

    def give_course(self) -> None:
        """Put the course there, if it is another one than the last."""
        own = OwnThings.read(self.folder, self.people, self.key)
        packet = own.course(self.people, self.place.names, self.place.pins)
        if self.store.own(self.key.station).get((COURSE, "")) != packet.mark:
            self.result = replace(self.result, sent=self.result.sent + self.store.put([packet]))

    # --- inside -----------------------------------------------------------------------------------
    def _is_here(
        self, row: PacketRow, own: OwnThings, marks: Mapping[tuple[str, str], str]
    ) -> bool:
        """Return whether a packet brings nothing, as far as its row tells."""
        if row.kind == ATTEMPT:
            known = own.attempts.get(row.item)
            return known is not None and (known.record, known.station) == (row.mark, row.station)
        mine = row.station == self.key.station or row.kind == ERASED
        return mine and marks.get((row.kind, row.item)) == row.mark

    def _take(self, rows: Sequence[PacketRow]) -> set[int]:
        """Take in some packets; return the places of those that have to wait."""
        known = stations_of(self.people)
        left = {row.seq for row in rows if row.station in self.strange}
        data = self.store.data([row for row in rows if row.seq not in left])
        opened: dict[int, OpenedFile] = {}
        for row in rows:
            if row.seq not in data or row.station in self.strange:
                left |= {row.seq} & data.keys()
                continue
            try:
                one = _opened(row.seq, data[row.seq])
                known = stations_with(one.manifest, known, self.key, one.source, self.trust)
                opened[row.seq] = one
            except UnknownStationError:
                self._name_unknown(row.station, one)
                left.add(row.seq)
            except ArchiveError as error:
                self._refuse(sentence_of(error))
        if opened:
            self._gather(list(opened.values()))
        return left

    def _gather(self, files: list[OpenedFile]) -> None:
        way, names = self.state.files, self.place.names
        try:
            done = gather_opened(
                files, self.folder, self.trust, names, self.people, giving_way=way, by=self.by
            )
        except ArchiveError as error:
            if len(files) == 1:
                self._refuse(sentence_of(error))
                return
            for one in files:  # the others are whole
                self._gather([one])
            return
        self.changed = True
        own = {
            digest
            for one in files
            if one.manifest.kind == COURSE_FILE
            for digest in one.manifest.files.values()
        }
        self.state = replace(self.state, files=self.state.files | own)
        self.result = replace(self.result, gathered=_together(self.result.gathered, done))

    def _refuse(self, line: str) -> None:
        self.result = replace(self.result, refused=(*self.result.refused, line))

    def _name_unknown(self, station: str, file: OpenedFile) -> None:
        sender = file.manifest.sender
        one = StrangeStation(sender.name, fingerprint(sender.public))
        self.strange.add(station)
        self.result = replace(self.result, unknown=(*self.result.unknown, one))


def _opened(seq: int, data: bytes) -> OpenedFile:
    source = Path(sentence("packet {place} of the school's store", place=seq))
    with reading(source):
        archive = zipfile.ZipFile(io.BytesIO(data))
        return OpenedFile(archive, source, read_manifest(archive, source))


def _together(first: GatheredFile, second: GatheredFile) -> GatheredFile:
    def both(name: str) -> Any:
        return getattr(first, name) + getattr(second, name)

    summed = ("attempts", "present", "remarks", "erased", "left_out", "people", "courses")
    values: Mapping[str, Any] = {name: both(name) for name in (*summed, "strangers", "different")}
    return GatheredFile(excess=second.excess, **values)


def _batches(rows: Sequence[PacketRow]) -> Iterator[list[PacketRow]]:
    """Return rows in parts that travel at once."""
    some: list[PacketRow] = []
    for row in rows:
        if some and (len(some) >= _PACKETS or sum(one.size for one in some) + row.size > _BATCH):
            yield some
            some = []
        some.append(row)
    if some:
        yield some


def _parts(values: Sequence[tuple[str, str]]) -> Iterator[Sequence[tuple[str, str]]]:
    for begin in range(0, len(values), _PACKETS):
        yield values[begin : begin + _PACKETS]
