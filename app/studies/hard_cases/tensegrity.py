"""Hard cases of the tensegrity needle holder: stretched, folded, flat; cables without a lever."""

from collections.abc import Callable
from math import pi
from typing import Any, Final

import numpy as np

from app.mechanisms.errors import DegenerateError, NotFiniteError, SingularError, UnreachableError
from app.mechanisms.tensegrity import (
    Cables,
    CableTensions,
    GuideMasses,
    JointReading,
    TensegrityGeometry,
    TensionVerdict,
    conditioning,
    forward,
    guide_stiffness,
    inverse,
    jacobian,
    jacobian_rate,
    joint_rates,
    joint_stiffness,
    length_curvature,
    length_jacobian,
    machine_points,
    nearest,
    tensions,
    torque_limits,
    trilaterate,
)
from app.mechanisms.tensegrity.dynamics import guide_dynamics
from app.studies.hard_cases.case import HardCase, analytic, answers, digits, named

PAPER: Final = TensegrityGeometry()
SCISSOR: Final = TensegrityGeometry(reading=JointReading.SCISSOR)
CABLES: Final = Cables()

_Way = Callable[..., Any]


def _edge(geometry: TensegrityGeometry, short: str, bound: float) -> HardCase:
    reading = geometry.reading.value
    reference = digits(f"joint variables, {reading}, θ1 {short} inside the edge")
    past = np.array(reference.given) - 2e-3 * geometry.bases[0]
    return HardCase(
        subsystem="kinematics",
        case=f"joint variables of a {reading} holder {short} rad inside its cone's edge (β → 0)",
        given="t at the largest θ1, towards the zenith",
        way=inverse,
        found=lambda way: way(geometry, np.array(reference.given)),
        reference=reference,
        unit="rad",
        bound=bound,  # one bit of θ over β
        beyond=named(UnreachableError, lambda: inverse(geometry, past)),
    )


def _beside(geometry: TensegrityGeometry, gap: str) -> HardCase:
    reading = geometry.reading.value
    reference = digits(f"joint variables, {reading}, T {gap} from A1")
    return HardCase(
        subsystem="kinematics",
        case=f"joint variables of a {reading} holder with T {gap} rad from A1 (β → π)",
        given="t beside the first base joint",
        way=inverse,
        found=lambda way: way(geometry, np.array(reference.given)),
        reference=reference,
        unit="rad",
        bound=2e-15,
        beyond=answers(
            "exactly π with T on A1",
            lambda: bool(abs(inverse(geometry, geometry.bases[0])[0] - pi) < 1e-15),
        ),
    )


def _low(height: str, bound: float) -> HardCase:
    reference = digits(f"direction, D = {height}")
    return HardCase(
        subsystem="kinematics",
        case=f"direction of a guide {height} over the plane of both base axes",
        given=f"β with t·(a1 × a2) = {height}",
        way=forward,
        found=lambda way: way(PAPER, np.array(reference.given)),
        reference=reference,
        unit="1",
        bound=bound,  # a few bits of β over D
        beyond=named(UnreachableError, lambda: forward(PAPER, np.array(reference.given) + 1e-3)),
    )


def _flat_jacobian(height: str) -> HardCase:
    reference = digits(f"jacobian of the guide, D = {height}")
    flat = conditioning(PAPER, digits("direction, discriminant -1e-15").given, tolerance=1e-7)
    return HardCase(
        subsystem="kinematics",
        case=f"Jacobian of a guide {height} over the plane of both base axes",
        given=f"β with t·(a1 × a2) = {height}",
        way=jacobian,
        found=lambda way: way(PAPER, np.array(reference.given)),
        reference=reference,
        unit="1",
        bound=2e-16 / float(height) ** 2,  # D itself is known to a few bits over D
        relative=True,
        beyond=answers("named FLAT, its gain not given", lambda: "flat" in flat.kinds),
    )


def _rate() -> HardCase:
    reference = digits("rate of the guide's jacobian, D = 1e-3")
    beta, rates = np.array(reference.given[:2]), np.array(reference.given[2:])

    return HardCase(
        subsystem="kinematics",
        case="rate of the Jacobian of a guide 1e-3 over the plane of both base axes",
        given="β̇ = (1, -2) rad/s",
        way=jacobian_rate,
        found=lambda way: way(PAPER, beta, rates),
        reference=reference,
        unit="1",
        bound=1e-8,
        relative=True,
        beyond=named(NotFiniteError, lambda: jacobian_rate(PAPER, beta, (np.nan, 0.0))),
    )


def _folded() -> HardCase:
    reference = digits("direction, T 1e-6 from A1")
    return HardCase(
        subsystem="kinematics",
        case="direction of a guide 1e-6 rad from A1",
        given="β1 → π",
        way=forward,
        found=lambda way: way(PAPER, np.array(reference.given)),
        reference=reference,
        unit="1",
        bound=2e-15,
        beyond=named(UnreachableError, lambda: forward(PAPER, (pi, 1.0))),
    )


