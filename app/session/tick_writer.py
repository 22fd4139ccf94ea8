"""Writes the loop's ticks into a record: a checkpoint first, then block after block."""

from collections.abc import Callable

from app.core import state_vector as slots
from app.core.arrays import FloatArray
from app.device.checkpoint import Checkpoint
from app.session import blocks, checkpoint_file
from app.session.header import SessionHeader
from app.session.mcap_file import McapFile

Rows = Callable[[int], FloatArray]
"""`Loop.rows`: rows of the history ring after a tick, shape (n, SLOTS)."""


class TickWriter:
    """Pulls the loop's rows and counts those that it came too late for.

    Args:
        rows: where ticks come from; None writes nothing.
        since_tick: last tick that does not belong to the record.
        start: the loop at that tick; None makes a record that cannot be replayed.

    Attributes:
        written: ticks written.
        lost: ticks overwritten in the ring before they were read.
    """

    def __init__(
        self, rows: Rows | None, since_tick: int = 0, start: Checkpoint | None = None
    ) -> None:
        self._rows = rows
        self._start = start
        self._tick = start.tick if start is not None else since_tick
        self.written = 0
        self.lost = 0

    def begin(self, file: McapFile, header: SessionHeader) -> None:
        """Write the checkpoint that the first row follows on."""
        if self._rows is not None and self._start is not None:
            message, self._start = checkpoint_file.pack(self._start), None
            file.message("/loop/checkpoint", header.nanoseconds(header.origin), message)

    def write(self, file: McapFile, header: SessionHeader) -> None:
        """Write the rows after the last one written; a gap in the tick numbers is a loss."""
        if self._rows is None:
            return
        self.begin(file, header)
        rows = self._rows(self._tick)
        rows = rows[rows[:, slots.TICK] > self._tick]
        if not len(rows):
            return
        lost = int(rows[0, slots.TICK]) - self._tick - 1
        file.message(
            "/loop/inputs",
            header.nanoseconds(float(rows[0, slots.TIME])),
            blocks.pack(rows, lost),
        )
        self._tick = int(rows[-1, slots.TICK])
        self.written += len(rows)
        self.lost += lost
