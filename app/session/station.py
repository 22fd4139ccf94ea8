"""The key of this station: drawn once, kept for its owner, and wrapped to travel in a backup.

Of its secret an Ed25519 key pair (RFC 8032) is derived: what the station signs with it anybody can
verify who has the public half. A renewed key keeps the secrets before it, so that what they sealed
and signed stays verified.
"""

from __future__ import annotations

import base64
import hashlib
import hmac
import json
import os
import secrets
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from app.core import paths
from app.core.errors import writing
from app.core.files import BINARY, step, write_atomically
from app.core.files import beside as new_name_beside
from app.core.messages import sentence
from app.session.errors import SessionError

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

_RECOVERY_BYTES: Final = 20
_NONCE_BYTES: Final = 12
_SCRYPT: Final[dict[str, int]] = {"n": 2**14, "r": 8, "p": 1, "dklen": 32}


class SignatureError(SessionError):
    """The station's key cannot be read or written, or a recovery key is not the right one."""


@dataclass(frozen=True, slots=True)
class StationKey:
    """The key that this station signs with.

    Attributes:
        station: random id of the station; not secret.
        secret: 32 random bytes.
        former: secrets before this one, newest first: what they sealed still holds.
    """

    station: str
    secret: bytes = field(repr=False)
    former: tuple[bytes, ...] = field(default=(), repr=False)

    @classmethod
    def of(cls, folder: Path | None = None) -> StationKey:
        """Read the key of this station; the first time it is drawn, and written with mode 0600.

        Raises:
            SignatureError: if it cannot be read or written.
        """
        path = key_file(folder)
        try:
            if not path.exists():
                _draw(path)
            document = json.loads(path.read_text(encoding="ascii"))
            former = tuple(bytes.fromhex(text) for text in document.get("former", ()))
            return cls(str(document["station"]), bytes.fromhex(document["secret"]), former)
        except OSError as error:
            raise SignatureError(
                sentence(
                    "the station's key {path} cannot be used: {error_strerror}; attempts "
                    "stay unsigned until it can be read",
                    path=path,
                    error_strerror=error.strerror or error,
                )
            ) from error
        except (ValueError, LookupError, TypeError) as error:
            raise SignatureError(
                sentence(
                    "the station's key {path} is damaged: bring it back with `acus store "
                    "restore` and the recovery key, or move it away for a new one",
                    path=path,
                )
            ) from error

    def seal(self, document: Mapping[str, Any]) -> str:
        """HMAC of a document, hexadecimal."""
        return hmac.digest(self.secret, _text(document), "sha256").hex()

    def has_sealed(self, document: Mapping[str, Any], seal: str) -> bool:
        """Return whether a seal of a document is this station's, by this secret or one before."""
        text, given = _text(document), seal.encode()
        seals = (hmac.digest(one, text, "sha256").hex() for one in (self.secret, *self.former))
        return (
            sum(hmac.compare_digest(given, one.encode()) for one in seals) > 0
        )  # none is passed over

    @property
    def public(self) -> str:
        """Public half of the key pair, hexadecimal; not secret."""
        return _public(self.secret)

    @property
    def publics(self) -> tuple[str, ...]:
        """Public halves of this key and of those before it, newest first."""
        return tuple(map(_public, (self.secret, *self.former)))

    def sign(self, purpose: str, document: Mapping[str, Any]) -> str:
        """Sign a document (Ed25519), hexadecimal: for one purpose, and no other."""
        return _private(self.secret).sign(_message(purpose, document)).hex()

    def succession(self) -> list[dict[str, str]]:
        """Return who followed whom among the public keys, newest first, signed by the one before.

        Whoever knows one of them knows those after it.
        """
        secrets_, rows = (self.secret, *self.former), []
        for new, old in pairwise(secrets_):
            row = {"station": self.station, "public": _public(new), "before": _public(old)}
            signature = _private(old).sign(_message("succession", row)).hex()
            rows.append(row | {"signature": signature})
        return rows

    def renewed(self) -> StationKey:
        """Return a key of the same station with a new secret, which keeps those before it."""
        return StationKey(self.station, secrets.token_bytes(32), (self.secret, *self.former))

    def derived(self, purpose: str) -> bytes:
        """Return a key for one purpose: what it seals is no seal of anything else."""
        return hmac.digest(self.secret, b"acus " + purpose.encode(), "sha256")

    def wrapped(self, recovery: str) -> dict[str, str]:
        """Encrypt the key with a recovery key: a document that may travel.

        AES-256-GCM (NIST SP 800-38D) under what scrypt (RFC 7914) makes of the recovery key and a
        salt, with a nonce of 96 random bits and the station's id as associated data. Salt and nonce
        are drawn anew each time, so that no key ever meets a nonce twice.

        Raises:
            SignatureError: if that is no recovery key.
        """
        from cryptography.hazmat.primitives.ciphers.aead import AESGCM

        salt, nonce = secrets.token_bytes(16), secrets.token_bytes(_NONCE_BYTES)
        cipher = AESGCM(_stretched(recovery, salt))
        every = b"".join((self.secret, *self.former))
        sealed = cipher.encrypt(nonce, every, _context(self.station))
        parts = {"salt": salt.hex(), "nonce": nonce.hex(), "sealed": sealed.hex()}
        return {"station": self.station, **parts}

    @classmethod
    def unwrapped(cls, document: Mapping[str, str], recovery: str) -> StationKey:
        """Decrypt what `wrapped` gave.

        Raises:
            SignatureError: for another recovery key, a damaged document, or one of an earlier
                build.
        """
        from cryptography.exceptions import InvalidTag
        from cryptography.hazmat.primitives.ciphers.aead import AESGCM

        if document and not opens(document):
            raise SignatureError(
                sentence(
                    "the station's key in this backup was sealed by an earlier build, in a form "
                    "that is no longer read: change the password where it was made (`acus people "
                    "instructor`), which prints a new recovery key, and make the backup again; "
                    "or restore it without `--key`, and admit its attempts"
                )
            )
        try:
            station, salt = str(document["station"]), bytes.fromhex(document["salt"])
            nonce, sealed = bytes.fromhex(document["nonce"]), bytes.fromhex(document["sealed"])
            if len(nonce) != _NONCE_BYTES:
                raise ValueError(sentence("a nonce of {nonce_bytes} bytes", nonce_bytes=len(nonce)))
        except (ValueError, LookupError, TypeError) as error:
            raise SignatureError(sentence("the station's key in this backup is damaged")) from error
        try:
            every = AESGCM(_stretched(recovery, salt)).decrypt(nonce, sealed, _context(station))
        except InvalidTag as error:
            raise SignatureError(
                sentence("that is not the recovery key that was printed: type it again")
            ) from error
        first, *former = (every[at : at + 32] for at in range(0, len(every), 32))
        return cls(station, first, tuple(former))

    def document(self) -> dict[str, Any]:
        """Return what stands in the key's file."""
        document = {"station": self.station, "secret": self.secret.hex()}
        return document | ({"former": [one.hex() for one in self.former]} if self.former else {})

    def keep(self, folder: Path | None = None) -> None:
        """Make it the key of this station.

        Raises:
            SignatureError: if it cannot be written.
        """
        path = key_file(folder)
        with writing(path, SignatureError):
            write_atomically(path, json.dumps(self.document()) + "\n")
            path.chmod(0o600)


