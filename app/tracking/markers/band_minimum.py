"""The least squares of the band's picture, from its pixels to the minimum (compiled).

One step of the fit: solve for the colours, then set up the step in position (compiled).

Solution of a small positive definite system, inside a kernel (compiled).
"""

from typing import Any, Final

import numpy as np

from app.core.compiled import REORDERED, njit
from app.tracking.markers.band_design import BAND, COLUMNS, PARTIALS, design
from app.tracking.markers.band_ground import directions, ground_columns
from app.tracking.markers.band_normal import MOVES, REST, colour_equations, move_equations
from app.tracking.markers.band_pixels import gather


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


_STEPS: Final = 4
_DONE_PX: Final = 0.02
_NEAR_PX: Final = 0.15
"""A step this small ends at the least squares' minimum, to a thousandth of a pixel."""

_FARTHEST_PX: Final = 8.0
_FEW: Final = 0.01
"""Share of pixels that may be left out without another step."""

_OUTLIER: Final = 9.0
"""Mean square residual of a pixel's colours [noise variances] beyond which it does not count."""

_CLEAR: Final = 4.0
"""From the needle's outline to what is background only [standard deviations of the blur]."""

RESULT: Final = 14


@njit
def minimise(
    image: Any,
    box: Any,
    frame: Any,
    arcs: Any,
    shape: Any,
    blur: float,
    noise: float,
    stretch_prior: float,
    priors: Any,
    shading_prior: Any,
    result: Any,
) -> bool:
    """Fit the band near its outline; False if there is nothing to fit.

    Args:
        image: uint8 (H, W, 3).
        box: see `band_pixels.surroundings`.
        frame: see `band_outline.outline`.
        arcs: likewise.
        shape: a `rig.NeedleShape`.
        blur: standard deviation of the point spread [px].
        noise: standard deviation of a grey value.
        stretch_prior: of width and length, inverse square of the relative standard deviation.
        priors: of the rest's colours by whether either side's background has edges,
            (2, 2, REST, REST).
        shading_prior: see `band_step.solve_step`.
        result: out, shift u and v [px], its covariance row by row [px²], width and length over
            the expected, misfit, outliers, area [px²] and paint; see `band_fit.BandFit`.
    """
    height, width = box[3] - box[1], box[2] - box[0]
    if height <= 0 or width <= 0:
        return False
    most = height * width
    pixels, colours, usable = np.empty((most, 2)), np.empty((most, 3)), np.empty(most, np.bool_)
    sides, clear = np.empty(most, np.int64), np.empty((height, width), np.int8)
    m = gather(
        image, box, frame, arcs, _CLEAR * blur, pixels, colours, usable, sides, clear
    )  # fmt: skip
    found, uneven = np.empty((2, 2)), np.empty(2, np.bool_)
    window = image[box[1] : box[3], box[0] : box[2]]
    directions(window, clear, noise, found, uneven)
    pixels, colours, usable = pixels[:m], colours[:m] / noise, usable[:m]
    first, weights = np.zeros(m, np.int64), np.empty((m, 4))
    ground_columns(pixels, sides[:m], found, first, weights)
    prior = priors[int(uneven[0]), int(uneven[1])]
    rows, seen = np.empty((m, PARTIALS, COLUMNS)), np.empty(m, np.bool_)
    squares, good = np.empty(m), usable.copy()
    shift, stretch, change = np.zeros(2), np.ones(2), np.empty(MOVES)
    covariance, paint, gain = np.empty((2, 2)), np.empty(3), 0.0
    for step in range(_STEPS):
        design(pixels, shift, frame, arcs, shape, blur, stretch, rows, seen)
        if not _paint(rows, seen, colours, good, paint):
            return False
        information = np.empty((MOVES + BAND, MOVES + BAND))
        right = np.empty(MOVES)
        if not solve_step(
            rows, seen, first, weights, colours, good, paint, prior.copy(), shading_prior,
            information, right, squares,
        ):  # fmt: skip
            return False
        # derivatives are by n and e of the pixel: the band moved by +u is the pixel moved by -u
        _turn(information, right, frame)
        for k in range(2):
            right[2 + k] -= stretch_prior * (stretch[k] - 1.0)
            information[2 + k, 2 + k] += stretch_prior
        if not _solve(information, right, change, covariance):
            return False
        gain = 0.0
        for k in range(MOVES):
            gain += right[k] * change[k]
        farthest, stretched = 0.0, 0.0
        for k in range(2):
            shift[k] += change[k]
            stretch[k] += change[2 + k]
            farthest = max(farthest, abs(shift[k]))
            stretched = max(stretched, abs(stretch[k] - 1.0))
        if not (farthest < _FARTHEST_PX and stretched < 0.4 and np.isfinite(gain)):
            return False
        moved = max(abs(change[0]), abs(change[1]))
        if moved < _DONE_PX and step > 0:
            break
        if moved < _NEAR_PX:
            before, after = 0, 0
            for i in range(m):
                before += good[i]
                good[i] = usable[i] and squares[i] < _OUTLIER
                after += good[i]
            if step > 0 or after > (1.0 - _FEW) * before:
                break
    result[0], result[1], result[6], result[7] = shift[0], shift[1], stretch[0], stretch[1]
    for k in range(4):
        result[2 + k] = covariance[k // 2, k % 2]
    for c in range(3):
        result[11 + c] = paint[c] * noise
    return _quality(rows, seen, squares, good, gain, result)


@njit
def _paint(rows: Any, seen: Any, colours: Any, good: Any, paint: Any) -> bool:
    """Mean colour of the pixels that the band fills; False if there are hardly any."""
    count = 0
    paint[:] = 0.0
    for i in range(rows.shape[0]):
        if seen[i] and good[i] and rows[i, 0, 0] > 0.97:
            count += 1
            for c in range(3):
                paint[c] += colours[i, c]
    paint /= max(count, 1)
    return count >= 6


@njit
def _turn(information: Any, right: Any, frame: Any) -> None:
    """From moves of the pixel by (n, e) to moves of the band by (u, v), in place."""
    size = information.shape[0]
    x, y = frame[3], frame[2]
    for k in range(size):
        by_n, by_e = information[k, 0], information[k, 1]
        information[k, 0], information[k, 1] = x * by_n - y * by_e, -y * by_n - x * by_e
    for k in range(size):
        by_n, by_e = information[0, k], information[1, k]
        information[0, k], information[1, k] = x * by_n - y * by_e, -y * by_n - x * by_e
    by_n, by_e = right[0], right[1]
    right[0], right[1] = x * by_n - y * by_e, -y * by_n - x * by_e


@njit
def _solve(information: Any, right: Any, change: Any, covariance: Any) -> bool:
    """Step of the moves, and the covariance of the first two; overwrites `information`."""
    size = information.shape[0]
    inverse = np.zeros((size, MOVES))
    for k in range(MOVES):
        inverse[k, k] = 1.0
    if not factorise(information):
        return False
    halve(information, inverse)
    finish(information, inverse)
    for p in range(MOVES):
        change[p] = 0.0
        for q in range(MOVES):
            change[p] += inverse[p, q] * right[q]
    covariance[:] = inverse[:2, :2]
    return True


@njit
def _quality(rows: Any, seen: Any, squares: Any, good: Any, gain: float, result: Any) -> bool:
    """Write misfit, outliers and area; False where too few of the band's pixels count."""
    total, count, area, kept = 0.0, 0, 0.0, 0.0
    for i in range(rows.shape[0]):
        if not seen[i]:
            continue
        share = rows[i, 0, 0]
        area += share
        if good[i]:
            kept += share
            if share > 0.05:
                count += 1
                total += squares[i]
    if count < 20:
        return False
    result[8] = (3.0 * total - gain) / (3.0 * count)  # the last step takes that much off
    result[9], result[10] = 1.0 - kept / area, area
    return True
