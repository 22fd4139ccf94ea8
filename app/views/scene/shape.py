"""What a feature puts into the 3D picture: cylinders and rings, in patient LPS millimetres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.views.kit.theme import Mark


@dataclass(frozen=True, slots=True, eq=False)
class ScenePiece:
    """A cylinder with round ends, or flat ones.

    Attributes:
        ends_mm: both ends, shape (2, 3).
        radius_mm: of it.
        mark: its colour.
        round: whether its ends are.
    """

    ends_mm: FloatArray
    radius_mm: float
    mark: Mark
    round: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Hoop:
    """Rings about one centre, seen through the body.

    Attributes:
        centre_mm: shape (3,).
        normal: of their plane, shape (3,).
        radii_mm: one of each ring.
        mark: their colour.
    """

    centre_mm: FloatArray
    normal: FloatArray
    radii_mm: tuple[float, ...]
    mark: Mark


@dataclass(frozen=True, slots=True, eq=False)
class SceneShape:
    """Something at one moment.

    Attributes:
        pieces: always the same ones in the same order.
        hoops: likewise.
    """

    pieces: tuple[ScenePiece, ...]
    hoops: tuple[Hoop, ...] = ()

    @property
    def points_mm(self) -> FloatArray:
        """All ends and centres, shape (n, 3): what a view of it must show."""
        ends = (piece.ends_mm for piece in self.pieces)
        return np.vstack([*ends, *(hoop.centre_mm[None] for hoop in self.hoops)])

    def near_mm(self, place_mm: FloatArray, reach_mm: float) -> FloatArray:
        """Return the points no farther than this from a place, shape (n, 3)."""
        points = self.points_mm
        return points[np.linalg.norm(points - place_mm, axis=1) <= reach_mm]

    def moved_mm(self, other: SceneShape | None) -> float:
        """Return how far a point of it is at most from where it was; infinite where there was
        none.
        """
        if other is None:
            return float("inf")
        return float(np.abs(self.points_mm - other.points_mm).max())

    @property
    def kind(self) -> tuple[object, ...]:
        """Return what its parts are: shapes of one kind are drawn by the same solids."""
        pieces = ((piece.mark, piece.round) for piece in self.pieces)
        return (*pieces, *((hoop.mark, len(hoop.radii_mm)) for hoop in self.hoops))
