"""Whether the robot can follow a plan; if not, why, and which rotation of the patient helps.

Rotations are said in the words that people use at a table.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np

from app.core.arrays import FloatArray, angle_between, read_only
from app.core.messages import joined, sentence
from app.core.units import DEGREE, MILLIMETRE
from app.mechanisms.profile import DeviceProfile
from app.planning.limits import ReachLimits, tilt_of
from app.planning.placement import PatientOrientation, PlacedPlan, Placement
from app.planning.plan import Plan

_PLAIN = 10.0 * DEGREE
_SIDES = (("left side", "right side"), ("back", "front"), ("head", "feet"))
_AXES = ("left–right axis", "front–back axis", "head–foot axis")


def rotation_in_words(rotation_vector: FloatArray, R_world_patient: FloatArray) -> str:
    """Say a rotation of the patient: the angle, the axis, and which side comes up.

    Args:
        rotation_vector: about world axes [rad], shape (3,).
        R_world_patient: orientation of the patient before it, LPS → world, shape (3, 3).

    Returns:
        For instance `turn the patient 12.0° about the head–foot axis, left side up`.
    """
    angle = float(np.linalg.norm(rotation_vector))
    if angle < 1e-6 * DEGREE:
        return sentence("leave the patient as is")
    axis = R_world_patient.T @ (rotation_vector / angle)
    words = sentence(
        "turn the patient {angle_deg:.1f}° about {axis_words}",
        angle_deg=angle / DEGREE,
        axis_words=_axis_words(axis),
    )
    rising = rising_side(rotation_vector, R_world_patient)
    return f"{words}, {rising} up" if rising else words


def rising_side(rotation_vector: FloatArray, R_world_patient: FloatArray) -> str:
    """Name the side of the patient that such a rotation lifts; empty if it is about the vertical.

    A point p rises at (ω × p)_z = (ẑ × ω)·p, so the side that rises lies along ẑ × ω.
    """
    up = np.cross([0.0, 0.0, 1.0], rotation_vector)
    norm = float(np.linalg.norm(up))
    if norm < np.sin(_PLAIN) * float(np.linalg.norm(rotation_vector)):
        return ""
    side = R_world_patient.T @ (up / norm)
    order = np.argsort(-np.abs(side))
    named = [i for i in order if abs(side[i]) > np.sin(_PLAIN)]
    return " and ".join(_SIDES[i][0 if side[i] > 0.0 else 1] for i in named)


def _axis_words(axis: FloatArray) -> str:
    largest = int(np.argmax(np.abs(axis)))
    off = float(np.arctan2(np.linalg.norm(np.delete(axis, largest)), abs(axis[largest])))
    if off < _PLAIN:
        return f"the {_AXES[largest]}"
    left, posterior, superior = axis
    return sentence(
        "the axis (L {left:.2f}, P {posterior:.2f}, S {superior:.2f}) through the entry",
        left=left,
        posterior=posterior,
        superior=superior,
    )


MARGIN = 2.0 * DEGREE
"""How far inside the limits a remedy puts the path [rad]."""

_EASY_TURN = 30.0 * DEGREE
_GRID = 2.0 * DEGREE


@dataclass(frozen=True, slots=True, eq=False)
class PatientTurn:
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


def find_remedy(placed: PlacedPlan, limits: ReachLimits) -> PatientTurn | None:
    """Return the smallest rotation that makes the direction of the path reachable, or None."""
    direction = nearest_direction(placed.axis, limits)
    if direction is None:
        return None
    rotation_vector = smallest_turn(placed.axis, direction)
    orientation = _best_orientation(placed, limits)
    return PatientTurn(
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
    lying = sentence(
        "lay the patient {lying} (tilt {tilt:.0f}°)", lying=_LYING[orientation], tilt=tilt
    )
    small = float(np.linalg.norm(rotation_vector)) <= _EASY_TURN
    return f"{turn}, or {lying}" if small else f"{lying}, or {turn}"


_LYING = {
    PatientOrientation.SUPINE: "supine (on the back)",
    PatientOrientation.PRONE: "prone (on the belly)",
    PatientOrientation.LEFT_DOWN: "left side down",
    PatientOrientation.RIGHT_DOWN: "right side down",
}


class Obstacle(StrEnum):
    """Why a path is out of reach."""

    UPWARD = "upward"
    TILT = "tilt"
    WORKSPACE = "workspace"
    DEPTH = "depth"


@dataclass(frozen=True, slots=True)
class ReachReason:
    """One reason why a path is out of reach.

    Attributes:
        obstacle: which limit.
        text: the reason for people, with the value and the limit.
    """

    obstacle: Obstacle
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, slots=True)
class Reach:
    """Answer of `reach`.

    Attributes:
        reachable: whether there is no reason against the path.
        tilt: angle between path and straight down [rad].
        depth: length of the path [m].
        reasons: each limit that is exceeded, with numbers.
        remedy: how to turn the patient so that the path is reachable; None when it already is,
            or when no rotation helps (a path that is too long stays too long).
        placed: the plan in world.
    """

    reachable: bool
    tilt: float
    depth: float
    reasons: tuple[ReachReason, ...]
    remedy: PatientTurn | None
    placed: PlacedPlan

    def message(self) -> str:
        """One line for people: reachable, or the reasons and the remedy."""
        if self.reachable:
            return sentence(
                "reachable: tilt {tilt_deg:.1f}°, depth {depth_mm:.1f} mm",
                tilt_deg=self.tilt / DEGREE,
                depth_mm=self.depth / MILLIMETRE,
            )
        reasons = joined("; ", (reason.text for reason in self.reasons))
        if self.remedy is None:
            return sentence("out of reach: {reasons}", reasons=reasons)
        return sentence(
            "out of reach: {reasons}. Remedy: {remedy}", reasons=reasons, remedy=self.remedy.words
        )


def reach(plan: Plan, placement: Placement, profile: DeviceProfile) -> Reach:
    """Tell whether a device can follow the path from its fulcrum to the target.

    Args:
        plan: entry and target in the patient.
        placement: how the patient lies.
        profile: the device.
    """
    return reach_within(plan, placement, ReachLimits.of(profile))


def reach_within(plan: Plan, placement: Placement, limits: ReachLimits) -> Reach:
    """`reach` for limits that do not come from a profile."""
    placed = PlacedPlan.of(plan, placement, limits.fulcrum)
    reasons = _direction_reasons(placed.axis, limits) + _depth_reasons(placed.length, limits)
    curable = bool(reasons) and all(r.obstacle is not Obstacle.DEPTH for r in reasons)
    return Reach(
        reachable=not reasons,
        tilt=placed.tilt,
        depth=placed.length,
        reasons=reasons,
        remedy=find_remedy(placed, limits) if curable else None,
        placed=placed,
    )


def _direction_reasons(axis: FloatArray, limits: ReachLimits) -> tuple[ReachReason, ...]:
    tilt, limit = tilt_of(axis) / DEGREE, limits.tilt_limit / DEGREE
    point = limits.tool_point(axis)
    if point is None:
        way = (
            sentence("horizontal")
            if tilt < 90.001
            else sentence("upward (tilt {tilt:.1f}° of 180°)", tilt=tilt)
        )
        text = sentence(
            "the path runs {way}; the needle enters from above, at most {limit:g}° from vertical",
            way=way,
            limit=limit,
        )
        return (ReachReason(Obstacle.UPWARD, text),)
    if tilt_of(axis) > limits.tilt_limit + 1e-9:
        text = sentence("tilt {tilt:.1f}° exceeds {limit:g}°", tilt=tilt, limit=limit)
        return (ReachReason(Obstacle.TILT, text),)
    if not limits.in_workspace(*point):
        x, y = (value / MILLIMETRE for value in point)
        text = sentence(
            "tool point ({x:.1f}, {y:.1f}) mm lies outside the robot's workspace", x=x, y=y
        )
        return (ReachReason(Obstacle.WORKSPACE, text),)
    return ()


def _depth_reasons(depth: float, limits: ReachLimits) -> tuple[ReachReason, ...]:
    if depth <= limits.depth_limit + 1e-9:
        return ()
    text = sentence(
        "depth {depth_mm:.1f} mm exceeds {limits_depth_limit_mm:g} mm; "
        "no rotation shortens a path: choose an entry closer to the target",
        depth_mm=depth / MILLIMETRE,
        limits_depth_limit_mm=limits.depth_limit / MILLIMETRE,
    )
    return (ReachReason(Obstacle.DEPTH, text),)
