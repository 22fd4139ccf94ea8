"""Child processes that run this very program, wherever it was started from.

The package's name, `app`, is a common one: a folder of that name in the working directory or on
`PYTHONPATH` must not be taken for it. So a child never looks into the working directory (`-P`), and
looks beside this package before anywhere else.
"""

import os
import sys
from pathlib import Path

from app.core import paths

_ROOT = str(Path(__file__).resolve().parents[2])


def module_command(module: str, *arguments: str, options: tuple[str, ...] = ()) -> list[str]:
    """Return the command line that runs a module; to be run in `environment`.

    Args:
        module: dotted name.
        arguments: of the module.
        options: of the interpreter.
    """
    return [*interpreter(*options), "-m", module, *arguments]


def interpreter(*options: str) -> list[str]:
    """Return the interpreter that a child runs in, to be followed by `-c`, `-m` or a file."""
    return [sys.executable, "-P", *options]


def environment(**values: str) -> dict[str, str]:
    """Return this process's environment for a child, with `values` set in it.

    The child finds the listed folders of plug-ins too, behind all others.
    """
    listed = (str(folder.parent) for folder in paths.plugin_folders())
    places = filter(None, (_ROOT, os.environ.get("PYTHONPATH"), *listed))
    return os.environ | values | {"PYTHONPATH": os.pathsep.join(places)}
