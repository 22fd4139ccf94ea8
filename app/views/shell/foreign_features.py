"""Features of somebody else's in the window: what one raises costs that feature alone.

Features of the program are made as they are. One of a folder of plug-ins that raises while it is
made is left out; one that raises where the window asks it something later is answered for. Either
is refused with the reason, which stands at the top of the window.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, Final

from app.core import plugin_folders
from app.views.kit.roles import Role
from app.views.shell.feature import Context, Feature

_ANSWERS: Final[dict[str, object]] = {
    "over": (),
    "watching": {},
    "forget": None,
    "suit_room": None,
    "unsaved": "",
    "save": False,
    "may_go": True,
    "opens": False,
    "close": None,
}
"""What the window asks of a feature -> what it goes on with where the answer cannot be used."""


def made(features: tuple[type[Feature], ...], context: Context) -> tuple[Feature, ...]:
    """Make every feature, in order; one of somebody else's that cannot be made is left out."""
    result = []
    for feature in features:
        if feature.__module__.startswith(f"{plugin_folders.APP.name}."):
            with context.shell.made_for(feature.roles):
                result.append(feature(context))
            continue
        try:
            with context.shell.made_for(_roles(feature)):
                foreign = feature(context)
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # whatever somebody's file does
            _refuse(feature, "its constructor does not work", error, context)
            continue
        for method, answer in _ANSWERS.items():
            setattr(foreign, method, _answered(foreign, method, answer))
        result.append(foreign)
    return tuple(result)


def _roles(feature: type[Feature]) -> frozenset[Role]:
    """Return for whom somebody else's feature exists; those of a feature that does not say it where
    what it says names no roles.
    """
    try:
        return frozenset(Role(str(role)) for role in feature.roles)
    except (TypeError, ValueError):
        return Feature.roles


def _answered(feature: Feature, method: str, answer: Any) -> Callable[..., Any]:
    """Return a method that gives `answer` where the feature's own raises or gives another type."""
    ask: Callable[..., Any] = getattr(feature, method)

    def call(*given: Any) -> Any:
        fault = f"{method}() does not work"
        try:
            result = ask(*given)
            if answer is None or isinstance(result, type(answer)):
                return result
            raise TypeError(f"gives {result!r}; give {type(answer).__name__}")
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # whatever somebody's file does
            _refuse(type(feature), fault, error, feature.context)
        return answer

    return call


def _refuse(feature: type[Feature], fault: str, error: BaseException, context: Context) -> None:
    path = Path(getattr(sys.modules.get(feature.__module__), "__file__", None) or feature.__name__)
    text = f"{type(error).__name__}: {error}".rstrip(": ")
    reason = f"{path}: feature {feature.__name__}: {fault}: {text}"
    plugin_folders.refused[path] = reason
    context.shell.messages.show_until(f"feature {path}", reason)
