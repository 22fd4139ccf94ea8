"""Checkpoints of a loop: taken between two ticks, and continued from in virtual time.

They are asked for with a buffer and two counters, and no lock in the loop. A rerun reads nothing
from a clock, an inbox or a wire: what a tick was given is written into the state, the same compiled
stages run, and the whole state is kept. From the same checkpoint the same build gives the same
bits.
"""

import threading
import time
from collections.abc import Callable, Sequence
from math import isfinite
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, IntArray
from app.core.messages import sentence
from app.core.parameters import Stage
from app.device.checkpoint import ADDRESSED, Checkpoint
from app.device.control import kernel
from app.device.control.kernel import (
    ANSWERED,
    ASKED,
    PARAMETERS,
    ROWS,
    STAGES,
    ArrayList,
    StageList,
    compiled,
    run_stages,
)
from app.device.control.table import AROUND_MACHINE, SCRATCH, SINCE, WITHOUT_MEMORY, Table
from app.device.errors import LoopError, RerunError

from numba import types  # isort: skip  (after core.compiled)


_PATIENCE: Final = 1.0
_POLL: Final = 0.0005


class CheckpointRequests:
    """Asks the kernel for checkpoints of one table.

    Args:
        counters: of the loop's history.
        table: its stages.

    Attributes:
        buffer: what the kernel writes: the state, then every stage's array, shape (n,).
    """

    def __init__(self, counters: IntArray, table: Table) -> None:
        self.buffer: FloatArray = np.zeros(sv.SLOTS + sum(len(s.parameters) for s in table))
        self._counters = counters
        self._table = table
        self._lock = threading.Lock()

    def checkpoint(self, idle: tuple[FloatArray, ArrayList] | None) -> Checkpoint:
        """Return a checkpoint, taken by the kernel between two ticks.

        Args:
            idle: state and packed parameters of a loop that nobody runs at the moment; None of one
                that a thread runs, which answers after its present tick.

        Raises:
            LoopError: if the loop does not answer within a second.
        """
        with self._lock:
            self._counters[ASKED] += 1
            if idle is not None:
                kernel.answer_now(*idle, self._counters, self.buffer)
            self._await_answer()
            return Checkpoint.of(self.buffer, self._table)

    def _await_answer(self) -> None:
        end = time.monotonic() + _PATIENCE
        while self._counters[ANSWERED] != self._counters[ASKED]:
            if time.monotonic() > end:
                raise LoopError(
                    sentence(
                        "the loop has not answered within {patience:g} s: it does not tick",
                        patience=_PATIENCE,
                    )
                )
            time.sleep(_POLL)


@compiled(types.void(types.float64[::1], STAGES, PARAMETERS, types.int64[::1], ROWS, ROWS))
def rerun_kernel(
    state: FloatArray,
    stages: StageList,
    parameters: ArrayList,
    slots: IntArray,
    given: FloatArray,
    rows: FloatArray,
) -> None:
    """Run one tick per row of `given`, whose columns go into `slots`; the states go into `rows`.

    An input that is not finite was not given: a stage of the tick (the scripted trainee) writes it.
    """
    for k in range(given.shape[0]):
        for j in range(len(slots)):
            value = given[k, j]
            if slots[j] >= sv.INPUTS or isfinite(value):
                state[slots[j]] = value
        run_stages(state, stages, parameters)
        for slot in range(sv.SLOTS):
            rows[k, slot] = state[slot]


class Rerun:
    """A table that continues from a checkpoint, tick by tick, on recorded inputs.

    Args:
        table: the stages; those that the checkpoint has beyond them (a wire's) are left out.
        checkpoint: where it continues from. Constants are taken from it as well as memory.
        slots: names of what every tick is given.

    Attributes:
        table: the stages with the memory that they have now.

    Raises:
        RerunError: if the table does not fit the checkpoint; says which stage.
    """

    def __init__(self, table: Table, checkpoint: Checkpoint, slots: Sequence[str]) -> None:
        self._given = [table]  # keeps what arrays say the address of
        self._slots = np.array([_slot(name) for name in slots], dtype=np.int64)
        self._state = np.array(checkpoint.state, dtype=np.float64)
        if self._state.shape != (sv.SLOTS,):
            raise RerunError(
                sentence(
                    "the checkpoint's state has {state_size} slots, this program's {sv_slots}",
                    state_size=self._state.size,
                    sv_slots=sv.SLOTS,
                )
            )
        self.table = Table.of(
            Stage(stage.name, stage.function, values)
            for stage, values in _memories(table, checkpoint)
        )
        self._pack()

    def exchange(self, table: Table, carry: Callable[[], None]) -> None:
        """Go on with another table, as `Loop.exchange` does."""
        carry()
        self._given.append(table)
        self.table = table
        self._pack()

    def _pack(self) -> None:
        self._stages, self._parameters = kernel.no_stages(), kernel.no_parameters()
        for stage in self.table:
            kernel.append(self._stages, self._parameters, stage.function, stage.parameters)

    def run(self, given: FloatArray) -> FloatArray:
        """Run n ticks on their inputs, shape (n, slots); returns their states, (n, SLOTS)."""
        rows = np.empty((len(given), sv.SLOTS))
        values = np.ascontiguousarray(given, dtype=np.float64)
        rerun_kernel(self._state, self._stages, self._parameters, self._slots, values, rows)
        return rows


