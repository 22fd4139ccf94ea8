"""Which share of each pixel along the outline the band covers (compiled).

A pixel's colour is a mixture: α of the band's paint under the light that falls there, and 1 - α
of the background behind it,

    p = α·(1 + δ)·f + (1 - α)·g,

with f the colour of the nearby inside of the band and g that of the nearby background. The light
changes fast towards the flanks of a round body, so the paint's brightness is left free: δ is an
unknown with standard deviation `SHADING`, and α comes from the least squares of all three colours
with that prior. Writing d = p - g, u = f - g, and ε = α·δ for the linear unknown:

    minimise |d - α·u - ε·f|² + λ·ε²,   λ = (noise / SHADING)²
    α = uᵀP d / uᵀP u,   P = I - f fᵀ / (f·f + λ),   var α = noise² / uᵀP u of its own pixel.

Redness alone (one colour, δ = 0) would pull the outline away from the darker flank.
"""

from typing import Any

import numpy as np

from app.core.compiled import njit

SHADING = 0.3
"""Standard deviation of the paint's brightness at the outline, relative to the nearby inside."""

_SHARED = 5.0
"""Variance of the centroid over that of independent pixels: pixels across the outline share the
estimates f and g, whose noise then adds up. Measured by Monte Carlo (a test repeats it)."""

_REACH = 5
_LEAST_CONTRAST = 12.0


@njit
def _spread(colours: Any, known: Any, wanted: Any) -> None:
    """Carry known colours into the wanted pixels, one pixel a step, as means of known neighbours.

    A pixel so takes the colour of the nearest part: of its own side of a shaded band. In place;
    `known` (H, W) int8 is raised for what was filled.
    """
    height, width = known.shape
    for step in range(1, _REACH + 1):
        for v in range(height):
            for u in range(width):
                if not wanted[v, u] or known[v, u] > 0:
                    continue
                n, c0, c1, c2 = 0, 0.0, 0.0, 0.0
                for y in range(max(0, v - 1), min(height, v + 2)):
                    for x in range(max(0, u - 1), min(width, u + 2)):
                        if 0 < known[y, x] <= step:
                            n += 1
                            c0 += colours[y, x, 0]
                            c1 += colours[y, x, 1]
                            c2 += colours[y, x, 2]
                if n:
                    colours[v, u, 0] = c0 / n
                    colours[v, u, 1] = c1 / n
                    colours[v, u, 2] = c2 / n
                    known[v, u] = step + 1


@njit
def _share(p: Any, f: Any, g: Any, ridge: float) -> Any:
    """α and uᵀP u of one pixel."""
    ff, fd, fu, ud, uu = ridge, 0.0, 0.0, 0.0, 0.0
    for k in range(3):
        d, u = p[k] - g[k], f[k] - g[k]
        ff += f[k] * f[k]
        fd += f[k] * d
        fu += f[k] * u
        ud += u * d
        uu += u * u
    strength = uu - fu * fu / ff
    return (ud - fu * fd / ff) / max(strength, 1e-9), strength


@njit
def outline_moments(window: Any, inside: Any, support: Any, noise: float) -> Any:
    """Area, centroid, its covariance and the quality of the band in a window.

    Args:
        window: uint8 (H, W, 3).
        inside: certainly band, (H, W).
        support: perhaps band, (H, W), containing `inside`.
        noise: standard deviation of a grey value.

    Returns:
        (area, u, v, var u, cov uv, var v, share of outline pixels that mix as they should).
    """
    height, width = inside.shape
    band = window.astype(np.float64)
    ground = band.copy()
    has_band, has_ground = np.zeros((height, width), np.int8), np.zeros((height, width), np.int8)
    edge = np.zeros((height, width), np.bool_)
    for v in range(height):
        for u in range(width):
            has_band[v, u] = 1 if inside[v, u] else 0
            has_ground[v, u] = 0 if support[v, u] else 1
            edge[v, u] = support[v, u] and not inside[v, u]
    _spread(band, has_band, edge)
    _spread(ground, has_ground, edge)
    ridge = (max(noise, 1.0) / SHADING) ** 2
    area, mu, mv, n, good = 0.0, 0.0, 0.0, 0, 0
    suu, suv, svv, s1u, s1v, s0 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for v in range(height):
        for u in range(width):
            weight = 1.0 if inside[v, u] else 0.0
            if edge[v, u] and has_band[v, u] and has_ground[v, u]:
                weight, strength = _share(window[v, u], band[v, u], ground[v, u], ridge)
                n += 1
                if strength < _LEAST_CONTRAST**2:
                    weight = 0.0
                    continue
                good += -0.3 < weight < 1.3
                weight = min(1.5, max(-0.5, weight))
                variance = noise * noise / strength
                s0 += variance
                s1u += variance * u
                s1v += variance * v
                suu += variance * u * u
                suv += variance * u * v
                svv += variance * v * v
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
