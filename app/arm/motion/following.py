"""Cartesian motion of the arm: lines, arcs and sweeps about the fulcrum, as paths of the joints.

A motion is followed by postures that lie each near the one before, at knots made denser until the
spline through them keeps to the motion within what is asked, between the knots too (`path`). Where
the elbow may turn freely it turns evenly: the arm angle is the polynomial of least degree along
which all joints keep half the margin that the postures had.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import islice
from typing import Final, Protocol

import numpy as np
from scipy.interpolate import CubicSpline

from app.arm.mechanics import (
    ARM_BRANCHES,
    ArmProfile,
    arm_angle,
    arm_branch,
    arm_singularity,
    feasible,
    inverse,
    reach,
    solve,
)
from app.arm.motion.errors import MotionError
from app.arm.motion.path import Bends, JointPath
from app.arm.motion.pivot import LEAST_DEXTERITY, SHAFT_OFF, Pivot
from app.core.arrays import FloatArray, cross, frozen, unit
from app.core.messages import sentence, sentence_of
from app.core.rotation import rotation_exp, rotation_log
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.mechanisms.errors import MechanismError

WITHIN: Final = 0.05 * MILLIMETRE
"""How far a followed point may be from its motion [m]."""

TURN_WITHIN: Final = 0.05 * DEGREE
"""How far its orientation may be [rad]."""

_KNOTS: Final = (9, 17, 33, 65, 129, 257)
_LARGEST_STEP: Final = 0.2  # of a joint between knots [rad]; more than that at the most is a jump
_SHRINKS: Final = 0.8  # what twice the knots do not make smaller is no matter of knots
_STARTS: Final = 24
_FEW_STARTS: Final = 3  # where the base is moved
_SHIFTS: Final = (0.1, 0.2, 0.3, 0.4, 0.5)  # of the base, when a better place is looked for [m]


class PoseMotion(Protocol):
    """A pose along a parameter from 0 to 1."""

    @property
    def bend(self) -> float:
        """Bound of the second derivative of its position [m]."""
        ...

    @property
    def turn_bend(self) -> float | None:
        """The same of any unit vector fixed to it; None where others that are checked imply it."""
        ...

    def at(self, s: float) -> RigidTransform:
        """Pose at s."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class PoseLine:
    """Straight from a pose to another, orientation on the shortest way (slerp)."""

    start: RigidTransform
    end: RigidTransform

    @property
    def bend(self) -> float:
        """None: it is straight, at even speed."""
        return 0.0

    @property
    def turn_bend(self) -> float:
        """ω² of the even turn."""
        return float(np.sum(_turn(self.start, self.end) ** 2))

    def at(self, s: float) -> RigidTransform:
        """Pose at s."""
        way = self.end.translation - self.start.translation
        return RigidTransform(_slerp(self.start, self.end, s), self.start.translation + s * way)


@dataclass(frozen=True, slots=True, eq=False)
class PoseArc:
    """A circle's arc about an axis through a centre, orientation on the shortest way.

    Attributes:
        start, end: poses; the end must lie on the circle through the start.
        centre_world: on the axis [m], shape (3,).
        axis_world: the arc is right-handed about it, shape (3,).

    Raises:
        MotionError: if the start is on the axis, or the end not on the circle.
    """

    start: RigidTransform
    end: RigidTransform
    centre_world: FloatArray
    axis_world: FloatArray

    def __post_init__(self) -> None:
        axis = unit(self.axis_world, "axis_world")
        object.__setattr__(self, "axis_world", axis)
        object.__setattr__(self, "centre_world", np.asarray(self.centre_world, dtype=np.float64))
        (up, radius), (other, its) = self._about(self.start), self._about(self.end)
        if radius < 1e-9 or abs(up - other) > 1e-9 or abs(radius - its) > 1e-9:
            raise MotionError(
                sentence(
                    "no arc: the start is {radius:.6g} m from the axis and {up:.6g} m along it, "
                    "the end {its:.6g} m and {other:.6g} m; both must be alike, and off the axis",
                    radius=radius,
                    up=up,
                    its=its,
                    other=other,
                )
            )

    def _about(self, pose: RigidTransform) -> tuple[float, float]:
        away = pose.translation - self.centre_world
        up = float(self.axis_world @ away)
        return up, float(np.linalg.norm(away - up * self.axis_world))

    @property
    def angle(self) -> float:
        """From start to end about the axis [rad], in (0, 2π]."""
        a = cross(self.axis_world, self.start.translation - self.centre_world)
        b = cross(self.axis_world, self.end.translation - self.centre_world)
        turned = float(np.arctan2(self.axis_world @ cross(a, b), a @ b)) % (2.0 * np.pi)
        return turned if turned > 0.0 else 2.0 * np.pi

    @property
    def bend(self) -> float:
        """Radius times the angle's square."""
        return self._about(self.start)[1] * self.angle**2

    @property
    def turn_bend(self) -> float:
        """ω² of the even turn."""
        return float(np.sum(_turn(self.start, self.end) ** 2))

    def at(self, s: float) -> RigidTransform:
        """Pose at s."""
        turn = rotation_exp(s * self.angle * self.axis_world)
        away = self.start.translation - self.centre_world
        return RigidTransform(_slerp(self.start, self.end, s), self.centre_world + turn @ away)


