"""The picture round the band as a linear model of its colours (compiled).

Every pixel sees, through the point spread (a Gaussian), shares of the band, of the shaft behind it,
of the point before it and of the background. Given where the band is, their colours are linear
unknowns; a column each, of which the first seven are the paint's shading and common to all colours:

    band        1, sin, cos of ψ, 2ψ and 4ψ (sin ψ = x, -1 to 1 across): the harmonics that a
                matt body has in any light (Ramamoorthi and Hanrahan 2001)
    shaft, tip  quadratic B-splines in x: polished, with a highlight along it

The derivatives of every entry by where the band is (n, e), how wide and how long, come along. The
integral over the point spread is exact along the needle and across, but for the strips' width
(`outline.strips`), within which an arc is a step. Derivation: docs/band-fit.md.
"""

import math
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.compiled import REORDERED, njit
from app.tracking.band.outline import tapers_at_once

BAND: Final = 7
SPLINES: Final = 9
COLUMNS: Final = BAND + 2 * SPLINES
PARTIALS: Final = 5
"""Entry and derivatives by n, e, the width's and the length's relative change."""

_FAR: Final = 3.0
"""Where the point spread is cut off [standard deviations]: what lies beyond is 0.3 % of it, and a
quarter of the strips near every pixel."""

_FINE: Final = 256
"""Entries of the table per standard deviation: linear between them, to 1e-6."""

_GRID = np.arange(-_FAR * _FINE, _FAR * _FINE + 2) / _FINE
_INSIDE: Final = math.erf(_FAR / math.sqrt(2.0))
_TABLE: Final = np.column_stack(
    [
        [0.5 + 0.5 * math.erf(z / math.sqrt(2.0)) / _INSIDE for z in _GRID],
        np.exp(-0.5 * _GRID**2) / math.sqrt(2.0 * math.pi) / _INSIDE,
    ]
)
"""Share of a Gaussian below, and the bell; both of what is within `_FAR`."""


@njit(fastmath=REORDERED, forceinline=True)
def _gauss(z: float) -> Any:
    """Share of a Gaussian below z, and the bell there."""
    t = (z + _FAR) * _FINE
    if not t > 0.0:
        return 0.0, 0.0
    if t >= _TABLE.shape[0] - 2:
        return 1.0, 0.0
    k = int(t)
    t -= k
    below, bell = _TABLE[k, 0], _TABLE[k, 1]
    return below + t * (_TABLE[k + 1, 0] - below), bell + t * (_TABLE[k + 1, 1] - bell)


@njit
def quadratic_spline(t: float, count: int, weights: Any) -> int:
    """Three quadratic B-splines of `count` that are not zero at t in 0..1; returns the first's."""
    t *= count - 2
    k = min(count - 3, max(0, int(t)))
    t -= k
    weights[0] = 0.5 * (1.0 - t) * (1.0 - t)
    weights[1] = 0.5 + t * (1.0 - t)
    weights[2] = 0.5 * t * t
    return k


class Rows(NamedTuple):
    """The model's columns at m pixels."""

    values: FloatArray
    """Entry and its derivatives, (m, PARTIALS or more, COLUMNS); of no meaning where not `seen`.
    If there are more, two of them are by the blur across and along the needle."""
    seen: NDArray[np.bool_]
    """Whether a pixel sees more than the background, (m,)."""


class _Strips(NamedTuple):
    """What the strips across the band have, whatever pixel looks at them."""

    paint: FloatArray
    """Harmonics of the shading, (strips, BAND)."""
    splines: FloatArray
    """Three B-splines of shaft and point, (strips, 3)."""
    first: NDArray[np.int64]
    """Which are these, (strips,)."""


@njit
def no_rows(count: int) -> Any:
    """Return `Rows` of `count` pixels for `design` to fill."""
    return Rows(np.empty((count, PARTIALS, COLUMNS)), np.zeros(count, np.bool_))