def _both_up() -> HardCase:
    reference = digits("direction where both roots look up")

    return HardCase(
        subsystem="kinematics",
        case="the right one of two directions that both look up",
        given="β = (2.2, 2.8) rad",
        way=forward,
        found=lambda way: way(PAPER, np.array(reference.given)),
        reference=reference,
        unit="1",
        bound=1e-15,
        beyond=named(NotFiniteError, lambda: forward(PAPER, (np.inf, 1.0))),
    )


def _touching(sign: str) -> HardCase:
    reference = digits(f"direction, discriminant {sign}1e-15")
    apart = (reference.given[0], reference.given[1] + 1e-9)
    return HardCase(
        subsystem="kinematics",
        case=f"direction where the discriminant is {sign}1e-15",
        given="two cones that touch, to a few bits of β",
        way=forward,
        found=lambda way: way(PAPER, np.array(reference.given)),
        reference=reference,
        unit="1",
        bound=2e-8 if sign == "+" else 1e-14,  # a bit of β over √1e-15; in the plane
        beyond=named(UnreachableError, lambda: forward(PAPER, apart)),
    )


def _stretched_rates() -> HardCase:
    reference = digits("rates of the joints, β1 = 1e-6")

    return HardCase(
        subsystem="kinematics",
        case="joint rates of a pantograph 1e-6 rad from stretched",
        given="β = (1e-6, 1.9) rad",
        way=joint_rates,
        found=lambda way: way(PAPER, np.array(reference.given)),
        reference=reference,
        unit="1",
        bound=2e-15,
        relative=True,
        beyond=named(SingularError, lambda: joint_rates(PAPER, (0.0, 1.9))),
    )


def _joint() -> HardCase:
    reference = digits("joint B1, β1 = 1e-6")

    return HardCase(
        subsystem="kinematics",
        case="joint B of a pantograph 1e-6 rad from stretched",
        given="t of β = (1e-6, 1.9) rad",
        way=machine_points,
        found=lambda way: way(PAPER, forward(PAPER, reference.given)).points["B1"],
        reference=reference,
        unit="m",
        bound=1e-9,  # √ε of the radius: of t, β = 1e-6 is known to 1e-10
        beyond=named(DegenerateError, lambda: machine_points(PAPER, PAPER.bases[1])),
    )


def _middle() -> HardCase:
    shown = machine_points(PAPER, (0.1, 0.2, 1.0))
    a, end, radius = shown.points["A1"], shown.points["T1"], PAPER.first_radius
    chord = float(np.linalg.norm(a - shown.points["C1"]))
    apart = [np.zeros(3), a, end]

    return HardCase(
        subsystem="kinematics",
        case="joint C by trilateration: three spheres that touch in one point",
        given="t ~ (0.1, 0.2, 1)",
        way=trilaterate,
        found=lambda way: way(apart, [radius, chord, chord]).point,
        reference=analytic("R (a + t)/|a + t|, the middle of the arc", shown.points["C1"]),
        unit="m",
        bound=1e-15,
        beyond=named(
            UnreachableError, lambda: trilaterate(apart, [radius, 0.99 * chord, 0.99 * chord])
        ),
    )


def _offered() -> HardCase:
    corner = forward(PAPER, (0.0, 0.0))
    far = corner + 0.5 * np.cross(*PAPER.bases)  # seen over the corner of both rims

    outwards = -(PAPER.bases[0] + PAPER.bases[1])
    return HardCase(
        subsystem="kinematics",
        case="nearest direction of one far out of reach: the corner of two cones",
        given="t ~ -(a1 + a2), and a little up",
        way=nearest,
        found=lambda way: way(PAPER, outwards + 0.3 * far),
        reference=analytic("β = (0, 0)", corner),
        unit="1",
        bound=1e-15,
        beyond=named(DegenerateError, lambda: nearest(PAPER, (0.0, 0.0, 0.0))),
    )


def _tensions(words: str, bound: float) -> HardCase:
    reference = digits(f"tensions, {words}")
    b1, b2, torque1, torque2, _ = reference.given

    flat = words.startswith("D")
    return HardCase(
        subsystem="statics",
        case=f"tensions of least norm, {words}"
        + (": both pantographs in one plane, cables B1D1 and B2D2 parallel" if flat else ""),
        given="τ = (-0.5, 0.4) N·m, at least 2 N",
        way=tensions,
        found=lambda way: way(PAPER, CABLES, (b1, b2), (torque1, torque2)).tensions,
        reference=reference,
        unit="N",
        bound=bound,
        beyond=answers(
            "at β = 0 named singular, within the limits, the shortfall said",
            lambda: (
                _at_zero().verdicts[0] is TensionVerdict.SINGULAR
                and _at_zero().tensions.max() <= CABLES.most
                and abs(_at_zero().shortfall[0] - 0.5) < 0.3
            ),
        ),
    )


def _at_zero() -> CableTensions:
    return tensions(PAPER, CABLES, (0.0, 1.9), (0.5, 0.4))


