"""Files: read whole only up to a limit, written so that nothing is ever half-written.

What is written stands beside first and is renamed then.

Every change of the store's files goes through here, and is told to who watches (`watched`) before
it happens: a test ends programs at each of them in turn. What a killed program had under a
temporary name is told by that name (`core.temporary`) and swept by the next.
"""

import errno
import os
import shutil
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

from app.core.temporary import name_of_process, process_has_gone

LARGEST_FILE = 1 << 20
"""No file of settings, profile, calibration, exercise or summary is larger [bytes]."""

Watch = Callable[[str, Path], None]
"""Told what is about to be done, and to which file or folder."""

_watches: list[Watch] = []


@contextmanager
def watched(watch: Watch) -> Iterator[None]:
    """Tell `watch` of every step before it is done."""
    _watches.append(watch)
    try:
        yield
    finally:
        _watches.remove(watch)


def step(deed: str, path: Path) -> None:
    """Tell who watches that something is about to be done."""
    for watch in _watches:
        watch(deed, path)


def read_at_most(path: Path, most: int = LARGEST_FILE) -> bytes:
    """Read a whole file that somebody else may have written, if it is no larger than it may be.

    Args:
        path: the file.
        most: bytes that it may have.

    Raises:
        OSError: if it cannot be read; with EFBIG if it is larger.
    """
    with path.open("rb") as stream:
        content = stream.read(most + 1)
    if len(content) > most:
        raise OSError(errno.EFBIG, f"it is larger than {most / (1 << 20):g} MB", str(path))
    return content


def beside(path: Path) -> Path:
    """Return a new temporary name in the folder of a file, hidden, that tells whose it is."""
    return path.with_name(f".{path.name}.{name_of_process()}")


BINARY: Final = getattr(os, "O_BINARY", 0)
"""Flag of `os.open` without which Windows writes another end of each line."""

_SYNCED: Final = os.O_RDWR if os.name == "nt" else os.O_RDONLY


def write_atomically(path: Path, content: str | bytes) -> None:
    """Write a whole file or nothing: a temporary file in the same folder, flushed, then renamed."""
    path.parent.mkdir(parents=True, exist_ok=True)
    raw = content.encode() if isinstance(content, str) else content
    part = beside(path)
    try:
        step("write", part)
        with part.open("xb") as stream:
            stream.write(raw)
            stream.flush()
            os.fsync(stream.fileno())
        replace(part, path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def replace(source: Path, target: Path) -> None:
    """Move a file or folder over another name in one step."""
    step("replace", target)
    os.replace(source, target)


def remove(path: Path) -> None:
    """Delete a file, or a folder with all that is in it; nothing is no error."""
    if path.is_dir() and not path.is_symlink():
        step("remove", path)
        shutil.rmtree(path)
    elif path.exists() or path.is_symlink():
        step("remove", path)
        path.unlink(missing_ok=True)


def sweep(folder: Path) -> int:
    """Delete what killed programs left in a folder under temporary names; return how many.

    A folder that cannot be read or written stays as it is.
    """
    try:
        names = [entry.name for entry in os.scandir(folder) if entry.name.startswith(".")]
    except OSError:
        return 0
    swept = 0
    for name in names:
        if process_has_gone(name):
            with suppress(OSError):
                remove(folder / name)
                swept += 1
    return swept


def sync(path: Path) -> None:
    """Wait until a file, or the entries of a folder, stand on the disk.

    Windows opens no folder, and writes its entries down by itself.
    """
    try:
        handle = os.open(path, _SYNCED)
    except PermissionError:
        if path.is_dir():
            return
        raise
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
