"""Reads an MCAP file that may be cut off or damaged: a linear scan that keeps what is whole."""

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import IO, Final
from zlib import crc32

from mcap.exceptions import EndOfFile, McapError
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    Chunk,
    ChunkIndex,
    Footer,
    McapRecord,
    Message,
    Metadata,
    MetadataIndex,
)
from mcap.stream_reader import StreamReader
from mcap.writer import MCAP0_MAGIC
from zstandard import ZstdDecompressor, ZstdError

from app.session.errors import BrokenRecordingError

_FRAME: Final = struct.Struct("<BQ")
_FOOTER: Final = 9 + 20
_MESSAGE: Final = struct.Struct("<HIQQ")


@dataclass(slots=True)
class FileContents:
    """What a file holds.

    Attributes:
        metadata: metadata records by name; a later record of a name replaces an earlier one.
        attachments: attached files by name.
        messages: payloads by topic, in the file's order.
        channels: channel metadata by topic.
        complete: whether the file was finished.
        problems: what is cut off or damaged, one line each.
    """

    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    messages: dict[str, list[bytes]] = field(default_factory=dict)
    channels: dict[str, dict[str, str]] = field(default_factory=dict)
    complete: bool = False
    problems: list[str] = field(default_factory=list)


def scan(path: Path) -> FileContents:
    """Read all records that are whole.

    Raises:
        BrokenRecordingError: if the file cannot be read or does not begin as an MCAP file.
    """
    result = FileContents()
    topics: dict[int, str] = {}
    payloads: dict[int, list[bytes]] = {}
    try:
        size = path.stat().st_size
        with path.open("rb") as stream:
            _check_magic(stream, path)
            for record in _records(stream, size, result.problems):
                if isinstance(record, Message):
                    payloads.setdefault(record.channel_id, []).append(record.data)
                else:
                    _sort(record, topics, result)
    except OSError as error:
        raise BrokenRecordingError(f"cannot read {path}: {error.strerror or error}") from error
    # Only now: the index at the end repeats the channels, should the first chunk be damaged.
    result.messages = {topics[i]: data for i, data in payloads.items() if i in topics}
    return result


def scan_by_index(path: Path, topic: str) -> FileContents | None:
    """Read metadata, attachments and the messages of one topic by the index at the file's end.

    The length of the attempt then hardly matters. None where the file was not finished or anything
    of this is not as it should be: then `scan` says what. Damage to other messages is not seen.

    Raises:
        BrokenRecordingError: if the file cannot be read.
    """
    try:
        with path.open("rb") as stream:
            return _indexed(stream, path.stat().st_size, topic)
    except OSError as error:
        raise BrokenRecordingError(f"cannot read {path}: {error.strerror or error}") from error
    except (_UnsoundError, ZstdError, ValueError, struct.error, MemoryError, OverflowError):
        return None


class _UnsoundError(Exception):
    """The index, or something that it points to, is not as it should be."""


def _indexed(stream: IO[bytes], size: int, topic: str) -> FileContents:
    summary = _summary(stream, size)
    result, ids = FileContents(complete=True), []
    for record in summary:
        if isinstance(record, Channel):
            result.channels[record.topic] = record.metadata
            if record.topic == topic:
                ids.append(record.id)
    result.messages[topic] = []
    for record in summary:
        if isinstance(record, AttachmentIndex | MetadataIndex):
            for found in _at(stream, record.offset, record.length):
                _sort(found, {}, result)
        elif isinstance(record, ChunkIndex) and any(i in record.message_index_offsets for i in ids):
            for found in _at(stream, record.chunk_start_offset, record.chunk_length, chunk=True):
                if isinstance(found, Chunk):
                    result.messages[topic] += _messages(found, ids)
    return result


