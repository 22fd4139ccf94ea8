"""A scanner in small, for tests alone: what a steel needle in water looks like after a real scan.

Parallel rays through a disc of water with a straight cylinder of steel in it, both met exactly;
intensities of a 120 kV spectrum summed over energies and over the height of a detector row, with a
floor below which no photon is counted; logarithm, water's own hardening corrected, filtered back
projection (Ram-Lak with a Hann window; Kak and Slaney 1988, chapter 3). It shares no code with
`app.imaging.scanned`.

Attenuation: NIST XCOM, mass coefficients of water, iron and aluminium. Spectrum: Kramers' law
behind 8 mm of aluminium, seen by a detector that adds up energy.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

KEV = np.array([30.0, 40.0, 50.0, 60.0, 80.0, 100.0, 150.0])
WATER_CM = np.array([0.3756, 0.2683, 0.2269, 0.2059, 0.1837, 0.1707, 0.1505])
IRON_CM = 7.9 * np.array([8.176, 3.629, 1.958, 1.205, 0.5952, 0.3717, 0.1964])
ALUMINIUM_CM = 2.7 * np.array([1.128, 0.5685, 0.3681, 0.2778, 0.2018, 0.1704, 0.1378])

DISC_MM = 150.0
"""Radius of the water."""
STEP_MM = 0.4
"""Distance of rays, and side of a pixel."""
HALF = 400
"""Rays on either side of the middle one."""
VIEWS = 900
FLOOR = 2e-5
"""Share of the open beam below which a detector counts nothing: photon starvation."""


@dataclass(frozen=True)
class Rod:
    """A cylinder of steel with flat ends [mm]: start, end, radius, and radius of its bore."""

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    radius: float
    bore: float = 0.0


def _spectrum() -> tuple[Floats, Floats, Floats]:
    """Return weights, and coefficients of water and iron [1/mm], over energies."""
    energy = np.arange(35.0, 120.0, 5.0)

    def at(table: Floats) -> Floats:
        return np.exp(np.interp(np.log(energy), np.log(KEV), np.log(table))) / 10.0

    counted = (120.0 - energy) * np.exp(-at(ALUMINIUM_CM) * 8.0)
    return counted / counted.sum(), at(WATER_CM), at(IRON_CM)


def _chord(rod: Rod, radius: float, angle: Floats, s: Floats, z: float) -> Floats:
    """Length of rays in a cylinder [mm], shape (views, rays).

    A ray is s (cos a, sin a) + t (-sin a, cos a) at height z.
    """
    a, b = np.array(rod.start), np.array(rod.end)
    length = float(np.linalg.norm(b - a))
    axis = (b - a) / length
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    origin = np.stack([s * cos - a[0], s * sin - a[1], np.full_like(s * cos, z - a[2])], axis=-1)
    way = np.stack([-sin, cos, np.zeros_like(cos)], axis=-1)
    o_along, w_along = origin @ axis, way @ axis
    o_across, w_across = origin - o_along[..., None] * axis, way - w_along[..., None] * axis
    qa = np.maximum(np.einsum("vri,vri->vr", w_across, w_across), 1e-12)
    qb = np.einsum("vri,vri->vr", o_across, np.broadcast_to(w_across, o_across.shape))
    qc = np.einsum("vri,vri->vr", o_across, o_across) - radius**2
    under = qb**2 - qa * qc
    root = np.sqrt(np.maximum(under, 0.0))
    low, high = (-qb - root) / qa, (-qb + root) / qa
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = np.stack([-o_along / w_along, (length - o_along) / w_along])
    flat = np.abs(np.broadcast_to(w_along, o_along.shape)) < 1e-9
    between = (o_along >= 0.0) & (o_along <= length)
    first = np.where(flat, np.where(between, -np.inf, np.inf), ends.min(axis=0))
    last = np.where(flat, np.where(between, np.inf, -np.inf), ends.max(axis=0))
    chord = np.minimum(high, last) - np.maximum(low, first)
    return np.where(under > 0.0, np.maximum(chord, 0.0), 0.0)


def scanned(rods: tuple[Rod, ...], row_mm: float, rows: int, fine: int = 3) -> Floats:
    """Return a slice [HU] about z = 0, shape (2 HALF + 1,) * 2, y upwards by rows.

    Args:
        rods: in the water.
        row_mm: height of a detector row: intensities are summed over it.
        rows: of the slice, averaged as pictures.
        fine: heights within a row.
    """
    weights, water, iron = _spectrum()
    angle = np.arange(VIEWS) * np.pi / VIEWS
    s = STEP_MM * np.arange(-HALF, HALF + 1)
    in_water = 2.0 * np.sqrt(np.maximum(DISC_MM**2 - s**2, 0.0))
    depth = np.linspace(0.0, 2.5 * DISC_MM, 400)
    hardened = -np.log(np.maximum(np.exp(-np.outer(depth, water)) @ weights, 1e-30))
    effective = hardened[1] / depth[1]
    total = np.zeros((VIEWS, len(s)))
    for row in range(rows):
        middle = (row - (rows - 1) / 2) * row_mm
        counted = np.zeros_like(total)
        for part in range(fine):
            z = middle + ((part + 0.5) / fine - 0.5) * row_mm
            steel = sum(
                (
                    _chord(rod, rod.radius, angle, s, z)
                    - (_chord(rod, rod.bore, angle, s, z) if rod.bore else 0.0)
                    for rod in rods
                ),
                np.zeros_like(total),
            )
            wet = np.maximum(in_water - steel, 0.0)
            for w, mu_w, mu_i in zip(weights, water, iron, strict=True):
                counted += w * np.exp(-wet * mu_w - steel * mu_i) / fine
        measured = -np.log(np.maximum(counted, FLOOR))
        total += np.interp(measured, hardened, depth * effective) / rows
    return 1000.0 * (_back(total, angle) / effective - 1.0)


def _back(sinogram: Floats, angle: Floats) -> Floats:
    """Filtered back projection, shape (rays, rays) [1/mm]."""
    count = sinogram.shape[1]
    size = 2 ** int(np.ceil(np.log2(2 * count)))
    frequency = np.fft.rfftfreq(size, STEP_MM)
    response = np.zeros(size)
    n = np.minimum(np.arange(size), size - np.arange(size))
    odd = n % 2 == 1
    response[0] = 1.0 / (4.0 * STEP_MM**2)
    response[odd] = -1.0 / (np.pi * n[odd] * STEP_MM) ** 2
    window = 0.5 + 0.5 * np.cos(2.0 * np.pi * frequency * STEP_MM)
    ramp = np.fft.rfft(response).real * window
    filtered = np.fft.irfft(np.fft.rfft(sinogram, size, axis=1) * ramp, size, axis=1)[:, :count]
    at = STEP_MM * np.arange(-HALF, HALF + 1)
    x, y = np.meshgrid(at, at)
    picture = np.zeros((count, count))
    for row, a in zip(filtered, angle, strict=True):
        place = (x * np.cos(a) + y * np.sin(a)) / STEP_MM + HALF
        picture += np.interp(place, np.arange(count), row, left=0.0, right=0.0)
    return picture * np.pi / len(angle) * STEP_MM
