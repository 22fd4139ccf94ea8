"""Packages of extras, imported when a file of their kind is met."""

from importlib import import_module
from typing import Any

from app.core.extras import not_installed
from app.imaging.structures.errors import ExtraMissingError

_EXTRAS = {"highdicom": "structures", "nrrd": "structures", "nibabel": "nifti"}


def extra(module: str, what: str) -> Any:
    """Import a package of an extra.

    Args:
        module: its name.
        what: what needs it, for the message.

    Raises:
        ExtraMissingError: if it is not installed; names the extra.
    """
    try:
        return import_module(module)
    except ImportError as error:
        needed = f"{module}, which {what} need,"
        raise not_installed(ExtraMissingError, needed, _EXTRAS[module]) from error
