"""Signs finished attempts with the station's key, and tells what a signature says of a record.

Beside a record stands `<id>.sig`: digests of the record, of its score and of its exercise, what
lists show of them, and an HMAC-SHA256 (RFC 2104) over all that with the key of this station.
*verified* means: written by this station and unchanged since. It does not mean that the owner of
the disk could not forge it, for whoever reads the key can sign. *unsigned* is a record without a
signature, as all of earlier versions are, or with that of another station.
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
from dataclasses import dataclass, field, replace
from enum import StrEnum
from pathlib import Path
from typing import Any, Final

from app.core import paths
from app.core.files import write_atomically
from app.session.conditions import EXERCISE_FILE
from app.session.errors import SessionError
from app.session.recording import open_recording
from app.session.sidecar import Cached, file_digest
from app.session.summary import Summary
from app.session.verify import SCORE_FILE

_VERSION: Final = 1
_RECOVERY_BYTES: Final = 20
_SCRYPT: Final[dict[str, int]] = {"n": 2**14, "r": 8, "p": 1, "dklen": 64}


class SignatureError(SessionError):
    """The station's key cannot be read or written, or a recovery key is not the right one."""


class Signed(StrEnum):
    """What a signature says of a record."""

    VERIFIED = "verified"
    ALTERED = "altered"
    UNSIGNED = "unsigned"


@dataclass(frozen=True, slots=True)
class SignatureCheck:
    """A verdict with its reason.

    Attributes:
        verdict: of the signature.
        why: what was altered, or why it counts as unsigned; empty if it is verified.
    """

    verdict: Signed
    why: str = ""

    def sentence(self) -> str:
        """Say it in one line."""
        return f"{self.verdict.value}: {self.why}" if self.why else self.verdict.value


@dataclass(frozen=True, slots=True)
class StationKey:
    """The key that this station signs with.

    Attributes:
        station: random id of the station; not secret.
        secret: 32 random bytes.
    """

    station: str
    secret: bytes = field(repr=False)

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
            return cls(str(document["station"]), bytes.fromhex(document["secret"]))
        except OSError as error:
            raise SignatureError(
                f"the station's key {path} cannot be used: {error.strerror or error}; attempts "
                "stay unsigned until it can be read"
            ) from error
        except (ValueError, LookupError, TypeError) as error:
            raise SignatureError(
                f"the station's key {path} is damaged: bring it back with `acus store restore` "
                "and the recovery key, or move it away for a new one"
            ) from error

    def seal(self, document: Mapping[str, Any]) -> str:
        """HMAC of a document, hexadecimal."""
        text = json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=True)
        return hmac.new(self.secret, text.encode(), hashlib.sha256).hexdigest()

    def wrapped(self, recovery: str) -> dict[str, str]:
        """Encrypt the key with a recovery key: a document that may travel.

        The 64 bytes that scrypt (RFC 7914) makes of the recovery key and a fresh salt are a
        one-time pad for the secret and the key of a MAC over it.

        Raises:
            SignatureError: if that is no recovery key.
        """
        salt = secrets.token_bytes(16)
        pad, key = _stretched(recovery, salt)
        body = bytes(a ^ b for a, b in zip(self.secret, pad, strict=True))
        tag = hmac.new(key, salt + body + self.station.encode(), hashlib.sha256).hexdigest()
        return {"station": self.station, "salt": salt.hex(), "secret": body.hex(), "tag": tag}

    @classmethod
    def unwrapped(cls, document: Mapping[str, str], recovery: str) -> StationKey:
        """Decrypt what `wrapped` gave.

        Raises:
            SignatureError: for another recovery key, or a damaged document.
        """
        try:
            station, salt = str(document["station"]), bytes.fromhex(document["salt"])
            body, tag = bytes.fromhex(document["secret"]), str(document["tag"])
        except (ValueError, LookupError, TypeError) as error:
            raise SignatureError("the station's key in this backup is damaged") from error
        pad, key = _stretched(recovery, salt)
        right = hmac.new(key, salt + body + station.encode(), hashlib.sha256).hexdigest()
        if not hmac.compare_digest(tag, right):
            raise SignatureError("that is not the recovery key that was printed: type it again")
        return cls(station, bytes(a ^ b for a, b in zip(body, pad, strict=True)))

    def keep(self, folder: Path | None = None) -> None:
        """Make it the key of this station.

        Raises:
            SignatureError: if it cannot be written.
        """
        document = {"station": self.station, "secret": self.secret.hex()}
        path = key_file(folder)
        try:
            write_atomically(path, json.dumps(document) + "\n")
            path.chmod(0o600)
        except OSError as error:
            raise SignatureError(f"cannot write {path}: {error.strerror or error}") from error


