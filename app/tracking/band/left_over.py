"""What a fit leaves of a delivered picture: its noise, and what that does to the band's place.

The noise is measured where the needle is, brightness and colour apart, and is alike in neighbours
as what is left is. Derivation: docs/band-fit.md.
"""

from typing import Any, Final

import numpy as np

from app.core.compiled import REORDERED, njit
from app.tracking.band.delivered import MOVES, influences

_LEAST: Final = 0.5
"""Least standard deviation of brightness or colour [grey levels]: they are whole numbers."""

_LAG: Final = 3
"""How far what is left is taken to be alike [px, or groups]."""

FAR_OFF: Final = 4.0
"""Standard deviations from which a pixel is left out."""

CHROMA_MORE: Final = 2.0
"""Colour counts for this much less: its quantisation is alike over whole blocks."""


@njit
def _deviation(values: Any, which: Any) -> float:
    """Return the standard deviation by the median of magnitudes."""
    count = 0
    out = np.empty(len(values))
    for i in range(len(values)):
        if which[i]:
            out[count] = abs(values[i])
            count += 1
    return 1.4826 * np.median(out[:count]) if count > 10 else 0.0


@njit
def noise_left(observed: Any, rows: Any, usable: Any, moved: Any) -> Any:
    """Return the noise of brightness and of colour near the needle, gross errors cut off."""
    typical = max(_LEAST, _deviation(moved.luma_left, rows.seen & usable))
    square, count = 0.0, 0
    for i in range(len(usable)):
        if rows.seen[i] and usable[i]:
            square += min(moved.luma_left[i] ** 2, (FAR_OFF * typical) ** 2)
            count += 1
    luma = max(_LEAST, np.sqrt(square / max(count, 1)))
    near = np.zeros(2 * len(moved.chroma_left), np.bool_)
    for k in range(len(moved.chroma_left)):
        for j in range(4):
            i = observed.members[k, j]
            if i >= 0 and rows.seen[i]:
                near[2 * k] = near[2 * k + 1] = True
    left = moved.chroma_left.copy().ravel()
    typical = max(_LEAST, _deviation(left, near))
    square, count = 0.0, 0
    for k in range(len(left)):
        if near[k]:
            square += min(left[k] ** 2, (FAR_OFF * typical) ** 2)
            count += 1
    return luma, max(_LEAST, CHROMA_MORE * np.sqrt(square / max(count, 1)))


@njit(fastmath=REORDERED)
def place_covariance(
    observed: Any,
    places: Any,
    size: Any,
    taken: Any,
    solved: Any,
    moved: Any,
    prior: Any,
    covariance: Any,
) -> None:
    """Fill the covariance of the band's n and e with noise alike as it is in what is left.

    Args:
        observed: `Observed`.
        places: column and row of every pixel, (2, m).
        size: columns and rows of a group, (2,).
        taken: colours' change with the moves, (SIZE, MOVES).
        solved: `Solved` of the last step.
        moved: `Moved`.
        prior: information of the moves beforehand, (MOVES,).
        covariance: out, (2, 2).
    """
    m, b = len(observed.luma), len(observed.chroma)
    by = (np.empty((m, 2)), np.empty((b, 2)), np.empty((b, 2)))
    inverse = solved.inverse
    influences(observed, solved.sparse, solved.tone, taken, moved, inverse, by)
    for p in range(2):
        for q in range(2):
            covariance[p, q] = 0.0
            for k in range(MOVES):
                covariance[p, q] += inverse[k, p] * prior[k] * inverse[k, q]
    us, vs = np.empty(b, np.int64), np.empty(b, np.int64)
    for k in range(b):
        us[k] = places[0, observed.members[k, 0]] // size[0]
        vs[k] = places[1, observed.members[k, 0]] // size[1]
    weights, kept = solved.weights, solved.kept
    _correlated(places[0], places[1], moved.luma_left, by[0], solved.good, weights[0], covariance)
    for plane in range(2):
        left = np.ascontiguousarray(moved.chroma_left[:, plane])
        _correlated(us, vs, left, by[1 + plane], kept, weights[1 + plane], covariance)


@njit(fastmath=REORDERED)
def _correlated(
    us: Any, vs: Any, left: Any, by: Any, good: Any, weight: float, covariance: Any
) -> None:
    """Add the covariance that one plane's noise makes."""
    n = len(left)
    if n == 0:
        return
    u0, v0 = us.min(), vs.min()
    grid = np.full((vs.max() - v0 + 1, us.max() - u0 + 1), -1, np.int64)
    count = 0
    for i in range(n):
        if good[i]:
            grid[vs[i] - v0, us[i] - u0] = i
            count += 1
    if count < 10:
        return
    side = 2 * _LAG + 1
    alike, pairs = np.zeros((side, side)), np.zeros((side, side))
    height, width = grid.shape
    for i in range(n):
        if not good[i]:
            continue
        x, y = us[i] - u0, vs[i] - v0
        for q in range(max(0, y - _LAG), min(height, y + _LAG + 1)):
            for p in range(max(0, x - _LAG), min(width, x + _LAG + 1)):
                j = grid[q, p]
                if j >= 0:
                    alike[q - y + _LAG, p - x + _LAG] += left[i] * left[j]
                    pairs[q - y + _LAG, p - x + _LAG] += 1.0
    for q in range(side):
        for p in range(side):
            taper = (1.0 - abs(q - _LAG) / (_LAG + 1.0)) * (1.0 - abs(p - _LAG) / (_LAG + 1.0))
            alike[q, p] *= taper / max(pairs[q, p], 1.0)
    for i in range(n):
        if not good[i]:
            continue
        x, y, first, second = us[i] - u0, vs[i] - v0, 0.0, 0.0
        for q in range(max(0, y - _LAG), min(height, y + _LAG + 1)):
            for p in range(max(0, x - _LAG), min(width, x + _LAG + 1)):
                j = grid[q, p]
                if j >= 0:
                    a = alike[q - y + _LAG, p - x + _LAG]
                    first += a * by[j, 0]
                    second += a * by[j, 1]
        square = weight * weight
        covariance[0, 0] += square * by[i, 0] * first
        covariance[0, 1] += square * by[i, 0] * second
        covariance[1, 0] += square * by[i, 1] * first
        covariance[1, 1] += square * by[i, 1] * second
