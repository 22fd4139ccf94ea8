"""Options of the commands that run a trainer: by which protocols others are told what is live."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from app.compose.watchers import RunWatcher

Igtl = Annotated[
    int | None,
    typer.Option(
        "--igtl", metavar="PORT", help="Serve OpenIGTLink, for 3D Slicer: 18944 (docs/links.md)."
    ),
]
Rosbridge = Annotated[
    int | None,
    typer.Option("--rosbridge", metavar="PORT", help="Serve rosbridge, for ROS programs: 9090."),
]
Foxglove = Annotated[
    int | None,
    typer.Option("--foxglove", metavar="PORT", help="Serve Foxglove's web sockets: 8765."),
]
Host = Annotated[
    str | None,
    typer.Option(
        "--links-host", help="Where links listen, such as 0.0.0.0, :: or *; default: this computer."
    ),
]
Token = Annotated[
    str | None,
    typer.Option(
        "--links-token",
        envvar="ACUS_LINKS_TOKEN",
        show_envvar=True,
        help="What peers of web sockets must know; elsewhere than on this computer they have to.",
    ),
]
Allow = Annotated[
    str | None,
    typer.Option(
        "--links-allow", help="Addresses or networks from which peers may come, with commas."
    ),
]


def given(**options: Any) -> dict[str, str]:
    """Return the options that were given, by their names on the command line."""
    return {
        name.replace("_", "-"): str(value)
        for name, value in options.items()
        if value is not None and value is not False
    }


def opened(options: dict[str, str]) -> tuple[RunWatcher, ...]:
    """Open the links that are asked for, and say where they are.

    Raises:
        AcusError: if one cannot be opened; nothing stays open then.
    """
    if not options.keys() - {"links-token"}:  # which may stand in the environment
        return ()
    from app.compose.watchers import open_watchers

    watchers = open_watchers(options)
    for watcher in watchers:
        for line in watcher.lines():
            typer.echo(line)
    return watchers
