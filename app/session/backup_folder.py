"""A folder of backups: what is in several of them lies there once.

Files are cut into pieces of 16 MiB at most; each lies in `objects` under its SHA-256, and a list,
`<time>.acusbackup`, tells of each file its pieces. What was there at the last backup is not written
again. Pieces are written first and the list at last, each whole or not at all: a backup that was
cut off leaves no list, and the next one finds its pieces.

Encrypted, a piece lies under a keyed digest, so that nobody sees which file it is. Key of the
folder: 32 random bytes, in each list under what scrypt (RFC 7914) makes of the passphrase; HKDF
(RFC 5869) makes one key for pieces, one for their names and one for lists of it. Pieces and lists
are AES-256-GCM (NIST SP 800-38D) with a nonce of 96 random bits and their name as associated data.
"""

from __future__ import annotations

import hashlib
import hmac
import io
import json
import secrets
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace
from typing import Any, BinaryIO, Final

from app.core.files import read_at_most, write_atomically
from app.core.messages import sentence
from app.session.backup_file import LARGEST_MANIFEST, MANIFEST, ArchiveError, reading_backup

FORMAT: Final = "acus-backup-list"
VERSION: Final = 1
SUFFIX: Final = ".acusbackup"
OBJECTS: Final = "objects"

_PIECE: Final = 1 << 24
_NONCE: Final = 12
_SCRYPT: Final = {"n": 1 << 15, "r": 8, "p": 1}
"""32 MB and some 0.1 s for each passphrase that is tried."""


@dataclass(frozen=True)
class FolderKey:
    """The key of a folder of encrypted backups.

    Attributes:
        secret: 32 bytes.
        wrapped: it, under the passphrase: a document that stands in each list.
    """

    secret: bytes
    wrapped: Mapping[str, str]

    @classmethod
    def drawn(cls, passphrase: str) -> FolderKey:
        """Draw a key, and wrap it with a passphrase."""
        from cryptography.hazmat.primitives.ciphers.aead import AESGCM

        secret, salt, nonce = (secrets.token_bytes(n) for n in (32, 16, _NONCE))
        sealed = AESGCM(_stretched(passphrase, salt)).encrypt(nonce, secret, b"acus backups")
        parts = {"salt": salt.hex(), "nonce": nonce.hex(), "sealed": sealed.hex()}
        return cls(secret, parts)

    @classmethod
    def opened(cls, wrapped: Mapping[str, str], passphrase: str, source: Path) -> FolderKey:
        """Unwrap a key.

        Raises:
            ArchiveError: for another passphrase, or a damaged document.
        """
        from cryptography.exceptions import InvalidTag
        from cryptography.hazmat.primitives.ciphers.aead import AESGCM

        try:
            salt, nonce, sealed = (bytes.fromhex(wrapped[n]) for n in ("salt", "nonce", "sealed"))
            key = _stretched(passphrase, salt)
            return cls(AESGCM(key).decrypt(nonce, sealed, b"acus backups"), wrapped)
        except InvalidTag as error:
            raise ArchiveError(
                sentence(
                    "{source} is encrypted, and that is not its passphrase: type it again",
                    source=source,
                )
            ) from error
        except (ValueError, LookupError, TypeError) as error:
            raise _damaged(source, error) from error

    def derived(self, purpose: str) -> bytes:
        """Return a key for one purpose."""
        from cryptography.hazmat.primitives.hashes import SHA256
        from cryptography.hazmat.primitives.kdf.hkdf import HKDF

        return HKDF(SHA256(), 32, None, f"acus backups: {purpose}".encode()).derive(self.secret)

    def sealed(self, purpose: str, data: bytes, name: str) -> bytes:
        """Encrypt something under its name."""
        from cryptography.hazmat.primitives.ciphers.aead import AESGCM

        nonce = secrets.token_bytes(_NONCE)
        return nonce + AESGCM(self.derived(purpose)).encrypt(nonce, data, name.encode())

    def unsealed(self, purpose: str, data: bytes, name: str) -> bytes:
        """Decrypt what `sealed` gave.

        Raises:
            ValueError: if it is not that.
        """
        from cryptography.exceptions import InvalidTag
        from cryptography.hazmat.primitives.ciphers.aead import AESGCM

        try:
            cipher = AESGCM(self.derived(purpose))
            return cipher.decrypt(data[:_NONCE], data[_NONCE:], name.encode())
        except InvalidTag as error:
            raise ValueError(sentence("it is not what was written")) from error


