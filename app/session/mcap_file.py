"""An MCAP file that is safe to lose the process in: chunks are closed and synced on demand."""

import os
from contextlib import suppress
from pathlib import Path
from typing import IO

from mcap.writer import CompressionType, Writer

from app import __version__
from app.session.blocks import COLUMNS, SLOT_NAMES
from app.session.errors import RecordingError
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
        self._stream: IO[bytes] | None = None
        self._writer: Writer | None = None
        self._channels: dict[str, int] = {}
        self._sequence = 0

    def open(self) -> None:
        """Create the file and write its head.

        Raises:
            RecordingError: if the folder cannot be written or the name is taken.
        """
        try:
            _make_folder(self.path.parent)
            self._stream = self.path.open("xb")
            self._writer = Writer(self._stream, CHUNK_SIZE, CompressionType.ZSTD)
            self._write_head(self._writer)
            self.flush()
        except FileExistsError as error:
            raise RecordingError(
                f"session {self._header.id} exists already ({self.path}): "
                "every attempt needs its own id"
            ) from error
        except OSError as error:
            self.abandon()
            raise RecordingError(f"cannot record to {self.path}: {_reason(error)}") from error

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

    def flush(self) -> None:
        """Close the open chunk and put everything on the disk."""
        writer, stream = self._open_writer(), self._stream
        writer.flush()  # type: ignore[no-untyped-call]  # mcap leaves it without types
        if stream is not None:
            os.fsync(stream.fileno())

    def close(self) -> None:
        """Finish the file (index and footer) and close it; idempotent."""
        if self._writer is None or self._stream is None:
            return
        try:
            self._writer.finish()  # type: ignore[no-untyped-call]
            self._stream.flush()
            os.fsync(self._stream.fileno())
        finally:
            self.abandon()

    def abandon(self) -> None:
        """Let go of the file as it is; what cannot be flushed any more is lost."""
        stream, self._stream, self._writer = self._stream, None, None
        if stream is not None:
            with suppress(OSError):  # the same full disk that has been reported already
                stream.close()

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
