"""What every view reads, from its source: neither Qt nor the view is imported.

A view that an exercise switches on and off, and the control scans, declare themselves in a literal
`DECLARATION = {"view": ..., "title": ..., "reads": ...}`. `compose` and `commands` collect the
declarations here and hand them to the scene compiler.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Final

from app import views
from app.core.declarations import read_source
from app.core.errors import ConfigurationError
from app.core.state_vector import INDEX
from app.simulation.consumers import Consumer

KEYS: Final = ("view", "title", "reads")
VIEWS: Final = Path(views.__file__).parent
_MARK: Final = b"\nDECLARATION"


@cache
def declared_views(folder: Path = VIEWS) -> Mapping[str, Consumer]:
    """Return who consumes what among the views, by the name of the view.

    Args:
        folder: searched with all folders in it.

    Raises:
        ConfigurationError: naming the file and what is wrong with its declaration, or both files
            that declare one view.
    """
    found: dict[str, Consumer] = {}
    files: dict[str, Path] = {}
    for path in sorted(folder.rglob("*.py")):
        if _MARK not in path.read_bytes():
            continue
        name, reads = _declared(path)
        if name in found:
            raise ConfigurationError(f"view {name!r} is declared twice: {files[name]} and {path}")
        found[name], files[name] = Consumer(f"view {name} shows it", reads), path
    return MappingProxyType(found)


def _declared(path: Path) -> tuple[str, tuple[str, ...]]:
    document = read_source(path, "a view", KEYS, ConfigurationError).document
    name, title, reads = (document[key] for key in KEYS)
    if not (isinstance(name, str) and name and isinstance(title, str) and title):
        raise ConfigurationError(f"{path}: view and title must be texts that are not empty")
    if not isinstance(reads, tuple) or not all(slot in INDEX for slot in reads):
        raise ConfigurationError(
            f"{path}: reads must be a tuple of slots of core.state_vector in lower case; got "
            f"{reads!r}"
        )
    return name, reads
