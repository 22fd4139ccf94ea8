"""Lobes of the lungs, parted by fissures; patients from seed `LOBES_FROM` on alone have them.

Right an oblique and a horizontal fissure, left an oblique one: planes with shallow waves. The right
oblique one passes in front of the nodule, which lies in the lower lobe.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import numpy as np

from app.imaging.phantom import organs
from app.imaging.phantom.patient import Patient, Point
from app.imaging.phantom.shapes import Field

MIDLINE_X: Final = 3.0
"""Plane between the lungs, model coordinates [mm]."""

RIGHT_UPPER, RIGHT_MIDDLE, RIGHT_LOWER = "right upper lobe", "right middle lobe", "right lower lobe"
LEFT_UPPER, LEFT_LOWER = "left upper lobe", "left lower lobe"
LOBES: Final = (RIGHT_LOWER, RIGHT_MIDDLE, RIGHT_UPPER, LEFT_LOWER, LEFT_UPPER)

FISSURE_MM: Final = 0.25
"""Half of what a fissure's two layers take of the lung in a CT [mm]: thinner than a voxel."""

_HILUM_Y, _HILUM_Z = 2.0, 338.0
_ROOM_MM = (5.5, 8.5)  # between nodule and fissure
_LEFT_DEG = (38.0, 46.0)
_HORIZONTAL_MM = (281.0, 287.0)  # height at its front
_WAVE_MM, _WAVE_LENGTH_MM = 1.2, 70.0


@dataclass(frozen=True, slots=True)
class Fissure:
    """A wavy plane, model coordinates [mm].

    Attributes:
        point: on the plane.
        normal: of the plane, unit: to the upper lobe.
        wave: phase of its waves along the body's width [rad].
    """

    point: Point
    normal: Point
    wave: float

    def above(self, x: Field, y: Field, z: Field) -> Field:
        """Distance above the fissure, to the upper lobe [mm], about."""
        (nx, ny, nz), (px, py, pz) = self.normal, self.point
        away: Field = nx * (x - px) + ny * (y - py) + nz * (z - pz)
        return away + _WAVE_MM * np.sin(2.0 * np.pi / _WAVE_LENGTH_MM * (x + 0.5 * z) + self.wave)


@dataclass(frozen=True, slots=True)
class Fissures:
    """All of a patient: right oblique, right horizontal, left oblique."""

    right: Fissure
    horizontal: Fissure
    left: Fissure

    def parting(self, at: organs.Place) -> dict[str, Field]:
        """Distance beyond each lobe's fissures and side, negative on its side [mm]."""
        right, left = self.right.above(at.x, at.y, at.z), self.left.above(at.x, at.y, at.z)
        level = self.horizontal.above(at.x, at.y, at.z)
        to_left, to_right = at.x - MIDLINE_X, MIDLINE_X - at.x
        return {
            RIGHT_LOWER: np.maximum(right, to_left),
            RIGHT_MIDDLE: np.maximum(np.maximum(-right, level), to_left),
            RIGHT_UPPER: np.maximum(np.maximum(-right, -level), to_left),
            LEFT_LOWER: np.maximum(left, to_right),
            LEFT_UPPER: np.maximum(-left, to_right),
        }

    def away(self, at: organs.Place) -> Field:
        """Distance from the nearest fissure [mm], about."""
        right, left = self.right.above(at.x, at.y, at.z), self.left.above(at.x, at.y, at.z)
        level = np.abs(self.horizontal.above(at.x, at.y, at.z))
        on_right = np.minimum(np.abs(right), np.maximum(level, -right))
        return np.where(at.x < MIDLINE_X, on_right, np.abs(left))


@lru_cache(maxsize=16)
def fissures(patient: Patient) -> Fissures:
    """Return the fissures of a patient who has lobes."""
    rng = patient.generator(10)

    def between(low: float, high: float) -> float:
        return float(rng.uniform(low, high))

    (x, y, z), radius = patient.own_nodule
    back, up = y - _HILUM_Y, z - _HILUM_Z
    room = radius + _WAVE_MM + between(*_ROOM_MM)
    # the plane through the hilum that leaves the nodule so far below it
    angle = np.arctan2(back, up) + np.arcsin(room / np.hypot(back, up))
    right = _oblique((x, _HILUM_Y, _HILUM_Z), float(angle) % np.pi, between(-0.1, 0.1))
    height, tilt = between(*_HORIZONTAL_MM), between(0.05, 0.2)
    level = _turned((between(-0.05, 0.05), -tilt, 1.0))
    left_deg = between(*_LEFT_DEG)
    left = _oblique((60.0, _HILUM_Y, _HILUM_Z), np.radians(left_deg), between(-0.1, 0.1))
    waves = [between(0.0, 2.0 * np.pi) for _ in range(3)]
    return Fissures(
        Fissure(*right, waves[0]),
        Fissure((-70.0, -75.0, height), level, waves[1]),
        Fissure(*left, waves[2]),
    )


def _oblique(point: Point, angle: float, aside: float) -> tuple[Point, Point]:
    """Plane that falls to the front, `angle` off the body's axis [rad]."""
    return point, _turned((aside, -float(np.cos(angle)), float(np.sin(angle))))


def _turned(way: Point) -> Point:
    length = float(np.linalg.norm(way))
    return way[0] / length, way[1] / length, way[2] / length


def lobes(patient: Patient, at: organs.Place) -> dict[str, Field]:
    """Signed distances to the lobes, negative inside, by name [mm]."""
    lung = organs.lungs(patient, at)
    return {name: np.maximum(lung, part) for name, part in fissures(patient).parting(at).items()}


def fissure_lines(patient: Patient, at: organs.Place) -> Field:
    """Signed distance to the layers of all fissures within the lungs [mm]."""
    lines: Any = fissures(patient).away(at) - FISSURE_MM
    return np.maximum(lines, organs.lungs(patient, at))
