"""The key of this installation: pseudonyms, UIDs and dates are derived with it, and only with it.

Without the key nobody can tell by trying identifiers whose pseudonym one is (a plain digest of an
eight-digit number is guessed in a second); with it the same patient gets the same pseudonym at
every import.
"""

import contextlib
import hashlib
import hmac
import os
from functools import lru_cache
from pathlib import Path

from app.core import paths
from app.core.files import BINARY
from app.core.messages import sentence
from app.imaging.privacy.errors import KeyDamagedError

BYTES = 32


def key_path() -> Path:
    """File of the key, readable by its owner only."""
    return paths.settings() / "privacy.key"


def installation_key() -> bytes:
    """Key of this installation, 32 bytes; made at the first call.

    Raises:
        KeyDamagedError: if it cannot be read or made, or is not a key.
    """
    path = key_path()
    try:
        if not path.exists():
            _make(path)
        known = path.stat()
        key = _read(path, known.st_mtime_ns, known.st_ino)
    except OSError as error:
        raise KeyDamagedError(
            sentence(
                "the privacy key {path} cannot be read or made: {error_strerror}; "
                "pseudonyms need it: make the folder writable",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    if len(key) != BYTES:
        raise KeyDamagedError(
            sentence(
                "the privacy key {path} has {stored_bytes} bytes, {needed_bytes} are needed; put "
                "the kept copy back, or delete it: then every patient gets a new pseudonym",
                path=path,
                stored_bytes=len(key),
                needed_bytes=BYTES,
            )
        )
    return key


@lru_cache(maxsize=1)
def _read(path: Path, changed_ns: int, number: int) -> bytes:
    """Read the key; kept as long as the file is the same one: it is asked for at every header."""
    return path.read_bytes()


def _make(path: Path) -> None:
    """Write beside and link: of two processes at once the second takes the first one's key."""
    import secrets

    path.parent.mkdir(parents=True, exist_ok=True)
    beside = path.with_name(f".{path.name}.{secrets.token_hex(16)}")
    try:
        flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | BINARY
        with os.fdopen(os.open(beside, flags, 0o600), "wb") as file:
            file.write(secrets.token_bytes(BYTES))
            file.flush()
            os.fsync(file.fileno())
        with contextlib.suppress(FileExistsError):
            os.link(beside, path)
    finally:
        beside.unlink(missing_ok=True)


def derived(key: bytes, purpose: str, *parts: str) -> bytes:
    """HMAC-SHA256 (RFC 2104) of a purpose and what it is about, 32 bytes."""
    message = "\0".join((purpose, *parts)).encode()
    return hmac.new(key, message, hashlib.sha256).digest()
