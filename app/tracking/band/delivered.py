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
_NOTHING: Final = 1e-9
"""Share of a pixel too small to count."""

_SHAFT0: Final = GROUND
_BAND0: Final = GROUND + COLUMNS - BAND
_WEIGHTS = np.array(
    [[0.114, 0.587, 0.299], [0.5, -0.331264, -0.168736], [-0.081312, -0.418688, 0.5]]
)
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

    used: NDArray[np.int64]
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
    """Fill the columns of every pixel: ground, shaft and point, band, in rising order."""
    for i in range(pixels.places.shape[0]):
        n, free = 0, 1.0
        if rows.seen[i]:
            row = rows.values[i, 0]
            for k in range(BAND, COLUMNS):
                free -= row[k]
            free -= row[0]
        if abs(free) > _NOTHING:
            start = pixels.first[i]
            last = CURVE + (SIDE if start >= SIDE else 0)
            for p in range(4):
                column = _ground_column(last if p == 3 else start + p)
                out.column[i, n], out.value[i, n] = column, free * pixels.weights[i, p]
                n += 1
        if rows.seen[i]:
            row = rows.values[i, 0]
            for k in range(BAND, COLUMNS):
                if row[k] != 0.0:
                    out.column[i, n], out.value[i, n] = _SHAFT0 + k - BAND, row[k]
                    n += 1
            if row[0] != 0.0:
                for k in range(BAND):
                    out.column[i, n], out.value[i, n] = _BAND0 + k, row[k]
                    n += 1
        out.used[i] = n


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


@njit(fastmath=REORDERED, forceinline=True)
def _target(tone: Any, i: int, plane: int) -> float:
    """Level of a plane at light 0, by the tangent."""
    total = 0.0
    for c in range(COLOURS):
        total += PLANE_WEIGHTS[plane, c] * (tone.level[i, c] - tone.slope[i, c] * tone.light[i, c])
    return total


@njit(fastmath=REORDERED)
def _group(
    observed: Any, sparse: Any, tone: Any, b: int, size: int, work: Any, at: Any, columns: Any
) -> int:
    """Fill the colours' columns of a group of pixels; returns how many.

    Args:
        observed: see `normal_equations`.
        sparse: likewise.
        tone: likewise.
        b: the group.
        size: its pixels.
        work: out, by each colour's light, (MOST * 4, 3).
        at: -1 for every column, and left so, (UNKNOWNS,).
        columns: out, (MOST * 4,).
    """
    count = 0
    for k in range(size):
        i = observed.members[b, k]
        for p in range(sparse.used[i]):
            column, value = sparse.column[i, p], sparse.value[i, p] / size
            n = at[column]
            if n < 0:
                n = count
                at[column], columns[n] = n, column
                work[n, 0] = work[n, 1] = work[n, 2] = 0.0
                count += 1
            for c in range(COLOURS):
                work[n, c] += value * tone.slope[i, c]
    for p in range(count):
        at[columns[p]] = -1
    return count


@njit(fastmath=REORDERED)
def _add_block(
    columns: Any, work: Any, count: int, square: Any, target: Any, normal: Any, right: Any
) -> None:
    """Add a pixel's or group's columns to the normal equations.

    Args:
        columns: which, (count,).
        work: by each colour's light, (count, 3).
        count: how many.
        square: weights of products of colours, (3, 3).
        target: weighted right side by colour, (3,).
        normal: in and out.
        right: in and out.
    """
    for p in range(count):
        a = COLOURS * columns[p]
        first, second, third = work[p, 0], work[p, 1], work[p, 2]
        right[a] += first * target[0]
        right[a + 1] += second * target[1]
        right[a + 2] += third * target[2]
        for q in range(count):
            if columns[q] > columns[p]:
                continue
            b = COLOURS * columns[q]
            for c in range(COLOURS):
                x = work[p, c]
                for d in range(COLOURS):
                    normal[a + c, b + d] += x * square[c, d] * work[q, d]


