"""Looking through everything a station keeps, or a backup of it, without changing anything.

Every record is read whole and held against its signature, every file of a backup against its list.
"""

from __future__ import annotations

import hashlib
import sqlite3
import zipfile
import zlib
from collections import Counter
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from app.core.messages import sentence
from app.core.progress import Progress
from app.session.audit import entries
from app.session.backup_file import ArchiveError, read_manifest
from app.session.header import TRASH
from app.session.people import PEOPLE, People
from app.session.sidecar import file_digest
from app.session.signature import Signed, read_signature
from app.session.station import StationKey
from app.session.store import SUFFIX, records


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


def check_backup(source: Path, progress: Progress | None = None) -> StoreCheck:
    """Read every file of a backup, and hold it against the backup's own list.

    Args:
        source: the backup.
        progress: reports, and may cancel.

    Raises:
        ArchiveError: if it is no backup, cut, of a newer version, or cannot be read.
        Cancelled: if that was asked for.
    """
    progress, wrong, count = progress or Progress(), [], 0
    try:
        with zipfile.ZipFile(source) as archive:
            manifest = read_manifest(archive, source)
            for number, (name, digest) in enumerate(manifest.files.items()):
                progress.report(number / len(manifest.files), name.rpartition("/")[2])
                count += name.endswith(SUFFIX)
                try:
                    with archive.open(name) as stream:
                        sha = hashlib.sha256()
                        while block := stream.read(1 << 20):
                            sha.update(block)
                    right = sha.hexdigest() == digest
                except (zipfile.BadZipFile, zlib.error, EOFError):
                    right = False
                if not right:
                    wrong.append(sentence("{name} is not what was packed", name=name))
    except (zipfile.BadZipFile, EOFError, NotImplementedError, RuntimeError) as error:
        raise ArchiveError(
            sentence(
                "{source} is no backup of Acus, or damaged: {error}", source=source, error=error
            )
        ) from error
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
