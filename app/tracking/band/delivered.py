"""Least squares of the band in a picture as a camera delivers it (compiled).

The light of every pixel is the linear model of `model`; what is compared are brightness at every
pixel and the colour differences at their own resolution, after the tone curve. All colours are so
coupled, and solved for together. Derivation: docs/band-fit.md.
"""

from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.compiled import REORDERED, njit
from app.tracking.band.model import BAND, COLUMNS
from app.tracking.band.pixels import CURVE, SIDE
from app.tracking.band.tone import to_level, to_light

COLOURS: Final = 3
GROUND: Final = 2 * SIDE
UNKNOWNS: Final = COLUMNS + GROUND
SIZE: Final = COLOURS * UNKNOWNS
MOST: Final = COLUMNS + 4
PLANES: Final = 3
_SHAFT0: Final = GROUND
_BAND0: Final = GROUND + COLUMNS - BAND
_WEIGHTS = np.array([[0.114, 0.587, 0.299], [0.5, -0.331264, -0.168736], [-0.081312, -0.418688, 0.5]])
PLANE_WEIGHTS: Final = _WEIGHTS
"""Of blue, green and red in brightness and both colour differences (ITU-T T.871)."""


class Observed(NamedTuple):
    """What is compared: brightness of m pixels, colour differences of b groups of pixels."""

    luma: FloatArray
    """(m,)."""
    chroma: FloatArray
    """(b, 2)."""
    members: NDArray[np.int64]
    """Pixels of every group, -1 for none, (b, 4)."""
    group: NDArray[np.int64]
    """Group of every pixel, -1 for none, (m,)."""


class Sparse(NamedTuple):
    """The columns of every pixel that are not zero, the same for all three colours."""

    count: NDArray[np.int64]
    column: NDArray[np.int64]
    """(m, MOST)."""
    value: FloatArray
    """(m, MOST)."""


@njit(forceinline=True)
def _ground_column(k: int) -> int:
    """Place of the background's column k: the curves first, the slopes after them."""
    side, at = k // SIDE, k % SIDE
    return 2 * CURVE + side if at == CURVE else side * CURVE + at


@njit
def sparse_rows(pixels: Any, rows: Any, out: Any) -> None:
    """Fill the columns of every pixel: ground, shaft and point, band."""
    for i in range(pixels.places.shape[0]):
        n, free = 0, 1.0
        if rows.seen[i]:
            row = rows.values[i, 0]
            free = 1.0 - row[0]
            if row[0] != 0.0:
                for k in range(BAND):
                    out.column[i, n], out.value[i, n] = _BAND0 + k, row[k]
                    n += 1
            for k in range(BAND, COLUMNS):
                if row[k] != 0.0:
                    free -= row[k]
                    out.column[i, n], out.value[i, n] = _SHAFT0 + k - BAND, row[k]
                    n += 1
        if abs(free) > 1e-9:
            start = pixels.first[i]
            last = CURVE + (SIDE if start >= SIDE else 0)
            for p in range(4):
                column = _ground_column(last if p == 3 else start + p)
                out.column[i, n], out.value[i, n] = column, free * pixels.weights[i, p]
                n += 1
        out.count[i] = n


@njit
def derivative(pixels: Any, rows: Any, i: int, partial: int, colours: Any, light: Any) -> None:
    """Fill the change of a pixel's light with a move, (3,).

    Args:
        pixels: `BandPixels`.
        rows: `model.Rows`.
        i: pixel.
        partial: which of the rows' derivatives.
        colours: coefficients, (UNKNOWNS, 3).
        light: out.
    """
    change = rows.values[i, partial]
    gained = -change[0]
    for c in range(COLOURS):
        light[c] = 0.0
    for k in range(BAND):
        for c in range(COLOURS):
            light[c] += change[k] * colours[_BAND0 + k, c]
    for k in range(BAND, COLUMNS):
        if change[k] != 0.0:
            gained -= change[k]
            for c in range(COLOURS):
                light[c] += change[k] * colours[_SHAFT0 + k - BAND, c]
    start = pixels.first[i]
    last = CURVE + (SIDE if start >= SIDE else 0)
    for p in range(4):
        column = _ground_column(last if p == 3 else start + p)
        for c in range(COLOURS):
            light[c] += gained * pixels.weights[i, p] * colours[column, c]


class Linearised(NamedTuple):
    """The tone curve about each pixel's light."""

    light: FloatArray
    """(m, 3)."""
    level: FloatArray
    """Grey levels of it, (m, 3)."""
    slope: FloatArray
    """Their derivative by the light, (m, 3)."""
    by_gamma: FloatArray
    """And by the tone curve's γ, (m, 3)."""


@njit
def linearise(levels: Any, gamma: float, out: Any) -> None:
    """Fill `Linearised` about the light that shows as `levels`, (m, 3)."""
    for i in range(levels.shape[0]):
        for c in range(COLOURS):
            level = min(265.0, max(-8.0, levels[i, c]))
            x = to_light(level, gamma)
            out.light[i, c] = x
            out.level[i, c], out.slope[i, c], out.by_gamma[i, c] = to_level(x, gamma)


