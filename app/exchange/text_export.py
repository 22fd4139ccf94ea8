"""Files for other programs, whole or not at all."""

from pathlib import Path

from app.core.errors import writing
from app.core.files import write_atomically
from app.exchange.errors import ExportError


def write_text(path: Path, text: str) -> None:
    """Write a text file, whole or not at all.

    Raises:
        ExportError: if the file cannot be written.
    """
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file, whole or not at all.

    Raises:
        ExportError: if the file cannot be written.
    """
    with writing(path, ExportError):
        write_atomically(path, content)
