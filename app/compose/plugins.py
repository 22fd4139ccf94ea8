"""Files of others: laws, effects, machines, exercises and the like, and which are refused.

They are read and not run, so that the answer costs little and harms nobody. Asked to, they are
imported too, each in a process of its own, which it may end. What only using them would find is
said by the one who uses them.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any, Final

from app import mechanisms
from app.core import language, paths
from app.core import plugin_folders as folders
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.plugin_trial import import_fault
from app.core.plugins import PluginKind, read_statements
from app.core.progress import Progress
from app.exercises.library import read_exercise
from app.mechanisms.profile import load_profile
from app.mechanisms.profile.device import TRIAL, machine_fault, refused_by_trial


@dataclass(frozen=True, slots=True)
class PluginFile:
    """A file that is not the program's own.

    Attributes:
        kind: what it is: `force law`, `effect`, `machine`, `feature`, `exercise` or the like.
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
    progress.report(len(kinds) / (len(kinds) + 1), sentence("machines"))
    found += _machines(tried)
    for folder in folders.folders():
        if not folder.is_own:
            found += _parts(folder, tried)
    return _with_refused(found + _languages())


def _with_refused(result: list[PluginFile]) -> tuple[PluginFile, ...]:
    """Return files with what whoever wanted to use them has refused since the program began."""
    reasons = dict(sorted(folders.refused.items()))
    files = [
        replace(file, title="", refused=file.refused or reasons[file.path])
        if file.path in reasons
        else file
        for file in result
    ]
    listed = {file.path for file in files}
    files += [
        PluginFile("folder" if not path.suffix else path.parent.name, path, "", reason)
        for path, reason in reasons.items()
        if path not in listed
    ]
    return tuple(files)


def _languages() -> list[PluginFile]:
    """List texts of languages that others bring."""
    rows = []
    for path in language.own_files():
        title, reason = "", ""
        try:
            title = sentence("{count} texts", count=len(language.read(path)))
        except (OSError, SyntaxError) as error:
            reason = sentence("{path} cannot be read: {error}", path=path, error=str(error))
        rows.append(PluginFile("language", path, title, reason))
    return rows


def _machines(tried: bool) -> list[PluginFile]:
    """List machines of others: folders, read as text as the files of the other kinds are."""
    shared = (one.path / "machines" for one in folders.folders() if not one.is_own)
    places = (*shared, *paths.plugin_places("mechanisms"))
    return [
        _machine(folder, tried)
        for folder in (folder for place in places for folder in sorted(place.glob("*/")))
        if not folder.name.startswith(("_", "."))
    ]


def _machine(folder: Path, tried: bool) -> PluginFile:
    if (Path(mechanisms.__file__ or "").parent / folder.name).exists():
        reason = f"{folder}: {folder.name!r} is a name of the program's own; rename the folder"
        return PluginFile("machine", folder, "", reason)
    title = ""
    for name, wanted in (("profile.py", "PROFILE"), ("machine.py", "machine")):
        reason = ""
        try:
            body = read_statements(folder / name)
        except FileNotFoundError:
            reason = sentence(
                "{folder} has no {name}: a machine is a folder with profile.py and machine.py; see "
                "'How to add a machine'",
                folder=folder,
                name=name,
            )
        except (OSError, SyntaxError, ValueError) as error:
            reason = f"{folder / name} cannot be read: {error}"
        else:
            if wanted not in _defined(body):
                reason = f"{folder / name} does not define {wanted}; see 'How to add a machine'"
            elif tried:
                reason = machine_fault(folder.name, Path(name).stem)
            title = _docstring(body) or folder.name
        if reason:
            return PluginFile("machine", folder, "", reason)
    kind = folder.name
    reason = refused_by_trial(kind) if tried else TRIAL.refusal(folder / "machine.py")
    return PluginFile("machine", folder, "" if reason else title, reason)


_PARTS: Final = {
    "features": "feature",
    "views": "view",
    "demonstrations": "demonstration",
    "commands": "command",
    "hard_cases": "file of hard cases",
    "comparisons": "compared machine",
}
"""Subfolder of a folder of plug-ins -> what a file in it is, where no kind of plug-in says so."""


