"""An MCAP file that is safe to lose the process in: chunks are closed and synced on demand."""

from pathlib import Path
from typing import Any, cast

from mcap.writer import CompressionType, Writer

from app import __version__
from app.session.blocks import COLUMNS, SLOT_NAMES
from app.session.errors import RecordingError
from app.session.growing_file import GrowingFile
from app.session.header import Attachment, SessionHeader
from app.session.sample import encode
from app.session.schemas import CHANNELS

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
        """Whether the disk is full: only the end may follow, in the space set aside for it."""
        return self._file.full

    @property
    def room(self) -> int:
        """Bytes that surely find space."""
        return self._file.room

    @property
    def published(self) -> bool:
        """Whether the file stands under its own name, with its beginning on the disk."""
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
                f"session {self._header.id} exists already ({self.path}): "
                "every attempt needs its own id"
            )
        return RecordingError(f"cannot record to {self.path}: {_reason(error)}")

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

    def close(self) -> None:
        """Finish the file (index and footer) and close it; idempotent.

        Raises:
            OSError: if it cannot be written.
        """
        if self._writer is None:
            return
        try:
            self._writer.finish()  # type: ignore[no-untyped-call]
            self._file.close()
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
            raise RecordingError(f"the record {self.path} is not open")
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
        raise RecordingError(f"cannot record to {folder}: it is a file, not a folder")
    folder.mkdir(parents=True, exist_ok=True)


def _reason(error: OSError) -> str:
    return error.strerror or str(error)
