"""Backup and restore as one file, erasing a person for good, and what is in the trash too long.

A backup is a ZIP archive: records with their signatures, deleted ones too, people, names, courses
and the user's own exercises, each with its SHA-256 in `manifest.json`; the station's key only
encrypted by the recovery key. Restoring overwrites no record and brings nobody back who was erased.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import sqlite3
import tempfile
import time
import zipfile
from collections.abc import Iterator
from contextlib import closing, suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final, NamedTuple
from uuid import uuid4

from app import __version__
from app.core import paths
from app.core.disclaimer import DISCLAIMER
from app.core.progress import Progress
from app.session.course import courses_folder
from app.session.database import BUSY_SECONDS
from app.session.errors import SessionError
from app.session.header import TRASH
from app.session.index import Index
from app.session.people import NAMES_FILE, PEOPLE, People
from app.session.sidecar import file_digest, read_kept, sidecar
from app.session.signature import signature_file
from app.session.station import StationKey, key_file
from app.session.store import SUFFIX, records

UNDO_DAYS: Final = 30
"""What was deleted can be brought back for so long at least."""

_FORMAT: Final = "acus-backup"
_VERSION: Final = 1
_MANIFEST: Final = "manifest.json"
_MEMBER: Final = re.compile(
    r"(records/(\.trash/)?[0-9A-Za-z][0-9A-Za-z._-]{0,63}\.(mcap|sig)"
    r"|people/(people\.sqlite|names\.json|courses/[a-z0-9-]+\.yaml)|exercises/[\w.-]+\.yaml)"
)
_LARGEST_MANIFEST: Final = 1 << 26


class ArchiveError(SessionError):
    """A backup that cannot be written or read; says what to do."""


@dataclass(frozen=True, slots=True)
class Restored:
    """What a backup brought.

    Attributes:
        records: attempts that were missing here.
        kept: that were here already, unchanged.
        different: ids of attempts that are another file here: the one here was kept.
        erased: attempts left out because their person was erased.
        people: `restored`, `kept` (there are people here already) or `none` in the backup.
        key: `restored`, `same`, `not asked` (no recovery key was given) or `none` in the backup.
    """

    records: int = 0
    kept: int = 0
    different: tuple[str, ...] = ()
    erased: int = 0
    people: str = "none"
    key: str = "none"


def backup(
    out: Path, folder: Path, people: People | None = None, progress: Progress | None = None
) -> int:
    """Write everything into one file, whole or not at all; return how many records are in it.

    Raises:
        ArchiveError: if it cannot be written.
        Cancelled: if that was asked for; nothing is left then.
    """
    people, progress = people or People(), progress or Progress()
    beside = out.with_name(f".{out.name}.{uuid4().hex}")
    count = 0
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        with (
            zipfile.ZipFile(beside, "x", zipfile.ZIP_STORED) as archive,
            tempfile.TemporaryDirectory(prefix="acus-") as scratch,
        ):
            members = list(_members(folder, people, Path(scratch)))
            digests: dict[str, str] = {}
            for number, (name, path) in enumerate(members):
                progress.report(number / len(members), path.name)
                with suppress(FileNotFoundError):  # deleted or moved meanwhile
                    digests[name] = file_digest(path)
                    packed = path.suffix not in (SUFFIX, ".sig")
                    kind = zipfile.ZIP_DEFLATED if packed else zipfile.ZIP_STORED
                    archive.write(path, name, kind)
                    count += name.endswith(SUFFIX)
            manifest = {
                "format": _FORMAT,
                "version": _VERSION,
                "software": __version__,
                "created": datetime.now(UTC).isoformat(timespec="seconds"),
                "key": people.wrapped_key(),
                "files": digests,
                "note": DISCLAIMER,
            }
            archive.writestr(_MANIFEST, json.dumps(manifest, indent=1))
        beside.chmod(0o600)
        os.replace(beside, out)
    except OSError as error:
        raise ArchiveError(f"cannot write {out}: {error.strerror or error}") from error
    finally:
        beside.unlink(missing_ok=True)
    return count


def restore_backup(
    source: Path,
    folder: Path,
    recovery: str = "",
    replace_people: bool = False,
    people: People | None = None,
    progress: Progress | None = None,
) -> Restored:
    """Bring back what a backup holds and is missing here; safe to be repeated.

    Args:
        source: the backup.
        folder: of the records.
        recovery: the printed key; brings back the station's key too, so that its records are
            verified here. Empty leaves the key here alone.
        replace_people: take people, names and courses of the backup although there are some here.
        people: of this station.
        progress: reports, and may cancel.

    Raises:
        ArchiveError: if it is no backup, damaged, of a newer version, or cannot be unpacked.
        SignatureError: for a wrong recovery key; nothing was done then.
        Cancelled: if that was asked for; what was restored by then stays.
    """
    people, progress = people or People(), progress or Progress()
    try:
        with zipfile.ZipFile(source) as archive:
            manifest = _manifest(archive, source)
            key, wrapped = None, manifest["key"]
            if recovery and wrapped:
                key = StationKey.unwrapped(wrapped, recovery)
            gone = people.erased_attempts()
            names: dict[str, str] = manifest["files"]
            found = Restored(key="none" if not wrapped else "not asked")
            for number, (name, digest) in enumerate(names.items()):
                progress.report(number / len(names), name.rpartition("/")[2])
                if name.startswith("records/"):
                    target = folder / name.removeprefix("records/")
                    found = _put_record(archive, name, digest, target, gone, found, source)
                elif name.startswith("exercises/"):
                    target = paths.data() / name
                    if not target.exists():
                        _put(archive, name, digest, target, source)
            if f"people/{PEOPLE}" in names:
                found = _put_people(archive, names, people, replace_people, found, source)
            if key is not None:
                found = replace(found, key=_put_key(key, people))
    except (zipfile.BadZipFile, EOFError, NotImplementedError, RuntimeError) as error:
        raise ArchiveError(f"{source} is no backup of Acus, or damaged: {error}") from error
    except OSError as error:
        why = error.strerror or error
        raise ArchiveError(f"cannot restore {source}: {why} ({error.filename or ''})") from error
    finish_erasing(folder, people)
    return found


class Erased(NamedTuple):
    """What became of the records of somebody who was erased.

    Attributes:
        deleted: how many went.
        anonymous: how many stay as nobody's.
        typed: how many stay and hold the name that was typed.
    """

    deleted: int
    anonymous: int
    typed: int


def erase_person(
    pseudonym: str, folder: Path, delete_records: bool, people: People | None = None
) -> Erased:
    """Erase a person for good; return what became of the records.

    Name, PIN, groups, comments and assignments go. Records of attempts made signed in hold a random
    key only: they go too, or stay as nobody's. Older records may hold a name that was typed: what
    is signed cannot be changed, so such a record stays as it is unless records are deleted.

    Raises:
        PeopleError: if there is no such student.
        DatabaseError, SessionError: if something cannot be read or written.
    """
    people = people or People()
    person = people.find(pseudonym)
    texts = {text for text, key in people.assigned().items() if key == person.key}
    index = Index(folder)
    index.refresh()
    own = {one.id: one.student for one in index.attempts([person.key, *texts])}
    for path in records(folder / TRASH):
        student = read_kept(path).summary.student
        if student == person.key or student in texts:
            own[path.stem] = student
    ids = list(own)
    people.forget_keys([person.key], ids, ids if delete_records else ())
    if delete_records:
        finish_erasing(folder, people)
        index.refresh()
        return Erased(len(ids), 0, 0)
    typed = sum(student in texts for student in own.values())
    return Erased(0, len(own) - typed, typed)


def finish_erasing(folder: Path, people: People) -> int:
    """Delete records of erased persons that are left, as after a kill; return how many."""
    gone = people.erased_attempts()
    count = 0
    for place in (folder, folder / TRASH):
        for path in records(place) if gone else ():
            if path.stem in gone:
                _remove(path)
                count += 1
    return count


def empty_trash(folder: Path, days: float = UNDO_DAYS, now: float | None = None) -> list[str]:
    """Delete for good what was deleted more than so many days ago; return the ids.

    Raises:
        SessionError: if something cannot be deleted.
    """
    now = time.time() if now is None else now
    old = [path for path in records(folder / TRASH) if now - deleted_at(path) > days * 86400.0]
    for path in old:
        _remove(path)
    return [path.stem for path in old]


def deleted_at(path: Path) -> float:
    """Return when a record in the trash was deleted [s since 1970]."""
    beside = sidecar(path)
    return beside.stat().st_mtime if beside.exists() else path.stat().st_ctime


# --- inside ---------------------------------------------------------------------------------------
def _remove(path: Path) -> None:
    """Delete a record and what stands beside it; the record first: nothing else tells of it."""
    try:
        for one in (path, sidecar(path), signature_file(path)):
            one.unlink(missing_ok=True)
    except OSError as error:
        raise SessionError(f"cannot delete {path}: {error.strerror or error}") from error


def _members(folder: Path, people: People, scratch: Path) -> Iterator[tuple[str, Path]]:
    """Yield name in the archive and file of everything that goes into a backup."""
    for place, inside in ((folder, "records"), (folder / TRASH, f"records/{TRASH}")):
        for path in records(place):
            for one in (path, signature_file(path)):
                if one.exists():
                    yield f"{inside}/{one.name}", one
    if (people.folder / PEOPLE).exists():
        copy = scratch / PEOPLE
        with (
            closing(sqlite3.connect(people.folder / PEOPLE, timeout=BUSY_SECONDS)) as source,
            closing(sqlite3.connect(copy)) as target,
        ):
            source.backup(target)
        yield f"people/{PEOPLE}", copy
    if (people.folder / NAMES_FILE).exists():
        yield f"people/{NAMES_FILE}", people.folder / NAMES_FILE
    for path in sorted(courses_folder(people.folder).glob("*.yaml")):
        yield f"people/courses/{path.name}", path
    for path in sorted((paths.data() / "exercises").glob("*.yaml")):
        yield f"exercises/{path.name}", path


def _manifest(archive: zipfile.ZipFile, source: Path) -> dict[str, Any]:
    """Read and check the list of what a backup holds."""
    try:
        if archive.getinfo(_MANIFEST).file_size > _LARGEST_MANIFEST:
            raise ValueError("its list is too long")
        document: dict[str, Any] = json.loads(archive.read(_MANIFEST))
        kind, version = document["format"], document["version"]
        files, known = dict(document["files"]), set(archive.namelist())
        key = dict(document["key"])
    except (KeyError, ValueError, TypeError, RecursionError) as error:
        raise ArchiveError(f"{source} is no backup of Acus: {error}") from error
    if kind != _FORMAT or not isinstance(version, int):
        raise ArchiveError(f"{source} is no backup of Acus: its format is {kind!r}")
    if version > _VERSION:
        raise ArchiveError(f"{source} was written by a newer version of Acus: use that version")
    odd = [name for name in files if not _MEMBER.fullmatch(str(name)) or name not in known]
    if odd:
        raise ArchiveError(f"{source} is damaged: {odd[0]!r} is missing in it or no name of Acus")
    return {"files": files, "key": key}


def _put(archive: zipfile.ZipFile, name: str, digest: str, target: Path, source: Path) -> None:
    """Unpack one file under its name, whole or not at all."""
    target.parent.mkdir(parents=True, exist_ok=True)
    beside = target.with_name(f".{target.name}.{uuid4().hex}")
    try:
        sha = hashlib.sha256()
        with archive.open(name) as packed, beside.open("xb") as stream:
            while block := packed.read(1 << 20):
                sha.update(block)
                stream.write(block)
            stream.flush()
            os.fsync(stream.fileno())
        if sha.hexdigest() != digest:
            raise ArchiveError(f"{source} is damaged: {name} is not what was packed")
        os.replace(beside, target)
    finally:
        beside.unlink(missing_ok=True)


def _put_record(
    archive: zipfile.ZipFile,
    name: str,
    digest: str,
    target: Path,
    gone: frozenset[str],
    found: Restored,
    source: Path,
) -> Restored:
    record = name.endswith(SUFFIX)
    if target.stem in gone:
        return replace(found, erased=found.erased + record)
    other = target.parent.parent if target.parent.name == TRASH else target.parent / TRASH
    here = next((one for one in (target, other / target.name) if one.exists()), None)
    if here is None:
        _put(archive, name, digest, target, source)
        return replace(found, records=found.records + record)
    if not record:
        return found
    if file_digest(here) == digest:
        return replace(found, kept=found.kept + 1)
    return replace(found, different=(*found.different, target.stem))


def _put_people(
    archive: zipfile.ZipFile,
    names: dict[str, str],
    people: People,
    replace_people: bool,
    found: Restored,
    source: Path,
) -> Restored:
    """Take over people, names and courses; who was erased here stays erased."""
    there = (people.folder / PEOPLE).exists()
    if there and not replace_people:
        return replace(found, people="kept")
    erased, attempts = list(people.erased()), sorted(people.erased_attempts())
    people.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    with tempfile.TemporaryDirectory(prefix="acus-") as scratch:
        copy = Path(scratch) / PEOPLE
        _put(archive, f"people/{PEOPLE}", names[f"people/{PEOPLE}"], copy, source)
        try:
            with closing(sqlite3.connect(copy)) as old:
                target = sqlite3.connect(people.folder / PEOPLE, timeout=BUSY_SECONDS)
                with closing(target) as new:
                    old.backup(new)
        except sqlite3.DatabaseError as error:
            raise ArchiveError(f"the people of {source} cannot be restored: {error}") from error
    for name, digest in names.items():
        if name.startswith("people/") and not name.endswith(PEOPLE):
            _put(archive, name, digest, people.folder / name.removeprefix("people/"), source)
    people.database.close()
    people.forget_keys(erased, (), attempts)
    return replace(found, people="restored")


def _put_key(key: StationKey, people: People) -> str:
    """Make the backup's key this station's; the one that was here is set aside."""
    path = key_file(people.folder)
    if path.exists():
        here = StationKey.of(people.folder)
        if here == key:
            return "same"
        os.replace(path, path.with_name(f"station-{here.station}.key"))
    key.keep(people.folder)
    return "restored"
