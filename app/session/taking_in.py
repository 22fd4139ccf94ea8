"""Taking in files of other stations: checked beside their place, then put there as one step.

The rules are told in `gathering`.
"""

from __future__ import annotations

import hashlib
import json
import os
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final
from uuid import uuid4

from app.core import paths
from app.core.files import LARGEST_FILE
from app.core.messages import Sentence, counted, sentence
from app.core.progress import Progress
from app.session.accounts import owner_of
from app.session.backup_file import ArchiveError, unpack
from app.session.header import TRASH
from app.session.journal import Step, move, removal
from app.session.limits import hold_limits
from app.session.people import People, Person, tables
from app.session.roster import looks_like_a_key
from app.session.school_file import SchoolManifest
from app.session.school_tables import COUNTED, TOMBSTONES, ErasedKeys
from app.session.sidecar import file_digest, read_kept, sidecar, summary_text
from app.session.signature import RECORD, shown_of, signature_file
from app.session.station import StationKey, signature_holds
from app.session.station_results import (
    COUNTER,
    CountedAttempt,
    SignedRemark,
    counted_attempts,
    counter_of,
    put_remarks,
    signed_remarks,
    tombstones,
)
from app.session.stations import (
    KnownStation,
    put_setting,
    put_stations,
)
from app.session.store import SUFFIX, beside, records
from app.session.summary import Summary

if TYPE_CHECKING:
    from sqlalchemy import Connection

_RECORDS: Final = "records/"
_COURSES: Final = "people/courses/"


@dataclass(frozen=True, slots=True)
class GatheredFile:
    """What a file of another station brought.

    Attributes:
        station: name of the station that wrote it.
        attempts: that were missing here.
        present: that were here already.
        remarks: that are the latest now.
        erased: persons who were erased here by it.
        left_out: attempts, remarks and people left out because they were erased somewhere.
        people: students who are new here.
        courses: that are new here.
        excess: attempts beyond a course's limit, all files together.
        strangers: of the attempts that were missing, those of students who are not known here.
        different: a line for each thing that is another one here and was left out.
    """

    station: str = ""
    attempts: int = 0
    present: int = 0
    remarks: int = 0
    erased: int = 0
    left_out: int = 0
    people: int = 0
    courses: int = 0
    excess: int = 0
    strangers: int = 0
    different: tuple[str, ...] = ()


def told_of(files: Sequence[GatheredFile]) -> list[Sentence]:
    """Return a line for each thing that somebody has to know of what came, all files together."""
    strangers = sum(one.strangers for one in files)
    excess = files[-1].excess if files else 0
    lines: list[Sentence] = []
    if strangers:
        lines.append(
            counted(
                "{n} attempt is of a student who is not known here and counts for nobody: take the "
                "course of their station in too (`acus store station` there)",
                "{n} attempts are of students who are not known here and count for nobody: take "
                "the course of their station in too (`acus store station` there)",
                strangers,
            )
        )
    if excess:
        lines.append(
            counted(
                "{n} attempt is beyond a course's limit at all stations together: marked",
                "{n} attempts are beyond a course's limit at all stations together: marked",
                excess,
            )
        )
    return lines


@dataclass(frozen=True, slots=True)
class OpenedFile:
    """A file of another station, open, and what it says of itself.

    Attributes:
        archive: the file.
        source: its path, or what it is called in messages.
        manifest: what it says, signed.
    """

    archive: zipfile.ZipFile
    source: Path
    manifest: SchoolManifest