@dataclass(frozen=True)
class Pieces:
    """The pieces of a folder of backups.

    Attributes:
        folder: of the backups.
        key: of the folder; None where nothing is encrypted.
    """

    folder: Path
    key: FolderKey | None = None

    def put(self, stream: BinaryIO) -> tuple[str, list[str], int]:
        """Keep a file; return its SHA-256, the names of its pieces, and how many bytes were new.

        Raises:
            OSError: if it cannot be read or written.
        """
        whole, names, new = hashlib.sha256(), [], 0
        while data := stream.read(_PIECE):
            whole.update(data)
            name = self._name(data)
            path, length = self._path(name), len(data) + (_NONCE + 16 if self.key else 0)
            if not (path.is_file() and path.stat().st_size == length):
                path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
                write_atomically(path, self.key.sealed("piece", data, name) if self.key else data)
                new += length
            names.append(name)
        return whole.hexdigest(), names, new

    def get(self, name: str) -> bytes:
        """Return a piece.

        Raises:
            ValueError: if it is missing or not what was written; says which file it is.
            OSError: if it cannot be read.
        """
        path = self._path(name)
        try:
            data = read_at_most(path, _PIECE + 64)
            data = self.key.unsealed("piece", data, name) if self.key else data
            right = hmac.compare_digest(self._name(data), name)
        except FileNotFoundError as error:
            raise ValueError(
                sentence("its piece {name} is missing", name=f"{OBJECTS}/{name[:2]}/{name}")
            ) from error
        except ValueError:
            right = False
        if not right:
            raise ValueError(
                sentence(
                    "its piece {name} is not what was written: delete it, and back up again while "
                    "the file is still here",
                    name=f"{OBJECTS}/{name[:2]}/{name}",
                )
            )
        return data

    def _name(self, data: bytes) -> str:
        digest = hashlib.sha256(data).digest()
        if self.key is None:
            return digest.hex()
        return hmac.digest(self.key.derived("name"), digest, "sha256").hex()

    def _path(self, name: str) -> Path:
        return self.folder / OBJECTS / name[:2] / name


@dataclass(frozen=True)
class FolderBackup:
    """One backup of a folder, read as an archive of files (`zipfile.ZipFile`).

    Attributes:
        pieces: of the folder.
        document: what the backup says of itself.
    """

    pieces: Pieces
    document: Mapping[str, Any]

    @classmethod
    def opened(cls, source: Path, passphrase: str = "") -> FolderBackup:
        """Read the list of a backup.

        Args:
            source: its file.
            passphrase: of an encrypted one.

        Raises:
            ArchiveError: if it is none, damaged, of a newer version, or encrypted otherwise.
            OSError: if it cannot be read.
        """
        envelope = _envelope(source)
        try:
            key, body = None, str(envelope["body"]).encode()
            if envelope["key"]:
                if not passphrase:
                    raise ArchiveError(
                        sentence("{source} is encrypted: give its passphrase", source=source)
                    )
                key = FolderKey.opened(envelope["key"], passphrase, source)
                body = key.unsealed("list", bytes.fromhex(envelope["body"]), FORMAT)
            elif hashlib.sha256(body).hexdigest() != envelope["sha256"]:
                raise ValueError(sentence("it is not what was written"))
            document = json.loads(body)
            for name, names in dict(document["pieces"]).items():
                if not all(len(one) == 64 and one.isalnum() for one in names):
                    raise ValueError(sentence("{name} has a piece without a name", name=name))
        except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
            raise _damaged(source, error) from error
        return cls(Pieces(source.parent, key), document)

    def open(self, name: str) -> BinaryIO:
        """Open a file of the backup to read; damage is a ValueError while it is read."""
        return io.BufferedReader(_Stream(self._pieces_of(name)), 1 << 20)

    def read(self, name: str) -> bytes:
        """Return a file of the backup whole; the manifest too."""
        if name == MANIFEST:
            return json.dumps(self.document).encode()
        return b"".join(self._pieces_of(name))

    def getinfo(self, name: str) -> SimpleNamespace:
        """Return how large the manifest is."""
        return SimpleNamespace(file_size=len(self.read(name)))

    def namelist(self) -> list[str]:
        """Return the names of all files."""
        return list(self.document["pieces"])

    def __enter__(self) -> FolderBackup:
        return self

    def __exit__(self, *_: object) -> None:
        return

    def _pieces_of(self, name: str) -> Iterator[bytes]:
        return (self.pieces.get(one) for one in self.document["pieces"][name])


class _Stream(io.RawIOBase):
    """Pieces one after the other, as a stream."""

    def __init__(self, pieces: Iterator[bytes]) -> None:
        self._pieces, self._rest = pieces, memoryview(b"")

    def readable(self) -> bool:
        return True

    def readinto(self, target: Any) -> int:
        if not self._rest:
            self._rest = memoryview(next(self._pieces, b""))
        count = min(len(target), len(self._rest))
        target[:count], self._rest = self._rest[:count], self._rest[count:]
        return count


def backups_of(folder: Path) -> list[Path]:
    """Return the lists of a folder of backups, oldest first; not files that hold all of one."""
    return sorted(path for path in folder.glob(f"*{SUFFIX}") if path.is_file() and is_list(path))


@contextmanager
def opened_backup(source: Path, passphrase: str = "") -> Iterator[zipfile.ZipFile | FolderBackup]:
    """Open a backup: a file that holds all of it, a list, or the newest list of a folder.

    Args:
        source: the backup.
        passphrase: of an encrypted one.

    Raises:
        ArchiveError: if it is none, cut, damaged, of a newer version, or encrypted otherwise.
        OSError: if it cannot be read.
    """
    source = newest(source)
    with reading_backup(source):
        if is_list(source):
            yield FolderBackup.opened(source, passphrase)
        else:
            with zipfile.ZipFile(source) as archive:
                yield archive


