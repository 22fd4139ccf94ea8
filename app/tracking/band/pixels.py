"""The pixels that the band's fit looks at, and the background that stands behind them (compiled).

What stands behind a needle has mostly straight edges. On either side of the needle the background
is a curve along the direction in which it changes most, plus a slope across that direction: an edge
outside is so carried on to the band's outline. Where nothing changes but by noise, the curve is
held straight.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.tracking.band.model import quadratic_spline

CURVE: Final = 22
SIDE: Final = CURVE + 1
"""Unknowns of one side's background: the curve's B-splines and the slope."""

_SIDE_PX: Final = 9.0
_HUB_PX: Final = 6.0
_TIP_PX: Final = 6.0
"""What is looked at beside the band and beyond its ends: a highlight moves along the shaft."""

_BRIGHTEST: Final = 254
"""A colour from here on may be cut off."""

_CLEAR: Final = 4.0
"""From the needle's outline to what is background only [standard deviations of the blur]."""

_SPACING_PX: Final = 1.5
_SLOPE_PX: Final = 10.0


class BandPixels(NamedTuple):
    """The m pixels near a band; colours in standard deviations of the noise."""

    places: FloatArray
    """u, v from the outline's origin [px], (m, 2)."""
    colours: FloatArray
    """(m, 3)."""
    usable: NDArray[np.bool_]
    """Whether no colour is cut off, (m,)."""
    first: NDArray[np.int64]
    """First of the background's three columns that are not zero, (m,)."""
    weights: FloatArray
    """Of those three and of the slope's column if only background is seen, (m, 4)."""
    uneven: NDArray[np.bool_]
    """Whether either side's background has edges, (2,)."""


@njit
def gather(image: Any, outline: Any, blur: float, noise: float) -> Any:
    """Collect the pixels near the band, row by row; none if its centre is outside the picture.

    Args:
        image: uint8 (H, W, 3).
        outline: a `band.outline.Outline`.
        blur: standard deviation of the point spread [px].
        noise: standard deviation of a grey value.
    """
    left, top, right, bottom = _box(outline, image.shape[0], image.shape[1])
    most = max(0, right - left) * max(0, bottom - top)
    places, colours, usable = np.empty((most, 2)), np.empty((most, 3)), np.empty(most, np.bool_)
    sides = np.empty(most, np.int64)
    clear = np.zeros((max(0, bottom - top), max(0, right - left)), np.int8)
    low, high = outline.arcs.min() - _HUB_PX, outline.arcs.max() + _TIP_PX
    middle, count, room = 0.5 * (outline.left + outline.right), 0, _CLEAR * blur
    for v in range(top, bottom):
        for u in range(left, right):
            du, dv = u - outline.u, v - outline.v
            e, n = du * outline.eu + dv * outline.ev, dv * outline.eu - du * outline.ev
            if not (low < e < high and outline.left - _SIDE_PX < n < outline.right + _SIDE_PX):
                continue
            if n > outline.right + room:
                clear[v - top, u - left] = 2
            elif n < outline.left - room:
                clear[v - top, u - left] = 1
            places[count, 0], places[count, 1] = du, dv
            brightest = 0
            for c in range(3):
                colours[count, c] = image[v, u, c]
                brightest = max(brightest, image[v, u, c])
            usable[count] = brightest < _BRIGHTEST
            sides[count] = 1 if n > middle else 0
            count += 1
    found, uneven = np.empty((2, 2)), np.empty(2, np.bool_)
    _directions(image[top:bottom, left:right], clear, noise, found, uneven)
    first, weights = np.zeros(count, np.int64), np.empty((count, 4))
    _background(places[:count], sides[:count], found, first, weights)
    return BandPixels(
        places[:count], colours[:count] / noise, usable[:count], first, weights, uneven
    )


@njit
def _box(outline: Any, height: int, width: int) -> Any:
    """Left, top, right, bottom of the pixels to look at, the last two exclusive; maybe none."""
    if not (0.0 <= outline.u < width and 0.0 <= outline.v < height):
        return 0, 0, 0, 0
    left, top, right, bottom = np.inf, np.inf, -np.inf, -np.inf
    for end in range(2):
        e = outline.arcs.max() + _TIP_PX if end else outline.arcs.min() - _HUB_PX
        for side in range(2):
            n = outline.right + _SIDE_PX if side else outline.left - _SIDE_PX
            u = outline.u + e * outline.eu - n * outline.ev
            v = outline.v + e * outline.ev + n * outline.eu
            left, right = min(left, u), max(right, u)
            top, bottom = min(top, v), max(bottom, v)
    return (
        max(0, math.floor(left)),
        max(0, math.floor(top)),
        min(width, math.ceil(right) + 1),
        min(height, math.ceil(bottom) + 1),
    )


@njit
def _directions(window: Any, clear: Any, noise: float, result: Any, uneven: Any) -> None:
    """Direction of the strongest change on both sides, and whether there are edges.

    Args:
        window: uint8 (H, W, 3).
        clear: (H, W) int8: 1 or 2 where only the first or second side's background is seen, or 0.
        noise: standard deviation of a grey value.
        result: out, unit vectors (u, v), (2, 2).
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
        result[side, 0] = math.cos(angle) if strong else 0.0
        result[side, 1] = math.sin(angle) if strong else 1.0
        uneven[side] = strong


@njit
def _background(places: Any, sides: Any, result: Any, first: Any, weights: Any) -> None:
    """Background's columns of every pixel, before they are multiplied by its free share.

    Args:
        places: see `BandPixels`.
        sides: which side of the needle's middle, 0 or 1, (m,).
        result: see `_directions`.
        first: out, see `BandPixels`.
        weights: likewise.
    """
    for side in range(2):
        low, high = np.inf, -np.inf
        for i in range(places.shape[0]):
            if sides[i] == side:
                t = places[i, 0] * result[side, 0] + places[i, 1] * result[side, 1]
                low, high = min(low, t), max(high, t)
        span = max(high - low, _SPACING_PX * (CURVE - 2))
        for i in range(places.shape[0]):
            if sides[i] != side:
                continue
            t = places[i, 0] * result[side, 0] + places[i, 1] * result[side, 1]
            k = quadratic_spline((t - low) / span, CURVE, weights[i])
            first[i] = side * SIDE + k
            across = places[i, 1] * result[side, 0] - places[i, 0] * result[side, 1]
            weights[i, 3] = across / _SLOPE_PX
