"""The summary beside a record, as a cache: lists trust it as long as the record is as it was.

`<id>.json` holds the summary, the size, time and digest of the record that it was made of, and a
digest of itself: a keyed one where this station has a key, so that nobody else can write it. Where
size and time are those of the record and its own digest is right, a list takes it as it is; else
the record is read and the file written anew. Whatever shows one attempt
(its debrief, report, exports, `acus session verify`) computes from the record and never asks the
file.
"""

import hashlib
import hmac
import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

from app.core.files import read_at_most, write_atomically
from app.core.json_values import finite
from app.session.errors import BrokenRecordingError
from app.session.recording import messages_agree, open_recording, read_recording
from app.session.station import StationKey, this_station
from app.session.summary import BROKEN, UNFINISHED, Summary, derive
from app.session.verify import Change, Verification, verify

_STILL_WRITTEN: Final = 10.0
"""A record that changed within this time [s] may be under way: nothing is kept of it."""

BEING_RECORDED: Final = "it is being recorded, or was until a moment ago"
"""Reason in the summary of a record that is under way."""

_OF_ATTEMPT: Final = frozenset(
    ("student", "exercise.id", "state", "score", "score.total", "score.passed", "score.void_reason")
)
"""What a summary of another station must say of a record as this one does. The rest may differ
where another version of Acus has listed the folder, and nobody has edited anything."""

_NOT_OURS: Final = (
    *(OSError, ValueError, LookupError, TypeError),
    *(AttributeError, ArithmeticError, RecursionError),
)


@dataclass(frozen=True, slots=True)
class Cached:
    """What stands beside a record.

    Attributes:
        summary: the attempt.
        size: of the record then [bytes].
        modified_ns: its time of change then.
        sha256: its digest then.
        intact: whether the file's own digest is right: nobody has edited it.
    """

    summary: Summary
    size: int
    modified_ns: int
    sha256: str
    intact: bool

    def fits(self, path: Path) -> bool:
        """Return whether a list may trust it: it is intact, and the record has the same size and
        time.
        """
        return self.intact and self.is_of(path)

    def is_of(self, path: Path) -> bool:
        """Return whether the record has the same size and time: it has not been written since.

        Raises:
            OSError: if it has gone.
        """
        return _size_and_time(path) == (self.size, self.modified_ns)


def sidecar(path: Path) -> Path:
    """Return the summary's file beside a record."""
    return path.with_suffix(".json")


def write_summary(path: Path, summary: Summary, mark: tuple[int, int] | None = None) -> None:
    """Write the summary beside the record `path`, whole or not at all.

    Args:
        path: the record.
        summary: of it.
        mark: size [bytes] and time [ns] of the record that was read; those of now without it. What
            was read before the record grew is trusted by no list.

    Raises:
        OSError: if the record cannot be read or the file not be written.
    """
    mark = mark or _size_and_time(path)  # before the digest: what grows meanwhile is not trusted
    write_atomically(sidecar(path), summary_text(path, summary, file_digest(path), mark))


def summary_text(
    path: Path, summary: Summary, digest: str, mark: tuple[int, int] | None = None
) -> str:
    """Return what stands beside a record, as `write_summary` writes it.

    Args:
        path: the record.
        summary: of it.
        digest: its SHA-256, hexadecimal.
        mark: as of `write_summary`.

    Raises:
        OSError: if the record cannot be read.
    """
    size, modified_ns = mark or _size_and_time(path)
    record = {"size": size, "modified_ns": modified_ns, "sha256": digest}
    document = summary.document() | {"record": record}
    document |= {"digest": _digest(document, this_station())}
    return json.dumps(document, allow_nan=False, ensure_ascii=False) + "\n"


def cached(path: Path) -> Cached | None:
    """Return what stands beside a record; None if nothing readable does."""
    try:
        document = json.loads(read_at_most(sidecar(path)))
        written, record = document.pop("digest", ""), document["record"]
        digest = _digest(document, this_station())  # raises for what cannot be printed: not ours
        return Cached(
            summary=Summary.of(document, path.stem),
            size=int(record["size"]),
            modified_ns=int(record["modified_ns"]),
            sha256=str(record["sha256"]),
            intact=hmac.compare_digest(str(written).encode(), digest.encode()),
        )
    except _NOT_OURS:
        return None


def read_summary(path: Path) -> Summary:
    """Return the summary of a record for a list: from its sidecar where that may be trusted.

    Never raises. A record that cannot be read gives a summary of state `broken` with the reason.
    """
    return read_kept(path).summary


