"""Fit of the band in a picture as a camera delivers it: iteration, noise and covariance.

Besides position, width and length the fit has the blur across and along the needle and the tone
curve for unknowns; the noise is that of what is left, brightness and colour apart, and correlated
as that is. Derivation: docs/band-fit.md.
"""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

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
    factorise_colours,
    finish_colours,
    halve_colours,
    linearise,
    move_rows,
    no_moves,
    normal_equations,
    solve_colours_alone,
    sparse_rows,
)
from app.tracking.band.equations import factorise, finish, halve
from app.tracking.band.left_over import FAR_OFF, noise_left, place_covariance
from app.tracking.band.model import BAND, COLUMNS, Rows, design
from app.tracking.band.pixels import CURVE, SIDE, gather

STEPS: Final = 6
_DONE_PX: Final = 0.03
_NEAR_PX: Final = 0.3
_LEAST_STEPS: Final = 2
_FARTHEST_PX: Final = 8.0
_STRETCHED: Final = 0.5
_MARGIN: Final = 4
"""What is looked at round the fit's pixels for the colours' resolution [px]."""

_GAMMA_SD, _GAMMA_LOW, _GAMMA_HIGH = 0.02, 0.85, 3.2
_BLUR_SD: Final = 0.5
_BLUR_LOW: Final = 0.35
_BLUR_HIGH: Final = 2.2
MATT = np.array([10.0, 1.0, 1.0, 0.15, 0.15, 0.03, 0.03, 0.02])
GLOSSY = np.array([10.0, 1.0, 1.0, 0.3, 0.3, 0.1, 0.1, 0.1])
"""Shading of a matt and of a shiny band: standard deviations of the harmonics relative to the
paint; the last is the share of the brightest colour that every colour may have besides."""
_STIFF: Final = 2.0
_SOFT: Final = 25.0


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
    """Take what is compared: `Observed`, columns and rows of a group, places of pixels (2, m)."""
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
    colour, kept = np.empty((count, 2)), np.empty((count, 4), np.int64)
    at = 0
    for b in range(rows * columns):
        if filled[b] == du * dv:
            kept[at] = members[b]
            colour[at, 0], colour[at, 1] = (
                values[0, b // columns, b % columns],
                values[1, b // columns, b % columns],
            )
            at += 1
    places = np.empty((2, m), np.int64)
    places[0], places[1] = us, vs
    return Observed(level, colour, kept), (du, dv), places


@njit
def keeps_all_colour(image: Any, u: float, v: float, half: int) -> bool:
    """Return whether the colour differences about a pixel have the picture's own resolution."""
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


class Solved(NamedTuple):
    """What a step works with: the model about the last one's place, and its equations."""

    rows: Rows
    sparse: Sparse
    tone: Linearised
    good: NDArray[np.bool_]
    """Which pixels' brightness counts, (m,)."""
    kept: NDArray[np.bool_]
    """Which groups' colour counts, (b,)."""
    weights: FloatArray
    """Inverse variances of the planes, (3,)."""
    paint: FloatArray
    """Mean light of the band, (3,)."""
    normal: FloatArray
    """Cholesky's factor of the colours' normal matrix, (SIZE, SIZE)."""
    first: NDArray[np.int64]
    """Its rows' first column that may differ from zero, (SIZE,)."""
    colours: FloatArray
    """(SIZE,)."""
    cross: FloatArray
    """(SIZE, MOVES)."""
    inverse: FloatArray
    """Of the moves' information, (MOVES, MOVES)."""
    step: FloatArray
    """(MOVES,)."""


@njit
def _no_solution(pixels: Any, observed: Any) -> Any:
    """Return `Solved` to fill."""
    m, b = len(observed.luma), len(observed.chroma)
    good, kept = pixels.usable.copy(), np.ones(b, np.bool_)
    _keep_groups(observed, good, kept)
    return Solved(
        Rows(np.empty((m, MOVES, COLUMNS)), np.zeros(m, np.bool_)),
        Sparse(np.zeros(m, np.int64), np.zeros((m, MOST), np.int64), np.zeros((m, MOST))),
        Linearised(np.zeros((m, 3)), np.zeros((m, 3)), np.zeros((m, 3)), np.zeros((m, 3))),
        good,
        kept,
        np.empty(3),
        np.zeros(3),
        np.empty((SIZE, SIZE)),
        np.empty(SIZE, np.int64),
        np.empty(SIZE),
        np.empty((SIZE, MOVES)),
        np.empty((MOVES, MOVES)),
        np.zeros(MOVES),
    )


@njit
def _solve(
    pixels: Any,
    observed: Any,
    sigma: Any,
    levels: Any,
    gamma: float,
    shading: Any,
    off: Any,
    prior: Any,
    solved: Any,
    moved: Any,
) -> bool:
    """Solve for the colours, and for the step of the moves.

    Args:
        pixels: `BandPixels`.
        observed: `Observed`.
        sigma: noise of brightness and colour [grey levels], (2,).
        levels: of the pixels, about which the tone curve is taken, (m, 3).
        gamma: of the tone curve.
        shading: see `MATT`.
        off: the moves from what is known of them beforehand, (MOVES,).
        prior: information of that, (MOVES,).
        solved: in and out; the rows are filled already.
        moved: out.
    """
    tone, sparse, normal, cross = solved.tone, solved.sparse, solved.normal, solved.cross
    good, kept, weights, colours = solved.good, solved.kept, solved.weights, solved.colours
    sparse_rows(pixels, solved.rows, sparse)
    linearise(levels, gamma, tone)
    if not _paint(solved.rows, good, tone, solved.paint):
        return False
    ground = np.empty((2, 3))
    _ground_slopes(pixels, solved.rows, tone, ground)
    weights[0], weights[1], weights[2] = sigma[0] ** -2, sigma[1] ** -2, sigma[1] ** -2
    normal[:], colours[:] = 0.0, 0.0
    _prior(pixels.uneven, ground, solved.paint, sigma[0], shading, normal)
    normal_equations(observed, sparse, tone, good, kept, weights, normal, colours)
    if not factorise_colours(normal, solved.first):
        return False
    solve_colours_alone(normal, solved.first, colours)
    by_unknown = colours.reshape((UNKNOWNS, COLOURS))
    move_rows(pixels, observed, solved.rows, sparse, tone, by_unknown, moved)
    information, gradient = np.zeros((MOVES, MOVES)), np.zeros(MOVES)
    cross[:] = 0.0
    cross_equations(
        observed, sparse, tone, good, kept, weights, moved, cross, information, gradient
    )
    halve_colours(normal, solved.first, cross)
    for a in range(SIZE):
        for p in range(MOVES):
            for q in range(MOVES):
                information[p, q] -= cross[a, p] * cross[a, q]
    solved.inverse[:] = 0.0
    for p in range(MOVES):
        information[p, p] += prior[p] + 1e-9
        gradient[p] -= prior[p] * off[p]
        solved.inverse[p, p] = 1.0
    if not factorise(information):
        return False
    halve(information, solved.inverse)
    finish(information, solved.inverse)
    solved.step[:] = solved.inverse @ gradient
    return True


class FitPlace(NamedTuple):
    """What the moves have come to."""

    shift: FloatArray
    stretch: FloatArray
    blur: FloatArray
    gamma: FloatArray
    """(1,)."""


@njit
def _advance(outline: Any, place: Any, step: Any) -> float:
    """Go the step, or as much of it as may be at once: the share; NaN where it leads too far."""
    far = max(abs(step[0]), abs(step[1]))
    scale = min(1.0, 2.0 / max(far, 1e-9))
    scale = min(scale, 0.7 / max(abs(step[6]), 1e-9))
    scale = min(scale, 0.15 / max(max(abs(step[2]), abs(step[3])), 1e-9))
    scale = min(scale, 0.5 / max(max(abs(step[4]), abs(step[5])), 1e-9))
    shift, stretch, blur = place.shift, place.stretch, place.blur
    # by n and e of the pixel: the band goes the other way
    shift[0] += scale * (outline.ev * step[0] - outline.eu * step[1])
    shift[1] += scale * (-outline.eu * step[0] - outline.ev * step[1])
    for k in range(2):
        stretch[k] += scale * step[2 + k]
        blur[k] = min(_BLUR_HIGH, max(_BLUR_LOW, blur[k] + scale * step[4 + k]))
    place.gamma[0] = min(_GAMMA_HIGH, max(_GAMMA_LOW, place.gamma[0] + scale * step[6]))
    farthest = max(abs(shift[0]), abs(shift[1]))
    stretched = max(abs(stretch[0] - 1.0), abs(stretch[1] - 1.0))
    return scale if farthest < _FARTHEST_PX and stretched < _STRETCHED else np.nan


@njit(fastmath=REORDERED)
def _level_up(moved: Any, step: Any, scale: float, levels: Any) -> None:
    """Fill the grey levels that the model has after a step."""
    for i in range(levels.shape[0]):
        for c in range(COLOURS):
            levels[i, c] = moved.levels[i, c]
        for p in range(MOVES):
            x = scale * step[p]
            for c in range(COLOURS):
                levels[i, c] += x * moved.changes[i, p, c]


@njit
def _leave_out(observed: Any, usable: Any, moved: Any, sigma: Any, good: Any, stored: Any) -> None:
    """Mark the pixels and groups that fit."""
    for i in range(len(good)):
        good[i] = usable[i] and abs(moved.luma_left[i]) < FAR_OFF * sigma[0]
    _keep_groups(observed, usable, stored)
    for k in range(len(stored)):
        worst = max(abs(moved.chroma_left[k, 0]), abs(moved.chroma_left[k, 1]))
        stored[k] = stored[k] and worst < FAR_OFF * sigma[1]


@njit
def _keep_groups(observed: Any, usable: Any, stored: Any) -> None:
    for k in range(len(stored)):
        stored[k] = True
        for j in range(4):
            i = observed.members[k, j]
            if i >= 0 and not usable[i]:
                stored[k] = False


@njit
def _leave_out_hidden(hidden: Any, places: Any, usable: Any) -> Any:
    """Mark what is hidden as not usable; return where nothing stands before the scene, (m,)."""
    open_to_view = np.ones(len(usable), np.bool_)
    if hidden.size:
        for i in range(len(usable)):
            open_to_view[i] = not hidden[places[1, i], places[0, i]]
            usable[i] = usable[i] and open_to_view[i]
    return open_to_view


@njit
def _about_band(rows: Any, good: Any, open_to_view: Any, moved: Any, colour: Any) -> Any:
    """Fill the band's mean colour; return its mean square residual, what is left out, its area.

    All of these are of what is `open_to_view`, (m,).
    """
    area, kept, total, number = 0.0, 0.0, 0.0, 0.0
    colour[:] = 0.0
    for i in range(len(good)):
        if not rows.seen[i] or not open_to_view[i]:
            continue
        share = rows.values[i, 0, 0]
        area += share
        if good[i]:
            kept += share
            total += share * moved.luma_left[i] ** 2
        if share > 0.7:
            number += 1.0
            for c in range(COLOURS):
                colour[c] += moved.levels[i, c]
    colour /= max(number, 1.0)
    return total / max(kept, 1e-9), 1.0 - kept / max(area, 1e-9), area, kept > 8.0


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
    hidden: Any,
) -> Any:
    """Fit the band near its outline in a delivered picture: whether there is one, and the minimum.

    Args:
        image: uint8 (H, W, 3).
        outline: a `band.outline.Outline`.
        shape: a `rig.NeedleShape`.
        blur0: standard deviation of the point spread in a still, sharp picture [px].
        noise0: standard deviation of a grey value, about.
        stretch_prior: inverse variance of width and length, relative.
        gamma0: of the tone curve, about.
        shading: `MATT` or `GLOSSY`.
        hidden: where something stands before needle and background, bool (H, W); (0, 0) for
            nowhere.
    """
    pixels = gather(image, outline, blur0, noise0)
    levels = pixels.colours * noise0
    observed, size, places = observe(image, outline, pixels)
    open_to_view = _leave_out_hidden(hidden, places, pixels.usable)
    m = len(observed.luma)
    place = FitPlace(np.zeros(2), np.ones(2), np.array([blur0, blur0]), np.array([gamma0]))
    covariance, colour, sigma = np.zeros((2, 2)), np.zeros(3), np.array([noise0, noise0])
    solved, moved = _no_solution(pixels, observed), no_moves(m, len(observed.chroma))
    prior, off, steps, enough = np.zeros(MOVES), np.zeros(MOVES), 0, m >= 40
    prior[2:4], prior[4:6], prior[6] = stretch_prior, _BLUR_SD**-2, _GAMMA_SD**-2
    while enough and steps < STEPS:
        steps += 1
        across, along = place.blur
        design(
            pixels.places, outline, shape, across, place.shift, place.stretch, solved.rows, along
        )
        off[2:4], off[4:6], off[6] = (
            place.stretch - 1.0,
            place.blur - blur0,
            place.gamma[0] - gamma0,
        )
        enough = _solve(
            pixels, observed, sigma, levels, place.gamma[0], shading, off, prior, solved, moved
        )
        if not enough:
            break
        step = solved.step
        scale = _advance(outline, place, step)
        enough = scale > 0.0
        _level_up(moved, step, scale, levels)
        sigma[0], sigma[1] = noise_left(observed, solved.rows, pixels.usable, moved)
        far = max(abs(step[0]), abs(step[1]))
        if far < _DONE_PX and abs(step[6]) < 0.1 and steps >= _LEAST_STEPS:
            break
        if far < _NEAR_PX and steps < STEPS:
            _leave_out(observed, pixels.usable, moved, sigma, solved.good, solved.kept)
    misfit, outliers, area = 0.0, 0.0, 0.0
    if enough:
        finish_colours(solved.normal, solved.first, solved.cross)
        turn = np.array([[outline.ev, -outline.eu], [-outline.eu, -outline.ev]])
        place_covariance(observed, places, size, solved.cross, solved, moved, prior, covariance)
        covariance = turn @ covariance @ turn.T
        misfit, outliers, area, enough = _about_band(
            solved.rows, solved.good, open_to_view, moved, colour
        )
    return enough, DeliveredMinimum(
        place.shift,
        covariance,
        place.stretch,
        colour,
        place.blur,
        place.gamma[0],
        sigma,
        misfit,
        outliers,
        area,
        steps,
        np.array([m, len(observed.chroma), size[0], size[1]], np.float64),
    )