def newest(source: Path) -> Path:
    """Return the newest backup of a folder; a file is itself.

    Raises:
        ArchiveError: if the folder holds none, or its newest list is damaged; names the one before.
    """
    if not source.is_dir():
        return source
    found = backups_of(source)
    if not found:
        raise ArchiveError(
            sentence(
                "{folder} holds no backup ({suffix}): give the folder that `acus store backup` was "
                "given",
                folder=source,
                suffix=SUFFIX,
            )
        )
    try:
        _envelope(found[-1])
    except ArchiveError as error:
        if len(found) == 1:
            raise
        raise ArchiveError(
            sentence(
                "{fault}; the backup before it is {earlier}",
                fault=str(error),
                earlier=found[-2],
            )
        ) from error
    return found[-1]


def is_list(source: Path) -> bool:
    """Return whether a file is the list of a backup in a folder, by its first bytes."""
    with source.open("rb") as stream:
        return stream.read(1) == b"{"


def is_encrypted(source: Path) -> bool:
    """Return whether a backup asks for a passphrase; False for what is none, or cannot be read."""
    try:
        if source.is_dir():
            return bool(_newest_key(backups_of(source)))
        return is_list(source) and bool(_envelope(source)["key"])
    except (OSError, ArchiveError, LookupError):
        return False


def pieces_for(folder: Path, passphrase: str) -> Pieces:
    """Return where the next backup of a folder goes: with the key of those that are there.

    Raises:
        ArchiveError: for another passphrase than theirs, none where they are encrypted, one where
            they are not, or where none of them can be read.
        OSError: if they cannot be read.
    """
    before = backups_of(folder)
    wrapped = _newest_key(before)
    if before and bool(wrapped) != bool(passphrase):
        raise ArchiveError(
            sentence("the backups in {folder} are encrypted: give their passphrase", folder=folder)
            if wrapped
            else sentence(
                "the backups in {folder} are not encrypted: choose another folder for encrypted "
                "ones",
                folder=folder,
            )
        )
    if not passphrase:
        return Pieces(folder)
    key = FolderKey.opened(wrapped, passphrase, folder) if wrapped else FolderKey.drawn(passphrase)
    return Pieces(folder, key)


def _newest_key(lists: list[Path]) -> dict[str, str] | None:
    """Return the key of the newest list that can be read: a damaged one ends no later backups."""
    trouble: ArchiveError | None = None
    for path in reversed(lists):
        try:
            key: dict[str, str] | None = _envelope(path)["key"]
            return key
        except ArchiveError as error:
            trouble = trouble or error
        except LookupError as error:
            trouble = trouble or _damaged(path, error)
    if trouble is not None:
        raise trouble
    return None


def write_list(pieces: Pieces, document: Mapping[str, Any]) -> Path:
    """Write the list of a backup whose pieces are there; return its file.

    Raises:
        OSError: if it cannot be written.
    """
    now = datetime.now(UTC).strftime("%Y-%m-%dT%H-%M-%S-%f")
    path, body = pieces.folder / f"{now}{SUFFIX}", json.dumps(document)
    envelope: dict[str, Any] = {"format": FORMAT, "version": VERSION, "key": None}
    if pieces.key is not None:
        sealed = pieces.key.sealed("list", body.encode(), FORMAT)
        envelope |= {"key": dict(pieces.key.wrapped), "body": sealed.hex()}
    else:
        envelope |= {"sha256": hashlib.sha256(body.encode()).hexdigest(), "body": body}
    write_atomically(path, json.dumps(envelope))
    path.chmod(0o600)
    return path


def _envelope(source: Path) -> dict[str, Any]:
    try:
        document: dict[str, Any] = json.loads(read_at_most(source, 3 * LARGEST_MANIFEST))
        kind, version = document["format"], document["version"]
        if kind != FORMAT or not isinstance(version, int):
            raise ValueError(sentence("its format is {kind!r}", kind=kind))
    except (ValueError, LookupError, TypeError, RecursionError) as error:
        raise _damaged(source, error) from error
    if version > VERSION:
        raise ArchiveError(
            sentence(
                "{source} was written by a newer version of Acus: use that version", source=source
            )
        )
    return document


def _stretched(passphrase: str, salt: bytes) -> bytes:
    from cryptography.hazmat.primitives.kdf.scrypt import Scrypt

    return Scrypt(salt, 32, **_SCRYPT).derive(passphrase.encode())


def _damaged(source: Path, error: Exception) -> ArchiveError:
    own = type(error) is ValueError  # what Python says of JSON and its parts helps nobody
    fault = str(error) if own else sentence("it is not whole")
    return ArchiveError(
        sentence(
            "{source} is no backup of Acus, or damaged: {fault}; give another one",
            source=source,
            fault=fault,
        )
    )
