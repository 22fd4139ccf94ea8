"""The trial of a plug-in that is one compiled stage, a force law or an effect: see `core.trial`.

It runs in a process of its own. The rooms bring what their arrays of parameters are made of: robots
here, scenes there.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from types import ModuleType
from typing import Any, Final, TypeVar

import numpy as np

from app.core import state_vector as sv
from app.core.plugins import Parameter, PluginKind, StageDeclaration
from app.core.trial_states import STATES, StageTrial
from app.core.trial_watch import CALL, Watch

_SHARES: Final = (None, 0.0, 1.0, 0.5, 0.02, 0.3)
"""Of the range of every parameter; None: its defaults."""

S = TypeVar("S", bound=StageDeclaration)


def try_stage(
    kind: PluginKind[S],
    declared: S,
    check_step: Callable[[ModuleType, S], None],
    arrays_of: Callable[[S, Any], Iterable[Any]],
    watch: Watch,
) -> dict[str, Any]:
    """Import a plug-in and give its `step` all states; return the verdict, see `core.trial`.

    Args:
        kind: of the plug-in.
        declared: its declaration.
        check_step: raises if its step is not compiled.
        arrays_of: yields the arrays of parameters that its module makes.
        watch: ends the process where it does not return.
    """
    module = replace(kind, trial=None).load(
        declared, after=lambda module: check_step(module, declared)
    )
    watch.doing("parameters()", CALL)
    arrays = [
        np.ascontiguousarray(array, dtype=np.float64).ravel()
        for array in arrays_of(declared, module)
    ]
    path = declared.path
    if not arrays:
        return {"reason": f"{path}: parameters() answers for no values within the declared ranges"}
    writes = [sv.INDEX[name] for name in declared.writes]
    reason = StageTrial(path, "step()", module.step, arrays, writes, watch).reason()
    return {"reason": reason, "states": STATES, "shortest": min(map(len, arrays))}


def values_tried(parameters: Mapping[str, Parameter], seed: int) -> Iterator[dict[str, float]]:
    """Yield values for the defaults, the ends and between; drawn where there is no default.

    Args:
        parameters: as declared.
        seed: of what is drawn.
    """
    rng = np.random.default_rng(seed)
    for share in _SHARES:
        values = {
            name: limit.minimum + share * (limit.maximum - limit.minimum)
            for name, limit in parameters.items()
            if share is not None
        }
        for name, limit in parameters.items():
            if limit.default is None and name not in values:
                values[name] = rng.uniform(limit.minimum, limit.maximum)
        yield values
