"""From the grid of a file onto the grid of a CT, by the geometry of both and nothing else."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import permutations, product

import numpy as np
from scipy import ndimage

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.structures.errors import FrameOfReferenceError, StructureError
from app.imaging.structures.structure import (
    COLOURS,
    Colour,
    Mask,
    Structure,
    StructureKind,
    StructureSet,
    cropped,
    free_name,
)
from app.imaging.volume import Volume

SAME_MM = 0.02
"""Grids whose voxels lie this near to each other are the same."""


_OFF_TIES = 1e-3
"""Voxels of the file by which grids are moved against each other."""


@dataclass(frozen=True, slots=True, eq=False)
class Labelled:
    """What a file holds of one structure, on the file's own grid.

    Attributes:
        name, kind, colour, warn_mm: as the file says; `colour` None where it says nothing.
        mask: shape (K, J, I).
        affine_mm: voxel (i, j, k) -> LPS [mm], shape (4, 4).
        others: further parts of it on grids of their own, (mask, affine) each.
    """

    name: str
    mask: Mask
    affine_mm: FloatArray
    kind: StructureKind | None = None
    colour: Colour | None = None
    warn_mm: float | None = None
    others: tuple[tuple[Mask, FloatArray], ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """What a reader found in a file.

    Attributes:
        structures: on grids of their own; made one after the other where each is large.
        count: how many there are.
        frame_of_reference: FrameOfReferenceUID of the file; empty where it carries none.
        notes: what the reader has to say.
        drawn_on: UIDs of the series and images that the file names as those it was drawn on; of a
            file of our own the digest of the CT.
    """

    structures: Iterable[Labelled]
    count: int
    frame_of_reference: str = ""
    notes: tuple[str, ...] = ()
    drawn_on: frozenset[str] = frozenset()


def place(
    result: Found, volume: Volume, progress: Progress, uids: frozenset[str] = frozenset()
) -> StructureSet:
    """Put structures of a file onto a CT.

    Args:
        result: what its reader found.
        volume: the CT; its grid is enough.
        progress: told of each structure.
        uids: of the CT's series and images, and the digest of its values.

    Raises:
        FrameOfReferenceError: if file and CT name different ones, and the file does not name this
            very series or an image of it.
        StructureError: if none of the structures has a voxel in the CT.
    """
    said = [*result.notes, *_same_frame(result, volume.series.frame_of_reference, uids)]
    placed, empty = StructureSet(), 0
    for number, labelled in enumerate(result.structures):
        progress.report(
            number / result.count,
            sentence("structure {current} of {count}", current=number + 1, count=result.count),
        )
        mask, note = _onto(labelled, volume)
        if note:
            said.append(note)
        if mask is None:
            empty += not any(part.any() for part, _ in _parts(labelled))
            continue
        name = free_name(_clean(labelled.name, number), [one.name for one in placed])
        kind = labelled.kind or guessed_kind(name)
        colour = labelled.colour or COLOURS[number % len(COLOURS)]
        structure = Structure.of(name, mask, volume, kind, colour, labelled.warn_mm)
        placed = placed.with_one(structure)
    if result.count and not len(placed):
        if empty == result.count:
            raise StructureError(
                sentence("the structures in the file are empty: nothing is drawn in them")
            )
        raise StructureError(
            sentence(
                "none of the structures in the file lies in this CT: they belong to another "
                "patient or another scan"
            )
        )
    return StructureSet(placed.structures, tuple(said))


def _same_frame(result: Found, own: str, uids: frozenset[str]) -> list[str]:
    """Check that file and CT share a frame of reference; return what has to be said of it."""
    named = result.frame_of_reference
    if not named and result.drawn_on & uids:
        return []
    if not named:
        return [sentence("the file names no frame of reference: placed by its coordinates alone")]
    if not own or named == own:
        return []
    if result.drawn_on & uids:
        return [
            sentence(
                "the file names another frame of reference (…{named}) than this CT "
                "(…{own}), but also this very series as the one that it was drawn on: placed "
                "by its coordinates; check that the outlines fit the picture",
                named=named[-12:],
                own=own[-12:],
            )
        ]
    raise FrameOfReferenceError(
        sentence(
            "the structures were drawn on another frame of reference "
            "(…{named}) than that of this CT (…{own}), and the file does not name this "
            "series: open the CT that they belong to",
            named=named[-12:],
            own=own[-12:],
        )
    )


def _clean(name: str, number: int) -> str:
    return " ".join("".join(c if c.isprintable() else " " for c in name).split())[:60] or (
        f"structure {number + 1}"
    )


def _parts(labelled: Labelled) -> tuple[tuple[Mask, FloatArray], ...]:
    return ((labelled.mask, labelled.affine_mm), *labelled.others)


def _onto(labelled: Labelled, volume: Volume) -> tuple[Mask | None, str]:
    """Mask on the grid of the CT, None where nothing of it lies there, and what was lost."""
    whole: Mask | None = None
    there, outside, all_exact = 0.0, 0.0, True
    for part, to_patient in _parts(labelled):
        if not part.any():
            continue
        box, corner = cropped(part)
        affine = np.array(to_patient, np.float64)
        affine[:3, 3] += affine[:3, :3] @ np.asarray(corner, np.float64)
        to_volume = volume.inverse_mm @ affine  # voxel of the box -> voxel of the CT
        exact = _exact(box, to_volume, volume)
        mask = exact if exact is not None else _resampled(box, to_volume, volume)
        size = float(abs(np.linalg.det(affine[:3, :3])) * box.sum())
        there, all_exact = there + size, all_exact and exact is not None
        outside += size * _outside(box, to_volume, volume)
        if mask is not None:
            whole = mask if whole is None else whole | mask
    if not there:
        return None, sentence(
            "{labelled_name} is empty in the file and was left out", labelled_name=labelled.name
        )
    if whole is None or not whole.any():
        return None, sentence(
            "{labelled_name} lies outside this CT and was left out", labelled_name=labelled.name
        )
    return whole, _lost(labelled.name, whole, (there, outside / there, all_exact), volume)


def _outside(box: Mask, to_volume: FloatArray, volume: Volume) -> float:
    """Share of a mask's voxels whose centres lie outside a CT."""
    at = np.argwhere(box)[:, ::-1] @ to_volume[:3, :3].T + to_volume[:3, 3]
    return float(((at < -0.5) | (at > np.array(volume.size) - 0.5)).any(axis=1).mean())


