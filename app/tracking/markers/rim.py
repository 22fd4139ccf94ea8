"""The rim of the band in a window: from a rough mask to its area, centroid and their noise.

First the shares that the band covers (see `matting`), in a wide rim round a rough mask; they lead
to the band's four edges (below). Then the shares again, only in a rim round the outline as
wide as the edge is blurred, what lies within counting as one: their sum stands in where there are
no four edges, or an edge of the background was taken for one.

The band's four edges to a few hundredths of a pixel, and the centroid between them (compiled).

Each pixel near an edge says which share of it lies inside, and the edge (see `four_edges`) is moved
until the shares of a blurred edge agree with these in the least squares, weighted by their noise.
The flanks are as parallel as the perspective lets them be: `taper` is how their distance changes
per pixel of x; left free it would tell little and add a third to the noise of the centroid.

Along a flank a pixel mixes paint and background; the paint's brightness, which falls steeply
there, is left free (see `matting`). At an end the picture changes along the needle from that of the
band to that of the shaft, each as wide as it is and with its own mixture of background beside it:
paint, shaft and background meet in one pixel of a corner, but along the needle two pictures only,

    p = E·B + (1 - E)·S + noise,

B what the picture shows further inside at the same place between the flanks, S further outside,
where the needle's point runs together as the shape of the needle says. Colours are means of 4 to
20 samples, whose noise adds little to that of the pixel.
"""

import math
from typing import Any, Final, NamedTuple

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.tracking.cameras.camera import Image
from app.tracking.markers.extractor import Mask
from app.tracking.markers.four_edges import (
    EDGES,
    arc,
    bell,
    below,
    centroid,
    centroid_noise,
    find_edges,
    mean_colour,
    patch_colour,
    place,
)
from app.tracking.markers.matting import mixture, paint_colour, rim_shares

RIM: Final = 1.9
"""Half width of the rim [standard deviations of the blurred edge]."""

OFF: Final = 3.0
"""From the edge to the first sample [the same]."""

_STEEPEST: Final = 2.5
"""Slope of an end's arc beyond which the rim is not widened."""

_END_PAINT_SD: Final = 0.03
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
    """Return how wide the needle is at x, beyond an end, over the shaft."""
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
    window: Any,
    edges: Any,
    end: int,
    tip: int,
    needle: Any,
    x: float,
    y: float,
    middle: float,
    start: float,
    out: Any,
    item: Any,
) -> None:
    """Mean colour of what is seen further outside at the same place between the shaft's edges."""
    sign = 2.0 * end - 1.0
    here = _narrowing(edges, end, tip, needle, x)
    out[:] = 0.0
    for i in range(4):
        at = start + sign * i
        across = middle + (y - middle) * _narrowing(edges, end, tip, needle, at) / here
        mean_colour(window, edges, at, across, 0.0, 0.0, 1, item)
        for k in range(3):
            out[k] += 0.25 * item[k]


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
    window: Any,
    edges: Any,
    end: int,
    tip: int,
    needle: Any,
    spread: float,
    noise: float,
    covariance: Any,
) -> Any:
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
                ease[0, k] = _END_PAINT_SD * expected * inner[k]
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


_PAINT_SD: Final = 0.3
_GROUND_SD: Final = 0.04
_SCATTER: Final = 2.0
"""What is left free at the flanks, relative: brightness of the paint, of the ground, and of the
ground per its scatter over the samples."""

_SHARED: Final = 1.45
"""Variance of the centroid over that of independent pixels, see `matting`."""

_PASSES: Final = 2


@njit
def edge_moments(
    window: Any,
    field: Any,
    sides: Any,
    hue: Any,
    blur: float,
    noise: float,
    focal: float,
    needle: Any,
) -> Any:
    """Area, centroid, its covariance and quality of the band.

    Args:
        window: uint8 (H, W, 3).
        field: first estimate of the shares, smooth, float32 (H, W).
        sides: see `four_edges.find_edges`.
        hue: mean colour of the paint, (3,).
        blur: standard deviation of the point spread [px].
        noise: standard deviation of a grey value, above 0.
        focal: of the camera [px], for the perspective.
        needle: distances of the tip and of where its point begins from the band's centre, in half
            lengths of the band, and the shaft's width over the band's, (3,).

    Returns:
        As `matting.rim_shares`; zeros where the band is too small to have four edges.
    """
    edges = np.empty(EDGES)
    nothing = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    if not find_edges(window, field, sides, edges):
        return nothing
    spread = math.sqrt(blur * blur + 1.0 / 12.0)
    tip = tip_end(window, edges)
    covariance, good, count = np.zeros((9, 9)), 0, 0
    for _ in range(_PASSES):
        good, count = _fit_flanks(window, edges, hue, spread, noise, focal, covariance)
        if count == 0:
            return nothing
        for end in range(2):
            more, seen = fit_end(window, edges, end, tip, needle, spread, noise, covariance)
            if seen == 0:
                return nothing
            good, count = good + more, count + seen
    area, mu, mv = centroid(edges)
    if not area > 0.0:
        return nothing
    uu, uv, vv = centroid_noise(edges, _SHARED * covariance, mu, mv)
    return area, mu, mv, uu, uv, vv, good / count


