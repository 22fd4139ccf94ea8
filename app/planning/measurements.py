"""What is measured in a CT: distances, angles, single values, regions. `measuring` measures them.

Every point is a true patient point, DICOM LPS [mm], so that a measurement means the same in every
plane that shows it, and survives turning, zooming and resampling of the view.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import hypot, pi

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.planning.errors import MeasurementError
from app.planning.plan import checked_point

Point = tuple[float, float, float]

SMALLEST_MM = 1e-6


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


def checked(item: Measurement) -> Measurement:
    """Return the measurement.

    Raises:
        MeasurementError: if a point is not finite, or a region has no extent.
    """
    for number, point in enumerate(item.points):
        checked_point(point, f"point {number + 1}")
    if isinstance(item, Region) and min(hypot(*item.right_mm), hypot(*item.down_mm)) < SMALLEST_MM:
        raise MeasurementError(
            sentence("a region needs an extent both ways: drag from corner to corner")
        )
    return item


def _point(values: FloatArray) -> Point:
    x, y, z = values.tolist()
    return x, y, z
