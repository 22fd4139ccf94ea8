"""Hard cases of the hand: a finger at its axis or stretched, grasps that hardly close or never."""

from collections.abc import Callable
from dataclasses import replace
from math import sqrt
from typing import Any, Final

import numpy as np

from app.arm.hand import (
    Contacts,
    FirmGrasp,
    GraspError,
    HandFinger,
    HandGeometry,
    Lever,
    SoftContact,
    ToolShaft,
    approach,
    close_hand,
    force_closure,
    forward,
    inverse,
    jacobian,
    load_hand,
    press,
)
from app.core.arrays import FloatArray
from app.mechanisms.errors import UnreachableError
from app.studies.hard_cases.case import HardCase, analytic, answers, digits, named

DECLARATION: Final[dict[str, Any]] = {
    "title": "The hand",
    "subsystems": {"grasping": "dynamics"},
}

HAND: Final = load_hand().hand
STRAIGHT: Final = replace(HAND, bend=0.0, distal=0.055)
"""A finger that can be stretched."""
LINE: Final = np.array([1.0, 2.0, -0.5]) / sqrt(5.25)
ACROSS: Final = np.array([2.0, -1.0, 0.0]) / sqrt(5.0)
COLLINEAR: Final = 0.02 * np.outer((-1.0, 0.2, 1.3), LINE)
_DRIVE: Final = load_hand().drive


def _joints(geometry: HandGeometry, p: Any) -> FloatArray:
    return inverse(geometry, p).joints


def _fingers() -> tuple[HardCase, ...]:
    beside = digits("joints of a finger, its point 1 nm beside the spread axis")
    stretched = digits("joints of a stretched finger without bend")
    rates = digits("jacobian of a finger, its point near the spread axis")
    rho, z = stretched.given
    height = beside.given[2]

    def keeps() -> bool:
        found = inverse(HAND, (0.0, 0.0, height), HandFinger.TWO, phi1_now=0.3)
        return found.any_spread and found.joints[0] == 0.3

    on_axis = np.array([0.0, 0.0, height])

    def nothing_moves() -> bool:
        found = inverse(HAND, on_axis, HandFinger.TWO, phi1_now=0.3)
        moved = jacobian(HAND, found.joints)
        return bool(found.any_spread and np.abs(moved[:, 0]).max() < 1e-16)

    return (
        HardCase(
            subsystem="kinematics",
            case="joints of a finger whose point is on its spread axis",
            given="p = (0, 0, 85) mm in the finger's frame, spread by 0.3 rad before",
            way=inverse,
            found=lambda way: [
                (q := way(HAND, on_axis, HandFinger.TWO, 0.3).joints)[0],
                *(forward(HAND, q) - on_axis),
            ],
            reference=analytic("the spread is kept, the point is met", (0.3, 0.0, 0.0, 0.0)),
            unit="rad, m",
            bound=1e-16,
            beyond=answers("said to be free, and the spread moves nothing there", nothing_moves),
        ),
        HardCase(
            subsystem="kinematics",
            case="joints of a finger whose point is 1 nm beside its spread axis",
            given="p = (0.6, 0.8, 8.5e7) nm in the finger's frame",
            way=inverse,
            found=lambda way: way(HAND, np.array(beside.given), HandFinger.TWO).joints,
            reference=beside,
            unit="rad",
            bound=1e-15,
            beyond=answers("on the axis the finger keeps the spread that it has", keeps),
        ),
        HardCase(
            subsystem="kinematics",
            case="joints of a finger where the arccos would be of 1 + 2.2e-16",
            given="no bend, L3 = 55 mm, the point at L2 + L3 from joint 2, to rounding",
            way=_joints,
            found=lambda way: way(STRAIGHT, (rho, 0.0, z))[1:],
            reference=stretched,
            unit="rad",
            bound=3e-8,  # √ε: so little bends it, and so little is known of it
            beyond=named(
                UnreachableError,
                lambda: inverse(STRAIGHT, (rho * (1.0 + 1e-9), 0.0, z * (1.0 + 1e-9))),
            ),
        ),
        HardCase(
            subsystem="kinematics",
            case="Jacobian of a finger whose point is 11 µm beside its spread axis",
            given="φ = (0.3, 1.508, 0.4935) rad",
            way=jacobian,
            found=lambda way: way(HAND, np.array(rates.given)),
            reference=rates,
            unit="m/rad",
            bound=1e-16,
            beyond=answers(
                "on the axis φ1 moves nothing, and all else is finite",
                lambda: bool(
                    np.isfinite(found := jacobian(HAND, inverse(HAND, (0, 0, height)).joints)).all()
                    and np.abs(found[:, 0]).max() < 1e-16
                ),
            ),
        ),
    )


def _pair(nx: float, ny: float, mu: float) -> Contacts:
    points = np.array([(-1.0, 0.0), (1.0, 0.0)])
    return Contacts(points, np.array([(1.0, 0.0), (nx, ny)]), mu)


def _said(contacts: Contacts) -> Callable[[Callable[..., Any]], list[float]]:
    def found(way: Callable[..., Any]) -> list[float]:
        closure = way(contacts)
        return [float(closure.closed), float(closure.rank), closure.margin]

    return found


