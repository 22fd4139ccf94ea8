"""Backup of everything, as one file or into a folder that keeps what is alike once.

One file is a ZIP archive: records with their signatures, deleted ones too, people, names, courses,
the user's own exercises with their structures and profiles, each with its SHA-256 in
`manifest.json`; the station's key only encrypted by the recovery key. CTs are left out and named.
A folder (`backup_folder`) takes the same files, and CTs where they are asked for.
`restoring` brings it back, `erasing` lets nothing be left of a person.

Looking through everything a station keeps, or a backup of it, without changing anything.

Every record is read whole and held against its signature, every file of a backup against its list.
"""

from __future__ import annotations

import hashlib
import json
import os
import sqlite3
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterator
from contextlib import ExitStack, closing, suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

from app import __version__
from app.core import paths
from app.core.configuration import read_yaml
from app.core.disclaimer import DISCLAIMER
from app.core.files import beside, remove, replace, step, sweep
from app.core.messages import sentence
from app.core.progress import Progress
from app.session.audit import entries, note
from app.session.backup_file import (
    FORMAT,
    MANIFEST,
    VERSION,
    ArchiveError,
    may_hold,
    read_manifest,
)
from app.session.backup_folder import OBJECTS, opened_backup, pieces_for, write_list
from app.session.course import courses_folder
from app.session.database import BUSY_SECONDS
from app.session.erasing import UNDO_DAYS as UNDO_DAYS
from app.session.erasing import Erased as Erased
from app.session.erasing import deleted_at as deleted_at
from app.session.erasing import empty_trash as empty_trash
from app.session.erasing import erase_person as erase_person
from app.session.erasing import finish_erasing as finish_erasing
from app.session.errors import SessionError
from app.session.header import TRASH
from app.session.journal import Journal, removal
from app.session.people import NAMES_FILE, PEOPLE, People
from app.session.restoring import Restored as Restored
from app.session.restoring import restore_backup as restore_backup
from app.session.sidecar import file_digest
from app.session.signature import Signed, read_signature, signature_file
from app.session.station import StationKey, this_station
from app.session.store import SUFFIX, records

_STRUCTURES: Final = (".nrrd", ".nii", ".gz", ".dcm")
"""Endings of files of structures that may lie beside an exercise."""


def backup(
    out: Path, folder: Path, people: People | None = None, progress: Progress | None = None
) -> int:
    """Write everything into one file, whole or not at all; return how many records are in it.

    What is prepared lies beside the file; a program that is killed leaves it until the next start.

    Raises:
        ArchiveError: if it cannot be written.
        Cancelled: if that was asked for; nothing is left then.
    """
    people, progress = people or People(), progress or Progress()
    part, scratch = beside(out), beside(out.with_name(f"{out.name}.people"))
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        sweep(out.parent)
        with ExitStack() as stack:
            with suppress(SessionError):  # a folder of people that can only be read
                stack.enter_context(Journal(people.folder, [removal(part), removal(scratch)]))
            stack.callback(remove, scratch)
            stack.callback(remove, part)
            count = _write(part, scratch, folder, people, progress)
            part.chmod(0o600)
            replace(part, out)
    except (OSError, sqlite3.Error) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise ArchiveError(sentence("cannot write {out}: {reason}", out=out, reason=why)) from error
    note("backup written", folder=people.folder)
    return count


@dataclass(frozen=True, slots=True)
class Saved:
    """What was written into a folder of backups.

    Attributes:
        path: the backup's list.
        records: how many attempts it holds.
        new: bytes that were not there before.
        left_out: what is not in it, a line each.
    """

    path: Path
    records: int
    new: int
    left_out: tuple[str, ...]


