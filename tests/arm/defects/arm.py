"""Defects of the arm's hard cases: arc cosines and arc tangents as printed, scans, squares."""

from dataclasses import replace
from math import acos, atan2, cos, degrees, pi
from typing import Any

import numpy as np

from app.arm.hard_cases.arm import SHOULDER
from app.arm.mechanics import (
    ARM_BRANCHES,
    TURN_LENGTH,
    ArmProfile,
    JointLimitError,
    arm_singularity,
    decoupled,
    forward,
    inverse,
    jacobian,
    link_frames,
    solve,
)
from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from tests.hard.defects import Defect


def lean_by_acos(arm: ArmProfile, pose: RigidTransform) -> Any:
    away = pose.translation - SHOULDER
    lost = acos(away[2] / float(np.linalg.norm(away))) - atan2(
        float(np.hypot(away[0], away[1])), away[2]
    )
    first = decoupled(arm, pose)[0]
    return (replace(first, q=first.q + lost * np.eye(7)[1]),)


def by_arctangent(arm: ArmProfile, pose: RigidTransform, keep: Any) -> Any:
    return decoupled(arm, pose, (0.0, keep[1]))


def apart(arm: ArmProfile, pose: RigidTransform, keep: Any) -> Any:
    first = decoupled(arm, pose, keep)[0]
    m = forward(arm, [*first.q[:4], 0.0, 0.0, 0.0]).rotation.T @ pose.rotation
    angles = atan2(m[1, 2], m[0, 2]), first.q[5], atan2(m[2, 1], -m[2, 0])
    return (replace(first, q=np.array([*first.q[:4], *angles])),)


def printed(arm: ArmProfile, pose: RigidTransform) -> Any:
    # acos, which is what √(1 - k²) beside k gives
    first = decoupled(arm, pose)[0]
    q = first.q.copy()
    q[5] = acos(min(1.0, cos(q[5])))
    return (replace(first, q=q),)


def each_for_itself(arm: ArmProfile, pose: RigidTransform, *arguments: Any) -> Any:
    # θ5 and θ7 each for itself, as the paper (and every textbook) prints them
    found = inverse(arm, pose, *arguments)
    q = found.q.copy()
    m = forward(arm, [*q[:4], 0.0, 0.0, 0.0]).rotation.T @ pose.rotation
    q[4], q[6] = atan2(m[1, 2], m[0, 2]), atan2(m[2, 1], -m[2, 0])
    return replace(found, q=q)


def untied(arm: ArmProfile, pose: RigidTransform) -> Any:
    down, up = decoupled(arm, pose)[0], decoupled(arm, pose)[2]
    return (replace(down, q=np.where(np.arange(7) == 1, up.q, down.q)),)


def by_squares(arm: ArmProfile, angles: FloatArray) -> Any:
    weighed = jacobian(arm, angles)
    weighed[3:] *= TURN_LENGTH
    values = np.linalg.eigvalsh(weighed @ weighed.T)
    return replace(
        arm_singularity(arm, angles), dexterity=float(np.sqrt(abs(values[0]) / values[-1]))
    )


def by_places(arm: ArmProfile, angles: FloatArray) -> float:
    there = forward(arm, angles)
    axis = (there.translation - SHOULDER) / np.linalg.norm(there.translation - SHOULDER)

    def across(posture: FloatArray) -> FloatArray:
        elbow = link_frames(arm, posture)[3][:3, 3] - SHOULDER
        return np.asarray(elbow - axis * (axis @ elbow))

    a, b = across(decoupled(arm, there)[0].q), across(angles)
    return atan2(float(axis @ np.cross(a, b)), float(a @ b))


def by_acos(arm: ArmProfile, pose: RigidTransform) -> Any:
    away = float(np.linalg.norm(pose.translation - SHOULDER))
    a, b = arm.upper_arm, arm.forearm
    above = np.nextafter((away**2 - a**2 - b**2) / (2.0 * a * b), 2.0)
    with np.errstate(invalid="ignore"):
        return replace(solve(arm, pose), q=np.full(7, np.arccos(max(above, 1.0 + 2.3e-16))))


def open_ended(arm: ArmProfile, pose: RigidTransform) -> Any:
    far = replace(arm, lower=1.001 * arm.lower, upper=1.001 * arm.upper)
    inside = RigidTransform(pose.rotation, SHOULDER + 0.9999 * (pose.translation - SHOULDER))
    return solve(far, inside)


def by_scan(arm: ArmProfile, pose: RigidTransform) -> Any:
    found = [
        inverse(arm, pose, angle, branch)
        for angle in np.linspace(-pi, pi, 360)
        for branch in ARM_BRANCHES
    ]
    best = max(found, key=lambda one: one.margin)
    if best.margin < 0.0:
        raise JointLimitError(f"the best of the scan is {degrees(-best.margin)}° beyond")
    return best


DEFECTS = {
    "kinematics": {
        "arm: first joint and pose with the wrist centre on the first axis": Defect(
            "θ1 = atan2(p_y, p_x), of zeros", by_arctangent
        ),
        "arm: joint angles with the wrist centre 1 nm from the first axis": Defect(
            "lean of the wrist centre by acos, which loses 1e-9", lean_by_acos
        ),
        "arm: fifth and seventh joint and pose with the wrist aligned": Defect(
            "θ5 and θ7 each by the arc tangent of zeros", apart
        ),
        "arm: sixth joint 1e-8 rad from an aligned wrist": Defect(
            "θ6 from √(1 - k²), as printed", printed
        ),
        "arm: the pose is met with the wrist 1e-9 rad from aligned": Defect(
            "θ5 and θ7 each for itself", each_for_itself
        ),
        "arm: dexterity with the elbow stretched, where outwards is lost": Defect(
            "roots of the eigenvalues of J Jᵀ, which square the smallest", by_squares
        ),
        **dict.fromkeys(
            (
                f"arm: second and fourth joint with the elbow {short} short of stretched"
                for short in ("1e-06", "1e-12")
            ),
            Defect("signs of θ2 and θ4 not tied, as printed", untied),
        ),
        "arm: arm angle with the elbow 1e-9 rad from stretched": Defect(
            "by the places of the two elbows, in doubles", by_places
        ),
        "arm: a target on the outer skin of the workspace, one bit beyond": Defect(
            "acos of the law of cosines, one bit above 1", by_acos
        ),
        "arm: a target on the inner skin, joint 4 at its limit": Defect(
            "limits with a share of room", open_ended
        ),
        "arm: joint 2 at its limit on the only branch, at the only arm angle": Defect(
            "a scan of 360 arm angles", by_scan
        ),
    },
}
