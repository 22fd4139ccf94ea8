"""A zip archive, read and unpacked in the worker process."""

import os
import stat
import zipfile
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from app.core.progress import Progress
from app.imaging.errors import FolderError

_CHUNK = 1 << 20
_STORED, _DEFLATED = zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED


@dataclass(frozen=True, slots=True)
class Bounds:
    """What an archive may hold.

    Attributes:
        files: at most so many.
        ratio: it may grow by this much on the whole, beyond `bomb_bytes`.
        bomb_bytes: up to here it may grow as it likes.
        free_bytes: the disk has so much for it.
    """

    files: int
    ratio: float
    bomb_bytes: int
    free_bytes: int


def unpack_into(
    path: Path, root: Path, bounds: Bounds, progress: Progress
) -> tuple[tuple[str, str], ...]:
    """Job of the worker: unpack an archive into a folder.

    Args:
        path: the archive.
        root: an empty folder.
        bounds: what it may hold.
        progress: told of each member.

    Returns:
        Members that were left out: a name for each, and why.

    Raises:
        FolderError: if it is damaged or does not keep the bounds.
        OSError: if it cannot be read, or the folder not be written.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            members = [member for member in archive.infolist() if not member.is_dir()]
            _check(members, bounds)
            return tuple(_extract(archive, members, root, progress))
    except (zipfile.BadZipFile, NotImplementedError, EOFError) as error:
        raise FolderError(f"it is damaged ({type(error).__name__})") from error


def _check(members: list[zipfile.ZipInfo], bounds: Bounds) -> None:
    whole = sum(member.file_size for member in members)
    packed = max(sum(member.compress_size for member in members), 1)
    if len(members) > bounds.files:
        raise FolderError(f"it holds {len(members)} files; {bounds.files} are unpacked at most")
    if whole > bounds.bomb_bytes and whole / packed > bounds.ratio:
        raise FolderError(
            f"it would grow {whole / packed:.0f} times to {whole / 1e9:.1f} GB: no archive of "
            "pictures does that; unpack it yourself if you trust it"
        )
    if whole > bounds.free_bytes:
        raise FolderError(
            f"it unpacks to {whole / 1e9:.1f} GB and {max(bounds.free_bytes, 0) / 1e9:.1f} GB are "
            "free in the temporary folder; make room, or unpack it elsewhere and open that folder"
        )


def _extract(
    archive: zipfile.ZipFile, members: list[zipfile.ZipInfo], root: Path, progress: Progress
) -> list[tuple[str, str]]:
    left_out = []
    for number, member in enumerate(members):
        progress.report(number / len(members), f"unpacking {number + 1} of {len(members)}")
        if reason := _refused(member):
            left_out.append((member.filename.replace("\\", "/").replace("/", "_")[:100], reason))
            continue
        target = root.joinpath(*PurePosixPath(member.filename).parts)
        target.parent.mkdir(parents=True, exist_ok=True)
        with archive.open(member) as packed, target.open("xb") as plain:
            while chunk := packed.read(_CHUNK):  # never more than the size that was checked
                progress.report(number / len(members), f"unpacking {number + 1} of {len(members)}")
                plain.write(chunk)
    return left_out


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
