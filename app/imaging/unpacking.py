"""Zip archives, unpacked to a private folder that goes when nobody needs it any more."""

import shutil
import weakref
from pathlib import Path

from app.core.passing import passing_folder, sweep_passing
from app.core.progress import Progress
from app.imaging.archive_file import Bounds
from app.imaging.errors import FileDamagedError, FolderError
from app.imaging.series import Ignored
from app.imaging.worker.jobs import UNPACK
from app.imaging.worker.limits import MOST_SECONDS, Allowance
from app.imaging.worker.pool import shared_worker

MOST_FILES = 200_000
MOST_RATIO = 200.0
"""An archive that grows by more than this on the whole, beyond `BOMB_BYTES`, is refused."""

BOMB_BYTES = 1 << 30
RESERVE_BYTES = 1 << 29
"""Of the disk so much stays free."""


class Unpacked:
    """Files of an archive on the disk; deleted with this object, at `close` or at the end.

    Those of a program that was killed are deleted by the next one.

    Attributes:
        root: the folder, for this user only.
        ignored: members that were left out, and why.
    """

    def __init__(self) -> None:
        sweep_passing()
        self.root = passing_folder("zip")
        self.ignored: list[Ignored] = []
        self._finalizer = weakref.finalize(self, shutil.rmtree, self.root, True)

    def close(self) -> None:
        """Delete the files; idempotent."""
        self._finalizer()


def unpack(path: Path, progress: Progress) -> Unpacked:
    """Unpack a zip archive, in the worker process.

    Members are named relative to the archive; absolute names, ways out of it (`..`), links and
    encrypted members are left out by name.

    Raises:
        FolderError: if it is damaged, grows out of all proportion, or does not fit the disk;
            nothing is left behind.
        WorkerError: if the process that unpacks it cannot be started.
        Cancelled: if `progress` was cancelled; nothing is left behind.
    """
    try:
        unpacked = Unpacked()
    except OSError as error:
        raise FolderError(f"{path} cannot be unpacked: {error.strerror or error}") from error
    try:
        free = shutil.disk_usage(unpacked.root).free - RESERVE_BYTES
        bounds = Bounds(MOST_FILES, MOST_RATIO, BOMB_BYTES, free)
        arguments = (path.absolute(), unpacked.root, bounds)
        allowed = Allowance(MOST_SECONDS)
        left_out = shared_worker().call(UNPACK, arguments, allowed, progress)
    except (FolderError, FileDamagedError, OSError) as error:
        unpacked.close()
        reason = getattr(error, "strerror", None) or str(error)
        raise FolderError(f"{path} cannot be unpacked: {reason}") from error
    except BaseException:
        unpacked.close()
        raise
    unpacked.ignored.extend(Ignored(unpacked.root / name, reason) for name, reason in left_out)
    return unpacked
