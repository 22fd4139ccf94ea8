"""Structures on the grid of a CT as the worker process hands them over."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from app.imaging.structures.structure import Colour, Index, StructureKind


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
    mask: NDArray[np.bool_]
    corner: Index
    warn_mm: float


@dataclass(frozen=True, slots=True, eq=False)
class PlacedStructures:
    """Structures of a file, and what was done or left out on the way."""

    structures: tuple[PlacedStructure, ...]
    notes: tuple[str, ...]
