"""Forward, differential and inverse kinematics of the arm, for one pose at a time.

Poses are ⁰T₇: the frame of the wrist, origin at the wrist centre, in the base's frame;
`ArmProfile.wrist_pose` makes them of poses of the tool in the world.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from app.arm.mechanics import kernels
from app.arm.mechanics.profile import JOINTS, TWISTS, ArmProfile
from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.mechanisms.errors import MechanismError, NotFiniteError
from app.mechanisms.status import check

WRIST_CENTRE: Final = (0.0, 0.0, 0.0)
"""The point that the Jacobian means where none is named."""


class ArmBranch(NamedTuple):
    """Signs of θ2, θ4 and θ6: which of the eight solutions at one arm angle. 0 counts as +1."""

    shoulder: int
    elbow: int
    wrist: int

    @property
    def signs(self) -> tuple[float, float, float]:
        """The same for kernels."""
        return float(self.shoulder), float(self.elbow), float(self.wrist)


ARM_BRANCHES: Final = tuple(
    ArmBranch(s2, s4, s6) for s2 in (1, -1) for s4 in (1, -1) for s6 in (1, -1)
)
"""All branches at one arm angle."""


class ArmSingularity(StrEnum):
    """Where the arm's angles are not all defined, and what is answered there.

    `FIRST_AXIS`: the wrist centre is on the axis of joint 1, so that θ1 of the solutions with
    θ3 = 0, and with it the zero of the arm angle, is free: what is kept of θ1 is taken.
    `SHOULDER`: sin θ2 = 0; only θ1 + θ3 (θ1 - θ3 at π) is defined; θ1 is kept.
    `ELBOW`: sin θ4 = 0, the elbow stretched: the edge of reach, along which the arm cannot move
    outwards; both signs of θ4 meet.
    `WRIST`: sin θ6 = 0; only θ5 + θ7 is defined; θ5 is kept.
    """

    FIRST_AXIS = "first_axis"
    SHOULDER = "shoulder"
    ELBOW = "elbow"
    WRIST = "wrist"


_BITS: Final = {
    ArmSingularity.FIRST_AXIS: kernels.FIRST_AXIS,
    ArmSingularity.SHOULDER: kernels.SHOULDER,
    ArmSingularity.ELBOW: kernels.ELBOW,
    ArmSingularity.WRIST: kernels.WRIST,
}


def named_singularities(bits: int) -> tuple[ArmSingularity, ...]:
    """Names of the bits that a kernel set."""
    return tuple(name for name, bit in _BITS.items() if bits & bit)


@dataclass(frozen=True, slots=True, eq=False)
class ArmSolution:
    """Joint angles for a pose.

    Attributes:
        q: joint angles [rad], shape (7,), in (-π, π].
        arm_angle: ψ [rad] (see `kernels`).
        branch: signs of θ2, θ4, θ6.
        singular: what is not defined there.
        margin: distance of the joint that is nearest to a limit of its own [rad]; negative beyond.
    """

    q: FloatArray
    arm_angle: float
    branch: ArmBranch
    singular: tuple[ArmSingularity, ...]
    margin: float


def seven(values: ArrayLike, name: str = "q") -> FloatArray:
    """Joint angles as an array of shape (7,).

    Raises:
        MechanismError: if the shape is another one.
        NotFiniteError: if an angle is NaN or infinite.
    """
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.shape != (JOINTS,):
        raise MechanismError(
            sentence(
                "{name} has shape {array_shape}; (7,) is needed", name=name, array_shape=array.shape
            )
        )
    if not np.isfinite(array).all():
        raise NotFiniteError(
            sentence("{name} is not finite: {array}", name=name, array=array.tolist())
        )
    return array


def pose_arrays(pose: RigidTransform) -> tuple[FloatArray, FloatArray]:
    """Rotation and position of a pose as kernels take them."""
    return np.ascontiguousarray(pose.rotation), pose.translation


def forward(arm: ArmProfile, q: ArrayLike) -> RigidTransform:
    """Pose ⁰T₇ of the wrist in the base's frame for joint angles q [rad], shape (7,).

    Raises:
        MechanismError: as `seven`.
    """
    rotation, position = np.empty((3, 3)), np.empty(3)
    kernels.forward_kernel(seven(q), arm.lengths, rotation, position)
    return RigidTransform(rotation, position)


def link_frames(arm: ArmProfile, q: ArrayLike) -> FloatArray:
    """Frames 1 to 7 of the paper's table in the base's frame, shape (7, 4, 4).

    By the paper's matrix of modified (Craig) parameters (section 2.1), its d3 as in the profile.

    Raises:
        MechanismError: as `seven`.
    """
    lift = (arm.pedestal, 0.0, arm.upper_arm, 0.0, arm.forearm, 0.0, 0.0)
    here, frames = np.eye(4), np.empty((JOINTS, 4, 4))
    for i, (angle, twist) in enumerate(zip(seven(q), TWISTS, strict=True)):
        c, s = np.cos(angle), np.sin(angle)
        ca, sa = 1.0 - 2.0 * abs(twist), 2.0 * twist  # α is 0 or a quarter turn
        step = np.array(
            [
                [c, -s, 0.0, 0.0],
                [s * ca, c * ca, -sa, -sa * lift[i]],
                [s * sa, c * sa, ca, ca * lift[i]],
                [0.0, 0.0, 0.0, 1.0],
            ]
        )
        here = here @ step
        frames[i] = here
    return frames


def jacobian(arm: ArmProfile, q: ArrayLike, at: ArrayLike = WRIST_CENTRE) -> FloatArray:
    """Geometric Jacobian, shape (6, 7), in the base's axes: velocity [m/rad], angular velocity.

    Args:
        arm: its lengths.
        q: joint angles [rad], shape (7,).
        at: the point that moves, in the frame of the wrist [m], shape (3,).

    Raises:
        MechanismError: as `seven`.
    """
    x, y, z = frozen(at, (3,), "at").tolist()
    out = np.empty((6, JOINTS))
    kernels.jacobian_kernel(seven(q), arm.lengths, (x, y, z), out)
    return out


def arm_branch(q: ArrayLike) -> ArmBranch:
    """Branch of joint angles in (-π, π], shape (7,).

    Raises:
        MechanismError: as `seven`.
    """
    angles = seven(q)
    return ArmBranch(*(1 if angles[k] >= 0.0 else -1 for k in (1, 3, 5)))


def arm_angle(arm: ArmProfile, q: ArrayLike) -> float:
    """Arm angle ψ of joint angles q [rad], shape (7,), in (-π, π].

    Right-handed about the line from shoulder to wrist; zero is the solution with θ3 = 0,
    θ1 = atan2(p_y, p_x) and the same sign of θ4. Defined with the elbow stretched too; with the
    wrist centre on the axis of joint 1, from θref = 0.

    Raises:
        MechanismError: as `seven`.
    """
    angle, _ = kernels.arm_angle_kernel(seven(q), arm.lengths, 0.0)
    return float(angle)


def decoupled(
    arm: ArmProfile, pose: RigidTransform, keep: tuple[float, float] = (0.0, 0.0)
) -> tuple[ArmSolution, ...]:
    """All eight solutions with θ3 = 0, whatever the joint limits (section 2.2.1, errata D3 to D5).

    In the order of the signs of s1 (θ1 = atan2(p_y, p_x), or half a turn on), θ4 and θ6.

    Args:
        arm: its lengths.
        pose: ⁰T₇.
        keep: θ1 and θ5 to keep where they are not defined [rad].

    Raises:
        UnreachableError: if the wrist centre is too far from the shoulder, or too near.
        DegenerateError: if it is in the shoulder itself (links of one length).
    """
    out, singular = np.empty((8, JOINTS)), np.empty(8, np.int64)
    rotation, position = pose_arrays(pose)
    status = kernels.eight_kernel(rotation, position, arm.lengths, keep, out, singular)
    check(status, in_words(arm, pose))
    found = []
    for q, bits in zip(out, singular, strict=True):
        angle, _ = kernels.arm_angle_kernel(q, arm.lengths, keep[0])
        found.append(solution(arm, q, float(angle), int(bits)))
    return tuple(found)


def inverse(
    arm: ArmProfile,
    pose: RigidTransform,
    arm_angle: float,
    branch: ArmBranch,
    keep: tuple[float, float] = (0.0, 0.0),
) -> ArmSolution:
    """Joint angles of a pose at an arm angle [rad] in a branch, whatever the joint limits.

    Args:
        arm: its lengths and limits.
        pose: ⁰T₇.
        arm_angle: ψ, as `arm_angle` says.
        branch: signs of θ2, θ4, θ6.
        keep: θ1 and θ5 to keep where they are not defined [rad].

    Raises:
        MechanismError: as `decoupled`; `NotFiniteError` for an arm angle that is not finite.
    """
    rotation, position = pose_arrays(pose)
    out = np.empty(JOINTS)
    status, bits = kernels.redundant_kernel(
        rotation, position, arm.lengths, arm_angle, branch.signs, keep, out
    )
    check(status, f"{in_words(arm, pose)}, arm angle {arm_angle} rad")
    return solution(arm, out, float(kernels.wrapped(np.remainder(arm_angle, 2.0 * np.pi))), bits)


def solution(arm: ArmProfile, q: FloatArray, angle: float, bits: int) -> ArmSolution:
    """Wrap what a kernel found."""
    margin = float(np.minimum(arm.upper - q, q - arm.lower).min())
    return ArmSolution(frozen(q), angle, arm_branch(q), named_singularities(bits), margin)


def in_words(arm: ArmProfile, pose: RigidTransform) -> str:
    """Return where the wrist centre of a pose is, and how far the links reach, for messages.

    Beyond them the nearest place that they reach is offered.
    """
    shoulder = np.array([0.0, 0.0, arm.pedestal])
    away = pose.translation - shoulder
    reach = float(np.linalg.norm(away))
    least, most = abs(arm.upper_arm - arm.forearm), arm.upper_arm + arm.forearm
    x, y, z = pose.translation
    words = sentence(
        "wrist centre ({x:.6g}, {y:.6g}, {z:.6g}) m is {reach:.6g} m from the shoulder; the "
        "links span {least:.4g} to {most:.4g} m",
        x=x,
        y=y,
        z=z,
        reach=reach,
        least=least,
        most=most,
    )
    within = min(max(reach, least), most)
    if within == reach or not 0.0 < reach < float("inf"):
        return sentence(
            "{refusal}; nearest_pose gives the nearest that is within the joint limits",
            refusal=words,
        )
    x, y, z = shoulder + within / reach * away
    return sentence(
        "{refusal}; the nearest that they reach is ({x:.4f}, {y:.4f}, {z:.4f}) m (nearest_pose)",
        refusal=words,
        x=x,
        y=y,
        z=z,
    )
