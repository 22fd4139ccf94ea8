"""What a tick is: inputs in, the stages in order, one row of history out. All compiled.

State crosses threads through arrays only. `inbox` and `sequence` form a sequence lock with one
writer at a time (odd while a write is in progress); `ring` is a history of whole states, whose row
is written before `counters[HEAD]` says so. A checkpoint is asked for and answered by two counters:
the loop copies everything that the next tick depends on between two ticks, and nobody waits for it.
"""

import warnings
from collections.abc import Callable, MutableSequence
from math import isfinite
from typing import Any, Final

from app.core import state_vector as sv
from app.core.arrays import FloatArray, IntArray
from app.core.compiled import STAGE_TYPE, njit
from app.core.parameters import StageFunction

from numba import types  # isort: skip  (after core.compiled, which sets the cache folder)
from numba.core.errors import NumbaExperimentalFeatureWarning  # isort: skip
from numba.extending import intrinsic  # isort: skip
from numba.typed import List  # isort: skip


@intrinsic
def _fence(typing_context: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        builder.fence("seq_cst")
        return context.get_dummy_value()

    return types.void(), generate


@njit
def fence() -> None:
    """Order all reads and writes before this line against all after it, on every processor."""
    _fence()


StageList = MutableSequence[StageFunction]
ArrayList = MutableSequence[FloatArray]
"""Numba's typed lists of stages and of their parameters, as the program's Python side sees them."""

HEAD: Final = 0
STOP: Final = 1
MISSED: Final = 2
ASKED: Final = 3
ANSWERED: Final = 4
RUNNING: Final = 5
EXCHANGE: Final = 6
COUNTERS: Final = 7
"""Entries of `counters` (int64): rows published, request to stop, deadlines missed, checkpoints
asked for and taken, number of the stage that runs now (from 1; 0 between two ticks), request to
give the table back for an exchange."""

_FLOATS = types.float64[::1]
_INTEGERS = types.int64[::1]
STAGES = types.ListType(STAGE_TYPE)
PARAMETERS = types.ListType(_FLOATS)
ROWS = types.float64[:, ::1]
TICK_TYPES = (_FLOATS, STAGES, PARAMETERS, _FLOATS, _FLOATS, _INTEGERS, ROWS, _INTEGERS, _FLOATS)
"""Types of (state, stages, parameters, inbox, scratch, sequence, ring, counters, checkpoint)."""


def compiled(signature: Any) -> Callable[[Any], Any]:
    """Compile now, for one signature, without numba's notice that tables of functions are new."""

    def decorate(function: Any) -> Any:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", NumbaExperimentalFeatureWarning)
            return njit(signature)(function)

    return decorate


@compiled(STAGES())
def no_stages() -> StageList:
    """Return an empty list of stages."""
    return List.empty_list(STAGE_TYPE)


@compiled(PARAMETERS())
def no_parameters() -> ArrayList:
    """Return an empty list of parameter arrays."""
    return List.empty_list(_FLOATS)


@compiled(types.void(STAGES, PARAMETERS, STAGE_TYPE, _FLOATS))
def append(
    stages: StageList, parameters: ArrayList, function: StageFunction, values: FloatArray
) -> None:
    """Add a stage with its parameters."""
    stages.append(function)
    parameters.append(values)


@compiled(types.void(_FLOATS, _INTEGERS, types.int64[::1], _FLOATS))
def post(inbox: FloatArray, sequence: IntArray, slots: IntArray, values: FloatArray) -> None:
    """Write some inputs as one change; the caller holds the writers' lock."""
    sequence[0] += 1
    fence()
    for k in range(len(slots)):
        inbox[slots[k]] = values[k]
    fence()
    sequence[0] += 1


@njit
def receive(state: FloatArray, inbox: FloatArray, scratch: FloatArray, sequence: IntArray) -> None:
    """Copy the inputs into the state; during a write, the last whole copy stays.

    An input that is not finite keeps its last value, so that no stage's memory is spoilt by it,
    and is counted in INPUT_FAULT, which makes `safety` hold the force at zero.
    """
    before = sequence[0]
    if before % 2 == 0:
        fence()
        for slot in range(sv.INPUTS):
            scratch[slot] = inbox[slot]
        fence()
        if sequence[0] == before:
            bad = 0
            for slot in range(sv.INPUTS):
                if isfinite(scratch[slot]):
                    state[slot] = scratch[slot]
                else:
                    bad += 1
            state[sv.INPUT_FAULT] = bad


@njit
def publish(state: FloatArray, ring: FloatArray, counters: IntArray) -> None:
    """Append the state to the history; readers see the row before they see the new head."""
    row = counters[HEAD] % ring.shape[0]
    for slot in range(sv.SLOTS):
        ring[row, slot] = state[slot]
    fence()
    counters[HEAD] += 1


@njit
def answer(
    state: FloatArray, parameters: ArrayList, counters: IntArray, checkpoint: FloatArray
) -> None:
    """Take the checkpoint that was asked for, if one was: the state, then every stage's array."""
    asked = counters[ASKED]
    if asked == counters[ANSWERED]:
        return
    for slot in range(sv.SLOTS):
        checkpoint[slot] = state[slot]
    place = sv.SLOTS
    for values in parameters:
        for k in range(len(values)):
            checkpoint[place] = values[k]
            place += 1
    fence()
    counters[ANSWERED] = asked


@compiled(types.void(_FLOATS, PARAMETERS, _INTEGERS, _FLOATS))
def answer_now(
    state: FloatArray, parameters: ArrayList, counters: IntArray, checkpoint: FloatArray
) -> None:
    """Take a checkpoint of a loop that nobody runs at the moment."""
    answer(state, parameters, counters, checkpoint)


@njit
def run_stages(state: FloatArray, stages: StageList, parameters: ArrayList) -> None:
    """Call every stage of a table in order."""
    for function, values in zip(stages, parameters):  # noqa: B905  (numba's zip has no strict)
        function(state, values)


@njit
def run_tick(
    state: FloatArray, stages: StageList, parameters: ArrayList, counters: IntArray
) -> None:
    """Call every stage of a table in order, and say before each which one it is."""
    for function, values in zip(stages, parameters):  # noqa: B905  (numba's zip has no strict)
        counters[RUNNING] += 1
        function(state, values)
    counters[RUNNING] = 0


@compiled(types.void(*TICK_TYPES, types.float64, types.float64, types.int64))
def step(
    state: FloatArray,
    stages: StageList,
    parameters: ArrayList,
    inbox: FloatArray,
    scratch: FloatArray,
    sequence: IntArray,
    ring: FloatArray,
    counters: IntArray,
    checkpoint: FloatArray,
    time: float,
    dt: float,
    ticks: int,
) -> None:
    """Run ticks at `time` + dt, + 2 dt, ... without waiting."""
    for k in range(ticks):
        state[sv.TIME] = time + (k + 1) * dt
        state[sv.DT] = dt
        state[sv.TICK] = counters[HEAD] + 1
        state[sv.MISSED] = counters[MISSED]
        receive(state, inbox, scratch, sequence)
        run_tick(state, stages, parameters, counters)
        publish(state, ring, counters)
        answer(state, parameters, counters, checkpoint)


@compiled(types.void(_FLOATS, STAGES, PARAMETERS, ROWS, _INTEGERS, types.float64))
def release(
    state: FloatArray,
    stages: StageList,
    parameters: ArrayList,
    ring: FloatArray,
    counters: IntArray,
    time: float,
) -> None:
    """Send zero torque through the link's write stages, whatever happened before.

    Its row in the history has a DT of 0, which no tick has: nothing was computed in it.
    """
    for slot in (sv.ENABLED, sv.TORQUE_LEFT, sv.TORQUE_RIGHT, sv.SAFETY_SCALE, sv.ARMING):
        state[slot] = 0.0
    for slot in (sv.FELT_X, sv.FELT_Y, sv.FELT_Z):
        state[slot] = 0.0
    state[sv.TIME] = time
    state[sv.DT] = 0.0
    state[sv.TICK] = counters[HEAD] + 1
    run_stages(state, stages, parameters)
    publish(state, ring, counters)


@compiled(types.void(_FLOATS, STAGES, PARAMETERS, types.int64))
def repeat(state: FloatArray, stages: StageList, parameters: ArrayList, times: int) -> None:
    """Call a table many times: what a benchmark or a cost estimate measures."""
    for _ in range(times):
        run_stages(state, stages, parameters)