def _slot(name: str) -> int:
    if name not in sv.INDEX:
        raise RerunError(
            sentence("this program's state has no slot {name!r}, which the record gives", name=name)
        )
    return sv.INDEX[name]


def _memories(table: Table, checkpoint: Checkpoint) -> list[tuple[Stage, FloatArray]]:
    """Pair every stage with a copy of its array in the checkpoint, by name, in order.

    Stages that share one array share its copy.
    """
    ends = np.cumsum((0, *checkpoint.sizes))
    left = [
        (name, checkpoint.parameters[start:end])
        for name, start, end in zip(checkpoint.names, ends[:-1], ends[1:], strict=True)
    ]
    pairs: list[tuple[Stage, FloatArray]] = []
    shared: dict[int, FloatArray] = {}
    around = {name for names in AROUND_MACHINE.values() for name in names}
    for stage in table:
        if stage.name in around:  # what they hold is of one tick, and of this program
            values = stage.parameters.copy()
            pairs.append((stage, shared.setdefault(id(stage.parameters), values)))
            continue
        if stage.name in WITHOUT_MEMORY and stage.name not in checkpoint.names:
            pairs.append((stage, stage.parameters.copy()))  # from before machines had stages
            continue
        if stage.name in SINCE and stage.name not in checkpoint.names:
            continue
        while left and left[0][0] != stage.name:
            left.pop(0)
        if not left:
            raise RerunError(
                sentence(
                    "the record has no stage {stage_name!r} in this place; its stages are "
                    "{checkpoint_names}",
                    stage_name=stage.name,
                    checkpoint_names=", ".join(checkpoint.names),
                )
            )
        values = _as_now(stage.name, np.array(left.pop(0)[1]))
        if stage.name in SCRATCH:  # as large as the state, which may have grown since
            values = np.zeros_like(stage.parameters)
        if len(values) != len(stage.parameters):
            raise RerunError(
                sentence(
                    "stage {stage_name!r} has {recorded_numbers} numbers in the record and "
                    "{expected_numbers} in this program: another version recorded it",
                    stage_name=stage.name,
                    recorded_numbers=len(values),
                    expected_numbers=len(stage.parameters),
                )
            )
        values[: ADDRESSED.get(stage.name, 0)] = stage.parameters[: ADDRESSED.get(stage.name, 0)]
        pairs.append((stage, shared.setdefault(id(stage.parameters), values)))
    return pairs


# Arrays of stages as older records hold them: before machines had stages of their own, kinematics,
# governor, plant and the laws that know the dynamics began with, or ended in, numbers of the
# pantograph, which was the only machine. They now stand in the machine's own stages, made from the
# profile that the record has attached; all else, memory included, goes over as it was.
# `tests/data/records-machines` are such records.

_MODEL: Final = 21
"""Numbers of the pantograph's dynamic model, as it stood in arrays."""

_CENTRE, _WEIGHT, _COULOMB, _VISCOUS = (3, 4, 5), (15, 16, 17), 18, 19
_NEEDLE_MASS, _NEEDLE_OFFSET = 12, 14
"""Places in it: remote centre, gravity, friction of the joints, the needle."""

_PLANT: Final = (
    *range(_MODEL, _MODEL + 17),
    *(*_CENTRE, _COULOMB, _VISCOUS, *_WEIGHT, _NEEDLE_MASS, _NEEDLE_OFFSET),
    *range(_MODEL + 17, _MODEL + 26),
    *range(_MODEL),
)
_IMPEDANCE: Final = (*range(8), *(15 + place for place in _CENTRE), *range(8, 15))
_COMPENSATION: Final = (
    *range(5),
    *(7 + place for place in (_COULOMB, _VISCOUS, _NEEDLE_MASS, _NEEDLE_OFFSET, *_WEIGHT)),
    *(5, 6),
)

_BEFORE: Final[dict[tuple[str, int], tuple[int, ...]]] = {
    ("kinematics", 14): tuple(range(3, 14)),
    ("governor", 125): tuple(range(7, 125)),
    ("plant", _MODEL + 26): _PLANT,
    ("impedance", 15 + _MODEL): _IMPEDANCE,
    ("compensation", 7 + _MODEL): _COMPENSATION,
}
"""Stage and length of its array then -> which of its numbers the array has now, in order."""


def _as_now(name: str, values: FloatArray) -> FloatArray:
    """Return a stage's array of a record as this program has it; one of today's as it is."""
    order = _BEFORE.get((name, len(values)))
    return values if order is None else values[np.array(order)]
