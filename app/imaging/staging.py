"""The folder that an import is written to before it joins the library, whole or not at all."""

import errno
import os
import shutil
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from app.core.descriptors import hold, is_held
from app.core.files import sync
from app.imaging.errors import ImagingError
from app.imaging.privacy.deidentified import LOCK
from app.imaging.series import Series

_PREFIX = ".staging-"
_SPARE_BYTES = 64 * 1024 * 1024
_YOUNG_S = 60.0


class ImportFailedError(ImagingError):
    """A series was not taken into the library; the message says why, and nothing was kept."""


@contextmanager
def staging(library: Path, series: Series) -> Iterator[Path]:
    """Folder beside the library's own for the files of an import; gone afterwards.

    Raises:
        ImportFailedError: if there is no room for the series, or writing fails.
    """
    try:
        library.mkdir(parents=True, exist_ok=True)
        sweep(library)
        _room(library, series)
        folder = Path(tempfile.mkdtemp(dir=library, prefix=_PREFIX))
    except OSError as error:
        raise ImportFailedError(f"the library {library} cannot be written: {_why(error)}") from None
    lock = os.open(folder / LOCK, os.O_CREAT | os.O_RDWR)
    try:
        hold(lock)  # the process that writes there holds it as well
        yield folder
    except OSError as error:
        if isinstance(error, ImagingError):
            raise
        raise ImportFailedError(f"{_why(error)}; nothing was kept") from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        os.close(lock)


def publish(folder: Path, to: Path) -> None:
    """Rename to its place; the lock goes last, so that no sweep takes a living folder."""
    folder.chmod(0o700)
    sync(folder)
    os.rename(folder, to)
    (to / LOCK).unlink(missing_ok=True)
    sync(to.parent)


def discard(folder: Path) -> None:
    """Delete a folder of the library: first it leaves the library, then the disk."""
    gone = Path(tempfile.mkdtemp(dir=folder.parent, prefix=_PREFIX))
    os.rename(folder, gone / folder.name)
    shutil.rmtree(gone, ignore_errors=True)


def sweep(library: Path) -> int:
    """Delete what imports left that died; returns how many. Living ones hold their lock."""
    swept = 0
    for folder in library.glob(f"{_PREFIX}*"):
        if _abandoned(folder):
            shutil.rmtree(folder, ignore_errors=True)
            swept += 1
    return swept


def _room(library: Path, series: Series) -> None:
    """Ask before writing whether it will fit; a disk that fills meanwhile is met later."""
    try:
        needed = sum(path.stat().st_size for path in series.files)
    except OSError:
        raise ImportFailedError(
            "a file of the series is gone: the folder was moved or its medium taken out; "
            "nothing was kept"
        ) from None
    free = shutil.disk_usage(library).free
    if free < needed + _SPARE_BYTES:
        raise ImportFailedError(
            f"the disk of the library has {free / 1e6:.0f} MB free, this series needs "
            f"{(needed + _SPARE_BYTES) / 1e6:.0f} MB; make room, nothing was kept"
        )


def _why(error: OSError) -> str:
    if error.errno == errno.ENOSPC:
        return "the disk of the library is full"
    return error.strerror or type(error).__name__


def _abandoned(folder: Path) -> bool:
    """Whether nobody holds the lock of a folder any more; a kill lets go of it too."""
    try:
        lock = os.open(folder / LOCK, os.O_RDWR)
    except FileNotFoundError:  # just being made, or just being deleted
        try:
            return time.time() - folder.stat().st_mtime > _YOUNG_S
        except OSError:
            return False
    except OSError:
        return False
    try:
        return not is_held(lock)
    finally:
        os.close(lock)
