"""Text files for other programs."""

from pathlib import Path

from app.core.files import write_atomically
from app.exchange.errors import ExportError


def write_text(path: Path, text: str) -> None:
    """Write a text file, whole or not at all.

    Raises:
        ExportError: if the file cannot be written.
    """
    try:
        write_atomically(path, text)
    except OSError as error:
        raise ExportError(f"cannot write {path}: {error.strerror or error}") from error