def backup_into(
    out: Path,
    folder: Path,
    people: People | None = None,
    progress: Progress | None = None,
    passphrase: str = "",
    with_cts: bool = False,
) -> Saved:
    """Add a backup to a folder of backups: what is there already is not written again.

    Args:
        out: folder of backups; made where there is none.
        folder: of the records.
        people: of this station.
        progress: reports, and may cancel.
        passphrase: encrypts; that of the backups that are there. Empty: nothing is encrypted.
        with_cts: the CTs of the user's own exercises too.

    Raises:
        ArchiveError: if it cannot be written, or another passphrase holds there.
        Cancelled: if that was asked for; there is no new list then.
    """
    people, progress = people or People(), progress or Progress()
    digests: dict[str, str] = {}
    names: dict[str, list[str]] = {}
    new, scratch = 0, beside(out / "people")
    try:
        out.mkdir(parents=True, exist_ok=True, mode=0o700)
        for place in (out, *sorted((out / OBJECTS).glob("*"))):
            sweep(place)
        pieces = pieces_for(out, passphrase)
        with ExitStack() as stack:
            with suppress(SessionError):  # a folder of people that can only be read
                stack.enter_context(Journal(people.folder, [removal(scratch)]))
            stack.callback(remove, scratch)
            every = list(_members(folder, people, scratch))
            every += ct_files() if with_cts else []
            members = [(name, path) for name, path in every if may_hold(name)]
            for number, (name, path) in enumerate(members):
                progress.report(number / len(members), path.name)
                with suppress(FileNotFoundError), path.open("rb") as stream:  # deleted meanwhile
                    digests[name], names[name], count = pieces.put(stream)
                    new += count
            odd = [f"{name}, by its name" for name, _ in every if not may_hold(name)]
            document = _manifest(people, digests, [*left_out(with_cts), *odd])
            written = write_list(pieces, document | {"pieces": names})
    except (OSError, sqlite3.Error) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else error
        raise ArchiveError(sentence("cannot write {out}: {reason}", out=out, reason=why)) from error
    note("backup written", folder=people.folder)
    count = sum(name.endswith(SUFFIX) for name in digests)
    return Saved(written, count, new, tuple(document["left_out"]))


def ct_folders() -> dict[str, tuple[Path | None, list[str]]]:
    """Return the CTs of the user's own exercises: folder and exercises, by digest or folder.

    The folder is None where it is not there.
    """
    found: dict[str, tuple[Path | None, list[str]]] = {}
    for path in sorted((paths.data() / "exercises").glob("*.yaml")):
        try:
            ct = read_yaml(path).get("ct") or {}
            if ct.get("folder"):
                place = (path.parent / str(ct["folder"])).resolve()
                where = ct.get("digest") or sentence(
                    "without a digest, in {folder}", folder=ct["folder"]
                )
                found.setdefault(str(where), (place if place.is_dir() else None, []))[1].append(
                    path.stem
                )
        except (OSError, ValueError, AttributeError, LookupError, TypeError):
            continue  # a file that is no exercise goes in as it is
    return found


def ct_files() -> Iterator[tuple[str, Path]]:
    """Yield name in the backup and file of the CTs of the user's own exercises."""
    for digest, (place, _) in ct_folders().items():
        if place is not None:
            named = hashlib.sha256(digest.encode()).hexdigest()[:16]
            files = (path for path in sorted(place.rglob("*")) if path.is_file())
            yield from ((f"cts/{named}/{k:06d}", path) for k, path in enumerate(files))


def left_out(with_cts: bool = False) -> list[str]:
    """Say what a backup does not hold: CTs, by their digests, and files that lie elsewhere.

    Args:
        with_cts: CTs that are there are in it.
    """
    data = paths.data()
    lines: list[str] = []
    for path in sorted((data / "exercises").glob("*.yaml")):
        try:
            parts = read_yaml(path).get("structures") or ()
            files = [Path(str(part["file"])) for part in parts]
        except (OSError, ValueError, AttributeError, LookupError, TypeError):
            continue  # a file that is no exercise goes in as it is
        for file in files:
            places = ((room / file).resolve() for room in (path.parent, data / "structures"))
            if not any(p.is_file() and p.is_relative_to(data.resolve()) for p in places):
                lines.append(
                    sentence("the structures {file} of {path_stem}", file=file, path_stem=path.stem)
                )
    return [
        sentence("the CT {name} of {some}", name=name, some=", ".join(some))
        for name, (place, some) in sorted(ct_folders().items())
        if not (with_cts and place is not None)
    ] + lines


