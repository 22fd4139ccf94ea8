"""The effects that exist: one file each on the search path of `app.simulation.effects`."""

import importlib
import pkgutil
from pathlib import Path
from types import ModuleType

from app.core.declarations import read_statements
from app.core.stage_check import RefusedStageError, check_stage
from app.simulation import effects
from app.simulation.declaration import Declaration, read_declaration
from app.simulation.errors import SimulationError


def effect_names() -> tuple[str, ...]:
    """Names of all effects, sorted; a folder appended to `effects.__path__` counts as well."""
    return tuple(sorted(module.name for module in pkgutil.iter_modules(effects.__path__)))


def declaration(name: str) -> Declaration:
    """Read what an effect says about itself, without importing it.

    Raises:
        SimulationError: for an unknown name, listing the known ones, or a broken file.
    """
    return read_declaration(_path(name))


def parameters_needed(name: str) -> int:
    """Return how many parameters an effect's stage uses at least; 0 for the program's own.

    Raises:
        SimulationError: for one that is not the program's own if its compiled code could do harm
            (`core.stage_check`); says where and why.
    """
    path = _path(name)
    if path.parent == Path(__file__).parent / "effects":
        return 0
    try:
        return check_stage(path, read_statements(path), declaration(name).writes).parameters
    except RefusedStageError as refusal:
        raise SimulationError(str(refusal)) from refusal


def _path(name: str) -> Path:
    for folder in effects.__path__:
        path = Path(folder) / f"{name}.py"
        if name.isidentifier() and path.is_file():
            return path
    raise SimulationError(f"there is no effect {name!r}; there are {', '.join(effect_names())}")


def implementation(name: str) -> ModuleType:
    """Import an effect. Only for effects that the plan keeps.

    Raises:
        SimulationError: as `parameters_needed`.
    """
    parameters_needed(name)
    return importlib.import_module(f"{effects.__name__}.{name}")
