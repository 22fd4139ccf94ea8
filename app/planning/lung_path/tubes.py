"""Vessels and bronchi about a path, with their diameters as the labels have them.

Where labels of a tube lie deep enough for a wide one, rays from its middle to its wall tell the
diameter: the shortest chord through the middle.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from scipy import ndimage

from app.core.arrays import FloatArray
from app.imaging.field.tissue_field import STEPS_PER_MM, TissueField
from app.imaging.field.walking import directions
from app.planning.lung_path.values import LEAST_TUBE_MM, TUBE_ROOM_MM, TubeNear

_CORE_MM: Final = 0.8  # the middle of a tube that is wide enough lies deeper than this in it
_BESIDE_MM: Final = 4.0
_RAYS: Final = 60
_REACH_MM: Final = 12.0
_RAY_STEP_MM: Final = 0.2
_CENTRINGS: Final = 4


def tubes_near(
    field: TissueField, codes: set[int], entry: FloatArray, end: FloatArray
) -> tuple[TubeNear, ...]:
    """Return tubes that a path meets or comes near, the first first.

    Args:
        field: of the patient.
        codes: of the tubes, each tissue for itself.
        entry: of the path, LPS, shape (3,).
        end: to which it is looked at, LPS, shape (3,); depths count from `entry`.
    """
    found = [one for code in sorted(codes) for one in _of_code(field, code, entry, end)]
    return tuple(sorted(found, key=lambda one: one.depth_mm))


def _of_code(field: TissueField, code: int, entry: FloatArray, end: FloatArray) -> list[TubeNear]:
    way = end - entry
    length = float(np.linalg.norm(way))
    if length < 1e-6:
        return []
    ijk = np.array([entry, end]) @ field.inverse_mm[:3, :3].T + field.inverse_mm[:3, 3]
    room = np.ceil((TUBE_ROOM_MM + _BESIDE_MM) / field.spacing_mm)
    size = np.array(field.labels.shape)
    first = np.clip(np.floor(ijk.min(axis=0) - room)[::-1], 0, size - 1).astype(int)
    last = np.clip(np.ceil(ijk.max(axis=0) + room)[::-1] + 1, first + 1, size).astype(int)
    box = tuple(slice(a, b) for a, b in zip(first.tolist(), last.tolist(), strict=True))
    chosen = field.labels[box] == code
    at = np.argwhere(chosen)
    if not len(at):
        return []
    places = (at + first)[:, ::-1] @ field.affine_mm[:3, :3].T + field.affine_mm[:3, 3]
    deep = field.distance[box][chosen] / STEPS_PER_MM
    along = np.clip((places - entry) @ way / length**2, 0.0, 1.0)
    away = np.linalg.norm(places - entry - along[:, None] * way, axis=1)
    gap = np.maximum(away - deep, 0.0)
    core = (deep >= _CORE_MM) & (away < TUBE_ROOM_MM + _BESIDE_MM)
    if not core.any():
        return []
    wide = np.zeros(chosen.shape, bool)
    wide[tuple(at[core].T)] = True
    numbers, count = ndimage.label(wide, np.ones((3, 3, 3)))
    own = numbers[tuple(at.T)]
    result = []
    for number in range(1, count + 1):
        cores = np.flatnonzero(own == number)
        near = cores[away[cores] < away[cores].min() + 1.5]
        middle = near[deep[near].argmax()]
        if gap[near].min() > TUBE_ROOM_MM:
            continue
        about = np.flatnonzero(np.linalg.norm(places - places[middle], axis=1) < deep[middle] + 2.5)
        nearest = about[gap[about].argmin()]
        if gap[nearest] > TUBE_ROOM_MM:
            continue
        diameter = diameter_mm(field, code, places[middle])
        if diameter < LEAST_TUBE_MM:
            continue
        x, y, z = (entry + along[nearest] * way).tolist()
        result.append(
            TubeNear(
                field.tissues[code].name or field.tissues[code].kind.value,
                diameter,
                float(gap[nearest]),
                float(along[nearest]) * length,
                (x, y, z),
            )
        )
    return result


def diameter_mm(field: TissueField, code: int, place: FloatArray) -> float:
    """Return the diameter of a tube about a place within it [mm]."""
    ways = directions(_RAYS)
    ways = np.vstack([ways, -ways])
    steps = np.arange(_RAY_STEP_MM, _REACH_MM, _RAY_STEP_MM)
    middle = np.array(place, np.float64)
    least = 0.0
    for _ in range(_CENTRINGS):
        points = middle + steps[:, None, None] * ways
        inside = field.codes_at(points.reshape(-1, 3)).reshape(len(steps), -1) == code
        left = np.where(inside.all(axis=0), len(steps), np.argmin(inside, axis=0))
        reach = _RAY_STEP_MM * (left + 0.5)
        chords = reach[:_RAYS] + reach[_RAYS:]
        least = max(least, float(chords.min()))
        short = chords < 1.25 * chords.min()
        shift = 0.5 * (reach[:_RAYS] - reach[_RAYS:])[short, None] * ways[:_RAYS][short]
        middle = middle + 2.0 * shift.mean(axis=0)  # chords along the offset alone show it
    return least
