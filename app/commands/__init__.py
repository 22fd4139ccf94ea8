"""The command line: one file per noun; each parses, calls one room and prints.

A file here exposes `register(app)`, which adds its commands. Rooms are imported inside the
commands, so that `acus --help` is instant.
"""

from importlib import import_module
from pkgutil import iter_modules

import typer


def build() -> typer.Typer:
    """Return the whole command line, every file of this folder registered."""
    app = typer.Typer(
        name="acus",
        help="A trainer for CT-guided needle insertion. Training only; not a medical device.",
        no_args_is_help=True,
        add_completion=False,
        rich_markup_mode="markdown",  # in rich's own markup [mm] is a style, and is cut out
        pretty_exceptions_enable=False,
    )
    for module in sorted(iter_modules(__path__), key=lambda item: item.name):
        import_module(f"{__name__}.{module.name}").register(app)
    return app
