"""The background beside the band (compiled): a curve across its own edges, on either side.

What stands behind a needle has mostly straight edges. On either side of the needle the background
is a curve along the direction in which it changes most, plus a slope across that direction: an edge
outside is so carried on to the band's outline. Where nothing changes but by noise, the curve is
held straight.
"""

import math
from typing import Any, Final

import numpy as np

from app.core.compiled import njit
from app.tracking.markers.band_design import quadratic_spline

CURVE: Final = 22
SIDE: Final = CURVE + 1
"""Unknowns of one side: the curve's B-splines and the slope."""

_SPACING_PX: Final = 1.5
_SLOPE_PX: Final = 10.0


@njit
def directions(window: Any, clear: Any, noise: float, found: Any, uneven: Any) -> None:
    """Direction of the strongest change on both sides, and whether there are edges.

    Args:
        window: uint8 (H, W, 3).
        clear: (H, W) int8: 1 or 2 where only the first or second side's background is seen, or 0.
        noise: standard deviation of a grey value.
        found: out, unit vectors (u, v), (2, 2).
        uneven: out, whether the change is more than noise's, (2,).
    """
    for side in range(2):
        mark, uu, uv, vv, n = side + 1, 0.0, 0.0, 0.0, 0
        for v in range(1, window.shape[0] - 1):
            for u in range(1, window.shape[1] - 1):
                if not (
                    clear[v, u] == mark
                    and clear[v, u - 1] == mark
                    and clear[v, u + 1] == mark
                    and clear[v - 1, u] == mark
                    and clear[v + 1, u] == mark
                ):
                    continue
                n += 1
                for c in range(3):
                    du = 0.5 * (float(window[v, u + 1, c]) - float(window[v, u - 1, c]))
                    dv = 0.5 * (float(window[v + 1, u, c]) - float(window[v - 1, u, c]))
                    uu += du * du
                    uv += du * dv
                    vv += dv * dv
        floor = 3.0 * n * 0.5 * noise * noise
        angle = 0.5 * math.atan2(2.0 * uv, uu - vv)
        strong = math.hypot(2.0 * uv, uu - vv) > 0.3 * floor
        found[side, 0] = math.cos(angle) if strong else 0.0
        found[side, 1] = math.sin(angle) if strong else 1.0
        uneven[side] = strong


@njit
def ground_columns(pixels: Any, sides: Any, found: Any, first: Any, weights: Any) -> None:
    """Background's columns of every pixel, before they are multiplied by its free share.

    Args:
        pixels: u, v from the frame's origin, (m, 2).
        sides: 0 or 1, (m,).
        found: see `directions`.
        first: out, the first of three columns, (m,).
        weights: out, of those three and of the slope's, (m, 4).
    """
    for side in range(2):
        low, high = np.inf, -np.inf
        for i in range(pixels.shape[0]):
            if sides[i] == side:
                t = pixels[i, 0] * found[side, 0] + pixels[i, 1] * found[side, 1]
                low, high = min(low, t), max(high, t)
        span = max(high - low, _SPACING_PX * (CURVE - 2))
        for i in range(pixels.shape[0]):
            if sides[i] != side:
                continue
            t = pixels[i, 0] * found[side, 0] + pixels[i, 1] * found[side, 1]
            k = quadratic_spline((t - low) / span, CURVE, weights[i])
            first[i] = side * SIDE + k
            across = pixels[i, 1] * found[side, 0] - pixels[i, 0] * found[side, 1]
            weights[i, 3] = across / _SLOPE_PX
