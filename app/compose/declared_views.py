"""What every view reads, from its source: neither Qt nor the view is imported.

A view that an exercise switches on and off, and the control scans, declare themselves in a literal
`DECLARATION = {"view": ..., "title": ..., "reads": ...}`. `compose` and `commands` collect the
declarations here and hand them to the scene compiler.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Final

from app import views
from app.core import plugin_folders
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.core.plugins import SLOTS, TEXT, Declaration, PluginKind
from app.simulation.consumers import Consumer


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredView(Declaration):
    """What a view says about itself: its name for exercises, and the slots that it reads."""

    view: str
    reads: tuple[str, ...]


KIND: Final[PluginKind[DeclaredView]] = PluginKind(
    noun="a view",
    declares=DeclaredView,
    fields={"view": TEXT, "title": TEXT, "reads": SLOTS},
    error=ConfigurationError,
)
VIEWS: Final = Path(views.__file__).parent
_MARK: Final = b"\nDECLARATION"


@cache
def declared_views(folder: Path | None = None) -> Mapping[str, Consumer]:
    """Return who consumes what among the views, by the name of the view.

    A file of somebody else's that is wrong is left out, and refused with the reason.

    Args:
        folder: searched with all folders in it; None: the program's views and those of plug-ins.

    Raises:
        ConfigurationError: naming the file of the program and what is wrong with its declaration,
            or both files that declare one view.
    """
    found: dict[str, Consumer] = {}
    files: dict[str, Path] = {}
    places = (VIEWS, *(one.path / "views" for one in plugin_folders.folders()))
    for path in (
        path
        for place in (places if folder is None else (folder,))
        for path in sorted(place.rglob("*.py"))
    ):
        try:
            if _MARK not in path.read_bytes():
                continue
            declared = KIND.read(path)
            name = declared.view
            if name in found:
                raise ConfigurationError(
                    sentence(
                        "view {name!r} is declared twice: {files} and {path}",
                        name=name,
                        files=files[name],
                        path=path,
                    )
                )
        except (OSError, ConfigurationError) as error:
            shared = plugin_folders.folder_of(path)
            if shared is None or shared.is_own:
                raise
            plugin_folders.refused[path] = str(error)
            continue
        found[name], files[name] = Consumer(f"“{declared.title}” shows it", declared.reads), path
    return MappingProxyType(found)
