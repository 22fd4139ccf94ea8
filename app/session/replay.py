"""A recorded attempt computed once more, and compared with its record to the last bit.

The loop starts from the record's checkpoint and is given, tick by tick, what was recorded: inputs,
time and, of a real robot, what its wire read. Everything else is computed: of a simulated robot
also the plant and so the encoders. Compared is every slot of the state, by a digest per tick; the
main outputs by their values in every tick; all by their values twice a second. Not compared is
`TICK_COST`, the time that a tick took; `LATENESS` and `MISSED` are measured too and are given.
"""

from collections.abc import Callable, Iterator
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.build import BUILD, build, changes
from app.session.blocks import CLOCK, INPUTS, SLOT_NAMES, WIRE
from app.session.comparison import Comparison
from app.session.errors import ReplayError
from app.session.recording import Recording
from app.session.replay_report import ReplayReport
from app.session.ticks import Inputs

TableOf = Callable[[Recording], Any]
"""Builds the loop's table (`device.control.Table`) of a recorded attempt: `compose` knows how."""

_CHUNK: Final = 4096


def is_simulated(recording: Recording) -> bool:
    """Whether the record's robot is simulated, so that its encoders can be recomputed."""
    return recording.metadata.get("device", {}).get("simulated") == "yes"


def given_slots(recording: Recording) -> tuple[str, ...]:
    """Names of what a tick of this record is given; the rest is computed."""
    return (*INPUTS, *CLOCK, *(() if is_simulated(recording) else WIRE))


def replay(recording: Recording, table_of: TableOf) -> ReplayReport:
    """Recompute an attempt and say where it first differs from its record.

    Raises:
        ReplayError: if the record cannot be replayed; says why.
        AcusError: if the table cannot be built from the record's attachments.
    """
    inputs = recording.inputs
    rows = _replayable(inputs)
    given = given_slots(recording)
    comparison = Comparison(inputs, given)
    for first, states in _states(recording, table_of, given, rows):
        comparison.look(first, states)
    changed = changes(recording.metadata.get(BUILD, {}), build())
    return ReplayReport(
        session=recording.id,
        ticks=rows,
        seconds=float(inputs.column("dt")[:rows].sum()),
        recorded_ticks=len(inputs.values),
        first_difference=comparison.first,
        largest_difference=comparison.largest,
        every_slot=comparison.every_slot,
        changes=changed,
        gaps=inputs.gaps(),
    )


def why_not(inputs: Inputs) -> str:
    """Return why a record cannot be replayed; empty if it can."""
    if inputs.checkpoint is None:
        return (
            "it holds no checkpoint of the loop: it was recorded by an older version, or its "
            "beginning is damaged"
        )
    if not len(inputs.values):
        return "it holds no tick of the loop"
    tick, start = int(inputs.column("tick")[0]), inputs.checkpoint.checkpoint.tick
    if tick != start + 1:
        return f"ticks {start + 1} to {tick - 1} are missing at its beginning"
    missing = set(inputs.checkpoint.slots) ^ set(SLOT_NAMES)
    if missing:
        return f"its program's state had other slots than this one's: {', '.join(sorted(missing))}"
    return ""


def _replayable(inputs: Inputs) -> int:
    """Count the rows up to the first gap, or up to the loop's end (a row without a step)."""
    reason = why_not(inputs)
    if reason:
        raise ReplayError(f"this record cannot be replayed: {reason}")
    tick, dt = inputs.column("tick"), inputs.column("dt")
    stops = np.flatnonzero((np.diff(tick, prepend=tick[0] - 1.0) != 1.0) | (dt == 0.0))
    return int(stops[0]) if len(stops) else len(tick)


def _states(
    recording: Recording, table_of: TableOf, given: tuple[str, ...], rows: int
) -> Iterator[tuple[int, FloatArray]]:
    """Recompute the ticks in pieces: number of the first row, and states, shape (n, SLOTS)."""
    from app.device.control.checkpoints import Rerun  # compiles or loads kernels

    inputs = recording.inputs
    recorded = inputs.checkpoint
    if recorded is None:
        raise ReplayError(f"this record cannot be replayed: {why_not(inputs)}")
    values = inputs.values[:, [inputs.columns.index(name) for name in given]]
    rerun = Rerun(table_of(recording), recorded.in_order_of(SLOT_NAMES), given)
    for first in range(0, rows, _CHUNK):
        yield first, rerun.run(values[first : min(first + _CHUNK, rows)])
