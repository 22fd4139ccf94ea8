"""Reads an MCAP file that may be cut off or damaged: a linear scan that keeps what is whole."""

import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import IO, Final

from mcap.exceptions import EndOfFile, McapError
from mcap.records import Attachment, Channel, Footer, McapRecord, Message, Metadata
from mcap.stream_reader import StreamReader
from mcap.writer import MCAP0_MAGIC
from zstandard import ZstdError

from app.session.errors import BrokenRecordingError

_FRAME: Final = struct.Struct("<BQ")


@dataclass(slots=True)
class Scan:
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


def scan(path: Path) -> Scan:
    """Read all records that are whole.

    Raises:
        BrokenRecordingError: if the file cannot be read or does not begin as an MCAP file.
    """
    result = Scan()
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


def _parse(frame: bytes, offset: int, problems: list[str]) -> list[McapRecord]:
    """Return the records of one frame; of a chunk, its messages."""
    records: list[McapRecord] = []
    try:
        for record in StreamReader(BytesIO(frame), skip_magic=True, validate_crcs=True).records:
            records.append(record)
    except EndOfFile:
        pass  # the frame's own end
    except (McapError, ZstdError, ValueError, struct.error, MemoryError, RuntimeError) as error:
        text = " ".join(str(error).split()) or type(error).__name__
        problems.append(f"the record at byte {offset} is damaged and left out: {text}")
        return []
    return records


def _sort(record: McapRecord, topics: dict[int, str], result: Scan) -> None:
    if isinstance(record, Channel):
        topics[record.id] = record.topic
        result.channels[record.topic] = record.metadata
    elif isinstance(record, Metadata):
        result.metadata[record.name] = record.metadata
    elif isinstance(record, Attachment):
        result.attachments[record.name] = record.data
    elif isinstance(record, Footer):
        result.complete = True