@njit(fastmath=REORDERED)
def design(
    places: Any,
    outline: Any,
    shape: Any,
    blur: float,
    shift: Any,
    stretch: Any,
    rows: Any,
    blur_along: float = 0.0,
) -> None:
    """Fill the rows of the pixels that see more than the background.

    Args:
        places: u, v from the outline's origin, (m, 2).
        outline: a `band.outline.Outline`.
        shape: a `rig.NeedleShape`.
        blur: standard deviation of the point spread [px]; across the needle only if another is
            given along it.
        shift: how far the band is from the outline's place [px], (2,).
        stretch: width and length of the band over those of the outline, (2,).
        rows: out, `Rows`.
        blur_along: standard deviation along the needle [px], where it is another one.
    """
    arcs = outline.arcs
    cells = arcs.shape[1]
    long = blur_along if blur_along > 0.0 else blur
    strip, reach = _strips(cells), _FAR * long
    low, high = stretch[1] * arcs[:2].min(), stretch[1] * arcs[:2].max()
    inner_low = stretch[1] * arcs[0].max() + reach
    inner_high = stretch[1] * arcs[1].min() - reach
    edges, slim = np.empty((4, cells + 1)), shape.shaft / shape.radius
    for i in range(places.shape[0]):
        row = rows.values[i]
        rows.seen[i] = False
        du, dv = places[i, 0] - shift[0], places[i, 1] - shift[1]
        e = du * outline.eu + dv * outline.ev
        n = dv * outline.eu - du * outline.ev
        left = outline.left + outline.left_slope * e
        right = outline.right + outline.right_slope * e
        bow = outline.bow * (e * e - outline.bow_zero)
        middle, width = 0.5 * (left + right) + bow, 0.5 * (right - left)
        if low - reach < e < high + reach:
            a, b = _across(n, middle, width, blur, stretch[0], edges)
            if a < b:
                row[:], rows.seen[i] = 0.0, True
            if inner_low < e < inner_high:
                _within(row, a, b, edges, strip.paint)
            else:
                _band(row, e, a, b, edges, arcs, long, stretch[1], strip.paint)
        for tip in range(2):
            if (e < high - reach * 2.0) if tip else (e > low + reach * 2.0):
                continue
            thick = slim
            if tip:
                at = (n - middle) / (stretch[0] * width)
                thick = _taper(outline, shape, e, at, long, stretch[1])
            a, b = _across(n, middle, width * thick, blur, stretch[0], edges)
            if a < b and not rows.seen[i]:
                row[:], rows.seen[i] = 0.0, True
            _shaft(row, e, a, b, edges, arcs, long, stretch[1], tip, strip.splines, strip.first)


@njit(fastmath=REORDERED)
def _strips(cells: int) -> Any:
    paint, splines = np.empty((cells, BAND)), np.empty((cells, 3))
    first = np.empty(cells, dtype=np.int64)
    for j in range(cells):
        x = (2 * j + 1.0) / cells - 1.0
        depth = math.sqrt(1.0 - x * x)
        double_sine, double_cosine = 2.0 * x * depth, 1.0 - 2.0 * x * x
        paint[j, 0], paint[j, 1], paint[j, 2] = 1.0, x, depth
        paint[j, 3], paint[j, 4] = double_sine, double_cosine
        paint[j, 5] = 2.0 * double_sine * double_cosine
        paint[j, 6] = 1.0 - 2.0 * double_sine * double_sine
        first[j] = quadratic_spline(0.5 * (x + 1.0), SPLINES, splines[j])
    return _Strips(paint, splines, first)


@njit(fastmath=REORDERED, forceinline=True)
def _taper(outline: Any, shape: Any, e: float, x: float, blur: float, stretch: float) -> float:
    """Width of the needle before the band, over the band's, where a pixel looks on average.

    Args:
        outline: see `design`.
        shape: likewise.
        e: of the pixel.
        x: of the pixel, across the band.
        blur: see `design`.
        stretch: of the length.
    """
    cells = outline.arcs.shape[1]
    j = int(0.5 * cells * (x + 1.0))
    h = (stretch * outline.arcs[1, min(cells - 1, max(0, j))] - e) / blur
    below, bell = _gauss(h)
    at = e + blur * bell / max(1.0 - below, 1e-3)
    taper = max(0.05, (outline.apex - at) / outline.taper)
    return taper if tapers_at_once(shape) else min(shape.shaft / shape.radius, taper)


@njit(fastmath=REORDERED, forceinline=True)
def _across(n: float, middle: float, width: float, blur: float, stretch: float, edges: Any) -> Any:
    """Fill share below, its derivatives by n, width and blur, at the strips' edges near a pixel.

    Returns the first strip near and the last + 1.
    """
    cells = edges.shape[1] - 1
    step = 2.0 * stretch * width / cells
    start = (n - _FAR * blur - middle + stretch * width) / step
    stop = (n + _FAR * blur - middle + stretch * width) / step
    a, b = max(0, math.floor(start)), min(cells, math.ceil(stop))
    at, ahead, sharp = (middle - stretch * width - n) / blur, step / blur, 1.0 / blur
    for j in range(a, b + 1):
        z = at + j * ahead
        below, bell = _gauss(z)
        bell *= sharp
        edges[0, j], edges[1, j] = below, -bell
        edges[2, j] = bell * width * (j * (2.0 / cells) - 1.0)
        edges[3, j] = -bell * z
    return a, b


