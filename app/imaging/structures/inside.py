"""Which parts of straight lines lie inside a mask, exactly.

Inside is where the mask's share, linear between voxel centres and 0 around it, is one half or
more. Between two voxel centres along each axis the share on a line is a polynomial of the third
degree of the place; where it passes one half is found in each such cell that the line runs through
(Amanatides, Woo 1987), so that nothing is missed between samples, however thin it is.
"""

from __future__ import annotations

from math import floor, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.compiled import njit

_HALF = 0.5 - 1e-9
_BISECTIONS = 60


@njit
def _corner(mask: Any, i: int, j: int, k: int) -> float:
    depth, height, width = mask.shape
    if i < 0 or j < 0 or k < 0 or i >= width or j >= height or k >= depth:
        return 0.0
    return 1.0 if mask[k, j, i] else 0.0


@njit
def _polynomial(mask: Any, start: Any, step: Any, cell: Any, out: Any) -> bool:
    """Coefficients of the share minus one half along a line in a cell; False where it is constant.

    Args:
        mask: shape (K, J, I).
        start: place of the line at 0, voxels (i, j, k) from the cell's first centre.
        step: from there to the place at 1.
        cell: its first voxel.
        out: coefficients of ascending powers, shape (4,), filled in place.
    """
    i, j, k = cell[0], cell[1], cell[2]
    c000, c100 = _corner(mask, i, j, k), _corner(mask, i + 1, j, k)
    c010, c110 = _corner(mask, i, j + 1, k), _corner(mask, i + 1, j + 1, k)
    c001, c101 = _corner(mask, i, j, k + 1), _corner(mask, i + 1, j, k + 1)
    c011, c111 = _corner(mask, i, j + 1, k + 1), _corner(mask, i + 1, j + 1, k + 1)
    total = c000 + c100 + c010 + c110 + c001 + c101 + c011 + c111
    out[0] = c000 - _HALF
    if total in (0.0, 8.0):
        return False
    a, b, c = c100 - c000, c010 - c000, c001 - c000
    ab = c110 - c100 - c010 + c000
    bc = c011 - c010 - c001 + c000
    ac = c101 - c100 - c001 + c000
    abc = c111 - c110 - c101 - c011 + c100 + c010 + c001 - c000
    x, y, z = start[0], start[1], start[2]
    u, v, w = step[0], step[1], step[2]
    out[0] += a * x + b * y + c * z + ab * x * y + bc * y * z + ac * x * z + abc * x * y * z
    out[1] = a * u + b * v + c * w
    out[1] += ab * (x * v + y * u) + bc * (y * w + z * v) + ac * (x * w + z * u)
    out[1] += abc * (y * z * u + x * z * v + x * y * w)
    out[2] = ab * u * v + bc * v * w + ac * u * w
    out[2] += abc * (x * v * w + y * u * w + z * u * v)
    out[3] = abc * u * v * w
    return True


@njit
def _value(p: Any, t: float) -> float:
    return float(p[0] + t * (p[1] + t * (p[2] + t * p[3])))


@njit
def _turns(p: Any, low: float, high: float, out: Any) -> int:
    """Places between `low` and `high` between which a polynomial only grows or falls, ends too."""
    out[0] = low
    count = 1
    a, b, c = 3.0 * p[3], 2.0 * p[2], p[1]
    first = second = low
    square = b * b - 4.0 * a * c
    if square > 0.0:  # without loss of digits where a is small
        q = -0.5 * (b + sqrt(square)) if b >= 0.0 else -0.5 * (b - sqrt(square))
        first = c / q if q != 0.0 else low
        second = q / a if a != 0.0 else low
    for turn in (min(first, second), max(first, second)):
        if low < turn < high:
            out[count] = turn
            count += 1
    out[count] = high
    return count + 1


