"""The band's four edges to a few hundredths of a pixel, and the centroid between them (compiled).

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
from typing import Any, Final

import numpy as np

from app.core.compiled import njit
from app.tracking.markers.edge_centroid import centroid, centroid_noise
from app.tracking.markers.edge_samples import bell, below, patch_colour, place
from app.tracking.markers.end_fit import OFF, RIM, fit_end, tip_end
from app.tracking.markers.four_edges import EDGES, arc, find_edges
from app.tracking.markers.matting import mixture

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
    window: Any, field: Any, sides: Any, hue: Any, blur: float, noise: float, focal: float,
    needle: Any,
) -> Any:  # fmt: skip
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
            )  # fmt: skip
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
