"""What can be searched for series: a folder, a DICOMDIR, a zip archive, one file.

Archives and DICOMDIRs are foreign files: they are read in the worker process, by the functions that
are called jobs here.
"""

import os
import shutil
import stat
import weakref
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from app.core.messages import sentence
from app.core.progress import Progress
from app.core.temporary import sweep_temporary, temporary_folder
from app.imaging.errors import FileDamagedError, FolderError
from app.imaging.series import Ignored
from app.imaging.worker.jobs import DIRECTORY, UNPACK
from app.imaging.worker.limits import MOST_SECONDS, Allowance
from app.imaging.worker.pool import shared_worker

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
        raise FolderError(
            sentence("it is damaged ({error_name})", error_name=type(error).__name__)
        ) from error


def _check(members: list[zipfile.ZipInfo], bounds: Bounds) -> None:
    whole = sum(member.file_size for member in members)
    packed = max(sum(member.compress_size for member in members), 1)
    if len(members) > bounds.files:
        raise FolderError(
            sentence(
                "it holds {files} files; {bounds_files} are unpacked at most",
                files=len(members),
                bounds_files=bounds.files,
            )
        )
    if whole > bounds.bomb_bytes and whole / packed > bounds.ratio:
        raise FolderError(
            sentence(
                "it would grow {growth:.0f} times to {unpacked_gb:.1f} GB: no archive of "
                "pictures does that; unpack it yourself if you trust it",
                growth=whole / packed,
                unpacked_gb=whole / 1e9,
            )
        )
    if whole > bounds.free_bytes:
        raise FolderError(
            sentence(
                "it unpacks to {unpacked_gb:.1f} GB and {free_gb:.1f} GB are free in the "
                "temporary folder; make room, or unpack it elsewhere and open that folder",
                unpacked_gb=whole / 1e9,
                free_gb=max(bounds.free_bytes, 0) / 1e9,
            )
        )


def _extract(
    archive: zipfile.ZipFile, members: list[zipfile.ZipInfo], root: Path, progress: Progress
) -> list[tuple[str, str]]:
    left_out = []
    for number, member in enumerate(members):
        progress.report(
            number / len(members),
            sentence("unpacking {current} of {count}", current=number + 1, count=len(members)),
        )
        if reason := _refused(member):
            left_out.append((member.filename.replace("\\", "/").replace("/", "_")[:100], reason))
            continue
        target = root.joinpath(*PurePosixPath(member.filename).parts)
        target.parent.mkdir(parents=True, exist_ok=True)
        with archive.open(member) as packed, target.open("xb") as plain:
            while chunk := packed.read(_CHUNK):  # never more than the size that was checked
                progress.report(
                    number / len(members),
                    sentence(
                        "unpacking {current} of {count}", current=number + 1, count=len(members)
                    ),
                )
                plain.write(chunk)
    return left_out


def _refused(member: zipfile.ZipInfo) -> str:
    """Return why a member is left out; empty if it is not."""
    name = PurePosixPath(member.filename.replace("\\", "/"))
    if name.is_absolute() or ".." in name.parts or ":" in member.filename or not name.parts:
        return sentence("leads out of the archive")
    if "\\" in member.filename or any(len(os.fsencode(part)) > 255 for part in name.parts):
        return sentence("has a name that is no file's")
    if stat.S_ISLNK(member.external_attr >> 16):
        return sentence("a link, not a file")
    if member.flag_bits & 1:
        return sentence("encrypted; unpack the archive yourself")
    if member.compress_type not in (_STORED, _DEFLATED):
        return sentence("packed in a way that is not read (stored and deflated are)")
    return ""


_MOST_RECORDS = 1_000_000


