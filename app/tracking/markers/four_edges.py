"""The four edges of the band in its own picture (compiled): two straight flanks and two arcs.

Found from a first estimate of the share that the band covers, without the needle's axis or the
camera: an edge is where the share falls through a half. In a frame whose x runs along the needle,
a flank is a line y = a + b·x, and an end, the picture of half a circle, x = c + q·√(1 - z²) + t·z
with z from -1 to 1 between the flanks.
What they enclose has an area and a centroid with its noise; `rim` moves them to where they belong.
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
    """Return how far it is from a place inside to where the field falls through a half; -1:
    nowhere.
    """
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
    """Return how much the colours beyond both ends differ from those beside them."""
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


@njit
def below(z: float) -> float:
    """Share of a Gaussian below z."""
    return 0.5 * math.erfc(-z / math.sqrt(2.0))


@njit
def bell(z: float) -> float:
    """Density of a Gaussian at z."""
    return math.exp(-0.5 * z * z) / math.sqrt(2.0 * math.pi)


@njit
def mean_colour(
    window: Any, edges: Any, x: float, y: float, dx: float, dy: float, n: int, out: Any
) -> None:
    """Mean colour of n samples from (x, y) on in steps of (dx, dy)."""
    for k in range(3):
        out[k] = 0.0
        for i in range(n):
            a, b = x + i * dx, y + i * dy
            out[k] += between(
                window[:, :, k],
                edges[0] + a * edges[2] - b * edges[3],
                edges[1] + a * edges[3] + b * edges[2],
            )
        out[k] /= n


@njit
def patch_colour(
    window: Any,
    edges: Any,
    x: float,
    y: float,
    dy: float,
    n: int,
    low: float,
    high: float,
    out: Any,
    item: Any,
) -> float:
    """Mean colour over n steps of dy across and 5 px along; returns its scatter², relative."""
    first, second = 0.0, 0.0
    out[:] = 0.0
    for i in range(-2, 3):
        at = min(high, max(low, x + i))
        mean_colour(window, edges, at, y, 0.0, dy, n, item)
        bright = (item[0] + item[1] + item[2]) / 5.0
        first, second = first + bright, second + 5.0 * bright * bright
        for k in range(3):
            out[k] += item[k] / 5.0
    return max(0.0, second - first * first) / (first + 1.0) ** 2


@njit
def place(edges: Any, u: int, v: int) -> Any:
    """x, y of a pixel, y of the flanks beside it, and z between them."""
    du, dv = u - edges[0], v - edges[1]
    x, y = du * edges[2] + dv * edges[3], dv * edges[2] - du * edges[3]
    low, high = edges[4] + edges[5] * x, edges[6] + edges[7] * x
    return x, y, low, high, (2.0 * y - low - high) / (high - low)


_STRIPS: Final = 48


@njit
def centroid(edges: Any) -> Any:
    """Area and centroid u, v of what the edges enclose."""
    h0, h1 = 0.5 * (edges[6] - edges[4]), 0.5 * (edges[7] - edges[5])
    m0, m1 = 0.5 * (edges[6] + edges[4]), 0.5 * (edges[7] + edges[5])
    area, mx, my = 0.0, 0.0, 0.0
    for k in range(_STRIPS):
        z = (2.0 * k + 1.0) / _STRIPS - 1.0
        a, b = arc(edges, 0, z), arc(edges, 1, z)
        s0, s1, s2 = b - a, 0.5 * (b * b - a * a), (b * b * b - a * a * a) / 3.0
        y0, y1 = m0 + z * h0, m1 + z * h1
        area += h0 * s0 + h1 * s1
        mx += h0 * s1 + h1 * s2
        my += y0 * h0 * s0 + (y0 * h1 + y1 * h0) * s1 + y1 * h1 * s2
    if not area > 0.0:
        return 0.0, 0.0, 0.0
    x, y = mx / area, my / area
    u = edges[0] + x * edges[2] - y * edges[3]
    v = edges[1] + x * edges[3] + y * edges[2]
    return area * 2.0 / _STRIPS, u, v


@njit
def centroid_noise(edges: Any, covariance: Any, mu: float, mv: float) -> Any:
    """Covariance of the centroid by those of the edges."""
    gain, moved, step = np.empty((2, 9)), np.empty(EDGES), 1e-4
    for k in range(9):
        moved[:] = edges
        if k < 2:
            moved[4 + 2 * k] += step
        elif k == 2:
            moved[5] += step
            moved[7] += step
        else:
            moved[5 + k] += step
        _, u, v = centroid(moved)
        gain[0, k], gain[1, k] = (u - mu) / step, (v - mv) / step
    full = gain @ covariance @ gain.T
    return full[0, 0], full[0, 1], full[1, 1]
