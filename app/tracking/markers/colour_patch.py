"""Patches of the marker's colour in a picture (compiled).

A pixel is marked where the colour is strong, and strong for its brightness (see `colour`): skin and
wood are not. What is marked and touches, corners too, is one patch.
"""

import math
from typing import Any, Final

import numpy as np

from app.core.compiled import REORDERED, njit

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