@njit
def _crossing(p: Any, low: float, high: float) -> float:
    """Return where a polynomial of opposite signs at both ends is zero."""
    rising = _value(p, low) < 0.0
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        if (_value(p, middle) < 0.0) == rising:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@njit
def _inside(mask: Any, start: Any, end: Any, spans: Any, first_only: bool) -> int:
    """Find the spans of a line from 0 to 1 inside a mask; returns how many there are.

    Args:
        mask: shape (K, J, I).
        start: of the line, voxels (i, j, k), shape (3,).
        end: of the line.
        spans: filled in place, shape (n, 2); what does not fit is not written.
        first_only: return at the first span that begins.
    """
    low, high = 0.0, 1.0
    for axis in range(3):  # only there the share is not zero
        size = float(mask.shape[2 - axis])
        along = end[axis] - start[axis]
        if along == 0.0:
            if start[axis] <= -1.0 or start[axis] >= size:
                return 0
            continue
        one, other = (-1.0 - start[axis]) / along, (size - start[axis]) / along
        low, high = max(low, min(one, other)), min(high, max(one, other))
    if low > high:
        return 0
    count, open_span = 0, False
    p, turns, step = np.empty(4), np.empty(4), np.empty(3)
    at, cell = np.empty(3), np.empty(3, np.int64)
    now = low
    while True:
        after = high
        for axis in range(3):
            along = end[axis] - start[axis]
            place = start[axis] + now * along
            ahead = floor(place + 1e-9) + 1.0 if along > 0.0 else -floor(-place + 1e-9) - 1.0
            if along != 0.0:
                after = min(after, max((ahead - start[axis]) / along, now))
        middle = 0.5 * (now + after)
        for axis in range(3):
            along = end[axis] - start[axis]
            cell[axis] = floor(start[axis] + middle * along)
            at[axis] = start[axis] - cell[axis]
            step[axis] = along
        changes = _polynomial(mask, at, step, cell, p)
        if not changes:
            p[1] = p[2] = p[3] = 0.0
            turns[0], turns[1] = now, after
            pieces = 2
        else:
            pieces = _turns(p, now, after, turns)
        for piece in range(pieces - 1):
            begin, stop = turns[piece], turns[piece + 1]
            starts_in, stops_in = _value(p, begin) >= 0.0, _value(p, stop) >= 0.0
            if not open_span and (starts_in or stops_in):
                if count < len(spans):
                    spans[count, 0] = begin if starts_in else _crossing(p, begin, stop)
                count += 1
                open_span = True
                if first_only:
                    return count
            if open_span and not stops_in:
                if count <= len(spans):
                    spans[count - 1, 1] = _crossing(p, begin, stop) if starts_in else begin
                open_span = False
        if after >= high:
            break
        now = after
    if open_span and count <= len(spans):
        spans[count - 1, 1] = high
    return count


@njit
def _meeting(mask: Any, lines: Any, out: Any) -> None:
    spans = np.empty((1, 2))
    for n in range(lines.shape[0]):
        for piece in range(lines.shape[1] - 1):
            if _inside(mask, lines[n, piece], lines[n, piece + 1], spans, True):
                out[n] = True
                break


def _fixed(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return it read-only, as most are: each type of array is compiled by itself."""
    view = np.ascontiguousarray(mask, bool).view()
    view.setflags(write=False)
    return view


def spans_inside(mask: NDArray[np.bool_], start: FloatArray, end: FloatArray) -> FloatArray:
    """Find the parts of a straight line inside a mask.

    Args:
        mask: shape (K, J, I).
        start: of the line, voxels (i, j, k) of the mask.
        end: of the line.

    Returns:
        Begin and end of each part as shares of the line, ascending, shape (n, 2).
    """
    ends = np.array(start, np.float64), np.array(end, np.float64)
    spans = np.empty((64, 2))
    count = int(_inside(_fixed(mask), *ends, spans, False))
    if count > len(spans):
        spans = np.empty((count, 2))
        _inside(_fixed(mask), *ends, spans, False)
    return spans[:count]


def meeting(mask: NDArray[np.bool_], lines: FloatArray) -> NDArray[np.bool_]:
    """Tell which lines of straight pieces run through a mask anywhere.

    Args:
        mask: shape (K, J, I).
        lines: corners in voxels (i, j, k) of the mask, shape (n, corners, 3).

    Returns:
        Shape (n,).
    """
    found = np.zeros(len(lines), bool)
    _meeting(_fixed(mask), np.array(lines, np.float64), found)
    return found