@njit(fastmath=REORDERED)
def _scatter(
    sparse: Any, tone: Any, i: int, plane: int, scale: float, work: Any, touched: Any, count: int
) -> int:
    """Add a pixel's columns, in a plane, to a dense row; returns how many columns are touched."""
    for k in range(sparse.count[i]):
        column, value = COLOURS * sparse.column[i, k], scale * sparse.value[i, k]
        for c in range(COLOURS):
            at = column + c
            x = value * PLANE_WEIGHTS[plane, c] * tone.slope[i, c]
            if work[at] == 0.0:
                touched[count] = at
                count += 1
                work[at] = 1e-30
            work[at] += x
    return count


@njit(fastmath=REORDERED, forceinline=True)
def _target(tone: Any, i: int, plane: int) -> float:
    """Level of a plane at light 0, by the tangent."""
    total = 0.0
    for c in range(COLOURS):
        total += PLANE_WEIGHTS[plane, c] * (tone.level[i, c] - tone.slope[i, c] * tone.light[i, c])
    return total


@njit(fastmath=REORDERED)
def _add(work: Any, touched: Any, count: int, y: float, weight: float, normal: Any, right: Any) -> None:
    """Add a row to the normal equations and empty it."""
    for p in range(count):
        a = touched[p]
        x = weight * work[a]
        right[a] += x * y
        for q in range(count):
            b = touched[q]
            if b <= a:
                normal[a, b] += x * work[b]
    for p in range(count):
        work[touched[p]] = 0.0


@njit(fastmath=REORDERED)
def normal_equations(
    observed: Any, sparse: Any, tone: Any, good: Any, kept: Any, weights: Any, normal: Any, right: Any
) -> None:
    """Add all that is compared to the colours' normal equations.

    Args:
        observed: `Observed`.
        sparse: `Sparse`.
        tone: `Linearised`.
        good: which pixels' brightness counts, (m,).
        kept: which groups' colour counts, (b,).
        weights: inverse variances of the three planes, (3,).
        normal: in and out, lower triangle, (SIZE, SIZE).
        right: in and out, (SIZE,).
    """
    work, touched = np.zeros(SIZE), np.zeros(SIZE, np.int64)
    for i in range(observed.luma.shape[0]):
        if good[i]:
            count = _scatter(sparse, tone, i, 0, 1.0, work, touched, 0)
            y = observed.luma[i] - _target(tone, i, 0)
            _add(work, touched, count, y, weights[0], normal, right)
    for b in range(observed.chroma.shape[0]):
        if not kept[b]:
            continue
        size = group_size(observed.members[b])
        for plane in range(1, PLANES):
            count, y = 0, observed.chroma[b, plane - 1]
            for k in range(size):
                i = observed.members[b, k]
                count = _scatter(sparse, tone, i, plane, 1.0 / size, work, touched, count)
                y -= _target(tone, i, plane) / size
            _add(work, touched, count, y, weights[plane], normal, right)


MOVES: Final = 7
"""n, e, width, length, blur across, blur along, tone curve."""


class Moved(NamedTuple):
    """Change of each plane with the moves, and what is left, for brightness and colour."""

    luma: FloatArray
    """(m, MOVES)."""
    chroma: FloatArray
    """(b, 2, MOVES)."""
    luma_left: FloatArray
    """Observed less model, (m,)."""
    chroma_left: FloatArray
    """(b, 2)."""
    levels: FloatArray
    """Grey levels of the model, (m, 3)."""
    changes: FloatArray
    """Of them with the moves, (m, MOVES, 3)."""


@njit
def no_moves(m: int, b: int) -> Any:
    """Return `Moved` of m pixels and b groups to fill."""
    return Moved(
        np.zeros((m, MOVES)),
        np.zeros((b, 2, MOVES)),
        np.zeros(m),
        np.zeros((b, 2)),
        np.zeros((m, COLOURS)),
        np.zeros((m, MOVES, COLOURS)),
    )


