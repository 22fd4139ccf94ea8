"""Signed distances [mm], negative inside: what the anatomy is put together from."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Field = NDArray[Any]
"""Single or double precision values on any grid of points."""


def smoothstep(t: Field) -> Field:
    """Rise from 0 to 1 between t = 0 and t = 1 with level ends."""
    s = np.clip(t, 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


def ellipsoid(point: tuple[Any, ...], centre: tuple[float, ...], radii: tuple[float, ...]) -> Field:
    """Approximate distance to an ellipsoid (or ellipse), exact on its surface."""
    scaled = [(p - c) / r for p, c, r in zip(point, centre, radii, strict=True)]
    steep = [s / r for s, r in zip(scaled, radii, strict=True)]
    tiny = 1e-6  # at the centre the quotient below tends to the smallest radius
    norm = np.sqrt(sum(s * s for s in scaled) + tiny**2)
    gradient = np.sqrt(sum(s * s for s in steep) + (tiny / min(radii)) ** 2)
    return norm * (norm - 1.0) / gradient


def capsule(
    x: Field, y: Field, start: tuple[float, float], end: tuple[float, float], radius: float
) -> Field:
    """Distance to a thick line in a slice."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    t = ((x - start[0]) * dx + (y - start[1]) * dy) / (dx * dx + dy * dy)
    t = np.clip(t, 0.0, 1.0)
    return np.hypot(x - start[0] - t * dx, y - start[1] - t * dy) - radius


def union(a: Field, b: Field, blend: float = 0.0) -> Field:
    """Smaller of two distances, the crease rounded over `blend` [mm]."""
    if blend <= 0.0:
        return np.minimum(a, b)
    h = np.maximum(blend - np.abs(a - b), 0.0) / blend
    return np.minimum(a, b) - 0.25 * blend * h * h


def intersection(a: Field, b: Field, blend: float = 0.0) -> Field:
    """Larger of two distances, the edge rounded over `blend` [mm]."""
    return -union(-a, -b, blend)


def cover(distance: Field, pixel_mm: float) -> Field:
    """Share of a pixel that lies inside, 0 to 1: the partial volume effect."""
    return np.clip(0.5 - distance / pixel_mm, 0.0, 1.0)
