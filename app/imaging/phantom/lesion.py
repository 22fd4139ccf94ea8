"""Lesion and default plan: a place in the liver that a needle can reach between the ribs."""

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.imaging.phantom import organs, skeleton
from app.imaging.phantom.patient import Patient, Point, draw_patient
from app.imaging.phantom.tubes import Tubes
from app.imaging.phantom.vessels import obstacles

SHORTEST_MM, LONGEST_MM = 60.0, 90.0
"""Length of the default path."""

STEEPEST_DEG: Final = 30.0
"""Largest angle between the default path and the vertical of a supine patient."""

_MARGINS_MM: Final = {"rib": 3.5, "lung": 4.0, "gut": 5.0, "vessel": 2.0}
_ATTEMPTS: Final = 60
_TILTS_DEG: Final = (4.0, 10.0, 16.0, 22.0, 28.0)
_SIDES_DEG: Final = tuple(range(0, 360, 20))


@dataclass(frozen=True, slots=True)
class _Route:
    """A path that meets nothing.

    Attributes:
        entry: on the skin, model coordinates.
        clearance: least distance to what must not be hit, beyond its margin [mm].
        length: of the path [mm].
        tilt: from the vertical [deg].
    """

    entry: FloatArray
    clearance: float
    length: float
    tilt: float

    @property
    def merit(self) -> float:
        """Safe first, then steep and short, as an operator would choose."""
        return min(self.clearance, 3.0) - 0.1 * self.tilt - 0.04 * self.length


@lru_cache(maxsize=16)
def planned_patient(seed: int) -> tuple[Patient, Point]:
    """Return the patient of a seed and the default entry in model coordinates [mm].

    The lesion is drawn again until it lies well inside the liver and a path to it exists.
    """
    patient = draw_patient(seed)
    rng = patient.generator(8)
    for _ in range(_ATTEMPTS):
        if _well_inside(patient) and (route := _best_route(patient)) is not None:
            x, y, z = (float(v) for v in route.entry)
            return patient, (x, y, z)
        x, y, z = patient.lesion_mm
        moved = rng.uniform((-100.0, -38.0, 165.0), (-66.0, -10.0, 205.0))
        patient = replace(patient, lesion_mm=(float(moved[0]), float(moved[1]), float(moved[2])))
    raise NumericalError(
        sentence(
            "no lesion with a safe path was found for phantom seed {seed}; take another", seed=seed
        )
    )


def make_patient(seed: int) -> Patient:
    """Return the patient of a seed; the same on every machine."""
    return planned_patient(seed)[0]


def _well_inside(patient: Patient) -> bool:
    at = _at(patient, np.array([patient.lesion_mm]))
    return bool(organs.liver(patient, at)[0] < -patient.lesion_radius_mm - 4.0)


def _at(patient: Patient, points: FloatArray) -> organs.Place:
    x, y, z = points.T
    return organs.place_of(patient, x, y, z)


def _best_route(patient: Patient) -> _Route | None:
    """Find the best straight path from the skin, or None."""
    blocked = obstacles(patient)
    routes = [_route(patient, tilt, side, blocked) for tilt in _TILTS_DEG for side in _SIDES_DEG]
    found = [route for route in routes if route is not None]
    return max(found, key=lambda route: route.merit) if found else None


def _heading(patient: Patient, tilt_deg: float, side_deg: float) -> FloatArray:
    """One millimetre from the lesion towards the front, tilted to a side, model coordinates."""
    tilt, side = np.radians(tilt_deg), np.radians(side_deg)
    lps = (np.sin(tilt) * np.cos(side), -np.cos(tilt), np.sin(tilt) * np.sin(side))
    return np.array(lps) / patient.scale


def _route(patient: Patient, tilt: float, side: float, blocked: dict[str, Tubes]) -> _Route | None:
    """Follow a direction to the skin; None if it is too long, too short or meets something."""
    heading = _heading(patient, tilt, side)
    along = np.arange(0.0, LONGEST_MM + 2.0, 0.5)
    points = np.array(patient.lesion_mm) + along[:, None] * heading
    at = _at(patient, points)
    outside = np.flatnonzero(at.skin > 0.0)
    if not outside.size or not SHORTEST_MM < along[outside[0]] < LONGEST_MM - 0.5:
        return None
    n = int(outside[0])
    share = at.skin[n - 1] / (at.skin[n - 1] - at.skin[n])
    entry = points[n - 1] + share * (points[n] - points[n - 1])
    clearance = _clearance(patient, points[:n], blocked)
    return None if clearance < 0.0 else _Route(entry, clearance, float(along[n]), tilt)


def _clearance(patient: Patient, points: FloatArray, blocked: dict[str, Tubes]) -> float:
    """Least distance to what must not be hit, beyond the margin of each [mm]; negative if hit."""
    at = _at(patient, points)
    p = np.abs(np.arctan2(at.x, at.y)) / np.pi
    bone, cartilage = skeleton.rib_distance(at.wall - 5.0, p, at.z)
    gut = np.minimum(organs.stomach(patient, at), organs.gallbladder(at))
    least = min(
        float(np.minimum(bone, cartilage).min()) - _MARGINS_MM["rib"],
        float(organs.lungs(patient, at).min()) - _MARGINS_MM["lung"],
        float(gut.min()) - _MARGINS_MM["gut"],
    )
    for name, tubes in blocked.items():
        if least < 0.0:
            break
        least = min(least, float(tubes.distance(points[::3]).min()) - _MARGINS_MM[name])
    return least
