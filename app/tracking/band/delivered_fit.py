"""Fit of the band in a picture as a camera delivers it: iteration, noise and covariance.

Besides position, width and length the fit has the blur across and along the needle and the tone
curve for unknowns; the noise is that of what is left, brightness and colour apart, and correlated
as that is. Derivation: docs/band-fit.md.
"""

from typing import Any, Final, NamedTuple

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import REORDERED, njit
from app.tracking.band.chroma import FULL, filled_in, luma_chroma, true_chroma
from app.tracking.band.delivered import (
    COLOURS,
    GROUND,
    MOST,
    MOVES,
    SIZE,
    UNKNOWNS,
    Linearised,
    Observed,
    Sparse,
    cross_equations,
    factorise_skyline,
    linearise,
    move_rows,
    no_moves,
    normal_equations,
    projected,
    sparse_rows,
)
from app.tracking.band.equations import factorise, finish, halve
from app.tracking.band.model import BAND, COLUMNS, Rows, design
from app.tracking.band.pixels import CURVE, SIDE, gather

STEPS: Final = 6
_DONE_PX: Final = 0.02
_NEAR_PX: Final = 0.3
_FARTHEST_PX: Final = 8.0
_MARGIN: Final = 4
"""What is looked at round the fit's pixels for the colours' resolution [px]."""

_LEAST: Final = 0.5
"""Least standard deviation of brightness or colour [grey levels]: they are whole numbers."""

_GAMMA_SD, _GAMMA_LOW, _GAMMA_HIGH = 0.02, 0.85, 3.2
_BLUR_SD: Final = 0.5
_BLUR_LOW: Final = 0.35
_BLUR_HIGH: Final = 2.2
MATT = np.array([10.0, 1.0, 1.0, 0.15, 0.15, 0.03, 0.03, 0.02])
GLOSSY = np.array([10.0, 1.0, 1.0, 0.3, 0.3, 0.1, 0.1, 0.1])
"""Shading of a matt and of a shiny band: standard deviations of the harmonics relative to the
paint; the last is the share of the brightest colour that every colour may have besides."""
_LAG: Final = 3
"""How far what is left is taken to be alike [px, or groups]."""

_STIFF: Final = 2.0
_SOFT: Final = 25.0
_FAR_OFF: Final = 4.0
"""Standard deviations from which a pixel is left out."""

CHROMA_MORE: Final = 2.0
"""Colour counts for this much less: its quantisation is alike over whole blocks."""


class DeliveredMinimum(NamedTuple):
    """Where the least squares' minimum is."""

    shift: FloatArray
    covariance: FloatArray
    stretch: FloatArray
    paint: FloatArray
    blur: FloatArray
    gamma: float
    noise: FloatArray
    """Standard deviation of brightness and colour [grey levels], (2,)."""
    misfit: float
    outliers: float
    area: float
    steps: int
    sizes: FloatArray
    """Pixels, groups, and columns and rows of a group, (4,)."""