@njit(fastmath=REORDERED, forceinline=True)
def _within(row: Any, a: int, b: int, edges: Any, profile: Any) -> None:
    """Like `_band`, far from both of the band's ends."""
    for j in range(a, b):
        share = edges[0, j + 1] - edges[0, j]
        by_n = edges[1, j + 1] - edges[1, j]
        by_width = edges[2, j + 1] - edges[2, j]
        for k in range(BAND):
            p = profile[j, k]
            row[0, k] += p * share
            row[1, k] += p * by_n
            row[3, k] += p * by_width
        if row.shape[0] > PARTIALS:
            by_blur = edges[3, j + 1] - edges[3, j]
            for k in range(BAND):
                row[PARTIALS, k] += profile[j, k] * by_blur


@njit(fastmath=REORDERED, forceinline=True)
def _band(
    row: Any,
    e: float,
    a: int,
    b: int,
    edges: Any,
    arcs: Any,
    blur: float,
    stretch: float,
    profile: Any,
) -> None:
    """Add the band's columns of one pixel and their derivatives."""
    sharp = 1.0 / blur
    for j in range(a, b):
        h1, h2 = (stretch * arcs[0, j] - e) * sharp, (stretch * arcs[1, j] - e) * sharp
        if h1 >= _FAR or h2 <= -_FAR:
            continue
        (below1, bell1), (below2, bell2) = _gauss(h1), _gauss(h2)
        along, k1, k2 = below2 - below1, bell1 * sharp, bell2 * sharp
        across = edges[0, j + 1] - edges[0, j]
        share = across * along
        by_n = (edges[1, j + 1] - edges[1, j]) * along
        by_e = (k1 - k2) * across
        by_width = (edges[2, j + 1] - edges[2, j]) * along
        by_length = (k2 * arcs[1, j] - k1 * arcs[0, j]) * across
        for k in range(BAND):
            p = profile[j, k]
            row[0, k] += p * share
            row[1, k] += p * by_n
            row[2, k] += p * by_e
            row[3, k] += p * by_width
            row[4, k] += p * by_length
        if row.shape[0] > PARTIALS:
            by_blur = (edges[3, j + 1] - edges[3, j]) * along
            by_long = (k1 * h1 - k2 * h2) * across
            for k in range(BAND):
                row[PARTIALS, k] += profile[j, k] * by_blur
                row[PARTIALS + 1, k] += profile[j, k] * by_long


@njit(fastmath=REORDERED, forceinline=True)
def _shaft(
    row: Any,
    e: float,
    a: int,
    b: int,
    edges: Any,
    arcs: Any,
    blur: float,
    stretch: float,
    tip: int,
    splines: Any,
    first: Any,
) -> None:
    """Add the columns of the shaft beyond one end of the band, and their derivatives."""
    start = BAND + tip * SPLINES
    sign, sharp = -1.0 if tip else 1.0, 1.0 / blur
    for j in range(a, b):
        h = (stretch * arcs[2 + tip, j] - e) * sharp
        along, bell = _gauss(sign * h)
        if along == 0.0:
            continue
        bell *= sign * sharp
        across = edges[0, j + 1] - edges[0, j]
        share = across * along
        by_n = (edges[1, j + 1] - edges[1, j]) * along
        by_e = -bell * across
        by_width = (edges[2, j + 1] - edges[2, j]) * along
        by_length = bell * arcs[2 + tip, j] * across
        for k in range(3):
            p, column = splines[j, k], start + first[j] + k
            row[0, column] += p * share
            row[1, column] += p * by_n
            row[2, column] += p * by_e
            row[3, column] += p * by_width
            row[4, column] += p * by_length
        if row.shape[0] > PARTIALS:
            by_blur = (edges[3, j + 1] - edges[3, j]) * along
            by_long = -bell * h * across
            for k in range(3):
                column = start + first[j] + k
                row[PARTIALS, column] += splines[j, k] * by_blur
                row[PARTIALS + 1, column] += splines[j, k] * by_long
