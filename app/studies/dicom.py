"""Survey: does Acus read DICOM as GDCM does, and where they differ, who is right?"""

import importlib.util
import tempfile
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from app.core.progress import Progress
from app.imaging.scanning import scan_folder
from app.imaging.series import Ignored, Series
from app.studies.dicom_cases.comparison import (
    ROUNDED,
    SAME_MM,
    UNEXPLAINED,
    Peer,
    SeriesAgreement,
    compare,
    read,
)
from app.studies.dicom_cases.reasons import justified, meaning
from app.studies.findings import Cell, Findings, Sheet, Survey

DECLARATION: Final[dict[str, Any]] = {
    "title": "Reading DICOM: Acus against GDCM through SimpleITK",
    "question": "Is every CT series read as GDCM reads it, or refused for a right reason?",
    "reference": (
        "GDCM through SimpleITK for voxels; each file's own position, orientation and "
        "spacing, read by pydicom, for places"
    ),
}


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


_COLUMNS = (
    "series or file",
    "size",
    "verdict",
    "voxels",
    "geometry",
    "Acus off [mm]",
    "GDCM off [mm]",
    "because",
)
_REFUSED = ("reason", "what that is", "files or series", "right", "for example")


def measure(progress: Progress | None, inputs: tuple[Path, ...] = ()) -> Findings:
    """Read everything twice and compare.

    Args:
        progress: told how far it is; cancels.
        inputs: folders; pydicom's own test files are read in any case.
    """
    progress = progress or Progress()
    rows: list[tuple[Cell, ...]] = []
    refused: dict[str, list[tuple[str, bool]]] = defaultdict(list)
    peer = Peer()
    try:
        for number, case in enumerate(_cases(inputs, progress)):
            progress.report(number / (number + 200.0), case.name)
            if row := _compared(case, peer):
                rows.append(row)
            if reason := _reason(case):
                right = justified(reason, peer.facts(case.files))
                refused[_kind(reason)].append((case.name, right))
    finally:
        peer.close()
    refusals = tuple(
        (reason, meaning(reason), len(found), sum(right for _, right in found), found[0][0])
        for reason, found in sorted(refused.items(), key=lambda item: -len(item[1]))
    )
    return Findings(
        (
            Sheet("read", "Read, and compared with GDCM through SimpleITK", _COLUMNS, tuple(rows)),
            Sheet("refused", "Refused, and whether the reason is right", _REFUSED, refusals),
        ),
        lines=_lines(rows, refusals),
    )


def _cases(inputs: tuple[Path, ...], progress: Progress) -> Iterator[DicomCase]:
    quiet = progress.part(0.0, 0.0)
    for folder in inputs:
        yield from folder_cases(folder, quiet)
    if (several := pydicom_folder()) is not None:
        yield from folder_cases(several, quiet)
    yield from file_cases(pydicom_files(), quiet)


def _reason(case: DicomCase) -> str:
    """Why the series or file is no volume; a file of one slice is none, and may still be read."""
    return case.found.reason


def _kind(reason: str) -> str:
    """Reason without the names and figures in it."""
    brief = reason.split(":")[0].split(" (")[0].split("; ")[0]
    return reason[:60] if brief == "not CT" else brief


def _compared(case: DicomCase, peer: Peer) -> tuple[Cell, ...] | None:
    """Row of a case whose voxels can be compared; None for any other."""
    series = case.found
    if isinstance(series, Ignored) or series.volume_file is not None:
        return None
    ours = read(series)
    if ours.values is None and not ours.error:
        return None
    theirs = peer.image(series.files if not case.alone else case.files)
    found = (
        SeriesAgreement(f"GDCM cannot: {theirs[:60]}", "", None, None)
        if isinstance(theirs, str)
        else compare(series, ours, theirs, peer)
    )
    return (
        case.name,
        "×".join(str(n) for n in series.size),
        ours.error or ("volume" if series.usable else _kind(series.reason)),
        found.values,
        found.geometry or "-",
        *("-" if off is None else round(off, 6) for off in (found.ours_mm, found.peer_mm)),
        found.because or "-",
    )


def _lines(
    rows: list[tuple[Cell, ...]], refusals: tuple[tuple[str, str, int, int, str], ...]
) -> tuple[str, ...]:
    count = sum(row[2] for row in refusals)
    right = sum(row[3] for row in refusals)
    equal = sum(row[3] == "equal" for row in rows)
    rounded = sum(row[3] == ROUNDED for row in rows)
    unexplained = sum(UNEXPLAINED in str(row[7]) for row in rows)
    ours = [row[5] for row in rows if isinstance(row[5], float)]
    theirs = [row[6] for row in rows if isinstance(row[6], float)]
    wrong = sum(off > SAME_MM for off in theirs)
    return (
        f"{len(rows)} series and files compared: {equal} with equal voxels, {rounded} equal "
        f"but for rounding to 32 bits; {unexplained} differences unexplained. {count} refused, "
        f"{right} of them for a reason that pydicom confirms.",
        f"Farthest that Acus puts a voxel from where its file says: {max(ours, default=0.0):.2g} "
        f"mm; GDCM through SimpleITK: {max(theirs, default=0.0):.3g} mm, above {SAME_MM} mm in "
        f"{wrong} cases.",
    )


STUDY = Survey(
    measure=measure,
    inputs="folders of DICOM files",
)
