"""Gripping a tool: how the palm comes to it, and where each finger touches it.

The tool is a cylinder without ends, as cameras see it: a point, an axis, a diameter. A finger is
round about the two lines of its links, from joint 2 over joint 3 to its tip, which ends at L3; with
a pad of 0 it is these lines, and touches with the grasp point of the paper. Closing follows the
hand's one motor per finger: both joints on the curve of free motion; if the proximal link touches
first, joint 2 stays there and the distal link goes on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from enum import StrEnum
from math import cos, inf, sin, sqrt
from typing import Final

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from app.arm.hand.closure import Contacts
from app.arm.hand.errors import GraspError
from app.arm.hand.finger import (
    Coupling,
    HandFinger,
    HandGeometry,
    coupled,
    forward_kernel,
)
from app.core.arrays import FloatArray, cross, frozen, unit
from app.core.compiled import njit
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE

STEPS: Final = 561
"""Postures tried on the way: every quarter of a degree of φ2, between which the grasp point moves
0.7 mm at most. A touch shallower than 0.02 mm on 4 mm of diameter can pass unseen between two."""

Joints = tuple[float, float, float]
"""(φ1, φ2, φ3) [rad]."""
Lengths = tuple[float, float, float, float]
"""(L1, L2, L3 less the pad, φ30) [m, m, m, rad]."""
Cylinder = tuple[float, float, float, float, float, float, float]
"""A point of the axis, the axis at length one, and the radius [m]."""

_ALONG: Final = 1e-6  # sine of the angle at which an approach counts as along the axis


class FingerLink(StrEnum):
    """What touches."""

    PROXIMAL = "proximal"
    DISTAL = "distal"


@dataclass(frozen=True, slots=True, eq=False)
class ToolShaft:
    """A cylinder without ends, in the frame that its name or context says.

    Attributes:
        position: a point on its axis, where it is to be gripped [m], shape (3,).
        axis: direction, of any length, kept at one, shape (3,).
        diameter: [m].

    Raises:
        GraspError: if the diameter is not positive.
        NumericalError: if a number is not finite, or the axis has no direction.
    """

    position: FloatArray
    axis: FloatArray
    diameter: float

    def __post_init__(self) -> None:
        if not 0.0 < self.diameter < inf:
            raise GraspError(
                sentence(
                    "a tool of diameter {diameter} m; a positive one is needed",
                    diameter=self.diameter,
                )
            )
        object.__setattr__(self, "position", frozen(self.position, (3,), "position"))
        object.__setattr__(self, "axis", frozen(unit(frozen(self.axis, (3,), "axis"), "axis")))

    def thicker(self, by: float) -> Cylinder:
        """Return position, axis and radius, so much larger [m]: what the kernels take."""
        (x, y, z), (ax, ay, az) = self.position.tolist(), self.axis.tolist()
        return x, y, z, ax, ay, az, 0.5 * self.diameter + by

    def seen_from(self, T_to_from: RigidTransform) -> ToolShaft:
        """Return the tool in another frame."""
        return ToolShaft(T_to_from @ self.position, T_to_from.rotate(self.axis), self.diameter)


@njit
def gap_kernel(
    proximal: bool, joints: Joints, links: Lengths, tool: Cylinder
) -> tuple[float, float]:
    """Distance of a link's line from a cylinder's surface [m], and the share of the link there.

    Seen along the cylinder's axis, the axis is a point and the link a line between two points. A
    link that is seen as a point, along the axis, counts as touching with its middle.
    """
    phi1, phi2, phi3 = joints
    l1, l2, l3, bend = links
    px, py, pz, ax, ay, az, radius = tool
    rho, z, turn, length = l1, 0.0, phi2, l2
    if not proximal:
        rho, z = l1 + l2 * cos(phi2), l2 * sin(phi2)
        turn, length = phi2 + phi3 + bend, l3
    c, s = cos(phi1), sin(phi1)
    ux, uy, uz = length * cos(turn) * c, length * cos(turn) * s, length * sin(turn)
    ox, oy, oz = rho * c - px, rho * s - py, z - pz
    along, offset = ux * ax + uy * ay + uz * az, ox * ax + oy * ay + oz * az
    ux, uy, uz = ux - along * ax, uy - along * ay, uz - along * az
    ox, oy, oz = ox - offset * ax, oy - offset * ay, oz - offset * az
    length2, share = ux * ux + uy * uy + uz * uz, 0.5
    if length2 > 0.0:
        share = min(max(-(ox * ux + oy * uy + oz * uz) / length2, 0.0), 1.0)
    ox, oy, oz = ox + share * ux, oy + share * uy, oz + share * uz
    return sqrt(ox * ox + oy * oy + oz * oz) - radius, share


@njit
def between_kernel(begin: Joints, end: Joints, share: float) -> Joints:
    """Posture at a share of the way from one to another."""
    return (
        begin[0] + share * (end[0] - begin[0]),
        begin[1] + share * (end[1] - begin[1]),
        begin[2] + share * (end[2] - begin[2]),
    )


@njit
def scan_kernel(
    proximal: bool, begin: Joints, end: Joints, links: Lengths, tool: Cylinder, steps: int
) -> int:
    """First of the steps 0 to `steps` between two postures at which a link touches; -1 if none."""
    for i in range(steps + 1):
        if gap_kernel(proximal, between_kernel(begin, end, i / steps), links, tool)[0] <= 0.0:
            return i
    return -1


@dataclass(frozen=True, slots=True, eq=False)
class FingerTouch:
    """Where a finger touches.

    Attributes:
        finger, link: what touches.
        point: in the hand's frame [m], shape (3,).
        normal: from there into the tool, across its axis, shape (3,).
        joints: (φ1, φ2, φ3) of the finger in that moment [rad], shape (3,).
        coupling: `FREE`, or `BREAKAWAY` for a distal link that went on alone.
    """

    finger: HandFinger
    link: FingerLink
    point: FloatArray
    normal: FloatArray
    joints: FloatArray
    coupling: Coupling


@dataclass(frozen=True, slots=True)
class Grasp:
    """A tool in the closed hand.

    Attributes:
        touches: in the order of the fingers; a finger may have two.
        spread: [rad].
    """

    touches: tuple[FingerTouch, ...]
    spread: float

    def contacts(self, friction: float, soft: float = 0.0) -> Contacts:
        """Return the touches for `closure.force_closure`, in the hand's frame.

        Raises:
            GraspError: as `Contacts`.
        """
        points = np.array([touch.point for touch in self.touches])
        normals = np.array([touch.normal for touch in self.touches])
        return Contacts(points, normals, friction, soft)


def approach(
    geometry: HandGeometry, tool_world: ToolShaft, towards: ArrayLike, height: float | None = None
) -> RigidTransform:
    """Place the palm before a tool so that three fingertips meet on both its sides: T_world_hand.

    The palm faces the tool as nearly along `towards` as the tool's axis lets it, its x along the
    axis; fingers 1 and 2 come from one side, finger 3 from the other. The tool lies at that height
    above joint 2 at which, in free motion, the round tips have it between them, their middles level
    with its axis.

    Args:
        geometry: the hand.
        tool_world: the tool.
        towards: direction in which the palm moves to it, of any length, shape (3,).
        height: of the tool's axis above joint 2 [m], if another one is wanted; the tips meet there
            only if joint 2 is held before.

    Raises:
        GraspError: if the palm would have to come along the tool's axis, the tool is too thick, or
            at that height it is out of the fingers' reach or in the palm.
        NumericalError: if `towards` has no direction.
    """
    away = unit(frozen(towards, (3,), "towards"), "towards")
    across = away - tool_world.axis * (away @ tool_world.axis)
    if np.linalg.norm(across) <= _ALONG:
        raise GraspError(
            sentence(
                "the palm would come along the tool's axis; give a direction across it"
                " (the axis is {round})",
                round=tool_world.axis.round(6).tolist(),
            )
        )
    z = unit(across)
    x = tool_world.axis
    rotation = np.column_stack([x, cross(z, x), z])
    radius = 0.5 * tool_world.diameter
    least, most = heights(geometry, radius)
    chosen = most if height is None else height
    if not least <= chosen <= most:
        raise GraspError(
            sentence(
                "the tool's axis at {chosen_mm:.4g} mm above joint 2: the tips meet on a"
                " tool of {tool_world_diameter_mm:.4g} mm from {least_mm:.4g} to"
                " {most_mm:.4g} mm",
                chosen_mm=chosen / MILLIMETRE,
                tool_world_diameter_mm=tool_world.diameter / MILLIMETRE,
                least_mm=least / MILLIMETRE,
                most_mm=most / MILLIMETRE,
            )
        )
    return RigidTransform(rotation, tool_world.position - chosen * z)


def heights(geometry: HandGeometry, radius: float) -> tuple[float, float]:
    """Heights above joint 2 at which tips can meet on a tool of a radius [m]: least, most [m].

    The most is reached in free motion; below it joint 2 must have been held, down to where joint 3
    is at its limit, or where the tool's surface comes to the palm.

    Raises:
        GraspError: if the tool is too thick, or too thin, for any height.
    """
    links = _round(geometry)

    def apart(phi2: float, phi3: float) -> float:
        return float(forward_kernel(0.0, phi2, phi3, *links)[0]) - radius - geometry.pad

    most_free = min(geometry.most_proximal, geometry.most_distal / geometry.coupling)
    free = _first(lambda phi2: apart(phi2, geometry.coupling * phi2), most_free)
    if free is None:
        widest = geometry.knuckle + geometry.proximal + geometry.distal * cos(geometry.bend)
        raise GraspError(
            sentence(
                "a tool of {radius_mm:.4g} mm: the fingers open to"
                " {widest_mm:.4g} mm and cannot close on it",
                radius_mm=2.0 * radius / MILLIMETRE,
                widest_mm=2.0 * widest / MILLIMETRE,
            )
        )
    most = float(forward_kernel(0.0, free, geometry.coupling * free, *links)[2])
    lowest = _first(lambda phi2: apart(phi2, geometry.most_distal), geometry.most_proximal)
    bent = geometry.most_distal
    if lowest is None:  # a thick tool: met with joint 2 held where it begins
        lowest, bent = 0.0, _first(lambda phi3: apart(0.0, phi3), geometry.most_distal) or 0.0
    tip = float(forward_kernel(0.0, lowest, bent, *links)[2])
    least = max(tip, radius - geometry.joint_height)
    if not least <= most:
        raise GraspError(
            sentence(
                "a tool of {radius_mm:.4g} mm would be met at"
                " {most_mm:.4g} mm above joint 2, where it is in the palm",
                radius_mm=2.0 * radius / MILLIMETRE,
                most_mm=most / MILLIMETRE,
            )
        )
    return least, most


def close_hand(geometry: HandGeometry, tool_hand: ToolShaft, spread: float = 0.0) -> Grasp:
    """Close all fingers on a tool that stands still in the hand's frame.

    Args:
        geometry: the hand.
        tool_hand: the tool, in the hand's frame.
        spread: of fingers 1 and 2 [rad].

    Raises:
        GraspError: if the spread is beyond its limits, the tool is in the palm or in an open
            finger, or a finger closes to its limit without touching; says which, and where.
    """
    if not 0.0 <= spread <= geometry.most_spread:
        raise GraspError(
            sentence(
                "spread {spread_deg:.4g}°; its limits are 0 and {geometry_most_spread_deg:.4g}°",
                spread_deg=spread / DEGREE,
                geometry_most_spread_deg=geometry.most_spread / DEGREE,
            )
        )
    _clear_of_the_palm(geometry, tool_hand)
    found: list[FingerTouch] = []
    for finger in HandFinger:
        T_hand_finger = finger.placed(geometry)
        phi1 = finger.turn * spread
        tool = tool_hand.seen_from(T_hand_finger.inverse())
        for touch in _closed(geometry, tool, finger, phi1):
            point, normal = T_hand_finger @ touch.point, T_hand_finger.rotate(touch.normal)
            found.append(replace(touch, point=frozen(point), normal=frozen(normal)))
    return Grasp(tuple(found), spread)


def _closed(
    geometry: HandGeometry, tool: ToolShaft, finger: HandFinger, phi1: float
) -> list[FingerTouch]:
    """Close one finger, all in its frame."""
    c = geometry.coupling
    most = min(geometry.most_proximal, geometry.most_distal / c)
    opened, shut = (phi1, 0.0, 0.0), (phi1, most, c * most)
    touching = []
    for link in FingerLink:
        share = _first_touch(geometry, tool, link, opened, shut)
        if share == 0.0:
            raise GraspError(
                sentence(
                    "finger {finger_name} stands in the tool with its {link} link when open;"
                    " move the hand back, or change the spread",
                    finger_name=finger.name.lower(),
                    link=link,
                )
            )
        if share is not None:
            touching.append((share, link))
    if not touching:
        raise GraspError(
            sentence(
                "finger {finger_name} closes to its limit without touching the tool;"
                " bring the hand nearer, or change the spread",
                finger_name=finger.name.lower(),
            )
        )
    share, link = min(touching)
    held = between_kernel(opened, shut, share)
    touches = [_touch(geometry, tool, finger, link, held)]
    if link is FingerLink.PROXIMAL:
        bent = (phi1, held[1], geometry.most_distal)
        more = _first_touch(geometry, tool, FingerLink.DISTAL, held, bent)
        if more is not None:
            here = between_kernel(held, bent, more)
            touches.append(_touch(geometry, tool, finger, FingerLink.DISTAL, here))
    return touches


def _first(apart: Callable[[float], float], most: float) -> float | None:
    """Return the first place in [0, most] at which something positive comes to 0; None if none."""
    before = 0.0
    if apart(before) <= 0.0:
        return None
    for here in np.linspace(0.0, most, STEPS)[1:].tolist():
        if apart(here) <= 0.0:
            return float(brentq(apart, before, here, xtol=1e-15, rtol=1e-14))
        before = here
    return None


def _first_touch(
    geometry: HandGeometry,
    tool: ToolShaft,
    link: FingerLink,
    begin: Joints,
    end: Joints,
) -> float | None:
    """Return the share of the way between two postures (φ1, φ2, φ3) at which a link touches."""
    proximal, lengths = link is FingerLink.PROXIMAL, _round(geometry)
    shape = tool.thicker(geometry.pad)
    step = scan_kernel(proximal, begin, end, lengths, shape, STEPS - 1)
    if step < 0:
        return None

    def gap(share: float) -> float:
        return float(gap_kernel(proximal, between_kernel(begin, end, share), lengths, shape)[0])

    if step == 0:
        return 0.0
    bracket = (step - 1) / (STEPS - 1), step / (STEPS - 1)
    return float(brentq(gap, *bracket, xtol=1e-15, rtol=1e-14))


def _touch(
    geometry: HandGeometry,
    tool: ToolShaft,
    finger: HandFinger,
    link: FingerLink,
    joints: Joints,
) -> FingerTouch:
    links = _round(geometry)
    proximal = link is FingerLink.PROXIMAL
    _, share = gap_kernel(proximal, joints, links, tool.thicker(geometry.pad))
    middle = np.array(forward_kernel(joints[0], joints[1], 0.0, *links[:2], 0.0, 0.0))
    if proximal:
        start = links[0] * np.array([cos(joints[0]), sin(joints[0]), 0.0])
        end = middle
    else:
        start, end = middle, np.array(forward_kernel(*joints, *links))
    inside = start + share * (end - start)
    axis = tool.position + tool.axis * ((inside - tool.position) @ tool.axis)
    normal = unit(axis - inside)
    point = axis - 0.5 * tool.diameter * normal
    coupling = coupled(geometry, joints[1], joints[2])
    return FingerTouch(finger, link, frozen(point), frozen(normal), frozen(joints), coupling)


def _round(geometry: HandGeometry) -> Lengths:
    """Return lengths (L1, L2, L3 less the pad, φ30): to the middle of the round tip."""
    l1, l2, l3, bend = geometry.links
    return l1, l2, l3 - geometry.pad, bend


def _clear_of_the_palm(geometry: HandGeometry, tool: ToolShaft) -> None:
    """Refuse a tool of which a part above the palm's disc is below its surface."""
    flat = np.hypot(*tool.axis[:2])
    middle = -float(tool.position[:2] @ tool.axis[:2]) / flat**2 if flat > _ALONG else 0.0
    nearest = tool.position + middle * tool.axis
    beside = float(np.hypot(*nearest[:2]))
    if beside > geometry.palm_radius + 0.5 * tool.diameter:
        return
    half = np.sqrt(max(geometry.palm_radius**2 - beside**2, 0.0))
    lowest = nearest[2] - half * (abs(tool.axis[2]) / flat if flat > _ALONG else inf)
    under = -geometry.joint_height + 0.5 * tool.diameter - lowest
    if under > 0.0:
        deep = f"{under / MILLIMETRE:.3g} mm deep" if under < inf else "along its axis"
        raise GraspError(
            sentence(
                "the tool stands in the palm, {deep}; the palm lies"
                " {geometry_joint_height_mm:.3g} mm below joint 2: move the hand back",
                deep=deep,
                geometry_joint_height_mm=geometry.joint_height / MILLIMETRE,
            )
        )