def read_kept(path: Path) -> Cached:
    """Return what a list may trust of a record: what is kept, or else is computed and kept now.

    Never raises; what cannot be kept has no digest.
    """
    found = cached(path)
    try:
        if found is not None and found.fits(path):
            return found
    except OSError:
        pass  # the record has gone: reading it says why
    return fresh_kept(path)


def fresh_kept(path: Path) -> Cached:
    """Compute the summary of a record anew, whatever is kept; never raises."""
    summary, mark = _computed(path)
    found = cached(path)
    if found is not None and found.intact and (found.size, found.modified_ns) == mark:
        return found
    digest = ""
    if summary.state not in (BROKEN, UNFINISHED):
        with suppress(OSError):
            digest = file_digest(path)
    return Cached(summary, *mark, digest, intact=False)


def fresh_summary(path: Path) -> Summary:
    """Return the summary of a record, computed from it, and keep it beside; never raises."""
    return _computed(path)[0]


def under_way(path: Path) -> bool:
    """Tell whether a record has no end and was written a moment ago; never raises."""
    try:
        return _seconds_since(path) <= _STILL_WRITTEN and not open_recording(path).complete
    except BrokenRecordingError:
        return False


def _computed(path: Path) -> tuple[Summary, tuple[int, int]]:
    """Compute a summary and keep it; return it with the record's size and time before it was read.

    A record may be ended while it is read: what was read then is kept nowhere.
    """
    mark = (0, 0)
    with suppress(OSError):  # it has gone: reading it says so
        mark = _size_and_time(path)
    try:
        recording = open_recording(path)
        summary = derive(recording)
    except BrokenRecordingError as error:
        broken = Summary(path.stem, _modified(path), state=BROKEN, reason=str(error), software="")
        return broken, mark
    if summary.state == UNFINISHED and _seconds_since(path) <= _STILL_WRITTEN:
        if not recording.complete:
            summary = replace(summary, reason=BEING_RECORDED, problems=())
        return summary, mark
    with suppress(OSError):  # a folder that cannot be written: next time again
        if mark == _size_and_time(path):
            write_summary(path, summary, mark)
    return summary, mark


def file_digest(path: Path) -> str:
    """SHA-256 of a file, hexadecimal.

    Raises:
        OSError: if it cannot be read.
    """
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def verify_record(path: Path) -> Verification:
    """Verify a record together with what stands beside it.

    Raises:
        BrokenRecordingError: if the record cannot be read.
    """
    recording = read_recording(path)
    found = verify(recording)
    other = messages_agree(recording)
    if other:
        change = Change(f"samples ({other})", "in messages", "otherwise in columns")
        found = replace(found, changes=(*found.changes, change))
    kept = cached(path)
    if kept is None or (kept.size, kept.modified_ns) != _size_and_time(path):
        return found  # no list believes it: it is written anew
    changes = [
        Change(f"{sidecar(path).name}: {name}", a, b)
        for name, a, b in differences(kept.summary, derive(recording, found))
        if kept.intact or name in _OF_ATTEMPT
    ]
    if kept.sha256 != file_digest(path):
        changes.append(Change(f"{path.name}: digest", kept.sha256, file_digest(path)))
    return replace(found, changes=(*found.changes, *changes))


def differences(result: Summary, fresh: Summary) -> list[tuple[str, Any, Any]]:
    """Fields in which a kept summary is not what the record gives: name, kept, computed."""
    a, b = finite(result.document()), finite(fresh.document())
    return [
        pair for name in b if a.get(name) != b[name] for pair in _fields(name, a.get(name), b[name])
    ]


def _fields(name: str, a: Any, b: Any) -> list[tuple[str, Any, Any]]:
    if isinstance(a, Mapping) and isinstance(b, Mapping):
        keys = dict.fromkeys((*a, *b))
        return [
            pair
            for key in keys
            if a.get(key) != b.get(key)
            for pair in _fields(f"{name}.{key}", a.get(key), b.get(key))
        ]
    return [(name, a, b)]


def _size_and_time(path: Path) -> tuple[int, int]:
    stat = path.stat()
    return stat.st_size, stat.st_mtime_ns


def _digest(document: Mapping[str, Any], key: StationKey | None = None) -> str:
    text = json.dumps(document, sort_keys=True, separators=(",", ":"), ensure_ascii=False).encode()
    if key is None:
        return hashlib.sha256(text).hexdigest()
    return hmac.digest(key.derived("summary"), text, "sha256").hex()


def _seconds_since(path: Path) -> float:
    try:
        return datetime.now(UTC).timestamp() - path.stat().st_mtime
    except OSError:
        return 0.0


def _modified(path: Path) -> str:
    try:
        seconds = path.stat().st_mtime
    except OSError:
        seconds = 0.0
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds")
