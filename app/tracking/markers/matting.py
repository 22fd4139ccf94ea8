"""Which share of each pixel along the outline the band covers (compiled).

A pixel's colour is a mixture: α of the band's paint under the light that falls there, and 1 - α
of the ground behind it,

    p = α·(1 + δ)·f + (1 - α)·(1 + γ)·g + noise,

with f the paint and g the ground beside it. Light changes fast towards the flanks of a round body
and the ground may change beneath the edge, so the brightness of both is left free: δ and γ are
unknowns with a standard deviation each. What they do to the pixel is proportional to the share
itself: a pixel that the band hardly covers tells its share by what it has of the paint's hue,
however bright the ground; one that is nearly covered by what it has of the ground's. So with the
share α₀ of a first estimate the generalised least squares are, for d = p - g and u = f - g,

    S = noise²·I + (α₀·SD δ)²·f fᵀ + ((1 - α₀)·SD γ)²·g gᵀ
    α = uᵀS⁻¹d / uᵀS⁻¹u,   var α = noise² · |S⁻¹u|² / (uᵀS⁻¹u)² of its own pixel.

f has the hue of the whole inside and the brightness just inside the pixel, g is what lies just
outside, both found along the side (see `Rim`) that the pixel belongs to: beyond the band's ends the
shaft is the same along the needle, and only there.
"""

import math
from typing import Any

import numpy as np

from app.core.compiled import njit

_PAINT_SD = 0.3
"""Of the paint's brightness in a pixel of the outline, relative to that just inside."""

_GROUND_SD, _GROUND_SCATTER = 0.06, 2.0
"""The same of the ground: a constant, and a multiple of its scatter over the samples beside it."""

_CLEAR, _SAMPLES, _FARTHEST = 2.0, 3, 14
"""Samples of paint and ground: distance from the outline, number, and most steps [px]."""

_SHARED = 1.5
"""Variance of the centroid over that of independent pixels: pixels across the outline share the
estimates f and g, whose noise then adds up. Measured by Monte Carlo (a test repeats it)."""

_LEAST_CONTRAST = 3.0
"""Of paint and ground [noise]."""


@njit
def _sample(window: Any, u: float, v: float, out: Any) -> None:
    """Colour between pixels, bilinear."""
    height, width = window.shape[0], window.shape[1]
    x, y = min(int(u), width - 2), min(int(v), height - 2)
    a, b = u - x, v - y
    for k in range(3):
        out[k] = (1.0 - b) * ((1.0 - a) * window[y, x, k] + a * window[y, x + 1, k]) + b * (
            (1.0 - a) * window[y + 1, x, k] + a * window[y + 1, x + 1, k]
        )


@njit
def _gather(
    window: Any, distance: Any, sign: float, place: Any, noise: float, out: Any, item: Any
) -> Any:
    """Mean colour of the first samples clear of the outline; (number, relative scatter²).

    `place` is u, v and the direction; `sign` 1 looks for ground, -1 for paint.
    """
    height, width = distance.shape
    n, first, second = 0, 0.0, 0.0
    out[:] = 0.0
    for step in range(_FARTHEST):
        u, v = place[0] + step * place[2], place[1] + step * place[3]
        if n == _SAMPLES or not (0.0 <= u <= width - 1.0 and 0.0 <= v <= height - 1.0):
            break
        if sign * distance[int(v + 0.5), int(u + 0.5)] < _CLEAR:
            continue
        _sample(window, u, v, item)
        bright = item[0] + item[1] + item[2]
        first, second, n = first + bright, second + bright * bright, n + 1
        for k in range(3):
            out[k] += item[k]
    if n == 0:
        return 0, 0.0
    for k in range(3):
        out[k] /= n
    if n == 1:
        return 1, 0.0
    scatter = (second - first * first / n) / (n - 1) - 6.0 * noise * noise
    return n, max(0.0, scatter) / (first / n + 1.0) ** 2


@njit
def mixture(p: Any, f: Any, g: Any, loose: Any, noise: float) -> Any:
    """α of one pixel, its variance and the contrast² that tells it.

    `loose`, (2, 3), holds two colours that are added to the pixel with factors of standard
    deviation 1. S⁻¹ is the adjugate of the symmetric 3 × 3 over its determinant, in units of the
    noise.
    """
    a, b, w = loose[0], loose[1], 1.0 / (noise * noise)
    xx = 1.0 + w * (a[0] * a[0] + b[0] * b[0])
    yy = 1.0 + w * (a[1] * a[1] + b[1] * b[1])
    zz = 1.0 + w * (a[2] * a[2] + b[2] * b[2])
    xy = w * (a[0] * a[1] + b[0] * b[1])
    xz = w * (a[0] * a[2] + b[0] * b[2])
    yz = w * (a[1] * a[2] + b[1] * b[2])
    x, y, z = f[0] - g[0], f[1] - g[1], f[2] - g[2]
    determinant = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    wx = (yy * zz - yz * yz) * x + (xz * yz - xy * zz) * y + (xy * yz - xz * yy) * z
    wy = (xz * yz - xy * zz) * x + (xx * zz - xz * xz) * y + (xy * xz - xx * yz) * z
    wz = (xy * yz - xz * yy) * x + (xy * xz - xx * yz) * y + (xx * yy - xy * xy) * z
    contrast = max(wx * x + wy * y + wz * z, 1e-12 * determinant)
    told = wx * (p[0] - g[0]) + wy * (p[1] - g[1]) + wz * (p[2] - g[2])
    variance = noise * noise * (wx * wx + wy * wy + wz * wz) / (contrast * contrast)
    return told / contrast, variance, contrast / (determinant * noise * noise)


