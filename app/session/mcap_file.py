"""An MCAP file that is safe to lose the process in: chunks are closed and synced on demand.

The file is whole up to its last commit, with space set aside for its end. What is written waits in
memory until `commit`. If the disk is full then, the file is cut back to the last commit, the space
set aside is given back, and the same bytes are written into it: whoever writes then knows (`full`)
that only the end may follow. Until `publish` the file has a name that no list looks at, so that one
under its own name is never without its beginning.
"""

import errno
import hashlib
import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, Final, cast

from mcap.writer import CompressionType, Writer

from app import __version__
from app.core.descriptors import hold, hold_alone
from app.core.files import step
from app.core.messages import sentence
from app.core.temporary import hidden
from app.session.blocks import COLUMNS, SLOT_NAMES
from app.session.errors import RecordingError
from app.session.header import Attachment, SessionHeader
from app.session.sample import encode
from app.session.schemas import CHANNELS

RESERVE: Final = 4 * 1024 * 1024
"""Set aside for the end [bytes]: the last chunk, score, result, samples of a short attempt and the
index of an hour."""

_TRIES: Final = 20
_NO_SPACE: Final = (errno.ENOSPC, errno.EDQUOT)


class GrowingFile:
    """See above; used by one thread at a time.

    Attributes:
        path: where it stands once it is published.
        full: whether the disk was full: the space set aside is in use.
    """

    def __init__(self, path: Path, reserve: int = RESERVE) -> None:
        self.path = path
        self.full = False
        self._size = reserve
        self._part = path.with_name(f".{path.name}.part")
        self._reserve = path.with_name(f".{path.name}.reserve")
        self._fd = self._reserve_fd = -1
        self._committed = 0
        self._pending = bytearray()
        self._published = False

    @property
    def published(self) -> bool:
        """Return whether the file stands under its own name."""
        return self._published

    @property
    def room(self) -> int:
        """Bytes that may surely follow: once full, what is left of the space set aside."""
        return max(0, self._size - len(self._pending)) if self.full else 1 << 62

    def open(self) -> None:
        """Create the file under its temporary name, and set space aside.

        Raises:
            FileExistsError: if there is a file of this name already.
            OSError: if it cannot be created, or there is no space for its end.
        """
        remove_strays(self.path.parent)
        if self.path.exists():
            raise FileExistsError(errno.EEXIST, "exists already", str(self.path))
        flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY | getattr(os, "O_BINARY", 0)
        try:
            self._reserve_fd = _held(self._opened_reserve)
            self._fd = _held(lambda: os.open(self._part, flags, 0o600))
        except OSError:
            self._give_back_space()
            raise

    def write(self, data: bytes) -> int:
        """Append, in memory."""
        self._pending += data
        return len(data)

    def tell(self) -> int:
        """Length of the file with what waits in memory."""
        return self._committed + len(self._pending)

    def flush(self) -> None:
        """Nothing: `commit` decides when bytes go to the disk."""

    def commit(self, sync: bool = True) -> None:
        """Hand what waits to the system, and wait for the disk with `sync`.

        Raises:
            OSError: if it cannot be written, not even with the space that was set aside; the file
                ends with the last commit then.
        """
        if self._pending:
            try:
                self._append()
            except OSError as error:
                self._cut()
                if error.errno not in _NO_SPACE or self.full:
                    raise
                self._give_back()
                self._append_or_cut()
            self._committed += len(self._pending)
            self._spend(len(self._pending))
            self._pending.clear()
        if sync:
            os.fsync(self._fd)

    def publish(self) -> None:
        """Commit, and give the file its own name.

        Raises:
            FileExistsError: if another file took the name meanwhile.
            OSError: if it cannot be written.
        """
        self.commit()
        step("publish", self.path)
        try:
            os.link(self._part, self.path)  # refuses a name that is taken, as a rename would not
        except FileExistsError:
            raise
        except OSError:  # a file system without links
            if self.path.exists():
                raise FileExistsError(errno.EEXIST, "exists already", str(self.path)) from None
            os.rename(self._part, self.path)
        self._part.unlink(missing_ok=True)
        self._published = True
        _sync_folder(self.path.parent)

    def close(self, sealed: Callable[[str], object] | None = None) -> None:
        """Commit the rest and close; what was never published is removed. Idempotent.

        Args:
            sealed: told the SHA-256 of the whole file before its end is written.

        Raises:
            OSError: if it cannot be written.
        """
        if self._fd < 0:
            return
        try:
            self._give_back_space()
            if sealed is not None:
                sealed(self._digest())
            step("close", self.path)
            self.commit()
        finally:
            self.abandon()

    def abandon(self) -> None:
        """Close the file as it is on the disk. Idempotent."""
        fd, self._fd = self._fd, -1
        if fd < 0:
            return
        self._pending.clear()
        with suppress(OSError):
            os.close(fd)
        with suppress(OSError):
            self._give_back_space()
        if not self._published:
            with suppress(OSError):
                self._part.unlink(missing_ok=True)

    def _opened_reserve(self) -> int:
        step("reserve", self._reserve)
        _set_aside(self._reserve, self._size)
        return os.open(self._reserve, os.O_RDONLY)

    def _digest(self) -> str:
        """SHA-256 of what is on the disk and what waits, hexadecimal."""
        found = hashlib.sha256()
        with (self.path if self._published else self._part).open("rb") as stream:
            while block := stream.read(1 << 20):
                found.update(block)
        found.update(self._pending)
        return found.hexdigest()

    def _append(self) -> None:
        view = memoryview(self._pending)
        try:
            while len(view):
                view = view[_write(self._fd, view) :]
        finally:
            view.release()

    def _append_or_cut(self) -> None:
        try:
            self._append()
        except OSError:
            self._cut()
            raise

    def _cut(self) -> None:
        with suppress(OSError):
            os.ftruncate(self._fd, self._committed)
            os.lseek(self._fd, self._committed, os.SEEK_SET)

    def _give_back(self) -> None:
        self.full = True
        self._give_back_space()

    def _give_back_space(self) -> None:
        fd, self._reserve_fd = self._reserve_fd, -1
        if fd >= 0:
            os.close(fd)
        step("give back", self._reserve)
        self._reserve.unlink(missing_ok=True)

    def _spend(self, count: int) -> None:
        if self.full:
            self._size = max(0, self._size - count)


