"""Files of others: laws, effects, metrics, marker extractors and studies, and which are refused.

They are read and not run, so that the answer costs little and harms nobody; what only running them
would find is said by the one who uses them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.core import paths
from app.core.plugins import PluginKind


@dataclass(frozen=True, slots=True)
class PluginFile:
    """A file that is not the program's own.

    Attributes:
        kind: what it is: `force law`, `effect`, `metric`, `marker extractor` or `study`.
        path: the file.
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


def plugin_files() -> tuple[PluginFile, ...]:
    """List the files of others of every kind, by kind and path."""
    found = []
    for kind, refused in _kinds():
        reasons = refused()
        for path in kind.files():
            if kind.is_own(path):
                continue
            reason = reasons.get(path, "")
            title = "" if reason else kind.read(path).title
            found.append(PluginFile(kind.word, path, title, reason))
    return tuple(found)


def plugin_folders() -> dict[str, Path]:
    """Return where the user's own files of each kind lie; a folder need not exist."""
    return {kind.word: paths.plugins(kind.folder) for kind, _ in _kinds()}


def refused_files() -> tuple[PluginFile, ...]:
    """List the files of others that cannot be used; they are left where they are."""
    return tuple(file for file in plugin_files() if file.refused)


def _kinds() -> tuple[tuple[PluginKind[Any], Callable[[], Mapping[Path, str]]], ...]:
    """Every kind with what looks its files through."""
    from app.device.control import law, laws
    from app.scoring import metrics
    from app.simulation import effects
    from app.studies import runner
    from app.tracking.markers import choice

    return (
        (law.KIND, laws.refused),
        (effects.KIND, effects.refused),
        (metrics.KIND, metrics.KIND.refused),
        (choice.KIND, choice.KIND.refused),
        (runner.KIND, runner.KIND.refused),
    )
