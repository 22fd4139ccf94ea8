"""A structure on the grid of a CT, the set of those that belong together, and outlines of one.

Outlines in any plane are closed lines by marching squares (Lorensen, Cline 1987).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen, read_only
from app.core.messages import sentence
from app.imaging.interpolation import interpolate
from app.imaging.structures.errors import StructureError
from app.imaging.volume import Volume
from app.imaging.worker.values import ATTACHED


@dataclass(frozen=True, slots=True, eq=False)
class PlacedStructure:
    """A structure, see `Structure`, without what the CT knows itself.

    Attributes:
        mask: shape (K', J', I'), the box of the CT that holds it.
        corner: voxel (i, j, k) of the CT at the mask's first one.
    """

    name: str
    kind: StructureKind
    colour: Colour
    mask: Annotated[NDArray[np.bool_], ATTACHED]
    corner: Index
    warn_mm: float


@dataclass(frozen=True, slots=True, eq=False)
class PlacedStructures:
    """Structures of a file, and what was done or left out on the way."""

    structures: tuple[PlacedStructure, ...]
    notes: tuple[str, ...]


# From which edge of a cell to which a line runs, for each set of corners inside (1 upper left,
# 2 upper right, 4 lower right, 8 lower left); what is inside lies on its left. 0 top, 1 right,
# 2 bottom, 3 left. Two corners across from each other are kept apart.
_LINES = {
    1: ((3, 0),),
    2: ((0, 1),),
    3: ((3, 1),),
    4: ((1, 2),),
    5: ((3, 0), (1, 2)),
    6: ((0, 2),),
    7: ((3, 2),),
    8: ((2, 3),),
    9: ((2, 0),),
    10: ((0, 1), (2, 3)),
    11: ((2, 1),),
    12: ((1, 3),),
    13: ((1, 0),),
    14: ((0, 3),),
}


def outlines(values: NDArray[np.floating], level: float = 0.5) -> list[FloatArray]:
    """Return the closed lines at which an array passes `level`; beyond its edges lies 0.

    Args:
        values: shape (rows, columns).
        level: of the lines, above 0.

    Returns:
        Lines of points (column, row) as floats, each of shape (n, 2), the last joined to the first.
    """
    padded = np.pad(np.asarray(values, np.float64), 1)
    inside = padded >= level
    if not inside.any():
        return []
    rows, columns = padded.shape
    a, b, c, d = inside[:-1, :-1], inside[:-1, 1:], inside[1:, 1:], inside[1:, :-1]
    case = a + 2 * b + 4 * c + 8 * d
    after: dict[int, int] = {}
    for number, lines in _LINES.items():
        row, column = np.nonzero(case == number)
        here = row * columns + column
        edges = (here, rows * columns + here + 1, here + columns, rows * columns + here)
        for start, end in lines:
            after.update(zip(edges[start].tolist(), edges[end].tolist(), strict=True))
    return [_points(np.array(ring), padded, level) - 1.0 for ring in _rings(after)]


def _rings(after: dict[int, int]) -> list[list[int]]:
    rings = []
    while after:
        start, at = after.popitem()
        ring = [start]
        while at != start:
            ring.append(at)
            at = after.pop(at)
        rings.append(ring)
    return rings


def _points(edges: NDArray[np.intp], values: FloatArray, level: float) -> FloatArray:
    """Points (column, row) on edges, numbered row by row: first the flat, then the upright ones."""
    columns = values.shape[1]
    upright, place = np.divmod(edges, values.size)
    row, column = np.divmod(place, columns)
    first = values[row, column]
    second = values[row + upright, column + 1 - upright]
    share = (level - first) / (second - first)
    return np.column_stack([column + (1 - upright) * share, row + upright * share])


MOST_POINTS = 10_000
"""Of the outlines of a structure in a plane: more are not told apart, and too slow to draw."""


def contours(
    structure: Structure,
    origin_mm: FloatArray,
    right: FloatArray,
    down: FloatArray,
    pixel_mm: float = 0.7,
) -> list[FloatArray]:
    """Outlines of a structure in a plane.

    Where they would have more than `MOST_POINTS`, as those of a threshold within noise, they are
    drawn in steps twice as wide, or wider yet, around every place that holds some of it: rather
    too large than too small.

    Args:
        structure: what.
        origin_mm: point of the plane with the coordinates (0, 0), LPS, shape (3,).
        right: where x of the plane runs: LPS per millimetre, shape (3,).
        down: the same for y.
        pixel_mm: the structure is looked at in steps of this.

    Returns:
        Closed lines of points (x, y) [mm] in the plane, each of shape (n, 2).
    """
    frame = np.column_stack([right, down, np.cross(right, down)])
    box = (structure.box_mm - origin_mm) @ np.linalg.inv(frame).T
    if box[:, 2].min() > 0.0 or box[:, 2].max() < 0.0:
        return []
    to_mask = np.linalg.inv(structure.grid_mm)
    steps = np.column_stack([to_mask[:3, :3] @ right, to_mask[:3, :3] @ down])
    start = to_mask[:3, :3] @ origin_mm + to_mask[:3, 3]
    if _along_voxels(steps):  # then look at centres of voxels only
        axes = np.abs(steps).argmax(axis=0)
        last = np.array(structure.mask.shape[::-1])[axes] - 1.0
        along = steps[axes, [0, 1]]
        low = np.minimum(-start[axes] / along, (last - start[axes]) / along)
        pixel = 1.0 / np.abs(along)
        values = _layer(structure.mask, axes, along, start)
    else:
        low, high = box[:, :2].min(axis=0), box[:, :2].max(axis=0)
        pixel = np.full(2, pixel_mm)
        columns, rows = (np.ceil((high - low) / pixel).astype(int) + 1).tolist()
        y, x = np.mgrid[:rows, :columns]
        plane = np.stack([x.ravel(), y.ravel()], axis=1) * pixel + low
        values = _share(structure.mask, start + plane @ steps.T).reshape(rows, columns)
    if _crossings(values >= 0.5) <= MOST_POINTS:
        return [line * pixel + low for line in outlines(values)]
    held, low = np.pad(values >= 0.5, 1), low - pixel
    while _crossings(held) > MOST_POINTS:
        held = np.pad(held, [(0, n % 2) for n in held.shape])
        held = held[::2] | held[1::2]
        held = held[:, ::2] | held[:, 1::2]
        low, pixel = low + pixel / 2.0, pixel * 2.0
    lines = outlines(held.astype(np.float64), 0.05)  # at 0.5 it cuts off the corners of squares
    return [line * pixel + low for line in lines]


def _layer(
    mask: Mask, axes: NDArray[np.intp], along: FloatArray, start: FloatArray
) -> NDArray[np.float64]:
    """Share of a mask at voxel centres of a plane along its axes, shape (rows, columns).

    Args:
        mask: shape (K, J, I).
        axes: of the voxels (i, j, k), along which columns and rows are counted.
        along: voxels per step on them; only its signs count.
        start: the plane's origin in voxels (i, j, k).
    """
    column, row = axes.tolist()
    across = 3 - column - row
    by_layer = mask.transpose(2 - across, 2 - row, 2 - column)
    share = np.zeros(by_layer.shape[1:])
    first = int(np.floor(start[across]))
    for number in (first, first + 1):
        if 0 <= number < len(by_layer):
            share += by_layer[number] * (1.0 - abs(start[across] - number))
    flips = tuple(slice(None, None, -1 if along[n] < 0.0 else 1) for n in (1, 0))
    return share[flips]


def _share(mask: Mask, ijk: FloatArray) -> FloatArray:
    """Share of a mask at places (i, j, k), linear between voxel centres; it fades beyond them."""
    beyond = np.abs(ijk - np.clip(ijk, 0.0, np.array(mask.shape[::-1]) - 1.0))
    share = np.clip(1.0 - beyond, 0.0, None).prod(axis=1)
    reached = share > 0.0
    share[reached] *= interpolate(mask, ijk[reached])
    return share


def _crossings(inside: NDArray[np.bool_]) -> int:
    """Return how often neighbours differ: the points of the outlines."""
    flat, upright = inside[:, 1:] ^ inside[:, :-1], inside[1:] ^ inside[:-1]
    return int(np.count_nonzero(flat)) + int(np.count_nonzero(upright))


def _along_voxels(steps: FloatArray) -> bool:
    """Return whether x and y of the plane both run along axes of the grid."""
    size = np.abs(steps)
    along = size.max(axis=0)
    return bool((size.sum(axis=0) - along <= 1e-6 * along).all())


Mask = NDArray[np.bool_]
Colour = tuple[int, int, int]
Index = tuple[int, int, int]

LONGEST_NAME = 64
"""Characters of a name: what a DICOM segment label holds."""


class StructureKind(StrEnum):
    """What a structure means for a needle."""

    RISK = "risk"
    VESSEL = "vessel"
    BONE = "bone"
    TARGET = "target"
    OTHER = "other"

    @property
    def warn_mm(self) -> float:
        """Usual distance [mm] from which a needle is warned; 0 for what may be met."""
        return {StructureKind.RISK: 5.0, StructureKind.VESSEL: 3.0, StructureKind.BONE: 2.0}.get(
            self, 0.0
        )

    @property
    def is_avoided(self) -> bool:
        """Return whether a path should keep away from it."""
        return self.warn_mm > 0.0


COLOURS: tuple[Colour, ...] = (
    (230, 159, 0),
    (86, 180, 233),
    (0, 178, 135),
    (240, 228, 66),
    (213, 94, 0),
    (204, 121, 167),
    (150, 170, 255),
    (190, 190, 190),
)
"""For structures whose file names none: Okabe and Ito's, told apart by colour-blind people too."""


@dataclass(frozen=True, eq=False)
class Structure:
    """Voxels of a CT that belong together.

    Attributes:
        name: for people; 1 to 64 characters, one line.
        kind: what it means for a needle.
        colour: red, green, blue, 0 to 255.
        mask: shape (K', J', I'), the box of the CT that holds it, read-only.
        corner: voxel (i, j, k) of the CT at the mask's first one.
        affine_mm: voxel (i, j, k) of the CT -> LPS [mm], shape (4, 4), read-only.
        warn_mm: a needle nearer than this is warned of it [mm]; 0 never.

    Raises:
        StructureError: if it holds no voxel, has no usable name, or the distance is not 0 to 50 mm.
    """

    name: str
    kind: StructureKind
    colour: Colour
    mask: Mask
    corner: Index
    affine_mm: FloatArray
    warn_mm: float = 0.0

    def __post_init__(self) -> None:
        name = " ".join(self.name.split())
        if not name or len(name) > LONGEST_NAME:
            raise StructureError(
                sentence(
                    "{name!r} is no name for a structure: 1 to {longest_name} characters are",
                    name=name[:80],
                    longest_name=LONGEST_NAME,
                )
            )
        if not 0.0 <= self.warn_mm <= 50.0:
            raise StructureError(
                sentence(
                    "warning distance {warn_mm:g} mm of {name}: 0 to 50 mm are",
                    warn_mm=self.warn_mm,
                    name=name,
                )
            )
        if self.mask.ndim != 3 or not self.mask.any():
            raise StructureError(sentence("structure {name} holds no voxel of this CT", name=name))
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "kind", StructureKind(self.kind))
        object.__setattr__(self, "affine_mm", frozen(self.affine_mm, (4, 4), "affine_mm"))
        self.mask.setflags(write=False)

    @classmethod
    def of(
        cls,
        name: str,
        mask: Mask,
        volume: Volume,
        kind: StructureKind = StructureKind.OTHER,
        colour: Colour = COLOURS[0],
        warn_mm: float | None = None,
    ) -> Structure:
        """Structure of a mask on the whole grid of a CT, shape (K, J, I)."""
        if mask.shape != volume.hu.shape:
            raise StructureError(
                sentence(
                    "mask of {mask_shape} voxels on a CT of {volume_hu_shape}",
                    mask_shape=mask.shape,
                    volume_hu_shape=volume.hu.shape,
                )
            )
        box, corner = cropped(mask)
        warn = kind.warn_mm if warn_mm is None else warn_mm
        return cls(name, kind, colour, box, corner, volume.affine_mm, warn)

    @cached_property
    def grid_mm(self) -> FloatArray:
        """Voxel (i, j, k) of the mask -> LPS [mm], shape (4, 4)."""
        affine = np.array(self.affine_mm)
        affine[:3, 3] += affine[:3, :3] @ np.asarray(self.corner, np.float64)
        return frozen(affine)

    @cached_property
    def box_mm(self) -> FloatArray:
        """Corners of the mask's voxels in LPS [mm], shape (8, 3)."""
        size = np.array(self.mask.shape[::-1])
        corners = np.array(list(np.ndindex(2, 2, 2))) * size - 0.5
        result: FloatArray = corners @ self.grid_mm[:3, :3].T + self.grid_mm[:3, 3]
        return read_only(result)

    @property
    def millilitres(self) -> float:
        """Volume [ml]."""
        return float(self.mask.sum() * abs(np.linalg.det(self.affine_mm[:3, :3])) / 1000.0)

    @property
    def centre_mm(self) -> FloatArray:
        """Centre of its voxels in LPS [mm], shape (3,)."""
        counts = [self.mask.sum(axis=axes, dtype=np.float64) for axes in ((0, 1), (0, 2), (1, 2))]
        middle = [float(count @ np.arange(len(count)) / count.sum()) for count in counts]
        result: FloatArray = self.grid_mm[:3, :3] @ middle + self.grid_mm[:3, 3]
        return result

    def holds(self, lps_mm: ArrayLike) -> Mask:
        """Return whether patient points [mm], shape (n, 3), lie in one of its voxels, shape
        (n,).
        """
        inverse = np.linalg.inv(self.grid_mm)
        at = np.asarray(lps_mm, np.float64) @ inverse[:3, :3].T + inverse[:3, 3]
        index = np.floor(at + 0.5).astype(np.intp)[:, ::-1]
        inside: Mask = ((index >= 0) & (index < self.mask.shape)).all(axis=1)
        inside[inside] = self.mask[tuple(index[inside].T)]
        return inside

    def full(self, shape: tuple[int, int, int]) -> Mask:
        """Return its mask on the whole grid, shape (K, J, I)."""
        mask = np.zeros(shape, bool)
        i, j, k = self.corner
        depth, height, width = self.mask.shape
        mask[k : k + depth, j : j + height, i : i + width] = self.mask
        return mask

    def changed(self, **fields: Any) -> Structure:
        """Return it with other fields."""
        return replace(self, **fields)