@njit
def _fit_flanks(
    window: Any, edges: Any, hue: Any, spread: float, noise: float, focal: float, covariance: Any
) -> Any:
    """Move both flanks; how many pixels are mixtures, and of how many."""
    paint, ground, one, ease = np.empty(3), np.empty(3), np.empty(3), np.empty((2, 3))
    normal, right, row = np.zeros((3, 3)), np.zeros(3), np.empty(3)
    strength = hue[0] * hue[0] + hue[1] * hue[1] + hue[2] * hue[2]
    good, count, off = 0, 0, OFF * spread
    half, tilt = 0.5 * (edges[6] - edges[4]), 0.5 * (edges[5] + edges[7])
    lean = min(0.9, max(-0.9, 0.5 * (edges[9] + edges[12]) / half))
    taper = -lean / (focal * math.sqrt(1.0 - lean * lean)) * half
    edges[5], edges[7] = tilt - taper, tilt + taper
    for v in range(window.shape[0]):
        for u in range(window.shape[1]):
            x, y, low, high, z = place(edges, u, v)
            sign = 1.0 if z > 0.0 else -1.0
            edge = high if sign > 0.0 else low
            if abs(y - edge) > RIM * spread:
                continue
            start, stop = arc(edges, 0, 0.9 * sign) + off, arc(edges, 1, 0.9 * sign) - off
            if not start - 0.5 <= x <= stop + 0.5:
                continue
            expected = below(sign * (edge - y) / spread)
            scatter = patch_colour(
                window, edges, x, edge + sign * off, sign, 4, start - off, stop + off, ground, one
            )
            patch_colour(window, edges, x, edge - sign * off, -sign, 2, start, stop, paint, one)
            light = (paint[0] * hue[0] + paint[1] * hue[1] + paint[2] * hue[2]) / strength
            loose = math.sqrt(_GROUND_SD**2 + _SCATTER**2 * scatter) * (1.0 - expected)
            for k in range(3):
                paint[k] = light * hue[k]
                ease[0, k] = _PAINT_SD * expected * paint[k]
                ease[1, k] = loose * ground[k]
            told, doubt, _ = mixture(window[v, u], paint, ground, ease, noise)
            count += 1
            good += -0.3 < told < 1.3
            told = min(1.3, max(-0.3, told)) - expected
            rise = sign * bell((edge - y) / spread) / spread
            row[0], row[1] = (0.0, rise) if sign > 0.0 else (rise, 0.0)
            row[2] = rise * x
            for i in range(3):
                right[i] += row[i] * told / doubt
                for j in range(3):
                    normal[i, j] += row[i] * row[j] / doubt
    if count < 6 or not (normal[0, 0] > 0.0 and normal[1, 1] > 0.0):
        return 0, 0
    normal[2, 2] += 1.0  # a slope of 1 is none: only so that a short flank has an answer
    inverse = np.linalg.inv(normal)
    change = inverse @ right
    covariance[:3, :3] = inverse
    edges[4], edges[6] = edges[4] + change[0], edges[6] + change[1]
    edges[5], edges[7] = edges[5] + change[2], edges[7] + change[2]
    return good, count


_ROUGH, _FINE = 2.5, 1.6
"""Half width of the rim [px]; the fine one is 2.3 standard deviations of a blur of 0.7 px."""

_AGREE_PX = 0.2
"""Farther from the sum of the shares the four edges are not the band's: one behind it was taken."""

_SMOOTH = 0.6
"""Of the first shares, before the outline is where they are a half [px]."""