def _margins() -> tuple[HardCase, ...]:
    slight = digits("margin of two opposed contacts, friction 1e-9")
    inside = digits("margin of two contacts, one 1e-9 rad inside its cone")
    nx, ny, mu = inside.given
    return (
        HardCase(
            subsystem="grasping",
            case="margin of two opposed contacts with friction 1e-9",
            given="points 2 m apart, torque scale 1 m",
            way=force_closure,
            found=lambda way: way(_pair(-1.0, 0.0, slight.given[0])).margin,
            reference=slight,
            unit="1",
            bound=1e-14,
            relative=True,
            beyond=answers(
                "open without friction, and the wrenches' rank says why",
                lambda: force_closure(_pair(-1.0, 0.0, 0.0)).rank == 1,
            ),
        ),
        HardCase(
            subsystem="grasping",
            case="margin where the line of two contacts is 1e-9 rad inside a cone",
            given="the second normal turned by 0.4 rad, μ = tan(0.4 + 1e-9)",
            way=force_closure,
            found=lambda way: way(_pair(nx, ny, mu)).margin,
            reference=inside,
            unit="N per N",
            bound=1e-15,
            beyond=answers(
                "open at margin 0 where the line is 1e-9 rad outside",
                lambda: not force_closure(_pair(nx, ny, np.tan(0.4 - 1e-9))).closed,
            ),
        ),
    )


def _never() -> tuple[HardCase, ...]:
    normals = np.array([ACROSS, -ACROSS, ACROSS])
    in_line = Contacts(COLLINEAR, normals, 0.8)
    thin = Contacts(COLLINEAR - 1e-6 * normals, normals, 0.8)
    triangle = 0.02 * np.array([(1.0, 0.0, 0.0), (-0.5, 0.8, 0.0), (-0.5, -0.8, 0.0)])
    parallel = Contacts(triangle, np.tile((0.0, 0.0, 1.0), (3, 1)), 0.8)
    against = Contacts(
        np.vstack([triangle, (0.0, 0.0, 0.02)]),
        np.vstack([parallel.normals, (0.0, 0.0, -1.0)]),
        0.8,
    )
    tool = ToolShaft(np.array([0.3, 0.2, 0.1]), np.array([1.0, 0.2, 0.0]), 5e-3)
    T_world_hand = approach(HAND, tool, (0.0, 0.0, -1.0))
    slippery = close_hand(HAND, tool.seen_from(T_world_hand.inverse()))
    nothing = "closed, rank, margin"
    return (
        HardCase(
            subsystem="grasping",
            case="three contacts on one line, which none of them can turn",
            given="hard fingers, μ = 0.8, normals across the line",
            way=force_closure,
            found=_said(in_line),
            reference=analytic(f"{nothing}: no torque about the line", (0.0, 5.0, 0.0)),
            unit="1",
            bound=0.0,
            beyond=answers(
                "closed with a margin below 1e-4 on a rod of 1 µm about the line",
                lambda: 0.0 < force_closure(thin).margin < 1e-4,
            ),
        ),
        HardCase(
            subsystem="grasping",
            case="contacts whose normals are parallel, and all push one way",
            given="three hard fingers, μ = 0.8",
            way=force_closure,
            found=_said(parallel),
            reference=analytic(f"{nothing}: nothing pushes back", (0.0, 6.0, 0.0)),
            unit="1",
            bound=0.0,
            beyond=answers(
                "closed with a fourth from the other side",
                lambda: force_closure(against).closed,
            ),
        ),
        HardCase(
            subsystem="grasping",
            case="the hand on a cylinder without friction",
            given="three tips on 5 mm, μ = 0",
            way=force_closure,
            found=_said(slippery.contacts(0.0)),
            reference=analytic(f"{nothing}: a force and a couple", (0.0, 2.0, 0.0)),
            unit="1",
            bound=0.0,
            beyond=answers(
                "closed with a margin below 1e-6 at friction 1e-6",
                lambda: 0.0 < force_closure(slippery.contacts(1e-6)).margin < 1e-6,
            ),
        ),
    )


def pressed(softer: float) -> FloatArray:
    """Return force and overshoot [N] of a grasp whose gain is for something softer, shape (2,)."""
    lever = Lever(free=8e-4, alone=3e-4, arm=0.09, breakaway=0.5)
    law = FirmGrasp(
        4.0, lever, SoftContact(1e9 / softer), _DRIVE.lag, _DRIVE.period, _DRIVE.top_speed
    )
    found = press(law, SoftContact(1e9), 2.0)
    return np.array([found.force[-1], found.overshoot(4.0)])


def _stiff() -> HardCase:
    def gained(gain: float) -> None:
        lever = Lever(free=8e-4, alone=3e-4, arm=0.09, breakaway=0.5)
        FirmGrasp(4.0, lever, SoftContact(1e9), _DRIVE.lag, _DRIVE.period, 1.0, gain)

    return HardCase(
        subsystem="grasping",
        case="a firm grasp of something as stiff as 1e9 N/m",
        given="4 N asked for, 2 ms a period; force after 2 s, and overshoot",
        way=pressed,
        found=lambda way: way(1.0),
        reference=analytic("the goal, and none", (4.0, 0.0)),
        unit="N",
        bound=1e-9,
        beyond=named(GraspError, lambda: gained(1.0)),
    )


CASES: Final = (*_fingers(), *_margins(), *_never(), _stiff())
"""Fingers, force closure, a firm grasp."""
