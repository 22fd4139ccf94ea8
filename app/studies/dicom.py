"""Survey: does Acus read DICOM as GDCM does, and where they differ, who is right?

Whether a refusal is right is judged by what pydicom says of the same files; nothing of Acus is
asked there: positions, orientations and sizes are compared anew.
"""

import importlib.util
import re
import tempfile
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
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
from app.studies.findings import Cell, Findings, Sheet, Survey

Fact = dict[str, Any]
Holds = Callable[[str, Sequence[Fact]], bool]

_SECONDARY = "1.2.840.10008.5.1.4.1.1.7"
_DIRECTORY = "1.2.840.10008.1.3.10"
_SAME_MM = 0.01
_GAP = 1.5
"""A distance so many times the usual one is a missing slice."""


def justified(reason: str, facts: Sequence[Fact]) -> bool:
    """Return whether the reason given for a refusal is true.

    Args:
        reason: in the program's words.
        facts: what pydicom says of the files, read by force; empty where it cannot read them.
    """
    for words, holds, _ in _RULES:
        if words in reason:
            return holds(reason, facts)
    return False


def meaning(reason: str) -> str:
    """Return what a refusal means for somebody who did not expect it."""
    modality = reason.partition("modality ")[2].rstrip(")")
    if modality in _MODALITIES:
        return _MODALITIES[modality]
    return next((what for words, _, what in _RULES if words in reason), "")


_MODALITIES = {
    "CR": "an X-ray: one projection, no depth",
    "ECG": "a curve, no pixels",
    "NM": "nuclear medicine: counts, no Hounsfield units",
    "OT": "test pictures and screen captures, mostly in colour",
    "RTDOSE": "a dose grid, no picture of the patient",
    "RTPLAN": "a plan of radiotherapy, no pixels",
    "RTSTRUCT": "contours: opened as structures of a CT",
    "SEG": "a segmentation, one bit a pixel: opened as structures of a CT",
    "SR": "a report, no pixels",
    "US": "ultrasound, mostly in colour",
    "none given": "pictures in colour without a modality",
}


def _modality(reason: str, facts: Sequence[Fact]) -> bool:
    said = set(reason.partition("modality ")[2].rstrip(")").split(", "))
    found = {fact["modality"] or "none given" for fact in facts}
    return bool(found) and found - {"CT"} == said


def _no_dicom(reason: str, facts: Sequence[Fact]) -> bool:
    return not any(fact["series"] or fact["preamble"] for fact in facts)


def _no_series(reason: str, facts: Sequence[Fact]) -> bool:
    return bool(facts) and not any(fact["series"] for fact in facts)


def _cut_short(reason: str, facts: Sequence[Fact]) -> bool:
    return any(not fact["pixels"] for fact in facts)


def _damaged(reason: str, facts: Sequence[Fact]) -> bool:
    return any(not fact["pixels"] or None in fact["planes"] for fact in facts)


def _single(reason: str, facts: Sequence[Fact]) -> bool:
    return [(fact["frames"], fact["samples"]) for fact in facts] == [(1, 1)] and (
        None not in facts[0]["planes"]
    )


def _planes(facts: Sequence[Fact]) -> list[list[list[float]]]:
    """Position, orientation, spacing of every frame; nothing where one is not placed."""
    planes = [plane for fact in facts for plane in fact["planes"]]
    return [] if None in planes else planes


def _distances(facts: Sequence[Fact]) -> FloatArray:
    """Return how far slices lie apart along their normal [mm], of files that agree on a
    direction.
    """
    planes = _planes(facts)
    if len(planes) < 2 or _several(planes, 1):
        return np.zeros(0)
    row, column = np.reshape(planes[0][1], (2, 3))
    along = np.array([plane[0] for plane in planes]) @ np.cross(row, column)
    return np.diff(np.sort(along))


def _several(planes: Sequence[Any], part: int) -> bool:
    """Return whether planes differ in their orientation (1) or pixel spacing (2)."""
    values = np.array([plane[part] for plane in planes])
    return bool(np.ptp(values, axis=0).max() > 1e-4)


def _gap(reason: str, facts: Sequence[Fact]) -> bool:
    apart = _distances(facts)
    return apart.size > 0 and float(apart.max()) >= _GAP * float(np.median(apart)) > 0.0


def _uneven(reason: str, facts: Sequence[Fact]) -> bool:
    apart = _distances(facts)
    return apart.size > 1 and float(np.ptp(apart)) > _SAME_MM


def _doubled(reason: str, facts: Sequence[Fact]) -> bool:
    apart = _distances(facts)
    return apart.size > 0 and float(apart.min()) < _SAME_MM


def _sideways(reason: str, facts: Sequence[Fact]) -> bool:
    """Return whether slices evenly apart lie on no straight line."""
    apart = _distances(facts)
    at = np.array([plane[0] for plane in _planes(facts)])
    if apart.size < 2 or np.ptp(apart) > _SAME_MM:
        return False
    row, column = np.reshape(_planes(facts)[0][1], (2, 3))
    ordered = at[np.argsort(at @ np.cross(row, column))]
    return bool(np.abs(np.diff(ordered, 2, axis=0)).max() > _SAME_MM)


def _missing(reason: str, facts: Sequence[Fact]) -> bool:
    return any(name in reason for fact in facts for name in fact["missing"])


def _undeclared(fact: Fact) -> bool:
    """Return whether values are of another unit than HU, or nobody says of which they are."""
    return fact["unit"] not in ("", "HU") or (fact["energies"] and not fact["unit"])


def _orientations(reason: str, facts: Sequence[Fact]) -> bool:
    planes = _planes(facts)
    return len(planes) > 1 and _several(planes, 1)