def _summary(stream: IO[bytes], size: int) -> list[McapRecord]:
    """Read what stands between data and footer; its checksum must be right."""
    end = size - len(MCAP0_MAGIC) - _FOOTER
    stream.seek(max(0, end))
    tail = stream.read()
    if end <= 0 or tail[_FOOTER:] != MCAP0_MAGIC or tail[0] != Opcode.FOOTER:
        raise _UnsoundError
    start, _, crc = struct.unpack_from("<QQI", tail, _FRAME.size)
    if not 0 < start < end:
        raise _UnsoundError
    stream.seek(start)
    data = stream.read(end - start)
    if crc32(data + tail[: _FOOTER - 4]) != crc:
        raise _UnsoundError
    return _parsed(data)


def _at(stream: IO[bytes], offset: int, length: int, chunk: bool = False) -> list[McapRecord]:
    stream.seek(offset)
    return _parsed(stream.read(length), chunk)


def _parsed(data: bytes, chunk: bool = False) -> list[McapRecord]:
    problems: list[str] = []
    records = _parse(data, 0, problems, chunk)
    if problems or not records:
        raise _UnsoundError
    return records


def _messages(chunk: Chunk, ids: list[int]) -> list[bytes]:
    """Messages of some channels of a chunk, without a look at the others."""
    data = chunk.data
    if chunk.compression == "zstd":
        data = ZstdDecompressor().decompress(data, max_output_size=chunk.uncompressed_size)
    elif chunk.compression:
        raise _UnsoundError
    if chunk.uncompressed_crc and crc32(data) != chunk.uncompressed_crc:
        raise _UnsoundError
    found, place = [], 0
    while place < len(data):
        opcode, length = _FRAME.unpack_from(data, place)
        body = place + _FRAME.size
        place = body + length
        if opcode == Opcode.MESSAGE and _MESSAGE.unpack_from(data, body)[0] in ids:
            found.append(data[body + _MESSAGE.size : place])
    return found


def _check_magic(stream: IO[bytes], path: Path) -> None:
    magic = stream.read(len(MCAP0_MAGIC))
    if magic != MCAP0_MAGIC:
        found = magic.hex(" ") or "nothing"
        raise BrokenRecordingError(f"{path.name} is not an MCAP file: it begins with {found}")


def _records(stream: IO[bytes], size: int, problems: list[str]) -> Iterator[McapRecord]:
    """Frame by frame; a frame that is not whole ends the file, one that is damaged is skipped."""
    while True:
        offset = stream.tell()
        head = stream.read(_FRAME.size)
        if not head:
            problems.append("the file ends without a footer: the attempt was not finished")
            return
        length = _FRAME.unpack(head)[1] if len(head) == _FRAME.size else size
        if length > size - offset - _FRAME.size:
            problems.append(
                f"the file is cut off at byte {size}, inside the record at byte {offset}"
            )
            return
        for record in _parse(head + stream.read(length), offset, problems):
            yield record
            if isinstance(record, Footer):
                return


def _parse(frame: bytes, offset: int, problems: list[str], chunk: bool = False) -> list[McapRecord]:
    """Return the records of one frame; of a chunk, its messages unless `chunk` wants it itself."""
    records: list[McapRecord] = []
    try:
        reader = StreamReader(
            BytesIO(frame), skip_magic=True, emit_chunks=chunk, validate_crcs=True
        )
        for record in reader.records:
            records.append(record)
    except EndOfFile:
        pass  # the frame's own end
    except (
        McapError,
        ZstdError,
        ValueError,
        struct.error,
        MemoryError,
        RuntimeError,
        OverflowError,
    ) as error:
        text = " ".join(str(error).split()) or type(error).__name__
        problems.append(f"the record at byte {offset} is damaged and left out: {text}")
        return []
    return records


def _sort(record: McapRecord, topics: dict[int, str], result: FileContents) -> None:
    if isinstance(record, Channel):
        topics[record.id] = record.topic
        result.channels[record.topic] = record.metadata
    elif isinstance(record, Metadata):
        result.metadata[record.name] = record.metadata
    elif isinstance(record, Attachment):
        result.attachments[record.name] = record.data
    elif isinstance(record, Footer):
        result.complete = True
