"""What is said where a package that not every installation has is missing.

Acus is published nowhere, so that no package index knows its extras: in a source folder make
installs one, elsewhere its packages are named.
"""

import re
from importlib.metadata import PackageNotFoundError, requires
from typing import TypeVar

from app.core.messages import sentence
from app.core.paths import in_checkout

_Family = TypeVar("_Family", bound=Exception)


def not_installed(family: type[_Family], package: str, extra: str, instead: str = "") -> _Family:
    """Return the error to raise from an ImportError.

    The import itself stays where it is used, as a statement: the contracts of imports see it.

    Args:
        family: of the error.
        package: its name, as people call it, and what needs it where that is not plain.
        extra: that brings it.
        instead: what can be done without it.
    """
    said = sentence(
        "{package} is not installed; install the extra `{extra}`: {install_command}",
        package=package,
        extra=extra,
        install_command=install_command(extra),
    )
    return family(f"{said}, or {instead}" if instead else said)


def install_command(extra: str) -> str:
    """Return the command that installs an extra: in the source folder, or beside the program.

    Where nothing says of what it consists no package is named: one called as it is a stranger's.
    """
    if in_checkout():
        return f"make extra NAME={extra}"
    names = " ".join(f"'{name}'" for name in packages(extra))
    return f"pip install {names}" if names else sentence("its packages stand in pyproject.toml")


def packages(extra: str) -> list[str]:
    """Return the packages of an extra with their versions, as pip takes them."""
    try:
        known = requires("acus") or []
    except PackageNotFoundError:
        return []
    marked = re.compile(rf"(.*?)\s*;\s*extra == ['\"]{re.escape(extra)}['\"]")
    return [found[1] for one in known if (found := marked.fullmatch(one))]
