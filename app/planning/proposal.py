"""A path for a demonstration on any CT: through soft tissue, steep enough for the robot.

Only for `acus demo` on a CT that comes without a plan. It knows nothing of organs and vessels, and
says so in its name: nobody practises on it unseen.
"""

from itertools import product

import numpy as np

from app.core.arrays import FloatArray, unit
from app.imaging.body import Body, is_inside, skin_entry
from app.imaging.errors import InvalidEntryError
from app.imaging.volume import Volume
from app.planning.errors import PlanError
from app.planning.plan import Plan

_ACROSS = (-0.45, 0.45, -0.35, 0.35, -0.25, 0.25, -0.15, 0.15)  # of the body's half width
_ALONG_MM = (0.0, 15.0, -15.0, 30.0, -30.0, 7.0, -7.0)
_TILTS_DEG = (12.0, -12.0, 5.0, -5.0)
_LENGTH_MM = 65.0
_BONE_HU = 180.0


def demonstration_plan(volume: Volume, body: Body, name: str = "demonstration") -> Plan:
    """Return a path from the anterior skin with the least bone on it (supine patient).

    Raises:
        PlanError: if no path of 65 mm from the anterior skin stays in the body.
    """
    candidates: list[tuple[float, int, tuple[FloatArray, FloatArray]]] = []
    for across, along, tilt in product(_ACROSS, _ALONG_MM, _TILTS_DEG):
        path = _path(volume, body, across, along, np.deg2rad(tilt))
        if path is not None:
            candidates.append((_bone_mm(volume, *path), len(candidates), path))
            if candidates[-1][0] == 0.0:
                break
    if not candidates:
        raise PlanError(
            f"no path of {_LENGTH_MM:g} mm from the anterior skin stays in the body of this CT;"
            " place entry and target yourself"
        )
    entry, target = min(candidates)[2]
    return Plan(entry, target, name)


def _path(
    volume: Volume, body: Body, across: float, along_mm: float, tilt: float
) -> tuple[FloatArray, FloatArray] | None:
    low, high = _extent_mm(volume, body)
    centre = 0.5 * (low + high)
    foot = centre + np.array([across * 0.5 * (high - low)[0], 0.0, along_mm])
    direction = unit([np.sin(tilt), np.cos(tilt), 0.1])  # posterior is +y in LPS
    outside = foot - direction * (foot[1] - low[1] + 30.0) / direction[1]
    try:
        entry = skin_entry(body, outside, foot)
    except InvalidEntryError:
        return None
    target = entry + _LENGTH_MM * direction
    return (entry, target) if is_inside(body, target) else None


def _extent_mm(volume: Volume, body: Body) -> tuple[FloatArray, FloatArray]:
    """Corners of the body's box in LPS [mm]."""
    cells = np.argwhere(body.coarse)[:, ::-1] * body.factors
    corners = volume.lps_mm(np.array([cells.min(axis=0), cells.max(axis=0)]))
    return corners.min(axis=0), corners.max(axis=0)


def _bone_mm(volume: Volume, entry: FloatArray, target: FloatArray) -> float:
    """Length of the path through what is as dense as bone [mm]."""
    steps = np.linspace(0.0, 1.0, int(_LENGTH_MM) + 1)[:, None]
    values = [volume.hu_at(p) for p in entry + steps * (target - entry)]
    return float(sum(value is not None and value > _BONE_HU for value in values))
