"""Walls about a path: the angle at which it crosses one, and how wide tubes beside it are.

The angle is to a plane through the wall about the crossing: one look at the field between eight
voxels turns by degrees where another tissue is near; places on the wall some millimetres about lie
on it within hundredths. Where labels of a tube lie deep enough for a wide one, rays from its middle
to its wall tell the diameter: the shortest chord through the middle.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.core.arrays import FloatArray
from app.imaging.field.tissue_field import STEPS_PER_MM, TissueField
from app.imaging.field.walking import directions
from app.planning.lung_path.values import LEAST_TUBE_MM, TUBE_ROOM_MM, TubeNear

_RADII_MM: Final = (1.5, 3.0)
_AROUND: Final = 12
_LOOK_MM: Final = 3.0
_STEP_MM: Final = 0.25
_HALVINGS: Final = 6
_LEAST: Final = 8  # places that a plane is laid through
_ROUNDS: Final = 2

_CORE_MM: Final = 0.8  # the middle of a tube that is wide enough lies deeper than this in it
_BESIDE_MM: Final = 4.0
_RAYS: Final = 60
_REACH_MM: Final = 12.0
_RAY_STEP_MM: Final = 0.2
_CENTRINGS: Final = 4


def crossing_angle(
    field: TissueField, inside: Collection[int], place: FloatArray, way: FloatArray
) -> float | None:
    """Return the angle between a path and a wall's normal [deg], 0 straight through.

    Args:
        field: of the patient.
        inside: codes of all that lies beyond the wall, the others before.
        place: of the crossing, LPS, shape (3,).
        way: of the path, shape (3,).

    None where too little of the wall is there.
    """
    way = way / max(float(np.linalg.norm(way)), 1e-12)
    normal = way
    looked = field.look_up(place[None])
    if looked.normal[0].any():
        normal = looked.normal[0]
    codes = np.array(sorted(inside))
    for _ in range(_ROUNDS):
        places = _on_wall(field, codes, place, normal)
        if len(places) < _LEAST:
            return None
        middle = places - places.mean(axis=0)
        normal = np.linalg.svd(middle)[2][2]
    return float(np.degrees(np.arccos(min(1.0, abs(float(normal @ way))))))


def _on_wall(
    field: TissueField, codes: NDArray[Any], place: FloatArray, normal: FloatArray
) -> FloatArray:
    """Return places on the wall about a crossing, LPS, shape (n, 3)."""
    side = np.cross(normal, np.eye(3)[int(np.abs(normal).argmin())])
    side /= np.linalg.norm(side)
    other = np.cross(normal, side)
    turns = 2.0 * np.pi * np.arange(_AROUND) / _AROUND
    ring = np.cos(turns)[:, None] * side + np.sin(turns)[:, None] * other
    starts = np.vstack([place[None], *(place + radius * ring for radius in _RADII_MM)])
    steps = np.arange(-_LOOK_MM, _LOOK_MM + 1e-9, _STEP_MM)
    lines = starts[:, None] + steps[None, :, None] * normal
    is_in = np.isin(field.codes_at(lines.reshape(-1, 3)), codes).reshape(lines.shape[:2])
    changes = is_in[:, 1:] != is_in[:, :-1]
    # the change that is nearest to the crossing's own plane
    cost = np.where(changes, np.abs(steps[:-1] + 0.5 * _STEP_MM), np.inf)
    first = cost.argmin(axis=1)
    rows = np.flatnonzero(changes.any(axis=1))
    low, high = steps[first[rows]], steps[first[rows] + 1]
    before = is_in[rows, first[rows]]
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        now = np.isin(field.codes_at(starts[rows] + middle[:, None] * normal), codes)
        low, high = np.where(now == before, middle, low), np.where(now == before, high, middle)
    found: FloatArray = starts[rows] + 0.5 * (low + high)[:, None] * normal
    return found


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