def signature_holds(public: str, purpose: str, document: Mapping[str, Any], signature: str) -> bool:
    """Return whether a document was signed for a purpose by the other half of a public key.

    Args:
        public: key, hexadecimal; one that is none has signed nothing.
        purpose: of the signature.
        document: that was signed.
        signature: hexadecimal.
    """
    from cryptography.exceptions import InvalidSignature
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey

    try:
        key = Ed25519PublicKey.from_public_bytes(bytes.fromhex(public))
        key.verify(bytes.fromhex(signature), _message(purpose, document))
    except (InvalidSignature, ValueError, TypeError, RecursionError):
        return False
    return True


def opens(document: Mapping[str, str]) -> bool:
    """Return whether a wrapped key is in the form that `StationKey.unwrapped` reads.

    Builds from before the first release wrote another one, without a nonce.
    """
    return "nonce" in document


def key_file(folder: Path | None = None) -> Path:
    """Return the file of the station's key; `folder` is that of people, the user's by default."""
    return (folder or paths.data() / "people") / "station.key"


def new_recovery_key() -> str:
    """Draw a key of 160 bits to print and lock away, in eight groups of four letters and digits."""
    text = base64.b32encode(secrets.token_bytes(_RECOVERY_BYTES)).decode()
    return "-".join(text[i : i + 4] for i in range(0, len(text), 4))


