"""Hard cases of the arm: first axis, aligned wrist, stretched elbow, edges of reach, a limit."""

from typing import Any, Final

import numpy as np

from app.arm.mechanics import (
    ARM_BRANCHES,
    ArmSingularity,
    JointLimitError,
    arm_angle,
    arm_singularity,
    decoupled,
    forward,
    inverse,
    load_arm,
    nearest_pose,
    solve,
)
from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.mechanisms.errors import NotFiniteError, UnreachableError
from app.studies.hard_cases.case import HardCase, ReferenceValue, analytic, answers, digits, named

DECLARATION: Final[dict[str, Any]] = {
    "title": "The arm's kinematics",
}

ARM: Final = load_arm()
SHOULDER: Final = np.array([0.0, 0.0, ARM.pedestal])
REACH: Final = ARM.upper_arm + ARM.forearm
WAY: Final = np.array([0.48, 0.64, 0.6])
"""A direction from the shoulder, with entries that are no powers of two."""

ONLY: Final = (0.1, float(ARM.upper[1]), 0.0, -0.8, 0.1, 0.5, 0.1)
"""Joint 2 at its limit, the elbow as high as it can be: at every other arm angle it is lower. The
other branches need joint 1 or 5 half a turn on, which is beyond theirs."""


def _pose(reference: ReferenceValue) -> RigidTransform:
    return RigidTransform(
        np.array(reference.given[3:]).reshape(3, 3), np.array(reference.given[:3])
    )


def _at(distance: float) -> RigidTransform:
    turn = forward(ARM, (0.3, 0.2, 0.1, 0.9, 0.4, 0.6, 0.2)).rotation
    return RigidTransform(turn, SHOULDER + distance * WAY)


def _off(q: FloatArray, there: RigidTransform) -> FloatArray:
    """Difference of the pose of a posture from another, twelve numbers."""
    return np.asarray((forward(ARM, q).matrix() - there.matrix())[:3].ravel())


def _beside_the_first_axis() -> HardCase:
    reference = digits("arm, wrist centre 1 nm from the first axis")
    there = _pose(reference)

    def kept() -> bool:
        on_axis = RigidTransform(there.rotation, np.array([0.0, 0.0, there.translation[2]]))
        found = decoupled(ARM, on_axis, keep=(0.7, 0.0))[0]
        return bool(found.q[0] == 0.7 and np.abs(_off(found.q, on_axis)).max() < 1e-15)

    return HardCase(
        subsystem="kinematics",
        case="arm: joint angles with the wrist centre 1 nm from the first axis",
        given="p = (0.6, 0.8) nm beside it, 0.54 m above the shoulder",
        way=decoupled,
        found=lambda way: way(ARM, there)[0].q,
        reference=reference,
        unit="rad",
        bound=3e-15,
        beyond=answers("on the axis: θ1 is kept, the pose reached to 1e-15", kept),
    )


def _on_the_first_axis() -> HardCase:
    turn = forward(ARM, (0.3, 0.2, 0.1, 0.9, 0.4, 0.6, 0.2)).rotation
    there = RigidTransform(turn, SHOULDER + np.array([0.0, 0.0, 0.54]))

    def every() -> bool:
        found = [decoupled(ARM, there, (keep, 0.0)) for keep in np.linspace(-3.0, 3.0, 7)]
        return all(np.abs(_off(one.q, there)).max() < 1e-15 for eight in found for one in eight)

    return HardCase(
        subsystem="kinematics",
        case="arm: first joint and pose with the wrist centre on the first axis",
        given="wrist centre 0.54 m above the shoulder, θ1 = 0.7 rad to be kept",
        way=decoupled,
        found=lambda way: [
            (q := way(ARM, there, (0.7, 0.0))[0].q)[0],
            *_off(q, there),
        ],
        reference=analytic("θ1 is kept, and the pose is met", [0.7, *np.zeros(12)]),
        unit="rad, m, 1",
        bound=1e-15,
        beyond=answers("whatever is kept, all eight meet the pose", every),
    )