@dataclass(frozen=True, slots=True, eq=False)
class Sweep:
    """The tip moves within the body; the shaft stays in the fulcrum.

    Attributes:
        pivot: the trocar and the tool.
        tips: places of the tip in the world [m], shape (n, 3): straight from one to another, or
            the cubic spline through more.
        roll: of the tool about its shaft, kept [rad].

    Raises:
        MotionError: if there are fewer than two places, or two that follow are the same.
    """

    pivot: Pivot
    tips: FloatArray
    roll: float = 0.0
    _spline: CubicSpline = field(init=False, repr=False)

    def __post_init__(self) -> None:
        tips = frozen(self.tips, name="tips")
        if tips.ndim != 2 or tips.shape[1] != 3 or len(tips) < 2:
            raise MotionError(
                sentence(
                    "tips have shape {tips_shape}; (n, 3) with two or more are needed",
                    tips_shape=tips.shape,
                )
            )
        lengths = np.linalg.norm(np.diff(tips, axis=0), axis=1)
        if not lengths.min() > 0.0:
            raise MotionError(
                sentence("a sweep has two places of the tip that follow and are the same")
            )
        s = np.append(0.0, np.cumsum(lengths)) / lengths.sum()
        object.__setattr__(self, "tips", tips)
        object.__setattr__(self, "_spline", CubicSpline(s, tips))

    @property
    def bend(self) -> float:
        """Of the spline: its second derivative is largest at a knot."""
        return float(np.linalg.norm(self._spline(self._spline.x, 2), axis=1).max())

    @property
    def turn_bend(self) -> None:
        """The orientation follows from tip and fulcrum, which are checked both."""
        return

    def at(self, s: float) -> RigidTransform:
        """Pose at s; `FulcrumError` where the way passes the fulcrum or is too flat."""
        return self.pivot.tip_pose(self._spline(s), self.roll)


@dataclass(frozen=True, slots=True)
class Margins:
    """What a path keeps from where the arm ends; the least of all its places.

    Attributes:
        joint: to a joint's limit [rad].
        reach: of the wrist centre to the shell in which it can be [m].
        dexterity: to a direction lost (see `SingularDistance`).
        elbow, wrist: |sin θ4|, |sin θ6|.
    """

    joint: float
    reach: float
    dexterity: float
    elbow: float
    wrist: float


@dataclass(frozen=True, slots=True, eq=False)
class Followed:
    """A motion as a path of the joints.

    Attributes:
        path: s as of the motion.
        miss: largest distance from the motion, bounded [m].
        turn_miss: largest error of orientation, bounded [rad]; 0 where it is not asked.
        off: largest distance of the shaft's line from the fulcrum, bounded [m]; 0 without one.
        margins: what it keeps.
    """

    path: JointPath
    miss: float
    turn_miss: float
    off: float
    margins: Margins


