"""A segment in space as seen from one slice: which parts lie in its slab, which outside."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from app.core.arrays import FloatArray


@dataclass(frozen=True, slots=True)
class PlanePoint:
    """A point seen from a slice: its place in the plane and its signed distance from it [mm]."""

    x: float
    y: float
    distance: float


@dataclass(frozen=True, slots=True)
class Piece:
    """Part of a segment that lies wholly inside or wholly outside the slab; ends in plane [mm]."""

    start: tuple[float, float]
    end: tuple[float, float]
    inside: bool


def pieces(start: PlanePoint, end: PlanePoint, half_mm: float) -> list[Piece]:
    """Cut a segment at the two faces of the slab |distance| ≤ `half_mm`.

    A segment parallel to the slice gives one piece. Pieces shorter than 1e-9 of the whole are left
    out, so that no zero-length line is drawn.
    """
    cuts = [0.0, *_crossings(start.distance, end.distance, half_mm), 1.0]
    return [
        Piece(_between(start, end, a), _between(start, end, b), inside)
        for a, b in pairwise(cuts)
        if b - a > 1e-9
        for inside in [abs(_mix(start.distance, end.distance, (a + b) / 2)) <= half_mm]
    ]


def _crossings(first: float, last: float, half_mm: float) -> list[float]:
    if abs(last - first) < 1e-9:
        return []
    fractions = ((face - first) / (last - first) for face in (-half_mm, half_mm))
    return sorted(fraction for fraction in fractions if 0.0 < fraction < 1.0)


def _between(start: PlanePoint, end: PlanePoint, fraction: float) -> tuple[float, float]:
    return _mix(start.x, end.x, fraction), _mix(start.y, end.y, fraction)


def _mix(a: float, b: float, fraction: float) -> float:
    return a + (b - a) * fraction


def as_point(values: FloatArray | tuple[float, float, float]) -> tuple[float, float, float]:
    """Return three finite floats, for signals and values that compare."""
    x, y, z = np.asarray(values, dtype=np.float64).tolist()
    return x, y, z
