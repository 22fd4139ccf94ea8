"""Normal equations of the band's picture (compiled), see `band_fit`.

Unknowns of each colour apart ("rest"): shaft, tip and background. Common to all colours: the
paint's shading and where the band is.
"""

from typing import Any, Final

import numpy as np

from app.core.compiled import njit
from app.tracking.markers.band_design import BAND, COLUMNS, PARTIALS
from app.tracking.markers.band_ground import CURVE, SIDE

REST: Final = COLUMNS - BAND + 2 * SIDE
MOVES: Final = PARTIALS - 1
_SHAFTS: Final = COLUMNS - BAND
_SLOPES: Final = _SHAFTS + CURVE


@njit
def covered(row: Any) -> float:
    """Share of band and shaft in a pixel, or its derivative: the sum of their columns."""
    rest = row[0]
    for k in range(BAND, COLUMNS):
        rest += row[k]
    return rest


@njit
def _entries(row: Any, free: float, first: int, weights: Any, index: Any, value: Any) -> int:
    """Columns of the rest that are not zero in a row; returns how many."""
    count = 0
    for k in range(BAND, COLUMNS):
        if row[k] != 0.0:
            index[count], value[count] = k - BAND, row[k]
            count += 1
    if free != 0.0:
        for k in range(3):
            index[count], value[count] = _SHAFTS + first + k, free * weights[k]
            count += 1
        index[count] = _SLOPES + (SIDE if first >= SIDE else 0)
        value[count] = free * weights[3]
        count += 1
    return count


@njit
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
    index, value = np.empty(COLUMNS + 4, np.int64), np.empty(COLUMNS + 4)
    right = np.empty(BAND + 3)
    cross[:], shared[:] = 0.0, 0.0
    for i in range(rows.shape[0]):
        if not good[i]:
            continue
        if not seen[i]:
            _ground_only(first[i], weights[i], colours[i], normal, cross)
            continue
        row = rows[i, 0]
        count = _entries(row, 1.0 - covered(row), first[i], weights[i], index, value)
        for k in range(BAND):
            right[k] = row[k]
        for c in range(3):
            right[BAND + c] = colours[i, c]
        for p in range(count):
            a, x = index[p], value[p]
            for q in range(p + 1):
                normal[a, index[q]] += x * value[q]
            for k in range(BAND + 3):
                cross[a, k] += x * right[k]
        if row[0] != 0.0:
            for k in range(BAND):
                for q in range(BAND + 3):
                    shared[k, q] += row[k] * right[q]


@njit
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


@njit
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
        cross: out, rest with the derivatives by n, e, width and length of each colour,
            (REST, 3 * MOVES).
        moves: out, derivatives with derivatives and with the band, (MOVES, MOVES + BAND).
        right: out, derivatives with the residual, (MOVES,).
    """
    index, value = np.empty(COLUMNS + 4, np.int64), np.empty(COLUMNS + 4)
    slope, ground, residual = np.empty(3 * MOVES), np.empty(3), np.empty(3)
    cross[:], moves[:], right[:] = 0.0, 0.0, 0.0
    for i in range(rows.shape[0]):
        start, slopes = _SHAFTS + first[i], _SLOPES + (SIDE if first[i] >= SIDE else 0)
        for c in range(3):
            ground[c] = weights[i, 3] * rest[slopes, c]
            for k in range(3):
                ground[c] += weights[i, k] * rest[start + k, c]
        row, count, free = rows[i, 0], 0, 1.0
        light = 0.0
        if seen[i]:
            free = 1.0 - covered(row)
            count = _entries(row, 0.0, first[i], weights[i], index, value)
            for k in range(BAND):
                light += row[k] * shading[k]
        squares[i] = 0.0
        for c in range(3):
            model = light * paint[c] + free * ground[c]
            for p in range(count):
                model += value[p] * rest[index[p], c]
            residual[c] = colours[i, c] - model
            squares[i] += residual[c] * residual[c] / 3.0
        if not seen[i] or not good[i] or (row[0] == 0.0 and free > 0.9999):
            continue
        for m in range(MOVES):
            change = rows[i, 1 + m]
            lost, light = covered(change), 0.0
            for k in range(BAND):
                light += change[k] * shading[k]
            for c in range(3):
                total = light * paint[c] - lost * ground[c]
                for p in range(count):
                    total += change[BAND + index[p]] * rest[index[p], c]
                slope[c * MOVES + m] = total
        count = _entries(row, free, first[i], weights[i], index, value)
        for p in range(count):
            a, x = index[p], value[p]
            for q in range(3 * MOVES):
                cross[a, q] += x * slope[q]
        for m in range(MOVES):
            painted = 0.0
            for c in range(3):
                x = slope[c * MOVES + m]
                right[m] += x * residual[c]
                painted += x * paint[c]
                for q in range(MOVES):
                    moves[m, q] += x * slope[c * MOVES + q]
            for k in range(BAND):
                moves[m, MOVES + k] += painted * row[k]
