"""Runs one compiled stage over a row of readings."""

from typing import Any

from app.core import state_vector as sv
from app.core.compiled import STAGE_TYPE
from app.device.control.kernel import compiled

from numba import types  # isort: skip  (after core.compiled)

_ROW = types.float64[::1]
_TABLE = types.Array(types.float64, 2, "C", readonly=True)


@compiled(
    types.void(
        STAGE_TYPE,
        _ROW,
        _ROW,
        types.Array(types.float64, 1, "C", readonly=True),
        _TABLE,
        types.float64[:, ::1],
        types.int64,
    )
)
def drive(
    function: Any,
    state: Any,
    parameters: Any,
    times: Any,
    readings: Any,
    rates: Any,
    rounds: int,
) -> None:
    """Step a velocity estimator through readings (n, 2) taken at `times` (n,); fill `rates`.

    Further `rounds` do the same again, to be timed: stamps that go back make it begin afresh.
    """
    for tick in range(rounds * len(times)):
        k = tick % len(times)
        state[sv.DT] = times[1] - times[0]
        state[sv.TIME], state[sv.Q_TIME] = times[k], times[k]
        state[sv.Q_LEFT], state[sv.Q_RIGHT] = readings[k, 0], readings[k, 1]
        function(state, parameters)
        rates[k, 0], rates[k, 1] = state[sv.QD_LEFT], state[sv.QD_RIGHT]
