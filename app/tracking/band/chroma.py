"""The colour-difference planes of a delivered picture, at the resolution that they have (compiled).

A JPEG of a camera keeps brightness at every pixel and both colour differences for two or four
pixels together (4:2:2, 4:2:0): the encoder takes their mean, the decoder fills them in between,
by ¾ of the nearer and ¼ of the farther one ("fancy upsampling" of libjpeg) or by repeating. So of
values c that were filled in like that, at the pixels 2k - 1 to 2k + 2 the third difference is
nothing: it tells such a plane from one of full resolution, and gives the values back.
"""

from typing import Any, Final

import numpy as np

from app.core.compiled import njit

RED_LUMA: Final = 0.299
GREEN_LUMA: Final = 0.587
BLUE_LUMA: Final = 0.114
"""Brightness of JPEG (ITU-T T.871), of red, green and blue."""

FULL: Final = 0
FILLED: Final = 1
REPEATED: Final = 2
"""How a plane was brought to full resolution along a direction: not at all, or how."""

_LESS: Final = 0.35
"""Energy of the difference that is to vanish, over that of the same difference one pixel on."""

_ROUNDED: Final = 1.6
"""Energy of a third difference that the rounding of the decoded colours makes [grey levels²]."""


@njit
def luma_chroma(image: Any, left: int, top: int, right: int, bottom: int) -> Any:
    """Return brightness (h, w) and both colour differences (2, h, w) of a part of a picture."""
    height, width = bottom - top, right - left
    luma, chroma = np.empty((height, width)), np.empty((2, height, width))
    for v in range(height):
        for u in range(width):
            b, g, r = (
                float(image[top + v, left + u, 0]),
                float(image[top + v, left + u, 1]),
                float(image[top + v, left + u, 2]),
            )
            luma[v, u] = RED_LUMA * r + GREEN_LUMA * g + BLUE_LUMA * b
            chroma[0, v, u] = -0.168736 * r - 0.331264 * g + 0.5 * b
            chroma[1, v, u] = 0.5 * r - 0.418688 * g - 0.081312 * b
    return luma, chroma


@njit
def filled_in(plane: Any, first: int) -> int:
    """Tell how a plane was brought to full resolution along its rows: FULL, FILLED or REPEATED.

    Args:
        plane: (h, w).
        first: column of the picture that the plane's first one is.
    """
    third, single = np.zeros(2), np.zeros(2)
    count = np.zeros(2)
    for v in range(plane.shape[0]):
        for u in range(1, plane.shape[1] - 2):
            phase = (first + u) % 2
            t = plane[v, u + 2] - 3.0 * plane[v, u + 1] + 3.0 * plane[v, u] - plane[v, u - 1]
            s = plane[v, u + 1] - plane[v, u]
            third[phase] += t * t
            single[phase] += s * s
            count[phase] += 1.0
    if count.min() < 8.0:
        return FULL
    third /= count
    single /= count
    if single[0] < _LESS * single[1] and single[0] < 1.0:
        return REPEATED
    if third[0] < _LESS * third[1] + _ROUNDED and third[0] < third[1]:
        return FILLED
    return FULL


@njit
def halved(plane: Any, first: int, how: int) -> Any:
    """Values that a plane was filled in from, two columns each: (h, n), and the first's column.

    Args:
        plane: (h, w).
        first: column of the picture that the plane's first one is; a value is of two columns that
            begin with an even one.
        how: FILLED or REPEATED.
    """
    start = first % 2
    if how == FILLED and start == 0:
        start = 2  # the value before it is looked at too
    stop = plane.shape[1] - (3 if how == FILLED else 1)
    count = max(0, (stop - start + 1) // 2)
    values = np.empty((plane.shape[0], count))
    for v in range(plane.shape[0]):
        for k in range(count):
            u = start + 2 * k
            if how == FILLED:
                values[v, k] = 0.25 * (
                    3.0 * plane[v, u] - plane[v, u - 1] + 3.0 * plane[v, u + 1] - plane[v, u + 2]
                )
            else:
                values[v, k] = 0.5 * (plane[v, u] + plane[v, u + 1])
    return values, start


@njit
def true_chroma(chroma: Any, left: int, top: int) -> Any:
    """Colour differences at their own resolution: values (2, m, n), where they begin, their size.

    Args:
        chroma: both planes at full resolution, (2, h, w).
        left: column of the picture that the planes' first one is.
        top: row of it.

    Returns:
        Values; column and row of the first value's first pixel in the planes; columns and rows of
        pixels that a value is the mean of.
    """
    height = chroma.shape[1]
    across = filled_in(chroma[1], left)
    down = filled_in(np.ascontiguousarray(chroma[1].T), top)
    u0, v0, du, dv = 0, 0, 1, 1
    planes = chroma
    if across != FULL:
        a, u0 = halved(planes[0], left, across)
        b, u0 = halved(planes[1], left, across)
        planes, du = np.empty((2, height, a.shape[1])), 2
        planes[0], planes[1] = a, b
    if down != FULL:
        a, v0 = halved(np.ascontiguousarray(planes[0].T), top, down)
        b, v0 = halved(np.ascontiguousarray(planes[1].T), top, down)
        narrow = np.empty((2, a.shape[1], planes.shape[2]))
        narrow[0], narrow[1] = a.T, b.T
        planes, dv = narrow, 2
    return planes, u0, v0, du, dv
