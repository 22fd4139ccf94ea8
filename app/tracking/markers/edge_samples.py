"""Colours and places beside the band's edges (compiled), see `edge_fit`."""

import math
from typing import Any

from app.core.compiled import njit
from app.tracking.markers.four_edges import between


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
    window: Any, edges: Any, x: float, y: float, dy: float, n: int, low: float, high: float,
    out: Any, one: Any,
) -> float:  # fmt: skip
    """Mean colour over n steps of dy across and 5 px along; returns its scatter², relative."""
    first, second = 0.0, 0.0
    out[:] = 0.0
    for i in range(-2, 3):
        at = min(high, max(low, x + i))
        mean_colour(window, edges, at, y, 0.0, dy, n, one)
        bright = (one[0] + one[1] + one[2]) / 5.0
        first, second = first + bright, second + 5.0 * bright * bright
        for k in range(3):
            out[k] += one[k] / 5.0
    return max(0.0, second - first * first) / (first + 1.0) ** 2


@njit
def place(edges: Any, u: int, v: int) -> Any:
    """x, y of a pixel, y of the flanks beside it, and z between them."""
    du, dv = u - edges[0], v - edges[1]
    x, y = du * edges[2] + dv * edges[3], dv * edges[2] - du * edges[3]
    low, high = edges[4] + edges[5] * x, edges[6] + edges[7] * x
    return x, y, low, high, (2.0 * y - low - high) / (high - low)