@njit(fastmath=REORDERED)
def normal_equations(
    observed: Any,
    sparse: Any,
    tone: Any,
    good: Any,
    kept: Any,
    weights: Any,
    normal: Any,
    right: Any,
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
    work, columns = np.zeros((4 * MOST, COLOURS)), np.zeros(4 * MOST, np.int64)
    at, square, target = np.full(UNKNOWNS, -1), np.zeros((COLOURS, COLOURS)), np.zeros(COLOURS)
    for c in range(COLOURS):
        for d in range(COLOURS):
            square[c, d] = weights[0] * PLANE_WEIGHTS[0, c] * PLANE_WEIGHTS[0, d]
    for i in range(observed.luma.shape[0]):
        if not good[i]:
            continue
        count = sparse.used[i]
        y = weights[0] * (observed.luma[i] - _target(tone, i, 0))
        for c in range(COLOURS):
            target[c] = y * PLANE_WEIGHTS[0, c]
            for p in range(count):
                work[p, c] = sparse.value[i, p] * tone.slope[i, c]
        _add_block(sparse.column[i], work, count, square, target, normal, right)
    for c in range(COLOURS):
        for d in range(COLOURS):
            square[c, d] = 0.0
            for plane in range(1, PLANES):
                square[c, d] += weights[plane] * PLANE_WEIGHTS[plane, c] * PLANE_WEIGHTS[plane, d]
    for b in range(observed.chroma.shape[0]):
        if not kept[b]:
            continue
        size = group_size(observed.members[b])
        count = _group(observed, sparse, tone, b, size, work, at, columns)
        target[0] = target[1] = target[2] = 0.0
        for plane in range(1, PLANES):
            y = observed.chroma[b, plane - 1]
            for k in range(size):
                y -= _target(tone, observed.members[b, k], plane) / size
            for c in range(COLOURS):
                target[c] += weights[plane] * PLANE_WEIGHTS[plane, c] * y
        _add_block(columns, work, count, square, target, normal, right)


@njit(fastmath=REORDERED)
def factorise_skyline(matrix: Any, first: Any) -> bool:
    """Replace the lower triangle by Cholesky's factor; False if it is not positive definite.

    Rows keep their leading zeros: most unknowns of the ground have few neighbours.

    Args:
        matrix: (n, n), in and out.
        first: memory, (n,): first column that is not zero.
    """
    size = matrix.shape[0]
    for i in range(size):
        start = 0
        while start < i and matrix[i, start] == 0.0:
            start += 1
        first[i] = start
        for j in range(start, i + 1):
            total = matrix[i, j]
            for k in range(max(start, first[j]), j):
                total -= matrix[i, k] * matrix[j, k]
            if j < i:
                matrix[i, j] = total / matrix[j, j]
            elif not total > 0.0:
                return False
            else:
                matrix[i, i] = np.sqrt(total)
    return True


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
        for k in range(sparse.used[i]):
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
        observed: see `normal_equations`.
        sparse: likewise.
        tone: likewise.
        good: likewise.
        kept: likewise.
        weights: likewise.
        moved: `Moved`.
        cross: in and out, (SIZE, MOVES).
        information: in and out, (MOVES, MOVES).
        right: in and out, (MOVES,).
    """
    work, columns = np.zeros((4 * MOST, COLOURS)), np.zeros(4 * MOST, np.int64)
    at = np.full(UNKNOWNS, -1)
    for i in range(observed.luma.shape[0]):
        if not good[i]:
            continue
        for p in range(sparse.used[i]):
            a, value = COLOURS * sparse.column[i, p], weights[0] * sparse.value[i, p]
            for c in range(COLOURS):
                x = value * PLANE_WEIGHTS[0, c] * tone.slope[i, c]
                for q in range(MOVES):
                    cross[a + c, q] += x * moved.luma[i, q]
        _square(moved.luma[i], moved.luma_left[i], weights[0], information, right)
    for b in range(observed.chroma.shape[0]):
        if not kept[b]:
            continue
        size = group_size(observed.members[b])
        count = _group(observed, sparse, tone, b, size, work, at, columns)
        for plane in range(1, PLANES):
            by = moved.chroma[b, plane - 1]
            for p in range(count):
                a = COLOURS * columns[p]
                for c in range(COLOURS):
                    x = weights[plane] * PLANE_WEIGHTS[plane, c] * work[p, c]
                    for q in range(MOVES):
                        cross[a + c, q] += x * by[q]
            _square(by, moved.chroma_left[b, plane - 1], weights[plane], information, right)


@njit(fastmath=REORDERED, forceinline=True)
def _square(by: Any, left: float, weight: float, information: Any, right: Any) -> None:
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
        observed: see `cross_equations`.
        sparse: likewise.
        tone: likewise.
        moved: likewise.
        taken: colours' change with the moves, (SIZE, MOVES).
        luma: out, (m, MOVES).
        chroma: out, (b, 2, MOVES).
    """
    work, columns = np.zeros((4 * MOST, COLOURS)), np.zeros(4 * MOST, np.int64)
    at = np.full(UNKNOWNS, -1)
    for i in range(observed.luma.shape[0]):
        for q in range(MOVES):
            luma[i, q] = moved.luma[i, q]
        for p in range(sparse.used[i]):
            a = COLOURS * sparse.column[i, p]
            for c in range(COLOURS):
                x = sparse.value[i, p] * PLANE_WEIGHTS[0, c] * tone.slope[i, c]
                for q in range(MOVES):
                    luma[i, q] -= x * taken[a + c, q]
    for b in range(observed.chroma.shape[0]):
        size = group_size(observed.members[b])
        count = _group(observed, sparse, tone, b, size, work, at, columns)
        for plane in range(1, PLANES):
            for q in range(MOVES):
                chroma[b, plane - 1, q] = moved.chroma[b, plane - 1, q]
            for p in range(count):
                a = COLOURS * columns[p]
                for c in range(COLOURS):
                    x = PLANE_WEIGHTS[plane, c] * work[p, c]
                    for q in range(MOVES):
                        chroma[b, plane - 1, q] -= x * taken[a + c, q]