class Moments(NamedTuple):
    """Of the covered shares in a window.

    `quality` is the share of the rim's pixels that are mixtures of paint and ground.
    """

    area: float
    u: float
    v: float
    var_u: float
    cov_uv: float
    var_v: float
    quality: float


def outline_moments(
    window: Image, blob: Mask, noise: float, optics: FloatArray, rough: bool = False
) -> Moments:
    """Area [px²], centroid [px] and its covariance [px²] of the band in a window.

    All zero where the band is too thin to have an inside.

    Args:
        window: uint8 (H, W, 3).
        blob: one where the band roughly is, (H, W).
        noise: standard deviation of a grey value.
        optics: standard deviation of the point spread [px], focal length [px], and three ratios of
            the needle, see `edge_moments`, (5,).
        rough: only the first pass, for a place to begin a fit at.
    """
    window = np.ascontiguousarray(window)
    least = max(noise, 1.0)
    share = np.empty(blob.shape, dtype=np.float32)
    smooth = cv2.GaussianBlur(blob.astype(np.float32), (0, 0), 1.0)
    distance = _signed_distance(blob)
    first = rim_shares(window, distance, smooth, _sides(blob, smooth), _ROUGH, least, share)
    if rough or first[0] <= 0.0:
        return Moments(*first)
    smooth = cv2.GaussianBlur(np.clip(share, -0.3, 1.3), (0, 0), _SMOOTH)
    hue, edges = np.empty(3), (0.0,) * 7
    if paint_colour(window, distance, hue):
        sides = _sides((smooth > 0.5).astype(np.uint8), smooth)
        edges = edge_moments(
            window, smooth, sides, hue, float(optics[0]), least, float(optics[1]), optics[2:]
        )
    outline = _greatest((smooth > 0.5).astype(np.uint8), blob)
    distance = _signed_distance(outline)
    summed = rim_shares(window, distance, smooth, _sides(outline, smooth), _FINE, least, share)
    agree = np.hypot(edges[1] - summed[1], edges[2] - summed[2]) < _AGREE_PX
    return Moments(*(edges if edges[0] > 0.0 and agree else summed))


def _signed_distance(mask: Mask) -> FloatArray:
    """Distance to the edge between a mask's pixels and the others, negative inside [px]."""
    within = cv2.distanceTransform(mask, cv2.DIST_L2, 5)
    beyond = cv2.distanceTransform(1 - mask, cv2.DIST_L2, 5)
    return np.asarray(beyond - within + np.where(mask > 0, 0.5, -0.5).astype(np.float32))


def _greatest(mask: Mask, blob: Mask) -> Mask:
    """Return the part of a mask that has most in common with the blob."""
    count, labels = cv2.connectedComponents(mask)
    if count <= 2:
        return mask
    common = np.bincount(labels[blob > 0], minlength=count)
    common[0] = 0
    return np.asarray(labels == int(common.argmax()), dtype=np.uint8)


def _sides(mask: Mask, smooth: FloatArray) -> FloatArray:
    """Centre, direction of one pair of sides and spreads along and across it, (6,).

    The direction is that of the fourth harmonic of the slopes, the same for all four sides of a
    band: which pair lies along the needle need not be known, and a square band has one too.
    """
    du, dv = cv2.Sobel(smooth, cv2.CV_32F, 1, 0), cv2.Sobel(smooth, cv2.CV_32F, 0, 1)
    real, imaginary = du * du - dv * dv, 2.0 * du * dv  # squared; once more below
    size = np.maximum(du * du + dv * dv, 1e-6)
    sine = float(np.sum(2.0 * real * imaginary / size))
    cosine = float(np.sum((real * real - imaginary * imaginary) / size))
    angle = 0.25 * np.arctan2(sine, cosine)
    c, s = float(np.cos(angle)), float(np.sin(angle))
    m = cv2.moments(mask, binaryImage=True)
    if m["m00"] <= 0.0:
        return np.array([0.0, 0.0, c, s, 1.0, 1.0])
    uu, uv, vv = (m[name] / m["m00"] for name in ("mu20", "mu11", "mu02"))
    along = c * c * uu + 2.0 * c * s * uv + s * s * vv
    across = s * s * uu - 2.0 * c * s * uv + c * c * vv
    spreads = np.sqrt([max(along, 0.1), max(across, 0.1)])
    return np.array([m["m10"] / m["m00"], m["m01"] / m["m00"], c, s, *spreads])