def named_files(path: Path, progress: Progress) -> tuple[tuple[str, ...], ...]:
    """Job of the worker: names of the files that a DICOMDIR refers to, folder by folder.

    Raises:
        FileDamagedError: if it holds more records than any medium.
    """
    import pydicom

    records = pydicom.dcmread(path, force=True).get("DirectoryRecordSequence") or []
    if len(records) > _MOST_RECORDS:
        raise FileDamagedError(sentence("it holds {records} records", records=len(records)))
    named = [record.get("ReferencedFileID") for record in records]
    return tuple(
        (each,) if isinstance(each, str) else tuple(map(str, each)) for each in named if each
    )


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
        sweep_temporary()
        self.root = temporary_folder("zip")
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
        raise FolderError(
            sentence(
                "{path} cannot be unpacked: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    try:
        free = shutil.disk_usage(unpacked.root).free - RESERVE_BYTES
        bounds = Bounds(MOST_FILES, MOST_RATIO, BOMB_BYTES, free)
        arguments = (path.absolute(), unpacked.root, bounds)
        allowed = Allowance(MOST_SECONDS)
        left_out = shared_worker().call(UNPACK, arguments, allowed, progress)
    except (FolderError, FileDamagedError, OSError) as error:
        unpacked.close()
        reason = getattr(error, "strerror", None) or str(error)
        raise FolderError(
            sentence("{path} cannot be unpacked: {reason}", path=path, reason=reason)
        ) from error
    except BaseException:
        unpacked.close()
        raise
    unpacked.ignored.extend(Ignored(unpacked.root / name, reason) for name, reason in left_out)
    return unpacked


_DIRECTORY_CLASS = b"1.2.840.10008.1.3.10"
_HEAD = 512
_NIFTI_ENDINGS = (".nii", ".nii.gz")


@dataclass(slots=True)
class SeriesSource:
    """Files to look at.

    Attributes:
        path: what was named.
        root: the folder that the files are named relative to.
        files: to be examined.
        ignored: what is known not to be one, and why.
        keeper: holds unpacked files on the disk as long as it lives; None where nothing is.
    """

    path: Path
    root: Path
    files: list[Path] = field(default_factory=list)
    ignored: list[Ignored] = field(default_factory=list)
    keeper: Any = None


def open_source(path: Path, progress: Progress) -> SeriesSource:
    """Find the files that a path stands for.

    Args:
        path: a folder (searched at any depth, links to folders are not followed), a zip archive
            (unpacked to a private folder, which is deleted with the listing), a DICOMDIR (the
            files that it names below its own folder), or one DICOM or NIfTI file.
        progress: told how far it is; cancels it.

    Raises:
        FolderError: if it does not exist, cannot be read or is none of these.
        Cancelled: if `progress` was cancelled.
    """
    try:
        is_file = path.is_file()
        head = _head(path) if is_file else b""
    except (OSError, ValueError) as error:
        raise FolderError(
            sentence("{path} cannot be read: {reason}", path=path, reason=why(error))
        ) from error
    if not is_file:
        return _folder(path, progress)
    if head[:2] == b"PK":
        return _unpacked(path, unpack(path, progress.part(0.0, 0.5)), progress)
    if _DIRECTORY_CLASS in head:
        return _directory(path, progress)
    if head[128:132] == b"DICM" or is_nifti(path):
        return SeriesSource(path, path.parent, [path])
    raise FolderError(
        sentence(
            "{path} is a file, and no DICOM, DICOMDIR, NIfTI or zip file; name the folder it is in",
            path=path,
        )
    )


def is_nifti(path: Path) -> bool:
    """Return whether a file is called as NIfTI files are."""
    return path.name.lower().endswith(_NIFTI_ENDINGS)


def why(error: Exception) -> str:
    """Return the system's words for an error of a file."""
    return getattr(error, "strerror", None) or str(error)


def _head(path: Path) -> bytes:
    with path.open("rb") as stream:
        return stream.read(_HEAD)


def _folder(root: Path, progress: Progress) -> SeriesSource:
    try:
        os.scandir(root).close()
    except FileNotFoundError:
        raise FolderError(
            sentence("{root} does not exist; name a folder with DICOM files", root=root)
        ) from None
    except NotADirectoryError:
        raise FolderError(
            sentence("{root} is no folder; name one with DICOM files", root=root)
        ) from None
    except (OSError, ValueError) as error:
        raise FolderError(
            sentence("{root} cannot be read: {reason}", root=root, reason=why(error))
        ) from error
    source = SeriesSource(root, root)
    source.files.extend(_walk(root, source.ignored, progress))
    return source


def _walk(root: Path, ignored: list[Ignored], progress: Progress) -> Iterator[Path]:
    def unreadable(error: OSError) -> None:
        ignored.append(Ignored(Path(error.filename), f"folder cannot be read: {why(error)}"))

    count = 0
    for folder, folders, names in os.walk(root, onerror=unreadable):
        progress.report(0.0, sentence("{count} files found", count=count))
        folders.sort()
        count += len(names)
        yield from (Path(folder, name) for name in sorted(names))


def _unpacked(path: Path, archive: Any, progress: Progress) -> SeriesSource:
    source = SeriesSource(path, archive.root, ignored=list(archive.ignored), keeper=archive)
    source.files.extend(_walk(archive.root, source.ignored, progress.part(0.5, 0.5)))
    return source


# --- DICOMDIR


def _directory(path: Path, progress: Progress) -> SeriesSource:
    """Files that a DICOMDIR, and those it names in turn, name; what is not there is said."""
    root = path.parent
    source = SeriesSource(path, root)
    waiting, seen = [path], {path}
    while waiting:
        directory = waiting.pop(0)
        named = _named(directory, progress)
        dropped = _dropped(directory.parent, named)
        for parts in named:
            found = _inside(directory.parent, parts, dropped)
            if found is None:
                shown = directory.parent.joinpath(*(part.replace("/", "_") for part in parts))
                source.ignored.append(Ignored(shown, "named in the DICOMDIR, but not there"))
            elif found not in seen:
                seen.add(found)
                is_directory = _DIRECTORY_CLASS in _head(found)
                (waiting if is_directory else source.files).append(found)
    source.files.sort()
    return source


def _named(path: Path, progress: Progress) -> list[tuple[str, ...]]:
    try:
        found = shared_worker().call(
            DIRECTORY, (path.absolute(),), Allowance(MOST_SECONDS), progress
        )
        return list(dict.fromkeys(found))
    except (FileDamagedError, OSError) as error:
        raise FolderError(
            sentence(
                "{path} cannot be read as a DICOMDIR ({error}); open its folder instead",
                path=path,
                error=error,
            )
        ) from error


def _dropped(root: Path, named: list[tuple[str, ...]]) -> int:
    """Return how many leading folders of the names are not there: 0, but where a medium was
    moved.
    """
    most = max((len(parts) for parts in named), default=1)
    counts = [len({_inside(root, parts, n) for parts in named} - {None}) for n in range(most)]
    return counts.index(max(counts))


def _inside(root: Path, parts: tuple[str, ...], dropped: int) -> Path | None:
    """File of these names, but the first few, below the folder."""
    if any(part in ("", ".", "..") or set(part) & set("/\\\0") for part in parts):
        return None
    here: Path | None = root
    for part in parts[dropped:]:
        here = None if here is None else _child(here, part)
    return here if here is not None and here.is_file() else None


def _child(folder: Path, name: str) -> Path | None:
    for spelled in (name, name.lower(), name.upper()):
        path = folder / spelled
        if path.exists() and not path.is_symlink():
            return path
    return None
