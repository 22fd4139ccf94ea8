"""The loop's ticks of a record: what each was given, and what to check a replay by."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.session import blocks, checkpoint_file
from app.session.blocks import TickBlock
from app.session.checkpoint_file import RecordedCheckpoint
from app.session.errors import BrokenRecordingError, BudgetExceededError
from app.session.scan import FileContents


@dataclass(frozen=True, slots=True, eq=False)
class Inputs:
    """The loop's inputs, encoder values and main outputs at the loop's rate.

    Attributes:
        columns: slot names.
        values: shape (n, len(columns)), read-only. NaN in `hand_*` while a scripted trainee acts.
        lost: rows that were overwritten before they could be recorded.
        slots: names of the slots of the program that recorded it.
        digests: of the whole state after each row, shape (n,); empty if some are missing.
        state_rows: rows whose whole state is recorded too, shape (k,).
        states: these states, shape (k, len(slots)), read-only.
        checkpoint: what the first row follows on; None if it cannot be read.
    """

    columns: tuple[str, ...]
    values: FloatArray
    lost: int
    slots: tuple[str, ...] = ()
    digests: NDArray[np.uint32] = field(default_factory=lambda: np.zeros(0, dtype=np.uint32))
    state_rows: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    states: FloatArray = field(default_factory=lambda: np.zeros((0, 0)))
    checkpoint: RecordedCheckpoint | None = None

    def column(self, name: str) -> FloatArray:
        """Return one slot over time, shape (n,).

        Raises:
            BrokenRecordingError: if the record has no such slot.
        """
        if name not in self.columns:
            raise BrokenRecordingError(
                sentence(
                    "no slot {name!r} in this record; it has {columns}",
                    name=name,
                    columns=", ".join(self.columns),
                )
            )
        result: FloatArray = self.values[:, self.columns.index(name)]
        return result

    def gaps(self) -> tuple[tuple[int, int], ...]:
        """Return (first tick, count) of every stretch of ticks that is missing between rows."""
        tick = self.column("tick").astype(np.int64) if len(self.values) else np.zeros(0, np.int64)
        at = np.flatnonzero(np.diff(tick) != 1)
        return tuple((int(tick[k]) + 1, int(tick[k + 1] - tick[k]) - 1) for k in at)


def read_inputs(content: FileContents, problems: list[str]) -> Inputs:
    """Read all blocks of a record; what cannot be read is told in `problems`.

    Raises:
        BudgetExceededError: if they hold more than a record of its size may.
    """
    channel = content.channels.get("/loop/inputs", {})
    columns = _names(channel.get("slots", "")) or blocks.COLUMNS
    slots = _names(channel.get("state", ""))
    parts = _blocks(content, len(columns), problems)
    checked = bool(slots) and all(len(part.digests) == len(part.values) for part in parts)
    whole = [(row, p) for row, p in _starts(parts) if p.states.shape[1] == len(slots) > 0]
    return Inputs(
        columns=columns,
        values=read_only(_joined([part.values for part in parts], (0, len(columns)))),
        lost=sum(part.lost for part in parts),
        slots=slots,
        digests=np.concatenate([p.digests for p in parts]) if parts and checked else _none(),
        state_rows=_rows([row + part.state_rows for row, part in whole]),
        states=read_only(_joined([part.states for _, part in whole], (0, len(slots)))),
        checkpoint=_checkpoint(content, problems),
    )


def _blocks(content: FileContents, columns: int, problems: list[str]) -> list[TickBlock]:
    parts = []
    for data in content.messages.get("/loop/inputs", []):
        try:
            block = blocks.unpack(data, content.budget)
        except BudgetExceededError:
            raise
        except BrokenRecordingError as error:
            problems.append(str(error))
            continue
        if block.values.shape[1] == columns:
            parts.append(block)
        else:
            problems.append(f"a block of {block.values.shape[1]} columns instead of {columns}")
    return parts


def _starts(parts: list[TickBlock]) -> list[tuple[int, TickBlock]]:
    ends = np.cumsum([len(part.values) for part in parts]).tolist()
    return [(end - len(part.values), part) for end, part in zip(ends, parts, strict=True)]


def _checkpoint(content: FileContents, problems: list[str]) -> RecordedCheckpoint | None:
    for data in content.messages.get("/loop/checkpoint", []):
        try:
            return checkpoint_file.unpack(data)
        except BrokenRecordingError as error:
            problems.append(str(error))
    return None


def _names(text: str) -> tuple[str, ...]:
    return tuple(text.split(",")) if text else ()


def _joined(parts: list[FloatArray], empty: tuple[int, int]) -> FloatArray:
    return np.concatenate(parts) if parts else np.empty(empty)


def _rows(parts: list[NDArray[np.int64]]) -> NDArray[np.int64]:
    return np.concatenate(parts) if parts else np.zeros(0, dtype=np.int64)


def _none() -> NDArray[np.uint32]:
    return np.zeros(0, dtype=np.uint32)
