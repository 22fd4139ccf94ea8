"""Effects, one file each. See 'How to add an effect' in docs/extending.md.

Nothing here imports them: their declarations are read as text (`core.plugins`), and only what a
plan keeps is imported. One that is not the program's own is tried before (`effect_trial`).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from types import MappingProxyType, ModuleType
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.plugins import (
    CHOICES,
    ENERGY,
    FLAG,
    PARAMETERS,
    PUBLISHED,
    SLOTS,
    TEXT,
    TEXTS,
    WRITES,
    Field,
    PluginKind,
    StageDeclaration,
    complete,
)
from app.core.trial import Trial
from app.simulation.errors import SimulationError
from app.simulation.scene import Binding


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect(StageDeclaration):
    """What an effect reads, writes and needs, and who could consume it.

    Attributes:
        consumers: kinds of consumer that could use it, for display; the compiler looks at slots.
        needs: parts of the scene that must not be empty (`layers`).
        models: way to compute it -> what that way is; the first is the default.
        model_reads: way -> what it reads beyond `reads`, where it reads more than the others.
        cost_class: A (< 50 ns), B (1-5 µs), C (frame or event rate), D (offline).
        pictures: whether it acts on the pictures of simulated cameras and not in the tick: its file
            declares it, and `tracking.simulated.picture_effects` makes it, found by its name.
    """

    consumers: tuple[str, ...]
    needs: tuple[str, ...]
    models: Mapping[str, str]
    cost_class: str
    pictures: bool = False
    model_reads: Mapping[str, tuple[str, ...]] = field(default_factory=lambda: MappingProxyType({}))

    def by(self, model: str) -> "Effect":
        """Return it as it is by one of its models: with all that this one reads."""
        more = self.model_reads.get(model, ())
        return replace(self, reads=tuple(dict.fromkeys((*self.reads, *more)))) if more else self

    @property
    def gives(self) -> tuple[str, ...]:
        """Return what consumers read of it: its slots, or `PICTURES`."""
        return (*self.writes, PICTURES) if self.pictures else self.writes

    def checked(self, given: Mapping[str, float]) -> dict[str, float]:
        """Complete `given` with the defaults and check every value.

        Raises:
            SimulationError: for an unknown name, or a value that is no number or out of range.
        """
        return complete(KIND, self, given)

    def model(self, asked: str) -> str:
        """Return the way to compute it: the one asked for, or the default.

        Raises:
            SimulationError: naming the ways that exist.
        """
        if asked and asked not in self.models:
            raise SimulationError(
                sentence(
                    "effect {name!r} has no model {asked!r}; it has {models}",
                    name=self.name,
                    asked=asked,
                    models=", ".join(self.models),
                )
            )
        return asked or next(iter(self.models))


_PARAMETERS = "parameters() does not work"

PICTURES: Final = "pictures"
"""What an effect on pictures gives, and who measures in them reads; no slot of the state."""


def effect_names() -> tuple[str, ...]:
    """Names of all effects, sorted."""
    return KIND.names()


def declaration(name: str) -> Effect:
    """Read what an effect says about itself, without importing it.

    Raises:
        SimulationError: for an unknown name, listing the known ones, or a broken file.
    """
    return KIND.find(name)


def parameters_of(name: str, values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters of an effect, its memory included.

    Of one on pictures: the number of its model, then its parameters as they are declared.

    Args:
        name: of the effect.
        values: of all its parameters, see `Effect.checked`.
        binding: what it is bound to.

    Raises:
        SimulationError: if its file cannot be used, or gives fewer than its stage uses.
    """
    return array_of(declaration(name), values, binding)


def array_of(declared: Effect, values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters of a declared effect, see `parameters_of`."""
    if declared.pictures:
        model = list(declared.models).index(declared.model(binding.model))
        return np.array([model, *(values[key] for key in declared.parameters)], dtype=float)
    module = load(declared)
    if KIND.is_own(declared.path):
        own: FloatArray = module.parameters(values, binding)
        return own
    with KIND.blamed(declared.path, _PARAMETERS):
        array = np.ascontiguousarray(module.parameters(values, binding), dtype=np.float64)
    if array.ndim != 1 or array.size < (least := _shortest(declared)):
        raise SimulationError(
            sentence(
                "{declared_path}: parameters() gives an array of the shape {array_shape} for "
                "this scene and these values; give one of the shape (n,), and of {least} numbers "
                "at least, as it was tried",
                declared_path=declared.path,
                array_shape=array.shape,
                least=least,
            )
        )
    return array


def implementation(name: str) -> ModuleType:
    """Import an effect. Only for effects that the plan keeps.

    Raises:
        SimulationError: for one that is not the program's own if it fails its trial; says where and
            why.
    """
    return load(declaration(name))


def load(declared: Effect) -> ModuleType:
    """Import a declared effect, see `implementation`."""
    return KIND.load(declared, _check_pictures, lambda module: check_step(module, declared))


def refused() -> dict[Path, str]:
    """Files of effects that cannot be used, and why; they are left where they are."""
    return KIND.refused(_check_pictures)


def check_step(module: ModuleType, effect: Effect) -> None:
    """Check that the step of an effect that is not the program's own is compiled.

    Raises:
        SimulationError: if it is not.
    """
    if KIND.is_own(effect.path):
        return
    from app.core.compiled import is_stage  # numba: who only reads declarations does without

    if not is_stage(module.step):
        raise SimulationError(
            sentence(
                "{effect_path}: step is not compiled; put @stage of core.compiled before it",
                effect_path=effect.path,
            )
        )


def _check_pictures(effect: Effect) -> None:
    if effect.pictures and not KIND.is_own(effect.path):
        raise SimulationError(
            sentence(
                "{effect_path}: pictures is True; only the program's own effects act on pictures",
                effect_path=effect.path,
            )
        )


def _shortest(effect: Effect) -> int:
    """Length of the shortest array that an effect of somebody else's was tried with."""
    return 0 if KIND.trial is None else int(KIND.trial.verdict(effect.path).get("shortest", 0))


def _model_reads(value: Any) -> Mapping[str, tuple[str, ...]]:
    return MappingProxyType({TEXT.read(name): SLOTS.read(slots) for name, slots in value.items()})


_MODEL_READS: Final = Field(f"{{model: {SLOTS.valid}, ...}}", _model_reads)

KIND: Final[PluginKind[Effect]] = PluginKind(
    noun="an effect",
    declares=Effect,
    fields={
        "title": TEXT,
        "reads": SLOTS,
        "writes": WRITES,
        "consumers": TEXTS,
        "needs": TEXTS,
        "models": CHOICES,
        "energy": ENERGY,
        "cost_class": TEXT,
        "parameters": PARAMETERS,
    },
    optional={"published": PUBLISHED, "pictures": FLAG, "model_reads": _MODEL_READS},
    error=SimulationError,
    package=__name__,
    folder="effects",
    functions=("step", "parameters"),
    spared="pictures",
    trial=Trial("app.simulation.effect_trial"),
)
