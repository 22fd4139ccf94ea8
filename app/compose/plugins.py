"""Files of others: laws, effects, metrics, remedies, extractors, studies, and which are refused.

They are read and not run, so that the answer costs little and harms nobody. Asked to, they are
imported too, each in a process of its own, which it may end. What only using them would find is
said by the one who uses them.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from app import mechanisms
from app.core import paths
from app.core import plugin_folders as folders
from app.core.plugins import PluginKind, read_statements
from app.core.progress import Progress
from app.mechanisms.profile.device import machine_fault


@dataclass(frozen=True, slots=True)
class PluginFile:
    """A file that is not the program's own.

    Attributes:
        kind: what it is: `force law`, `effect`, `metric`, `marker extractor`, `CT remedy`, `study`
            or `machine`.
        path: the file; of a machine its folder.
        title: as it declares it; empty if it is refused.
        refused: why it cannot be used, with file, line and what would be valid; empty if it can.
    """

    kind: str
    path: Path
    title: str
    refused: str

    @property
    def name(self) -> str:
        """Name by which exercises and commands call it."""
        return self.path.stem


RIGHTS: Final = (
    "files of your own run with all your rights, as any program that you start: take none from "
    "people whom you do not trust"
)


def plugin_files(tried: bool = False, progress: Progress | None = None) -> tuple[PluginFile, ...]:
    """List the files of others of every kind, by kind and path.

    Args:
        tried: whether each is also imported, in a process of its own.
        progress: names the file that is looked at.
    """
    found: list[PluginFile] = []
    progress, kinds = progress or Progress(), _kinds()
    for number, (kind, refused) in enumerate(kinds):
        reasons = refused()
        for path in kind.files():
            if kind.is_own(path):
                continue
            progress.report(number / (len(kinds) + 1), path.name)
            reason = reasons.get(path) or (kind.fault(path) if tried else "")
            title = "" if reason else kind.read(path).title
            found.append(PluginFile(kind.word, path, title, reason))
    progress.report(len(kinds) / (len(kinds) + 1), "machines")
    refused_folders = [
        PluginFile("folder" if not path.suffix else path.parent.name, path, "", reason)
        for path, reason in sorted(folders.refused.items())
    ]
    return (*found, *_machines(tried), *refused_folders)


def _machines(tried: bool) -> list[PluginFile]:
    """List the user's own machines: folders, read as text as the files of the other kinds are."""
    found = []
    own = {path.name for path in Path(mechanisms.__file__ or "").parent.iterdir()}
    for folder in sorted(paths.plugins("mechanisms").glob("*/")):
        if folder.name.startswith(("_", ".")):
            continue
        title, reason = "", ""
        if folder.name in own:
            reason = f"{folder}: {folder.name!r} is a name of the program's own; rename the folder"
            found.append(PluginFile("machine", folder, "", reason))
            continue
        for name, wanted in (("profile.py", "PROFILE"), ("machine.py", "machine")):
            try:
                body = read_statements(folder / name)
            except (OSError, SyntaxError, ValueError) as error:
                reason = f"{folder / name} cannot be read: {error}"
                break
            if wanted not in _defined(body):
                reason = f"{folder / name} does not define {wanted}; see 'How to add a machine'"
                break
            if tried and (reason := machine_fault(folder.name, Path(name).stem)):
                break
            title = (ast.get_docstring(ast.Module(body, [])) or folder.name).split("\n")[0]
        found.append(PluginFile("machine", folder, "" if reason else title, reason))
    return found


def _defined(body: list[ast.stmt]) -> set[str]:
    """Names that a file's statements define at its top level."""
    names = {node.name for node in body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    for node in body:
        targets = [node.target] if isinstance(node, ast.AnnAssign) else getattr(node, "targets", [])
        names |= {target.id for target in targets if isinstance(target, ast.Name)}
    return names


def plugin_folders() -> dict[str, Path]:
    """Return where the user's own files of each kind lie; a folder need not exist."""
    folders = {kind.word: paths.plugins(kind.folder) for kind, _ in _kinds()}
    return folders | {"machine": paths.plugins("mechanisms")}


def refused_files() -> tuple[PluginFile, ...]:
    """List the files of others that cannot be used; they are left where they are."""
    return tuple(file for file in plugin_files() if file.refused)


def _kinds() -> tuple[tuple[PluginKind[Any], Callable[[], Mapping[Path, str]]], ...]:
    """Every kind with what looks its files through."""
    from app.device.control import law, laws
    from app.imaging import remedies
    from app.scoring import metrics
    from app.simulation import effects
    from app.studies import runner
    from app.tracking.markers import choice

    return (
        (law.KIND, laws.refused),
        (effects.KIND, effects.refused),
        (metrics.KIND, metrics.KIND.refused),
        (choice.KIND, choice.KIND.refused),
        (remedies.KIND, remedies.refused),
        (runner.KIND, runner.KIND.refused),
    )
