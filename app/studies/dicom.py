"""Survey: does Acus read DICOM as GDCM does, and where they differ, who is right?"""

from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

from app.core.progress import Progress
from app.imaging.series import Ignored
from app.studies.dicom_cases.cases import (
    DicomCase,
    file_cases,
    folder_cases,
    pydicom_files,
    pydicom_folder,
)
from app.studies.dicom_cases.comparison import (
    ROUNDED,
    SAME_MM,
    UNEXPLAINED,
    SeriesAgreement,
    compare,
    read,
)
from app.studies.dicom_cases.peer import Peer
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
