"""A band of which something in front hides a part: what hides it, and where the band then is.

The needle's line is known by the robot, so the band's size in the picture is, and its place across
the needle to half a pixel. Something stands before it on one of four sides: over the end towards
the hub or the tip, over the left or the right flank. For each of them the band is laid so that what
is visible of its colour ends where the band does on the other side; the edge of what hides it is
the line that parts, of the band's pixels, those in its colour from the others. What lies beyond
that line, and a little before it, says nothing.
"""

import math
from dataclasses import dataclass
from enum import Enum
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.tracking.band.outline import Outline
from app.tracking.cameras.camera import Image
from app.tracking.markers.colour import ColourModel

_PURE: Final = 0.72
"""Least strength over the brightest colour of a pixel, over that of the paint: skin has less."""

_WINDOW: Final = 8
"""What is looked at round the band [px]."""

_MARGIN_PX: Final = 2.2
"""How far before the edge of what hides it the picture says nothing: blur, and groups of pixels
that share a colour."""

_INSIDE_PX, _BESIDE_PX = 1.0, 2.0
"""How near to the band's ends or flanks, where something may stand and beside that, no pixel is
looked at: their colours are mixed."""

_MIXED: Final = 0.25
"""Most pixels on the wrong side of that edge, over the hidden ones."""

_LEAST: Final = 12
"""Fewest pixels of the band's colour."""

_CANDIDATES: Final = 4
_FEW: Final = 4
"""Fewest hidden pixels that tell where an edge is."""


class OccludedSide(Enum):
    """Where something stands before the band: direction (e, n) from its middle."""

    NOWHERE = (0, 0)
    HUB = (-1, 0)
    TIP = (1, 0)
    LEFT = (0, -1)
    RIGHT = (0, 1)


@dataclass(frozen=True, slots=True, eq=False)
class Occlusion:
    """Something before the band.

    Attributes:
        side: where it stands.
        shift: u, v of the band from the outline's place, as its visible edges say [px], shape (2,).
        pixels: what it hides, and a little more, bool (H, W), read-only.
        strength: of the band's colour where it is seen [grey levels].
        mixed: pixels on the wrong side of its edge, over the hidden ones.
    """

    side: OccludedSide
    shift: FloatArray
    pixels: NDArray[np.bool_]
    strength: float
    mixed: float


def occlusions(image: Image, outline: Outline, colour: ColourModel) -> tuple[Occlusion, ...]:
    """Return what may stand before a band, each side at most once; nothing at all is `NOWHERE`.

    Args:
        image: the picture, uint8 (H, W, 3).
        outline: of the whole band, where the robot's line passes what is seen of it.
        colour: of the marker.
    """
    height, width = image.shape[:2]
    reach = 0.75 * float(outline.arcs[1].max() - outline.arcs[0].min()) + _WINDOW
    left, top = max(0, math.floor(outline.u - reach)), max(0, math.floor(outline.v - reach))
    right = min(width, math.ceil(outline.u + reach) + 1)
    bottom = min(height, math.ceil(outline.v + reach) + 1)
    if right - left < _WINDOW or bottom - top < _WINDOW:
        return ()
    v, u = np.mgrid[top:bottom, left:right]
    e = (u - outline.u) * outline.eu + (v - outline.v) * outline.ev
    n = (v - outline.v) * outline.eu - (u - outline.u) * outline.ev
    strength, painted = _painted(image[top:bottom, left:right], colour)
    result = []
    for side in OccludedSide:
        place = _occlusion(outline, e, n, painted, side)
        if place is None:
            continue
        shift, beyond, mixed = place
        pixels = np.zeros((height, width), dtype=np.bool_)
        pixels[top:bottom, left:right] = beyond
        seen = float(np.median(strength[painted & ~beyond])) if (painted & ~beyond).any() else 0.0
        result.append(Occlusion(side, shift, read_only(pixels), seen, mixed))
    return tuple(result)


def paint_patches(image: Image, colour: ColourModel, most: float) -> list[FloatArray]:
    """Middles of what is as pure as the marker's paint, the largest first [px], each (2,).

    Args:
        image: the picture, uint8 (H, W, 3).
        colour: of the marker.
        most: largest area of a band [px²].
    """
    half = np.ascontiguousarray(image[::2, ::2])
    strength = cv2.transform(half, colour.weights[None])
    brightest = half.max(axis=2)
    mask = (strength > colour.strength) & (strength > _PURE * _own_purity(colour) * brightest)
    count, _, statistics, middles = cv2.connectedComponentsWithStats(mask.astype(np.uint8))
    areas = 4.0 * statistics[1:count, cv2.CC_STAT_AREA]
    fitting = np.flatnonzero((areas >= 4.0 * _LEAST / 2) & (areas <= most))
    largest = fitting[np.argsort(-areas[fitting])][:_CANDIDATES]
    return [2.0 * middles[1 + i] for i in largest]


