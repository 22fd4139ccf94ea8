"""`acus plate`: the fiducial plates that a registration is checked with."""

import typer

from app.commands.answer import Commands
from app.commands.registration import list_plates

app = Commands(help="Fiducial plates (docs/registration.md).")
app.command("list")(list_plates)


def register(root: typer.Typer) -> None:
    """Add `plate` to the command line."""
    root.add_typer(app, name="plate")
