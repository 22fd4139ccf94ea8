"""Labels of a CT by its Hounsfield values, by shapes, and by the structures that somebody marked.

In this order: outside the body is air; its first 2 mm are skin; air within it is lung where it is
large and holds tissue, else gas of the gut; above 250 HU is bone, with its holes filled, unless it
is bright in its middle and nowhere as bright as cortex, as contrast in a vessel is; below -25 HU is
fat; soft tissue of the wall is muscle, what lies further in is an organ that nobody named. A
structure knows better than all of it, the first that holds a voxel before the others.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.body import SKIN_HU, Body
from app.imaging.field import band
from app.imaging.field.bones import BONE_HU, Bones, find_bones
from app.imaging.field.errors import FieldError
from app.imaging.field.grid import FieldGrid
from app.imaging.field.marking import Marks, mark, share_between
from app.imaging.field.morphology import (
    Mask,
    closed,
    counts_by,
    grown,
    pieces,
    pooled,
    shrunk,
    smoothed,
    spread,
)
from app.imaging.field.naming import LUNG_VESSEL
from app.imaging.field.tissue_field import (
    FARTHEST,
    MOST_TISSUES,
    NOBODYS,
    STEPS_PER_MM,
    UNKNOWN,
    FieldTissue,
    TissueField,
    TissueKind,
)
from app.imaging.orthogonal import nearest_axes
from app.imaging.structures.structure import Structure
from app.imaging.volume import Volume

SKIN_MM: Final = 2.0
FAT_HU: Final = -25.0
WALL_MM: Final = 14.0
"""Soft tissue is muscle of the wall so far from the fat under the skin [mm]."""

_BY_HU: Final = "HU"
_AIR, _SKIN, _FAT, _MUSCLE, _ORGAN, _LUNG, _LUNG_VESSEL, _GAS, _BONE, _CONTRAST, _UNSURE = range(
    1, 12
)
TABLE: Final = (
    NOBODYS,
    FieldTissue(_AIR, TissueKind.AIR, "", 0.99, _BY_HU),
    FieldTissue(_SKIN, TissueKind.SKIN, "", 0.8, "first 2 mm of the body"),
    FieldTissue(_FAT, TissueKind.FAT, "", 0.9, _BY_HU),
    FieldTissue(_MUSCLE, TissueKind.MUSCLE, "", 0.6, "soft tissue of the wall"),
    FieldTissue(_ORGAN, TissueKind.ORGAN, "", 0.3, "soft tissue within the wall"),
    FieldTissue(_LUNG, TissueKind.LUNG, "", 0.95, "large air in the body"),
    FieldTissue(_LUNG_VESSEL, TissueKind.VESSEL, LUNG_VESSEL, 0.5, "soft tissue in the lung"),
    FieldTissue(_GAS, TissueKind.GUT, "gas", 0.6, "air in the body"),
    FieldTissue(_BONE, TissueKind.BONE, "", 0.9, _BY_HU),
    FieldTissue(_CONTRAST, TissueKind.VESSEL, "contrast", 0.7, "bright, long, without cortex"),
    FieldTissue(_UNSURE, TissueKind.VESSEL, "bone or contrast", 0.3, "bright, without cortex"),
)

_LUNG_ML, _LUNG_AIR_HU = 15.0, -960.0
_LUNG_SURELY_ML = 300.0
_HOLLOW_ML = 0.05  # less air than this is noise
_COARSE = 2  # voxels to a cell where shapes are looked for
_HALF = np.float32(0.5)


@dataclass(slots=True)
class _Parts:
    """What the labels are made of, on the grid: Hounsfield values, and levels of boundaries."""

    hu: NDArray[np.float32]
    skin_depth: NDArray[np.int8]
    wall: NDArray[np.float32]


def field_of_ct(
    volume: Volume,
    structures: Sequence[Structure],
    grid: FieldGrid,
    progress: Progress,
    body: Body,
) -> TissueField:
    """Label a CT; see above.

    Args:
        volume: in Hounsfield units.
        structures: on it.
        grid: of the field.
        progress: reports, and may be cancelled.
        body: of the CT.

    Raises:
        FieldError: if the values are no Hounsfield values, or there are too many structures.
        Cancelled: if `progress` was cancelled.
    """
    if volume.unit != "HU":
        raise FieldError(
            sentence(
                "the values of this volume are in {volume_unit}, not in HU: tissue is "
                "told by Hounsfield values; give the layers by hand",
                volume_unit=volume.unit or "no unit",
            )
        )
    notes: list[str] = []
    if not body.coarse.any():
        notes.append(sentence("there is no body in this CT: all of it is air"))
    progress.report(0.1, sentence("reading the CT on the field's grid"))
    hu = smoothed(grid.from_volume(volume.hu, volume.affine_mm))
    progress.report(0.25, sentence("looking for the skin"))
    inside = _inside(body, hu, grid)
    depth = _skin_depth(inside, hu, grid.spacing_mm)
    labels = np.where(inside, np.uint8(_ORGAN), np.uint8(_AIR))
    skin = inside & (depth < SKIN_MM * STEPS_PER_MM)
    skin |= inside & (depth < FARTHEST) & (hu >= FAT_HU)  # no muscle lies between skin and fat
    progress.report(0.4, sentence("looking for lung and gut"))
    _label_air(labels, inside & ~skin, hu, grid.spacing_mm)
    progress.report(0.5, sentence("looking for bone"))
    axis = 2 - nearest_axes(volume.direction)[0][2]
    bones = find_bones(hu, inside & ~skin, grid.spacing_mm, axis)
    progress.report(0.6, sentence("parting fat, muscle and organs"))
    gas = (labels == _LUNG) | (labels == _GAS)
    fat = (hu < FAT_HU) & (labels == _ORGAN) & ~grown(gas)
    labels[fat] = _FAT
    wall = _wall(labels, skin, bones.bone, grid)
    labels[(labels == _ORGAN) & (wall > 0.0)] = _MUSCLE
    labels[bones.bone] = _BONE
    labels[bones.contrast] = _CONTRAST
    labels[bones.unsure] = _UNSURE
    labels[skin] = _SKIN
    notes += _missing(labels, bones)
    progress.report(0.7, sentence("laying structures over it"))
    marks = mark(labels, structures, grid, TABLE)
    notes += marks.notes
    if grid.beyond_reach is not None:
        labels[grid.beyond_reach] = UNKNOWN
    progress.report(0.75, sentence("placing the boundaries"))
    crossing = _crossing(labels, _Parts(hu, depth, wall), marks)
    distance = band.distances(labels, (grid.spacing_mm,) * 3, crossing)
    progress.report(1.0, sentence("the tissue field is made"))
    return TissueField(labels, distance, grid.affine_mm, marks.tissues, tuple(notes))


def _inside(body: Body, hu: NDArray[np.float32], grid: FieldGrid) -> Mask:
    """Voxels in the body: its coarse cells, their edges by the values."""
    cells = np.array(body.volume.affine_mm)
    cells[:3, :3] *= body.factors
    around = np.ones((3, 3, 3), bool)
    inner = ndimage.binary_erosion(body.coarse, around, border_value=1)
    outer = ndimage.binary_dilation(body.coarse, around)
    to = np.linalg.inv(cells) @ grid.affine_mm
    if np.abs(to[:3, :3] - np.diag(np.diag(to[:3, :3]))).max() < 1e-9:
        rows = np.ix_(
            *(
                np.clip(
                    np.rint(to[a, 3] + to[a, a] * np.arange(grid.shape[2 - a])), 0, n - 1
                ).astype(np.intp)
                for a, n in zip((2, 1, 0), body.coarse.shape, strict=True)
            )
        )
        surely, maybe = inner[rows], outer[rows]
    else:
        surely, maybe = (
            grid.from_volume(mask.astype(np.float32), cells) >= _HALF for mask in (inner, outer)
        )
    result: Mask = (hu > body.skin_level) & maybe
    result |= surely
    return result


def _skin_depth(inside: Mask, hu: NDArray[np.float32], spacing_mm: float) -> NDArray[np.int8]:
    """Depth of the body's voxels below its surface [1/40 mm], 127 where deeper or outside."""
    flat = hu.ravel()

    def crossing(first: band.Indices, second: band.Indices) -> NDArray[Any]:
        return share_between(flat[first] - SKIN_HU, flat[second] - SKIN_HU)

    return band.distances(inside.view(np.uint8), (spacing_mm,) * 3, crossing, rounds=2)


