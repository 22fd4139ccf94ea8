"""Recorded ticks once more: the same compiled stages, fed with what was recorded, in virtual time.

Nothing is read from a clock, an inbox or a wire. What a tick was given is written into the state,
the stages run, and the whole state is kept: from the same checkpoint the same build gives the same
bits.
"""

from collections.abc import Sequence
from math import isfinite
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.checkpoint import Checkpoint
from app.device.control import kernel
from app.device.control.kernel import PARAMETERS, ROWS, STAGES, compiled, run_stages
from app.device.control.table import Stage, Table
from app.device.errors import RerunError

from numba import types  # isort: skip  (after core.compiled)


@compiled(types.void(types.float64[::1], STAGES, PARAMETERS, types.int64[::1], ROWS, ROWS))
def rerun_kernel(
    state: Any, stages: Any, parameters: Any, slots: Any, given: Any, rows: Any
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

    Raises:
        RerunError: if the table does not fit the checkpoint; says which stage.
    """

    def __init__(self, table: Table, checkpoint: Checkpoint, slots: Sequence[str]) -> None:
        self._slots = np.array([_slot(name) for name in slots], dtype=np.int64)
        self._state = np.array(checkpoint.state, dtype=np.float64)
        if self._state.shape != (sv.SLOTS,):
            raise RerunError(
                f"the checkpoint's state has {self._state.size} slots, this program's {sv.SLOTS}"
            )
        self._stages, self._parameters = kernel.no_stages(), kernel.no_parameters()
        for stage, values in _memories(table, checkpoint):
            kernel.append(self._stages, self._parameters, stage.function, values)

    def run(self, given: FloatArray) -> FloatArray:
        """Run n ticks on their inputs, shape (n, slots); returns their states, (n, SLOTS)."""
        rows = np.empty((len(given), sv.SLOTS))
        values = np.ascontiguousarray(given, dtype=np.float64)
        rerun_kernel(self._state, self._stages, self._parameters, self._slots, values, rows)
        return rows


def _slot(name: str) -> int:
    if name not in sv.INDEX:
        raise RerunError(f"this program's state has no slot {name!r}, which the record gives")
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
    for stage in table:
        while left and left[0][0] != stage.name:
            left.pop(0)
        if not left:
            raise RerunError(
                f"the record has no stage {stage.name!r} in this place; its stages are "
                f"{', '.join(checkpoint.names)}"
            )
        values = np.array(left.pop(0)[1])
        if len(values) != len(stage.parameters):
            raise RerunError(
                f"stage {stage.name!r} has {len(values)} numbers in the record and "
                f"{len(stage.parameters)} in this program: another version recorded it"
            )
        pairs.append((stage, shared.setdefault(id(stage.parameters), values)))
    return pairs
