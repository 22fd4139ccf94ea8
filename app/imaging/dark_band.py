"""The dark band beyond the ends of a needle in a slice, as a scanner leaves it.

A ray that runs along the needle is starved of photons: what it measures is less than the metal it
went through. Filtered back projection draws that along the ray, beyond both ends of the metal, as a
dark band with faint bright sides (Barrett and Keat 2004, RadioGraphics 24:1679). A point at r
beyond the end of a piece of length L sees it within an angle, and what the rays through it miss in
sum goes as ln(1 + L / r) times the height of the piece. So a thin lamina dz of the slice darkens

    K (dz / T) ln(1 + L / r) / (1 + r / R),   R = F L / (L + G),

T being the slice's thickness. The lamina cuts a needle that lies in the slice along all of its
length, and one that leaves it obliquely in a short ellipse: their sum is strong and long beyond a
tip that lies in the slice, weaker and shorter where a shaft leaves it. K, F, G and the
shape across are fitted to a small scanner of its own (tests/imaging/metal_projector.py: steel of
1.27 mm in 300 mm of water, 120 kV, rows of 1.25 mm, a slice of 5 mm); another one has others.
"""

from __future__ import annotations

from math import ceil

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.scan_order import ScanNeedle

DEPTH_HU = 1100.0
"""K: of a lamina as thick as the slice."""

FADES_MM = 60.0
SHORT_MM = 40.0
"""F and G: the band fades by half more over R, which is shorter for a short piece."""

NEAREST_MM = 1.0
"""No nearer to the end does the band grow."""

LAMINA_MM = 0.2
"""Thickness of a lamina, at most."""

SIDES = 0.045
SIDES_MM = 15.0
"""Share and width of the bright sides."""

CORE_MM = 0.3
SPREADS = 3.0
"""Half width of the dark core: this, and the radius times 1 + 3 r / L."""

EMPTY_MM = 15.0
"""Beyond a hollow needle the band is as deep as beyond a solid one only from so far on."""

_LEAST_MM = 0.3
_FARTHEST_MM = 250.0


def add_bands(
    hu: NDArray[np.float32],
    needle: ScanNeedle,
    middle_mm: float,
    slice_mm: float,
    grid: FloatArray,
) -> None:
    """Darken one slice beyond both ends of the needle's piece in it.

    Args:
        hu: of the slice, shape (rows, columns); changed.
        needle: in the frame in which the slice is straight.
        middle_mm: of the slice.
        slice_mm: its thickness.
        grid: affine of the scan, shape (4, 4).
    """
    piece = needle.within(middle_mm - slice_mm / 2, middle_mm + slice_mm / 2)
    if piece is None:
        return
    way = (piece[1] - piece[0])[:2]
    if float(np.linalg.norm(way)) < _LEAST_MM:  # upright in the slice: a dot has no direction
        return
    along = way / np.linalg.norm(way)
    origin = piece[0][:2]
    count = ceil(slice_mm / LAMINA_MM)
    heights = middle_mm + ((np.arange(count) + 0.5) / count - 0.5) * slice_mm
    cuts = [cut for z in heights if (cut := _cut(needle, z, origin, along)) is not None]
    if not cuts:
        return
    rows, columns = np.mgrid[0 : hu.shape[0], 0 : hu.shape[1]]
    x = grid[0, 3] + columns * grid[0, 0] - origin[0]
    y = grid[1, 3] + rows * grid[1, 1] - origin[1]
    u, across = x * along[0] + y * along[1], np.abs(x * along[1] - y * along[0])
    near = across < 3.0 * SIDES_MM
    u, across = u[near], across[near]
    total = np.zeros_like(u)
    for sign, which in ((1.0, 1), (-1.0, 0)):
        total += _beyond(u, across, cuts, sign, which, needle) / count
    hu[near] -= total.astype(np.float32)


def _cut(
    needle: ScanNeedle, z: float, origin: FloatArray, along: FloatArray
) -> tuple[float, float] | None:
    """Return from where to where a lamina at height z lies in the metal, along the piece [mm]."""
    ends: list[tuple[float, float]] = []
    for piece in needle.pieces:
        axis, radius = piece.axis, piece.radius_mm
        flat = float(np.hypot(axis[0], axis[1]))
        if flat < 1e-9:
            continue
        start = float((piece.hub_mm[:2] - origin) @ along)
        length = piece.length_mm - 0.5 * piece.tip_length_mm  # half of the point counts
        height, steep = z - float(piece.hub_mm[2]), float(axis[2])
        if abs(steep) < 1e-9:
            if abs(height) > radius:
                continue
            low, high = 0.0, length
        else:
            # u flat + height steep is the way along the shaft, height flat - u steep across it.
            edges = sorted((height * flat + way * radius) / steep for way in (-1.0, 1.0))
            faces = (-height * steep / flat, (length - height * steep) / flat)
            low, high = max(edges[0], faces[0]), min(edges[1], faces[1])
        if high > low:
            ends.append((start + low, start + high))
    if not ends:
        return None
    return min(low for low, _ in ends), max(high for _, high in ends)


def _beyond(
    u: FloatArray,
    across: FloatArray,
    cuts: list[tuple[float, float]],
    sign: float,
    which: int,
    needle: ScanNeedle,
) -> FloatArray:
    """Sum of the laminas' bands beyond one of their ends [HU], shape (n,).

    All laminas' depths depend on the place along the needle alone; the shape across is that of
    their mean.
    """
    outermost = max(sign * cut[which] for cut in cuts)
    innermost = min(sign * cut[which] for cut in cuts)
    place = innermost + np.arange(0.0, _FARTHEST_MM + outermost - innermost, 0.5)
    depth, width = np.zeros_like(place), np.zeros_like(place)
    wall = 1.0 - (needle.bore_mm / needle.radius_mm) ** 2
    for cut in cuts:
        length = cut[1] - cut[0]
        fades = FADES_MM * length / (length + SHORT_MM)
        r = place - sign * cut[which]
        beyond = r > 0.0
        r = np.maximum(r, NEAREST_MM)
        share = wall + (1.0 - wall) * r / (r + EMPTY_MM)
        one = beyond * share * np.log1p(length / r) / (1.0 + r / fades)
        depth += one
        core = CORE_MM + needle.radius_mm * (1.0 + SPREADS * r / length)
        width += one * (core if needle.bore_mm == 0.0 else 0.8 * core)
    width = np.where(depth > 0.0, width / np.maximum(depth, 1e-12), 1.0)
    at = sign * u
    deep = DEPTH_HU * np.interp(at, place, depth, left=0.0, right=0.0)
    wide = np.interp(at, place, width)
    sides = SIDES * np.exp(-((across / SIDES_MM) ** 2))
    result: FloatArray = deep * (1.0 / (1.0 + (across / wide) ** 2) - sides)
    return result
