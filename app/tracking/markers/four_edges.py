"""The four edges of the band in its own picture (compiled): two straight flanks and two arcs.

Found from a first estimate of the share that the band covers, without the needle's axis or the
camera: an edge is where the share falls through a half. In a frame whose x runs along the needle,
a flank is a line y = a + b·x, and an end, the picture of half a circle, x = c + q·√(1 - z²) + t·z
with z from -1 to 1 between the flanks.
"""

import math
from typing import Any, Final

import numpy as np

from app.core.compiled import njit

EDGES: Final = 14
"""Centre u, v; direction u, v of x; a, b of the flanks below and above; c, q, t of both ends."""

_PLACES: Final = 9
_STEP: Final = 0.5
_FARTHEST: Final = 120
_CLEAR: Final = 2.5
"""Nearer than this to a corner an edge is not looked for [px]."""

_BESIDE: Final = 3.5


@njit
def between(field: Any, u: float, v: float) -> float:
    """Value of a field between its pixels, bilinear; that of the border beyond it."""
    u = min(field.shape[1] - 1.001, max(0.0, u))
    v = min(field.shape[0] - 1.001, max(0.0, v))
    x, y = int(u), int(v)
    a, b = u - x, v - y
    return (1.0 - b) * ((1.0 - a) * field[y, x] + a * field[y, x + 1]) + b * (
        (1.0 - a) * field[y + 1, x] + a * field[y + 1, x + 1]
    )


@njit
def _crossing(field: Any, u: float, v: float, du: float, dv: float) -> float:
    """How far it is from a place inside to where the field falls through a half; -1: nowhere."""
    before = between(field, u, v)
    for k in range(1, _FARTHEST):
        now = between(field, u + _STEP * k * du, v + _STEP * k * dv)
        if now < 0.5 <= before:
            return _STEP * (k - 1 + (before - 0.5) / (before - now))
        before = now
    return -1.0


@njit
def arc(edges: Any, end: int, z: float) -> float:
    """Place x of an end (0: the lower x) at z between the flanks."""
    k = 8 + 3 * end
    z = min(1.0, max(-1.0, z))
    return edges[k] + edges[k + 1] * math.sqrt(1.0 - z * z) + edges[k + 2] * z


@njit
def find_edges(window: Any, field: Any, sides: Any, edges: Any) -> bool:
    """Fill the edges; False where the band is too small to have four.

    Args:
        window: uint8 (H, W, 3).
        field: first estimate of the shares, smooth, float32 (H, W).
        sides: centre u, v, direction of one pair of sides and the spreads along it and across.
        edges: out, (EDGES,).
    """
    c, s = sides[2], sides[3]
    along, across = math.sqrt(3.0) * sides[4], math.sqrt(3.0) * sides[5]
    if _shaft_leaves(window, sides[0], sides[1], -s, c, across, along) > _shaft_leaves(
        window, sides[0], sides[1], c, s, along, across
    ):
        c, s, along, across = -s, c, across, along
    edges[:] = 0.0
    edges[0], edges[1] = sides[0], sides[1]
    edges[4], edges[6] = -across, across
    for _ in range(2):
        edges[2], edges[3] = c, s
        if not (_ends(field, edges) and _flanks(field, edges)):
            return False
        tilt = 0.5 * (edges[5] + edges[7])
        norm = math.sqrt(1.0 + tilt * tilt)
        c, s = (edges[2] - tilt * edges[3]) / norm, (edges[3] + tilt * edges[2]) / norm
    return True


@njit
def _shaft_leaves(
    window: Any, u: float, v: float, du: float, dv: float, along: float, across: float
) -> float:
    """How much the colours beyond both ends differ from those beside them."""
    total = 0.0
    for end in (-1.0, 1.0):
        x = end * (along + _BESIDE)
        for side in (-1.0, 1.0):
            y = side * (across + _BESIDE)
            for k in range(3):
                middle = between(window[:, :, k], u + x * du, v + x * dv)
                corner = between(window[:, :, k], u + x * du - y * dv, v + x * dv + y * du)
                total += (middle - corner) ** 2
    return total


@njit
def _ends(field: Any, edges: Any) -> bool:
    """Fit both ends' arcs to where the shares fall between the flanks."""
    u0, v0, c, s = edges[0], edges[1], edges[2], edges[3]
    low, high = edges[4], edges[6]
    if not high - low > 2.0 * _CLEAR:
        return False
    rows, right = np.empty((_PLACES, 3)), np.empty(_PLACES)
    for end in range(2):
        sign = 2.0 * end - 1.0
        for k in range(_PLACES):
            y = low + 1.0 + (high - low - 2.0) * k / (_PLACES - 1.0)
            z = (2.0 * y - low - high) / (high - low)
            found = _crossing(field, u0 - y * s, v0 + y * c, sign * c, sign * s)
            if found < 0.0:
                return False
            rows[k, 0], rows[k, 1], rows[k, 2] = 1.0, math.sqrt(max(0.0, 1.0 - z * z)), z
            right[k] = sign * found
        edges[8 + 3 * end : 11 + 3 * end] = np.linalg.solve(rows.T @ rows, rows.T @ right)
    return True


@njit
def _flanks(field: Any, edges: Any) -> bool:
    """Fit both flanks' lines to where the shares fall between the ends."""
    u0, v0, c, s = edges[0], edges[1], edges[2], edges[3]
    for side in range(2):
        sign = 2.0 * side - 1.0
        start, stop = arc(edges, 0, 0.9 * sign) + _CLEAR, arc(edges, 1, 0.9 * sign) - _CLEAR
        count = int(stop - start) + 1
        if not stop - start > 2.0:
            return False
        n, x1, x2, y1, xy = 0.0, 0.0, 0.0, 0.0, 0.0
        for k in range(count):
            x = start + k
            found = _crossing(field, u0 + x * c, v0 + x * s, -sign * s, sign * c)
            if found < 0.0:
                return False
            y = sign * found
            n, x1, x2, y1, xy = n + 1.0, x1 + x, x2 + x * x, y1 + y, xy + x * y
        slope = (n * xy - x1 * y1) / (n * x2 - x1 * x1)
        edges[4 + 2 * side], edges[5 + 2 * side] = (y1 - slope * x1) / n, slope
    return True
