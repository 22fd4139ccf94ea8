"""What can be searched for series: a folder, a DICOMDIR, a zip archive, one file."""

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from app.core.progress import Progress
from app.imaging.errors import FileDamagedError, FolderError
from app.imaging.series import Ignored
from app.imaging.unpacking import unpack
from app.imaging.worker.jobs import DIRECTORY
from app.imaging.worker.limits import MOST_SECONDS, Allowance
from app.imaging.worker.pool import shared_worker

_DIRECTORY_CLASS = b"1.2.840.10008.1.3.10"
_HEAD = 512
_NIFTI_ENDINGS = (".nii", ".nii.gz")


@dataclass(slots=True)
class Source:
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


def open_source(path: Path, progress: Progress) -> Source:
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
        raise FolderError(f"{path} cannot be read: {why(error)}") from error
    if not is_file:
        return _folder(path, progress)
    if head[:2] == b"PK":
        return _unpacked(path, unpack(path, progress.part(0.0, 0.5)), progress)
    if _DIRECTORY_CLASS in head:
        return _directory(path, progress)
    if head[128:132] == b"DICM" or is_nifti(path):
        return Source(path, path.parent, [path])
    raise FolderError(
        f"{path} is a file, and no DICOM, DICOMDIR, NIfTI or zip file; name the folder it is in"
    )


def is_nifti(path: Path) -> bool:
    """Whether a file is called as NIfTI files are."""
    return path.name.lower().endswith(_NIFTI_ENDINGS)


def why(error: Exception) -> str:
    """Return the system's words for an error of a file."""
    return getattr(error, "strerror", None) or str(error)


def _head(path: Path) -> bytes:
    with path.open("rb") as stream:
        return stream.read(_HEAD)


def _folder(root: Path, progress: Progress) -> Source:
    try:
        os.scandir(root).close()
    except FileNotFoundError:
        raise FolderError(f"{root} does not exist; name a folder with DICOM files") from None
    except NotADirectoryError:
        raise FolderError(f"{root} is no folder; name one with DICOM files") from None
    except (OSError, ValueError) as error:
        raise FolderError(f"{root} cannot be read: {why(error)}") from error
    source = Source(root, root)
    source.files.extend(_walk(root, source.ignored, progress))
    return source


def _walk(root: Path, ignored: list[Ignored], progress: Progress) -> Iterator[Path]:
    def unreadable(error: OSError) -> None:
        ignored.append(Ignored(Path(error.filename), f"folder cannot be read: {why(error)}"))

    count = 0
    for folder, folders, names in os.walk(root, onerror=unreadable):
        progress.report(0.0, f"{count} files found")
        folders.sort()
        count += len(names)
        yield from (Path(folder, name) for name in sorted(names))


def _unpacked(path: Path, archive: Any, progress: Progress) -> Source:
    source = Source(path, archive.root, ignored=list(archive.ignored), keeper=archive)
    source.files.extend(_walk(archive.root, source.ignored, progress.part(0.5, 0.5)))
    return source


# --- DICOMDIR


def _directory(path: Path, progress: Progress) -> Source:
    """Files that a DICOMDIR, and those it names in turn, name; what is not there is said."""
    root = path.parent
    source = Source(path, root)
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
            f"{path} cannot be read as a DICOMDIR ({error}); open its folder instead"
        ) from error


def _dropped(root: Path, named: list[tuple[str, ...]]) -> int:
    """How many leading folders of the names are not there: 0, but where a medium was moved."""
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
