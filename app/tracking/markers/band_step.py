"""One step of the fit: solve for the colours, then set up the step in position (compiled)."""

from typing import Any

import numpy as np

from app.core.compiled import REORDERED, njit
from app.tracking.markers.band_design import BAND
from app.tracking.markers.band_normal import MOVES, REST, colour_equations, move_equations
from app.tracking.markers.cholesky import factorise, finish, halve


@njit(fastmath=REORDERED)
def solve_step(
    rows: Any,
    seen: Any,
    first: Any,
    weights: Any,
    colours: Any,
    good: Any,
    paint: Any,
    prior: Any,
    shading_prior: Any,
    information: Any,
    right: Any,
    squares: Any,
) -> bool:
    """Solve for the colours, then set up the step in n, e, width and length.

    Args:
        rows: see `band_design.design`.
        seen: likewise.
        first: see `band_ground.ground_columns`.
        weights: as above.
        colours: as above.
        good: as above.
        paint: mean colour of the band, (3,).
        prior: of the rest's coefficients, lower triangle, (REST, REST); overwritten.
        shading_prior: of the band's, relative to the paint, (BAND,).
        information: out, of moves and shading, the rest eliminated, (MOVES + BAND, same).
        right: out, gradient by the moves, (MOVES,).
        squares: out, mean square over the colours of the pixels' residuals, (m,).

    Returns:
        False if the pixels do not determine the colours.
    """
    cross, shared = np.empty((REST, BAND + 3)), np.empty((BAND, BAND + 3))
    colour_equations(rows, seen, first, weights, colours, good, prior, cross, shared)
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
    rest = np.empty((REST, 3))
    for a in range(REST):
        light = 0.0
        for k in range(BAND):
            light += cross[a, k] * shading[k, 0]
        for c in range(3):
            rest[a, c] = cross[a, BAND + c] - light * paint[c]
    finish(prior, rest)
    crosses, moves = np.empty((REST, 3 * MOVES)), np.empty((MOVES, MOVES + BAND))
    move_equations(
        rows, seen, first, weights, colours, good, paint, shading[:, 0], rest, squares,
        crosses, moves, right,
    )  # fmt: skip
    halve(prior, crosses)
    for p in range(MOVES):
        for q in range(MOVES + BAND):
            information[p, q] = moves[p, q]
    for k in range(BAND):
        for q in range(BAND):
            information[MOVES + k, MOVES + q] = strength * free[k, q]
        information[MOVES + k, MOVES + k] += shading_prior[k]
    for a in range(REST):
        for p in range(MOVES):
            painted = 0.0
            for c in range(3):
                x = crosses[a, 3 * p + c]
                painted += paint[c] * x
                for q in range(MOVES):
                    information[p, q] -= x * crosses[a, 3 * q + c]
            for k in range(BAND):
                information[p, MOVES + k] -= painted * cross[a, k]
    for p in range(MOVES):
        for q in range(MOVES, MOVES + BAND):
            information[q, p] = information[p, q]
    return True
