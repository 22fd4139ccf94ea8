"""A file that grows at its end, whole up to its last commit, with space set aside for its end.

What is written waits in memory until `commit`. If the disk is full then, the file is cut back to
the last commit, the space set aside is given back, and the same bytes are written into it: whoever
writes then knows (`full`) that only the end may follow. Until `publish` the file has a name that no
list looks at, so that one under its own name is never without its beginning.
"""

import errno
import os
from contextlib import suppress
from pathlib import Path
from time import time
from typing import Final

RESERVE: Final = 4 * 1024 * 1024
"""Set aside for the end [bytes]: the last chunk, score, result, samples of a short attempt and the
index of an hour."""

_NO_SPACE: Final = (errno.ENOSPC, errno.EDQUOT)
_STRAY: Final = 86_400.0
"""What a killed program left under a temporary name is removed after this long [s]."""


class GrowingFile:
    """See above; used by one thread at a time.

    Attributes:
        path: where it stands once it is published.
        full: whether the disk was full: the space set aside is in use.
    """

    def __init__(self, path: Path, reserve: int = RESERVE) -> None:
        self.path = path
        self.full = False
        self._size = reserve
        self._part = path.with_name(f".{path.name}.part")
        self._reserve = path.with_name(f".{path.name}.reserve")
        self._fd = -1
        self._committed = 0
        self._pending = bytearray()
        self._published = False

    @property
    def published(self) -> bool:
        """Whether the file stands under its own name."""
        return self._published

    @property
    def room(self) -> int:
        """Bytes that may surely follow: once full, what is left of the space set aside."""
        return max(0, self._size - len(self._pending)) if self.full else 1 << 62

    def open(self) -> None:
        """Create the file under its temporary name, and set space aside.

        Raises:
            FileExistsError: if there is a file of this name already.
            OSError: if it cannot be created, or there is no space for its end.
        """
        _remove_strays(self.path.parent)
        if self.path.exists():
            raise FileExistsError(errno.EEXIST, "exists already", str(self.path))
        flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY | getattr(os, "O_BINARY", 0)
        try:
            _set_aside(self._reserve, self._size)
            self._fd = os.open(self._part, flags, 0o600)
        except OSError:
            self._reserve.unlink(missing_ok=True)
            raise

    def write(self, data: bytes) -> int:
        """Append, in memory."""
        self._pending += data
        return len(data)

    def tell(self) -> int:
        """Length of the file with what waits in memory."""
        return self._committed + len(self._pending)

    def flush(self) -> None:
        """Nothing: `commit` decides when bytes go to the disk."""

    def commit(self, sync: bool = True) -> None:
        """Hand what waits to the system, and wait for the disk with `sync`.

        Raises:
            OSError: if it cannot be written, not even with the space that was set aside; the file
                ends with the last commit then.
        """
        if self._pending:
            try:
                self._append()
            except OSError as error:
                self._cut()
                if error.errno not in _NO_SPACE or self.full:
                    raise
                self._give_back()
                self._append_or_cut()
            self._committed += len(self._pending)
            self._spend(len(self._pending))
            self._pending.clear()
        if sync:
            os.fsync(self._fd)

    def publish(self) -> None:
        """Commit, and give the file its own name.

        Raises:
            FileExistsError: if another file took the name meanwhile.
            OSError: if it cannot be written.
        """
        self.commit()
        try:
            os.link(self._part, self.path)  # refuses a name that is taken, as a rename would not
        except FileExistsError:
            raise
        except OSError:  # a file system without links
            if self.path.exists():
                raise FileExistsError(errno.EEXIST, "exists already", str(self.path)) from None
            os.rename(self._part, self.path)
        self._part.unlink(missing_ok=True)
        self._published = True
        _sync_folder(self.path.parent)

    def close(self) -> None:
        """Commit the rest and close; what was never published is removed. Idempotent.

        Raises:
            OSError: if it cannot be written.
        """
        if self._fd < 0:
            return
        try:
            self._give_back_space()
            self.commit()
        finally:
            self.abandon()

    def abandon(self) -> None:
        """Close the file as it is on the disk. Idempotent."""
        fd, self._fd = self._fd, -1
        if fd < 0:
            return
        self._pending.clear()
        with suppress(OSError):
            os.close(fd)
        with suppress(OSError):
            self._reserve.unlink(missing_ok=True)
        if not self._published:
            with suppress(OSError):
                self._part.unlink(missing_ok=True)

    def _append(self) -> None:
        view = memoryview(self._pending)
        try:
            while len(view):
                view = view[_write(self._fd, view) :]
        finally:
            view.release()

    def _append_or_cut(self) -> None:
        try:
            self._append()
        except OSError:
            self._cut()
            raise

    def _cut(self) -> None:
        with suppress(OSError):
            os.ftruncate(self._fd, self._committed)
            os.lseek(self._fd, self._committed, os.SEEK_SET)

    def _give_back(self) -> None:
        self.full = True
        self._give_back_space()

    def _give_back_space(self) -> None:
        self._reserve.unlink(missing_ok=True)

    def _spend(self, count: int) -> None:
        if self.full:
            self._size = max(0, self._size - count)


def _write(fd: int, data: memoryview) -> int:
    return os.write(fd, data)


def _set_aside(path: Path, size: int) -> None:
    """Create a file whose blocks are really taken from the disk."""
    fd = os.open(path, os.O_CREAT | os.O_WRONLY | os.O_TRUNC | getattr(os, "O_BINARY", 0), 0o600)
    try:
        if hasattr(os, "posix_fallocate"):
            os.posix_fallocate(fd, 0, size)
        else:
            zeros = memoryview(bytes(size))
            while len(zeros):
                zeros = zeros[_write(fd, zeros) :]
    finally:
        os.close(fd)


def _sync_folder(folder: Path) -> None:
    """Wait until the folder's entries stand on the disk, where a folder can be opened."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def _remove_strays(folder: Path) -> None:
    for path in (*folder.glob(".*.mcap.part"), *folder.glob(".*.mcap.reserve")):
        with suppress(OSError):
            if time() - path.stat().st_mtime > _STRAY:
                path.unlink()
