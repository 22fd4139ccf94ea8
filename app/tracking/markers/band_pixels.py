"""Which pixels of a picture the fit looks at (compiled)."""

import math
from typing import Any, Final

import numpy as np

from app.core.compiled import njit

_SIDE_PX: Final = 9.0
_HUB_PX: Final = 6.0
_TIP_PX: Final = 6.0
"""What is looked at beside the band and beyond its ends: a highlight moves along the shaft."""

_BRIGHTEST: Final = 254
"""A colour from here on may be cut off."""


@njit
def surroundings(frame: Any, arcs: Any, height: int, width: int, box: Any) -> bool:
    """Fill the box of the pixels to look at; False if the band's centre is outside the picture.

    Args:
        frame: see `band_outline.outline`.
        arcs: likewise.
        height: of the picture [px].
        width: likewise.
        box: out, left, top, right, bottom [px], cut at the picture's edge; the last two exclusive.
    """
    if not (0.0 <= frame[0] < width and 0.0 <= frame[1] < height):
        return False
    left, top, right, bottom = np.inf, np.inf, -np.inf, -np.inf
    for end in range(2):
        e = arcs.max() + _TIP_PX if end else arcs.min() - _HUB_PX
        for side in range(2):
            n = frame[6] + _SIDE_PX if side else frame[4] - _SIDE_PX
            u = frame[0] + e * frame[2] - n * frame[3]
            v = frame[1] + e * frame[3] + n * frame[2]
            left, right = min(left, u), max(right, u)
            top, bottom = min(top, v), max(bottom, v)
    box[0], box[1] = max(0, math.floor(left)), max(0, math.floor(top))
    box[2], box[3] = min(width, math.ceil(right) + 1), min(height, math.ceil(bottom) + 1)
    return True


@njit
def gather(
    image: Any,
    box: Any,
    frame: Any,
    arcs: Any,
    room: float,
    pixels: Any,
    colours: Any,
    usable: Any,
    sides: Any,
    clear: Any,
) -> int:
    """Collect the pixels near the band, row by row; returns how many.

    Args:
        image: uint8 (H, W, 3).
        box: see `surroundings`.
        frame: see `band_outline.outline`.
        arcs: likewise.
        room: from the needle's outline to what is background only [px].
        pixels: out, u and v from the frame's origin, (m, 2), m at least the box's.
        colours: out, (m, 3).
        usable: out, whether no colour is cut off, (m,).
        sides: out, which side of the needle's middle, (m,).
        clear: out, the box with 1 or 2 where there is but background of a side, 0 elsewhere.
    """
    low, high = arcs.min() - _HUB_PX, arcs.max() + _TIP_PX
    middle, count = 0.5 * (frame[4] + frame[6]), 0
    for v in range(box[1], box[3]):
        for u in range(box[0], box[2]):
            du, dv = u - frame[0], v - frame[1]
            e, n = du * frame[2] + dv * frame[3], dv * frame[2] - du * frame[3]
            mark = 0
            if low < e < high and frame[4] - _SIDE_PX < n < frame[6] + _SIDE_PX:
                mark = 2 if n > frame[6] + room else (1 if n < frame[4] - room else 0)
                pixels[count, 0], pixels[count, 1] = du, dv
                brightest = 0
                for c in range(3):
                    colours[count, c] = image[v, u, c]
                    brightest = max(brightest, image[v, u, c])
                usable[count] = brightest < _BRIGHTEST
                sides[count] = 1 if n > middle else 0
                count += 1
            clear[v - box[1], u - box[0]] = mark
    return count
