"""Normal equations of the band's picture (compiled), see `band_fit`.

Unknowns of each colour apart ("rest"): shaft, tip and background. Common to all colours: the
paint's shading and where the band is.
"""

from typing import Any, Final

import numpy as np

from app.core.compiled import njit
from app.tracking.markers.band_design import BAND, COLUMNS, PARTIALS
from app.tracking.markers.band_ground import CURVE, SIDE
from app.tracking.markers.cholesky import factorise, finish, halve

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


@njit
def solve_step(
    rows: Any,
    first: Any,
    weights: Any,
    colours: Any,
    good: Any,
    paint: Any,
    prior: Any,
    shading_prior: Any,
    information: Any,
    right: Any,
    residual: Any,
) -> bool:
    """Solve for the colours, then set up the step in n, e, width and length.

    Args:
        rows: as above.
        first: as above.
        weights: as above.
        colours: as above.
        good: as above.
        paint: mean colour of the band, (3,).
        prior: of the rest's coefficients, (REST, REST); overwritten.
        shading_prior: of the band's, relative to the paint, (BAND,).
        information: out, of moves and shading, the rest eliminated, (MOVES + BAND, same).
        right: out, gradient by the moves, (MOVES,).
        residual: out, (m, 3).

    Returns:
        False if the pixels do not determine the colours.
    """
    cross, shared = np.empty((REST, BAND + 3)), np.empty((BAND, BAND + 3))
    colour_equations(rows, first, weights, colours, good, prior, cross, shared)
    if not factorise(prior):
        return False
    halve(prior, cross)
    free = np.empty((BAND, BAND + 3))
    strength = paint[0] ** 2 + paint[1] ** 2 + paint[2] ** 2
    shading, matrix = np.zeros((BAND, 1)), np.empty((BAND, BAND))
    for k in range(BAND):
        for q in range(BAND + 3):
            free[k, q] = shared[k, q]
            for a in range(REST):
                free[k, q] -= cross[a, k] * cross[a, q]
        for c in range(3):
            shading[k, 0] += free[k, BAND + c] * paint[c]
        for q in range(BAND):
            matrix[k, q] = strength * free[k, q]
        matrix[k, k] += shading_prior[k]
    if not factorise(matrix):
        return False
    halve(matrix, shading)
    finish(matrix, shading)
    band, rest = np.empty((BAND, 3)), np.empty((REST, 3))
    for c in range(3):
        for k in range(BAND):
            band[k, c] = shading[k, 0] * paint[c]
        for a in range(REST):
            rest[a, c] = cross[a, BAND + c]
            for k in range(BAND):
                rest[a, c] -= cross[a, k] * band[k, c]
    finish(prior, rest)
    crosses, moves = np.empty((3, REST, MOVES)), np.empty((3, MOVES, MOVES + BAND))
    move_equations(rows, first, weights, colours, good, band, rest, residual, crosses, moves, right)
    information[:] = 0.0
    both = np.empty((REST, MOVES + BAND))
    for c in range(3):
        halve(prior, crosses[c])
        for a in range(REST):
            for m in range(MOVES):
                both[a, m] = crosses[c, a, m]
            for k in range(BAND):
                both[a, MOVES + k] = paint[c] * cross[a, k]
        for p in range(MOVES + BAND):
            for q in range(p, MOVES + BAND):
                total = 0.0
                for a in range(REST):
                    total -= both[a, p] * both[a, q]
                if q < MOVES:
                    total += moves[c, p, q]
                elif p < MOVES:
                    total += paint[c] * moves[c, p, q]
                else:
                    total += paint[c] ** 2 * shared[p - MOVES, q - MOVES]
                information[p, q] += total
                if q > p:
                    information[q, p] += total
    for k in range(BAND):
        information[MOVES + k, MOVES + k] += shading_prior[k]
    return True
