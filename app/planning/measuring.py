"""Measuring in a volume: from a distance, an angle, a probe or a region to its numbers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import degrees, hypot, pi

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.interpolation import Interpolation, interpolate
from app.imaging.volume import Volume
from app.planning.measurements import (
    SMALLEST_MM,
    Angle,
    Distance,
    Measurement,
    Point,
    Probe,
    Region,
)

ALONG = 0.9999
"""Cosine from which a direction counts as that of the voxels: then whole voxels are counted."""

MOST_SAMPLES = 4_000_000


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number with its name and unit; None where it cannot be told."""

    name: str
    value: float | None
    unit: str


@dataclass(frozen=True, slots=True)
class Measured:
    """What a measurement came to.

    Attributes:
        quantities: the most important first.
        note: why a value is missing; empty otherwise.
    """

    quantities: tuple[Quantity, ...]
    note: str = field(default="")

    @property
    def text(self) -> str:
        """The values in one line, as they stand beside the drawing."""
        if self.note:
            return self.note
        return "  ".join(_said(quantity) for quantity in self.quantities if _is_shown(quantity))

    def __iter__(self) -> Iterator[Quantity]:
        return iter(self.quantities)


def measured(item: Measurement, volume: Volume) -> Measured:
    """Measure in a volume."""
    if isinstance(item, Distance):
        return Measured((Quantity("length", _distance(item.a_mm, item.b_mm), "mm"),))
    if isinstance(item, Angle):
        angle = _angle(item)
        note = "" if angle is not None else "two points fall together"
        return Measured((Quantity("angle", angle, "°"),), note)
    if isinstance(item, Probe):
        value = volume.hu_at(item.at_mm, Interpolation.NEAREST)
        note = "" if value is not None else "outside the image"
        return Measured((Quantity("value", value, volume.unit),), note)
    return _region(item, volume)


def _distance(a: Point, b: Point) -> float:
    return hypot(*(x - y for x, y in zip(a, b, strict=True)))


def _angle(item: Angle) -> float | None:
    u, v = (np.array(p) - np.array(item.vertex_mm) for p in (item.a_mm, item.b_mm))
    if min(np.linalg.norm(u), np.linalg.norm(v)) < SMALLEST_MM:
        return None
    # Kahan's form keeps its digits for angles near 0 and 180°, where acos loses them.
    u, v = u / np.linalg.norm(u), v / np.linalg.norm(v)
    return degrees(2.0 * float(np.arctan2(np.linalg.norm(u - v), np.linalg.norm(u + v))))


def _region(item: Region, volume: Volume) -> Measured:
    width, height = hypot(*item.right_mm), hypot(*item.down_mm)
    values = _values(item, volume)
    area = Quantity("area", pi * width * height, "mm²")
    if values is None or not len(values):
        note = "too large" if values is None else "no voxel inside"
        return Measured((area,), note)
    deviation = float(values.std(ddof=1)) if len(values) > 1 else None
    return Measured(
        (
            Quantity("mean", float(values.mean()), volume.unit),
            Quantity("deviation", deviation, volume.unit),
            area,
            Quantity("minimum", float(values.min()), volume.unit),
            Quantity("maximum", float(values.max()), volume.unit),
            Quantity("samples", float(len(values)), ""),
        )
    )


def _values(item: Region, volume: Volume) -> NDArray[np.float64] | None:
    """Values inside the ellipse; None if there would be too many.

    Where both axes run along the voxels, those are the voxels whose centres lie inside, in the
    slice through the centre; elsewhere trilinear values on a lattice of the finest spacing.
    """
    centre = np.array(item.centre_mm)
    vectors = [np.array(item.right_mm), np.array(item.down_mm)]
    halves = [float(np.linalg.norm(v)) for v in vectors]
    if min(halves) < SMALLEST_MM:  # a drag along a line
        return np.empty(0)
    units = [v / h for v, h in zip(vectors, halves, strict=True)]
    axes = [_voxel_axis(unit, volume) for unit in units]
    aligned = axes[0] is not None and axes[1] is not None and axes[0] != axes[1]
    steps, offsets = [], []
    anchor = volume.lps_mm(np.rint(volume.voxel(centre))) if aligned else centre
    for unit, axis in zip(units, axes, strict=True):
        step = float(volume.spacing_mm[axis] if aligned else volume.spacing_mm.min())
        steps.append(step)
        offsets.append(float((anchor - centre) @ unit))
    counts = [int(np.ceil(h / s)) + 1 for h, s in zip(halves, steps, strict=True)]
    if (2 * counts[0] + 1) * (2 * counts[1] + 1) > MOST_SAMPLES:
        return None
    x, y = (
        offset + step * np.arange(-count, count + 1)
        for offset, step, count in zip(offsets, steps, counts, strict=True)
    )
    across, down = np.meshgrid(x, y)
    inside = (across / halves[0]) ** 2 + (down / halves[1]) ** 2 <= 1.0
    points = centre + across[inside, None] * units[0] + down[inside, None] * units[1]
    ijk = volume.voxel(points)
    kept = ijk[((ijk >= -0.5) & (ijk <= np.array(volume.size) - 0.5)).all(axis=1)]
    if not len(kept):
        return np.empty(0)
    way = Interpolation.NEAREST if aligned else Interpolation.TRILINEAR
    return np.asarray(interpolate(volume.hu, kept, way), dtype=np.float64)


def _voxel_axis(unit: FloatArray, volume: Volume) -> int | None:
    cosines = np.abs(unit @ volume.direction)
    axis = int(np.argmax(cosines))
    return axis if cosines[axis] > ALONG else None


def _is_shown(quantity: Quantity) -> bool:
    return quantity.name not in ("minimum", "maximum", "samples")


def _said(quantity: Quantity) -> str:
    sign = {"mean": "mean ", "deviation": "± "}.get(quantity.name, "")
    if quantity.value is None:
        return f"{sign}–"
    digits = 0 if quantity.name == "value" else 1
    gap = "" if quantity.unit in ("°", "") else " "
    return f"{sign}{quantity.value:.{digits}f}{gap}{quantity.unit}"
