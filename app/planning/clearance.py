"""How far a path, or the needle now, keeps from structures."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.imaging.structures.structure import Structure

if TYPE_CHECKING:
    from app.imaging.structures.distance import SignedDistance


class Nearness(StrEnum):
    """What a distance means."""

    FREE = "free"
    NEAR = "near"
    HIT = "hit"


@dataclass(frozen=True, slots=True, eq=False)
class PathClearance:
    """Distance of a line from one structure.

    Attributes:
        structure: which.
        distance_mm: smallest distance of the line from it; negative inside.
        at_mm: where on the line, LPS [mm], shape (3,).
        depth_mm: how far along the line.
        through_mm: length of the line inside.
        accuracy_mm: bound of the error of `distance_mm` by the CT's grid.
    """

    structure: Structure
    distance_mm: float
    at_mm: FloatArray
    depth_mm: float
    through_mm: float
    accuracy_mm: float = 0.0

    @property
    def nearness(self) -> Nearness:
        """Hit where the line is inside, near within the structure's warning distance.

        A structure that may be met (its warning distance is 0) is always free.
        """
        if self.structure.warn_mm <= 0.0:
            return Nearness.FREE
        if self.distance_mm <= 0.0:
            return Nearness.HIT
        return Nearness.NEAR if self.distance_mm < self.structure.warn_mm else Nearness.FREE


Field = tuple[Structure, "SignedDistance"]


def clearances(
    start_mm: ArrayLike,
    end_mm: ArrayLike,
    fields: Iterable[Field],
    beyond_mm: float | None = None,
) -> tuple[PathClearance, ...]:
    """Distances of a line from all structures, in their order.

    Args:
        start_mm: of the line, LPS, shape (3,).
        end_mm: of the line.
        fields: structures with their distance fields.
        beyond_mm: what is further off than this beyond a structure's warning distance need not be
            told exactly; None wants everything exact.
    """
    found = []
    for structure, field in fields:
        within = np.inf if beyond_mm is None else structure.warn_mm + beyond_mm
        nearest = field.along(start_mm, end_mm, within)
        where = (nearest.distance_mm, nearest.at_mm, nearest.depth_mm, nearest.through_mm)
        found.append(PathClearance(structure, *where, field.boundary.accuracy_mm))
    return tuple(found)


def worst(result: Iterable[PathClearance]) -> PathClearance | None:
    """Return the one to warn of: the deepest hit, else the nearest; None where all is free."""
    warned = [one for one in result if one.nearness is not Nearness.FREE]
    return min(warned, key=lambda one: one.distance_mm, default=None)
