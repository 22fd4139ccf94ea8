"""Normal equations of the band's picture (compiled), see `band_fit`.

Unknowns of each colour apart ("rest"): shaft, tip and background. Common to all colours: the
paint's shading and where the band is.
"""

from typing import Any, Final

import numpy as np

from app.core.compiled import REORDERED, njit
from app.tracking.markers.band_design import BAND, COLUMNS, PARTIALS
from app.tracking.markers.band_ground import CURVE, SIDE

REST: Final = COLUMNS - BAND + 2 * SIDE
MOVES: Final = PARTIALS - 1
_SHAFTS: Final = COLUMNS - BAND
_SLOPES: Final = _SHAFTS + CURVE
_NOTHING: Final = 1e-9
"""Share of a pixel too small to count."""


@njit(fastmath=REORDERED, forceinline=True)
def _shafts(row: Any) -> Any:
    """First of a row's columns of shaft and tip that is not zero, and the last + 1."""
    low, high = BAND, COLUMNS
    while low < high and row[low] == 0.0:
        low += 1
    while high > low and row[high - 1] == 0.0:
        high -= 1
    return low, high


@njit(fastmath=REORDERED, forceinline=True)
def _free(row: Any, low: int, high: int) -> float:
    """Share of the background in a pixel: what band and shaft leave."""
    rest = 1.0 - row[0]
    for k in range(low, high):
        rest -= row[k]
    return rest


@njit(fastmath=REORDERED)
def colour_equations(
    rows: Any,
    seen: Any,
    first: Any,
    weights: Any,
    colours: Any,
    good: Any,
    normal: Any,
    cross: Any,
    shared: Any,
) -> None:
    """Add up what is needed to solve for the colours.

    Args:
        rows: see `band_design.design`.
        seen: likewise.
        first: see `band_ground.ground_columns`.
        weights: likewise.
        colours: of the pixels, (m, 3).
        good: which count, (m,).
        normal: in and out, lower triangle, (REST, REST).
        cross: out, rest with band and colours, (REST, BAND + 3).
        shared: out, band with band and colours, (BAND, BAND + 3).
    """
    right, ground = np.empty(BAND + 3), np.empty(4)
    cross[:], shared[:] = 0.0, 0.0
    for i in range(rows.shape[0]):
        if not good[i]:
            continue
        if not seen[i]:
            _ground_only(first[i], weights[i], colours[i], normal, cross)
            continue
        row = rows[i, 0]
        low, high = _shafts(row)
        free = _free(row, low, high)
        for k in range(BAND):
            right[k] = row[k]
        for c in range(3):
            right[BAND + c] = colours[i, c]
        for p in range(4):
            ground[p] = free * weights[i, p]
        for k in range(low, high):
            x = row[k]
            for q in range(low, k + 1):
                normal[k - BAND, q - BAND] += x * row[q]
            for q in range(BAND + 3):
                cross[k - BAND, q] += x * right[q]
        if abs(free) > _NOTHING:
            _background(first[i], ground, row, low, high, right, normal, cross)
        if row[0] != 0.0:
            for k in range(BAND):
                for q in range(k, BAND + 3):
                    shared[k, q] += row[k] * right[q]
    for k in range(BAND):
        for q in range(k):
            shared[k, q] = shared[q, k]


@njit(fastmath=REORDERED, forceinline=True)
def _background(
    first: int, ground: Any, row: Any, low: int, high: int, right: Any, normal: Any, cross: Any
) -> None:
    """Add what the background's four columns of a pixel have in common with all others."""
    start, slope = _SHAFTS + first, _SLOPES + (SIDE if first >= SIDE else 0)
    for p in range(4):
        a, x = (slope if p == 3 else start + p), ground[p]
        for q in range(low, high):
            normal[a, q - BAND] += x * row[q]
        for q in range(min(p, 2) + 1):
            normal[a, start + q] += x * ground[q]
        for q in range(BAND + 3):
            cross[a, q] += x * right[q]
    normal[slope, slope] += ground[3] * ground[3]


@njit(fastmath=REORDERED, forceinline=True)
def _ground_only(first: int, weights: Any, colour: Any, normal: Any, cross: Any) -> None:
    """Add a pixel of the background alone."""
    start, slope = _SHAFTS + first, _SLOPES + (SIDE if first >= SIDE else 0)
    for p in range(4):
        a, x = (slope if p == 3 else start + p), weights[p]
        for q in range(min(p, 2) + 1):
            normal[a, start + q] += x * weights[q]
        for c in range(3):
            cross[a, BAND + c] += x * colour[c]
    normal[slope, slope] += weights[3] * weights[3]


