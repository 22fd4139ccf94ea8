"""The ends of the band (compiled): the arc at which its picture turns into the shaft's.

See `edge_fit` for what a pixel mixes there.
"""

import math
from typing import Any, Final

import numpy as np

from app.core.compiled import njit
from app.tracking.markers.edge_samples import bell, below, mean_colour, place
from app.tracking.markers.four_edges import arc
from app.tracking.markers.matting import mixture

RIM: Final = 1.9
"""Half width of the rim [standard deviations of the blurred edge]."""

OFF: Final = 3.0
"""From the edge to the first sample [the same]."""

_STEEPEST: Final = 2.5
"""Slope of an end's arc beyond which the rim is not widened."""

_PAINT_SD: Final = 0.03
_SHAFT_SD: Final = 0.05
_THINNER_SD: Final = 0.3
"""What is left free, relative: brightness of paint and shaft, and of S's way to background near the
flanks."""

_NODES: Final = np.array([0.0, -1.3556262, 1.3556262, -2.8569700, 2.8569700])
_WEIGHTS: Final = np.array([0.5333333, 0.2220759, 0.2220759, 0.0112574, 0.0112574])
"""Gauss-Hermite: the end's arc is curved within the point spread."""


@njit
def tip_end(window: Any, edges: Any) -> int:
    """Find the end beyond which the needle is thinner, 0 for that of the lower x.

    There the colours at the flanks are the background's.
    """
    shaft, ground, different = np.empty(3), np.empty(3), np.zeros(2)
    for end in range(2):
        sign = 2.0 * end - 1.0
        for side in range(2):
            across = 2.0 * side - 1.0
            x = arc(edges, end, 0.8 * across) + 3.0 * sign
            edge = edges[4 + 2 * side] + edges[5 + 2 * side] * x
            mean_colour(window, edges, x, edge - 0.8 * across, sign, 0.0, 3, shaft)
            mean_colour(window, edges, x, edge + 3.0 * across, sign, 0.0, 3, ground)
            for k in range(3):
                different[end] += (shaft[k] - ground[k]) ** 2
    return 1 if different[1] < different[0] else 0


@njit
def _narrowing(edges: Any, end: int, tip: int, needle: Any, x: float) -> float:
    """How wide the needle is at x, beyond an end, over the shaft."""
    if end != tip:
        return 1.0
    first = edges[8] + 0.785 * edges[9]  # mean of the arc: π/4 of its rise
    last = edges[11] + 0.785 * edges[12]
    middle, half = 0.5 * (first + last), 0.5 * (last - first)
    at = (x - middle) / half * (2.0 * end - 1.0)
    if at <= needle[1]:
        return 1.0
    return min(1.0, max(0.05, (needle[0] - at) / (needle[0] - needle[1])))


@njit
def _shaft_colour(
    window: Any, edges: Any, end: int, tip: int, needle: Any, x: float, y: float, middle: float,
    start: float, out: Any, one: Any,
) -> None:  # fmt: skip
    """Mean colour of what is seen further outside at the same place between the shaft's edges."""
    sign = 2.0 * end - 1.0
    here = _narrowing(edges, end, tip, needle, x)
    out[:] = 0.0
    for i in range(4):
        at = start + sign * i
        across = middle + (y - middle) * _narrowing(edges, end, tip, needle, at) / here
        mean_colour(window, edges, at, across, 0.0, 0.0, 1, one)
        for k in range(3):
            out[k] += 0.25 * one[k]


@njit
def _end_share(
    edges: Any, end: int, x: float, z: float, half: float, spread: float, row: Any
) -> float:
    """Share of a pixel that lies before an end, and its derivatives by c, q and t of the arc."""
    sign = 2.0 * end - 1.0
    total, share = 0.0, 0.0
    row[:] = 0.0
    for i in range(_NODES.shape[0]):
        at = z + _NODES[i] * spread / half
        if abs(at) > 1.0:
            continue
        h = sign * (arc(edges, end, at) - x) / spread
        weight = _WEIGHTS[i]
        rise = weight * sign * bell(h) / spread
        total += weight
        share += weight * below(h)
        row[0] += rise
        row[1] += rise * math.sqrt(1.0 - at * at)
        row[2] += rise * at
    if total == 0.0:
        return 0.0
    for k in range(3):
        row[k] /= total
    return share / total


@njit
def fit_end(
    window: Any, edges: Any, end: int, tip: int, needle: Any, spread: float, noise: float,
    covariance: Any,
) -> Any:  # fmt: skip
    """Move an end's arc; how many pixels are mixtures, and of how many."""
    inner, outer, beside, one = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    ease, normal, right, row = np.zeros((2, 3)), np.zeros((3, 3)), np.zeros(3), np.empty(3)
    good, count, off, sign = 0, 0, OFF * spread, 2.0 * end - 1.0
    for v in range(window.shape[0]):
        for u in range(window.shape[1]):
            x, y, low, high, z = place(edges, u, v)
            half, middle = 0.5 * (high - low), 0.5 * (high + low)
            inside = min(0.95, max(-0.95, z))
            at = arc(edges, end, inside)
            slope = (arc(edges, end, inside + 0.05) - arc(edges, end, inside - 0.05)) / 0.1
            wide = math.sqrt(1.0 + min(_STEEPEST, abs(slope) / half) ** 2)
            if abs(z) > 1.0 or abs(x - at) > RIM * spread * wide:
                continue
            reach = RIM * spread * wide + off - RIM * spread
            length = abs(at - arc(edges, 1 - end, inside))
            steps = min(6, max(1, int(length - reach - off)))
            expected = _end_share(edges, end, x, z, half, spread, row)
            mean_colour(window, edges, at - sign * reach, y, -sign, 0.0, steps, inner)
            _shaft_colour(
                window, edges, end, tip, needle, x, y, middle, at + sign * reach, outer, one
            )
            edge = high + 3.5 * spread if z > 0.0 else low - 3.5 * spread
            mean_colour(window, edges, x, edge, 0.0, 1.0 if z > 0.0 else -1.0, 3, beside)
            near = _THINNER_SD * below(3.0 - half * (1.0 - abs(z)) / spread)
            for k in range(3):
                ease[0, k] = _PAINT_SD * expected * inner[k]
                ease[1, k] = (1.0 - expected) * (
                    near * (beside[k] - outer[k]) + _SHAFT_SD * outer[k]
                )
            told, doubt, contrast = mixture(window[v, u], inner, outer, ease, noise)
            if contrast < 4.0:
                continue
            count += 1
            good += -0.3 < told < 1.3
            told = min(1.3, max(-0.3, told)) - expected
            for i in range(3):
                right[i] += row[i] * told / doubt
                for j in range(3):
                    normal[i, j] += row[i] * row[j] / doubt
    if count < 4:
        return 0, 0
    normal[1, 1] += 0.1
    normal[2, 2] += 1.0  # weak: the arcs are as wide and upright as they were to a pixel or so
    inverse = np.linalg.inv(normal)
    change = inverse @ right
    edges[8 + 3 * end : 11 + 3 * end] += change
    covariance[3 + 3 * end : 6 + 3 * end, 3 + 3 * end : 6 + 3 * end] = inverse
    return good, count