def _wrist_aligned() -> HardCase:
    q = np.array([0.3, 0.7, 0.0, 0.9, 0.3, 0.0, 0.4])
    there = forward(ARM, q)

    def named_wrist() -> bool:
        return ArmSingularity.WRIST in decoupled(ARM, there, (0.0, -0.5))[0].singular

    return HardCase(
        subsystem="kinematics",
        case="arm: fifth and seventh joint and pose with the wrist aligned",
        given="the pose of θ = (0.3, 0.7, 0, 0.9, 0.3, 0, 0.4), θ5 = -0.5 rad to be kept",
        way=decoupled,
        found=lambda way: [
            (found := way(ARM, there, (0.0, -0.5))[0].q)[4],
            found[4] + found[6],
            *_off(found, there),
        ],
        reference=analytic("θ5 is kept, θ5 + θ7 = 0.7, the pose is met", [-0.5, 0.7, *[0.0] * 12]),
        unit="rad, m, 1",
        bound=1e-15,
        beyond=answers("named: the wrist", named_wrist),
    )


def _wrist_almost_aligned() -> HardCase:
    reference = digits("arm, sixth joint 1e-8 rad from aligned")
    there = _pose(reference)

    return HardCase(
        subsystem="kinematics",
        case="arm: sixth joint 1e-8 rad from an aligned wrist",
        given="the pose of θ = (0.3, 0.7, 0, 0.9, 0.4, 1e-8, 0.2)",
        way=decoupled,
        found=lambda way: way(ARM, there)[0].q[5],
        reference=reference,
        unit="rad",
        bound=1e-15,
        beyond=answers("aligned: θ5 is kept, θ5 + θ7 right to 1e-15", _aligned),
    )


def _aligned() -> bool:
    q = np.array([0.3, 0.7, 0.0, 0.9, 0.3, 0.0, 0.4])
    found = decoupled(ARM, forward(ARM, q), keep=(0.0, -0.5))[0].q
    return bool(abs(found[4] + 0.5) < 1e-15 and abs(found[4] + found[6] - 0.7) < 1e-15)


def _wrist_closes() -> HardCase:
    aligned = (0.3, 0.7, 0.2, 0.9, 0.4, 1e-9, 0.2)
    there, angle, branch = forward(ARM, aligned), arm_angle(ARM, aligned), ARM_BRANCHES[0]

    return HardCase(
        subsystem="kinematics",
        case="arm: the pose is met with the wrist 1e-9 rad from aligned",
        given="the pose of θ = (0.3, 0.7, 0.2, 0.9, 0.4, 1e-9, 0.2)",
        way=inverse,
        found=lambda way: _off(way(ARM, there, angle, branch).q, there),
        reference=analytic("forward of inverse is the pose: 0", np.zeros(12)),
        unit="m, 1",
        bound=1e-15,
        beyond=named(NotFiniteError, lambda: inverse(ARM, there, float("nan"), branch)),
    )


def _almost_stretched(short: str) -> HardCase:
    reference = digits(f"arm, wrist centre {short} short of stretched")
    there = RigidTransform(np.eye(3), np.array(reference.given))

    return HardCase(
        subsystem="kinematics",
        case=f"arm: second and fourth joint with the elbow {short} short of stretched",
        given=f"wrist centre at 0.82 m (1 - {short}) from the shoulder",
        way=decoupled,
        found=lambda way: way(ARM, there)[0].q[[1, 3]],
        reference=reference,
        unit="rad",
        bound=1e-15 / float(reference.value[1]),  # no formula is better than ε / θ4
        beyond=named(UnreachableError, lambda: solve(ARM, _at(REACH * (1.0 + 1e-9)))),
    )


def _stretched() -> HardCase:
    q = np.array([0.3, 0.7, 0.5, 0.0, 0.4, 0.6, 0.2])
    there = forward(ARM, q)

    def met() -> bool:
        found = solve(ARM, there)
        kinds = arm_singularity(ARM, q).kinds
        return bool(np.abs(_off(found.q, there)).max() < 1e-15 and ArmSingularity.ELBOW in kinds)

    return HardCase(
        subsystem="kinematics",
        case="arm: dexterity with the elbow stretched, where outwards is lost",
        given="θ = (0.3, 0.7, 0.5, 0, 0.4, 0.6, 0.2)",
        way=arm_singularity,
        found=lambda way: [way(ARM, q).dexterity, way(ARM, q).elbow],
        reference=analytic("0: no joint moves the wrist centre outwards", (0.0, 0.0)),
        unit="1",
        bound=1e-15,
        beyond=answers("the pose is met all the same, and the elbow is named", met),
    )


