"""What a stage costs per tick."""

from time import perf_counter

import numpy as np

from app.core.arrays import FloatArray
from app.core.parameters import StageFunction
from app.device.control import kernel
from app.device.control.kernel import ArrayList, StageList

_REPEATS = 5
_TARGET = 2e-3


def stage_cost(function: StageFunction, parameters: FloatArray, state: FloatArray) -> float:
    """Time [s] that one call of a stage takes, the shortest of a few runs of about 2 ms.

    Works on copies: neither the state, shape (SLOTS,), nor the stage's memory changes.
    """
    functions, values = kernel.no_stages(), kernel.no_parameters()
    kernel.append(functions, values, function, np.array(parameters, dtype=np.float64))
    copy = np.array(state, dtype=np.float64)
    calls = 100
    while (elapsed := _timed(copy, functions, values, calls)) < 0.5 * _TARGET:
        calls *= 4
    shortest = min([elapsed] + [_timed(copy, functions, values, calls) for _ in range(_REPEATS)])
    return shortest / calls


def _timed(state: FloatArray, functions: StageList, values: ArrayList, calls: int) -> float:
    start = perf_counter()
    kernel.repeat(state, functions, values, calls)
    return perf_counter() - start
