"""Features of the window that lie in folders of plug-ins: `features/`, one a file.

A file declares itself in `DECLARATION` and defines `FEATURE`, the class. Title and page of help are
read without importing it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from app.core import plugin_folders
from app.core.errors import ConfigurationError
from app.core.plugins import TEXT, Declaration, PluginKind
from app.views.kit.text import translated
from app.views.shell.feature import Feature


@dataclass(frozen=True, slots=True, kw_only=True)
class DeclaredFeature(Declaration):
    """What a feature says about itself.

    Attributes:
        after: folder or file of the feature of `app.views` behind which it stands.
        help: page and heading about its widgets; empty for the first page.
    """

    after: str
    help: str = ""


KIND: Final[PluginKind[DeclaredFeature]] = PluginKind(
    noun="a feature",
    declares=DeclaredFeature,
    fields={"title": TEXT, "after": TEXT},
    optional={"help": TEXT},
    error=ConfigurationError,
    folder="features",
)


def declared_features() -> tuple[DeclaredFeature, ...]:
    """Return what the features of all folders of plug-ins say about themselves."""
    unusable = KIND.refused()
    plugin_folders.refused.update({p: r for p, r in unusable.items() if not KIND.is_own(p)})
    return tuple(KIND.read(path) for path in KIND.files() if path not in unusable)


def page_of_plugin(module: str) -> str:
    """Return the page of help about the widgets of a module; empty where it is no plug-in's."""
    for declared in declared_features():
        folder = plugin_folders.folder_of(declared.path)
        if folder is not None and module.startswith(f"{folder.package}."):
            return declared.help
    return ""


def with_plugins(features: tuple[type[Feature], ...]) -> tuple[type[Feature], ...]:
    """Return features with those of plug-ins, each behind the one that it names.

    One of somebody else's that cannot be used is left out, and refused with the reason.

    Raises:
        ConfigurationError: if a file of the program cannot be imported, defines no `FEATURE`, or
            names a feature that there is not; names it.
    """
    order = list(features)
    for declared in declared_features():
        try:
            _insert(declared, order)
        except ConfigurationError as error:
            if KIND.is_own(declared.path):
                raise
            plugin_folders.refused[declared.path] = translated(error)
    return tuple(order)


def _insert(declared: DeclaredFeature, order: list[type[Feature]]) -> None:
    feature = getattr(KIND.load(declared), "FEATURE", None)
    if not (isinstance(feature, type) and issubclass(feature, Feature)):
        raise ConfigurationError(f"{declared.path} must define FEATURE, a class of Feature")
    names = [_name_of(other) for other in order]
    if declared.after not in names:
        raise ConfigurationError(
            f"{declared.path}: after is {declared.after!r}; valid are {', '.join(names)}"
        )
    order.insert(names.index(declared.after) + 1, feature)


def _name_of(feature: type[Feature]) -> str:
    *_, folder, file = feature.__module__.split(".")
    return folder if file == "feature" else file