def _held(opened: Callable[[], int]) -> int:
    """Create a file and hold it, so that nobody takes it for one that a killed program left.

    One that was swept away before it was held is created once more.

    Raises:
        OSError: if it cannot be created.
    """
    for _ in range(_TRIES):
        try:
            fd = opened()
        except FileNotFoundError:
            continue
        with suppress(OSError):  # a file system without locks: nothing is swept there
            hold(fd)
        if os.fstat(fd).st_nlink:
            return fd
        os.close(fd)
    raise FileNotFoundError(errno.ENOENT, "its folder has gone, or is cleared all the time")


def _write(fd: int, data: memoryview) -> int:
    return os.write(fd, data)


def _set_aside(path: Path, size: int) -> None:
    """Create a file whose blocks are really taken from the disk."""
    fd = os.open(path, os.O_CREAT | os.O_WRONLY | os.O_TRUNC | getattr(os, "O_BINARY", 0), 0o600)
    try:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(fd, 0, size)
        else:
            zeros = memoryview(bytes(size))
            while len(zeros):
                zeros = zeros[_write(fd, zeros) :]
    finally:
        os.close(fd)


def _sync_folder(folder: Path) -> None:
    """Wait until the folder's entries stand on the disk, where a folder can be opened."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def remove_strays(folder: Path, names: Sequence[str] | None = None) -> None:
    """Delete what killed programs left of records under temporary names: who lives holds them.

    Args:
        folder: of the records.
        names: that `hidden` has just given there; they are read without.
    """
    names = hidden(folder) if names is None else names
    left = [name for name in names if name.endswith((".mcap.part", ".mcap.reserve"))]
    for path in map(folder.joinpath, left):
        with suppress(OSError):
            fd = os.open(path, os.O_RDONLY)
            try:
                if hold_alone(fd):
                    path.unlink(missing_ok=True)
            finally:
                os.close(fd)


CHUNK_SIZE = 256 * 1024
"""A chunk is closed at this size at the latest [bytes]; `flush` closes it earlier."""


class McapFile:
    """One record being written; not thread-safe, its recorder's thread owns it."""

    def __init__(self, path: Path, header: SessionHeader) -> None:
        """Keep what is needed."""
        self.path = path
        self._header = header
        self._file = GrowingFile(path)
        self._writer: Writer | None = None
        self._channels: dict[str, int] = {}
        self._sequence = 0

    @property
    def full(self) -> bool:
        """Return whether the disk is full: only the end may follow, in the space set aside for
        it.
        """
        return self._file.full

    @property
    def room(self) -> int:
        """Bytes that surely find space."""
        return self._file.room

    @property
    def published(self) -> bool:
        """Return whether the file stands under its own name, with its beginning on the disk."""
        return self._file.published

    def open(self) -> None:
        """Set space aside and write the head, under a name that no list looks at; see `publish`.

        Raises:
            RecordingError: if the folder cannot be written or the name is taken.
        """
        try:
            _make_folder(self.path.parent)
            self._file.open()
            # All that a writer asks of a stream is what a growing file has.
            self._writer = Writer(cast("Any", self._file), CHUNK_SIZE, CompressionType.ZSTD)
            self._write_head(self._writer)
        except OSError as error:
            raise self._refused(error) from error

    def publish(self) -> None:
        """Put what was written so far on the disk and give the file its name.

        Raises:
            RecordingError: if it cannot be written or the name is taken.
        """
        try:
            self._finish_chunk()
            self._file.publish()
        except OSError as error:
            raise self._refused(error) from error

    def _refused(self, error: OSError) -> RecordingError:
        self.abandon()
        if isinstance(error, FileExistsError):
            return RecordingError(
                sentence(
                    "session {header_id} exists already ({path}): every attempt needs its own id",
                    header_id=self._header.id,
                    path=self.path,
                )
            )
        return RecordingError(
            sentence("cannot record to {path}: {reason}", path=self.path, reason=_reason(error))
        )

    def message(self, topic: str, nanoseconds: int, data: bytes) -> None:
        """Append one message."""
        writer = self._open_writer()
        self._sequence += 1
        channel = self._channels[topic]
        writer.add_message(channel, nanoseconds, data, nanoseconds, self._sequence & 0xFFFFFFFF)

    def attach(self, attachment: Attachment, nanoseconds: int) -> None:
        """Append a file."""
        a = attachment
        self._open_writer().add_attachment(nanoseconds, nanoseconds, a.name, a.media_type, a.data)

    def metadata(self, name: str, values: dict[str, str]) -> None:
        """Append a metadata record."""
        self._open_writer().add_metadata(name, values)

    def flush(self, sync: bool = True) -> None:
        """Close the open chunk and hand it to the system; with `sync` wait for the disk.

        Raises:
            OSError: if it cannot be written, not even into the space that was set aside.
        """
        self._finish_chunk()
        self._file.commit(sync)

    def close(self, sealed: Callable[[str], object] | None = None) -> None:
        """Finish the file (index and footer) and close it; idempotent.

        Args:
            sealed: told the SHA-256 of the whole file before its end is written; does not raise.

        Raises:
            OSError: if it cannot be written.
        """
        if self._writer is None:
            return
        try:
            self._writer.finish()  # type: ignore[no-untyped-call]
            self._file.close(sealed)
        finally:
            self.abandon()

    def abandon(self) -> None:
        """Let go of the file as it is on the disk."""
        self._writer = None
        self._file.abandon()

    def _finish_chunk(self) -> None:
        self._open_writer().flush()  # type: ignore[no-untyped-call]  # mcap leaves it without types

    def _open_writer(self) -> Writer:
        if self._writer is None:
            raise RecordingError(sentence("the record {path} is not open", path=self.path))
        return self._writer

    def _write_head(self, writer: Writer) -> None:
        writer.start(profile="", library=f"acus {__version__}")
        for name, values in self._header.records().items():
            writer.add_metadata(name, values)
        now = self._header.nanoseconds(self._header.origin)
        for attachment in self._header.attachments:
            self.attach(attachment, now)
        for topic, channel in CHANNELS.items():
            if channel.schema is None:
                extra = {"layout": "docs/sessions.md"}
                if topic == "/loop/inputs":
                    extra |= {"slots": ",".join(COLUMNS), "state": ",".join(SLOT_NAMES)}
                self._channels[topic] = writer.register_channel(topic, channel.layout, 0, extra)
            else:
                title = str(channel.schema["title"])
                schema = writer.register_schema(title, "jsonschema", encode(channel.schema))
                self._channels[topic] = writer.register_channel(topic, "json", schema)


def _make_folder(folder: Path) -> None:
    if folder.exists() and not folder.is_dir():
        raise RecordingError(
            sentence("cannot record to {folder}: it is a file, not a folder", folder=folder)
        )
    folder.mkdir(parents=True, exist_ok=True)


def _reason(error: OSError) -> str:
    return error.strerror or str(error)
