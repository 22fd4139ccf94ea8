"""What is told of every run besides the window: one file each, found by being here.

A file defines `watcher(options)`, which opens what the options of the command line ask for, and
returns a `RunWatcher`; None where they ask for nothing of it.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from app.core.errors import ConfigurationError
from app.core.messages import sentence

if TYPE_CHECKING:
    from app.compose.trainer import Rig
    from app.imaging.volume import Volume


class WatchedRun(Protocol):
    """A run as who watches it knows it."""

    @property
    def rig(self) -> Rig:
        """Return the trainer and its parts: others after each change of the plan."""


class RunWatcher(Protocol):
    """Watches runs; its methods return at once."""

    def began(self, run: WatchedRun, volume: Volume | None) -> None:
        """Take a run that has begun; `volume`: the CT, where it is open."""

    def ended(self, run: WatchedRun) -> None:
        """Let go of a run; nothing happens for one that is not watched."""

    def lines(self) -> tuple[str, ...]:
        """Return what the command line says about it, a line each."""

    def close(self) -> None:
        """End what was opened; idempotent."""


def open_watchers(options: Mapping[str, str]) -> tuple[RunWatcher, ...]:
    """Open what options ask for.

    Args:
        options: of the command line, by name without dashes; those that are not given are left out.

    Raises:
        AcusError: if one cannot be used; nothing stays open then.
    """
    files = sorted(Path(__file__).parent.glob("[!_]*.py"))
    opened: list[RunWatcher] = []
    try:
        for path in files:
            made = import_module(f"{__name__}.{path.stem}").watcher(options)
            if made is not None:
                opened.append(made)
    except BaseException:
        for one in opened:
            one.close()
        raise
    if options and not opened:
        raise ConfigurationError(
            sentence("nothing in this program takes --{option}", option=next(iter(options)))
        )
    return tuple(opened)