def _lost(name: str, mask: Mask, before: tuple[float, float, bool], volume: Volume) -> str:
    """Say what became of a structure whose size [mm³], share outside and exactness were so."""
    there, outside, exact = before
    here = abs(np.linalg.det(volume.affine_mm[:3, :3])) * mask.sum()
    if outside > 0.005:
        return sentence(
            "{outside:.0f} % of {name} lie outside this CT", outside=100.0 * outside, name=name
        )
    if not exact and abs(here / there - 1.0) > 0.1:
        return sentence(
            "{name} has {here:.2f} ml on the grid of this CT, {there:.2f} ml in the file",
            name=name,
            here=here / 1000.0,
            there=there / 1000.0,
        )
    return ""


def _exact(box: Mask, to_volume: FloatArray, volume: Volume) -> Mask | None:
    """Return the mask itself where the grids differ in order and direction of the axes only."""
    linear, offset = to_volume[:3, :3], to_volume[:3, 3]
    turn = np.rint(linear)
    if not any(np.array_equal(abs(turn), np.eye(3)[list(p)]) for p in permutations(range(3))):
        return None
    size = np.array(box.shape[::-1])
    ends = np.array(list(product(*((0, n - 1) for n in size))), np.float64)
    miss = ends @ (linear - turn).T + offset - np.rint(offset)
    if (np.abs(miss) * volume.spacing_mm).max() > SAME_MM:
        return None
    ijk = np.argwhere(box)[:, ::-1] @ turn.T.astype(np.intp) + np.rint(offset).astype(np.intp)
    ijk = ijk[((ijk >= 0) & (ijk < np.array(volume.size))).all(axis=1)]
    mask = np.zeros(volume.hu.shape, bool)
    mask[ijk[:, 2], ijk[:, 1], ijk[:, 0]] = True
    return mask


