"""The marker's colour: what counts as it, and how it is learned from a click.

A paint under more or less of the same light keeps the direction of its colour (blue, green, red as
a vector), whatever the exposure; grey things lie on the diagonal. So a pixel's *strength* is its
colour times weights that add up to zero (grey gives zero), and a patch has the marker's colour if
the angle of its mean colour to the learned one is small. The threshold of the strength follows the
strongest in view, so that less light needs no other setting.

A patch (compiled): a pixel is marked where the colour is strong, and strong for its brightness:
skin and wood are not. What is marked and touches, corners too, is one patch.
"""

import math
from functools import cached_property
from typing import Any, Final

import numpy as np
from pydantic import Field

from app.core.arrays import FloatArray, read_only, unit
from app.core.compiled import REORDERED, njit
from app.core.configuration import Strict
from app.tracking.cameras.camera import Image
from app.tracking.errors import TrackingError

_NEAR: Final = 24
"""Where the strongest pixel is looked for that sets the threshold [px], half width."""

_PURITY: Final = 0.3
"""Least strength over the brightest colour of a pixel: skin and wood have less."""

_SINGLE: Final = 0.01
"""More than single precision is off in a strength [grey levels]."""

_SPECK: Final = 6.0
_SPECK_SHARE: Final = 0.2
"""Least area of a patch [px²], and over that of the largest."""


@njit
def _strength(image: Any, v: int, u: int, weights: Any) -> float:
    return weights[0] * image[v, u, 0] + weights[1] * image[v, u, 1] + weights[2] * image[v, u, 2]


@njit
def _is_pure(image: Any, v: int, u: int, weights: Any, strength: float) -> bool:
    """Whether the strength is enough for the brightness of the marker's main colours."""
    bright = 0.0
    for k in range(3):
        if weights[k] == 1.0:
            bright += image[v, u, k]
    return strength - _PURITY * bright >= 0.5


@njit
def mark_half(image: Any, weights: Any, least: float, mask: Any, box: Any) -> bool:
    """Mark every second pixel of every second row; False if there is none to mark.

    Args:
        image: uint8 (H, W, 3).
        weights: see `colour.ColourModel.weights`.
        least: strength of a pixel [grey levels].
        mask: out, uint8 ((H + 1) // 2, (W + 1) // 2).
        box: out, left, top, right, bottom of what is marked [px of the mask], the last two
            exclusive.
    """
    height, width = mask.shape
    box[0], box[1], box[2], box[3] = width, height, 0, 0
    for v in range(height):
        mask[v] = 0
        if not _any_strong(image, 2 * v, weights, least):
            continue
        for u in range(width):
            strength = _strength(image, 2 * v, 2 * u, weights)
            if strength >= least and _is_pure(image, 2 * v, 2 * u, weights, strength):
                mask[v, u] = 1
                box[0], box[1] = min(box[0], u), min(box[1], v)
                box[2], box[3] = max(box[2], u + 1), max(box[3], v + 1)
    return box[2] > box[0]