def _own_purity(colour: ColourModel) -> float:
    """Strength of the marker's colour itself over its brightest part."""
    bgr = np.array(colour.bgr)
    return float(colour.weights @ bgr / bgr.max())


def _painted(window: Image, colour: ColourModel) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Return each pixel's strength, and where it is as pure as the paint that is seen."""
    bgr = window.astype(np.float64)
    strength = bgr @ colour.weights
    purity, own = strength / np.maximum(bgr.max(axis=2), 1.0), _own_purity(colour)
    paint = (strength > colour.strength) & (purity > _PURE * own)
    usual = float(np.median(purity[paint])) if paint.any() else own
    return strength, (strength > 0.5 * colour.strength) & (purity > _PURE * usual)


def _occlusion(
    outline: Outline, e: FloatArray, n: FloatArray, painted: NDArray[np.bool_], side: OccludedSide
) -> tuple[FloatArray, NDArray[np.bool_], float] | None:
    """Return the band's shift, what is hidden in the window and how mixed; None if it cannot be."""
    low, high = float(outline.arcs[0].mean()), float(outline.arcs[1].mean())
    near = painted & (n > outline.left - 2.0) & (n < outline.right + 2.0)
    if near.sum() < _LEAST:
        return None
    first, last = _extent(e[near])
    along = {OccludedSide.HUB: last - high, OccludedSide.TIP: first - low}.get(
        side, 0.5 * (first + last - low - high)
    )
    at = e - along
    whole = side is OccludedSide.NOWHERE
    long, wide = (_INSIDE_PX if whole or k else _BESIDE_PX for k in side.value)
    inside = (at > low + long) & (at < high - long)
    inside &= (n > outline.left + outline.left_slope * at + wide) & (
        n < outline.right + outline.right_slope * at - wide
    )
    hidden = inside & ~painted
    seen = inside & painted
    shift = along * np.array([outline.eu, outline.ev])
    if seen.sum() < max(_LEAST, hidden.sum()) or (hidden.sum() < _FEW) != whole:
        return None
    if whole:
        return shift, np.zeros_like(painted), 0.0
    normal, edge, wrong = _edge(at, n, seen, hidden, side)
    if wrong > _MIXED * hidden.sum():
        return None
    beyond = normal[0] * at + normal[1] * n > edge - _MARGIN_PX
    return shift, beyond, wrong / float(hidden.sum())


def _extent(values: FloatArray) -> tuple[float, float]:
    """Return the ends of what the pixels occlusion, but for stray ones."""
    first, last = np.quantile(values, (0.02, 0.98)).tolist()
    return first - 0.5, last + 0.5


_LEANS: Final = np.deg2rad(np.arange(0.0, 33.0, 3.0))
"""By how much the edge of what hides the band may lean to the band's own sides [rad]."""

_UPRIGHT: Final = 0.4
"""What a lean is worth [pixels on the wrong side a radian]: of two alike the lesser."""


def _edge(
    e: FloatArray,
    n: FloatArray,
    seen: NDArray[np.bool_],
    hidden: NDArray[np.bool_],
    side: OccludedSide,
) -> tuple[FloatArray, float, float]:
    """Straight line that parts seen and hidden pixels best.

    Returns:
        Unit normal (e, n) towards what is hidden, the line's distance from the origin along it, and
        how many pixels lie on the wrong side.
    """
    at = np.column_stack(
        [np.concatenate([e[seen], e[hidden]]), np.concatenate([n[seen], n[hidden]])]
    )
    is_hidden = np.concatenate([np.zeros(seen.sum(), np.bool_), np.ones(hidden.sum(), np.bool_)])
    best, least = (np.array(side.value, dtype=np.float64), 0.0, np.inf), np.inf
    for lean in np.concatenate([_LEANS, -_LEANS[1:]]):
        turn = np.array([[math.cos(lean), -math.sin(lean)], [math.sin(lean), math.cos(lean)]])
        normal = turn @ np.array(side.value, dtype=np.float64)
        along = at @ normal
        order = np.argsort(along)
        before = np.concatenate([[0], np.cumsum(is_hidden[order])])
        after = np.concatenate([[0], np.cumsum(~is_hidden[order])])
        wrong = before + after[-1] - after
        k = int(np.argmin(wrong))
        if wrong[k] + _UPRIGHT * abs(float(lean)) < least:
            least = wrong[k] + _UPRIGHT * abs(float(lean))
            low, high = along[order[max(0, k - 1)]], along[order[min(len(at) - 1, k)]]
            best = (normal, 0.5 * float(low + high), float(wrong[k]))
    return best