def this_station() -> StationKey | None:
    """Return the key for lists, which go on without one: then everything is unsigned."""
    path = key_file()
    try:
        stat = path.stat()
        return _read_key(path.parent, stat.st_mtime_ns, stat.st_size, stat.st_ino)
    except (OSError, SignatureError):
        return None


@lru_cache(maxsize=4)
def _read_key(folder: Path, *_: int) -> StationKey:
    """Read the key once for each state of its file: lists ask for it at every record."""
    return StationKey.of(folder)


def seals_here() -> bool:
    """Return whether this station has a key: attempts count here only if it has sealed or admitted
    them.

    One that cannot be read counts as well: without it nothing is verified.
    """
    return key_file().exists()


def _draw(path: Path) -> None:
    """Write a new key whole under its name, unless another program was faster."""
    document = {"station": secrets.token_hex(8), "secret": secrets.token_hex(32)}
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    beside = new_name_beside(path)
    try:
        step("write", beside)
        handle = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL | BINARY, 0o600)
        with os.fdopen(handle, "w") as stream:
            stream.write(json.dumps(document) + "\n")
            stream.flush()
            os.fsync(stream.fileno())
        with suppress(FileExistsError):
            os.link(beside, path)  # never replaces a key that is there
    finally:
        beside.unlink(missing_ok=True)


def _text(document: Mapping[str, Any]) -> bytes:
    """Return the one text that a document is sealed and signed as."""
    text = json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
    return text.encode()


def _message(purpose: str, document: Mapping[str, Any]) -> bytes:
    return b"acus " + purpose.encode() + b"\0" + _text(document)


@lru_cache(maxsize=64)
def _private(secret: bytes) -> Ed25519PrivateKey:
    """Return the private half of the pair that a secret stands for."""
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

    seed = hmac.digest(secret, b"acus ed25519", "sha256")
    return Ed25519PrivateKey.from_private_bytes(seed)


@lru_cache(maxsize=64)
def _public(secret: bytes) -> str:
    return _private(secret).public_key().public_bytes_raw().hex()


def _context(station: str) -> bytes:
    """Return what a wrapped key is bound to: to being one, and to its station."""
    return b"acus station key\0" + station.encode("utf-8", "surrogatepass")


def _stretched(recovery: str, salt: bytes) -> bytes:
    """Return the key of 256 bits that a recovery key stands for with this salt."""
    letters = "".join(c for c in recovery.upper() if c.isalnum())
    swapped = letters.translate(str.maketrans("018", "OIB"))  # digits that base 32 does not have
    try:
        raw = base64.b32decode(swapped)
    except ValueError as error:
        raise SignatureError(_NO_RECOVERY_KEY) from error
    if len(raw) != _RECOVERY_BYTES:
        raise SignatureError(_NO_RECOVERY_KEY)
    return hashlib.scrypt(raw, salt=salt, **_SCRYPT)


_NO_RECOVERY_KEY: Final = sentence(
    "a recovery key has eight groups of four letters and digits: type it again"
)