def cropped(mask: Mask) -> tuple[Mask, Index]:
    """Return the smallest box that holds all of a mask, and its corner (i, j, k).

    Raises:
        StructureError: if the mask is empty.
    """
    spans = []
    for axis in range(3):
        filled = np.flatnonzero(mask.any(axis=tuple(a for a in range(3) if a != axis)))
        if not filled.size:
            raise StructureError(sentence("a structure needs at least one voxel"))
        spans.append(slice(int(filled[0]), int(filled[-1]) + 1))
    k, j, i = (span.start for span in spans)
    return mask[tuple(spans)].copy(), (i, j, k)


@dataclass(frozen=True, eq=False)
class StructureSet:
    """Structures of one CT, in the order of their file; names are unique.

    Attributes:
        structures: them.
        notes: what was done or left out on the way here, for people.
    """

    structures: tuple[Structure, ...] = ()
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        names = [structure.name for structure in self.structures]
        double = {name for name in names if names.count(name) > 1}
        if double:
            raise StructureError(
                sentence(
                    "structure {double_name} is there twice: rename one", double_name=min(double)
                )
            )

    def __iter__(self) -> Iterator[Structure]:
        """Iterate over the structures."""
        return iter(self.structures)

    def __len__(self) -> int:
        """Return how many there are."""
        return len(self.structures)

    def find(self, name: str) -> Structure:
        """Return the structure of a name.

        Raises:
            StructureError: if there is none; lists those that are.
        """
        for structure in self.structures:
            if structure.name == name:
                return structure
        names = ", ".join(structure.name for structure in self.structures) or "none"
        raise StructureError(
            sentence("there is no structure {name!r}; there are: {names}", name=name, names=names)
        )

    def with_one(self, structure: Structure, instead_of: str | None = None) -> StructureSet:
        """Return the set with one more structure, or with it in the place of another."""
        old = structure.name if instead_of is None else instead_of
        if all(known.name != old for known in self.structures):
            return replace(self, structures=(*self.structures, structure))
        kept = (structure if known.name == old else known for known in self.structures)
        return replace(self, structures=tuple(kept))

    def without(self, name: str) -> StructureSet:
        """Return the set without the structure of a name."""
        kept = tuple(structure for structure in self.structures if structure.name != name)
        return replace(self, structures=kept)

    def united(self, other: StructureSet) -> StructureSet:
        """Return both sets as one; a name that is taken gets a number."""
        result = self
        for structure in other:
            name = free_name(structure.name, [known.name for known in result])
            result = result.with_one(structure.changed(name=name))
        return replace(result, notes=(*self.notes, *other.notes))


def free_name(name: str, taken: list[str]) -> str:
    """Return `name`, or with a number behind it where it is taken."""
    if name not in taken:
        return name
    number = 2
    while f"{name[:58]} {number}" in taken:
        number += 1
    return f"{name[:58]} {number}"
