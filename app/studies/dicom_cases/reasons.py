"""Whether a refusal is right, by what pydicom says of the same files; and what each refusal means.

Nothing of Acus is asked: positions, orientations and sizes are compared anew.
"""

import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from app.core.arrays import FloatArray

Fact = dict[str, Any]
Holds = Callable[[str, Sequence[Fact]], bool]

_SECONDARY = "1.2.840.10008.5.1.4.1.1.7"
_DIRECTORY = "1.2.840.10008.1.3.10"
_SAME_MM = 0.01
_GAP = 1.5
"""A distance so many times the usual one is a missing slice."""


def justified(reason: str, facts: Sequence[Fact]) -> bool:
    """Whether the reason given for a refusal is true.

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
    """How far slices lie apart along their normal [mm], of files that agree on a direction."""
    planes = _planes(facts)
    if len(planes) < 2 or _several(planes, 1):
        return np.zeros(0)
    row, column = np.reshape(planes[0][1], (2, 3))
    along = np.array([plane[0] for plane in planes]) @ np.cross(row, column)
    return np.diff(np.sort(along))


def _several(planes: Sequence[Any], part: int) -> bool:
    """Whether planes differ in their orientation (1) or pixel spacing (2)."""
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
    """Whether a file has no header of NIfTI, a size that cannot be, or less than it promises."""
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
    ("truncated", _cut_short, "cut short, or its frames have no place in the patient"),
    ("damaged", _damaged, "cut short, or its frames have no place in the patient"),
    ("no pixels", _any(lambda fact: not fact["pixels"]), "no picture"),
    ("bits per pixel", _bits, "values that no CT has"),
    ("Hounsfield", _any(lambda fact: not fact["rescale"]), "values of no known unit"),
    (
        "ImagePositionPatient",
        _any(lambda fact: None in fact["planes"]),
        "nobody says where it lies",
    ),
    ("single slice", _single, "no volume; its pixels and its place are compared above"),
    ("doubled", _doubled, "two differing pictures of one place"),
    ("gap", _gap, "a slice is missing; read on request, resampled"),
    ("uneven", _uneven, "slices not evenly apart; read on request, resampled"),
    ("mixed orientations", _orientations, "views in several directions, no stack"),
    ("mixed pixel spacings", _spacings, "pictures of several scales, no stack"),
    ("mixed image sizes", _sizes, "pictures of several sizes, no stack"),
    ("multi-frame", _any(lambda fact: fact["frames"] > 1), "nobody says where its frames lie"),
)
"""Words of a reason, what must hold for it to be right, and what it means."""
