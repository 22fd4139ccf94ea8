"""Reach of the arm, how far a posture is from singular, the nearest pose that can be reached, and
how well a reached pose is known.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.arm.mechanics.kinematics import (
    ArmSingularity,
    ArmSolution,
    arm_angle,
    forward,
    jacobian,
    seven,
    solution,
)
from app.arm.mechanics.least_squares import TURN_LENGTH, iterate, starts
from app.arm.mechanics.profile import ArmProfile
from app.arm.mechanics.redundancy import JointLimitError, solve
from app.core.arrays import FloatArray, frozen
from app.core.rotation import rotation_log, skew
from app.core.transform import RigidTransform
from app.mechanisms.errors import DegenerateError, UnreachableError

STARTS: Final = 24
"""Starts of the search for a nearest pose."""


@dataclass(frozen=True, slots=True)
class ArmReach:
    """Shell about the shoulder in which the wrist centre can be [m]; the tool's point is further.

    Attributes:
        inner: with joint 4 at its limit: 0.4104 m for the iiwa14 (errata D7).
        outer: with the elbow stretched: 0.82 m.
    """

    inner: float
    outer: float


def reach(arm: ArmProfile) -> ArmReach:
    """Shell about the shoulder, from the lengths and the limits of joint 4."""
    bend = min(max(arm.upper[3], -arm.lower[3]), np.pi)
    a, b = arm.upper_arm, arm.forearm
    # a² + b² + 2 a b cos θ4, without its cancellation
    inner = np.hypot(a - b, 2.0 * np.sqrt(a * b) * np.cos(0.5 * bend))
    return ArmReach(float(inner), a + b)


@dataclass(frozen=True, slots=True)
class SingularDistance:
    """Distance of a posture from singular, as sines, and what it is called.

    Attributes:
        first_axis: wrist centre from the axis of joint 1, as a share of its distance from the
            shoulder.
        shoulder: |sin θ2|.
        elbow: |sin θ4|.
        wrist: |sin θ6|.
        dexterity: smallest singular value of the Jacobian, turns weighed by `TURN_LENGTH`, over its
            largest: 0 where a direction of motion is lost. Seven joints can be aligned in one of
            the ways above without losing any.
        kinds: those within the tolerance asked for.
    """

    first_axis: float
    shoulder: float
    elbow: float
    wrist: float
    dexterity: float
    kinds: tuple[ArmSingularity, ...]


def arm_singularity(arm: ArmProfile, q: ArrayLike, tolerance: float = 1e-6) -> SingularDistance:
    """How far from singular q [rad], shape (7,), is; named where a sine is within `tolerance`.

    Raises:
        MechanismError: as `forward`.
    """
    angles = seven(q)
    centre = forward(arm, angles).translation - [0.0, 0.0, arm.pedestal]
    aside = float(np.hypot(centre[0], centre[1]) / np.linalg.norm(centre))
    shoulder, elbow, wrist = np.abs(np.sin(angles[[1, 3, 5]])).tolist()
    weighed = jacobian(arm, angles)
    weighed[3:] *= TURN_LENGTH
    values = np.linalg.svd(weighed, compute_uv=False)
    sines = aside, shoulder, elbow, wrist
    kinds = tuple(
        kind for kind, sine in zip(ArmSingularity, sines, strict=True) if sine <= tolerance
    )
    return SingularDistance(*sines, float(values[-1] / values[0]), kinds)


@dataclass(frozen=True, slots=True, eq=False)
class NearestPose:
    """A pose that can be reached, offered for one that cannot.

    Attributes:
        T_base_wrist: the pose, ⁰T₇.
        solution: joint angles for it, within the limits.
        shift: how far the wrist centre moves for it [m].
        turn: how far it turns [rad].
    """

    T_base_wrist: RigidTransform
    solution: ArmSolution
    shift: float
    turn: float


def nearest_pose(arm: ArmProfile, pose: RigidTransform) -> NearestPose:
    """Offer the pose nearest to ⁰T₇ that is within reach and joint limits: itself, if it is.

    Out of the shell of reach the wrist centre is moved straight onto it, which is nearest; in the
    shoulder itself, upwards. If joint limits forbid that, a turn of one radian counts as
    `TURN_LENGTH`, and the best that iterations from `STARTS` postures find is taken: reachable in
    any case, nearest as far as they found. The same in every run.
    """
    onto = _onto_shell(arm, pose)
    try:
        return _offered(pose, onto, solve(arm, onto))
    except (JointLimitError, UnreachableError, DegenerateError):
        pass
    found = (iterate(arm, pose, start) for start in starts(arm, STARTS))
    best = min(found, key=lambda end: end.error)
    there = forward(arm, best.q)
    answer = solution(arm, best.q, arm_angle(arm, best.q), 0)
    return _offered(pose, there, answer)


def _onto_shell(arm: ArmProfile, pose: RigidTransform) -> RigidTransform:
    shell = reach(arm)
    shoulder = np.array([0.0, 0.0, arm.pedestal])
    away = pose.translation - shoulder
    distance = float(np.linalg.norm(away))
    wanted = min(max(distance, shell.inner), shell.outer)
    if wanted == distance:
        return pose
    direction = away / distance if distance > 0.0 else np.array([0.0, 0.0, 1.0])
    return RigidTransform(pose.rotation, shoulder + wanted * direction)


def _offered(asked: RigidTransform, there: RigidTransform, answer: ArmSolution) -> NearestPose:
    shift = float(np.linalg.norm(there.translation - asked.translation))
    turn = float(np.linalg.norm(rotation_log(there.rotation @ asked.rotation.T)))
    return NearestPose(there, answer, shift, turn)


def tool_covariance(arm: ArmProfile, q: ArrayLike) -> FloatArray:
    """Covariance of the tool's pose in the world at joint angles q [rad], shape (7,).

    Carries the error of hand and eye (where the base is, what the hand holds) and of the encoders
    to the tool's centre point, to first order.

    Returns:
        Of a small shift of the point [m] and turn of the tool [rad], in the world's axes, (6, 6).

    Raises:
        MechanismError: as `forward`.
    """
    angles = seven(q)
    at = arm.T_wrist_tool.translation
    T_base_wrist = forward(arm, angles)
    tool = arm.tool_pose(T_base_wrist)
    turn = np.kron(np.eye(2), arm.T_world_base.rotation)
    by_joints = turn @ jacobian(arm, angles, at)
    by_base = turn.copy()  # a turn of the base moves what stands away from it
    away = arm.T_world_base.rotation.T @ (tool.translation - arm.T_world_base.translation)
    by_base[:3, 3:] = -arm.T_world_base.rotation @ skew(away)
    by_tool = np.kron(np.eye(2), tool.rotation)
    return frozen(
        arm.resolution**2 * by_joints @ by_joints.T
        + by_base @ arm.base_covariance @ by_base.T
        + by_tool @ arm.tool_covariance @ by_tool.T
    )
