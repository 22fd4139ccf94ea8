"""Attempts that were cut off: found at the next start, and closed as they stand.

A record without its end belongs to an attempt that was interrupted (the program was killed, the
power went), unless some program still writes it: whoever writes holds a lock on the file, and adds
to it twice a second. Closing one copies every record that is whole, says that the attempt was
interrupted, and takes the place of the old file in one step; it is listed as unfinished from then
on and never scored as if it had been finished.
"""

from __future__ import annotations

import os
import struct
import time
from collections.abc import Iterator
from contextlib import closing, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import IO, Final

from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import DataEnd, Footer, Metadata
from mcap.writer import MCAP0_MAGIC

from app.core.descriptors import hold, is_held
from app.core.files import BINARY, replace, sync
from app.core.messages import sentence
from app.session.errors import SessionError
from app.session.machine import FINAL
from app.session.recording import open_recording, read_recording
from app.session.sidecar import read_summary
from app.session.signature import Signed, judge_whole, signature_file
from app.session.station import this_station
from app.session.store import find, records, settled
from app.session.summary import BROKEN, Summary
from app.session.verify import state_of

QUIET_S: Final = 15.0
"""A record that grew within this time [s] is taken to be under way, whatever its lock says."""

INTERRUPTED: Final = "interrupted"
"""State in the result of a record that was closed here; lists say `unfinished`."""

_FRAME: Final = struct.Struct("<BQ")
_BLOCK: Final = 1 << 20


def interrupted(folder: Path, now: float | None = None) -> tuple[list[Summary], bool]:
    """Return the attempts that were cut off, newest first, and whether some may yet turn out so.

    Args:
        folder: of the records; one that does not exist holds none.
        now: wall-clock time [s since 1970].

    Raises:
        SessionError: if the folder cannot be read.
    """
    now, found, fresh = time.time() if now is None else now, [], False
    for path in records(settled(folder)):
        if not is_cut_off(path):
            continue
        if _age(path, now) < QUIET_S:
            fresh = True
        elif not _is_written(path):
            summary = read_summary(path)
            found += [summary] if summary.state != BROKEN else []
    return sorted(found, key=lambda one: (one.started, one.id), reverse=True), fresh


def is_cut_off(path: Path) -> bool:
    """Return whether a file begins as a record, has no end, and was never signed as finished."""
    if signature_file(path).exists():  # asked first: of most attempts it is enough
        return False
    try:
        with path.open("rb") as stream:
            begins = stream.read(len(MCAP0_MAGIC)) == MCAP0_MAGIC
            if not begins or path.stat().st_size < 2 * len(MCAP0_MAGIC):
                return False
            stream.seek(-len(MCAP0_MAGIC), os.SEEK_END)
            return stream.read() != MCAP0_MAGIC
    except OSError:
        return False


def recover(folder: Path, session_id: str, now: float | None = None) -> Path:
    """Close a record that was cut off: all that is whole in it stays; return its file.

    One that has its end and is as it was signed stays as it is.

    Args:
        folder: of the records.
        session_id: of the attempt.
        now: wall-clock time [s since 1970].

    Raises:
        SessionNotFoundError: if there is no such session.
        BrokenRecordingError: if it holds nothing of an attempt.
        SessionError: if a program still writes it, it cannot be written, or it was altered or cut
            after it was signed.
    """
    path, now = find(folder, session_id), time.time() if now is None else now
    if not is_cut_off(path):
        _require_whole(path)
        return path
    beside = path.with_name(f".{path.name}.part")
    try:
        with path.open("rb") as stream:
            if _age(path, now) < QUIET_S or not _alone(stream):
                raise SessionError(
                    sentence(
                        "{path_stem} is being written by a running program: end its attempt "
                        "there, or try again {quiet_s:.0f} s after that program has gone",
                        path_stem=path.stem,
                        quiet_s=QUIET_S,
                    )
                )
            end = _end(path, now)
            fd = os.open(beside, os.O_CREAT | os.O_TRUNC | os.O_WRONLY | BINARY, 0o600)
            with closing(os.fdopen(fd, "wb")) as out:
                with suppress(OSError):
                    hold(out.fileno())  # nobody takes it for one that a killed program left
                for part in _whole(stream, path.stat().st_size):
                    out.write(part)
                out.write(end)
                out.flush()
                os.fsync(out.fileno())
            replace(beside, path)
        if os.name == "posix":
            sync(path.parent)
    except OSError as error:
        raise SessionError(
            sentence(
                "cannot recover {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    finally:
        beside.unlink(missing_ok=True)
    return path


# --- inside ---------------------------------------------------------------------------------------
def _require_whole(path: Path) -> None:
    check = judge_whole(path, this_station())
    altered = check.verdict is Signed.ALTERED
    if altered or not open_recording(path).complete:
        why = f"altered after it was signed ({check.why})" if altered else "cut or damaged"
        raise SessionError(
            sentence(
                "{path_stem} was {reason} and cannot be recovered from itself; a backup may hold "
                "it whole (`acus store restore`)",
                path_stem=path.stem,
                reason=why,
            )
        )


def _end(path: Path, now: float) -> bytes:
    """Return what closes a record: what became of the attempt, and the end of the file."""
    recording = read_recording(path)
    result = dict(recording.metadata.get("result", {}))
    if "state" not in result:
        last = state_of(recording)
        finished = last in {state.value for state in FINAL}
        seconds = recording.samples.time
        after = float(seconds[-1] - recording.origin) if len(seconds) else 0.0
        why = f"interrupted after {after:.0f} s: the program ended; recovered as it stood"
        result |= {"state": last, "reason": ""} if finished else {"state": INTERRUPTED}
        result |= {} if finished else {"reason": why}
    moment = datetime.fromtimestamp(now, UTC).isoformat(timespec="seconds")
    builder = RecordBuilder()
    Metadata("result", result | {"recovered": moment}).write(builder)
    DataEnd(0).write(builder)
    Footer(0, 0, 0).write(builder)
    return bytes(builder.end()) + MCAP0_MAGIC  # type: ignore[no-untyped-call]


def _whole(stream: IO[bytes], size: int) -> Iterator[bytes]:
    """Yield the file's head and every record that is whole, up to the first that is not."""
    stream.seek(0)
    yield stream.read(len(MCAP0_MAGIC))
    while True:
        head, left = stream.read(_FRAME.size), size - stream.tell()
        if len(head) < _FRAME.size:
            return
        opcode, length = _FRAME.unpack(head)
        if length > left or opcode in (0, Opcode.DATA_END, Opcode.FOOTER):
            return
        yield head
        while length:
            block = stream.read(min(length, _BLOCK))
            if not block:
                return  # it has become shorter meanwhile
            length -= len(block)
            yield block


def _is_written(path: Path) -> bool:
    try:
        with path.open("rb") as stream:
            return not _alone(stream)
    except OSError:
        return True


def _alone(stream: IO[bytes]) -> bool:
    """Return whether no other program holds the file; who asks holds it until it is closed.

    Without locks (Windows) the time of its last change has to do.
    """
    return os.name != "posix" or not is_held(stream.fileno())


def _age(path: Path, now: float) -> float:
    try:
        return now - path.stat().st_mtime
    except OSError:
        return 0.0
