"""Which tissues a needle meets along a line in a CT, by Hounsfield values and structures.

Values are read every half millimetre, as means over five points a millimetre beside each other,
and taken as the median of 2.5 mm, so that noise changes nothing. Then, in this order:

    air and lung below -400 HU, fat to -25, soft tissue to 250, bone above;

a run shorter than `shortest_mm` belongs to the longer of its neighbours (the slope from lung to
soft tissue is no fat). The first 2 mm are skin, which no CT resolves. Soft tissue of the body's
wall is muscle, what lies further in is organ: CT values do not tell them apart, so a run that holds
the target is an organ, and one that is muscle first and organ then is parted where the mean of the
values changes most, or 12 mm into it where they do not change. What is marked by a structure is
what its kind and name say, else an organ of that name.

Contrast in arteries can be above 250 HU: mark such a vessel, or it is taken for bone.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import ndimage

from app.core.arrays import FloatArray, unit
from app.core.messages import sentence
from app.imaging.errors import ImagingError
from app.imaging.interpolation import interpolate
from app.imaging.structures.structure import Structure, StructureKind
from app.imaging.volume import Volume


class Tissue(StrEnum):
    """What a needle can meet."""

    SKIN = "skin"
    FAT = "fat"
    MUSCLE = "muscle"
    ORGAN = "organ"
    LUNG = "lung"
    """Lung, and gas elsewhere."""
    BONE = "bone"


@dataclass(frozen=True, slots=True)
class TissueRun:
    """A stretch of one tissue on a line.

    Attributes:
        tissue: what it is.
        begin_mm, end_mm: from the entry.
        name: of the structure that says so; empty where the values do.
    """

    tissue: Tissue
    begin_mm: float
    end_mm: float
    name: str = ""

    @property
    def thickness_mm(self) -> float:
        """Length of the stretch [mm]."""
        return self.end_mm - self.begin_mm


STEP_MM = 0.5
SKIN_MM = 2.0
SHORTEST_MM = 2.0
"""A run shorter than this is noise, or a slope between its neighbours [mm]."""

_LIMITS_HU = (-400.0, -25.0, 250.0)
_AIR, _FAT, _SOFT, _BONE = range(4)
_BESIDE_MM = 1.0
_MEDIAN = 5  # samples
_WALL_MM = 45.0  # the first soft tissue that is no thicker can be the body's wall
_THIN_MM = 20.0  # so can what follows, as long as it is thinner and no organ has come
_MUSCLE_MM = 12.0  # of a wall whose end the values do not tell
_CONTRAST_HU = 15.0  # between wall and organ that the values tell
_NAMES = {
    Tissue.BONE: ("bone", "rib", "vertebra", "sternum", "pelvis", "scapula", "clavicle"),
    Tissue.LUNG: ("lung", "trachea", "bronch"),
    Tissue.MUSCLE: ("muscle", "diaphragm", "autochthon", "psoas", "gluteus"),
    Tissue.FAT: ("fat", "adipose"),
    Tissue.SKIN: ("skin",),
}


def tissue_along(
    volume: Volume,
    entry_mm: ArrayLike,
    target_mm: ArrayLike,
    beyond_mm: float = 40.0,
    structures: Sequence[Structure] = (),
    shortest_mm: float = SHORTEST_MM,
) -> tuple[TissueRun, ...]:
    """Return the tissues from the entry to the target and beyond, joined without gaps.

    Args:
        volume: of a CT.
        entry_mm: where the line begins, LPS, shape (3,).
        target_mm: where it leads, likewise.
        beyond_mm: how far to look beyond the target, as far as the CT goes.
        structures: on this CT, which know better; the first that holds a point counts.
        shortest_mm: shorter runs are none, bone above 1 mm excepted.

    Raises:
        ImagingError: if the values are no Hounsfield values, or the entry lies outside the CT.
    """
    if volume.unit != "HU":
        raise ImagingError(
            sentence(
                "the values of this volume are in {volume_unit}, not in HU: tissue is "
                "told by Hounsfield values; give the layers by hand",
                volume_unit=volume.unit or "no unit",
            )
        )
    entry, target = (np.asarray(point, np.float64) for point in (entry_mm, target_mm))
    length = float(np.linalg.norm(target - entry))
    middles = np.arange(0.5 * STEP_MM, length + beyond_mm, STEP_MM)
    points = entry + middles[:, None] * unit(target - entry, "path")
    ijk = volume.voxel(points)
    outside = ((ijk < -0.5) | (ijk > np.array(volume.size) - 0.5)).any(axis=1)
    points = points[: int(np.argmax(outside)) if outside.any() else None]
    if len(points) * STEP_MM < SKIN_MM:
        raise ImagingError(
            sentence(
                "entry {entry_mm} mm lies outside the CT: move it",
                entry_mm=entry.round(1).tolist(),
            )
        )
    hu = _values(volume, points, unit(target - entry, "path"))
    kinds = np.searchsorted(_LIMITS_HU, hu, side="right")
    first = int(np.argmax(kinds != _AIR))  # the entry may lie a little before the skin
    if first * STEP_MM < 5.0:
        kinds[:first] = kinds[first]
    codes = _marked(kinds, points, structures)
    runs = _parted(_joined(codes, shortest_mm), hu, structures, length)
    return _with_skin(_united(runs))


def _values(volume: Volume, points: FloatArray, along: FloatArray) -> FloatArray:
    """Hounsfield values at points, robust to noise, shape (n, 3) -> (n,)."""
    side = np.eye(3)[int(np.argmin(np.abs(along)))]
    first = unit(np.cross(along, side), "side")
    second = np.cross(along, first)
    offsets = _BESIDE_MM * np.array([0.0 * first, first, -first, second, -second])
    places = (points[:, None, :] + offsets).reshape(-1, 3)
    values = interpolate(volume.hu, volume.voxel(places)).reshape(len(points), -1).mean(axis=1)
    return np.asarray(ndimage.median_filter(values, _MEDIAN, mode="nearest"), np.float64)


def _marked(
    kinds: NDArray[np.intp], points: FloatArray, structures: Sequence[Structure]
) -> NDArray[np.intp]:
    """Codes of the samples: kinds by value, then one for each structure."""
    codes = kinds.copy()
    for number, structure in reversed(list(enumerate(structures))):
        inverse = np.linalg.inv(structure.grid_mm)
        at = points @ inverse[:3, :3].T + inverse[:3, 3]
        share = ndimage.map_coordinates(
            structure.mask, at[:, ::-1].T, np.float32, order=1, mode="grid-constant"
        )
        codes[share >= 0.5] = _BONE + 1 + number
    return codes


def _joined(codes: NDArray[np.intp], shortest_mm: float) -> list[tuple[int, int, int]]:
    """Return runs (code, first sample, end) of which none is too short."""
    edges = np.flatnonzero(np.diff(codes)) + 1
    runs = [(int(codes[a]), int(a), int(b)) for a, b in pairwise((0, *edges.tolist(), len(codes)))]
    while len(runs) > 1:
        shares = [
            (end - first) * STEP_MM / (0.5 * shortest_mm if code == _BONE else shortest_mm)
            for code, first, end in runs
        ]
        k = int(np.argmin(shares))
        if shares[k] >= 1.0:
            break
        beside = [n for n in (k - 1, k + 1) if 0 <= n < len(runs)]
        taker = max(beside, key=lambda n: runs[n][2] - runs[n][1])
        runs[k] = (runs[taker][0], runs[k][1], runs[k][2])
        runs = _merged(runs)
    return runs


def _merged(runs: list[tuple[int, int, int]]) -> list[tuple[int, int, int]]:
    found = runs[:1]
    for code, first, end in runs[1:]:
        if code == found[-1][0]:
            found[-1] = (code, found[-1][1], end)
        else:
            found.append((code, first, end))
    return found


def _parted(
    runs: list[tuple[int, int, int]], hu: FloatArray, structures: Sequence[Structure], length: float
) -> list[TissueRun]:
    """Name the runs; soft tissue is muscle of the wall, organ, or first the one and then."""
    found: list[TissueRun] = []
    wall = inside = False
    for code, first, end in runs:
        begin_mm, end_mm = first * STEP_MM, end * STEP_MM
        if code > _BONE:
            marked = structures[code - _BONE - 1]
            found.append(TissueRun(_named(marked), begin_mm, end_mm, marked.name))
        elif code != _SOFT:
            tissue = {_AIR: Tissue.LUNG, _FAT: Tissue.FAT, _BONE: Tissue.BONE}[code]
            found.append(TissueRun(tissue, begin_mm, end_mm))
        else:
            holds = begin_mm < length <= end_mm
            thin = end_mm - begin_mm <= (_THIN_MM if wall else _WALL_MM)
            if thin and not holds and not inside:
                found.append(TissueRun(Tissue.MUSCLE, begin_mm, end_mm))
            elif wall or inside or end_mm - begin_mm < 2.0 * _MUSCLE_MM:
                found.append(TissueRun(Tissue.ORGAN, begin_mm, end_mm))
            else:
                edge = begin_mm + _wall_end(hu[first:end])
                found.append(TissueRun(Tissue.MUSCLE, begin_mm, edge))
                found.append(TissueRun(Tissue.ORGAN, edge, end_mm))
            wall = True
        inside = inside or found[-1].tissue in (Tissue.LUNG, Tissue.ORGAN)
    return found


def _named(structure: Structure) -> Tissue:
    """Return what a structure's kind or name says; an organ where they say nothing else."""
    if structure.kind is StructureKind.BONE:
        return Tissue.BONE
    words = structure.name.casefold()
    for tissue, known in _NAMES.items():
        if any(word in words for word in known):
            return tissue
    return Tissue.ORGAN


