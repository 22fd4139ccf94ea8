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
from app.tracking.band.tone import about_level

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
            out.level[i, c] = level
            out.light[i, c], out.slope[i, c], out.by_gamma[i, c] = about_level(level, gamma)


@njit(fastmath=REORDERED, forceinline=True)
def _target(tone: Any, i: int, plane: int) -> float:
    """Level of a plane at light 0, by the tangent."""
    total = 0.0
    for c in range(COLOURS):
        total += PLANE_WEIGHTS[plane, c] * (tone.level[i, c] - tone.slope[i, c] * tone.light[i, c])
    return total


@njit(fastmath=REORDERED)
def _group(
    observed: Any, sparse: Any, tone: Any, b: int, size: int, work: Any, seen: Any, columns: Any
) -> int:
    """Fill the columns of a group of pixels, in rising order; returns how many.

    Args:
        observed: see `normal_equations`.
        sparse: likewise.
        tone: likewise.
        b: the group.
        size: its pixels.
        work: by each colour's light, zero and left so but for what is returned, (UNKNOWNS, 3).
        seen: likewise False, (UNKNOWNS,).
        columns: out, (UNKNOWNS,).
    """
    share = 1.0 / size
    for k in range(size):
        i = observed.members[b, k]
        for p in range(sparse.used[i]):
            column, value = sparse.column[i, p], sparse.value[i, p] * share
            seen[column] = True
            for c in range(COLOURS):
                work[column, c] += value * tone.slope[i, c]
    count = 0
    for column in range(UNKNOWNS):
        if seen[column]:
            columns[count] = column
            count += 1
    return count


@njit(fastmath=REORDERED)
def _clear(columns: Any, count: int, work: Any, seen: Any) -> None:
    """Undo `_group`."""
    for p in range(count):
        seen[columns[p]] = False
        for c in range(COLOURS):
            work[columns[p], c] = 0.0


@njit(fastmath=REORDERED, forceinline=True)
def _add_row(at: Any, z: Any, count: int, y: float, normal: Any, right: Any) -> None:
    """Add what one value says of the colours; `at` are the unknowns, rising, `z` its changes."""
    for p in range(count):
        x, row = z[p], normal[at[p]]
        right[at[p]] += x * y
        for q in range(p + 1):
            row[at[q]] += x * z[q]


@njit(fastmath=REORDERED, forceinline=True)
def _add_rows(at: Any, z: Any, count: int, y: Any, normal: Any, right: Any) -> None:
    """Like `_add_row` of two values, z (2, n), y (2,)."""
    for p in range(count):
        x0, x1, row = z[0, p], z[1, p], normal[at[p]]
        right[at[p]] += x0 * y[0] + x1 * y[1]
        for q in range(p + 1):
            row[at[q]] += x0 * z[0, q] + x1 * z[1, q]


