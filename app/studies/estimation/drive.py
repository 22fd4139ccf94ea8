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
    )
)
def drive(
    function: Any, state: Any, parameters: Any, times: Any, readings: Any, rates: Any
) -> None:
    """Step a velocity estimator through readings (n, 2) taken at `times` (n,); fill `rates`."""
    before = 2.0 * times[0] - times[1]
    for k in range(len(times)):
        state[sv.DT] = times[k] - before
        before = times[k]
        state[sv.TIME], state[sv.Q_TIME] = times[k], times[k]
        state[sv.Q_LEFT], state[sv.Q_RIGHT] = readings[k, 0], readings[k, 1]
        function(state, parameters)
        rates[k, 0], rates[k, 1] = state[sv.QD_LEFT], state[sv.QD_RIGHT]