def own_files() -> Iterator[tuple[str, Path]]:
    """Yield name in the archive and file of the user's own exercises with what belongs to them."""
    own, structures = paths.data() / "exercises", paths.data() / "structures"
    for path in (*sorted(own.glob("*")), *sorted((own / "profiles").glob("*.yaml"))):
        if path.is_file() and path.suffix in (".yaml", *_STRUCTURES):
            yield f"exercises/{path.relative_to(own).as_posix()}", path
    for path in sorted(structures.rglob("*")):
        if path.is_file() and not path.name.startswith("."):
            yield f"structures/{path.relative_to(structures).as_posix()}", path


# --- inside ---------------------------------------------------------------------------------------
def _write(part: Path, scratch: Path, folder: Path, people: People, progress: Progress) -> int:
    """Write the archive; return how many records are in it."""
    count, digests = 0, {}
    step("write", part)
    with zipfile.ZipFile(part, "x", zipfile.ZIP_STORED) as archive:
        every = list(_members(folder, people, scratch))
        members = [(name, path) for name, path in every if may_hold(name)]
        odd = [f"{name}, by its name" for name, _ in every if not may_hold(name)]
        for number, (name, path) in enumerate(members):
            progress.report(number / len(members), path.name)
            with suppress(FileNotFoundError):  # deleted or moved meanwhile
                digests[name] = _pack(archive, name, path)
                count += name.endswith(SUFFIX)
        manifest = _manifest(people, digests, [*left_out(), *odd])
        archive.writestr(MANIFEST, json.dumps(manifest, indent=1))
    with part.open("rb+") as stream:
        os.fsync(stream.fileno())
    return count


def _manifest(people: People, digests: dict[str, str], without: list[str]) -> dict[str, Any]:
    """Return what a backup says of itself."""
    key = this_station()
    return {
        "format": FORMAT,
        "version": VERSION,
        "software": __version__,
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "station": key.station if key is not None else "",
        "key": people.wrapped_key(),
        "files": digests,
        "left_out": without,
        "note": DISCLAIMER,
    }


def _pack(archive: zipfile.ZipFile, name: str, path: Path) -> str:
    """Pack a file as it is while it is read; return the SHA-256 of just that."""
    step("pack", path)
    sha = hashlib.sha256()
    with path.open("rb") as stream:
        info = zipfile.ZipInfo.from_file(path, name)
        packed = path.suffix not in (SUFFIX, ".sig")
        info.compress_type = zipfile.ZIP_DEFLATED if packed else zipfile.ZIP_STORED
        with archive.open(info, "w") as target:
            while block := stream.read(1 << 20):
                sha.update(block)
                target.write(block)
    return sha.hexdigest()


def _members(folder: Path, people: People, scratch: Path) -> Iterator[tuple[str, Path]]:
    """Yield name in the archive and file of everything that goes into a backup."""
    for place, inside in ((folder, "records"), (folder / TRASH, f"records/{TRASH}")):
        for path in records(place):
            for one in (signature_file(path), path):
                if one.exists():
                    yield f"{inside}/{one.name}", one
    if (people.folder / PEOPLE).exists():
        yield f"people/{PEOPLE}", _copied(people.folder / PEOPLE, scratch / PEOPLE)
    if (people.folder / NAMES_FILE).exists():
        yield f"people/{NAMES_FILE}", people.folder / NAMES_FILE
    for path in sorted(courses_folder(people.folder).glob("*.yaml")):
        yield f"people/courses/{path.name}", path
    yield from own_files()
    for path in sorted((paths.data() / "research").glob("*/*")):
        if path.suffix in (".yaml", ".json"):
            yield f"research/{path.parent.name}/{path.name}", path
        elif path.suffix == ".sqlite":
            copy = scratch / "research" / path.parent.name / path.name
            yield f"research/{path.parent.name}/{path.name}", _copied(path, copy)


def _copied(path: Path, copy: Path) -> Path:
    """Copy a database as it stands at one moment, for this user only."""
    step("copy", copy)
    copy.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    with (
        closing(sqlite3.connect(path, timeout=BUSY_SECONDS)) as source,
        closing(sqlite3.connect(copy)) as target,
    ):
        source.backup(target)
    return copy