def key_file(folder: Path | None = None) -> Path:
    """Return the file of the station's key; `folder` is that of people, the user's by default."""
    return (folder or paths.data() / "people") / "station.key"


def new_recovery_key() -> str:
    """Draw a key of 160 bits to print and lock away, in eight groups of four letters and digits."""
    text = base64.b32encode(secrets.token_bytes(_RECOVERY_BYTES)).decode()
    return "-".join(text[i : i + 4] for i in range(0, len(text), 4))


def signature_file(path: Path) -> Path:
    """Return the file of a record's signature."""
    return path.with_suffix(".sig")


def sign(path: Path, summary: Summary, files: Mapping[str, bytes], key: StationKey) -> None:
    """Sign a finished record that this program has just written.

    Args:
        path: the record.
        summary: what lists show of it.
        files: its attachments by name.
        key: of this station.

    Raises:
        SignatureError: if the record cannot be read or the signature not be written.
    """
    try:
        document = _document(path, file_digest(path), summary, files, key.station)
        text = json.dumps(document | {"hmac": key.seal(document)}, indent=1)
        write_atomically(signature_file(path), text + "\n")
    except OSError as error:
        raise SignatureError(f"{path.name} is not signed: {error.strerror or error}") from error


def judge(path: Path, kept: Cached, key: StationKey | None) -> SignatureCheck:
    """Say for a list what the signature of a record says, from what is kept beside it.

    The record is not read: its digest is that of `kept`, which lists trust as long as the record's
    size and time are what they were. `judge_whole` reads it.
    """
    found = _read(path, key)
    if isinstance(found, SignatureCheck):
        return found
    if found["record"] != kept.sha256:
        return SignatureCheck(Signed.ALTERED, "the record is not the one that was signed")
    shown = _shown(kept.summary)
    other = [name for name, value in found["shown"].items() if shown.get(name) != value]
    if _rules(kept.summary) != found["rules"]:
        other = [name for name in other if name not in ("total", "passed")]  # computed anew
    if other:
        return SignatureCheck(Signed.ALTERED, f"the list shows another {other[0]} than was signed")
    return SignatureCheck(Signed.VERIFIED)


def judge_whole(path: Path, key: StationKey | None) -> SignatureCheck:
    """Say what the signature of a record says, reading the whole record.

    Raises:
        BrokenRecordingError: if it is none.
    """
    found = _read(path, key)
    if isinstance(found, SignatureCheck):
        return found
    if found["record"] == file_digest(path):
        return SignatureCheck(Signed.VERIFIED)
    files = open_recording(path).attachments
    for name, word in ((SCORE_FILE, "score"), (EXERCISE_FILE, "exercise")):
        if _digest(files.get(name)) != found[word]:
            return SignatureCheck(
                Signed.ALTERED, f"the {word} in it is not the one that was signed"
            )
    return SignatureCheck(Signed.ALTERED, "the record is not the one that was signed")