def _limit() -> HardCase:
    reference = digits("largest torques, β1 = 1.5")
    high = float(reference.value[1])
    beta = (1.5, 1.5)
    other = float(torque_limits(PAPER, CABLES, beta)[1, 1])

    def numbers(way: _Way) -> Any:
        found = way(PAPER, CABLES, beta, (high, other + 1e-9))
        return [*found.tensions, *found.shortfall]

    return HardCase(
        subsystem="statics",
        case="a cable's limit met exactly, and a load 1e-9 N·m outside the tension polytope",
        given="β = (1.5, 1.5) rad, τ1 the largest, τ2 the largest and 1e-9 N·m",
        way=tensions,
        found=numbers,
        reference=analytic(
            "the corner of the polytope; nothing short, 1e-9 N·m short",
            [CABLES.least, CABLES.most, CABLES.least, CABLES.most, 0.0, 1e-9],
        ),
        unit="N or N·m",
        bound=2e-14,
        beyond=named(NotFiniteError, lambda: tensions(PAPER, CABLES, beta, (np.nan, 0.0))),
    )


def _polytope() -> HardCase:
    reference = digits("largest torques, β1 = 1.5")

    return HardCase(
        subsystem="statics",
        case="the load that four cables can just hold",
        given="β1 = 1.5 rad, 2 to 60 N",
        way=torque_limits,
        found=lambda way: way(PAPER, CABLES, (1.5, 1.5))[0],
        reference=reference,
        unit="N·m",
        bound=2e-15,
        beyond=answers(
            "more is a shortfall, the limits held",
            lambda: bool(
                tensions(PAPER, CABLES, (1.5, 1.5), (9.0, 0.0)).tensions.max() <= CABLES.most
            ),
        ),
    )


def _curvature() -> HardCase:
    reference = digits("curvature of the cables, β = 1e-3 and π - 1e-3")

    def numbers(way: _Way) -> Any:
        found = way(PAPER, np.array(reference.given))
        return [*found[:2, 0], *found[2:, 1]]

    return HardCase(
        subsystem="statics",
        case="curvature of the cables where one has almost none: pretension always softens",
        given="β = (1e-3, π - 1e-3) rad",
        way=length_curvature,
        found=numbers,
        reference=reference,
        unit="m/rad²",
        bound=2e-17,
        beyond=answers(
            "exactly none at β = 0 for B1D1, none positive",
            lambda: bool(
                length_curvature(PAPER, (0.0, pi))[0, 0] == 0.0
                and length_curvature(PAPER, (0.0, pi)).max() <= 0.0
            ),
        ),
    )


def _slack() -> HardCase:
    beta, pulled = np.array([1.5, 1.9]), np.array([0.0, 12.0, -1.0, 0.0])
    lever, bend = length_jacobian(PAPER, beta), length_curvature(PAPER, beta)
    alone = CABLES.stiffness * lever[1, 0] ** 2 + 12.0 * bend[1, 0]

    return HardCase(
        subsystem="statics",
        case="stiffness with slack cables: one of the first pantograph's, both of the second's",
        given="tensions (0, 12, -1, 0) N",
        way=joint_stiffness,
        found=lambda way: way(PAPER, CABLES, beta, pulled),
        reference=analytic("k l'² + t l'' of what is taut", [alone, 0.0]),
        unit="N·m/rad",
        bound=1e-13,
        beyond=named(
            SingularError,
            lambda: guide_stiffness(PAPER, CABLES, forward(PAPER, (0.0, 1.9)), np.full(4, 5.0)),
        ),
    )


def _mass(words: str, bound: float) -> HardCase:
    reference = digits(f"mass matrix of the holder, {words}")

    return HardCase(
        subsystem="dynamics",
        case=f"mass matrix of the needle holder, {words}",
        given=f"β = ({reference.given[0]:g}, {reference.given[1]:g}) rad, bars of 170 g/m",
        way=guide_dynamics,
        found=lambda way: way(PAPER, GuideMasses(), np.array(reference.given)).mass,
        reference=reference,
        unit="1",
        bound=bound,
        relative=True,
        beyond=named(
            SingularError,
            lambda: guide_dynamics(PAPER, GuideMasses(), inverse(PAPER, PAPER.bases[0])),
        ),
    )


CASES: Final = (
    _edge(PAPER, "1e-3", 2e-14),
    _edge(PAPER, "1e-6", 1e-12),
    _edge(SCISSOR, "1e-3", 2e-14),
    _edge(SCISSOR, "1e-6", 1e-12),
    _beside(PAPER, "1e-3"),
    _beside(PAPER, "1e-9"),
    _beside(SCISSOR, "1e-3"),
    _beside(SCISSOR, "1e-9"),
    _low("1e-3", 2e-13),
    _low("1e-6", 1e-10),
    _flat_jacobian("1e-3"),
    _flat_jacobian("1e-6"),
    _rate(),
    _folded(),
    _both_up(),
    _touching("+"),
    _touching("-"),
    _stretched_rates(),
    _joint(),
    _middle(),
    _offered(),
    _tensions("β1 = 1e-6", 1e-12),
    _tensions("D = 1e-6", 1e-12),
    _limit(),
    _polytope(),
    _curvature(),
    _slack(),
    _mass("β1 = 1e-6", 1e-14),
    _mass("D = 1e-3", 1e-9),
)
"""Kinematics, statics, dynamics."""
