"""What reading a record may take, counted as it is read: nothing is made before it is paid for.

A few bytes of a record can stand for gigabytes: chunks and columns are compressed, JSON of empty
lists takes thirty times its text as values. So the reader says before each step how much memory
that will take, and gives up where the sum exceeds what a file of this size may ever need. The
ceiling is the one of every foreign file (`imaging.worker.limits`): 2 GiB, more only for a long
record and where the machine has it free. Memory that was counted bounds the time as well.
"""

from pathlib import Path
from typing import Final

from zstandard import ZstdDecompressor, ZstdError

from app.core.messages import sentence
from app.imaging.worker.limits import MEMORY_BYTES, size_of
from app.session.errors import BudgetExceededError

LEAST_BYTES: Final = 1 << 27
"""What the smallest record may take [bytes]."""

BYTES_PER_BYTE: Final = 150
"""What a record may take beside that for each of its own bytes; those of an attempt take up to 90,
where nothing moves."""

OBJECT_BYTES: Final = 200
"""A message, or a value of JSON, beside its text [bytes]."""

RECORD_BYTES: Final = 4096
"""What a record costs that stands in the file by itself, in memory or time [bytes]: the least has
nine, and an attempt has sixteen of them in a second."""

LONGEST_WORD: Final = 64
"""A state, or the source of a depth, has fewer characters; columns are as wide as the longest."""


class ReadingBudget:
    """What is left of what may be taken.

    Args:
        name: of the file, for messages.
        size: of the file [bytes].
    """

    def __init__(self, name: str, size: int) -> None:
        self._name = name
        self._size = size
        self._allowed = self._left = allowed_bytes(size)

    @classmethod
    def of(cls, path: Path) -> "ReadingBudget":
        """Return the budget of a file on the disk."""
        return cls(path.name, size_of(path))

    def take(self, count: int) -> None:
        """Count what is about to be made [bytes].

        Raises:
            BudgetExceededError: if it is more than is left; names the file, its size and what it
                may take.
        """
        self._left -= count
        if self._left < 0:
            raise BudgetExceededError(
                sentence(
                    "{name} has {size:.1f} MB and would take more than "
                    "{allowed:.0f} MB of memory to be read, which no attempt does: it is "
                    "damaged or hostile; move it out of the folder",
                    name=self._name,
                    size=self._size / 1e6,
                    allowed=self._allowed / 1e6,
                )
            )

    def take_json(self, text: bytes) -> None:
        """Count a text that is about to be read as JSON: at most one value for each separator.

        Raises:
            BudgetExceededError: as `take`.
        """
        values = 1 + sum(map(text.count, (b",", b"[", b"{", b":")))
        self.take(len(text) + OBJECT_BYTES // 2 * values)


def allowed_bytes(size: int) -> int:
    """Return how much memory a record of this size may take [bytes]."""
    most = LEAST_BYTES + BYTES_PER_BYTE * size
    if most <= MEMORY_BYTES:
        return most
    from app.imaging.memory import SHARE, available

    free = available()
    return most if free is None else min(most, max(MEMORY_BYTES, int(SHARE * free)))


def decompressed(data: bytes, most: int) -> bytes:
    """Decompress zstd, and no more of it than was paid for.

    Args:
        data: one frame.
        most: bytes that it may hold.

    Raises:
        ZstdError: if it is damaged, or holds more.
    """
    reader = ZstdDecompressor(max_window_size=1 << 27).stream_reader(data)
    found = bytes(reader.read(most))
    if reader.read(1):
        raise ZstdError(sentence("it holds more than the {most} bytes that it should", most=most))
    return found