def judged(path: Path, kept: Cached, key: StationKey | None) -> Summary:
    """Return the summary of a record with the verdict of its signature."""
    judgement = judge(path, kept, key)
    problems = kept.summary.problems
    if judgement.verdict is Signed.ALTERED:
        problems = (*problems, f"altered after it was signed: {judgement.why}")
    return replace(kept.summary, signature=judgement.verdict.value, problems=problems)


def this_station() -> StationKey | None:
    """Return the key for lists, which go on without one: then everything is unsigned."""
    try:
        return StationKey.of() if key_file().exists() else None
    except SignatureError:
        return None


def _read(path: Path, key: StationKey | None) -> dict[str, Any] | SignatureCheck:
    """Return the signed document, or what can be said without it."""
    try:
        document: dict[str, Any] = json.loads(signature_file(path).read_text(encoding="ascii"))
        seal = str(document.pop("hmac"))
        station, fields = str(document["station"]), (document["record"], document["shown"].items())
    except FileNotFoundError:
        return SignatureCheck(Signed.UNSIGNED, "no signature stands beside it")
    except OSError as error:
        return SignatureCheck(Signed.UNSIGNED, f"its signature cannot be read: {error.strerror}")
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return SignatureCheck(Signed.ALTERED, "its signature is damaged")
    if key is None or station != key.station:
        return SignatureCheck(Signed.UNSIGNED, f"signed by another station ({station[:16]})")
    with suppress(ValueError, TypeError, RecursionError):
        if fields and hmac.compare_digest(seal.encode(), key.seal(document).encode()):
            if document["id"] == path.stem:
                return document
            return SignatureCheck(
                Signed.ALTERED, "the signature beside it is that of another attempt"
            )
    return SignatureCheck(Signed.ALTERED, "its signature is not this station's")


def _document(
    path: Path, digest: str, summary: Summary, files: Mapping[str, bytes], station: str
) -> dict[str, Any]:
    return {
        "version": _VERSION,
        "station": station,
        "id": path.stem,
        "record": digest,
        "score": _digest(files.get(SCORE_FILE)),
        "exercise": _digest(files.get(EXERCISE_FILE)),
        "rules": _rules(summary),
        "shown": _shown(summary),
    }


def _shown(summary: Summary) -> dict[str, Any]:
    score = summary.score or {}
    total = score.get("total")
    return {
        "student": summary.student,
        "exercise": summary.exercise_id,
        "state": summary.state,
        "total": None if total is None else f"{float(total):.6f}",
        "passed": score.get("passed"),
    }


def _rules(summary: Summary) -> int:
    return int((summary.score or {}).get("scoring_version", 0) or 0)


def _digest(data: bytes | None) -> str:
    return "" if data is None else hashlib.sha256(data).hexdigest()


def _draw(path: Path) -> None:
    """Write a new key whole under its name, unless another program was faster."""
    document = {"station": secrets.token_hex(8), "secret": secrets.token_hex(32)}
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    beside = path.with_name(f".{path.name}.{secrets.token_hex(8)}")
    try:
        handle = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
        with os.fdopen(handle, "w") as stream:
            stream.write(json.dumps(document) + "\n")
            stream.flush()
            os.fsync(stream.fileno())
        with suppress(FileExistsError):
            os.link(beside, path)  # never replaces a key that is there
    finally:
        beside.unlink(missing_ok=True)


def _stretched(recovery: str, salt: bytes) -> tuple[bytes, bytes]:
    letters = "".join(c for c in recovery.upper() if c.isalnum())
    swapped = letters.translate(str.maketrans("018", "OIB"))  # digits that base 32 does not have
    try:
        raw = base64.b32decode(swapped)
    except ValueError as error:
        raise SignatureError(_NO_RECOVERY_KEY) from error
    if len(raw) != _RECOVERY_BYTES:
        raise SignatureError(_NO_RECOVERY_KEY)
    made = hashlib.scrypt(raw, salt=salt, **_SCRYPT)
    return made[:32], made[32:]


_NO_RECOVERY_KEY: Final = (
    "a recovery key has eight groups of four letters and digits: type it again"
)
