"""Writing what a station gives to the others: its results, or the course for a station."""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Callable, Iterator
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path

from app.core.files import beside, remove, step, sweep
from app.core.files import replace as put_in_place
from app.core.messages import sentence
from app.core.progress import Progress
from app.session.archive import own_files
from app.session.audit import note
from app.session.backup_file import ArchiveError, may_hold
from app.session.course import Course, courses_folder
from app.session.errors import SessionError
from app.session.journal import Journal, removal
from app.session.people import PEOPLE, People, tables
from app.session.school_file import (
    COURSE,
    RESULTS,
    SchoolManifest,
    SentStudent,
    attempts_of,
    packed_digest,
    write_manifest,
)
from app.session.sidecar import cached, file_digest
from app.session.signature import Signed, read_signature, signature_text
from app.session.station import StationKey
from app.session.station_results import (
    CountedAttempt,
    counted_attempts,
    counter_of,
    sign_and_number,
    signed_remarks,
    tombstones,
)
from app.session.stations import KnownStation, name_of_station, stations_of
from app.session.store import SUFFIX, settled


@dataclass(frozen=True, slots=True)
class WrittenFile:
    """What a file for other stations holds.

    Attributes:
        attempts: how many.
        remarks: how many.
        erased: tombstones.
        people: students.
        courses: how many.
        left_out: ids of attempts whose record or signature is not what it was.
    """

    attempts: int = 0
    remarks: int = 0
    erased: int = 0
    people: int = 0
    courses: int = 0
    left_out: tuple[str, ...] = ()


def write_results(
    out: Path,
    folder: Path,
    course: Course | None = None,
    people: People | None = None,
    progress: Progress | None = None,
) -> WrittenFile:
    """Write the results of this station into one file, whole or not at all.

    Finished attempts that this station signed, with what was said of attempts here, and who was
    erased; what it has from other stations those give themselves.

    Args:
        out: the file.
        folder: of the records.
        course: only attempts at its exercises; None for all.
        people: of this station.
        progress: reports, and may cancel; nothing is left then.

    Raises:
        ArchiveError: if it cannot be written.
    """
    people, progress = people or People(), progress or Progress()
    key = up_to_date(folder, people, progress.part(0.0, 0.3))

    def fill(archive: zipfile.ZipFile) -> WrittenFile:
        with people.database.read() as connection:
            every = counted_attempts(connection)
            remarks = list(signed_remarks(connection).values())
            stones, counter = tombstones(connection), counter_of(connection)
        exercises = None if course is None else {item.exercise for item in course.items}
        wanted = {
            name for name, one in every.items() if exercises is None or one.exercise in exercises
        }
        own = attempts_of(
            one for name, one in every.items() if name in wanted and one.station == key.station
        )
        files: dict[str, str] = {}
        taken: list[CountedAttempt] = []
        left: list[str] = []
        for number, one in enumerate(own):
            progress.report(0.3 + 0.7 * number / len(own), one.attempt)
            if not (folder / f"{one.attempt}{SUFFIX}").exists():
                continue  # deleted here: it is not this station's result any more
            if digests := pack_attempt(archive, folder, one, key):
                files |= digests
                taken.append(one)
            else:
                left.append(one.attempt)
        mine = [
            one
            for one in remarks
            if one.station == key.station and (exercises is None or one.attempt in wanted)
        ]
        manifest = SchoolManifest(
            RESULTS,
            sender_of(people, key, counter),
            tuple(key.succession()),
            files,
            tuple(taken),
            tuple(mine),
            tuple(stones),
        )
        write_manifest(archive, manifest, key)
        return WrittenFile(len(taken), len(mine), len(stones), left_out=tuple(left))

    note("results written", folder=people.folder)
    return _whole(out, people, fill)


def write_course(
    out: Path,
    folder: Path,
    names: bool = False,
    pins: bool = False,
    people: People | None = None,
    progress: Progress | None = None,
) -> WrittenFile:
    """Write the course for a station into one file, whole or not at all.

    People by key and pseudonym with their groups, courses, own exercises, and known stations.

    Args:
        out: the file.
        folder: of the records.
        names: of the students too.
        pins: hashes of their PINs too.
        people: of this station.
        progress: reports, and may cancel; nothing is left then.

    Raises:
        ArchiveError: if it cannot be written.
    """
    people, progress = people or People(), progress or Progress()
    key = up_to_date(folder, people, progress.part(0.0, 0.3))

    def fill(archive: zipfile.ZipFile) -> WrittenFile:
        manifest = pack_course(archive, people, key, names, pins, progress.part(0.3, 1.0))
        write_manifest(archive, manifest, key)
        return WrittenFile(
            erased=len(manifest.tombstones),
            people=len(manifest.people),
            courses=sum(name.startswith("people/") for name in manifest.files),
        )

    return _whole(out, people, fill)


