"""Which series and files are compared."""

import importlib.util
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from app.core.progress import Progress
from app.imaging.scanning import scan_folder
from app.imaging.series import Ignored, Series

MOST_ALONE = 64
"""Files of a refused series up to which each is a case of its own as well."""


@dataclass(frozen=True, slots=True)
class DicomCase:
    """Something to be read.

    Attributes:
        name: for the table.
        found: the series, or why there is none.
        alone: whether it is one file by itself.
        files: it consists of.
    """

    name: str
    found: Series | Ignored
    alone: bool
    files: tuple[Path, ...]


def folder_cases(folder: Path, progress: Progress) -> Iterator[DicomCase]:
    """Yield every series below a folder; of refused ones every file by itself as well.

    Raises:
        FolderError: if the folder cannot be read.
    """
    listing = scan_folder(folder, progress)
    for series in listing.series:
        where = _shared(series.files, folder)
        yield DicomCase(f"{where}, {series.label}", series, False, series.files)
        if not series.usable and 1 < len(series.files) <= MOST_ALONE:
            yield from file_cases(series.files, progress, folder)


def _shared(files: Sequence[Path], folder: Path) -> str:
    parents = {file.parent for file in files}
    where = parents.pop() if len(parents) == 1 else folder
    return folder.name if where == folder else f"{folder.name}/{where.relative_to(folder)}"


def file_cases(
    files: Sequence[Path], progress: Progress, root: Path | None = None
) -> Iterator[DicomCase]:
    """Yield every file by itself: equal series UIDs would group unrelated files.

    Args:
        files: the files.
        progress: cancels.
        root: folder that they are named relative to; by their names alone if left out.
    """
    for file in files:
        with tempfile.TemporaryDirectory(prefix="acus-case-") as folder:
            Path(folder, file.name).symlink_to(file.absolute())
            listing = scan_folder(folder, progress.part(0.0, 0.0))
            every: tuple[Series | Ignored, ...] = (*listing.series, *listing.ignored)
            for found in every:
                name = file.name if root is None else f"{root.name}/{file.relative_to(root)}"
                yield DicomCase(name, found, True, (file,))


def pydicom_files() -> tuple[Path, ...]:
    """Return pydicom's own test files, and those of the package pydicom-data if it is installed."""
    folders = []
    for package, inside in (("pydicom", "data/test_files"), ("data_store", "data")):
        spec = importlib.util.find_spec(package)
        for place in (spec.submodule_search_locations or ()) if spec else ():
            folders.append(Path(place, inside))
    return tuple(file for folder in folders for file in sorted(folder.glob("*")) if file.is_file())


def pydicom_folder() -> Path | None:
    """Return the folder of several series among pydicom's test files."""
    spec = importlib.util.find_spec("pydicom")
    places = (spec.submodule_search_locations or ()) if spec else ()
    folders = [Path(place, "data/test_files/dicomdirtests") for place in places]
    return next((folder for folder in folders if folder.is_dir()), None)
