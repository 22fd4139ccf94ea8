"""Deflated data sets: inflated no further than needed, so that no bomb fills the memory."""

import io
import zlib
from typing import BinaryIO

from app.core.messages import sentence
from app.imaging.errors import FileDamagedError

HEAD_BYTES = 1 << 24
"""A header must end within this much of the inflated data set."""

_CHUNK = 1 << 20


def inflated_head(stream: BinaryIO) -> BinaryIO:
    """Inflate the first `HEAD_BYTES` of a data set, `stream` standing where it starts.

    Raises:
        FileDamagedError: if it is not deflated data.
    """
    return io.BytesIO(Inflater(stream, stream.tell()).read_at(0, HEAD_BYTES))


class Inflater:
    """Bytes at ascending places of a deflated data set.

    Args:
        stream: the file; owned by the caller.
        start: byte in it at which the deflated data set starts.
    """

    def __init__(self, stream: BinaryIO, start: int) -> None:
        self._stream, self._at = stream, 0
        self._engine = zlib.decompressobj(-zlib.MAX_WBITS)
        stream.seek(start)

    def read_at(self, offset: int, count: int) -> bytes:
        """Return up to `count` bytes from `offset` on; fewer where the data set ends.

        Args:
            offset: not before what was read already.
            count: bytes.

        Raises:
            FileDamagedError: if it is not deflated data.
        """
        try:
            while self._at < offset and self._next(min(_CHUNK, offset - self._at)):
                pass
            parts, wanted = [], count
            while wanted and (part := self._next(min(_CHUNK, wanted))):
                parts.append(part)
                wanted -= len(part)
        except zlib.error as error:
            raise FileDamagedError(
                sentence(
                    "its data set is not deflated as its transfer syntax says, or damaged "
                    "({error})",
                    error=error,
                )
            ) from error
        return b"".join(parts)

    def _next(self, most: int) -> bytes:
        while not self._engine.eof:
            source = self._engine.unconsumed_tail or self._stream.read(_CHUNK)
            part = self._engine.decompress(source, most)
            if part or not source:
                self._at += len(part)
                return part
        return b""
