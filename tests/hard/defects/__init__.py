"""Deliberate defects: for every hard case a wrong way to compute the same, which must break it.

A bound that no defect breaks would guard nothing. Each file here belongs to the file of cases of
its name in `app/studies/hard_cases`; those of a folder of plug-ins, which has its own
`hard_cases`, lie in the folder `defects` of its tests. `DEFECTS` of a file is subsystem → case →
defect; a file that is added is found by being there.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

TESTS = Path(__file__).resolve().parents[2]
FOLDER = "defects"


@dataclass(frozen=True, slots=True)
class Defect:
    """A wrong way to compute the same: in words, and as a function called like the case's own."""

    text: str
    way: Callable[..., Any]


@cache
def defects() -> dict[str, Defect]:
    """Return the defects by the names of their cases.

    Raises:
        ValueError: if two defects are of one case.
    """
    gathered: dict[str, Defect] = {}
    for folder in sorted(path for path in TESTS.glob(f"*/{FOLDER}") if path.is_dir()):
        for info in iter_modules([str(folder)]):
            module = import_module(f"{TESTS.name}.{folder.parent.name}.{FOLDER}.{info.name}")
            for subsystem, by_case in module.DEFECTS.items():
                for case, defect in by_case.items():
                    name = f"{subsystem}: {case}"
                    if name in gathered:
                        raise ValueError(f"two defects are of the hard case {name!r}; remove one")
                    gathered[name] = defect
    return gathered
