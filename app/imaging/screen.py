"""Hounsfield values straight into a screen's pixels: window, level and scale in one pass, compiled.

Without the interpreter lock, so that a thread beside the window's can do it. Every row of values
becomes grey as in `window.to_grey`; between the centres of four values a pixel's grey is
interpolated bilinearly, of greys, as Qt does when it draws a picture larger, with weights of
1/2048: within two thirds of a grey level. Beyond the outermost centres the edge goes on.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.core.compiled import njit
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.imaging.window import WindowLevel

_BITS: Final = 11
_ONE: Final = 1 << _BITS
_HALF: Final = 1 << (2 * _BITS - 1)


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
        raise NumericalError(
            sentence(
                "a picture of {values_shape} values on {place} px cannot be drawn",
                values_shape=values.shape,
                place=place,
            )
        )
    kind = values.dtype if values.dtype == np.int16 else np.float32
    values = np.ascontiguousarray(values, kind)[:]  # every other order would be compiled for
    values.flags.writeable = False  # and what may be written besides what may not
    out = np.empty((size[1], size[0]), np.uint32)
    span = window.width - 1.0
    gain = np.float32(255.0 / span) if span >= 1e-3 else np.float32(0.0)  # 0: a step
    middle = np.float32(window.level - 0.5)
    flip, empty = (255 if inverted else 0), 0xFF000000 | background * 0x010101
    left, top, width, height = (float(number) for number in place)
    _draw(values, middle, gain, flip, left, top, width, height, empty, out)
    return out


@njit
def _draw(
    values: NDArray[Any],
    middle: float,
    gain: float,
    flip: int,
    left: float,
    top: float,
    width: float,
    height: float,
    empty: int,
    out: NDArray[np.uint32],
) -> None:
    columns, weights = _sources(left, width, values.shape[1], out.shape[1])
    rows, row_weights = _sources(top, height, values.shape[0], out.shape[0])
    greys = np.empty(values.shape[1] + 1, np.int32)
    upper, lower = np.zeros(out.shape[1], np.int32), np.zeros(out.shape[1], np.int32)
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
            _row(values[first], middle, gain, columns, weights, greys, upper)
            held = first
        if row_weights[y] and second != below:
            _row(values[second], middle, gain, columns, weights, greys, lower)
            below = second
        weight = row_weights[y]
        for x in range(out.shape[1]):
            if columns[x] < 0:
                out[y, x] = empty
            else:
                sum_ = np.int32(upper[x] * (_ONE - weight) + lower[x] * weight + _HALF)
                grey = sum_ >> (2 * _BITS)
                out[y, x] = np.uint32(0xFF000000) | np.uint32((grey ^ flip) * 0x010101)


@njit
def _sources(
    start: float, extent: float, count: int, size: int
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """First of the two values that each pixel lies between, and `_ONE` times the second's share.

    -1 where the pixel's middle lies beside the picture.
    """
    first, weights = np.empty(size, np.int32), np.zeros(size, np.int32)
    per_pixel = count / extent
    for x in range(size):
        middle = x + 0.5 - start
        if middle < 0.0 or middle >= extent:
            first[x] = -1
            continue
        at = min(max(middle * per_pixel - 0.5, 0.0), count - 1.0)
        fixed = int(at * _ONE + 0.5)
        first[x] = fixed >> _BITS
        weights[x] = fixed & (_ONE - 1)
    return first, weights


@njit
def _row(
    row: NDArray[Any],
    middle: float,
    gain: float,
    columns: NDArray[np.int32],
    weights: NDArray[np.int32],
    greys: NDArray[np.int32],
    out: NDArray[np.int32],
) -> None:
    """Greys of a row, then those between two of them at each pixel, `_ONE` times as much."""
    count = row.shape[0]
    for at in range(count):
        greys[at] = _grey(np.float32(row[at]), middle, gain)
    greys[count] = greys[count - 1]
    for x in range(out.shape[0]):
        at = max(columns[x], 0)
        out[x] = greys[at] * (_ONE - weights[x]) + greys[at + 1] * weights[x]


@njit
def _grey(value: float, middle: float, gain: float) -> int:
    """Grey of a value, as `window.to_grey` rounds it."""
    if gain == 0.0:
        return 255 if value > middle else 0
    scaled = (value - middle) * gain + np.float32(128.0)
    return int(min(max(scaled, np.float32(0.0)), np.float32(255.0)))


STROKE: Final = 13
"""Numbers of a stroke: both ends x, y, x, y [mm], width [px], red, green, blue (0 to 255), opacity
at either end, whether its edges are smooth, length of its dashes and of the gaps [px], 0 if solid.
Of an ellipse, which has `ELLIPSE` for smooth edges: middle and half axes [mm], and in place of the
second opacity the angle of the first axis [rad], clockwise.
"""

ELLIPSE: Final = 2.0


def draw_strokes(
    pixels: NDArray[np.uint32],
    strokes: NDArray[np.float64],
    corner: tuple[float, float],
    scale: float,
    ratio: float,
) -> None:
    """Draw straight strokes and ellipses over a picture, the later ones over the earlier ones.

    A pixel is covered as far as its middle lies within the stroke, with half a pixel to either side
    of an edge that is smooth; ends are flat. Opacity changes evenly from end to end.

    Args:
        pixels: 0xAARRGGBB, premultiplied where it is not opaque, shape (height, width); drawn into.
        strokes: see `STROKE`, shape (n, `STROKE`).
        corner: place of the first pixel's outer corner [mm].
        scale: pixels for each millimetre.
        ratio: pixels for each px of widths and dashes.
    """
    _strokes(pixels, strokes, float(corner[0]), float(corner[1]), float(scale), float(ratio))


@njit
def _strokes(
    pixels: NDArray[np.uint32],
    strokes: NDArray[np.float64],
    left: float,
    top: float,
    scale: float,
    ratio: float,
) -> None:
    height, width = pixels.shape
    for number in range(strokes.shape[0]):
        row = strokes[number]
        if row[10] == ELLIPSE:
            _ellipse(pixels, row, left, top, scale, ratio)
            continue
        x0, y0 = (row[0] - left) * scale, (row[1] - top) * scale
        along, down = (row[2] - row[0]) * scale, (row[3] - row[1]) * scale
        length = np.sqrt(along * along + down * down)
        if not 1e-9 < length < 1e9:
            continue
        ux, uy = along / length, down / length
        half, soft = 0.5 * row[4] * ratio, row[10] * 0.5
        dash, period = row[11] * ratio, (row[11] + row[12]) * ratio
        reach = half + soft
        flat = abs(ux) >= abs(uy)  # by columns, else by rows
        lead = ux if flat else uy
        x1, y1 = x0 + along, y0 + down
        low, high = (min(x0, x1), max(x0, x1)) if flat else (min(y0, y1), max(y0, y1))
        first = int(max(low - reach, 0.0))
        last = int(min(high + reach + 1.0, float(width if flat else height)))
        spread, most = reach / abs(lead) + 1.0, float(height if flat else width)
        for a in range(first, last):
            middle = y0 + (a + 0.5 - x0) * uy / ux if flat else x0 + (a + 0.5 - y0) * ux / uy
            begin, end = int(max(middle - spread, 0.0)), int(min(middle + spread + 1.0, most))
            for b in range(begin, end):
                dx, dy = (a + 0.5 - x0, b + 0.5 - y0) if flat else (b + 0.5 - x0, a + 0.5 - y0)
                at, beside = dx * ux + dy * uy, abs(dx * uy - dy * ux)
                cover = _cover(at, beside, length, half, soft, dash, period)
                if cover > 0.0:
                    share = min(max(at / length, 0.0), 1.0)
                    cover *= row[8] + (row[9] - row[8]) * share
                    y, x = (b, a) if flat else (a, b)
                    pixels[y, x] = _over(pixels[y, x], row[5], row[6], row[7], cover)


@njit
def _ellipse(
    pixels: NDArray[np.uint32],
    row: NDArray[np.float64],
    left: float,
    top: float,
    scale: float,
    ratio: float,
) -> None:
    """Draw an ellipse; half axes below a quarter of a pixel are taken as that."""
    x0, y0, a, b = (row[0] - left) * scale, (row[1] - top) * scale, row[2] * scale, row[3] * scale
    if not (0.0 < b < 1e9 and 0.0 < a < 1e9):
        return
    a, b = max(a, 0.25), max(b, 0.25)
    cosine, sine = np.cos(row[9]), np.sin(row[9])
    half, soft = 0.5 * row[4] * ratio, 0.5
    dash, period = row[11] * ratio, (row[11] + row[12]) * ratio
    margin, mean = 2.0 * (half + soft) + 1.0, np.sqrt(0.5 * (a * a + b * b))
    tall = np.sqrt((a * sine) ** 2 + (b * cosine) ** 2) + margin
    height, width = pixels.shape
    for y in range(int(max(y0 - tall, 0.0)), int(min(max(y0 + tall + 1.0, 0.0), float(height)))):
        dy = y + 0.5 - y0
        begin, end = _span(dy, a + margin, b + margin, cosine, sine)
        hole, over = _span(dy, a - margin, b - margin, cosine, sine)
        x = int(max(x0 + begin, 0.0))
        last = int(min(max(x0 + end + 1.0, 0.0), float(width)))
        while x < last:
            dx = x + 0.5 - x0
            if hole < dx < over:  # nothing to draw inside
                x = max(x + 1, int(max(x0 + over, 0.0)))
                continue
            u, v = cosine * dx + sine * dy, cosine * dy - sine * dx
            cover = min(half + soft - _beside(abs(u), abs(v), a, b), 1.0)
            if cover > 0.0 and dash > 0.0:
                here = (np.arctan2(v / b, u / a) * mean) % period
                edge = max(min(here, dash - here), here - period)
                cover *= min(max(edge + soft, 0.0), 1.0)
            if cover > 0.0:
                pixels[y, x] = _over(pixels[y, x], row[5], row[6], row[7], cover * row[8])
            x += 1


@njit
def _beside(u: float, v: float, a: float, b: float) -> float:
    """Distance of a point (u, v) from an ellipse, neither of them negative.

    To the first order |k - 1| / |grad k| with k² = (u / a)² + (v / b)², exact for a circle; for a
    narrow one the nearest point is sought by the circle of curvature at the last, three times.
    """
    if 0.5 < a / b < 2.0:
        k = np.sqrt((u / a) ** 2 + (v / b) ** 2)
        steep = np.sqrt((u / (a * a)) ** 2 + (v / (b * b)) ** 2)
        return abs(k - 1.0) * k / steep if steep > 0.0 else min(a, b)
    s, t = np.sqrt(0.5), np.sqrt(0.5)
    for _ in range(3):
        centre_u, centre_v = (a * a - b * b) * s**3 / a, (b * b - a * a) * t**3 / b
        radius = np.hypot(a * s - centre_u, b * t - centre_v)
        far = max(np.hypot(u - centre_u, v - centre_v), 1e-12)
        s = min(max(((u - centre_u) * radius / far + centre_u) / a, 0.0), 1.0)
        t = min(max(((v - centre_v) * radius / far + centre_v) / b, 0.0), 1.0)
        length = max(np.hypot(s, t), 1e-12)
        s, t = s / length, t / length
    return np.hypot(u - a * s, v - b * t)


@njit
def _span(dy: float, a: float, b: float, cosine: float, sine: float) -> tuple[float, float]:
    """Return where a row crosses an ellipse about the origin; the first beyond the second if
    nowhere.
    """
    if a <= 0.0 or b <= 0.0:
        return 1.0, -1.0
    p = (cosine / a) ** 2 + (sine / b) ** 2
    q = dy * cosine * sine * (1.0 / (a * a) - 1.0 / (b * b))
    r = dy * dy * ((sine / a) ** 2 + (cosine / b) ** 2) - 1.0
    root = q * q - p * r
    if root < 0.0:
        return 1.0, -1.0
    return (-q - np.sqrt(root)) / p, (-q + np.sqrt(root)) / p


@njit
def _cover(
    at: float, beside: float, length: float, half: float, soft: float, dash: float, period: float
) -> float:
    """Return how much of a pixel a stroke covers, by its middle along and beside the stroke
    [px].
    """
    if soft == 0.0:
        if beside > half or at < 0.0 or at > length:
            return 0.0
        return 1.0 if dash <= 0.0 or at % period < dash else 0.0
    cover = min(half + soft - beside, 1.0) * min(at + soft, 1.0) * min(length - at + soft, 1.0)
    if beside > half + soft or at < -soft or at > length + soft:
        return 0.0
    if dash > 0.0:
        here = at % period
        edge = max(min(here, dash - here), here - period)  # to the nearest edge, inwards
        cover *= min(max(edge + soft, 0.0), 1.0)
    return cover


@njit
def _over(below: int, red: float, green: float, blue: float, cover: float) -> np.uint32:
    """Lay a colour over a premultiplied one."""
    keep, half = 1.0 - cover, 0.5
    a = int(cover * 255.0 + keep * ((below >> 24) & 255) + half)
    r = int(cover * red + keep * ((below >> 16) & 255) + half)
    g = int(cover * green + keep * ((below >> 8) & 255) + half)
    b = int(cover * blue + keep * (below & 255) + half)
    return np.uint32((a << 24) | (r << 16) | (g << 8) | b)