@dataclass(frozen=True, slots=True)
class StoreCheck:
    """What was looked through, and what is wrong with it.

    Attributes:
        files: how many were read whole.
        signatures: how many records of each verdict; empty of a backup.
        wrong: a line for each thing that is not as it was written.
    """

    files: int
    signatures: dict[str, int]
    wrong: tuple[str, ...]


def check_store(
    folder: Path, people: People | None = None, progress: Progress | None = None
) -> StoreCheck:
    """Read every record, deleted ones too, the list of people and the audit trail.

    Args:
        folder: of the records.
        people: of this station.
        progress: reports, and may cancel.

    Raises:
        SessionError: if the folder or the station's key cannot be read.
        Cancelled: if that was asked for.
    """
    people, progress = people or People(), progress or Progress()
    key = StationKey.of(people.folder)
    every = [*records(folder), *records(folder / TRASH)]
    wrong: list[str] = []
    verdicts: Counter[str] = Counter()
    for number, path in enumerate(every):
        progress.report(number / len(every), path.stem)
        document, check = read_signature(path, key)
        try:
            digest = file_digest(path)
        except OSError as error:
            reason = error.strerror or error
            wrong.append(sentence("{file} cannot be read: {reason}", file=path, reason=reason))
            continue
        altered = check.verdict is Signed.ALTERED or (document and document["record"] != digest)
        verdicts[Signed.ALTERED if altered else check.verdict] += 1
        if altered:
            wrong.append(sentence("{file} was altered after it was signed", file=path))
    if (people.folder / PEOPLE).exists():
        wrong += _people_trouble(people.folder / PEOPLE)
    wrong += [
        sentence("line {place} of the audit trail is not as it was written", place=one.number)
        for one in entries(people.folder)
        if not one.right
    ]
    return StoreCheck(len(every), {str(name): count for name, count in verdicts.items()}, (*wrong,))


def check_backup(
    source: Path, progress: Progress | None = None, passphrase: str = ""
) -> StoreCheck:
    """Read every file of a backup, and hold it against the backup's own list.

    Args:
        source: the backup: a file, or a folder of backups, of which the newest is read.
        progress: reports, and may cancel.
        passphrase: of an encrypted backup.

    Raises:
        ArchiveError: if it is no backup, cut, of a newer version, encrypted otherwise, or cannot
            be read.
        Cancelled: if that was asked for.
    """
    progress, wrong, count = progress or Progress(), [], 0
    try:
        with opened_backup(source, passphrase) as archive:
            manifest = read_manifest(archive, source)
            for number, (name, digest) in enumerate(manifest.files.items()):
                progress.report(number / len(manifest.files), name.rpartition("/")[2])
                count += name.endswith(SUFFIX)
                try:
                    with archive.open(name) as stream:
                        sha = hashlib.sha256()
                        while block := stream.read(1 << 20):
                            sha.update(block)
                    if sha.hexdigest() != digest:
                        wrong.append(sentence("{name} is not what was packed", name=name))
                except (zipfile.BadZipFile, zlib.error, EOFError):
                    wrong.append(sentence("{name} is not what was packed", name=name))
                except ValueError as error:
                    wrong.append(sentence("{name}: {reason}", name=name, reason=error))
    except OSError as error:
        why = error.strerror or error
        raise ArchiveError(
            sentence("cannot read {source}: {reason}", source=source, reason=why)
        ) from error
    return StoreCheck(count, {}, tuple(wrong))


def _people_trouble(path: Path) -> list[str]:
    """Return what SQLite finds wrong with a list of people."""
    try:
        with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as source:
            told = [str(row[0]) for row in source.execute("PRAGMA quick_check")]
    except sqlite3.Error as error:
        told = [str(error)]
    if told == ["ok"]:
        return []
    return [
        sentence(
            "the list of people {file} is damaged ({reason}): bring it back with `acus store "
            "restore`",
            file=path,
            reason=told[0],
        )
    ]