def _resampled(box: Mask, to_volume: FloatArray, volume: Volume) -> Mask | None:
    """Voxels of the CT of which at least half lies inside, or that hold a whole thin part."""
    size = np.array(box.shape[::-1])
    corners = np.array(list(np.ndindex(2, 2, 2))) * size - 0.5
    reach = corners @ to_volume[:3, :3].T + to_volume[:3, 3]
    low = np.maximum(np.floor(reach.min(axis=0)).astype(int), 0)
    high = np.minimum(np.ceil(reach.max(axis=0)).astype(int) + 1, volume.size)
    if (high <= low).any():
        return None
    flip = np.eye(3)[::-1]
    back = np.linalg.inv(to_volume)
    values = np.pad(box.astype(np.float32), 1)
    # a CT coarser than the file: the mean over a voxel, not the one point in its middle
    half = np.rint((np.abs(back[:3, :3]).sum(axis=1)[::-1] - 1.0) / 2.0).astype(int).clip(0)
    values = ndimage.uniform_filter(
        np.pad(values, [(int(h), int(h)) for h in half]),
        tuple(int(2 * h + 1) for h in half),
        mode="constant",
    )
    # a voxel just on a boundary belongs to one side of it: half-open, or both ends would grow
    offset = (back[:3, :3] @ low + back[:3, 3])[::-1] + 1.0 + half + _OFF_TIES
    share = ndimage.affine_transform(
        values, flip @ back[:3, :3] @ flip, offset, output_shape=tuple((high - low)[::-1]), order=1
    )
    mask = np.zeros(volume.hu.shape, bool)
    inside = share >= 0.5
    if not inside.any():
        inside = (share > 0.0) & (share >= share.max())
    mask[low[2] : high[2], low[1] : high[1], low[0] : high[0]] = inside
    return mask


_WORDS = {
    StructureKind.TARGET: (
        "lesion",
        "tumor",
        "tumour",
        "target",
        "gtv",
        "ctv",
        "ptv",
        "nodule",
        "metasta",
        "cyst",
        "mass",
    ),
    StructureKind.VESSEL: ("vessel", "aort", "vena", "arter", "vein", "portal", "caval", "cava"),
    StructureKind.BONE: (
        "rib",
        "bone",
        "vertebra",
        "spine",
        "sternum",
        "pelvis",
        "sacrum",
        "femur",
        "scapula",
        "clavic",
        "humer",
        "costa",
    ),
    StructureKind.RISK: (
        "lung",
        "heart",
        "bowel",
        "gut",
        "colon",
        "duodenum",
        "stomach",
        "kidney",
        "nerve",
        "spleen",
        "pancreas",
        "gall",
        "oesoph",
        "esoph",
        "trachea",
        "bronch",
        "spinal",
        "cord",
        "bladder",
        "ureter",
        "pleura",
        "diaphragm",
        "avoid",
        "risk",
    ),
}


def guessed_kind(name: str) -> StructureKind:
    """Kind that a name speaks for; `other` where it says nothing. The user can change it."""
    lower = name.lower()
    for kind in (
        StructureKind.TARGET,
        StructureKind.RISK,
        StructureKind.VESSEL,
        StructureKind.BONE,
    ):
        words = _WORDS[kind]
        if any(lower.startswith(word) or f" {word}" in lower.replace("_", " ") for word in words):
            return kind
    return StructureKind.OTHER
