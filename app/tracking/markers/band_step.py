"""One step of the fit: solve for the colours, then set up the step in position (compiled)."""

from typing import Any

import numpy as np

from app.core.compiled import njit
from app.tracking.markers.band_design import BAND
from app.tracking.markers.band_normal import MOVES, REST, colour_equations, move_equations
from app.tracking.markers.cholesky import factorise, finish, halve


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
        rows: see `band_design.design`.
        first: see `band_ground.ground_columns`.
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
