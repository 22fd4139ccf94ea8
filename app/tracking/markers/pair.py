"""Two bands on the shaft: which is which, and the needle's axis and tip from both.

With the bands' centres p₁ (towards the tip) and p₂, L = |p₁ - p₂| and P = 1 - a aᵀ,

    a = (p₁ - p₂) / L,        ∂a/∂(p₁, p₂) = [P, -P] / L,
    tip = p₁ + o a,           ∂tip/∂(p₁, p₂) = [1 + o P / L, -o P / L],

o being the first band's distance from the tip; both covariances follow from the 6×6 one of the two
points. With points of σ in every direction, independent: the axis turns by √2 σ / L about either
normal.
"""

from dataclasses import dataclass
from itertools import permutations
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only

SIGMAS: Final = 4.5
"""Difference [standard deviations] up to which a distance is the one between the bands."""

PLACED: Final = 0.05
"""Share of the distance by which the bands may be painted too near or too far."""


@dataclass(frozen=True, slots=True, eq=False)
class ShaftAxis:
    """Axis and tip of a needle from its two bands.

    Attributes:
        axis: unit, from the second band to the first, shape (3,), read-only.
        axis_covariance: of it, shape (3, 3), read-only; zero along itself.
        p_tip: [m], shape (3,), read-only.
        tip_covariance: of it [m²], shape (3, 3), read-only.
    """

    axis: FloatArray
    axis_covariance: FloatArray
    p_tip: FloatArray
    tip_covariance: FloatArray


def shaft_axis(points: FloatArray, covariance: FloatArray, offset: float) -> ShaftAxis | None:
    """Axis and tip from both bands; None if the points are one.

    Args:
        points: centres of the first and the second band [m], shape (2, 3).
        covariance: of both together [m²], shape (6, 6).
        offset: from the first band to the tip [m].
    """
    between = points[0] - points[1]
    length = float(np.linalg.norm(between))
    if not length > 1e-6:
        return None
    axis = between / length
    across = (np.eye(3) - np.outer(axis, axis)) / length
    turns = np.hstack([across, -across])
    moves = np.hstack([np.eye(3), np.zeros((3, 3))]) + offset * turns
    return ShaftAxis(
        read_only(axis),
        read_only(turns @ covariance @ turns.T),
        read_only(points[0] + offset * axis),
        read_only(moves @ covariance @ moves.T),
    )


def fits(points: FloatArray, covariance: FloatArray, distance: float) -> bool:
    """Whether two points are as far apart as the bands.

    Args:
        points: [m], shape (2, 3).
        covariance: of both together [m²], shape (6, 6).
        distance: between the bands' centres [m].
    """
    between = points[0] - points[1]
    length = float(np.linalg.norm(between))
    if not length > 1e-6:
        return False
    along = np.concatenate([between, -between]) / length
    sigma = float(np.sqrt(max(0.0, float(along @ covariance @ along))))
    return abs(length - distance) <= PLACED * distance + SIGMAS * sigma


def tell_apart(
    points: list[FloatArray], sigma: float, distance: float, towards: FloatArray
) -> tuple[int, int] | None:
    """Which of some red points are the first and the second band; None unless just two can be.

    Args:
        points: [m], each of shape (3,).
        sigma: standard deviation of a point, per axis [m].
        distance: between the bands' centres [m].
        towards: direction, shape (3,), that the needle's tip points to within 90°.
    """
    spread = sigma**2 * np.eye(6)
    found = [
        (i, j)
        for i, j in permutations(range(len(points)), 2)
        if (points[i] - points[j]) @ towards > 0.0
        and fits(np.stack([points[i], points[j]]), spread, distance)
    ]
    return found[0] if len(found) == 1 else None