@njit(fastmath=REORDERED, forceinline=True)
def _any_strong(image: Any, v: int, weights: Any, least: float) -> bool:
    """Whether any second pixel of a row may be strong enough: without a branch, eight at a time."""
    blue, green, red = np.float32(weights[0]), np.float32(weights[1]), np.float32(weights[2])
    limit = np.float32(least - _SINGLE)
    some: Any = False
    for u in range((image.shape[1] + 1) // 2):
        strength = (
            blue * np.float32(image[v, 2 * u, 0])
            + green * np.float32(image[v, 2 * u, 1])
            + red * np.float32(image[v, 2 * u, 2])
        )
        some |= strength >= limit
    return some


@njit
def nearest_patch(
    image: Any,
    region: Any,
    u: float,
    v: float,
    weights: Any,
    least: float,
    share: float,
    labels: Any,
    box: Any,
    centre: Any,
) -> int:
    """Label of the patch nearest to a pixel in a region; 0 if there is none.

    Args:
        image: uint8 (H, W, 3).
        region: left, top, right, bottom [px]; the last two exclusive.
        u: column of the pixel, in the picture.
        v: its row.
        weights: see `colour.ColourModel.weights`.
        least: strength of a pixel [grey levels].
        share: of the strongest pixel nearby that a pixel must have.
        labels: out, int32, of the region's size: the patches' numbers, 0 outside them.
        box: out, left, top, width, height of the patch in the region [px].
        centre: out, mean pixel of the patch in the picture, (2,).
    """
    left, top = region[0], region[1]
    height, width = region[3] - top, region[2] - left
    strengths = np.empty((height, width), np.float32)
    _measure(image, top, left, weights, strengths)
    x, y = round(u) - left, round(v) - top
    rows = slice(max(0, y - _NEAR), max(0, y + _NEAR))
    near = strengths[rows, max(0, x - _NEAR) : max(0, x + _NEAR)]
    strongest = min(255.0, near.max()) if near.size else 0.0
    if strongest < least:
        strongest = min(255.0, strengths.max())
    limit = max(math.floor(least) + 0.5, share * strongest)
    for j in range(height):
        for i in range(width):
            pure = strengths[j, i] >= limit and _is_pure(
                image, top + j, left + i, weights, strengths[j, i]
            )
            labels[j, i] = -1 if pure else 0
    return _choose(labels, left, top, u, v, box, centre)


@njit(fastmath=REORDERED)
def _measure(image: Any, top: int, left: int, weights: Any, strengths: Any) -> None:
    """Strength of every pixel: without a branch, eight at a time."""
    blue, green, red = np.float32(weights[0]), np.float32(weights[1]), np.float32(weights[2])
    for j in range(strengths.shape[0]):
        for i in range(strengths.shape[1]):
            strengths[j, i] = (
                blue * np.float32(image[top + j, left + i, 0])
                + green * np.float32(image[top + j, left + i, 1])
                + red * np.float32(image[top + j, left + i, 2])
            )


@njit
def _choose(labels: Any, left: int, top: int, u: float, v: float, box: Any, centre: Any) -> int:
    """Fill box and centre of the nearest patch that is no speck beside the largest; its number.

    What is nearer than the largest so far may be a speck beside one that comes later: only then
    are the patches gone through once more.
    """
    stack = np.empty((labels.size, 2), np.int32)
    largest = 0
    for attempt in range(2):
        count, best, smallest, nearest = 0, 0, 0, np.inf
        for j in range(labels.shape[0]):
            for i in range(labels.shape[1]):
                if labels[j, i] != -1:
                    continue
                count += 1
                area, low, high, first, last, su, sv = _flood(labels, j, i, count, stack)
                largest = max(largest, area)
                mu, mv = left + su / area, top + sv / area
                distance = math.hypot(mu - u, mv - v)
                if area >= max(_SPECK, _SPECK_SHARE * largest) and distance < nearest:
                    best, nearest, smallest = count, distance, area
                    box[0], box[1], box[2], box[3] = first, low, last - first + 1, high - low + 1
                    centre[0], centre[1] = mu, mv
        if attempt or not best or smallest >= _SPECK_SHARE * largest:
            break
        for j in range(labels.shape[0]):
            for i in range(labels.shape[1]):
                labels[j, i] = -1 if labels[j, i] else 0
    return best


@njit
def _flood(labels: Any, j: int, i: int, label: int, stack: Any) -> Any:
    """Label a patch; returns its area, rows, columns, and the sums of columns and of rows."""
    height, width = labels.shape
    low, high, first, last = j, j, i, i
    area, su, sv, waiting = 0, 0.0, 0.0, 1
    stack[0, 0], stack[0, 1] = j, i
    labels[j, i] = label
    while waiting > 0:
        waiting -= 1
        b, a = stack[waiting, 0], stack[waiting, 1]
        area += 1
        su += a
        sv += b
        low, high, first, last = min(low, b), max(high, b), min(first, a), max(last, a)
        for q in range(max(0, b - 1), min(height, b + 2)):
            for p in range(max(0, a - 1), min(width, a + 2)):
                if labels[q, p] == -1:
                    labels[q, p] = label
                    stack[waiting, 0], stack[waiting, 1] = q, p
                    waiting += 1
    return area, low, high, first, last, su, sv


_CLICK = 2
_WINDOW = 24
_LEAST_STRENGTH = 25.0


class ColourModel(Strict):
    """The marker's colour as settings keep it.

    Attributes:
        bgr: its colour [grey levels]; only the direction counts.
        angle_deg: largest angle of a patch's mean colour to it.
        strength: least strength of a pixel [grey levels].
        share: of the strongest pixel nearby that a pixel must have.
    """

    bgr: tuple[float, float, float] = (44.0, 26.0, 205.0)
    angle_deg: float = Field(default=18.0, gt=0.0, le=45.0)
    strength: float = Field(default=_LEAST_STRENGTH, ge=5.0, le=200.0)
    share: float = Field(default=0.35, gt=0.0, lt=1.0)

    @cached_property
    def weights(self) -> FloatArray:
        """Of blue, green and red in the strength, shape (3,): they add up to 0, the largest is 1.

        Raises:
            TrackingError: if the colour is grey.
        """
        colour = np.array(self.bgr)
        free = colour - colour.mean()
        if not free.max() > 0.05 * max(colour.max(), 1.0):
            raise TrackingError(
                f"the marker's colour {self.bgr} (blue, green, red) is grey; a marker needs a "
                "colour that nothing else has: click on its middle, not on the shaft"
            )
        return read_only(free / free.max())

    def angle(self, bgr: FloatArray) -> float:
        """Angle of a colour to the marker's [deg]; 90 for black."""
        colour = bgr.tolist()
        length = math.hypot(*colour)
        if length < 1.0:
            return 90.0
        cosine = sum(a * b for a, b in zip(self._direction, colour, strict=True)) / length
        return math.degrees(math.acos(min(1.0, cosine)))

    @cached_property
    def _direction(self) -> tuple[float, float, float]:
        blue, green, red = unit(np.array(self.bgr)).tolist()
        return blue, green, red

    def is_marker(self, bgr: FloatArray) -> bool:
        """Whether a patch of this mean colour may be the marker."""
        return self.angle(bgr) <= self.angle_deg

    def threshold(self, strongest: float) -> float:
        """Least strength of a pixel where the strongest nearby is `strongest` [grey levels]."""
        return max(self.strength, self.share * strongest)


RED = ColourModel()
"""A matt red, as the shipped rigs have it."""


def learn(image: Image, uv: FloatArray) -> ColourModel:
    """Learn the colour from a click on the marker.

    The colour is the mean of what is like the clicked spot; the angle is half the way to the
    nearest colour of the surroundings that is strong enough to be taken for it, 8° to 25°.

    Args:
        image: the picture.
        uv: the click [px], shape (2,).

    Raises:
        TrackingError: if the click is outside the picture, on grey, or on something overexposed.
    """
    height, width = image.shape[:2]
    u, v = np.rint(np.asarray(uv, dtype=np.float64)).astype(int)
    if not (_CLICK <= u < width - _CLICK and _CLICK <= v < height - _CLICK):
        raise TrackingError(f"the click at ({u}, {v}) is outside the picture of {width}x{height}")
    spot = image[v - _CLICK : v + _CLICK + 1, u - _CLICK : u + _CLICK + 1].reshape(-1, 3)
    if (spot >= 254).any(axis=1).mean() > 0.25:
        raise TrackingError("the marker is overexposed where you clicked; lower exposure or light")
    window = image[max(0, v - _WINDOW) : v + _WINDOW + 1, max(0, u - _WINDOW) : u + _WINDOW + 1]
    colours = window.reshape(-1, 3).astype(np.float64)
    clicked = ColourModel(bgr=_triple(np.median(spot, axis=0)))
    strength = colours @ clicked.weights
    strongest = float(np.median(spot.astype(np.float64) @ clicked.weights))
    if strongest < _LEAST_STRENGTH:
        raise TrackingError(
            f"the colour at ({u}, {v}) is nearly grey (strength {strongest:.0f}, at least "
            f"{_LEAST_STRENGTH:.0f} is needed): click on the middle of the marker"
        )
    angles = _angles(colours, np.array(clicked.bgr))
    strong = strength > 0.5 * strongest
    same = strong & (angles < 12.0)
    mean = colours[same].mean(axis=0)
    others = _angles(colours[strong & ~same], mean)
    limit = 0.5 * float(np.percentile(others, 5)) if others.size > 20 else 18.0
    return ColourModel(
        bgr=_triple(mean),
        angle_deg=float(np.clip(limit, 8.0, 25.0)),
        strength=float(np.clip(0.15 * strongest, 10.0, _LEAST_STRENGTH)),
    )


def _angles(colours: FloatArray, colour: FloatArray) -> FloatArray:
    lengths = np.maximum(np.linalg.norm(colours, axis=1), 1.0)
    cosine = colours @ unit(colour) / lengths
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _triple(colour: FloatArray) -> tuple[float, float, float]:
    blue, green, red = (round(float(value), 1) for value in colour)
    return blue, green, red