def _arm_angle_stretched() -> HardCase:
    reference = digits("arm angle, elbow 1e-9 rad from stretched")
    q = np.array(reference.given)

    def stretched() -> bool:
        straight = np.where(np.arange(7) == 3, 0.0, q)
        return abs(arm_angle(ARM, straight) - float(reference.value[0])) < 1e-8

    return HardCase(
        subsystem="kinematics",
        case="arm: arm angle with the elbow 1e-9 rad from stretched",
        given="θ = (0.3, 0.7, 0.5, 1e-9, 0.4, 0.6, 0.2)",
        way=arm_angle,
        found=lambda way: way(ARM, q),
        reference=reference,
        unit="rad",
        bound=1e-15,
        beyond=answers("stretched: still defined, by the normal of the elbow plane", stretched),
    )


def _skin() -> HardCase:
    there = _at(REACH * (1.0 + 2.3e-16))

    return HardCase(
        subsystem="kinematics",
        case="arm: a target on the outer skin of the workspace, one bit beyond",
        given="wrist centre at 0.82 m (1 + 2.3e-16) from the shoulder",
        way=solve,
        found=lambda way: _off(way(ARM, there).q, there),
        reference=analytic("forward of the solution is the pose: 0", np.zeros(12)),
        unit="m, 1",
        bound=1e-15,
        beyond=answers(
            "refused by UnreachableError at 1e-9 more, and the nearest pose is offered", _offered
        ),
    )


def _offered() -> bool:
    beyond = _at(REACH * (1.0 + 1e-9))
    refused = named(UnreachableError, lambda: solve(ARM, beyond)).happens()
    return refused and nearest_pose(ARM, beyond).shift < 1e-9


def _inner_skin() -> HardCase:
    folded = np.array([0.3, 0.4, 0.5, ARM.upper[3], 0.2, 0.6, 0.7])
    there = forward(ARM, folded)

    return HardCase(
        subsystem="kinematics",
        case="arm: a target on the inner skin, joint 4 at its limit",
        given="the pose of θ4 = 120°",
        way=solve,
        found=lambda way: [*_off(way(ARM, there).q, there), abs(way(ARM, there).q[3])],
        reference=analytic("the pose, and |θ4| = 120°", [*np.zeros(12), float(ARM.upper[3])]),
        unit="m, rad",
        bound=1e-15,
        beyond=named(
            JointLimitError, lambda: solve(ARM, forward(ARM, folded + 1e-6 * np.eye(7)[3]))
        ),
    )


def _only_branch() -> HardCase:
    there = forward(ARM, ONLY)

    further = np.array(ONLY) + 1e-6 * np.eye(7)[1]
    return HardCase(
        subsystem="kinematics",
        case="arm: joint 2 at its limit on the only branch, at the only arm angle",
        given="the pose of θ = (0.1, 120°, 0, -0.8, 0.1, 0.5, 0.1)",
        way=solve,
        found=lambda way: way(ARM, there).q,
        reference=analytic("the joint angles it was made of", ONLY),
        unit="rad",
        bound=1e-7,  # the arm angle of a touching root: √ε
        beyond=named(JointLimitError, lambda: solve(ARM, forward(ARM, further))),
    )


CASES: Final = (
    _on_the_first_axis(),
    _beside_the_first_axis(),
    _wrist_aligned(),
    _wrist_almost_aligned(),
    _wrist_closes(),
    _stretched(),
    _almost_stretched("1e-06"),
    _almost_stretched("1e-12"),
    _arm_angle_stretched(),
    _skin(),
    _inner_skin(),
    _only_branch(),
)
"""All of them."""
