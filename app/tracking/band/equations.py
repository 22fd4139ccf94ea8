"""Least squares of the band's picture: the colours eliminated, the step in position (compiled).

Unknowns of each colour apart ("rest"): shaft, tip and background. Common to all colours: the
paint's shading and where the band is ("moves": n, e, width, length). The colours are solved for at
every step; what is left is a small system in moves and shading. Derivation: docs/band-fit.md.
"""

from typing import Any, Final, NamedTuple

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import REORDERED, njit
from app.tracking.band.model import BAND, COLUMNS, PARTIALS
from app.tracking.band.pixels import CURVE, SIDE

REST: Final = COLUMNS - BAND + 2 * SIDE
MOVES: Final = PARTIALS - 1
_SHAFTS: Final = COLUMNS - BAND
_SLOPES: Final = _SHAFTS + CURVE
_NOTHING: Final = 1e-9
"""Share of a pixel too small to count."""


class SolvedColours(NamedTuple):
    """Colours that fit best where the band is taken to be, and what led to them."""

    shading: FloatArray
    """Of the band: its coefficients are those of the paint times these, (BAND,)."""
    rest: FloatArray
    """Coefficients of the rest, (REST, 3)."""
    factor: FloatArray
    """Cholesky's factor L of the rest's normal matrix, (REST, REST)."""
    halved: FloatArray
    """L⁻¹ (rest with band and colours), (REST, BAND + 3)."""
    band: FloatArray
    """Band with band, the rest eliminated and the prior added, (BAND, BAND)."""


class MoveSums(NamedTuple):
    """Sums over the pixels in which the moves' derivatives stand."""

    squares: FloatArray
    """Mean square over the colours of each pixel's residual, (m,)."""
    cross: FloatArray
    """Rest with the derivatives of the three colours by n, then by e, width, length,
    (REST, 3 * MOVES)."""
    moves: FloatArray
    """Derivatives with derivatives and with the band, (MOVES, MOVES + BAND)."""
    right: FloatArray
    """Derivatives with the residual, (MOVES,)."""


class StepEquations(NamedTuple):
    """What a step in position, width and length is solved from."""

    information: FloatArray
    """Of moves and shading, the rest eliminated, (MOVES + BAND, MOVES + BAND)."""
    right: FloatArray
    """Gradient by the moves, (MOVES,)."""
    squares: FloatArray
    """See `MoveSums`."""


@njit(fastmath=REORDERED)
def solve_colours(
    pixels: Any, rows: Any, good: Any, paint: Any, prior: Any, shading_prior: Any
) -> Any:
    """Solve for the colours: whether the pixels determine them, and `SolvedColours`.

    Args:
        pixels: a `BandPixels`.
        rows: a `model.Rows`.
        good: which pixels count, (m,).
        paint: mean colour of the band, (3,).
        prior: of the rest's coefficients, lower triangle, (REST, REST).
        shading_prior: of the band's, relative to the paint, (BAND,).
    """
    normal, shading, rest = prior.copy(), np.zeros((BAND, 1)), np.empty((REST, 3))
    cross, shared = colour_sums(pixels, rows, good, normal)
    band, factor = np.empty((BAND, BAND)), np.empty((BAND, BAND))
    solved = SolvedColours(shading[:, 0], rest, normal, cross, band)
    if not factorise(normal):
        return False, solved
    halve(normal, cross)
    strength = paint[0] ** 2 + paint[1] ** 2 + paint[2] ** 2
    free = np.empty(BAND + 3)
    for k in range(BAND):
        for q in range(BAND + 3):
            free[q] = shared[k, q]
            for a in range(REST):
                free[q] -= cross[a, k] * cross[a, q]
        for c in range(3):
            shading[k, 0] += free[BAND + c] * paint[c]
        for q in range(BAND):
            band[k, q] = strength * free[q]
        band[k, k] += shading_prior[k]
    factor[:] = band
    if not factorise(factor):
        return False, solved
    halve(factor, shading)
    finish(factor, shading)
    for a in range(REST):
        light = 0.0
        for k in range(BAND):
            light += cross[a, k] * shading[k, 0]
        for c in range(3):
            rest[a, c] = cross[a, BAND + c] - light * paint[c]
    finish(normal, rest)
    return True, solved