class MotionRefusedError(MotionError):
    """The arm cannot follow a motion.

    Attributes:
        at: how far of the motion it gets, 0 to 1.
        p_world: where that is [m], shape (3,).
        placement: T_world_base from which it could follow; None if none was found or looked for.
    """

    def __init__(
        self,
        reason: str,
        at: float,
        p_world: FloatArray,
        placement: RigidTransform | None = None,
        looked: bool = False,
    ) -> None:
        x, y, z = p_world.tolist()
        message = sentence(
            "the arm gets {share:.3g} % of the way, to ({x:.4g}, {y:.4g}, {z:.4g}) m: {reason}",
            share=100.0 * at,
            x=x,
            y=y,
            z=z,
            reason=reason,
        )
        if placement is not None:
            px, py, pz = placement.translation.tolist()
            message += sentence(
                "; with its base at ({x:.4g}, {y:.4g}, {z:.4g}) m it could", x=px, y=py, z=pz
            )
        elif looked:
            message += sentence(
                "; no base within {away:g} m of where it stands was found that could",
                away=_SHIFTS[-1],
            )
        super().__init__(message)
        self.why, self.at, self.p_world, self.placement = reason, at, p_world, placement


def margins(arm: ArmProfile, path: JointPath) -> Margins:
    """Return what a path keeps, over the places looked at."""
    shell, q = reach(arm), path.at(path.places())
    bends = Bends.of(arm, path)
    away = np.linalg.norm(bends.position - (0.0, 0.0, arm.pedestal), axis=1)
    seen = [arm_singularity(arm, one) for one in q]
    return Margins(
        joint=float(np.minimum(arm.upper - q, q - arm.lower).min()),
        reach=float(np.minimum(shell.outer - away, away - shell.inner).min()),
        dexterity=min(one.dexterity for one in seen),
        elbow=min(one.elbow for one in seen),
        wrist=min(one.wrist for one in seen),
    )


def follow(
    arm: ArmProfile,
    motion: PoseMotion,
    T_tool_moved: RigidTransform,
    start: FloatArray | None = None,
    pivot: Pivot | None = None,
    within: float = WITHIN,
    turn_within: float = TURN_WITHIN,
    least_dexterity: float = LEAST_DEXTERITY,
    suggest: bool = True,
    starts: int = _STARTS,
) -> Followed:
    """Find a path of the joints for a motion.

    Args:
        arm: its lengths, limits and placement.
        motion: poses in the world of the frame that moves.
        T_tool_moved: that frame in the arm's tool frame (`HeldTool.T_tool_needle` for the tip).
        start: joint angles at its begin [rad], shape (7,); without them the postures there are
            tried, best margin first.
        pivot: the fulcrum in which the shaft must stay, within `SHAFT_OFF`; None outside.
        within: largest error of position [m].
        turn_within: largest error of orientation [rad].
        least_dexterity: of all postures.
        suggest: whether a refusal looks for a placement of the base that could.
        starts: how many postures are tried where none is given.

    Raises:
        MotionRefusedError: if the arm cannot: says where and why.
        FulcrumError, NoGripError: if the motion itself is not defined somewhere (see `Pivot`).
    """
    job = _Job(arm, motion, T_tool_moved.inverse(), pivot, within, turn_within, least_dexterity)
    try:
        return job.followed(start, starts)
    except MotionRefusedError as error:
        if not suggest:
            raise
        place = place_base(arm, job.possible)
        raise MotionRefusedError(error.why, error.at, error.p_world, place, True) from error