def _spacings(reason: str, facts: Sequence[Fact]) -> bool:
    planes = _planes(facts)
    return len(planes) > 1 and _several(planes, 2)


def _sizes(reason: str, facts: Sequence[Fact]) -> bool:
    return len({tuple(fact["size"]) for fact in facts}) > 1


def _bits(reason: str, facts: Sequence[Fact]) -> bool:
    found = re.search(r"\d+", reason)
    return found is not None and any(fact["bits"] == int(found.group()) for fact in facts)


def _any(holds: Callable[[Fact], bool]) -> Holds:
    return lambda reason, facts: any(holds(fact) for fact in facts)


def _nifti(holds: Callable[[Fact], bool]) -> Holds:
    """Return a rule of NIfTI files, by the fixed places of their headers."""
    return lambda reason, facts: any(bool(f.get("nifti")) and holds(f["nifti"]) for f in facts)


def _no_nifti(reason: str, facts: Sequence[Fact]) -> bool:
    """Return whether a file has no header of NIfTI, a size that cannot be, or less than it
    promises.
    """
    return any(
        "nifti" in fact
        and (
            not fact["nifti"]
            or min(fact["nifti"]["sizes"], default=0) < 1
            or fact["nifti"]["bytes"] < np.prod(fact["nifti"]["sizes"])
        )
        for fact in facts
    )


_COLOURED = (128, 2304)
_COMPLEX = (32, 1792, 2048)

_RULES: tuple[tuple[str, Holds, str], ...] = (
    ("not a NIfTI file", _no_nifti, "another format under that name, or a file cut short"),
    (
        "does not say where it lies",
        _nifti(lambda fact: not fact["placed"]),
        "neither sform nor qform is set",
    ),
    ("span no volume", _nifti(lambda fact: not fact["volume"]), "an affine without an inverse"),
    ("sheared:", _nifti(lambda fact: not fact["square"]), "an affine that is no grid of boxes"),
    (
        "one volume is read",
        _nifti(lambda fact: len(fact["sizes"]) not in (3, 4) or fact["sizes"][3:] not in ([], [1])),
        "times or vectors beside the three axes",
    ),
    (
        "slices; a volume needs at least two",
        _nifti(lambda fact: len(fact["sizes"]) < 3 or fact["sizes"][2] < 2),
        "a single slice",
    ),
    (
        "not one number for each voxel",
        _nifti(lambda fact: fact["type"] in (*_COLOURED, *_COMPLEX)),
        "colours or complex numbers",
    ),
    (
        "mosaic",
        _any(lambda fact: "MOSAIC" in fact["image_type"]),
        "many slices side by side in one picture",
    ),
    ("not CT", _modality, "another kind of picture"),
    ("not a DICOM file", _no_dicom, "text, JSON, a colour profile, a header too damaged to tell"),
    ("of no series", _no_series, "belongs to no series, as every CT image must"),
    ("empty file", lambda reason, facts: not facts, "nothing in it"),
    ("DICOM directory", _any(lambda fact: fact["sop_class"] == _DIRECTORY), "names other files"),
    (
        "picture",
        _any(lambda fact: fact["samples"] != 1 or "MONO" not in fact["photometric"]),
        "in colour: no Hounsfield units",
    ),
    (
        "secondary capture",
        _any(lambda fact: fact["sop_class"].startswith(_SECONDARY)),
        "a copy of a screen or of a film",
    ),
    (
        "localizer",
        _any(lambda fact: "LOCALIZER" in fact["image_type"]),
        "a scout view: a projection, no slice",
    ),
    (
        "perfusion",
        _any(lambda fact: "PERFUSION" in fact["image_type"]),
        "blood flow, computed: no Hounsfield units",
    ),
    (
        "frames are described",
        _any(lambda fact: None in fact["planes"]),
        "cut short, or its frames have no place in the patient",
    ),
    ("missing, without which its pixels", _missing, "nobody says how its pixels are stored"),
    (
        "undefined length",
        _any(lambda fact: fact["undefined"]),
        "compressed and not, both at once",
    ),
    ("truncated", _cut_short, "cut short, or its frames have no place in the patient"),
    ("damaged", _damaged, "cut short, or its frames have no place in the patient"),
    ("no pixels", _any(lambda fact: not fact["pixels"]), "no picture"),
    ("bits per pixel", _bits, "values that no CT has"),
    (
        " map",
        _any(lambda fact: len(fact["image_type"]) > 3 or _undeclared(fact)),
        "computed from a scan: no Hounsfield units",
    ),
    ("RescaleType", _any(_undeclared), "values of another unit, or of one that is not said"),
    ("Hounsfield", _any(lambda fact: not fact["rescale"]), "values of no known unit"),
    (
        "ImagePositionPatient",
        _any(lambda fact: None in fact["planes"]),
        "nobody says where it lies",
    ),
    ("single slice", _single, "no volume; its pixels and its place are compared above"),
    ("doubled", _doubled, "two differing pictures of one place"),
    ("gap", _gap, "a slice is missing; read on request, resampled"),
    ("sideways", _sideways, "slices not above each other; read on request, resampled"),
    ("uneven", _uneven, "slices not evenly apart; read on request, resampled"),
    ("mixed orientations", _orientations, "views in several directions, no stack"),
    ("mixed pixel spacings", _spacings, "pictures of several scales, no stack"),
    ("mixed image sizes", _sizes, "pictures of several sizes, no stack"),
    ("multi-frame", _any(lambda fact: fact["frames"] > 1), "nobody says where its frames lie"),
)
"""Words of a reason, what must hold for it to be right, and what it means."""


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
    """Return why the series or file is no volume; a file of one slice is none, and may still be
    read.
    """
    return case.found.reason


def _kind(reason: str) -> str:
    """Reason without the names and figures in it."""
    if " is truncated" in reason:
        return "truncated"
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
