"""`acus run`: the trainer."""

import errno
import os
from pathlib import Path
from typing import Annotated, Any

import typer

from app.commands import completion, link_options
from app.core.messages import sentence

RANK = 10


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("run")(run)


def run(
    ct: Annotated[
        Path | None, typer.Option("--ct", help="Folder of a CT to open; default: the start page.")
    ] = None,
    exercise: Annotated[
        str, typer.Option(help="Exercise to begin with.", autocompletion=completion.exercises)
    ] = "",
    device: Annotated[
        str | None,
        typer.Option(
            help="Serial port of a real robot (docs/hardware.md), or haply: for an Inverse3"
            " (docs/haply.md); default: simulated."
        ),
    ] = None,
    cameras: Annotated[
        str | None,
        typer.Option(
            help="A settings file, left=SOURCE,right=SOURCE or simulated (docs/cameras.md); "
            "default: as chosen in the window."
        ),
    ] = None,
    pen: Annotated[
        str | None,
        typer.Option(
            help="No robot: a webcam that sees a pen with printed markers, usb:0, folder:PATH, "
            "video:PATH or simulated (docs/pen.md); or igtl:HOST, a tracked needle (docs/links.md)."
        ),
    ] = None,
    igtl: link_options.Igtl = None,
    rosbridge: link_options.Rosbridge = None,
    foxglove: link_options.Foxglove = None,
    links_host: link_options.Host = None,
    links_token: link_options.Token = None,
    links_allow: link_options.Allow = None,
) -> None:
    """Open the trainer. The mouse moves a simulated hand, or a real robot its own needle."""
    _check(ct, device, exercise)
    from app.commands.session import tell_folder
    from app.compose import needle_sources
    from app.compose.desktop import Desktop
    from app.tracking.cameras.settings import parse_cameras
    from app.views.shell.application import start
    from app.views.shell.language import Rebuilding
    from app.views.shell.remembered import show_as_remembered
    from app.views.shell.window import open_window

    if pen is not None:
        needle_sources.check(pen)
    chosen = None if cameras is None else parse_cameras(cameras)
    asked = link_options.given(
        igtl=igtl,
        rosbridge=rosbridge,
        foxglove=foxglove,
        links_host=links_host,
        links_token=links_token,
        links_allow=links_allow,
    )
    watchers = link_options.opened(asked)
    tell_folder()
    application = start()
    services = Desktop(watchers=watchers)

    def make() -> Any:
        """Return a window with what the command line asks for: another language keeps it."""
        made = open_window(services)
        if device is not None:
            made.equipment.take(device)
        if chosen is not None:
            made.equipment.take_cameras(chosen)
        if pen is not None:
            made.equipment.take_pen(pen)
        return made

    rebuilding = Rebuilding(make)
    window = rebuilding.window
    show_as_remembered(window, window.settings)
    if exercise:
        window.begin_exercise(exercise)
    if ct is not None:
        window.open_ct.open_folder(ct)
    code = application.exec()
    rebuilding.close()
    for watcher in watchers:
        watcher.close()
    raise typer.Exit(code)


def _check(ct: Path | None, device: str | None, exercise: str) -> None:
    """Look at what was asked for before a window opens.

    Raises:
        AcusError: if there is no such folder, port or exercise; says which there are.
    """
    if ct is not None and not ct.exists():
        from app.imaging.errors import FolderError

        raise FolderError(
            sentence("--ct {ct} does not exist; name a folder or file with a CT", ct=ct)
        )
    if device is not None and os.sep in device and not Path(device).exists():
        from app.device.errors import LinkError
        from app.device.links.port import reason

        absent = FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), device)
        raise LinkError(reason(device, 0, absent))
    if exercise:
        from app.exercises.library import load_exercise

        load_exercise(exercise)
