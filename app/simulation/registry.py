"""The effects that exist: one file each on the search path of `app.simulation.effects`."""

import importlib
import pkgutil
from pathlib import Path
from types import ModuleType

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
    for folder in effects.__path__:
        path = Path(folder) / f"{name}.py"
        if name.isidentifier() and path.is_file():
            return read_declaration(path)
    raise SimulationError(f"there is no effect {name!r}; there are {', '.join(effect_names())}")


def implementation(name: str) -> ModuleType:
    """Import an effect. Only for effects that the plan keeps."""
    return importlib.import_module(f"{effects.__name__}.{name}")
