"""The root of every error that Acus raises on purpose, and what is said of files that fail."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from app.core.messages import sentence


class AcusError(Exception):
    """Something the user can act on.

    The message says what happened, the value, the limit or the valid names, and what to do. The
    families stand beside the code that raises them (`imaging.errors`, `device.errors`, ...). The
    command line prints the message in one line and ends with exit code 2; the window shows it.
    """


class ConfigurationError(AcusError, ValueError):
    """A settings, profile or exercise file says something that cannot be used."""


class NumericalError(AcusError, ArithmeticError):
    """An input for which no finite answer exists (NaN, infinite or outside the domain)."""


@contextmanager
def reading(path: Path, kind: type[AcusError]) -> Iterator[None]:
    """Raise an error of this kind, which names file and reason, where the block meets `OSError`."""
    try:
        yield
    except OSError as error:
        raise kind(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error


@contextmanager
def writing(path: Path, kind: type[AcusError]) -> Iterator[None]:
    """Raise an error of this kind, which names file and reason, where the block meets `OSError`."""
    try:
        yield
    except OSError as error:
        raise kind(
            sentence(
                "cannot write {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
