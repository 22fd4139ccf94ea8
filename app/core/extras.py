"""What is said where a package that not every installation has is missing."""

from typing import TypeVar

_Family = TypeVar("_Family", bound=Exception)


def not_installed(family: type[_Family], what: str, extra: str, instead: str = "") -> _Family:
    """Return the error to raise from an ImportError.

    The import itself stays where it is used, as a statement: the contracts of imports see it.

    Args:
        family: of the error.
        what: the package as people call it, and what needs it where that is not plain.
        extra: that brings it.
        instead: what can be done without it.
    """
    said = f"{what} is not installed; install the extra `{extra}`: {pip_command(extra)}"
    return family(f"{said}, or {instead}" if instead else said)


def pip_command(extra: str) -> str:
    """Return the command that installs an extra."""
    return f"pip install 'acus[{extra}]'"
