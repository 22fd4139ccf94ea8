"""The rim of the band in a window: from a rough mask to its area, centroid and their noise.

First the shares that the band covers (see `matting`), in a wide rim round a rough mask; they lead
to the band's four edges (see `edge_fit`). Then the shares again, only in a rim round the outline as
wide as the edge is blurred, what lies within counting as one: their sum stands in where there are
no four edges, or an edge of the background was taken for one.
"""

from typing import NamedTuple

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.markers.edge_fit import edge_moments
from app.tracking.markers.extractor import Mask
from app.tracking.markers.matting import paint_colour, rim_shares

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
            the needle, see `edge_fit.edge_moments`, (5,).
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