@njit
def observe(image: Any, outline: Any, pixels: Any) -> Any:
    """Take brightness and colour differences of the pixels: `Observed`, and sizes of a group."""
    m = pixels.places.shape[0]
    left, top = 1 << 30, 1 << 30
    right, bottom = -1, -1
    us, vs = np.empty(m, np.int64), np.empty(m, np.int64)
    for i in range(m):
        us[i] = round(outline.u + pixels.places[i, 0])
        vs[i] = round(outline.v + pixels.places[i, 1])
        left, top = min(left, us[i]), min(top, vs[i])
        right, bottom = max(right, us[i] + 1), max(bottom, vs[i] + 1)
    left, top = max(0, left - _MARGIN), max(0, top - _MARGIN)
    right, bottom = min(image.shape[1], right + _MARGIN), min(image.shape[0], bottom + _MARGIN)
    luma, chroma = luma_chroma(image, left, top, right, bottom)
    values, u0, v0, du, dv = true_chroma(chroma, left, top)
    rows, columns = values.shape[1], values.shape[2]
    members = np.full((rows * columns, 4), -1, np.int64)
    filled = np.zeros(rows * columns, np.int64)
    level = np.empty(m)
    for i in range(m):
        level[i] = luma[vs[i] - top, us[i] - left]
        x, y = us[i] - left - u0, vs[i] - top - v0
        if x >= 0 and y >= 0 and x // du < columns and y // dv < rows:
            b = (y // dv) * columns + x // du
            if filled[b] < 4:
                members[b, filled[b]] = i
                filled[b] += 1
    count = 0
    for b in range(rows * columns):
        count += filled[b] == du * dv
    colour, kept, group = np.empty((count, 2)), np.empty((count, 4), np.int64), np.full(m, -1)
    at = 0
    for b in range(rows * columns):
        if filled[b] == du * dv:
            kept[at] = members[b]
            colour[at, 0], colour[at, 1] = (
                values[0, b // columns, b % columns],
                values[1, b // columns, b % columns],
            )
            for k in range(filled[b]):
                group[members[b, k]] = at
            at += 1
    return Observed(level, colour, kept, group), du, dv, us, vs


@njit
def keeps_all_colour(image: Any, u: float, v: float, half: int) -> bool:
    """Whether the colour differences about a pixel have the picture's own resolution."""
    left, top = max(0, round(u) - half), max(0, round(v) - half)
    right, bottom = min(image.shape[1], round(u) + half), min(image.shape[0], round(v) + half)
    if right - left < 8 or bottom - top < 8:
        return True
    _, chroma = luma_chroma(image, left, top, right, bottom)
    across = filled_in(chroma[1], left)
    return across == FULL and filled_in(np.ascontiguousarray(chroma[1].T), top) == FULL


@njit
def _prior(uneven: Any, ground: Any, paint: Any, noise: float, shading: Any, normal: Any) -> None:
    """Add what is known of the colours beforehand; `ground` are slopes of the tone, (2, 3)."""
    for a in range(SIZE):
        normal[a, a] += 0.05
    for side in range(2):
        for c in range(COLOURS):
            sd = (_SOFT if uneven[side] else _STIFF) * noise / ground[side, c]
            w = 1.0 / (sd * sd)
            for k in range(CURVE - 2):
                first = side * CURVE + k
                for p in range(3):
                    for q in range(p + 1):
                        x = (-2.0 if p == 1 else 1.0) * (-2.0 if q == 1 else 1.0)
                        normal[COLOURS * (first + p) + c, COLOURS * (first + q) + c] += w * x
    brightest = max(paint[0], max(paint[1], paint[2]))
    for k in range(BAND):
        for c in range(COLOURS):
            at = COLOURS * (GROUND + COLUMNS - BAND + k) + c
            sd = shading[k] * (paint[c] + shading[BAND] * brightest)
            normal[at, at] += 1.0 / (sd * sd)


@njit
def _ground_slopes(pixels: Any, rows: Any, tone: Any, out: Any) -> None:
    out[:] = 0.0
    count = np.zeros(2)
    for i in range(len(rows.seen)):
        if not rows.seen[i]:
            side = 1 if pixels.first[i] >= SIDE else 0
            count[side] += 1
            for c in range(COLOURS):
                out[side, c] += tone.slope[i, c]
    for side in range(2):
        for c in range(COLOURS):
            out[side, c] = max(out[side, c] / max(count[side], 1.0), 1.0) if count[side] else 255.0


@njit
def _design(
    pixels: Any,
    outline: Any,
    shape: Any,
    shift: Any,
    stretch: Any,
    blur: Any,
    rows: Any,
    other: Any,
) -> None:
    """Fill the rows with all derivatives; those by the blur are differences."""
    design(pixels.places, outline, shape, blur[0], shift, stretch, rows, blur[1])
    for axis in range(2):
        step = 0.02
        across = blur[0] + (step if axis == 0 else 0.0)
        along = blur[1] + (step if axis == 1 else 0.0)
        design(pixels.places, outline, shape, across, shift, stretch, other, along)
        for i in range(len(rows.seen)):
            if rows.seen[i]:
                for k in range(COLUMNS):
                    x = other.values[i, 0, k] if other.seen[i] else 0.0
                    rows.values[i, 5 + axis, k] = (x - rows.values[i, 0, k]) / step


@njit
def _paint(rows: Any, good: Any, tone: Any, paint: Any) -> bool:
    for least in (0.97, 0.85, 0.7):
        count = 0
        paint[:] = 0.0
        for i in range(len(good)):
            if rows.seen[i] and good[i] and rows.values[i, 0, 0] > least:
                count += 1
                for c in range(COLOURS):
                    paint[c] += tone.light[i, c]
        if count >= 6:
            for c in range(COLOURS):
                paint[c] /= count
            return True
    return False


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
def _noise(observed: Any, rows: Any, usable: Any, moved: Any) -> Any:
    """Return the noise of brightness and of colour near the needle, gross errors cut off."""
    typical = max(_LEAST, _deviation(moved.luma_left, rows.seen & usable))
    square, count = 0.0, 0
    for i in range(len(usable)):
        if rows.seen[i] and usable[i]:
            square += min(moved.luma_left[i] ** 2, (_FAR_OFF * typical) ** 2)
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
            square += min(left[k] ** 2, (_FAR_OFF * typical) ** 2)
            count += 1
    return luma, max(_LEAST, CHROMA_MORE * np.sqrt(square / max(count, 1)))


@njit
def fit_delivered(
    image: Any,
    outline: Any,
    shape: Any,
    blur0: float,
    noise0: float,
    stretch_prior: float,
    gamma0: float,
    shading: Any,
) -> Any:
    """Fit the band near its outline in a delivered picture."""
    pixels = gather(image, outline, blur0, max(1.0, noise0))
    noise0 = max(1.0, noise0)
    levels = pixels.colours * noise0
    observed, du, dv, us, vs = observe(image, outline, pixels)
    m, b = len(observed.luma), len(observed.chroma)
    shift, stretch, blur, gamma = np.zeros(2), np.ones(2), np.array([blur0, blur0]), gamma0
    covariance, paint, sigma = np.zeros((2, 2)), np.zeros(3), np.array([noise0, noise0])
    sizes = np.array([float(m), float(b), float(du), float(dv)])
    nothing = DeliveredMinimum(
        shift, covariance, stretch, paint, blur, gamma, sigma, 0.0, 0.0, 0.0, 0, sizes
    )
    if m < 40:
        return False, nothing
    rows = Rows(np.zeros((m, MOVES, COLUMNS)), np.zeros(m, np.bool_))
    other = Rows(np.zeros((m, MOVES, COLUMNS)), np.zeros(m, np.bool_))
    sparse = Sparse(np.zeros(m, np.int64), np.zeros((m, MOST), np.int64), np.zeros((m, MOST)))
    tone = Linearised(np.zeros((m, 3)), np.zeros((m, 3)), np.zeros((m, 3)), np.zeros((m, 3)))
    moved = no_moves(m, b)
    good, kept = pixels.usable.copy(), np.ones(b, np.bool_)
    _keep_groups(observed, good, kept)
    normal, right = np.empty((SIZE, SIZE)), np.empty((SIZE, 1))
    cross, information, gradient = (
        np.empty((SIZE, MOVES)),
        np.empty((MOVES, MOVES)),
        np.empty((MOVES, 1)),
    )
    inverse, ground, weights = np.empty((MOVES, MOVES)), np.empty((2, 3)), np.empty(3)
    prior, skyline = np.zeros(MOVES), np.empty(SIZE, np.int64)
    prior[2], prior[3] = stretch_prior, stretch_prior
    prior[4], prior[5] = 1.0 / _BLUR_SD**2, 1.0 / _BLUR_SD**2
    prior[6] = 1.0 / _GAMMA_SD**2
    at, step = np.zeros(MOVES), np.zeros(MOVES)
    steps = 0
    for attempt in range(STEPS):
        steps = attempt + 1
        _design(pixels, outline, shape, shift, stretch, blur, rows, other)
        sparse_rows(pixels, rows, sparse)
        linearise(levels, gamma, tone)
        if not _paint(rows, good, tone, paint):
            return False, nothing
        _ground_slopes(pixels, rows, tone, ground)
        weights[0], weights[1] = 1.0 / sigma[0] ** 2, 1.0 / sigma[1] ** 2
        weights[2] = weights[1]
        normal[:], right[:] = 0.0, 0.0
        _prior(pixels.uneven, ground, paint, sigma[0], shading, normal)
        normal_equations(observed, sparse, tone, good, kept, weights, normal, right[:, 0])
        if not factorise_skyline(normal, skyline):
            return False, nothing
        halve(normal, right)
        finish(normal, right)
        colours = right.copy().reshape((UNKNOWNS, COLOURS))
        move_rows(pixels, observed, rows, sparse, tone, colours, moved)
        cross[:], information[:], gradient[:] = 0.0, 0.0, 0.0
        cross_equations(
            observed, sparse, tone, good, kept, weights, moved, cross, information, gradient[:, 0]
        )
        halve(normal, cross)
        at[2], at[3] = stretch[0] - 1.0, stretch[1] - 1.0
        at[4], at[5], at[6] = blur[0] - blur0, blur[1] - blur0, gamma - gamma0
        for p in range(MOVES):
            for q in range(MOVES):
                for a in range(SIZE):
                    information[p, q] -= cross[a, p] * cross[a, q]
            information[p, p] += prior[p] + 1e-9
            gradient[p, 0] -= prior[p] * at[p]
        inverse[:] = 0.0
        for p in range(MOVES):
            inverse[p, p] = 1.0
        if not factorise(information):
            return False, nothing
        halve(information, inverse)
        finish(information, inverse)
        for p in range(MOVES):
            step[p] = 0.0
            for q in range(MOVES):
                step[p] += inverse[p, q] * gradient[q, 0]
        far = max(abs(step[0]), abs(step[1]))
        scale = min(1.0, 2.0 / max(far, 1e-9))
        scale = min(scale, 0.7 / max(abs(step[6]), 1e-9))
        scale = min(scale, 0.15 / max(max(abs(step[2]), abs(step[3])), 1e-9))
        scale = min(scale, 0.5 / max(max(abs(step[4]), abs(step[5])), 1e-9))
        # by n and e of the pixel: the band goes the other way
        shift[0] += scale * (outline.ev * step[0] - outline.eu * step[1])
        shift[1] += scale * (-outline.eu * step[0] - outline.ev * step[1])
        for k in range(2):
            stretch[k] += scale * step[2 + k]
            blur[k] = min(_BLUR_HIGH, max(_BLUR_LOW, blur[k] + scale * step[4 + k]))
        gamma = min(_GAMMA_HIGH, max(_GAMMA_LOW, gamma + scale * step[6]))
        if not (
            max(abs(shift[0]), abs(shift[1])) < _FARTHEST_PX
            and max(abs(stretch[0] - 1.0), abs(stretch[1] - 1.0)) < 0.5
        ):
            return False, nothing
        for i in range(m):
            for c in range(COLOURS):
                level = moved.levels[i, c]
                for p in range(MOVES):
                    level += scale * moved.changes[i, p, c] * step[p]
                levels[i, c] = level
        both = np.abs(moved.chroma_left)
        sigma[0], sigma[1] = _noise(observed, rows, pixels.usable, moved)
        if far < _DONE_PX and abs(step[6]) < 0.1 and attempt > 1:
            break
        if far < _NEAR_PX:
            for i in range(m):
                good[i] = pixels.usable[i] and abs(moved.luma_left[i]) < _FAR_OFF * sigma[0]
            _keep_groups(observed, pixels.usable, kept)
            for k in range(b):
                worst = max(both[k, 0], both[k, 1])
                kept[k] = kept[k] and worst < _FAR_OFF * sigma[1]
    finish(normal, cross)
    _sandwich(
        observed,
        sparse,
        tone,
        good,
        kept,
        cross,
        moved,
        weights,
        prior,
        inverse,
        us,
        vs,
        du,
        dv,
        outline,
        covariance,
    )
    area, kept_area, total, count = 0.0, 0.0, 0.0, 0.0
    for i in range(m):
        if rows.seen[i]:
            share = rows.values[i, 0, 0]
            area += share
            if good[i]:
                kept_area += share
                total += share * moved.luma_left[i] ** 2
                count += share
    colour = np.zeros(3)
    number = 0.0
    for i in range(m):
        if rows.seen[i] and rows.values[i, 0, 0] > 0.7:
            number += 1.0
            for c in range(COLOURS):
                colour[c] += moved.levels[i, c]
    colour /= max(number, 1.0)
    return count > 8.0, DeliveredMinimum(
        shift,
        covariance,
        stretch,
        colour,
        blur,
        gamma,
        sigma,
        total / max(count, 1e-9),
        1.0 - kept_area / max(area, 1e-9),
        area,
        steps,
        sizes,
    )


@njit
def _keep_groups(observed: Any, usable: Any, kept: Any) -> None:
    for k in range(len(kept)):
        kept[k] = True
        for j in range(4):
            i = observed.members[k, j]
            if i >= 0 and not usable[i]:
                kept[k] = False


@njit(fastmath=REORDERED)
def _sandwich(
    observed: Any,
    sparse: Any,
    tone: Any,
    good: Any,
    kept: Any,
    taken: Any,
    moved: Any,
    weights: Any,
    prior: Any,
    inverse: Any,
    us: Any,
    vs: Any,
    du: int,
    dv: int,
    outline: Any,
    covariance: Any,
) -> None:
    """Fill the covariance of the band's place with noise as it is correlated in what is left."""
    m, b = len(observed.luma), len(observed.chroma)
    luma, chroma = np.empty((m, MOVES)), np.empty((b, 2, MOVES))
    projected(observed, sparse, tone, taken, moved, luma, chroma)
    middle = np.zeros((MOVES, MOVES))
    for p in range(MOVES):
        middle[p, p] = prior[p]
    pu, pv = np.empty(b, np.int64), np.empty(b, np.int64)
    for k in range(b):
        pu[k], pv[k] = us[observed.members[k, 0]] // du, vs[observed.members[k, 0]] // dv
    _correlated(us, vs, moved.luma_left, luma, good, weights[0], middle)
    for plane in range(2):
        _correlated(
            pu,
            pv,
            np.ascontiguousarray(moved.chroma_left[:, plane]),
            np.ascontiguousarray(chroma[:, plane]),
            kept,
            weights[1 + plane],
            middle,
        )
    whole = inverse @ middle @ inverse
    turn = np.array([[outline.ev, -outline.eu], [-outline.eu, -outline.ev]])
    covariance[:] = turn @ np.ascontiguousarray(whole[:2, :2]) @ turn.T


@njit(fastmath=REORDERED)
def _correlated(
    us: Any, vs: Any, left: Any, by: Any, good: Any, weight: float, middle: Any
) -> None:
    """Add the covariance of the gradient by one plane."""
    n = len(left)
    if n == 0:
        return
    u0, v0 = us.min(), vs.min()
    grid = np.full((vs.max() - v0 + 1, us.max() - u0 + 1), -1, np.int64)
    square, count = 0.0, 0
    for i in range(n):
        if good[i]:
            grid[vs[i] - v0, us[i] - u0] = i
            square += left[i] ** 2
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
    total = np.empty(MOVES)
    for i in range(n):
        if not good[i]:
            continue
        x, y = us[i] - u0, vs[i] - v0
        for k in range(MOVES):
            total[k] = 0.0
        for q in range(max(0, y - _LAG), min(height, y + _LAG + 1)):
            for p in range(max(0, x - _LAG), min(width, x + _LAG + 1)):
                j = grid[q, p]
                if j >= 0:
                    for k in range(MOVES):
                        total[k] += alike[q - y + _LAG, p - x + _LAG] * by[j, k]
        for k in range(MOVES):
            for p in range(MOVES):
                middle[k, p] += weight * weight * by[i, k] * total[p]
