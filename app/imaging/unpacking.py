"""Zip archives, unpacked to a private folder that goes when nobody needs it any more."""

import os
import shutil
import stat
import tempfile
import weakref
import zipfile
from pathlib import Path, PurePosixPath

from app.core.progress import Progress
from app.imaging.errors import FolderError
from app.imaging.series import Ignored

MOST_FILES = 200_000
MOST_RATIO = 200
"""An archive that grows by more than this on the whole, beyond `BOMB_BYTES`, is refused."""

BOMB_BYTES = 1 << 30
RESERVE_BYTES = 1 << 29
"""Of the disk so much stays free."""

_CHUNK = 1 << 20
_STORED, _DEFLATED = zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED


class Unpacked:
    """Files of an archive on the disk; deleted with this object, at `close` or at the end.

    Attributes:
        root: the folder, for this user only.
        ignored: members that were left out, and why.
    """

    def __init__(self) -> None:
        self.root = Path(tempfile.mkdtemp(prefix="acus-zip-"))
        self.ignored: list[Ignored] = []
        self._finalizer = weakref.finalize(self, shutil.rmtree, self.root, True)

    def close(self) -> None:
        """Delete the files; idempotent."""
        self._finalizer()


def unpack(path: Path, progress: Progress) -> Unpacked:
    """Unpack a zip archive.

    Members are named relative to the archive; absolute names, ways out of it (`..`), links and
    encrypted members are left out by name.

    Raises:
        FolderError: if it is damaged, grows out of all proportion, or does not fit the disk;
            nothing is left behind.
        Cancelled: if `progress` was cancelled; nothing is left behind.
    """
    unpacked: Unpacked | None = None
    try:
        with zipfile.ZipFile(path) as archive:
            members = [member for member in archive.infolist() if not member.is_dir()]
            _check(path, members)
            unpacked = Unpacked()
            _extract(archive, members, unpacked, progress)
        return unpacked
    except (zipfile.BadZipFile, OSError, NotImplementedError, ValueError, RuntimeError) as error:
        _close(unpacked)
        if isinstance(error, FolderError):
            raise
        reason = getattr(error, "strerror", None) or str(error)
        raise FolderError(f"{path} cannot be unpacked: {reason}") from error
    except BaseException:
        _close(unpacked)
        raise


def _close(unpacked: Unpacked | None) -> None:
    if unpacked is not None:
        unpacked.close()


def _check(path: Path, members: list[zipfile.ZipInfo]) -> None:
    whole = sum(member.file_size for member in members)
    packed = max(sum(member.compress_size for member in members), 1)
    if len(members) > MOST_FILES:
        raise FolderError(f"{path} holds {len(members)} files; {MOST_FILES} are unpacked at most")
    if whole > BOMB_BYTES and whole / packed > MOST_RATIO:
        raise FolderError(
            f"{path} would grow {whole / packed:.0f} times to {whole / 1e9:.1f} GB: no archive of "
            "pictures does that; unpack it yourself if you trust it"
        )
    free = shutil.disk_usage(tempfile.gettempdir()).free - RESERVE_BYTES
    if whole > free:
        raise FolderError(
            f"{path} unpacks to {whole / 1e9:.1f} GB and {max(free, 0) / 1e9:.1f} GB are free in "
            f"{tempfile.gettempdir()}; make room, or unpack it elsewhere and open that folder"
        )


def _extract(
    archive: zipfile.ZipFile,
    members: list[zipfile.ZipInfo],
    unpacked: Unpacked,
    progress: Progress,
) -> None:
    for number, member in enumerate(members):
        progress.report(number / len(members), f"unpacking {number + 1} of {len(members)}")
        if reason := _refused(member):
            name = member.filename.replace("\\", "/").replace("/", "_")[:100]
            unpacked.ignored.append(Ignored(unpacked.root / name, reason))
            continue
        target = unpacked.root.joinpath(*PurePosixPath(member.filename).parts)
        target.parent.mkdir(parents=True, exist_ok=True)
        with archive.open(member) as packed, target.open("xb") as plain:
            while chunk := packed.read(_CHUNK):  # never more than the size that was checked
                progress.report(number / len(members))
                plain.write(chunk)


def _refused(member: zipfile.ZipInfo) -> str:
    """Why a member is left out; empty if it is not."""
    name = PurePosixPath(member.filename.replace("\\", "/"))
    if name.is_absolute() or ".." in name.parts or ":" in member.filename or not name.parts:
        return "leads out of the archive"
    if "\\" in member.filename or any(len(os.fsencode(part)) > 255 for part in name.parts):
        return "has a name that is no file's"
    if stat.S_ISLNK(member.external_attr >> 16):
        return "a link, not a file"
    if member.flag_bits & 1:
        return "encrypted; unpack the archive yourself"
    if member.compress_type not in (_STORED, _DEFLATED):
        return "packed in a way that is not read (stored and deflated are)"
    return ""
