"""Which rotation of the patient brings a path within reach."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from app.core.arrays import FloatArray, angle_between, read_only
from app.core.units import DEGREE
from app.planning.limits import ReachLimits, tilt_of
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.words import rotation_in_words

MARGIN = 2.0 * DEGREE
"""How far inside the limits a remedy puts the path [rad]."""

_EASY_TURN = 30.0 * DEGREE
_GRID = 2.0 * DEGREE


@dataclass(frozen=True, slots=True, eq=False)
class Remedy:
    """A way to turn the patient that brings the path within reach, 2° inside the limits.

    Attributes:
        rotation_vector: smallest further rotation about the fulcrum, world axes [rad], shape (3,).
        placement: the placement after it, ready to be used.
        orientation: a plain patient orientation (no free rotation) that does it as well, the one
            with the steepest path; None if there is none. The better choice for large angles.
        words: both, said for people.
    """

    rotation_vector: FloatArray
    placement: Placement
    orientation: PatientOrientation | None
    words: str

    @property
    def angle(self) -> float:
        """Angle of the rotation [rad]."""
        return float(np.linalg.norm(self.rotation_vector))


def find_remedy(placed: PlacedPlan, limits: ReachLimits) -> Remedy | None:
    """Return the smallest rotation that makes the direction of the path reachable, or None."""
    direction = nearest_direction(placed.axis, limits)
    if direction is None:
        return None
    rotation_vector = smallest_turn(placed.axis, direction)
    orientation = _best_orientation(placed, limits)
    return Remedy(
        rotation_vector=read_only(rotation_vector),
        placement=placed.placement.turned(rotation_vector),
        orientation=orientation,
        words=_words(rotation_vector, placed, orientation),
    )


def smallest_turn(start: FloatArray, end: FloatArray) -> FloatArray:
    """Rotation vector [rad] of the smallest rotation that takes one unit vector to another.

    Between opposite directions every perpendicular axis serves; the world's y, the head–foot axis
    of a patient who is not turned, is preferred.
    """
    axis = np.cross(start, end)
    if np.linalg.norm(axis) < 1e-9:
        axis = np.cross(start, np.cross([0.0, 1.0, 0.0], start))
    if np.linalg.norm(axis) < 1e-9:
        axis = np.array([1.0, 0.0, 0.0])
    turn: FloatArray = axis / np.linalg.norm(axis) * angle_between(start, end)
    return turn


def nearest_direction(axis: FloatArray, limits: ReachLimits) -> FloatArray | None:
    """Needle direction within reach, with `MARGIN`, that is nearest to `axis`; None if none is.

    Straight towards the vertical until the tilt is allowed, which is the nearest point of a cone;
    where the workspace forbids that, the nearest of a grid of directions (to 2°).
    """
    steepest = max(0.0, limits.tilt_limit - MARGIN)
    tilt = min(tilt_of(axis), steepest)
    horizontal = np.array([axis[0], axis[1]])
    norm = np.linalg.norm(horizontal)
    # a path straight up has no azimuth: any serves; to the side keeps the words simple
    azimuth = horizontal / norm if norm > 1e-12 else np.array([1.0, 0.0])
    direct = np.array([*(np.sin(tilt) * azimuth), -np.cos(tilt)])
    if limits.holds(direct, MARGIN):
        return direct
    nearest_first = sorted(_grid(steepest), key=lambda d: -float(d @ axis))
    return next((d for d in nearest_first if limits.holds(d, MARGIN)), None)


def _grid(steepest: float) -> list[FloatArray]:
    directions = [np.array([0.0, 0.0, -1.0])]
    for tilt in np.arange(_GRID, steepest, _GRID):
        turns = np.arange(0.0, 2.0 * np.pi, _GRID / np.sin(tilt))
        directions += [
            np.array([np.sin(tilt) * np.cos(t), np.sin(tilt) * np.sin(t), -np.cos(tilt)])
            for t in turns
        ]
    return directions


def _best_orientation(placed: PlacedPlan, limits: ReachLimits) -> PatientOrientation | None:
    def tilt(orientation: PatientOrientation) -> float:
        return tilt_of(orientation.rotation @ placed.plan.direction)

    allowed = [
        orientation
        for orientation in PatientOrientation
        if limits.holds(orientation.rotation @ placed.plan.direction, MARGIN)
    ]
    return min(allowed, key=tilt, default=None)


def _words(
    rotation_vector: FloatArray, placed: PlacedPlan, orientation: PatientOrientation | None
) -> str:
    turn = rotation_in_words(rotation_vector, placed.placement.rotation)
    if orientation is None:
        return turn
    plain = replace(placed.placement, orientation=orientation, rotation_deg=(0.0, 0.0, 0.0))
    tilt = tilt_of(plain.rotation @ placed.plan.direction) / DEGREE
    lying = f"lay the patient {_LYING[orientation]} (tilt {tilt:.0f}°)"
    small = float(np.linalg.norm(rotation_vector)) <= _EASY_TURN
    return f"{turn}, or {lying}" if small else f"{lying}, or {turn}"


_LYING = {
    PatientOrientation.SUPINE: "supine (on the back)",
    PatientOrientation.PRONE: "prone (on the belly)",
    PatientOrientation.LEFT_DOWN: "left side down",
    PatientOrientation.RIGHT_DOWN: "right side down",
}
