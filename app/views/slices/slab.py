"""A segment in space as seen from one slice: which parts lie in its slab, which outside."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import NamedTuple

import numpy as np

from app.core.arrays import FloatArray


class PlanePoint(NamedTuple):
    """A point seen from a slice: its place in the plane and its signed distance from it [mm]."""

    x: float
    y: float
    distance: float


@dataclass(frozen=True, slots=True)
class Piece:
    """Part of a segment that lies wholly inside or wholly outside the slab; ends in plane [mm].

    Attributes:
        start, end: places of its ends [mm].
        inside: whether it lies in the slab.
        distances: of its ends from the slice, without sign [mm].
    """

    start: tuple[float, float]
    end: tuple[float, float]
    inside: bool
    distances: tuple[float, float] = (0.0, 0.0)


def pieces(start: PlanePoint, end: PlanePoint, half_mm: float) -> list[Piece]:
    """Cut a segment at the two faces of the slab |distance| ≤ `half_mm`.

    A segment parallel to the slice gives one piece. Pieces shorter than 1e-9 of the whole are left
    out, so that no zero-length line is drawn.
    """
    low, high = start.distance, end.distance
    if max(abs(low), abs(high)) <= half_mm:
        return [Piece(start[:2], end[:2], True, (abs(low), abs(high)))]
    cuts = [0.0, *_crossings(low, high, half_mm), 1.0]
    found = []
    for a, b in pairwise(cuts):
        if b - a > 1e-9:
            inside = abs(_mix(low, high, (a + b) / 2)) <= half_mm
            distances = abs(_mix(low, high, a)), abs(_mix(low, high, b))
            found.append(Piece(_between(start, end, a), _between(start, end, b), inside, distances))
    return found


def chord(
    at: tuple[float, float],
    direction: tuple[float, float],
    bounds: tuple[float, float, float, float],
) -> tuple[float, float]:
    """Return where a line enters and leaves a rectangle, as distances along it from a point.

    Args:
        at: the point.
        direction: of the line, unit.
        bounds: left, top, width, height.

    Returns:
        First and last distance, the first beyond the last where the line passes by.
    """
    first, last = -inf, inf
    for position, rate, low, size in zip(at, direction, bounds[:2], bounds[2:], strict=True):
        if abs(rate) < 1e-12:
            if not low <= position <= low + size:
                return inf, -inf
            continue
        one, other = (low - position) / rate, (low + size - position) / rate
        first, last = max(first, min(one, other)), min(last, max(one, other))
    return first, last


def crossing(
    item: tuple[float, float, float, float], other: tuple[float, float, float, float]
) -> tuple[float, float] | None:
    """Point where two lines (point x, y, unit direction dx, dy) meet; None if they are parallel."""
    x, y, dx, dy = item
    u, v, du, dv = other
    sine = dx * dv - dy * du
    if abs(sine) < 1e-6:
        return None
    along = ((u - x) * dv - (v - y) * du) / sine
    return x + along * dx, y + along * dy


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
