"""Effects, one file each. See 'How to add an effect' in docs/extending.md.

Nothing here imports them: their declarations are read as text (`core.plugins`), and only what a
plan keeps is imported. The compiled code of one that is not the program's own is checked before.
"""

from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.plugins import (
    CHOICES,
    ENERGY,
    FLAG,
    PARAMETERS,
    PUBLISHED,
    SLOTS,
    TEXT,
    TEXTS,
    PluginKind,
    StageDeclaration,
    complete,
    read_statements,
)
from app.core.stage_check import RefusedStageError, check_stage
from app.simulation.errors import SimulationError
from app.simulation.scene import Binding


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect(StageDeclaration):
    """What an effect reads, writes and needs, and who could consume it.

    Attributes:
        consumers: kinds of consumer that could use it, for display; the compiler looks at slots.
        needs: parts of the scene that must not be empty (`layers`).
        models: way to compute it -> what that way is; the first is the default.
        cost_class: A (< 50 ns), B (1-5 µs), C (frame or event rate), D (offline).
        pictures: whether it acts on the pictures of simulated cameras and not in the tick: its file
            declares it, and `tracking.simulated.picture_effects` makes it, found by its name.
    """

    consumers: tuple[str, ...]
    needs: tuple[str, ...]
    models: Mapping[str, str]
    cost_class: str
    pictures: bool = False

    @property
    def gives(self) -> tuple[str, ...]:
        """What consumers read of it: its slots, or `PICTURES`."""
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
                f"effect {self.name!r} has no model {asked!r}; it has {', '.join(self.models)}"
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
    name = declared.name
    if declared.pictures:
        model = list(declared.models).index(declared.model(binding.model))
        return np.array([model, *(values[key] for key in declared.parameters)], dtype=float)
    module = load(declared)
    own = nullcontext() if KIND.is_own(declared.path) else KIND.blamed(declared.path, _PARAMETERS)
    with own:
        array: FloatArray = module.parameters(values, binding)
    if (needed := _needed(declared)) > len(array):
        raise SimulationError(
            f"effect {name}: step() uses {needed} parameters, parameters() gives {len(array)}"
        )
    return array


def implementation(name: str) -> ModuleType:
    """Import an effect. Only for effects that the plan keeps.

    Raises:
        SimulationError: for one that is not the program's own if its compiled code could do harm
            (`core.stage_check`); says where and why.
    """
    return load(declaration(name))


def load(declared: Effect) -> ModuleType:
    """Import a declared effect, see `implementation`."""
    return KIND.load(declared, before=_needed)


def refused() -> dict[Path, str]:
    """Files of effects that cannot be used, and why; they are left where they are."""
    return KIND.refused(_needed)


def _needed(effect: Effect) -> int:
    """Parameters that an effect's stage uses at least; 0 for the program's own."""
    if KIND.is_own(effect.path):
        return 0
    if effect.pictures:
        raise SimulationError(
            f"{effect.path}: pictures is True; only the program's own effects act on pictures"
        )
    try:
        return check_stage(effect.path, read_statements(effect.path), effect.writes).parameters
    except RefusedStageError as refusal:
        raise SimulationError(str(refusal)) from refusal


KIND: Final[PluginKind[Effect]] = PluginKind(
    noun="an effect",
    declares=Effect,
    fields={
        "title": TEXT,
        "reads": SLOTS,
        "writes": SLOTS,
        "consumers": TEXTS,
        "needs": TEXTS,
        "models": CHOICES,
        "energy": ENERGY,
        "cost_class": TEXT,
        "parameters": PARAMETERS,
    },
    optional={"published": PUBLISHED, "pictures": FLAG},
    error=SimulationError,
    package=__name__,
    folder="effects",
    functions=("step", "parameters"),
    spared="pictures",
)