def pack_course(
    archive: zipfile.ZipFile,
    people: People,
    key: StationKey,
    names: bool,
    pins: bool,
    progress: Progress,
) -> SchoolManifest:
    """Pack courses and own exercises; return what a course for a station says."""
    with people.database.read() as connection:
        stones, counter = tombstones(connection), counter_of(connection)
    files = {}
    members = [*_courses(people), *own_files()]
    for number, (name, path) in enumerate(members):
        progress.report(number / len(members), path.name)
        if may_hold(name):
            step("pack", path)
            files[name] = packed_digest(path.read_bytes(), name, archive)
    return SchoolManifest(
        COURSE,
        sender_of(people, key, counter),
        tuple(key.succession()),
        files,
        tombstones=tuple(stones),
        people=tuple(_students(people, names, pins)),
        stations=tuple(stations_of(people).values()),
    )


def up_to_date(folder: Path, people: People, progress: Progress) -> StationKey:
    """Sign and number what is new here, before it is sent; return the key of this station."""
    key = StationKey.of(people.folder)
    settled(folder)
    sign_and_number(folder, people, key, progress)
    return key


def sender_of(people: People, key: StationKey, counter: int) -> KnownStation:
    """Return this station as its files tell of it."""
    return KnownStation(key.station, name_of_station(people, key), key.public, counter)


def pack_attempt(
    archive: zipfile.ZipFile, folder: Path, attempt: CountedAttempt, key: StationKey
) -> dict[str, str]:
    """Pack a record with its signature; nothing where one of them is not what it was."""
    path = folder / f"{attempt.attempt}{SUFFIX}"
    step("pack", path)
    document, check = read_signature(path, key)
    if check.verdict is not Signed.VERIFIED or document["record"] != file_digest(path):
        return {}
    # those of earlier versions have no signature that others could verify
    parts = {".sig": signature_text(document, key).encode(), SUFFIX: path.read_bytes()}
    kept = cached(path)
    if kept is not None and kept.fits(path):
        summary = json.dumps(kept.summary.document(), ensure_ascii=False, allow_nan=False)
        parts[".json"] = summary.encode("utf-8", "surrogatepass")
    names = {f"records/{attempt.attempt}{ending}": data for ending, data in parts.items()}
    return {name: packed_digest(data, name, archive) for name, data in names.items()}


# --- inside ---------------------------------------------------------------------------------------
def _whole(
    out: Path, people: People, fill: Callable[[zipfile.ZipFile], WrittenFile]
) -> WrittenFile:
    """Write an archive beside its place, for this user only, and put it there once it is whole."""
    part = beside(out)
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        sweep(out.parent)
        with ExitStack() as stack:
            with suppress(SessionError):  # a folder of people that can only be read
                stack.enter_context(Journal(people.folder, [removal(part)]))
            stack.callback(remove, part)
            step("write", part)
            with zipfile.ZipFile(part, "x", zipfile.ZIP_STORED) as archive:
                part.chmod(0o600)
                written = fill(archive)
            with part.open("rb+") as stream:
                os.fsync(stream.fileno())
            put_in_place(part, out)
    except OSError as error:
        why = error.strerror or error
        raise ArchiveError(sentence("cannot write {out}: {reason}", out=out, reason=why)) from error
    return written


def _students(people: People, names: bool, pins: bool) -> Iterator[SentStudent]:
    from sqlalchemy import select

    hashes: dict[str, str] = {}
    if pins and (people.folder / PEOPLE).exists():
        persons = tables()["persons"].c
        with people.database.read() as connection:
            hashes = {
                str(key): str(pin)
                for key, pin in connection.execute(select(persons.key, persons.pin))
            }
    for one in people.everybody(names):
        yield SentStudent(one.key, one.pseudonym, one.groups, one.name, hashes.get(one.key, ""))


def _courses(people: People) -> Iterator[tuple[str, Path]]:
    for path in sorted(courses_folder(people.folder).glob("*.yaml")):
        yield f"people/courses/{path.name}", path