def _label_air(
    labels: NDArray[np.uint8], inner: Mask, hu: NDArray[np.float32], spacing_mm: float
) -> None:
    """Label lung, what lies in it, and gas."""
    air = inner & (hu < SKIN_HU)
    if not air.any():
        return
    coarse = pooled(air, _COARSE, np.logical_and)  # cells that are air throughout
    numbers, count = pieces(coarse)
    cell_ml = (spacing_mm * _COARSE) ** 3 / 1000.0
    millilitres = counts_by(numbers, count) * cell_ml
    mean = pooled(hu, _COARSE, np.add) / _COARSE**3
    medians = np.zeros(count + 1)
    for number, box in enumerate(ndimage.find_objects(numbers), start=1):
        if box is not None and millilitres[number] >= _LUNG_ML:
            medians[number] = float(np.median(mean[box][numbers[box] == number]))
    lung = (millilitres >= _LUNG_SURELY_ML) | ((millilitres >= _LUNG_ML) & (medians > _LUNG_AIR_HU))
    lung[0] = False
    cells = lung[numbers]
    near = spread(grown(cells, 2), _COARSE, labels.shape)
    labels[air & near] = _LUNG
    gas = air & ~near
    if gas.any():
        parts, number = pieces(pooled(gas, _COARSE))
        sizes = counts_by(parts, number) * cell_ml
        labels[gas & spread((sizes >= _HOLLOW_ML)[parts], _COARSE, labels.shape)] = _GAS
    if cells.any():
        hull = spread(shrunk(closed(cells, 3), 1), _COARSE, labels.shape)
        labels[hull & inner & ~air] = _LUNG_VESSEL


