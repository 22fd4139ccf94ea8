"""Hounsfield values straight into a screen's pixels: window, level and scale in one pass, compiled.

Without the interpreter lock, so that a thread beside the window's can do it. Between the centres
of four values a pixel's grey is interpolated bilinearly, of greys and with weights of 1/256, as Qt
does when it draws a picture larger; beyond the outermost centres the edge goes on.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.compiled import njit
from app.core.errors import NumericalError
from app.imaging.window import WindowLevel, grey_table

_HALF: Final = 1 << 15
_ONE: Final = 256


def screen_pixels(
    values: NDArray[Any],
    window: WindowLevel,
    inverted: bool,
    place: tuple[float, float, float, float],
    size: tuple[int, int],
    background: int = 0,
) -> NDArray[np.uint32]:
    """Draw a picture into pixels of 0xAARRGGBB.

    Args:
        values: int16 or float32, shape (rows, columns); copied where they are not contiguous.
        window: which of them become which grey, as in `window.to_grey`.
        inverted: whether high values are dark.
        place: left, top, width and height of the picture [px]; it may reach beyond the pixels.
        size: width and height of what is drawn into [px].
        background: grey of pixels whose middle lies beside the picture, 0 to 255.

    Returns:
        Shape (height, width).

    Raises:
        NumericalError: if there are no values, or the picture has no size.
    """
    if values.ndim != 2 or not values.size or min(place[2:]) <= 0.0:
        raise NumericalError(f"a picture of {values.shape} values on {place} px cannot be drawn")
    values = np.ascontiguousarray(values)  # every other order would be compiled for
    width, height = size
    out = np.empty((height, width), np.uint32)
    rows, row_weights = _sources(place[1], place[3], values.shape[0], height)
    columns, column_weights = _sources(place[0], place[2], values.shape[1], width)
    flip, empty = (255 if inverted else 0), 0xFF000000 | background * 0x010101
    if values.dtype == np.int16:
        table = grey_table(window)
        _by_table(values, table, flip, rows, row_weights, columns, column_weights, empty, out)
        return out
    span = window.width - 1.0
    gain = np.float32(255.0 / span) if span >= 1e-3 else np.float32(0.0)  # 0: a step
    middle = np.float32(window.level - 0.5)
    values = values.astype(np.float32, copy=False)
    _by_line(values, middle, gain, flip, rows, row_weights, columns, column_weights, empty, out)
    return out


def _sources(
    start: float, extent: float, count: int, size: int
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """First of the two values that each pixel lies between, and 256 times the share of the second.

    -1 where the pixel's middle lies beside the picture.
    """
    middles = np.arange(size) + 0.5 - start
    fixed = np.floor((middles * (count / extent) - 0.5) * _ONE + 0.5).astype(np.int64)
    fixed = np.clip(fixed, 0, (count - 1) * _ONE)
    first = fixed >> 8
    first[(middles < 0.0) | (middles >= extent)] = -1
    return first.astype(np.int32), (fixed & (_ONE - 1)).astype(np.int32)


@njit
def _blend(
    upper: NDArray[np.int32],
    lower: NDArray[np.int32],
    weight: int,
    flip: int,
    columns: NDArray[np.int32],
    empty: int,
    out: NDArray[np.uint32],
) -> None:
    for x in range(out.shape[0]):
        if columns[x] < 0:
            out[x] = empty
        else:
            grey = (upper[x] * (_ONE - weight) + lower[x] * weight + _HALF) >> 16
            out[x] = np.uint32(0xFF000000) | np.uint32((grey ^ flip) * 0x010101)


@njit
def _row_by_table(
    row: NDArray[np.int16],
    table: NDArray[np.uint8],
    columns: NDArray[np.int32],
    weights: NDArray[np.int32],
    out: NDArray[np.int32],
) -> None:
    last = row.shape[0] - 1
    for x in range(out.shape[0]):
        at = max(columns[x], 0)
        one = np.int32(table[np.uint16(row[at])])
        other = np.int32(table[np.uint16(row[min(at + 1, last)])])
        out[x] = one * (_ONE - weights[x]) + other * weights[x]


@njit
def _by_table(
    values: NDArray[np.int16],
    table: NDArray[np.uint8],
    flip: int,
    rows: NDArray[np.int32],
    row_weights: NDArray[np.int32],
    columns: NDArray[np.int32],
    weights: NDArray[np.int32],
    empty: int,
    out: NDArray[np.uint32],
) -> None:
    upper, lower = np.empty(out.shape[1], np.int32), np.empty(out.shape[1], np.int32)
    held, below = -1, -1
    for y in range(out.shape[0]):
        first = rows[y]
        if first < 0:
            out[y, :] = empty
            continue
        second = min(first + 1, values.shape[0] - 1)
        if first == below:  # one row further down
            upper, lower, held, below = lower, upper, below, -1
        if first != held:
            _row_by_table(values[first], table, columns, weights, upper)
            held = first
        if second != below:
            _row_by_table(values[second], table, columns, weights, lower)
            below = second
        _blend(upper, lower, row_weights[y], flip, columns, empty, out[y])


@njit
def _grey(value: float, middle: float, gain: float) -> int:
    """Grey of a value, as `window.to_grey` rounds it."""
    if gain == 0.0:
        return 255 if value > middle else 0
    scaled = (value - middle) * gain + np.float32(128.0)
    return int(min(max(scaled, np.float32(0.0)), np.float32(255.0)))


@njit
def _row_by_line(
    row: NDArray[np.float32],
    middle: float,
    gain: float,
    columns: NDArray[np.int32],
    weights: NDArray[np.int32],
    out: NDArray[np.int32],
) -> None:
    last = row.shape[0] - 1
    for x in range(out.shape[0]):
        at, share = max(columns[x], 0), weights[x]
        grey = _grey(row[at], middle, gain) * (_ONE - share)
        if share:
            grey += _grey(row[min(at + 1, last)], middle, gain) * share
        out[x] = grey


@njit
def _by_line(
    values: NDArray[np.float32],
    middle: float,
    gain: float,
    flip: int,
    rows: NDArray[np.int32],
    row_weights: NDArray[np.int32],
    columns: NDArray[np.int32],
    weights: NDArray[np.int32],
    empty: int,
    out: NDArray[np.uint32],
) -> None:
    upper, lower = np.empty(out.shape[1], np.int32), np.empty(out.shape[1], np.int32)
    held, below = -1, -1
    for y in range(out.shape[0]):
        first = rows[y]
        if first < 0:
            out[y, :] = empty
            continue
        second = min(first + 1, values.shape[0] - 1)
        if first == below:  # one row further down
            upper, lower, held, below = lower, upper, below, -1
        if first != held:
            _row_by_line(values[first], middle, gain, columns, weights, upper)
            held = first
        if row_weights[y] and second != below:
            _row_by_line(values[second], middle, gain, columns, weights, lower)
            below = second
        _blend(upper, lower, row_weights[y], flip, columns, empty, out[y])
