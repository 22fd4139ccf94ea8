"""All hard cases: of every file of this folder, and of plug-ins' `hard_cases`, with `CASES`."""

from functools import cache
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from app.core import plugin_folders
from app.studies import hard_cases
from app.studies.errors import StudyError
from app.studies.hard_cases.case import SUBSYSTEMS, HardCase


@cache
def cases() -> tuple[HardCase, ...]:
    """Return the cases, in the order of the subsystems.

    Raises:
        StudyError: if a subsystem has no case, or two cases have one name.
    """
    found: list[HardCase] = []
    names = [f"{hard_cases.__name__}.{info.name}" for info in iter_modules(hard_cases.__path__)]
    modules = [*map(import_module, names), *plugin_folders.modules("hard_cases")]
    for module in sorted(modules, key=lambda module: module.__name__.rpartition(".")[2]):
        if Path(module.__file__ or "") not in plugin_folders.refused:
            found += getattr(module, "CASES", ())
    called = [case.name for case in found]
    if twice := sorted({name for name in called if called.count(name) > 1}):
        raise StudyError(f"two hard cases are called {twice[0]!r}; rename one")
    if bare := set(SUBSYSTEMS) - {case.subsystem for case in found}:
        raise StudyError(f"subsystems without a hard case: {', '.join(sorted(bare))}")
    return tuple(sorted(found, key=lambda case: SUBSYSTEMS.index(case.subsystem)))
