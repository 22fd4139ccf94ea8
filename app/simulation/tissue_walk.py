"""Kernels that look into a bound field of tissue: what lies at a point, the first wall on a way.

A field is two arrays of bytes outside the loop's own: the code of each voxel's tissue, and how far
the voxel's centre is from the nearest boundary of that tissue [1/40 mm]. At a point, with the
weights w of its eight neighbours and their distances d, every tissue L about it has

    s_L = Σ w (+d where the neighbour is L, -d where it is not);

the largest is the tissue there, the two largest are equal on the boundary, and half of their
difference is the distance to it, its gradient the normal. A point outside the grid is unknown.

Breathing. Tissue that rests at X lies at X + w(X) b, b being the displacement of what goes along
with all of it. The wall of the body stays: where wall is at rest, wall is. What lies at another
point is looked up at X, which is found by going back again and again until it changes by less than
`_NEAR`; what would come out of the wall is what lies before it. w is the tissue's own share, times
a straight function of place (less towards the spine), times another one in the lung, whose apex
stays (it changes its volume).
"""

from typing import Any, Final, NamedTuple

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.parameters import numbered

from numba import carray, types  # isort: skip  (after core.compiled)
from numba.core import cgutils  # isort: skip
from numba.extending import intrinsic  # isort: skip

UNIT: Final = 0.025e-3  # [m] of a distance in the field
_NEAR: Final = 0.05e-3  # [m]
_TURNS: Final = 6
_SHORTEST: Final = 0.25  # voxels of a step along a way
_UNSURE: Final = 0.5  # voxels by which an interpolated distance may be too long
_EXACT: Final = 2e-6  # [m]
_MOST_STEPS: Final = 600
_MOST_HALVINGS: Final = 40


class FieldPlaces(NamedTuple):
    """Addresses and sizes; the voxel of a point of the world [m]; how shares depend on place.

    The share at X is that of the tissue, times spine + spine_* · X held between the two limits,
    in the lung times lung + lung_* · X held between 0 and 2.
    """

    slot: int
    labels: int
    distance: int
    nx: int
    ny: int
    nz: int
    i_x: int
    i_y: int
    i_z: int
    i_0: int
    j_x: int
    j_y: int
    j_z: int
    j_0: int
    k_x: int
    k_y: int
    k_z: int
    k_0: int
    spacing: int
    spine: int
    spine_x: int
    spine_y: int
    spine_z: int
    spine_least: int
    spine_most: int
    lung: int
    lung_x: int
    lung_y: int
    lung_z: int
    codes: int
    table: int


class TissueRow(NamedTuple):
    """Of a tissue in the table: share of breathing, 1 for lung, 1 for rigid, 1 for no tissue."""

    share: int
    lung: int
    rigid: int
    empty: int


FIELD: Final = numbered(FieldPlaces)
ROW: Final = numbered(TissueRow)