def _parts(folder: folders.PluginFolder, tried: bool) -> Iterator[PluginFile]:
    """Yield what a folder of somebody else's holds beside plug-ins that one file makes."""
    for part, kind in _PARTS.items():
        for path in folder.files(part):
            title, reason = "", ""
            try:
                body = read_statements(path)
                declared = folders.declared(body)
            except (OSError, SyntaxError, ValueError) as error:
                reason = f"{path} cannot be read: {error}"
            else:
                if part == "views" and not declared:
                    continue  # a piece of a feature
                title = str(declared.get("title") or _docstring(body) or path.stem)
                fault = import_fault(path, f"{folder.package}.{part}") if tried else ""
                reason = f"{path} cannot be imported: {fault}" if fault else ""
                if part == "features" and not reason:
                    reason = _feature_fault(path, body, declared)
            yield PluginFile(kind, path, "" if reason else title, reason)
    for path in sorted((folder.path / "devices").glob("*.yaml")):
        yield _checked("device profile", path, lambda path: load_profile(path).description)
    for path in sorted((folder.path / "exercises").glob("*.yaml")):
        yield _checked("exercise", path, lambda path: read_exercise(path).title)


def _feature_fault(path: Path, body: list[ast.stmt], declared: Mapping[str, Any]) -> str:
    """Return why the window would leave a feature out, as its text shows; empty if it takes it."""
    if "FEATURE" not in _defined(body):
        return sentence(
            "{path} must define FEATURE, a class of Feature; see 'How to add a panel'", path=path
        )
    own = (p for p in (folders.APP / "views").glob("*/*.py") if b"(Feature):" in p.read_bytes())
    others = (p for one in folders.folders() for p in one.files("features") if p != path)
    names = sorted(p.parent.name if p.stem == "feature" else p.stem for p in (*own, *others))
    if declared.get("after") in names:
        return ""
    return sentence(
        "{path}: after is {declared_get!r}; valid are {names}",
        path=path,
        declared_get=declared.get("after"),
        names=", ".join(names),
    )


def _checked(kind: str, path: Path, title: Callable[[Path], str]) -> PluginFile:
    try:
        return PluginFile(kind, path, title(path), "")
    except AcusError as error:
        return PluginFile(kind, path, "", str(error))


def _docstring(body: list[ast.stmt]) -> str:
    return (ast.get_docstring(ast.Module(body, [])) or "").split("\n")[0]


def _defined(body: list[ast.stmt]) -> set[str]:
    """Names that a file's statements define at its top level."""
    names = {node.name for node in body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    for node in body:
        targets = [node.target] if isinstance(node, ast.AnnAssign) else getattr(node, "targets", [])
        names |= {target.id for target in targets if isinstance(target, ast.Name)}
    return names


def plugin_folders() -> dict[str, tuple[Path, ...]]:
    """Return where the user's own files of each kind lie; a folder need not exist."""
    places = {kind.word: paths.plugin_places(kind.folder) for kind, _ in _kinds()}
    more = {"machine": "mechanisms", "language": "translations"}
    return places | {word: paths.plugin_places(folder) for word, folder in more.items()}


def refused_files() -> tuple[PluginFile, ...]:
    """List the files of others that cannot be used; they are left where they are."""
    return tuple(file for file in plugin_files() if file.refused)


def _kinds() -> tuple[tuple[PluginKind[Any], Callable[[], Mapping[Path, str]]], ...]:
    """Return every kind with what looks its files through; further rooms bring theirs."""
    from app.device.control import law, laws
    from app.imaging import remedies
    from app.scoring import metrics
    from app.simulation import effects
    from app.tracking.markers import choice

    rooms = sorted(path.parent.name for path in folders.APP.glob("*/plugin_kinds.py"))
    more = (import_module(f"{folders.APP.name}.{room}.plugin_kinds").KINDS for room in rooms)
    return (
        (law.KIND, laws.refused),
        (effects.KIND, effects.refused),
        (metrics.KIND, metrics.KIND.refused),
        (choice.KIND, choice.KIND.refused),
        (remedies.KIND, remedies.refused),
        *((kind, kind.refused) for kinds in more for kind in kinds),
    )