@dataclass
class TakingIn:
    """Files on their way in.

    Attributes:
        files: of other stations, open.
        folder: of the records here.
        people: of this station.
        key: of this station.
        known: stations, with those of the files.
        giving_way: digests of files here that another one may replace.
        done: what came of it so far.
    """

    files: tuple[OpenedFile, ...]
    folder: Path
    people: People
    key: StationKey
    known: Mapping[str, KnownStation]
    giving_way: frozenset[str]
    done: GatheredFile = field(default_factory=GatheredFile)
    erased_keys: ErasedKeys = field(default_factory=lambda: ErasedKeys(()))
    counted: dict[str, CountedAttempt] = field(default_factory=dict)
    steps: list[Step] = field(default_factory=list)
    courses: list[Path] = field(default_factory=list)
    brought: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        """Begin with the first file."""
        self.current = self.files[0]

    def take(self, names: bool, progress: Progress) -> None:
        """Prepare everything beside its place, then put it there as one step."""
        self.done = replace(self.done, station=self.current.manifest.sender.name)
        mark = f".gathering.{uuid4().hex}"
        rooms = (self.folder, self.people.folder, paths.data())
        for room in rooms:
            room.mkdir(parents=True, exist_ok=True, mode=0o700)
        stages = {room: room / mark for room in rooms}
        undo = [removal(stage) for stage in stages.values()]

        def prepare() -> None:
            with self.people.database.read() as connection:
                stones = tombstones(connection)
            sent = (stone for one in self.files for stone in one.manifest.tombstones)
            self.erased_keys = ErasedKeys({*stones, *sent})
            gone = self.people.erased_attempts()
            for stage in stages.values():
                stage.mkdir(mode=0o700)
            for number, one in enumerate(self.files):
                self.current = one
                share = progress.part(number / len(self.files), (number + 1) / len(self.files))
                self._stage(gone, stages, share)
            _sync(stages.values())

        with self.people.as_one(self.steps, undo, prepare) as (connection, write_names):
            put_stations(connection, self.key, self.known.values())
            listed, after = self.people.names(), self.people.names()
            here = {one.key: one for one in self.people.everybody()}
            for one in self.files:
                self.current = one
                self._change(connection)
                self._take_people(connection, here, after if names else {})
            remarks = (remark for one in self.files for remark in one.manifest.remarks)
            most = max((one.counter for one in remarks), default=0)
            put_setting(connection, COUNTER, str(max(counter_of(connection), most)))
            self.done = replace(self.done, strangers=self._strangers(here))
            self._erase(connection, set(here))
            gone = self.erased_keys
            after = {one: name for one, name in after.items() if not gone.of(owner_of(one))}
            if after != listed:
                write_names(after)
            excess = hold_limits(connection, self.people.folder, self.courses)
            self.done = replace(self.done, excess=excess)
            self.steps += undo
        if self.done.erased:
            self.people.database.shrink()

    @property
    def manifest(self) -> SchoolManifest:
        """Return what the file says that is being taken."""
        return self.current.manifest

    @property
    def archive(self) -> zipfile.ZipFile:
        """Return the file that is being taken."""
        return self.current.archive

    @property
    def source(self) -> Path:
        """Return the path of the file that is being taken."""
        return self.current.source

    # --- files ------------------------------------------------------------------------------------
    def _stage(self, gone: frozenset[str], stages: Mapping[Path, Path], progress: Progress) -> None:
        """Unpack and check what is missing here, and is not `gone` with its person."""
        for number, one in enumerate(self.manifest.attempts):
            progress.report(number / len(self.manifest.attempts), one.attempt)
            self._stage_attempt(one, gone, stages[self.folder])
        rooms = ((_COURSES, self.people.folder), ("exercises/", paths.data()))
        for name in self.manifest.files:
            progress.check()
            for begin, room in (*rooms, ("structures/", paths.data())):
                if name.startswith(begin):
                    self._stage_own(name, room / name.removeprefix("people/"), stages[room])

    def _stage_attempt(self, attempt: CountedAttempt, gone: frozenset[str], stage: Path) -> None:
        record, signature = (
            f"{_RECORDS}{attempt.attempt}{SUFFIX}",
            f"{_RECORDS}{attempt.attempt}.sig",
        )
        if (
            self.manifest.files.get(record) != attempt.record
            or signature not in self.manifest.files
        ):
            raise ArchiveError(_damaged(self.source, record))
        if attempt.attempt in gone or self.erased_keys.of(attempt.student) == "deleted":
            self.done = replace(self.done, left_out=self.done.left_out + 1)
            return
        target = self.folder / f"{attempt.attempt}{SUFFIX}"
        places = (target, self.folder / TRASH / target.name)
        here = next((path for path in places if path.exists()), None)
        if here is not None and file_digest(here) != attempt.record:
            self.say(
                sentence(
                    "the attempt {name} is another record here: the one here was kept, ask its "
                    "station which is right",
                    name=attempt.attempt,
                )
            )
            return
        if attempt.attempt in self.counted:  # another file has just brought it
            here = here or target
        self.counted[attempt.attempt] = attempt
        if here is not None:
            self.done = replace(self.done, present=self.done.present + 1)
            return
        for name, place in ((signature, signature_file(target)), (record, target)):
            self._unpack(name, stage / place.name)
            self.steps.append(move(stage / place.name, place))
        shown = self._check_signature(stage / target.name, attempt)
        self._stage_summary(stage / target.name, attempt.record, shown)
        self.brought.append(attempt.attempt)
        self.done = replace(self.done, attempts=self.done.attempts + 1)

    def _unpack(self, name: str, target: Path) -> None:
        try:
            digest = self.manifest.files[name]
            unpack(self.archive, name, digest, target, self.source, durable=False)
        except ArchiveError as error:
            raise ArchiveError(_damaged(self.source, name)) from error

    def _check_signature(self, record: Path, attempt: CountedAttempt) -> dict[str, Any]:
        """Return what lists show by the signature of a record.

        Refuses the file where its station did not sign this record of this student.
        """
        try:
            document = json.loads(signature_file(record).read_text("ascii"))
            shown, public = document["shown"], str(document.pop("public"))
            signature = str(document.pop("ed25519"))
            del document["hmac"]
            said = (document["id"], document["station"], document["record"])
            whom = (shown["student"], shown["exercise"])
        except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
            raise ArchiveError(_damaged(self.source, record.name)) from error
        mine = public in self.key.publics
        theirs = self.known.get(public)
        right = mine or (theirs is not None and theirs.station == attempt.station)
        right = right and said == (attempt.attempt, attempt.station, attempt.record)
        right = right and whom == (attempt.student, attempt.exercise)
        if not (right and signature_holds(public, RECORD, document, signature)):
            raise ArchiveError(
                sentence(
                    "{source} is forged: {name} is not signed by the station {station}; ask there "
                    "for the file",
                    source=self.source,
                    name=attempt.attempt,
                    station=self.manifest.sender.name,
                )
            )
        return dict(shown)

    def _stage_summary(self, record: Path, digest: str, shown: Mapping[str, Any]) -> None:
        """Keep the summary that the station gives of a record beside it, for lists.

        One that does not say what is signed is left out: lists read the record then.
        """
        name = f"{_RECORDS}{record.stem}.json"
        info = self.archive.NameToInfo.get(name) if name in self.manifest.files else None
        if info is None or info.file_size > LARGEST_FILE:
            return
        data = self.archive.read(info)
        try:
            summary = Summary.of(json.loads(data), record.stem)
        except (ValueError, LookupError, TypeError, ArithmeticError, RecursionError):
            return
        right = hashlib.sha256(data).hexdigest() == self.manifest.files[name]
        if right and shown_of(summary) == shown:
            text = summary_text(record, summary, digest)
            sidecar(record).write_text(text, encoding="utf-8", newline="\n")
            self.steps.append(move(sidecar(record), sidecar(self.folder / record.name)))

    def _stage_own(self, name: str, target: Path, stage: Path) -> None:
        """Prepare a course or an exercise; one that is here is kept, and said if it is another."""
        digest = self.manifest.files[name]
        here = next((path for path in (stage / name, target) if path.exists()), None)
        present = "" if here is None else file_digest(here)
        if present and (here != target or present == digest or present not in self.giving_way):
            if present != digest:
                self.say(
                    sentence(
                        "{name} is another file here: the one here was kept; to have both let one "
                        "station give its own another id",
                        name=name,
                    )
                )
            return
        self._unpack(name, stage / name)
        self.steps.append(move(stage / name, target))
        if name.startswith(_COURSES):
            self.courses.append(stage / name)
            self.done = replace(self.done, courses=self.done.courses + 1)

    # --- lists ------------------------------------------------------------------------------------
    def _change(self, connection: Connection) -> None:
        """Write what is signed: tombstones, numbers and remarks."""
        from sqlalchemy.dialects.sqlite import insert

        stones = [stone._asdict() for stone in self.manifest.tombstones]
        brought = [one.attempt for one in self.manifest.attempts if one.attempt in self.counted]
        numbers = [self.counted[name]._asdict() for name in brought]
        for table, rows in ((TOMBSTONES, stones), (COUNTED, numbers)):
            if rows:
                connection.execute(insert(tables()[table]).on_conflict_do_nothing(), rows)
        latest = signed_remarks(connection)
        later: dict[tuple[str, str], SignedRemark] = {}
        keys = {**self.known}
        for public in self.key.publics:  # what this station said, come back
            keys[public] = KnownStation(self.key.station, "", public)
        for remark in self.manifest.remarks:
            place = (remark.attempt, remark.kind)
            before = later.get(place, latest.get(place))
            if self.erased_keys.of(remark.student):
                self.done = replace(self.done, left_out=self.done.left_out + 1)
            elif before is not None and before.order() >= remark.order():
                continue
            elif not remark.holds(keys):
                raise ArchiveError(
                    sentence(
                        "{source} is forged: a remark in it is not signed by the station "
                        "{station}; ask there for the file",
                        source=self.source,
                        station=self.manifest.sender.name,
                    )
                )
            else:
                later[place] = remark
        put_remarks(connection, later.values())
        self.done = replace(self.done, remarks=self.done.remarks + len(later))

    def _take_people(
        self, connection: Connection, known: dict[str, Person], listed: dict[str, str]
    ) -> None:
        """Add the students who are new to those here, and their names to a list."""
        from sqlalchemy.dialects.sqlite import insert

        persons, members = tables()["persons"], tables()["members"]
        taken = {one.pseudonym.casefold(): one.key for one in known.values()}
        for one in self.manifest.people:
            holder = taken.get(one.pseudonym.casefold(), one.key)
            if self.erased_keys.of(one.key):
                self.done = replace(self.done, left_out=self.done.left_out + 1)
                continue
            if one.key not in known and holder != one.key:
                self.say(
                    sentence(
                        "{pseudonym} is somebody else here: give one of them another pseudonym "
                        "(`acus people rename`), then take this in again",
                        pseudonym=one.pseudonym,
                    )
                )
                continue
            if one.key not in known:
                connection.execute(persons.insert(), one.row())
                known[one.key] = Person(one.key, one.pseudonym)
                taken[one.pseudonym.casefold()] = one.key
                self.done = replace(self.done, people=self.done.people + 1)
            for group in one.groups:
                put = insert(members).values(person=one.key, grp=group)
                connection.execute(put.on_conflict_do_nothing())
            if one.name:
                listed.setdefault(one.key, one.name)

    def _strangers(self, known: Mapping[str, Person]) -> int:
        """Return how many of the attempts that come are of students whom nobody here knows."""
        whose = [self.counted[name].student for name in self.brought]
        keys = [one for one in whose if looks_like_a_key(one) and not self.erased_keys.of(one)]
        return sum(one not in known for one in keys)

    def _erase(self, connection: Connection, known: set[str]) -> None:
        """Erase who has a tombstone, with records where these were not kept as nobody's."""
        counted = counted_attempts(connection)
        latest = signed_remarks(connection)
        students = known | {one.student for one in counted.values()}
        gone = {key for key in students if self.erased_keys.of(key)}
        if not gone:
            return
        numbered = {name: one.student for name, one in counted.items()}
        files = [*records(self.folder), *records(self.folder / TRASH)]
        whose = {path: numbered.get(path.stem) or read_kept(path).summary.student for path in files}
        own = [path for path, student in whose.items() if student in gone]
        lost = [path for path in own if self.erased_keys.of(whose[path]) == "deleted"]
        names = {name for name, student in numbered.items() if student in gone}
        comments = names | {path.stem for path in own}
        comments |= {place[0] for place, one in latest.items() if self.erased_keys.of(one.student)}
        ids = {path.stem for path in lost}
        ids |= {name for name in names if self.erased_keys.of(numbered[name]) == "deleted"}
        self.people.forget_in(connection, sorted(gone), sorted(comments), sorted(ids))
        self.steps += [removal(file) for path in lost for file in beside(path)]
        self.done = replace(self.done, erased=len(gone & known))

    def say(self, line: str) -> None:
        """Name what is left out because it is another one here."""
        self.done = replace(self.done, different=(*self.done.different, line))


def _sync(stages: Any) -> None:
    """Wait until what was unpacked stands on the disk."""
    if hasattr(os, "sync"):
        os.sync()  # one wait for thousands of small files
        return
    for stage in stages:
        for path in stage.rglob("*"):
            if path.is_file():
                with path.open("rb+") as stream:
                    os.fsync(stream.fileno())


def _damaged(source: Path, name: str) -> str:
    return sentence(
        "{source} is damaged at {name}: fetch it anew from its station", source=source, name=name
    )