def _wall(
    labels: NDArray[np.uint8], skin: Mask, bone: Mask, grid: FieldGrid
) -> NDArray[np.float32]:
    """Level that is positive in the body's wall [mm]: near the fat under the skin, or near bone."""
    factor = max(1, round(4.0 / grid.spacing_mm))
    cell = factor * grid.spacing_mm
    outside = pooled(labels == _AIR, factor) | pooled(skin, factor)
    fat = pooled((labels == _FAT).astype(np.float32), factor, np.add) > 0.5 * factor**3
    # opened before it is taken apart: fat within the wall joins that below it by narrow gaps
    ball = np.ones((3, 3, 3), bool)
    edges = np.pad(fat | outside, 2, mode="edge")
    opened = ndimage.binary_opening(edges, ball)[2:-2, 2:-2, 2:-2]
    parts, _ = pieces(opened)
    from_outside = np.unique(parts[outside])
    outer = np.isin(parts, from_outside[from_outside > 0]) | outside
    level = np.full(outer.shape, WALL_MM, np.float32)
    if outer.any() and not outer.all():
        level -= ndimage.distance_transform_edt(~outer, cell).astype(np.float32)
    bones = pooled(bone, factor)
    if bones.any():
        near = 6.0 - ndimage.distance_transform_edt(~bones, cell).astype(np.float32)
        level = np.maximum(level, near)
    affine = np.array(grid.affine_mm)
    affine[:3, :3] *= factor
    affine[:3, 3] += grid.affine_mm[:3, :3] @ np.full(3, 0.5 * (factor - 1))
    return grid.from_volume(level, affine)


def _missing(labels: NDArray[np.uint8], bones: Bones) -> list[str]:
    """Say what a CT of a trunk has and this one has not."""
    there = np.bincount(labels.ravel(), minlength=len(TABLE)) > 0
    notes: list[str] = []
    if there[_SKIN] and not there[_BONE]:
        notes.append(sentence("no bone was found: no needle can be told that it met one"))
    if there[_SKIN] and not there[_LUNG]:
        notes.append(sentence("no lung was found within reach"))
    if bones.unsure.any():
        notes.append(
            sentence("bright tissue without cortex may be bone or contrast: mark it to be sure")
        )
    return notes


def _crossing(labels: NDArray[np.uint8], parts: _Parts, marks: Marks) -> band.Crossing:
    """Return the rule that places the boundary between two voxels by what parts their labels."""
    codes, hu = labels.ravel(), parts.hu.ravel()
    depth, wall = parts.skin_depth.ravel(), parts.wall.ravel()
    gassy = np.isin(np.arange(MOST_TISSUES), (_AIR, _LUNG, _GAS))
    bright = np.isin(np.arange(MOST_TISSUES), (_BONE, _CONTRAST, _UNSURE))

    def crossing(first: band.Indices, second: band.Indices) -> NDArray[Any]:
        a, b = codes[first], codes[second]
        share, left = marks.placed(codes, first, second)
        left &= (a != UNKNOWN) & (b != UNKNOWN)
        between = (
            (gassy[a] != gassy[b], hu, SKIN_HU),
            ((a == _SKIN) | (b == _SKIN), depth, SKIN_MM * STEPS_PER_MM),
            (bright[a] != bright[b], hu, BONE_HU),
            ((a == _FAT) | (b == _FAT), hu, FAT_HU),
            ((a == _MUSCLE) | (b == _MUSCLE), wall, 0.0),
        )
        for parted, level, zero in between:
            mine = np.flatnonzero(left & parted)
            ends = (level[index[mine]].astype(np.float32) - zero for index in (first, second))
            share[mine] = share_between(*ends)
            left[mine] = False
        return share

    return crossing