def _wall_end(hu: FloatArray) -> float:
    """Return where in soft tissue the wall ends [mm]: where the mean changes most, if it does."""
    least, most = int(4.0 / STEP_MM), min(int(_WALL_MM / STEP_MM), len(hu) - int(4.0 / STEP_MM))
    places = np.arange(least, most)
    total, sums = hu.sum(), np.cumsum(hu)
    before = sums[places - 1] / places
    after = (total - sums[places - 1]) / (len(hu) - places)
    weight = places * (len(hu) - places)
    k = int(np.argmax(weight * (after - before) ** 2))
    told = abs(after[k] - before[k]) >= _CONTRAST_HU
    return float(places[k] * STEP_MM) if told else _MUSCLE_MM


def _united(runs: list[TissueRun]) -> list[TissueRun]:
    found = runs[:1]
    for run in runs[1:]:
        if (run.tissue, run.name) == (found[-1].tissue, found[-1].name):
            found[-1] = replace(found[-1], end_mm=run.end_mm)
        else:
            found.append(run)
    return found


def _with_skin(runs: list[TissueRun]) -> tuple[TissueRun, ...]:
    """Let the first `SKIN_MM` be skin; what is left of less than that is skin as well."""
    below = [
        replace(run, begin_mm=max(run.begin_mm, SKIN_MM)) for run in runs if run.end_mm > SKIN_MM
    ]
    below = [run for run in below if run.tissue is not Tissue.SKIN]
    if len(below) > 1 and below[0].begin_mm == SKIN_MM and below[0].thickness_mm < SKIN_MM:
        below = below[1:]
    end = below[0].begin_mm if below else SKIN_MM
    return (TissueRun(Tissue.SKIN, 0.0, end), *below)