@intrinsic
def _pointer(typing_context: Any, address: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return builder.inttoptr(arguments[0], cgutils.voidptr_t)

    return types.voidptr(types.int64), generate


@njit
def labels_of(p: FloatArray) -> Any:
    """View of the codes, shape (nz, ny, nx)."""
    shape = (int(p[FIELD.nz]), int(p[FIELD.ny]), int(p[FIELD.nx]))
    return carray(_pointer(np.int64(p[FIELD.labels])), shape, np.uint8)


@njit
def distances_of(p: FloatArray) -> Any:
    """View of the distances to the boundary, shape (nz, ny, nx)."""
    shape = (int(p[FIELD.nz]), int(p[FIELD.ny]), int(p[FIELD.nx]))
    return carray(_pointer(np.int64(p[FIELD.distance])), shape, np.int8)


@njit
def _code(labels: Any, p: FloatArray, k: int, j: int, i: int) -> int:
    """Code of a voxel; unknown where it names no row of the table."""
    code = int(labels[k, j, i])
    return code if code < int(p[FIELD.codes]) else 0


@njit
def _of(code: int, c: Any, w: Any) -> float:
    total = 0.0
    for n in range(8):
        total += w[n] if c[n] == code else 0.0
    return total


@njit
def at_rest(p: FloatArray, labels: Any, distance: Any, x: float, y: float, z: float) -> Any:
    """Return what lies at a point of the world [m] without breathing: `tissue_at` but the share."""
    i = p[FIELD.i_x] * x + p[FIELD.i_y] * y + p[FIELD.i_z] * z + p[FIELD.i_0]
    j = p[FIELD.j_x] * x + p[FIELD.j_y] * y + p[FIELD.j_z] * z + p[FIELD.j_0]
    k = p[FIELD.k_x] * x + p[FIELD.k_y] * y + p[FIELD.k_z] * z + p[FIELD.k_0]
    nz, ny, nx = labels.shape
    if not (0.0 <= i <= nx - 1.0 and 0.0 <= j <= ny - 1.0 and 0.0 <= k <= nz - 1.0):
        return 0, 0, 0.0, 0.0, 0.0, 0.0
    a, b, c = min(int(i), nx - 2), min(int(j), ny - 2), min(int(k), nz - 2)
    u, v, w = i - a, j - b, k - c
    codes = (
        _code(labels, p, c, b, a),
        _code(labels, p, c, b, a + 1),
        _code(labels, p, c, b + 1, a),
        _code(labels, p, c, b + 1, a + 1),
        _code(labels, p, c + 1, b, a),
        _code(labels, p, c + 1, b, a + 1),
        _code(labels, p, c + 1, b + 1, a),
        _code(labels, p, c + 1, b + 1, a + 1),
    )
    d = (
        float(distance[c, b, a]),
        float(distance[c, b, a + 1]),
        float(distance[c, b + 1, a]),
        float(distance[c, b + 1, a + 1]),
        float(distance[c + 1, b, a]),
        float(distance[c + 1, b, a + 1]),
        float(distance[c + 1, b + 1, a]),
        float(distance[c + 1, b + 1, a + 1]),
    )
    u1, v1, w1 = 1.0 - u, 1.0 - v, 1.0 - w
    best = other = codes[0]
    if (
        codes[1] != best
        or codes[2] != best
        or codes[3] != best
        or codes[4] != best
        or codes[5] != best
        or codes[6] != best
        or codes[7] != best
    ):
        held = (
            u1 * v1 * w1 * d[0],
            u * v1 * w1 * d[1],
            u1 * v * w1 * d[2],
            u * v * w1 * d[3],
            u1 * v1 * w * d[4],
            u * v1 * w * d[5],
            u1 * v * w * d[6],
            u * v * w * d[7],
        )
        most = second = -1.0
        for m in range(8):
            if codes[m] == best and most >= 0.0:
                continue
            if codes[m] == other and second >= 0.0:
                continue
            sum_of = _of(codes[m], codes, held)
            if sum_of > most:
                if codes[m] != best and most >= 0.0:
                    other, second = best, most
                best, most = codes[m], sum_of
            elif sum_of > second:
                other, second = codes[m], sum_of
    h0, h1 = _signed(codes[0], d[0], best, other), _signed(codes[1], d[1], best, other)
    h2, h3 = _signed(codes[2], d[2], best, other), _signed(codes[3], d[3], best, other)
    h4, h5 = _signed(codes[4], d[4], best, other), _signed(codes[5], d[5], best, other)
    h6, h7 = _signed(codes[6], d[6], best, other), _signed(codes[7], d[7], best, other)
    f00, f10 = u1 * h0 + u * h1, u1 * h2 + u * h3
    f01, f11 = u1 * h4 + u * h5, u1 * h6 + u * h7
    f0, f1 = v1 * f00 + v * f10, v1 * f01 + v * f11
    di = w1 * (v1 * (h1 - h0) + v * (h3 - h2)) + w * (v1 * (h5 - h4) + v * (h7 - h6))
    dj = w1 * (f10 - f00) + w * (f11 - f01)
    dk = f1 - f0
    gx = -(p[FIELD.i_x] * di + p[FIELD.j_x] * dj + p[FIELD.k_x] * dk)
    gy = -(p[FIELD.i_y] * di + p[FIELD.j_y] * dj + p[FIELD.k_y] * dk)
    gz = -(p[FIELD.i_z] * di + p[FIELD.j_z] * dj + p[FIELD.k_z] * dk)
    length = np.sqrt(gx * gx + gy * gy + gz * gz)
    turn = 1.0 / length if length > 0.0 else 0.0
    inside = UNIT * max(w1 * f0 + w * f1, 0.0)
    return best, other, inside, gx * turn, gy * turn, gz * turn


@njit
def _signed(code: int, d: float, best: int, other: int) -> float:
    return d if code == best else (-d if code == other else 0.0)


@njit
def _row(p: FloatArray, code: int) -> int:
    return int(p[FIELD.table]) + len(ROW) * code


@njit
def share_at(p: FloatArray, code: int, x: float, y: float, z: float) -> float:
    """Share of the displacement by breathing of a tissue that rests at a point of the world."""
    row = _row(p, code)
    share = p[row + ROW.share]
    if share == 0.0:
        return 0.0
    place = p[FIELD.spine] + p[FIELD.spine_x] * x + p[FIELD.spine_y] * y + p[FIELD.spine_z] * z
    share *= min(max(place, p[FIELD.spine_least]), p[FIELD.spine_most])
    if p[row + ROW.lung] != 0.0:
        depth = p[FIELD.lung] + p[FIELD.lung_x] * x + p[FIELD.lung_y] * y + p[FIELD.lung_z] * z
        share *= min(max(depth, 0.0), 2.0)
    return share


@njit
def tissue_at(
    p: FloatArray,
    labels: Any,
    distance: Any,
    x: float,
    y: float,
    z: float,
    breath: Any,
    near: float,
) -> Any:
    """Return what lies at a point of the world [m] now.

    Returned are the code of the tissue; that beyond the nearest boundary, the same for none near;
    the distance to that boundary [m], 3 mm or so where it is farther; its normal in world, out of
    the tissue, zero for none near; and the share of the displacement by breathing.

    Args:
        p: the array.
        labels: codes of the field.
        distance: of the field's voxels.
        x: of the point.
        y: of the point.
        z: of the point.
        breath: displacement of what goes along with all of it (x, y, z) [m].
        near: the share that the search begins with.
    """
    rest = at_rest(p, labels, distance, x, y, z)
    bx, by, bz = breath
    size = np.sqrt(bx * bx + by * by + bz * bz)
    if p[_row(p, rest[0]) + ROW.share] == 0.0 or size == 0.0:
        share = share_at(p, rest[0], x, y, z)
        return rest[0], rest[1], rest[2], rest[3], rest[4], rest[5], share
    share, held, seen, lies = near, False, rest, False
    for _ in range(_TURNS):
        seen = at_rest(p, labels, distance, x - share * bx, y - share * by, z - share * bz)
        lies = p[_row(p, seen[0]) + ROW.share] != 0.0
        if not lies:
            share, held = 0.5 * share, True
            continue
        now = share_at(p, seen[0], x - share * bx, y - share * by, z - share * bz)
        is_near = held or abs(now - share) * size < _NEAR
        share = share if held else now
        if is_near:
            break
    if not lies:
        return rest[0], rest[1], rest[2], rest[3], rest[4], rest[5], 0.0
    ends = p[_row(p, seen[1]) + ROW.share] == 0.0  # at rest; the wall itself has stayed
    if rest[1] != rest[0] and p[_row(p, rest[1]) + ROW.share] == 0.0:
        if ends or seen[1] == seen[0] or rest[2] < seen[2]:
            return seen[0], rest[1], rest[2], rest[3], rest[4], rest[5], share
    elif ends:
        return seen[0], seen[0], max(rest[2], seen[2]), 0.0, 0.0, 0.0, share
    return seen[0], seen[1], seen[2], seen[3], seen[4], seen[5], share


@njit
def first_wall(
    p: FloatArray,
    labels: Any,
    distance: Any,
    start: Any,
    way: Any,
    length: float,
    code: int,
    inside: float,
    breath: Any,
    near: float,
) -> tuple[float, int]:
    """Return where a straight way first leaves a tissue [m], -1 for nowhere, and into what.

    Steps are as long as the nearest boundary is away, and a quarter of a voxel at least.

    Args:
        p: the array.
        labels: codes of the field.
        distance: of the field's voxels.
        start: where it begins, in the tissue `code`, `inside` from its boundary [m].
        way: unit vector.
        length: of the way [m].
        code: of the tissue.
        inside: from its boundary [m].
        breath: see `tissue_at`.
        near: see `tissue_at`.
    """
    spacing = p[FIELD.spacing]
    low = 0.0
    for turn in range(_MOST_STEPS):
        if low >= length:
            break
        high = min(low + max(_SHORTEST * spacing, inside - _UNSURE * spacing), length)
        if turn == _MOST_STEPS - 1:
            high = length
        x, y, z = start[0] + high * way[0], start[1] + high * way[1], start[2] + high * way[2]
        seen = tissue_at(p, labels, distance, x, y, z, breath, near)
        if seen[0] != code:
            beyond = seen[0]
            for _ in range(_MOST_HALVINGS):
                if high - low <= _EXACT:
                    break
                middle = 0.5 * (low + high)
                x, y, z = (
                    start[0] + middle * way[0],
                    start[1] + middle * way[1],
                    start[2] + middle * way[2],
                )
                seen = tissue_at(p, labels, distance, x, y, z, breath, near)
                if seen[0] == code:
                    low = middle
                else:
                    high, beyond = middle, seen[0]
            return high, beyond
        low, inside = high, seen[2]
    return -1.0, code


@njit
def look_often(p: FloatArray, labels: Any, distance: Any, points: FloatArray) -> int:
    """Look points of the world up, shape (n, 3), for their cost; returns the sum of the codes."""
    total = 0
    for n in range(len(points)):
        total += at_rest(p, labels, distance, points[n, 0], points[n, 1], points[n, 2])[0]
    return total
