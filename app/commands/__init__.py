"""The command line: one file per noun; each parses, calls one room and returns an `Answer`.

A file named in `NOUNS`, and every file in `commands/` of a folder of plug-ins, exposes
`register(root)`, which adds its commands; names that a command had before stay beside the new one,
hidden. Rooms are imported inside the commands, so that `acus --help` is instant.
"""

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Annotated

import typer

from app import __version__
from app.commands.answer import Commands
from app.core import plugin_folders

NOUNS = (
    *("run", "demo", "check", "ct", "pacs", "structures", "transform", "session"),
    *("store", "people", "results"),
    *("device", "camera", "calibrate", "registration", "pen", "urdf", "explain"),
    *("exercise", "law", "plugin", "study"),
)


def build() -> typer.Typer:
    """Return the whole command line, every noun registered."""
    root = Commands(
        name="acus",
        help="A trainer for CT-guided needle insertion. Training only; not a medical device.",
        add_completion=True,
    )
    root.callback()(_options)
    for noun in NOUNS:
        import_module(f"{__name__}.{noun}").register(root)
    for added in plugin_folders.modules("commands"):
        _register(added, root)
    return root


def _register(added: ModuleType, root: typer.Typer) -> None:
    """Add the commands of a plug-in; one of somebody else's that fails is refused."""
    path = Path(added.__file__ or "")
    folder = plugin_folders.folder_of(path)
    try:
        added.register(root)
    except Exception as error:
        if folder is not None and folder.is_own:
            raise
        reason = f"register() does not work: {type(error).__name__}: {error}"
        plugin_folders.refused[path] = f"{path}: {reason}"


def _print_version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"acus {__version__}")
        raise typer.Exit


def _options(
    version: Annotated[
        bool,
        typer.Option(
            "--version", help="Print the version.", callback=_print_version, is_eager=True
        ),
    ] = False,
) -> None:
    """Take what stands before the noun."""