@njit(fastmath=REORDERED)
def move_rows(
    pixels: Any, observed: Any, rows: Any, sparse: Any, tone: Any, colours: Any, moved: Any
) -> None:
    """Fill the derivatives and residuals at solved colours, (UNKNOWNS, 3)."""
    levels, changes, light = moved.levels, moved.changes, np.empty(COLOURS)
    changes[:], moved.chroma[:], moved.luma[:] = 0.0, 0.0, 0.0
    for i in range(observed.luma.shape[0]):
        for c in range(COLOURS):
            light[c] = 0.0
        for k in range(sparse.count[i]):
            for c in range(COLOURS):
                light[c] += sparse.value[i, k] * colours[sparse.column[i, k], c]
        for c in range(COLOURS):
            levels[i, c] = tone.level[i, c] + tone.slope[i, c] * (light[c] - tone.light[i, c])
            changes[i, MOVES - 1, c] = tone.by_gamma[i, c]
        if rows.seen[i]:
            for p in range(MOVES - 1):
                derivative(pixels, rows, i, 1 + p, colours, light)
                for c in range(COLOURS):
                    changes[i, p, c] = tone.slope[i, c] * light[c]
        moved.luma_left[i] = observed.luma[i]
        for c in range(COLOURS):
            moved.luma_left[i] -= PLANE_WEIGHTS[0, c] * levels[i, c]
            for p in range(MOVES):
                moved.luma[i, p] += PLANE_WEIGHTS[0, c] * changes[i, p, c]
    for b in range(observed.chroma.shape[0]):
        size = group_size(observed.members[b])
        for plane in range(1, PLANES):
            left = observed.chroma[b, plane - 1]
            for k in range(size):
                i = observed.members[b, k]
                for c in range(COLOURS):
                    x = PLANE_WEIGHTS[plane, c] / size
                    left -= x * levels[i, c]
                    for p in range(MOVES):
                        moved.chroma[b, plane - 1, p] += x * changes[i, p, c]
            moved.chroma_left[b, plane - 1] = left


@njit(forceinline=True)
def group_size(members: Any) -> int:
    """How many pixels a group has."""
    size = 0
    for k in range(members.shape[0]):
        size += members[k] >= 0
    return size


@njit(fastmath=REORDERED)
def cross_equations(
    observed: Any,
    sparse: Any,
    tone: Any,
    good: Any,
    kept: Any,
    weights: Any,
    moved: Any,
    cross: Any,
    information: Any,
    right: Any,
) -> None:
    """Add products of the moves' derivatives with the colours, each other and what is left.

    Args:
        observed, sparse, tone, good, kept, weights: see `normal_equations`.
        moved: `Moved`.
        cross: in and out, (SIZE, MOVES).
        information: in and out, (MOVES, MOVES).
        right: in and out, (MOVES,).
    """
    work, touched = np.zeros(SIZE), np.zeros(SIZE, np.int64)
    for i in range(observed.luma.shape[0]):
        if good[i]:
            count = _scatter(sparse, tone, i, 0, 1.0, work, touched, 0)
            by, left = moved.luma[i], moved.luma_left[i]
            _cross(work, touched, count, by, left, weights[0], cross, information, right)
    for b in range(observed.chroma.shape[0]):
        if not kept[b]:
            continue
        size = group_size(observed.members[b])
        for plane in range(1, PLANES):
            count = 0
            for k in range(size):
                i = observed.members[b, k]
                count = _scatter(sparse, tone, i, plane, 1.0 / size, work, touched, count)
            by, left = moved.chroma[b, plane - 1], moved.chroma_left[b, plane - 1]
            _cross(work, touched, count, by, left, weights[plane], cross, information, right)


@njit(fastmath=REORDERED)
def _cross(
    work: Any,
    touched: Any,
    count: int,
    by: Any,
    left: float,
    weight: float,
    cross: Any,
    information: Any,
    right: Any,
) -> None:
    for p in range(count):
        a = touched[p]
        x = weight * work[a]
        for q in range(MOVES):
            cross[a, q] += x * by[q]
        work[a] = 0.0
    for p in range(MOVES):
        right[p] += weight * by[p] * left
        for q in range(MOVES):
            information[p, q] += weight * by[p] * by[q]


@njit(fastmath=REORDERED)
def projected(
    observed: Any, sparse: Any, tone: Any, taken: Any, moved: Any, luma: Any, chroma: Any
) -> None:
    """Fill the derivatives by the moves less what the colours take of them.

    Args:
        observed, sparse, tone, moved: see `cross_equations`.
        taken: colours' change with the moves, (SIZE, MOVES).
        luma: out, (m, MOVES).
        chroma: out, (b, 2, MOVES).
    """
    work, touched = np.zeros(SIZE), np.zeros(SIZE, np.int64)
    for i in range(observed.luma.shape[0]):
        count = _scatter(sparse, tone, i, 0, 1.0, work, touched, 0)
        _less(work, touched, count, taken, moved.luma[i], luma[i])
    for b in range(observed.chroma.shape[0]):
        size = group_size(observed.members[b])
        for plane in range(1, PLANES):
            count = 0
            for k in range(size):
                i = observed.members[b, k]
                count = _scatter(sparse, tone, i, plane, 1.0 / size, work, touched, count)
            _less(work, touched, count, taken, moved.chroma[b, plane - 1], chroma[b, plane - 1])


@njit(fastmath=REORDERED, forceinline=True)
def _less(work: Any, touched: Any, count: int, taken: Any, by: Any, out: Any) -> None:
    for q in range(MOVES):
        out[q] = by[q]
    for p in range(count):
        a = touched[p]
        for q in range(MOVES):
            out[q] -= work[a] * taken[a, q]
        work[a] = 0.0
