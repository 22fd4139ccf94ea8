"""Text files for other programs."""

from pathlib import Path

from app.core.files import write_atomically
from app.core.messages import sentence
from app.exchange.errors import ExportError


def write_text(path: Path, text: str) -> None:
    """Write a text file, whole or not at all.

    Raises:
        ExportError: if the file cannot be written.
    """
    try:
        write_atomically(path, text)
    except OSError as error:
        raise ExportError(
            sentence(
                "cannot write {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
