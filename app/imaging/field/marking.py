"""Structures laid over a field's labels, with the places of their boundaries by their shares."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.imaging.field import band
from app.imaging.field.errors import FieldError
from app.imaging.field.grid import FieldGrid
from app.imaging.field.morphology import smoothed
from app.imaging.field.naming import kind_of, name_of
from app.imaging.field.tissue_field import (
    MOST_TISSUES,
    STEPS_PER_MM,
    UNKNOWN,
    FieldTissue,
    TissueField,
)
from app.imaging.structures.structure import Structure

CONFIDENCE: Final = 0.95
_HALF = np.float32(0.5)

_Share = tuple[tuple[slice, ...], NDArray[np.float32]]


@dataclass(frozen=True, slots=True)
class Marks:
    """Structures on a grid.

    Attributes:
        tissues: the whole table, the structures last.
        shares: for each the box of the grid that holds it, and its share in the voxels' cells.
        first_code: of the structures.
        shape: of the grid.
        notes: which of them overlap, a line each.
    """

    tissues: tuple[FieldTissue, ...]
    shares: tuple[_Share, ...]
    first_code: int
    shape: tuple[int, int, int]
    notes: tuple[str, ...]

    def placed(
        self, codes: NDArray[np.uint8], first: band.Indices, second: band.Indices
    ) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
        """Place the boundaries of structures between voxels, 0 to 1; and say which are left."""
        a, b = codes[first], codes[second]
        share, left = np.full(len(a), _HALF, np.float32), np.ones(len(a), bool)
        for number, (box, held) in enumerate(self.shares):
            code = self.first_code + number
            mine = np.flatnonzero(left & ((a == code) | (b == code)))
            ends = (
                _in_box(index[mine], box, held, self.shape) - _HALF for index in (first, second)
            )
            share[mine] = share_between(*ends)
            left[mine] = False
        return share, left


def mark(
    labels: NDArray[np.uint8],
    structures: Sequence[Structure],
    grid: FieldGrid,
    table: Sequence[FieldTissue],
) -> Marks:
    """Lay structures over labels, in place, the first on top.

    Raises:
        FieldError: if there are more than a field can hold.
    """
    if len(structures) + len(table) > MOST_TISSUES:
        raise FieldError(
            sentence(
                "{structures} structures: a field has room for {most_structures}",
                structures=len(structures),
                most_structures=MOST_TISSUES - len(table),
            )
        )
    tissues = list(table)
    for code, structure in enumerate(structures, start=len(table)):
        name = name_of(structure)
        tissues.append(FieldTissue(code, kind_of(structure), name, CONFIDENCE, "structure"))
    shares = tuple(_share(structure, grid) for structure in structures)
    notes = []
    for number in reversed(range(len(structures))):
        box, share = shares[number]
        held = share >= _HALF
        below = np.unique(labels[box][held], return_counts=True)
        for code, count in zip(below[0].tolist(), below[1].tolist(), strict=True):
            if code >= len(table):
                over, under = structures[number].name, structures[code - len(table)].name
                millilitres = count * grid.spacing_mm**3 / 1000.0
                notes.append(
                    sentence(
                        "structures {over} and {under} overlap by {millilitres:.2g} ml, "
                        "which count as {over}",
                        over=over,
                        under=under,
                        millilitres=millilitres,
                    )
                )
        labels[box][held] = len(table) + number
    return Marks(tuple(tissues), shares, len(table), grid.shape, tuple(reversed(notes)))


def laid_over(field: TissueField, structures: Sequence[Structure], grid: FieldGrid) -> TissueField:
    """Return a field with structures laid over it; its own boundaries stay where they were."""
    labels = field.labels.copy()
    marks = mark(labels, structures, grid, field.tissues)
    if grid.beyond_reach is not None:
        labels[grid.beyond_reach] = UNKNOWN
    codes, level = labels.ravel(), field.distance.ravel()

    def crossing(first: band.Indices, second: band.Indices) -> NDArray[Any]:
        share, left = marks.placed(codes, first, second)
        a, b = (level[index[left]] / np.float32(STEPS_PER_MM) for index in (first, second))
        share[left] = a / np.maximum(a + b, np.float32(1e-6))
        return share

    distance = band.distances(labels, (grid.spacing_mm,) * 3, crossing)
    notes = (*field.notes, *marks.notes)
    return TissueField(labels, distance, field.affine_mm, marks.tissues, notes)


def share_between(first: NDArray[Any], second: NDArray[Any]) -> NDArray[Any]:
    """Return where between two values of a level lies its zero, 0 to 1; half where it does not."""
    step = first - second
    safe = np.where(np.abs(step) > 1e-6, step, 1.0)
    share = first / safe
    return np.where((np.abs(step) > 1e-6) & (share >= 0.0) & (share <= 1.0), share, 0.5)


def _share(structure: Structure, grid: FieldGrid) -> tuple[tuple[slice, ...], NDArray[np.float32]]:
    """Return how much of the surroundings of voxels a structure holds, and the box of the grid."""
    inverse = np.linalg.inv(grid.affine_mm)
    corners = structure.box_mm @ inverse[:3, :3].T + inverse[:3, 3]
    size = np.array(grid.shape[::-1])
    low = np.clip(np.floor(corners.min(axis=0)).astype(int) - 2, 0, size)
    high = np.clip(np.ceil(corners.max(axis=0)).astype(int) + 3, 0, size)
    if (high <= low).any():
        return (slice(0, 0),) * 3, np.zeros((0, 0, 0), np.float32)
    box = tuple(slice(int(a), int(b)) for a, b in zip(low[::-1], high[::-1], strict=True))
    affine = np.array(grid.affine_mm)
    affine[:3, 3] += grid.affine_mm[:3, :3] @ low
    nx, ny, nz = (high - low).tolist()
    part = FieldGrid((nz, ny, nx), affine, grid.spacing_mm, None, grid.reach_mm)
    padded = np.pad(structure.mask, 1).astype(np.float32)
    corner = np.array(structure.grid_mm)
    corner[:3, 3] -= structure.grid_mm[:3, :3] @ np.ones(3)
    return box, part.from_volume(smoothed(padded), corner)


def _in_box(
    index: band.Indices, box: tuple[slice, ...], held: NDArray[Any], shape: tuple[int, ...]
) -> NDArray[Any]:
    """Values of a box at flat indices of the whole grid; 0 outside it."""
    if not held.size:
        return np.zeros(len(index), np.float32)
    at = [part - span.start for part, span in zip(np.unravel_index(index, shape), box, strict=True)]
    inside = np.ones(len(index), bool)
    for part, size in zip(at, held.shape, strict=True):
        inside &= (part >= 0) & (part < size)
    result = np.zeros(len(index), np.float32)
    result[inside] = held[tuple(part[inside] for part in at)]
    return result
