"""The angle at which a path crosses a wall: to a plane through the wall about the crossing.

One look at the field between eight voxels turns by degrees where another tissue is near; places on
the wall some millimetres about lie on it within hundredths.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.imaging.field.tissue_field import TissueField

_RADII_MM: Final = (1.5, 3.0)
_AROUND: Final = 12
_LOOK_MM: Final = 3.0
_STEP_MM: Final = 0.25
_HALVINGS: Final = 6
_LEAST: Final = 8  # places that a plane is laid through
_ROUNDS: Final = 2


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
    field: TissueField, codes: np.ndarray, place: FloatArray, normal: FloatArray
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