def place_base(arm: ArmProfile, possible: Callable[[ArmProfile], bool]) -> RigidTransform | None:
    """Return the placement T_world_base nearest to the arm's own for which something is possible.

    Tried are shifts of up to half a metre on a grid of directions; the base keeps its orientation.
    """
    ways = [np.array([x, y, z]) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
    for size in _SHIFTS:
        for way in sorted(ways, key=lambda v: float(v @ v))[1:]:
            base = arm.T_world_base
            there = base.translation + size * unit(way)
            moved = replace(arm, T_world_base=RigidTransform(base.rotation, there))
            if possible(moved):
                return moved.T_world_base
    return None


@dataclass(frozen=True, slots=True)
class _Job:
    arm: ArmProfile
    motion: PoseMotion
    T_moved_tool: RigidTransform
    pivot: Pivot | None
    within: float
    turn_within: float
    least_dexterity: float

    def possible(self, arm: ArmProfile) -> bool:
        """Return whether the same is possible for the arm elsewhere."""
        pivot = None if self.pivot is None else replace(self.pivot, arm=arm)
        elsewhere = replace(self, arm=arm, pivot=pivot)
        try:
            for s in (1.0, 0.0, 0.5, 0.25, 0.75):
                solve(arm, elsewhere.wrist(s))
            elsewhere.followed(None, _FEW_STARTS)
        except (MechanismError, MotionRefusedError):
            return False
        return True

    def wrist(self, s: float) -> RigidTransform:
        return self.arm.wrist_pose(self.motion.at(s) @ self.T_moved_tool)

    def refused(self, reason: str, s: float) -> MotionRefusedError:
        return MotionRefusedError(reason, s, self.motion.at(s).translation)

    def followed(self, start: FloatArray | None, most: int = _STARTS) -> Followed:
        refusals = []
        for q in [start] if start is not None else self.starts(most):
            try:
                return self.densified(q)
            except MotionRefusedError as error:
                refusals.append(error)
        raise max(refusals, key=lambda error: error.at)

    def starts(self, most: int) -> list[FloatArray]:
        """Postures for the first pose, best margin first."""
        pose = self.wrist(0.0)
        try:
            found = [solve(self.arm, pose)]
        except MechanismError as error:
            raise self.refused(sentence_of(error), 0.0) from error
        for branch in ARM_BRANCHES:
            for low, high in feasible(self.arm, pose, branch):
                count = 1 + int((high - low) / 0.8)
                for angle in low + (high - low) * (np.arange(count) + 0.5) / count:
                    found.append(inverse(self.arm, pose, float(angle), branch))
        found.sort(key=lambda one: -one.margin)
        return [one.q for one in islice(found, most) if one.margin >= 0.0] or [found[0].q]

    def densified(self, start: FloatArray) -> Followed:
        last = np.inf
        for count in _KNOTS:
            try:
                return self.checked(*self.postures(start, count))
            except _CoarseError as error:
                if error.size > _SHRINKS * last or count == _KNOTS[-1]:
                    raise self.refused(sentence_of(error), error.s) from error
                last = error.size
        raise AssertionError(sentence("the last count returns or raises"))

    def postures(self, start: FloatArray, count: int) -> tuple[FloatArray, FloatArray]:
        s, q = np.linspace(0.0, 1.0, count), np.empty((count, 7))
        poses = [self.wrist(float(one)) for one in s]
        near, jump = start, None
        for k, pose in enumerate(poses):
            try:
                q[k] = solve(self.arm, pose, near).q
            except MechanismError as error:  # which depends on no posture: no jump before it counts
                raise self.edge(float(s[max(k - 1, 0)]), float(s[k])) from error
            joint = int(np.argmax(np.abs(q[k] - near)))
            step = abs(float(q[k, joint] - near[joint]))
            if k == 0 and step > 1e-6:
                raise self.refused(
                    sentence(
                        "joint {joint} stands {step_deg:.3g}° from the posture that the"
                        " motion begins with",
                        joint=joint + 1,
                        step_deg=np.degrees(step),
                    ),
                    0.0,
                )
            if step > _LARGEST_STEP and jump is None:
                jump = _CoarseError(
                    sentence(
                        "joint {joint} would jump by {step_deg:.3g}°: to go on it needs"
                        " another posture",
                        joint=joint + 1,
                        step_deg=np.degrees(step),
                    ),
                    float(s[k - 1]),
                    step,
                )
            near = q[k]
        if jump is not None:
            raise jump
        return s, self.evened(s, poses, q)

    def edge(self, low: float, high: float) -> MotionRefusedError:
        """Refusal where the poses stop being reached, between two parameters."""
        why, beyond = "", high
        for _ in range(12):
            try:
                solve(self.arm, self.wrist(high))
                low = high
            except MechanismError as error:
                why, beyond = str(error), high
            high = 0.5 * (low + beyond)
        return self.refused(why, low)

    def evened(self, s: FloatArray, poses: list[RigidTransform], q: FloatArray) -> FloatArray:
        """Return the same poses with an arm angle that changes evenly, where that can be."""
        arm = self.arm
        branch = arm_branch(q[0])
        if any(arm_branch(one) != branch for one in q):
            return q
        angles = np.unwrap([arm_angle(arm, one) for one in q])
        kept = float(np.minimum(arm.upper - q, q - arm.lower).min())
        for degree in range(4):
            powers = s[:, None] ** np.arange(1, degree + 1)
            terms, *_ = np.linalg.lstsq(powers, angles - angles[0], rcond=None)
            even = angles[0] + powers @ terms
            try:
                found = [
                    inverse(arm, pose, float(angle), branch, (float(one[0]), float(one[4])))
                    for pose, angle, one in zip(poses, even, q, strict=True)
                ]
            except MechanismError:
                return q
            smooth = np.array([one.q for one in found])
            near = np.abs(smooth[0] - q[0]).max() < 1e-9  # of a free start to the last bit
            steps = np.abs(np.diff(smooth, axis=0)).max()
            if min(one.margin for one in found) >= 0.5 * kept and near and steps < _LARGEST_STEP:
                return smooth
        return q

    def checked(self, s: FloatArray, q: FloatArray) -> Followed:
        path = JointPath(s, q)
        bends = Bends.of(self.arm, path)
        T_wrist_moved = self.arm.T_wrist_tool @ self.T_moved_tool.inverse()
        base = self.arm.T_world_base
        wanted = [base.inverse() @ self.motion.at(float(one)) for one in bends.s]
        centre = T_wrist_moved.translation
        there = bends.position + bends.rotation @ centre
        away = np.linalg.norm(there - [one.translation for one in wanted], axis=1)
        misses = bends.between(away, bends.fixed_to_tool(centre) + self.motion.bend)
        self.narrow(bends, misses, self.within, "its point would be {:.3g} mm off", MILLIMETRE)
        turn_miss = off = 0.0
        if self.motion.turn_bend is not None:
            turned = bends.rotation @ T_wrist_moved.rotation
            chords = np.array(
                [
                    2.0 * np.sin(0.5 * np.linalg.norm(rotation_log(a.T @ b.rotation)))
                    for a, b in zip(turned, wanted, strict=True)
                ]
            )
            bound = bends.direction() + self.motion.turn_bend
            turns = 2.0 * np.arcsin(np.minimum(0.5 * bends.between(chords, bound), 1.0))
            self.narrow(bends, turns, self.turn_within, "it would be turned {:.3g}° off", DEGREE)
            turn_miss = float(turns.max())
        if self.pivot is not None:
            off = self.pivot.off(path)
            if off > SHAFT_OFF:
                raise _CoarseError(
                    sentence(
                        "the shaft would pass the fulcrum at {off_mm:.3g} mm",
                        off_mm=off / MILLIMETRE,
                    ),
                    0.0,
                    off,
                )
        kept = margins(self.arm, path)
        if kept.dexterity < self.least_dexterity:
            worst = min(bends.s, key=lambda one: arm_singularity(self.arm, path.at(one)).dexterity)
            seen = arm_singularity(self.arm, path.at(worst), 0.05)
            names = ", ".join(seen.kinds) or "aligned joints"
            raise self.refused(
                sentence(
                    "its dexterity falls to {dexterity:.2g} ({names});"
                    " {least_dexterity:g} is the least",
                    dexterity=kept.dexterity,
                    names=names,
                    least_dexterity=self.least_dexterity,
                ),
                float(worst),
            )
        if kept.joint < 0.0:
            raise _CoarseError(
                sentence("a joint would pass its limit between two postures"), 0.0, 0.0
            )
        return Followed(path, float(misses.max()), turn_miss, off, kept)

    def narrow(
        self, bends: Bends, result: FloatArray, most: float, words: str, unit_of: float
    ) -> None:
        """Refuse the step that misses most, if it does by more than allowed."""
        worst = int(np.argmax(result))
        if result[worst] > most:
            said = words.format(float(result[worst]) / unit_of)
            raise _CoarseError(said, float(bends.s[worst]), float(result[worst]))


class _CoarseError(MotionError):
    """The knots are too far apart: at `s`, by `size` of something."""

    def __init__(self, reason: str, s: float, size: float) -> None:
        super().__init__(reason)
        self.s, self.size = s, size


def _turn(start: RigidTransform, end: RigidTransform) -> FloatArray:
    return rotation_log(start.rotation.T @ end.rotation)


def _slerp(start: RigidTransform, end: RigidTransform, s: float) -> FloatArray:
    return np.asarray(start.rotation @ rotation_exp(s * _turn(start, end)))
