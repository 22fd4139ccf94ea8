"""What is said where a package that not every installation has is missing."""

from typing import TypeVar

from app.core.errors import AcusError

_Family = TypeVar("_Family", bound=AcusError)


def not_installed(family: type[_Family], what: str, extra: str) -> _Family:
    """Return the error to raise from an ImportError.

    The import itself stays where it is used, as a statement: the contracts of imports see it.

    Args:
        family: of the error.
        what: the package as people call it.
        extra: that brings it.
    """
    return family(
        f"{what} is not installed; install the extra `{extra}`: pip install 'acus[{extra}]'"
    )
