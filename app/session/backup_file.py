"""The file of a backup: a ZIP archive whose list tells the SHA-256 of each file in it."""

from __future__ import annotations

import hashlib
import json
import os
import re
import zipfile
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, Final, Protocol

from app.core.files import step
from app.core.messages import sentence
from app.session.errors import SessionError

FORMAT: Final = "acus-backup"
VERSION: Final = 1
MANIFEST: Final = "manifest.json"

_MEMBER: Final = re.compile(
    r"(records/(\.trash/)?[0-9A-Za-z][0-9A-Za-z._-]{0,63}\.(mcap|sig)"
    r"|people/(people\.sqlite|names\.json|courses/[a-z0-9-]+\.yaml)"
    r"|exercises/(profiles/)?[\w@][\w@.-]*"
    r"|structures/([\w-][\w.-]*/){0,3}[\w-][\w.-]*"
    r"|cts/[0-9a-f]{16}/[0-9]{6}"
    r"|research/[a-z0-9-]+/(design\.yaml|exercise-[0-9]+\.yaml|allocation\.json|ledger\.sqlite))"
)
LARGEST_MANIFEST: Final = 1 << 26


class ArchiveError(SessionError):
    """A backup that cannot be written or read; says what to do."""


class Packed(Protocol):
    """What a backup is read from: a `zipfile.ZipFile`, or pieces in a folder."""

    def open(self, name: str, /) -> IO[bytes]:
        """Open a file of it to read."""

    def read(self, name: str, /) -> bytes:
        """Return a file of it whole."""

    def getinfo(self, name: str, /) -> Any:
        """Return how large a file is, as `file_size`."""

    def namelist(self) -> list[str]:
        """Return the names of its files."""


@dataclass(frozen=True)
class Manifest:
    """What a backup says of itself.

    Attributes:
        files: SHA-256 of each file in it, by name.
        key: the station's key under the recovery key; empty without one.
        station: id of the station that wrote it; empty where it does not say.
        left_out: what is not in it, one line each.
    """

    files: Mapping[str, str]
    key: Mapping[str, str]
    station: str
    left_out: tuple[str, ...] = ()


@contextmanager
def reading_backup(source: Path) -> Iterator[None]:
    """Name a backup in whatever is wrong with its archive.

    Raises:
        ArchiveError: if it is none, cut, or packed as no backup is.
    """
    try:
        yield
    except (zipfile.BadZipFile, EOFError, NotImplementedError, RuntimeError) as error:
        raise ArchiveError(
            sentence(
                "{source} is no backup of Acus, or damaged: {error}", source=source, error=error
            )
        ) from error


def may_hold(name: str) -> bool:
    """Return whether a backup may hold a file of this name."""
    return _MEMBER.fullmatch(name) is not None


def read_manifest(archive: Packed, source: Path) -> Manifest:
    """Read and check the list of what a backup holds.

    Raises:
        ArchiveError: if it is none, damaged, of a newer version, or would write elsewhere.
    """
    try:
        if archive.getinfo(MANIFEST).file_size > LARGEST_MANIFEST:
            raise ValueError(sentence("its list is too long"))
        document: dict[str, Any] = json.loads(archive.read(MANIFEST))
        kind, version = document["format"], document["version"]
        files, known = dict(document["files"]), set(archive.namelist())
        key = {str(name): str(value) for name, value in dict(document["key"]).items()}
        station = str(document.get("station") or key.get("station", ""))
        left_out = tuple(map(str, document.get("left_out", ())))
    except (KeyError, ValueError, TypeError, RecursionError) as error:
        raise ArchiveError(
            sentence("{source} is no backup of Acus: {error}", source=source, error=error)
        ) from error
    if kind != FORMAT or not isinstance(version, int):
        raise ArchiveError(
            sentence(
                "{source} is no backup of Acus: its format is {kind!r}", source=source, kind=kind
            )
        )
    if version > VERSION:
        raise ArchiveError(
            sentence(
                "{source} was written by a newer version of Acus: use that version", source=source
            )
        )
    odd = [name for name in files if not _MEMBER.fullmatch(str(name)) or name not in known]
    if odd:
        raise ArchiveError(
            sentence(
                "{source} is damaged: {odd_name!r} is missing in it or no name of Acus",
                source=source,
                odd_name=odd[0],
            )
        )
    return Manifest(files, key, station, left_out)


def unpack(
    archive: Packed,
    name: str,
    digest: str,
    target: Path,
    source: Path,
    durable: bool = True,
) -> None:
    """Unpack one file, and look whether it is what was packed.

    Args:
        archive: the backup, open.
        name: of the file in it.
        digest: its SHA-256.
        target: where it goes.
        source: path of the backup, for messages.
        durable: wait until it stands on the disk; else whoever asked waits for all files at once.

    Raises:
        ArchiveError: if it is not.
        OSError: if it cannot be written.
    """
    target.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    step("unpack", target)
    sha = hashlib.sha256()
    try:
        with archive.open(name) as packed, target.open("xb") as stream:
            while block := packed.read(1 << 20):
                sha.update(block)
                stream.write(block)
            stream.flush()
            if durable:
                os.fsync(stream.fileno())
    except (zlib.error, ValueError, zipfile.BadZipFile) as error:
        raise ArchiveError(
            sentence(
                "{source} is damaged at {name}: {error}", source=source, name=name, error=error
            )
        ) from error
    if sha.hexdigest() != digest:
        raise ArchiveError(
            sentence("{source} is damaged: {name} is not what was packed", source=source, name=name)
        )
