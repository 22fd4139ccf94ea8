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
        first: see `band_ground.ground_columns`.
        weights: likewise.
        colours: of the pixels, (m, 3).
        good: which count, (m,).
        normal: in and out, (REST, REST).
        cross: out, rest with band and colours, (REST, BAND + 3).
        shared: out, band with band and colours, (BAND, BAND + 3).
    """
    index, value = np.empty(COLUMNS + 4, np.int64), np.empty(COLUMNS + 4)
    right = np.empty(BAND + 3)
    cross[:], shared[:] = 0.0, 0.0
    for i in range(rows.shape[0]):
        if not good[i]:
            continue
        row = rows[i, 0]
        count = _entries(row, 1.0 - covered(row), first[i], weights[i], index, value)
        for k in range(BAND):
            right[k] = row[k]
        for c in range(3):
            right[BAND + c] = colours[i, c]
        for p in range(count):
            a, x = index[p], value[p]
            for q in range(count):
                normal[a, index[q]] += x * value[q]
            for k in range(BAND + 3):
                cross[a, k] += x * right[k]
        if row[0] != 0.0:
            for k in range(BAND):
                for q in range(BAND + 3):
                    shared[k, q] += row[k] * right[q]


@njit
def move_equations(
    rows: Any,
    first: Any,
    weights: Any,
    colours: Any,
    good: Any,
    band: Any,
    rest: Any,
    residual: Any,
    cross: Any,
    moves: Any,
    right: Any,
) -> None:
    """Residuals, and what is needed to solve for the position.

    Args:
        rows: as above.
        first: as above.
        weights: as above.
        colours: as above.
        good: as above.
        band: coefficients, (BAND, 3).
        rest: coefficients, (REST, 3).
        residual: out, colours minus the model, (m, 3).
        cross: out, rest with the derivatives by n, e, width and length, (3, REST, MOVES).
        moves: out, derivatives with derivatives and with the band, (3, MOVES, MOVES + BAND).
        right: out, derivatives with the residual, (MOVES,).
    """
    index, value = np.empty(COLUMNS + 4, np.int64), np.empty(COLUMNS + 4)
    slope = np.empty((MOVES, 3))
    ground = np.empty(3)
    cross[:], moves[:], right[:] = 0.0, 0.0, 0.0
    for i in range(rows.shape[0]):
        row = rows[i, 0]
        free = 1.0 - covered(row)
        count = _entries(row, free, first[i], weights[i], index, value)
        start = _SHAFTS + first[i]
        slopes = _SLOPES + (SIDE if first[i] >= SIDE else 0)
        for c in range(3):
            ground[c] = weights[i, 3] * rest[slopes, c]
            for k in range(3):
                ground[c] += weights[i, k] * rest[start + k, c]
            model = 0.0
            for k in range(BAND):
                model += row[k] * band[k, c]
            for p in range(count):
                model += value[p] * rest[index[p], c]
            residual[i, c] = colours[i, c] - model
        if not good[i] or (row[0] == 0.0 and free > 0.9999):
            continue
        for m in range(MOVES):
            change = rows[i, 1 + m]
            lost = covered(change)
            for c in range(3):
                total = -lost * ground[c]
                for k in range(BAND):
                    total += change[k] * band[k, c]
                for k in range(BAND, COLUMNS):
                    if change[k] != 0.0:
                        total += change[k] * rest[k - BAND, c]
                slope[m, c] = total
        for c in range(3):
            for m in range(MOVES):
                x = slope[m, c]
                if x == 0.0:
                    continue
                right[m] += x * residual[i, c]
                for q in range(MOVES):
                    moves[c, m, q] += x * slope[q, c]
                for k in range(BAND):
                    moves[c, m, MOVES + k] += x * row[k]
                for p in range(count):
                    cross[c, index[p], m] += x * value[p]
