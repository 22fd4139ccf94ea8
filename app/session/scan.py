"""Reads an MCAP file that may be cut off, damaged or hostile.

A linear scan keeps what is whole. Whatever is unpacked is paid for before (`session.budget`).
"""

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import IO, Final, NamedTuple
from zlib import crc32

from mcap.data_stream import ReadDataStream
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
from zstandard import ZstdError

from app.core.configuration import LARGEST_FILE
from app.core.errors import reading
from app.core.messages import sentence
from app.session.budget import OBJECT_BYTES, RECORD_BYTES, ReadingBudget, decompressed
from app.session.errors import BrokenRecordingError
from app.session.header import TISSUE_FILE
from app.session.sample_columns import SAMPLES_FILE

LARGEST_FIELD: Final = 16 << 20
"""No attached tissue field is larger, packed [bytes]."""

_FRAME: Final = struct.Struct("<BQ")
_FOOTER: Final = 9 + 20
_MESSAGE: Final = struct.Struct("<HIQQ")
_UNREADABLE: Final = (
    *(McapError, ZstdError, ValueError, LookupError, struct.error),
    *(MemoryError, RuntimeError, OverflowError),
)
_MOST_DAMAGED: Final = 100
"""A file with more damaged records is given up there: no fault of a disk makes so many."""


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
        budget: what whoever reads on in it may take.
    """

    budget: ReadingBudget
    metadata: dict[str, dict[str, str]] = field(default_factory=dict)
    attachments: dict[str, bytes] = field(default_factory=dict)
    messages: dict[str, list[bytes]] = field(default_factory=dict)
    channels: dict[str, dict[str, str]] = field(default_factory=dict)
    complete: bool = False
    problems: list[str] = field(default_factory=list)


def scan(path: Path) -> FileContents:
    """Read all records that are whole.

    Raises:
        BrokenRecordingError: if the file cannot be read, does not begin as an MCAP file, or takes
            more than a file of its size may.
    """
    result = FileContents(ReadingBudget.of(path))
    topics: dict[int, str] = {}
    payloads: dict[int, list[bytes]] = {}
    with reading(path, BrokenRecordingError):
        size = path.stat().st_size
        with path.open("rb") as stream:
            _check_magic(stream, path)
            for record in _records(stream, size, result):
                if isinstance(record, ChunkedMessage | Message):
                    payloads.setdefault(record.channel_id, []).append(record.data)
                else:
                    _sort(record, topics, result)
    # Only now: the index at the end repeats the channels, should the first chunk be damaged.
    result.messages = {topics[i]: data for i, data in payloads.items() if i in topics}
    return result


def scan_by_index(path: Path, topic: str) -> FileContents | None:
    """Read metadata, attachments and the messages of one topic by the index at the file's end.

    The length of the attempt then hardly matters. None where the file was not finished or anything
    of this is not as it should be: then `scan` says what. Damage to other messages is not seen.

    Raises:
        BrokenRecordingError: if the file cannot be read, or takes more than a file of its size may.
    """
    try:
        with path.open("rb") as stream:
            return _indexed(stream, path, topic)
    except OSError as error:
        raise BrokenRecordingError(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    except (_UnsoundError, *_UNREADABLE):
        return None


class ChunkedMessage(NamedTuple):
    """A message out of a chunk: its channel and what it says."""

    channel_id: int
    data: bytes


class _UnsoundError(Exception):
    """The index, or something that it points to, is not as it should be."""


def _indexed(stream: IO[bytes], path: Path, topic: str) -> FileContents:
    summary = _summary(stream, path.stat().st_size)
    result, ids = FileContents(ReadingBudget.of(path), complete=True), []
    for record in summary:
        if isinstance(record, Channel):
            result.channels[record.topic] = record.metadata
            if record.topic == topic:
                ids.append(record.id)
    messages = result.messages[topic] = []
    for record in summary:
        if isinstance(record, AttachmentIndex | MetadataIndex):
            for found in _at(stream, record.offset, record.length, result.budget):
                _sort(found, {}, result)
        elif isinstance(record, ChunkIndex) and any(i in record.message_index_offsets for i in ids):
            place, length = record.chunk_start_offset, record.chunk_length
            for found in _at(stream, place, length, result.budget):
                if isinstance(found, Chunk):
                    parts = _chunked(found, result.budget, frozenset(ids))
                    messages += [part.data for part in parts if isinstance(part, ChunkedMessage)]
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


def _at(stream: IO[bytes], offset: int, length: int, budget: ReadingBudget) -> list[McapRecord]:
    """Read what an index points to; it may point to the same again and again."""
    stream.seek(offset)
    data = stream.read(length)
    budget.take(len(data) + RECORD_BYTES)
    return _parsed(data)


def _parsed(data: bytes) -> list[McapRecord]:
    problems: list[str] = []
    records = _parse(data, 0, problems)
    if problems or not records:
        raise _UnsoundError
    return records


def _chunked(
    chunk: Chunk, budget: ReadingBudget, ids: frozenset[int] | None = None
) -> Iterator[Channel | ChunkedMessage]:
    """Yield channels and messages of a chunk; with `ids` those of some channels only."""
    data = _unpacked(chunk, budget)
    place = 0
    while place < len(data):
        opcode, length = _FRAME.unpack_from(data, place)
        body = place + _FRAME.size
        place = body + length
        if place > len(data):
            raise ValueError(sentence("a record in it is cut off"))
        if opcode == Opcode.MESSAGE:
            channel_id = _MESSAGE.unpack_from(data, body)[0]
            if ids is None or channel_id in ids:
                text = data[body + _MESSAGE.size : place]
                budget.take(OBJECT_BYTES + len(text))
                yield ChunkedMessage(channel_id, text)
        elif opcode == Opcode.CHANNEL and ids is None:
            budget.take(RECORD_BYTES + length)
            yield Channel.read(ReadDataStream(BytesIO(data[body:place])))


def _unpacked(chunk: Chunk, budget: ReadingBudget) -> bytes:
    """Return what a chunk holds, never more than it says that it does."""
    data, size = chunk.data, chunk.uncompressed_size
    if chunk.compression == "zstd":
        budget.take(size)
        data = decompressed(data, size)
    elif chunk.compression:
        raise ValueError(
            sentence(
                "a chunk is compressed by {chunk_compression!r}, not zstd",
                chunk_compression=chunk.compression[:20],
            )
        )
    if len(data) != size:
        raise ValueError(sentence("a chunk does not hold the {size} bytes that it says", size=size))
    if chunk.uncompressed_crc and crc32(data) != chunk.uncompressed_crc:
        raise ValueError(sentence("its crc is another"))
    return data


def _check_magic(stream: IO[bytes], path: Path) -> None:
    magic = stream.read(len(MCAP0_MAGIC))
    if magic != MCAP0_MAGIC:
        found = magic.hex(" ") or "nothing"
        raise BrokenRecordingError(
            sentence(
                "{path_name} is not an MCAP file: it begins with {first_bytes}",
                path_name=path.name,
                first_bytes=found,
            )
        )


def _records(
    stream: IO[bytes], size: int, result: FileContents
) -> Iterator[McapRecord | ChunkedMessage]:
    """Frame by frame; a frame that is not whole ends the file, one that is damaged is skipped."""
    problems = result.problems
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
        result.budget.take(RECORD_BYTES)
        for record in _parse(head + stream.read(length), offset, problems):
            if isinstance(record, Chunk):
                yield from _whole_chunk(record, offset, result)
            else:
                yield record
            if isinstance(record, Footer):
                return
        if len(problems) > _MOST_DAMAGED:
            problems.append(f"what follows byte {stream.tell()} is left out: too much is damaged")
            return


def _whole_chunk(chunk: Chunk, offset: int, result: FileContents) -> list[Channel | ChunkedMessage]:
    """Return all of a chunk, or nothing of one that is damaged."""
    try:
        return list(_chunked(chunk, result.budget))
    except _UNREADABLE as error:
        result.problems.append(_damaged(offset, error))
        return []


def _parse(frame: bytes, offset: int, problems: list[str]) -> list[McapRecord]:
    """Return the records of one frame; a chunk as it is."""
    records: list[McapRecord] = []
    try:
        reader = StreamReader(BytesIO(frame), skip_magic=True, emit_chunks=True, validate_crcs=True)
        for record in reader.records:
            records.append(record)
    except EndOfFile:
        pass  # the frame's own end
    except _UNREADABLE as error:
        problems.append(_damaged(offset, error))
        return []
    return records


def _damaged(offset: int, error: Exception) -> str:
    text = " ".join(str(error).split()) or type(error).__name__
    return sentence(
        "the record at byte {offset} is damaged and left out: {fault}", offset=offset, fault=text
    )


def _sort(record: McapRecord, topics: dict[int, str], result: FileContents) -> None:
    if isinstance(record, Channel):
        topics[record.id] = record.topic
        result.channels[record.topic] = record.metadata
    elif isinstance(record, Metadata):
        result.metadata[record.name] = record.metadata
    elif isinstance(record, Attachment):
        most = LARGEST_FIELD if record.name == TISSUE_FILE else LARGEST_FILE
        if len(record.data) > most and record.name != SAMPLES_FILE:
            name, size = record.name[:40], len(record.data) / 1e6
            result.problems.append(
                f"the attached file {name} is left out: it has {size:.1f} MB, "
                f"{most >> 20} MB are the most"
            )
        else:
            result.attachments[record.name] = record.data
    elif isinstance(record, Footer):
        result.complete = True