@njit(fastmath=REORDERED)
def normal_equations(
    observed: Any,
    sparse: Any,
    tone: Any,
    good: Any,
    stored: Any,
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
        stored: which groups' colour counts, (b,).
        weights: inverse variances of the three planes, (3,).
        normal: in and out, lower triangle, (SIZE, SIZE).
        right: in and out, (SIZE,).
    """
    work, columns = np.zeros((UNKNOWNS, COLOURS)), np.empty(UNKNOWNS, np.int64)
    seen, at, z, y = np.zeros(UNKNOWNS, np.bool_), np.empty(SIZE, np.int64), np.empty(SIZE), 0.0
    both, targets, root = np.empty((2, SIZE)), np.empty(2), np.sqrt(weights)
    for i in range(observed.luma.shape[0]):
        if not good[i]:
            continue
        n = 0
        for p in range(sparse.used[i]):
            a, value = COLOURS * sparse.column[i, p], root[0] * sparse.value[i, p]
            for c in range(COLOURS):
                at[n], z[n] = a + c, value * PLANE_WEIGHTS[0, c] * tone.slope[i, c]
                n += 1
        y = root[0] * (observed.luma[i] - _target(tone, i, 0))
        _add_row(at, z, n, y, normal, right)
    for b in range(observed.chroma.shape[0]):
        if not stored[b]:
            continue
        size = group_size(observed.members[b])
        count = _group(observed, sparse, tone, b, size, work, seen, columns)
        n = 0
        for p in range(count):
            for c in range(COLOURS):
                at[n] = COLOURS * columns[p] + c
                for k in range(2):
                    both[k, n] = root[1 + k] * PLANE_WEIGHTS[1 + k, c] * work[columns[p], c]
                n += 1
        for k in range(2):
            y = observed.chroma[b, k]
            for j in range(size):
                y -= _target(tone, observed.members[b, j], 1 + k) / size
            targets[k] = root[1 + k] * y
        _add_rows(at, both, n, targets, normal, right)
        _clear(columns, count, work, seen)


@njit(fastmath=REORDERED)
def factorise_colours(matrix: Any, first: Any) -> bool:
    """Replace the lower triangle by Cholesky's factor; False if it is not positive definite.

    Rows keep their leading zeros: most unknowns of the ground have few neighbours. The three
    colours of an unknown have the same ones, and are done together.

    Args:
        matrix: (SIZE, SIZE), in and out.
        first: out, first column of every row that may differ from zero, (SIZE,).
    """
    for a in range(0, matrix.shape[0], COLOURS):
        start = 0
        while start < a and matrix[a, start] == 0.0 and matrix[a + 1, start] == 0.0:
            if matrix[a + 2, start] != 0.0:
                break
            start += 1
        first[a] = first[a + 1] = first[a + 2] = start
        one, two, three = matrix[a], matrix[a + 1], matrix[a + 2]
        for j in range(start, a):
            row, x, y, z = matrix[j], 0.0, 0.0, 0.0
            for k in range(max(start, first[j]), j):
                x += one[k] * row[k]
                y += two[k] * row[k]
                z += three[k] * row[k]
            pivot = 1.0 / row[j]
            one[j] = (one[j] - x) * pivot
            two[j] = (two[j] - y) * pivot
            three[j] = (three[j] - z) * pivot
        for i in range(a, a + COLOURS):
            for j in range(a, i + 1):
                total = matrix[i, j]
                for k in range(start, j):
                    total -= matrix[i, k] * matrix[j, k]
                if j < i:
                    matrix[i, j] = total / matrix[j, j]
                elif not total > 0.0:
                    return False
                else:
                    matrix[i, i] = np.sqrt(total)
    return True


@njit(fastmath=REORDERED)
def halve_colours(factor: Any, first: Any, right: Any) -> None:
    """Like `equations.halve`, with rows' leading zeros passed over."""
    size, count = right.shape
    for i in range(size):
        for k in range(first[i], i):
            x = factor[i, k]
            for c in range(count):
                right[i, c] -= x * right[k, c]
        for c in range(count):
            right[i, c] /= factor[i, i]


@njit(fastmath=REORDERED)
def finish_colours(factor: Any, first: Any, right: Any) -> None:
    """Like `equations.finish`, likewise."""
    size, count = right.shape
    for i in range(size - 1, -1, -1):
        for c in range(count):
            right[i, c] /= factor[i, i]
        for k in range(first[i], i):
            x = factor[i, k]
            for c in range(count):
                right[k, c] -= x * right[i, c]


@njit(fastmath=REORDERED)
def solve_colours_alone(factor: Any, first: Any, x: Any) -> None:
    """Replace a vector b by (L Lᵀ)⁻¹ b."""
    for i in range(len(x)):
        total, row = 0.0, factor[i]
        for k in range(first[i], i):
            total += row[k] * x[k]
        x[i] = (x[i] - total) / row[i]
    for i in range(len(x) - 1, -1, -1):
        row = factor[i]
        x[i] /= row[i]
        y = x[i]
        for k in range(first[i], i):
            x[k] -= row[k] * y


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


@njit(fastmath=REORDERED, forceinline=True)
def _behind(pixels: Any, i: int, colours: Any, ground: Any) -> None:
    """Fill the background's light at a pixel, (3,)."""
    start = pixels.first[i]
    last = CURVE + (SIDE if start >= SIDE else 0)
    ground[0] = ground[1] = ground[2] = 0.0
    for p in range(4):
        column, weight = _ground_column(last if p == 3 else start + p), pixels.weights[i, p]
        for c in range(COLOURS):
            ground[c] += weight * colours[column, c]


@njit(fastmath=REORDERED, forceinline=True)
def _light_moved(row: Any, colours: Any, ground: Any, slope: Any, changes: Any) -> None:
    """Add the change of a pixel's grey levels with the moves to `changes`, (MOVES, 3).

    What a column gains with a move the background behind loses.
    """
    begin = 0 if row[0, 0] != 0.0 else BAND
    for k in range(begin, COLUMNS):
        if k >= BAND and row[0, k] == 0.0:
            continue
        at = _BAND0 + k if k < BAND else _SHAFT0 + k - BAND
        b, g, r = colours[at, 0], colours[at, 1], colours[at, 2]
        if k == 0 or k >= BAND:  # the shares; the other harmonics are of the same share
            b, g, r = b - ground[0], g - ground[1], r - ground[2]
        b, g, r = b * slope[0], g * slope[1], r * slope[2]
        for p in range(MOVES - 1):
            x = row[1 + p, k]
            changes[p, 0] += x * b
            changes[p, 1] += x * g
            changes[p, 2] += x * r


@njit(fastmath=REORDERED)
def move_rows(
    pixels: Any, observed: Any, rows: Any, sparse: Any, tone: Any, colours: Any, moved: Any
) -> None:
    """Fill the derivatives and residuals at solved colours, (UNKNOWNS, 3)."""
    levels, changes, light, ground = moved.levels, moved.changes, np.empty(3), np.empty(3)
    changes[:], moved.luma[:] = 0.0, 0.0
    for i in range(observed.luma.shape[0]):
        light[0] = light[1] = light[2] = 0.0
        for k in range(sparse.used[i]):
            value, column = sparse.value[i, k], sparse.column[i, k]
            for c in range(COLOURS):
                light[c] += value * colours[column, c]
        for c in range(COLOURS):
            levels[i, c] = tone.level[i, c] + tone.slope[i, c] * (light[c] - tone.light[i, c])
            changes[i, MOVES - 1, c] = tone.by_gamma[i, c]
        if rows.seen[i]:
            _behind(pixels, i, colours, ground)
            _light_moved(rows.values[i], colours, ground, tone.slope[i], changes[i])
        moved.luma_left[i] = observed.luma[i]
        for c in range(COLOURS):
            moved.luma_left[i] -= PLANE_WEIGHTS[0, c] * levels[i, c]
        for p in range(MOVES):
            for c in range(COLOURS):
                moved.luma[i, p] += PLANE_WEIGHTS[0, c] * changes[i, p, c]
    _move_groups(observed, moved)


@njit(fastmath=REORDERED)
def _move_groups(observed: Any, moved: Any) -> None:
    """Fill what `Moved` has of the colour differences."""
    levels, changes = moved.levels, moved.changes
    moved.chroma[:] = 0.0
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
    """Return how many pixels a group has."""
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
    stored: Any,
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
        stored: likewise.
        weights: likewise.
        moved: `Moved`.
        cross: in and out, (SIZE, MOVES).
        information: in and out, (MOVES, MOVES).
        right: in and out, (MOVES,).
    """
    work, columns = np.zeros((UNKNOWNS, COLOURS)), np.empty(UNKNOWNS, np.int64)
    seen = np.zeros(UNKNOWNS, np.bool_)
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
        if not stored[b]:
            continue
        size = group_size(observed.members[b])
        count = _group(observed, sparse, tone, b, size, work, seen, columns)
        for plane in range(1, PLANES):
            by = moved.chroma[b, plane - 1]
            for p in range(count):
                a = COLOURS * columns[p]
                for c in range(COLOURS):
                    x = weights[plane] * PLANE_WEIGHTS[plane, c] * work[columns[p], c]
                    for q in range(MOVES):
                        cross[a + c, q] += x * by[q]
            _square(by, moved.chroma_left[b, plane - 1], weights[plane], information, right)
        _clear(columns, count, work, seen)


@njit(fastmath=REORDERED, forceinline=True)
def _square(by: Any, left: float, weight: float, information: Any, right: Any) -> None:
    for p in range(MOVES):
        right[p] += weight * by[p] * left
        for q in range(MOVES):
            information[p, q] += weight * by[p] * by[q]


@njit(fastmath=REORDERED)
def influences(
    observed: Any, sparse: Any, tone: Any, taken: Any, moved: Any, inverse: Any, out: Any
) -> None:
    """Fill by how much each value moves the band's n and e, but for its weight.

    Args:
        observed: see `cross_equations`.
        sparse: likewise.
        tone: likewise.
        taken: colours' change with the moves, (SIZE, MOVES).
        moved: see `cross_equations`.
        inverse: of the moves' information, (MOVES, MOVES).
        out: of brightness and both colour differences, three times (m or b, 2).
    """
    work, columns = np.zeros((UNKNOWNS, COLOURS)), np.empty(UNKNOWNS, np.int64)
    seen, luma = np.zeros(UNKNOWNS, np.bool_), out[0]
    turn = np.ascontiguousarray(inverse[:, :2])
    by_colour = taken @ turn
    luma[:] = moved.luma @ turn
    for i in range(observed.luma.shape[0]):
        for p in range(sparse.used[i]):
            a = COLOURS * sparse.column[i, p]
            for c in range(COLOURS):
                x = sparse.value[i, p] * PLANE_WEIGHTS[0, c] * tone.slope[i, c]
                luma[i, 0] -= x * by_colour[a + c, 0]
                luma[i, 1] -= x * by_colour[a + c, 1]
    for b in range(observed.chroma.shape[0]):
        size = group_size(observed.members[b])
        count = _group(observed, sparse, tone, b, size, work, seen, columns)
        for plane in range(1, PLANES):
            for q in range(2):
                total = 0.0
                for k in range(MOVES):
                    total += moved.chroma[b, plane - 1, k] * turn[k, q]
                for p in range(count):
                    a = COLOURS * columns[p]
                    for c in range(COLOURS):
                        x = PLANE_WEIGHTS[plane, c] * work[columns[p], c]
                        total -= x * by_colour[a + c, q]
                out[plane][b, q] = total
        _clear(columns, count, work, seen)