@njit(fastmath=REORDERED)
def step_equations(pixels: Any, rows: Any, good: Any, paint: Any, colours: Any) -> Any:
    """Set up the step in n, e, width and length: `StepEquations`.

    Args:
        pixels: see `solve_colours`.
        rows: likewise.
        good: likewise.
        paint: likewise.
        colours: solved at this place.
    """
    sums = move_sums(pixels, rows, good, paint, colours.shading, colours.rest)
    crosses, halved = sums.cross, colours.halved
    halve(colours.factor, crosses)
    information = np.empty((MOVES + BAND, MOVES + BAND))
    for p in range(MOVES):
        for q in range(MOVES + BAND):
            information[p, q] = sums.moves[p, q]
    for k in range(BAND):
        for q in range(BAND):
            information[MOVES + k, MOVES + q] = colours.band[k, q]
    for a in range(REST):
        for p in range(MOVES):
            painted = 0.0
            for c in range(3):
                x = crosses[a, 3 * p + c]
                painted += paint[c] * x
                for q in range(MOVES):
                    information[p, q] -= x * crosses[a, 3 * q + c]
            for k in range(BAND):
                information[p, MOVES + k] -= painted * halved[a, k]
    for p in range(MOVES):
        for q in range(MOVES, MOVES + BAND):
            information[q, p] = information[p, q]
    return StepEquations(information, sums.right, sums.squares)


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
def colour_sums(pixels: Any, rows: Any, good: Any, normal: Any) -> Any:
    """Add up what is needed to solve for the colours.

    Args:
        pixels: see `solve_colours`.
        rows: likewise.
        good: likewise.
        normal: in and out, lower triangle of the rest's normal matrix, (REST, REST).

    Returns:
        Rest with band and colours, (REST, BAND + 3), and band with band and colours,
        (BAND, BAND + 3).
    """
    colours, first, weights = pixels.colours, pixels.first, pixels.weights
    cross, shared = np.zeros((REST, BAND + 3)), np.zeros((BAND, BAND + 3))
    right, ground = np.empty(BAND + 3), np.empty(4)
    for i in range(colours.shape[0]):
        if not good[i]:
            continue
        if not rows.seen[i]:
            _ground_only(first[i], weights[i], colours[i], normal, cross)
            continue
        row = rows.values[i, 0]
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
    return cross, shared


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
def move_sums(pixels: Any, rows: Any, good: Any, paint: Any, shading: Any, rest: Any) -> Any:
    """Residuals, and what is needed to solve for the position: `MoveSums`.

    Args:
        pixels: see `solve_colours`.
        rows: likewise.
        good: likewise.
        paint: likewise.
        shading: see `SolvedColours`.
        rest: likewise.
    """
    colours, first, weights = pixels.colours, pixels.first, pixels.weights
    slope, ground, residual = np.empty(3 * MOVES), np.empty(3), np.empty(3)
    squares, cross = np.empty(colours.shape[0]), np.zeros((REST, 3 * MOVES))
    moves, right = np.zeros((MOVES, MOVES + BAND)), np.zeros(MOVES)
    for i in range(colours.shape[0]):
        _colour_behind(first[i], weights[i], rest, ground)
        row, low, high, free = rows.values[i, 0], BAND, BAND, 1.0
        if rows.seen[i]:
            low, high = _shafts(row)
            free = _free(row, low, high)
            _model(row, low, high, free, shading, paint, rest, ground, residual)
        else:
            residual[:] = ground
        squares[i] = 0.0
        for c in range(3):
            residual[c] = colours[i, c] - residual[c]
            squares[i] += residual[c] * residual[c] / 3.0
        if not rows.seen[i] or not good[i] or (row[0] == 0.0 and free > 0.9999):
            continue
        for m in range(MOVES):
            change = rows.values[i, 1 + m]
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
    return MoveSums(squares, cross, moves, right)


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


@njit(fastmath=REORDERED)
def factorise(matrix: Any) -> bool:
    """Replace the lower triangle by Cholesky's factor; False if it is not positive definite."""
    size = matrix.shape[0]
    column = np.empty(size)
    for j in range(size):
        if not matrix[j, j] > 0.0:
            return False
        matrix[j, j] = np.sqrt(matrix[j, j])
        for i in range(j + 1, size):
            x = matrix[i, j] / matrix[j, j]
            matrix[i, j] = column[i] = x
            if x != 0.0:
                for k in range(j + 1, i + 1):
                    matrix[i, k] -= x * column[k]
    return True


@njit(fastmath=REORDERED)
def halve(factor: Any, right: Any) -> None:
    """Replace B, (size, n), by L⁻¹ B: products of two such are those with the inverse between."""
    size, count = right.shape
    for i in range(size):
        for k in range(i):
            x = factor[i, k]
            if x != 0.0:
                for c in range(count):
                    right[i, c] -= x * right[k, c]
        for c in range(count):
            right[i, c] /= factor[i, i]


@njit(fastmath=REORDERED)
def finish(factor: Any, right: Any) -> None:
    """Replace L⁻¹ B by (L Lᵀ)⁻¹ B."""
    size, count = right.shape
    for i in range(size - 1, -1, -1):
        for k in range(i + 1, size):
            x = factor[k, i]
            if x != 0.0:
                for c in range(count):
                    right[i, c] -= x * right[k, c]
        for c in range(count):
            right[i, c] /= factor[i, i]
