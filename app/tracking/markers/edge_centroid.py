"""Area and centroid of what the band's four edges enclose, and its noise (compiled)."""

from typing import Any, Final

import numpy as np

from app.core.compiled import njit
from app.tracking.markers.four_edges import EDGES, arc

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
