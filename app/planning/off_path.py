"""How far off the path a needle is: the one definition that window, record and score share.

The path leads from the entry to the target *as it is now*: where breathing moves the target, the
path turns about the entry with it. Off the path is the part of tip - target across that path, which
is the distance of the tip from its line; to go is the rest along it; the angle is the one between
needle and path. With the target at rest the path is the planned one, to the last bit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, crosses, read_only
from app.planning.placement import PlacedPlan

SHORTEST = 1e-3
"""A target nearer to the entry than this [m] gives no direction: the planned one stays."""


@dataclass(frozen=True, slots=True, eq=False)
class Offset:
    """From the tip to the target, along and across the path to the target as it is now.

    Attributes:
        lateral: distance off the path [m].
        remaining: way still to go along the path [m]; negative once too deep.
        distance: from the tip to the target [m].
        angle: between needle and path [rad].
        across: from the path to the tip, across the path [m], shape (3,), read-only.
        path: unit vector of the path, entry to target, shape (3,), read-only.
    """

    lateral: float
    remaining: float
    distance: float
    angle: float
    across: FloatArray
    path: FloatArray

    def arrived(self, across: float, along: float) -> bool:
        """Return whether the tip is at the target: within `across` and within `along` [m] of it."""
        return self.lateral <= across and abs(self.remaining) <= along


NOWHERE = Offset(0.0, 0.0, 0.0, 0.0, read_only(np.zeros(3)), read_only(np.zeros(3)))
"""Stands where nothing may be told."""


def path_to(placed: PlacedPlan, p_target: FloatArray) -> FloatArray:
    """Return unit vectors from the entry to targets [m], shape (3,) or (n, 3), like `p_target`.

    The planned direction for a target at rest, and for one that is not known (NaN).
    """
    moved = p_target - placed.p_target
    way = p_target - placed.p_entry
    length = np.linalg.norm(way, axis=-1, keepdims=True)
    still = ~(np.abs(moved).max(axis=-1, keepdims=True) > 0.0) | ~(length > SHORTEST)
    result: FloatArray = np.where(still, placed.axis, way / np.where(still, 1.0, length))
    return result


def offset(p_tip: FloatArray, axis: FloatArray, placed: PlacedPlan, p_target: FloatArray) -> Offset:
    """Offset of one needle, tip [m] and direction, from where the target is now [m]."""
    path = path_to(placed, p_target)
    across, remaining = split(p_tip - p_target, path)
    lateral = float(np.linalg.norm(across))
    return Offset(
        lateral,
        float(remaining),
        float(np.hypot(lateral, remaining)),
        float(angles(axis, path)),
        read_only(across),
        read_only(path),
    )


def split(beyond: FloatArray, path: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Part of tip - target across the path, (n, 3) or (3,), and the way to go, (n,) or ()."""
    along = np.sum(beyond * path, axis=-1) if path.ndim > 1 else beyond @ path
    across = beyond - along[..., None] * path
    return across, -along


def angles(axes: FloatArray, path: FloatArray) -> FloatArray:
    """Angle between needles and path [rad], exact near 0 and π."""
    sideways = np.linalg.norm(crosses(axes, path), axis=-1)
    along = np.sum(axes * path, axis=-1) if path.ndim > 1 else axes @ path
    result: FloatArray = np.arctan2(sideways, along)
    return result
