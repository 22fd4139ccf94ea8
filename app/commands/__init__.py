"""The command line: one file per noun; each parses, calls one room and returns an `Answer`.

Every file here that defines `register(root)`, and every file in `commands/` of a folder of
plug-ins, adds its commands by it; `RANK` says where the noun stands among those of the program in
`acus --help`. Rooms are imported inside the commands, so that `acus --help` is instant.
"""

from importlib import import_module
from operator import attrgetter
from pathlib import Path
from types import ModuleType
from typing import Annotated

import typer

from app import __version__
from app.commands.answer import Commands
from app.core import plugin_folders
from app.core.messages import sentence

_MARK = b"\ndef register("


def build() -> typer.Typer:
    """Return the whole command line, every noun registered."""
    root = Commands(
        name="acus",
        help="A trainer for CT-guided needle insertion. Training only; not a medical device.",
        add_completion=True,
    )
    root.callback()(_options)
    for noun in _nouns():
        noun.register(root)
    for added in plugin_folders.modules("commands"):
        _register(added, root)
    return root


def _nouns() -> list[ModuleType]:
    """Import the program's own files of commands, in the order of `acus --help`."""
    files = (path for path in Path(__file__).parent.glob("*.py") if _MARK in path.read_bytes())
    modules = [import_module(f"{__name__}.{path.stem}") for path in files]
    return sorted(modules, key=attrgetter("RANK"))


def _register(added: ModuleType, root: typer.Typer) -> None:
    """Add the commands of a plug-in; one of somebody else's that fails or takes a name is refused.

    Its commands are built once apart: whether typer can make anything of them shows only then.
    """
    path = Path(added.__file__ or "")
    folder = plugin_folders.folder_of(path)
    if folder is not None and folder.is_own:
        added.register(root)
        return
    apart = Commands(name=root.info.name)
    try:
        added.register(apart)
        taken = typer.main.get_group(apart).commands.keys() & typer.main.get_group(root).commands
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # SystemExit too: whatever somebody's file does
        text = f"{type(error).__name__}: {error}".rstrip(": ")
        plugin_folders.refused[path] = sentence(
            "{path}: register() does not work: {reason}", path=path, reason=text
        )
        return
    if taken:
        plugin_folders.refused[path] = sentence(
            "{path}: `acus {command}` is there already; rename it", path=path, command=min(taken)
        )
        return
    root.registered_commands += apart.registered_commands
    root.registered_groups += apart.registered_groups


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
