"""The trial of an effect, in a process of its own: see `core.trial`."""

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.errors import AcusError
from app.core.trial_states import STATES, StageTrial
from app.core.trial_watch import CALL, Watch
from app.simulation import effects
from app.simulation.effects import KIND, Effect
from app.simulation.scene import BONE, DEFAULT_LAYERS, FAT, LIVER, LUNG, SKIN, Binding, Scene

_LAYERS: Final = (
    DEFAULT_LAYERS,
    (SKIN,),
    (FAT,),
    (SKIN, BONE),
    (SKIN, FAT, LIVER, LUNG, LIVER, LUNG, BONE),
    (),
)
_SHARES: Final = (None, 0.0, 1.0, 0.5)
"""Of the range of every parameter; None: its defaults."""


def run(path: Path, argument: str, watch: Watch) -> dict[str, Any]:
    """Try the effect of a file; see `core.trial.Trial.verdict`."""
    effect = KIND.read(path)
    module = replace(KIND, trial=None).load(
        effect, after=lambda module: effects.check_step(module, effect)
    )
    watch.doing("parameters()", CALL)
    arrays = list(_arrays(effect, module))
    if not arrays:
        return {"reason": f"{path}: parameters() answers for no values within the declared ranges"}
    writes = [sv.INDEX[name] for name in effect.writes]
    reason = StageTrial(path, "step()", module.step, arrays, writes, watch).reason()
    return {"reason": reason, "states": STATES, "shortest": min(map(len, arrays))}


def _arrays(effect: Effect, module: Any) -> Iterator[Any]:
    """Arrays of parameters in each scene that has what the effect needs, by each of its models."""
    rng = np.random.default_rng(1)
    for layers in _LAYERS:
        scene = Scene(layers=layers)
        if not all(len(getattr(scene, part, (1,))) for part in effect.needs if part != "needle"):
            continue
        for share in _SHARES:
            values = {
                key: limit.minimum + share * (limit.maximum - limit.minimum)
                for key, limit in effect.parameters.items()
                if share is not None
            }
            for key, limit in effect.parameters.items():
                if limit.default is None and key not in values:
                    values[key] = rng.uniform(limit.minimum, limit.maximum)
            with suppress(AcusError):  # a scene, or values, that the effect itself refuses
                given = effect.checked(values)
                for model in effect.models:
                    for slot in (sv.PLANT_DEPTH, sv.DEPTH):
                        array = module.parameters(given, Binding(scene, slot, model))
                        yield np.ascontiguousarray(array, dtype=np.float64).ravel()
