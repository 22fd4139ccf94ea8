"""How much of a lesion a union of zones covers, and how far the union reaches beyond its surface.

The share is an integral over the lesion by cells that are halved where a surface runs through them.
There the surface is smeared over a few cells by a step whose second moment vanishes, so that a
curved one costs nothing at that order either. The margin of a place on the lesion's surface is its
distance from the nearest place that the union leaves out; where the union does not even reach the
place, the distance to the union, negative.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.planning.ablation.zone import Zone

Depths = Callable[[FloatArray], FloatArray]
"""Places (n, 3) -> how deep they lie below a surface [mm], negative outside, exact near it."""

Inside = Callable[[FloatArray], NDArray[np.bool_]]

MOST_MM: Final = 20.0
"""A margin that is larger, or that nothing limits, counts as this."""

STEP_MM: Final = 0.6
"""The union's surface is looked at in places so far apart."""

_WIDE: Final = 2.0  # half width of the smeared step, in cells
_HALF_DIAGONAL: Final = 0.5 * 3.0**0.5
_ON: Final = 1e-6


def in_union(zones: Sequence[Zone], points: FloatArray) -> NDArray[np.bool_]:
    """Return which points lie in one of several zones, or within a millionth of one, shape (n,)."""
    inside: NDArray[np.bool_] = np.zeros(len(points), bool)
    for zone in zones:
        inside |= zone.about_mm(points) > _ON
    return inside


def depths_in_union(zones: Sequence[Zone], points: FloatArray) -> FloatArray:
    """Return how deep points lie in the deepest zone of several [mm], negative outside of all.

    Outside that is the exact distance from the union; inside a lower bound.
    """
    if not zones:
        return np.full(len(points), -np.inf)
    return np.asarray(np.max([zone.depths_mm(points) for zone in zones], axis=0))


def volumes(
    lesion: Depths,
    zones: Sequence[Zone],
    box: tuple[FloatArray, FloatArray],
    cells: int = 96,
    coarse: int = 8,
) -> tuple[float, float]:
    """Return the volumes of a lesion and of what zones cover of it [mm3].

    Args:
        lesion: depth of places below its surface; may stop rising 3 mm below it.
        zones: that cover it.
        box: lowest and highest corner that holds it all.
        cells: so many of the smallest lie along the box's longest side.
        coarse: the largest cell is so many times the smallest, a power of two.
    """
    low, high = (np.asarray(corner, np.float64) for corner in box)
    smallest = float((high - low).max()) / cells
    size, whole, covered = coarse * smallest, 0.0, 0.0
    counts = np.maximum(1, np.ceil((high - low) / size)).astype(int) + 1
    start = 0.5 * (low + high) - 0.5 * (counts - 1) * size
    axes = [start[a] + size * np.arange(counts[a]) for a in range(3)]
    centres = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    reach = _WIDE * smallest
    while len(centres):
        in_lesion = lesion(centres)
        in_zones = (
            np.max([zone.about_mm(centres) for zone in zones], axis=0)
            if zones
            else np.full(len(centres), -np.inf)
        )
        if size <= smallest * 1.001:
            steps = smeared(in_lesion / reach)
            whole += float(steps.sum()) * size**3
            both = smeared(np.minimum(in_lesion, in_zones) / reach)
            covered += float(both.sum()) * size**3
            break
        near = _HALF_DIAGONAL * size + reach
        # First order distances may be short of the true one: cells are halved twice as near.
        cut = (np.abs(in_lesion) < near) | ((in_lesion > 0.0) & _cut(zones, centres, 2.0 * near))
        plain = ~cut & (in_lesion > 0.0)
        whole += float(plain.sum()) * size**3
        covered += float((plain & (in_zones > 0.0)).sum()) * size**3
        eighths = 0.25 * size * (2.0 * np.array(list(np.ndindex(2, 2, 2))) - 1.0)
        centres = (centres[cut][:, None, :] + eighths).reshape(-1, 3)
        size *= 0.5
    return whole, covered


def _cut(zones: Sequence[Zone], points: FloatArray, near: float) -> NDArray[np.bool_]:
    cut: NDArray[np.bool_] = np.zeros(len(points), bool)
    for zone in zones:
        cut |= np.abs(zone.about_mm(points)) < near
    return cut


def smeared(t: FloatArray) -> FloatArray:
    """Return a step from 0 to 1 over t = -1 ... 1 whose slope has no first and second moment."""
    t = np.clip(t, -1.0, 1.0)
    return np.asarray(0.5 + 1.125 * t - 0.625 * t**3)


def bare_surface(zones: Sequence[Zone], step_mm: float = STEP_MM) -> FloatArray:
    """Return places of the union's surface, shape (n, 3), the creases between zones among them."""
    places = [np.empty((0, 3))]
    for number, zone in enumerate(zones):
        others = [other for k, other in enumerate(zones) if k != number]
        own = zone.surface_mm(step_mm)
        if not others:
            return own
        places.append(own[~in_union(others, own)])
        for k, other in enumerate(others):
            crease = _crease(zone, other, own, step_mm)
            rest = others[:k] + others[k + 1 :]
            if rest:
                crease = crease[~in_union(rest, crease)]
            places.append(crease)
    return np.concatenate(places)


def _crease(zone: Zone, other: Zone, own: FloatArray, near: float) -> FloatArray:
    """Return places where two surfaces cross: those of one that lie near it, moved onto it."""
    points = own[np.abs(other.about_mm(own)) < near]
    for _ in range(6):
        if not len(points):
            break
        for one in (other, zone):
            points = one.nearest_mm(points)
    return points[np.abs(other.about_mm(points)) < 0.02]


def margins_mm(
    points: FloatArray,
    zones: Sequence[Zone],
    in_organ: Inside | None = None,
    step_mm: float = STEP_MM,
) -> FloatArray:
    """Return the margins at places of a lesion's surface [mm], shape (n,), at most `MOST_MM`.

    Args:
        points: on the surface, shape (n, 3).
        zones: that were ablated.
        in_organ: tells which places belong to the organ; only there can anything be left out, so
            that no margin beyond its capsule is asked for. None where all does.
        step_mm: see `STEP_MM`; what creases leave is known to a few hundredths of it.
    """
    if not zones:
        return np.full(len(points), -MOST_MM)
    depths = depths_in_union(zones, points)
    result = np.minimum(depths, 0.0)
    covered = depths > 0.0
    if not covered.any():
        return np.maximum(result, -MOST_MM)
    inside, best = points[covered], np.full(int(covered.sum()), MOST_MM)
    bare = bare_surface(zones, step_mm)
    if in_organ is not None and len(bare):
        bare = bare[in_organ(bare)]
    if len(bare):
        from scipy.spatial import cKDTree  # the window is there before it

        best = np.minimum(best, cKDTree(bare).query(inside)[0])
    for number, zone in enumerate(zones):  # where the nearest place is no crease, it is known
        at, depth = zone.nearest_mm(inside), zone.depths_mm(inside)
        others = [other for k, other in enumerate(zones) if k != number]
        counts = (depth > 0.0) & ~in_union(others, at)
        if in_organ is not None and counts.any():
            counts[counts] = in_organ(at[counts])
        best = np.where(counts, np.minimum(best, depth), best)
    result[covered] = best
    return np.maximum(result, -MOST_MM)
