"""The trial of an effect, in a process of its own: see `core.stage_trial`."""

from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, Final

from app.core import state_vector as sv
from app.core.errors import AcusError
from app.core.stage_trial import try_stage, values_tried
from app.core.trial_watch import Watch
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


def run(path: Path, argument: str, watch: Watch) -> dict[str, Any]:
    """Try the effect of a file; see `core.trial.Trial.verdict`."""
    return try_stage(KIND, KIND.read(path), effects.check_step, _arrays, watch)


def _arrays(effect: Effect, module: Any) -> Iterator[Any]:
    """Yield arrays of parameters in each scene that has what the effect needs, by each model."""
    for number, layers in enumerate(_LAYERS):
        scene = Scene(layers=layers)
        if not all(len(getattr(scene, part, (1,))) for part in effect.needs if part != "needle"):
            continue
        for values in values_tried(effect.parameters, number):
            with suppress(AcusError):  # a scene, or values, that the effect itself refuses
                given = effect.checked(values)
                for model in effect.models:
                    for slot in (sv.PLANT_DEPTH, sv.DEPTH):
                        yield module.parameters(given, Binding(scene, slot, model))
