"""Folders of plug-ins: the one search path of everything that can be added to the program.

A plug-in folder holds all that belongs to one thing, a machine above all, in subfolders whose names
say of what kind their files are; each kind is looked for by whoever uses it:

| subfolder | holds |
|---|---|
| `machines/` | machines that point a needle, a folder each |
| `laws/`, `effects/`, `metrics/`, `extractors/` | plug-ins of that kind, a file each |
| `remedies/`, `studies/` | the same |
| `needle_sources/` | what stands in for robot and cameras, a file each |
| `features/` | features of the window |
| `views/` | what features are built from; views that exercises switch on and off |
| `demonstrations/` | who shows an exercise by `acus demo` |
| `commands/` | further commands |
| `devices/` | profiles of devices, YAML files |
| `exercises/` | exercises |
| `translations/` | texts of languages, files of Qt's `lupdate` |
| `hard_cases/` | hard cases for `acus study hard` |
| `comparisons/` | machines in the table of `acus study machines` |

The program's own are the folders of `app` whose `__init__.py` says so in a `DECLARATION`. Nothing
names them: without such a folder the program has less, and everything else goes on. Folders of
others are packages too: `ACUS_PLUGINS` lists some, and each entry point of the group `acus.plugins`
of an installed distribution names one, as in `gimbal = "acus_gimbal"`. What is wrong with theirs is
kept in `refused`, and costs nothing but itself.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from importlib import import_module, metadata
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any, Final

from app.core import paths
from app.core.messages import sentence
from app.core.plugin_trial import import_fault

APP: Final = Path(__file__).resolve().parents[1]
"""Folder of the program."""

GROUP: Final = "acus.plugins"
"""Entry points of installed distributions whose values are folders of plug-ins."""

refused: Final[dict[Path, str]] = {}
"""Folders and files of others that cannot be used, each with the reason."""

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
        """Return whether it comes with the program."""
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
    """Return the search path of plug-ins: the program's own, those listed, those installed."""
    own = sorted(path.parent for path in APP.glob("*/__init__.py") if _MARK in path.read_bytes())
    found = [PluginFolder(path, f"{APP.name}.{path.name}") for path in own]
    for path in paths.plugin_folders():
        if str(path.parent) not in sys.path:
            sys.path.append(str(path.parent))
        found.extend(_package(path.name, path))
    for point in metadata.entry_points(group=GROUP):
        found.extend(_package(point.value, Path(point.value.replace(".", "/"))))
    return tuple({folder.path: folder for folder in found}.values())


def _package(name: str, place: Path) -> Iterator[PluginFolder]:
    """Yield the folder of a package, which is not imported for that; none where it is refused.

    Args:
        name: of the package, with dots.
        place: where it should lie; of an installed one only its name is known.
    """
    top, *inner = name.split(".")
    try:
        spec = find_spec(top) if top.isidentifier() else None
    except (ImportError, ValueError):
        spec = None
    taken = ""
    for root in (spec.submodule_search_locations or ()) if spec else ():
        folder = Path(root, *inner)
        try:
            is_package = (folder / "__init__.py").is_file()
        except OSError as error:
            refused[place] = sentence(
                "{folder} cannot be read: {reason}", folder=folder, reason=error.strerror or error
            )
            return
        if is_package and (not place.is_absolute() or folder == place):
            yield PluginFolder(folder, name)
            return
        taken = sentence(": {folder} has that name", folder=folder) if is_package else taken
    if place.is_absolute() and not place.exists():
        refused[place] = sentence("{folder}: there is no such folder", folder=place)
        return
    refused[place] = sentence(
        "{name!r} is no package that can be imported{taken}: a folder of plug-ins has an "
        "__init__.py and a name of its own that is a Python name",
        name=name,
        taken=taken,
    )


def refused_folders() -> tuple[str, ...]:
    """Return why folders of others cannot be used, one text each; looks for none but once."""
    folders()
    return tuple(reason for place, reason in sorted(refused.items()) if not place.suffix)


def declared(body: Iterable[ast.stmt]) -> dict[str, Any]:
    """Return what the statements of a file declare, of whatever kind it is; empty if nothing.

    Raises:
        ValueError: if it is no literal.
    """
    for node in body:
        if isinstance(node, ast.AnnAssign | ast.Assign) and node.value is not None:
            target = node.targets[0] if isinstance(node, ast.Assign) else node.target
            if isinstance(target, ast.Name) and target.id == "DECLARATION":
                document = ast.literal_eval(node.value)
                return document if isinstance(document, dict) else {}
    return {}


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


def modules(kind: str, name: str = "*") -> Iterator[ModuleType]:
    """Import every file of a kind in all plug-in folders, in their order; of one name, if given.

    A file of somebody else's is imported only where a process of its own has shown that it can be;
    else it is `refused`.
    """
    for folder in folders():
        for path in folder.files(kind, name):
            if folder.is_own:
                yield import_module(folder.module_name(path))
            elif (module := _imported(folder, path)) is not None:
                yield module


def _imported(folder: PluginFolder, path: Path) -> ModuleType | None:
    name = folder.module_name(path)
    fault = import_fault(path, name.rpartition(".")[0])
    try:
        if not fault:
            return import_module(name)
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # whatever somebody's file does
        fault = f"{type(error).__name__}: {error}"
    refused[path] = f"{path} cannot be imported: {fault}"
    return None
