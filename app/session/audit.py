"""Who did what at this station: a file that is added to, each line signed and chained to the last.

A line holds when, who (`instructor`, a student's random key, `account`: whoever sits at the
computer of a station without a password, or `program`: by itself), what, and about which keys and
ids; never a name, a pseudonym, a path or a text. Its Ed25519 signature covers the digest of the
line before, so that a line that was changed, taken out or put in is seen. Lines cut off at the end
are not, unless somebody kept an earlier copy; who owns the disk can replace key and file.
Before a station has a key its lines are chained alone; after the first signed one each is signed.
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
import re
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

from app.core.descriptors import hold_alone
from app.core.files import BINARY, step
from app.session.errors import SessionError
from app.session.station import StationKey, key_file, signature_holds

FILE: Final = "audit.jsonl"

ACCOUNT: Final = "account"
INSTRUCTOR: Final = "instructor"
PROGRAM: Final = "program"

WHAT: Final = (
    "password set",
    "password changed",
    "password recovered",
    "signed in",
    "signed in by hospital",
    "sign-in linked",
    "sign-in unlinked",
    "sign-in configured",
    "role given",
    "students added",
    "students changed",
    "student renamed",
    "PIN set",
    "student erased",
    "course saved",
    "attempts remarked",
    "attempts admitted",
    "attempt deleted",
    "attempt brought back",
    "results written",
    "statements sent",
    "backup written",
    "backup restored",
    "files taken in",
    "store synchronised",
    "station named",
    "station revoked",
    "key renewed",
)
"""All that is told of."""

_PURPOSE: Final = "audit"
_BEGIN: Final = "0" * 64
_ID: Final = re.compile(r"[\w.@:+-]{1,80}")
_MANY: Final = 100
"""So many ids stand in a line; of more only their number."""
_TAIL: Final = 1 << 16

_log = logging.getLogger(__name__)
_acting = [ACCOUNT]


@dataclass(frozen=True, slots=True)
class AuditEntry:
    """One thing that was done.

    Attributes:
        number: its place, from 1.
        time: by this computer's clock, ISO 8601 in UTC.
        who: `instructor`, `account` or a person's random key.
        what: one of `WHAT`.
        about: keys of people, ids of attempts, exercises, courses or stations.
        count: how many they are, where they are too many to stand here.
        right: whether it stands where it was written, as it was written.
    """

    number: int
    time: str
    who: str
    what: str
    about: tuple[str, ...]
    count: int
    right: bool


def act_as(who: str) -> None:
    """Say who does what this program does from now on."""
    _acting[0] = who


def note(what: str, about: Sequence[str] = (), folder: Path | None = None, who: str = "") -> None:
    """Add a line; where it cannot be written the program's log says so, and the work goes on.

    Args:
        what: one of `WHAT`.
        about: keys and ids; what is none is left out.
        folder: of the people.
        who: did it, such as `program`; whoever is here without it.
    """
    if what not in WHAT:
        raise ValueError(what)
    try:
        key = _key(folder)
        ids = [one for one in map(str, about) if _ID.fullmatch(one)]
        with _held(audit_file(folder)) as descriptor:
            number, before = _last(descriptor)
            entry: dict[str, Any] = {
                "number": number + 1,
                "time": datetime.now(UTC).isoformat(timespec="seconds"),
                "who": who or _acting[0],
                "what": what,
                "about": ids if len(ids) <= _MANY else [],
                "count": len(ids),
                "before": before,
                "public": "" if key is None else key.public,
            }
            entry["signature"] = "" if key is None else key.sign(_PURPOSE, entry)
            line = json.dumps(entry, ensure_ascii=True).encode() + b"\n"
            step("audit", audit_file(folder))
            os.write(descriptor, line)
            os.fsync(descriptor)
    except (OSError, SessionError) as error:
        _log.warning("the audit trail cannot be written: %s", type(error).__name__)


def audit_file(folder: Path | None = None) -> Path:
    """Return where the lines are: beside the people."""
    return key_file(folder).with_name(FILE)


def entries(folder: Path | None = None) -> list[AuditEntry]:
    """Return all lines in their order, each with whether it is what was written.

    Raises:
        SessionError: if the file cannot be read.
    """
    path, result = audit_file(folder), []
    try:
        lines = path.read_bytes().splitlines() if path.exists() else []
    except OSError as error:
        raise SessionError(f"{path}: {error.strerror}") from error
    key = _key(folder)
    publics = set() if key is None else set(key.publics)
    before, signed = _BEGIN, False
    for place, line in enumerate(lines, 1):
        entry, by_key = _entry(line, place, before, publics)
        result.append(replace(entry, right=entry.right and (by_key or not signed)))
        before, signed = hashlib.sha256(line).hexdigest(), signed or by_key
    return result


# --- inside ---------------------------------------------------------------------------------------
def _key(folder: Path | None) -> StationKey | None:
    """Return the station's key; none is drawn for a line."""
    return StationKey.of(folder) if key_file(folder).exists() else None


def _entry(line: bytes, place: int, before: str, publics: set[str]) -> tuple[AuditEntry, bool]:
    """Return a line, and whether a key signed it."""
    try:
        document = json.loads(line)
        signature = str(document.pop("signature"))
        public = str(document["public"])
        holds = public in publics and signature_holds(public, _PURPOSE, document, signature)
        right = (holds or not signature) and document["before"] == before
        right = right and document["number"] == place
        about = tuple(map(str, document["about"]))
        time_, who, what = (str(document[name]) for name in ("time", "who", "what"))
        entry = AuditEntry(place, time_, who, what, about, int(document["count"]), right)
        return entry, bool(signature)
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return AuditEntry(place, "", "", "", (), 0, right=False), True


@contextmanager
def _held(path: Path) -> Iterator[int]:
    """Open the file to add to it, alone among all programs."""
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    descriptor = os.open(path, os.O_RDWR | os.O_CREAT | os.O_APPEND | BINARY, 0o600)
    try:
        end = time.monotonic() + 5.0
        while hold_alone(descriptor) is False and time.monotonic() < end:
            time.sleep(0.002)
        yield descriptor
    finally:
        os.close(descriptor)


def _last(descriptor: int) -> tuple[int, str]:
    """Return number and digest of the last line; one that a kill cut off goes first."""
    size = os.fstat(descriptor).st_size
    begin = max(0, size - _TAIL)
    os.lseek(descriptor, begin, os.SEEK_SET)
    data = os.read(descriptor, size - begin)
    if data and not data.endswith(b"\n"):
        data = data[: data.rfind(b"\n") + 1]
        os.ftruncate(descriptor, begin + len(data))
    lines = data.splitlines()
    if not lines:
        return 0, _BEGIN
    total = len(lines) if begin == 0 else _counted(descriptor)
    return total, hashlib.sha256(lines[-1]).hexdigest()


def _counted(descriptor: int) -> int:
    """Count the lines of a long file."""
    number = 0
    os.lseek(descriptor, 0, os.SEEK_SET)
    while block := os.read(descriptor, 1 << 20):
        number += block.count(b"\n")
    return number
