"""The samples of an attempt as columns: an attachment that is read at once, whatever its length.

The same numbers stand in the record's JSON channels, sample by sample, for other programs and for
an attempt that was never finished; `acus session verify` compares the two. Layout: magic `ACUS`,
version u16, length of a JSON text u32, CRC-32 of what follows, the text, then the columns as
`session.columns` stores them; from the text on compressed (zstd). The text: `rows`, `fields` (array
of name, kind, columns) and `words` (of each field of text, its different words; its column holds
their numbers). Fields are found by name: what is not known is left out, and what is missing is not
known.
"""

import json
import struct
from dataclasses import MISSING, fields
from typing import Any, Final
from zlib import crc32

import numpy as np
import zstandard
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.session import columns
from app.session.budget import LONGEST_WORD, ReadingBudget, decompressed
from app.session.errors import BrokenRecordingError
from app.session.header import Attachment
from app.session.samples import Samples

SAMPLES_FILE: Final = "samples.acus"
"""Name of the attachment."""

MAGIC: Final = b"ACUS"
VERSION: Final = 1
_HEADER: Final = struct.Struct("<4sHII")
_UNREADABLE: Final = (
    *(zstandard.ZstdError, ValueError, LookupError),
    *(TypeError, RecursionError, MemoryError, OverflowError),
)


def attachment(samples: Samples) -> Attachment:
    """Return the samples as a file of the record."""
    return Attachment(SAMPLES_FILE, "application/octet-stream", pack(samples))


def pack(samples: Samples) -> bytes:
    """Return the samples as bytes."""
    known: list[tuple[str, str, int]] = []
    words: dict[str, list[str]] = {}
    parts: list[FloatArray] = []
    for field in fields(Samples):
        values = getattr(samples, field.name)
        if values is None:
            continue
        kind = {"U": "word", "b": "flag"}.get(values.dtype.kind, "number")
        if kind == "word":
            names, values = np.unique(values, return_inverse=True)
            words[field.name] = names.tolist()
        table = np.asarray(values, dtype=np.float64).reshape(len(samples.time), -1)
        known.append((field.name, kind, table.shape[1]))
        parts.append(table)
    rows = len(samples.time)
    text = json.dumps({"rows": rows, "fields": known, "words": words}).encode()
    body = text + (columns.encode(np.hstack(parts)) if rows else b"")
    packed = zstandard.compress(body)
    return _HEADER.pack(MAGIC, VERSION, len(text), crc32(packed)) + packed


def unpack(data: bytes, budget: ReadingBudget) -> Samples:
    """Read them back.

    Raises:
        BrokenRecordingError: if they cannot be read; says why.
        BudgetExceededError: if they hold more than a record of its size may.
    """
    if len(data) < _HEADER.size or data[:4] != MAGIC:
        raise BrokenRecordingError(
            sentence(
                "{samples_file} does not begin with {magic}",
                samples_file=SAMPLES_FILE,
                magic=MAGIC.decode(),
            )
        )
    _, version, length, checksum = _HEADER.unpack_from(data)
    if version != VERSION:
        raise BrokenRecordingError(
            sentence(
                "{samples_file} has version {version}, not {known_version}",
                samples_file=SAMPLES_FILE,
                version=version,
                known_version=VERSION,
            )
        )
    if crc32(data[_HEADER.size :]) != checksum:
        raise BrokenRecordingError(
            sentence(
                "{samples_file} is damaged: its checksum is another", samples_file=SAMPLES_FILE
            )
        )
    try:
        packed = data[_HEADER.size :]
        size = zstandard.frame_content_size(packed)  # -1 where it does not say: that is not ours
        budget.take(max(0, size))
        body = decompressed(packed, max(0, size))
        budget.take_json(body[:length])
        document = json.loads(body[:length])
        return _read(document, body[length:], budget)
    except BrokenRecordingError:  # also that it is too large
        raise
    except _UNREADABLE as error:
        raise BrokenRecordingError(
            sentence(
                "{samples_file} cannot be read: {error}", samples_file=SAMPLES_FILE, error=error
            )
        ) from error


def same(a: Samples, b: Samples) -> str:
    """Name the first field in which the samples of `a` are not those of `b`; empty if none.

    `a` may end before `b` does: then its samples are compared.
    """
    n = len(a.time)
    for field in fields(Samples):
        x, y = getattr(a, field.name), getattr(b, field.name)
        if x is None or y is None:
            continue
        if len(y) < n:
            return field.name
        if not np.array_equal(x, y[:n], equal_nan=x.dtype.kind == "f"):
            return field.name
    return ""


def _read(document: dict[str, Any], data: bytes, budget: ReadingBudget) -> Samples:
    rows, known = int(document["rows"]), document["fields"]
    count = sum(int(width) for _, _, width in known)
    if rows < 0 or min((int(w) for *_, w in known), default=0) < 0 or (rows and not data):
        raise ValueError(
            sentence(
                "{rows} rows of {columns} columns in {block_bytes} bytes",
                rows=rows,
                columns=count,
                block_bytes=len(data),
            )
        )
    budget.take(4 * LONGEST_WORD * rows * sum(kind == "word" for _, kind, _ in known))
    table = columns.decode(data, rows, count, budget)[0] if rows else np.zeros((0, count))
    values, at = {}, 0
    for name, kind, width in known:
        part = table[:, at : at + int(width)]
        values[str(name)] = _array(part, str(kind), document["words"].get(name, []))
        at += int(width)
    wanted = {field.name: field for field in fields(Samples)}
    missing = [n for n, f in wanted.items() if n not in values and f.default is MISSING]
    if missing:
        raise ValueError(sentence("it lacks {missing}", missing=", ".join(missing)))
    return Samples(**{name: value for name, value in values.items() if name in wanted})


def _array(part: FloatArray, kind: str, words: list[str]) -> NDArray[Any]:
    flat = part[:, 0] if part.shape[1] == 1 else part
    if kind == "word":
        if any(len(str(word)) > LONGEST_WORD for word in words):
            raise ValueError(
                sentence("a word of more than {longest_word} characters", longest_word=LONGEST_WORD)
            )
        texts = np.array([str(word) for word in words], dtype=np.str_)
        return read_only(texts[flat.astype(np.int64)] if len(flat) else texts[:0])
    if kind == "flag":
        return read_only(flat != 0.0)
    return read_only(np.ascontiguousarray(flat))
