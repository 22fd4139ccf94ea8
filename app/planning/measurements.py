"""What is measured in a CT: distances, angles, single values, means over a region. Values only.

Every point is a true patient point, DICOM LPS [mm], so that a measurement means the same in every
plane that shows it, and survives turning, zooming and resampling of the view.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from math import degrees, hypot, pi

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.interpolation import Interpolation, interpolate
from app.imaging.volume import Volume
from app.planning.errors import MeasurementError
from app.planning.plan import checked_point

Point = tuple[float, float, float]

ALONG = 0.9999
"""Cosine from which a direction counts as that of the voxels: then whole voxels are counted."""

SMALLEST_MM = 1e-6
MOST_SAMPLES = 4_000_000


@dataclass(frozen=True, slots=True)
class Distance:
    """Between two points [mm]."""

    a_mm: Point
    b_mm: Point
    name: str = ""

    @property
    def points(self) -> tuple[Point, ...]:
        """Its handles."""
        return (self.a_mm, self.b_mm)

    def moved(self, handle: int, to: Point) -> Distance:
        """Return it with one handle elsewhere."""
        return replace(self, a_mm=to) if handle == 0 else replace(self, b_mm=to)


@dataclass(frozen=True, slots=True)
class Angle:
    """At `vertex_mm`, between the directions to two points [mm]."""

    a_mm: Point
    vertex_mm: Point
    b_mm: Point
    name: str = ""

    @property
    def points(self) -> tuple[Point, ...]:
        """Its handles."""
        return (self.a_mm, self.vertex_mm, self.b_mm)

    def moved(self, handle: int, to: Point) -> Angle:
        """Return it with one handle elsewhere."""
        a, vertex, b = (to if handle == i else point for i, point in enumerate(self.points))
        return replace(self, a_mm=a, vertex_mm=vertex, b_mm=b)


@dataclass(frozen=True, slots=True)
class Probe:
    """The value at a point [mm]."""

    at_mm: Point
    name: str = ""

    @property
    def points(self) -> tuple[Point, ...]:
        """Its handle."""
        return (self.at_mm,)

    def moved(self, handle: int, to: Point) -> Probe:
        """Return it elsewhere."""
        return replace(self, at_mm=to)


@dataclass(frozen=True, slots=True)
class Region:
    """An ellipse: its centre and its two half axes as vectors, at right angles [mm]."""

    centre_mm: Point
    right_mm: Point
    down_mm: Point
    name: str = ""

    @property
    def points(self) -> tuple[Point, ...]:
        """Its handles: ends of both axes, then the centre."""
        c, r, d = (np.array(v) for v in (self.centre_mm, self.right_mm, self.down_mm))
        return tuple(_point(p) for p in (c - r, c + r, c - d, c + d, c))

    def moved(self, handle: int, to: Point) -> Region:
        """Return it with an end of an axis elsewhere (the other end stays), or all of it."""
        if handle == 4:
            return replace(self, centre_mm=to)
        axis = self.right_mm if handle < 2 else self.down_mm
        unit = np.array(axis) / max(hypot(*axis), SMALLEST_MM)
        other = np.array(self.points[handle ^ 1])
        sign = 1.0 if handle % 2 else -1.0
        half = max(0.5 * sign * float((np.array(to) - other) @ unit), SMALLEST_MM)
        centre = other + sign * half * unit
        moved, vector = replace(self, centre_mm=_point(centre)), _point(half * unit)
        return replace(moved, right_mm=vector) if handle < 2 else replace(moved, down_mm=vector)

    def outline(self, count: int = 48) -> FloatArray:
        """Points of its rim, shape (count, 3)."""
        turn = np.linspace(0.0, 2.0 * pi, count, endpoint=False)[:, None]
        c, r, d = (np.array(v) for v in (self.centre_mm, self.right_mm, self.down_mm))
        rim: FloatArray = c + np.cos(turn) * r + np.sin(turn) * d
        return rim


Measurement = Distance | Angle | Probe | Region

KINDS = {Distance: "distance", Angle: "angle", Probe: "probe", Region: "region"}
"""Name of each kind, for files and lists."""


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


def checked(item: Measurement) -> Measurement:
    """Return the measurement.

    Raises:
        MeasurementError: if a point is not finite, or a region has no extent.
    """
    for number, point in enumerate(item.points):
        checked_point(point, f"point {number + 1}")
    if isinstance(item, Region) and min(hypot(*item.right_mm), hypot(*item.down_mm)) < SMALLEST_MM:
        raise MeasurementError("a region needs an extent both ways: drag from corner to corner")
    return item


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
    units = [v / max(h, SMALLEST_MM) for v, h in zip(vectors, halves, strict=True)]
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


def _point(values: FloatArray) -> Point:
    x, y, z = values.tolist()
    return x, y, z