@njit
def paint_colour(window: Any, distance: Any, out: Any) -> bool:
    """Mean colour of what is surely inside; False where nothing is."""
    n = 0
    out[:] = 0.0
    for v in range(distance.shape[0]):
        for u in range(distance.shape[1]):
            if distance[v, u] < -_CLEAR:
                n += 1
                for k in range(3):
                    out[k] += window[v, u, k]
    if n > 0:
        for k in range(3):
            out[k] /= n
    return n >= 4


@njit
def rim_shares(
    window: Any, distance: Any, first: Any, sides: Any, width: float, noise: float, share: Any
) -> Any:
    """Fill the covered shares of a window; area, centroid, covariance and quality of the band.

    Args:
        window: uint8 (H, W, 3).
        distance: to the outline, negative inside [px], float32 (H, W).
        first: first estimate of the shares, float32 (H, W).
        sides: centre u, v, a unit vector along one pair of sides, and the spreads along it and
            across, which tell the two pairs of sides apart, (6,).
        width: to each side of the outline, in which shares are estimated [px].
        noise: standard deviation of a grey value, above 0.
        share: out, float32 (H, W): 1 inside the rim, 0 outside.

    Returns:
        (area, u, v, var u, cov uv, var v, share of outline pixels that mix as they should);
        zeros where there is no inside or no rim.
    """
    hue, f, g, one = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    place, loose = np.empty(4), np.empty((2, 3))
    area, mu, mv, n, good = 0.0, 0.0, 0.0, 0, 0
    suu, suv, svv, s1u, s1v, s0 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    some = paint_colour(window, distance, hue)
    brightness = hue[0] * hue[0] + hue[1] * hue[1] + hue[2] * hue[2]
    if not some or brightness < 1.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for v in range(distance.shape[0]):
        for u in range(distance.shape[1]):
            weight = 0.0 if distance[v, u] > 0.0 else 1.0
            if abs(distance[v, u]) <= width:
                n += 1
                weight = 0.0
                x = (u - sides[0]) * sides[2] + (v - sides[1]) * sides[3]
                y = (v - sides[1]) * sides[2] - (u - sides[0]) * sides[3]
                along = abs(x) * sides[5] > abs(y) * sides[4]
                sign = 1.0 if (x if along else y) > 0.0 else -1.0
                place[0], place[1] = u, v
                place[2] = sign * (sides[2] if along else -sides[3])
                place[3] = sign * (sides[3] if along else sides[2])
                outside, scatter = _gather(window, distance, 1.0, place, noise, g, one)
                place[2], place[3] = -place[2], -place[3]
                within, _ = _gather(window, distance, -1.0, place, noise, f, one)
                share[v, u] = 0.0
                if outside == 0:
                    continue
                bright = 1.0
                if within > 0:
                    bright = (f[0] * hue[0] + f[1] * hue[1] + f[2] * hue[2]) / brightness
                for k in range(3):
                    f[k] = bright * hue[k]
                a = min(1.0, max(0.0, first[v, u]))
                ease = math.sqrt(_GROUND_SD**2 + _GROUND_SCATTER**2 * scatter) * (1.0 - a)
                for k in range(3):
                    loose[0, k], loose[1, k] = _PAINT_SD * a * f[k], ease * g[k]
                weight, variance, contrast = mixture(window[v, u], f, g, loose, noise)
                if contrast < _LEAST_CONTRAST**2:
                    weight = 0.0
                    continue
                good += -0.3 < weight < 1.3
                weight = min(1.5, max(-0.5, weight))
                s0 += variance
                s1u += variance * u
                s1v += variance * v
                suu += variance * u * u
                suv += variance * u * v
                svv += variance * v * v
            share[v, u] = weight
            area += weight
            mu += weight * u
            mv += weight * v
    if area <= 0.0 or n == 0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    mu, mv = mu / area, mv / area
    square = area * area / _SHARED
    return (
        area,
        mu,
        mv,
        (suu - 2.0 * mu * s1u + mu * mu * s0) / square,
        (suv - mu * s1v - mv * s1u + mu * mv * s0) / square,
        (svv - 2.0 * mv * s1v + mv * mv * s0) / square,
        good / n,
    )