@njit(fastmath=REORDERED)
def move_equations(
    rows: Any,
    seen: Any,
    first: Any,
    weights: Any,
    colours: Any,
    good: Any,
    paint: Any,
    shading: Any,
    rest: Any,
    squares: Any,
    cross: Any,
    moves: Any,
    right: Any,
) -> None:
    """Residuals, and what is needed to solve for the position.

    Args:
        rows: as above.
        seen: as above.
        first: as above.
        weights: as above.
        colours: as above.
        good: as above.
        paint: mean colour of the band, (3,).
        shading: of the band: its coefficients are those of the paint times these, (BAND,).
        rest: coefficients, (REST, 3).
        squares: out, mean square over the colours of the difference from the model, (m,).
        cross: out, rest with the derivatives of the three colours by n, then by e, width and
            length, (REST, 3 * MOVES).
        moves: out, derivatives with derivatives and with the band, (MOVES, MOVES + BAND).
        right: out, derivatives with the residual, (MOVES,).
    """
    slope, ground, residual = np.empty(3 * MOVES), np.empty(3), np.empty(3)
    cross[:], moves[:], right[:] = 0.0, 0.0, 0.0
    for i in range(rows.shape[0]):
        _colour_behind(first[i], weights[i], rest, ground)
        row, low, high, free = rows[i, 0], BAND, BAND, 1.0
        if seen[i]:
            low, high = _shafts(row)
            free = _free(row, low, high)
            _model(row, low, high, free, shading, paint, rest, ground, residual)
        else:
            residual[:] = ground
        squares[i] = 0.0
        for c in range(3):
            residual[c] = colours[i, c] - residual[c]
            squares[i] += residual[c] * residual[c] / 3.0
        if not seen[i] or not good[i] or (row[0] == 0.0 and free > 0.9999):
            continue
        for m in range(MOVES):
            change = rows[i, 1 + m]
            gained, by_colour = -change[0], slope[3 * m : 3 * m + 3]
            for k in range(low, high):
                gained -= change[k]
            _model(change, low, high, gained, shading, paint, rest, ground, by_colour)
        start, last = _SHAFTS + first[i], _SLOPES + (SIDE if first[i] >= SIDE else 0)
        for k in range(low, high):
            for q in range(3 * MOVES):
                cross[k - BAND, q] += row[k] * slope[q]
        if abs(free) > _NOTHING:
            for p in range(4):
                a, x = (last if p == 3 else start + p), free * weights[i, p]
                for q in range(3 * MOVES):
                    cross[a, q] += x * slope[q]
        _gather_moves(slope, residual, paint, row, moves, right)
    for m in range(MOVES):
        for q in range(m):
            moves[m, q] = moves[q, m]


@njit(fastmath=REORDERED, forceinline=True)
def _colour_behind(first: int, weights: Any, rest: Any, ground: Any) -> None:
    """Fill the background's colour at a pixel, (3,)."""
    start, slope = _SHAFTS + first, _SLOPES + (SIDE if first >= SIDE else 0)
    for c in range(3):
        ground[c] = (
            weights[0] * rest[start, c]
            + weights[1] * rest[start + 1, c]
            + weights[2] * rest[start + 2, c]
            + weights[3] * rest[slope, c]
        )


@njit(fastmath=REORDERED, forceinline=True)
def _model(
    row: Any,
    low: int,
    high: int,
    free: float,
    shading: Any,
    paint: Any,
    rest: Any,
    ground: Any,
    colour: Any,
) -> None:
    """Fill the colour that a row stands for, (3,); of a row's derivative, its change."""
    light = 0.0
    for k in range(BAND):
        light += row[k] * shading[k]
    first, second, third = light * paint[0], light * paint[1], light * paint[2]
    for k in range(low, high):
        first += row[k] * rest[k - BAND, 0]
        second += row[k] * rest[k - BAND, 1]
        third += row[k] * rest[k - BAND, 2]
    colour[0] = first + free * ground[0]
    colour[1] = second + free * ground[1]
    colour[2] = third + free * ground[2]


@njit(fastmath=REORDERED, forceinline=True)
def _gather_moves(slope: Any, residual: Any, paint: Any, row: Any, moves: Any, right: Any) -> None:
    """Add a pixel to the products of the derivatives with each other, the band and the residual."""
    for m in range(MOVES):
        first, second, third = slope[3 * m], slope[3 * m + 1], slope[3 * m + 2]
        right[m] += first * residual[0] + second * residual[1] + third * residual[2]
        painted = first * paint[0] + second * paint[1] + third * paint[2]
        for q in range(m, MOVES):
            moves[m, q] += (
                first * slope[3 * q] + second * slope[3 * q + 1] + third * slope[3 * q + 2]
            )
        for k in range(BAND):
            moves[m, MOVES + k] += painted * row[k]
