"""Folders of plug-ins: the one search path of everything that can be added to the program.

A plug-in folder holds all that belongs to one thing, a machine above all, in subfolders whose names
say of what kind their files are; each kind is looked for by whoever uses it:

| subfolder | holds |
|---|---|
| `machines/` | machines that point a needle, a folder each |
| `laws/`, `effects/`, `metrics/`, `extractors/`, `studies/` | plug-ins of that kind, a file each |
| `features/` | features of the window |
| `views/` | what features are built from; views that exercises switch on and off |
| `demonstrations/` | who shows an exercise by `acus demo` |
| `commands/` | further commands |
| `exercises/` | exercises |
| `hard_cases/` | hard cases for `acus study hard` |
| `comparisons/` | machines in the table of `acus study machines` |

The program's own are the folders of `app` whose `__init__.py` says so in a `DECLARATION`. Nothing
names them: without such a folder the program has less, and everything else goes on.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Final

APP: Final = Path(__file__).resolve().parents[1]
"""Folder of the program."""

_MARK: Final = b"\nDECLARATION"


@dataclass(frozen=True, slots=True)
class PluginFolder:
    """One folder of plug-ins.

    Attributes:
        path: the folder.
        package: dotted name by which its modules are imported; subfolders are packages of it.
    """

    path: Path
    package: str

    @property
    def is_own(self) -> bool:
        """Whether it comes with the program."""
        return self.path.is_relative_to(APP)

    def files(self, kind: str, name: str = "*") -> list[Path]:
        """Return its files of a kind, sorted, without those that begin with an underscore.

        Args:
            kind: name of the subfolder.
            name: of one file, without `.py`; all of them without it.
        """
        found = sorted((self.path / kind).glob(f"{name}.py"))
        return [path for path in found if not path.stem.startswith("_")]

    def module_name(self, path: Path) -> str:
        """Return the dotted name of one of its files."""
        return ".".join((self.package, *path.relative_to(self.path).with_suffix("").parts))


@cache
def folders() -> tuple[PluginFolder, ...]:
    """Return the search path of plug-ins, the program's own first."""
    own = sorted(path.parent for path in APP.glob("*/__init__.py") if _MARK in path.read_bytes())
    return tuple(PluginFolder(path, f"{APP.name}.{path.name}") for path in own)


def files(kind: str, name: str = "*") -> list[Path]:
    """Return the files of a kind in all plug-in folders, in their order; see `PluginFolder.files`.

    Args:
        kind: name of the subfolder.
        name: of one file, without `.py`.
    """
    return [path for folder in folders() for path in folder.files(kind, name)]


def folder_of(path: Path) -> PluginFolder | None:
    """Return the plug-in folder that a file lies in; None if it lies in none."""
    return next((folder for folder in folders() if path.is_relative_to(folder.path)), None)


def modules(kind: str) -> Iterator[ModuleType]:
    """Import every file of a kind in all plug-in folders, in their order."""
    for folder in folders():
        for path in folder.files(kind):
            yield import_module(folder.module_name(path))
