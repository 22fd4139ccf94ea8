"""Files for other programs, whole or not at all."""

from pathlib import Path

from app.core.files import write_atomically
from app.core.messages import sentence
from app.exchange.errors import ExportError


def write_text(path: Path, text: str) -> None:
    """Write a text file, whole or not at all.

    Raises:
        ExportError: if the file cannot be written.
    """
    _write(path, text)


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file, whole or not at all.

    Raises:
        ExportError: if the file cannot be written.
    """
    _write(path, content)


def _write(path: Path, content: str | bytes) -> None:
    try:
        write_atomically(path, content)
    except OSError as error:
        raise ExportError(
            sentence(
                "cannot write {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
