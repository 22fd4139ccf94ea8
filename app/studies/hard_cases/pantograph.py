"""Hard cases of the pantograph: kinematics, statics, dynamics where arms and elbows are in line."""

from collections.abc import Callable
from math import acos, cos, pi, sqrt
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.errors import NumericalError
from app.mechanisms.errors import DegenerateError, NotFiniteError, SingularError, UnreachableError
from app.mechanisms.pantograph import (
    Geometry,
    Singularity,
    dexterity,
    dynamic_terms,
    felt_force,
    force_map,
    forward,
    inverse,
    jacobian,
    jacobian_rate,
    needle_at,
    printed_force,
    singularity,
    system_inverse,
    system_rates,
    tool_force,
)
from app.mechanisms.pantograph.dynamics import friction_kernel
from app.mechanisms.pantograph.profile import load_pantograph
from app.studies.hard_cases.case import HardCase, ReferenceValue, analytic, answers, digits, named

PROFILE: Final = load_pantograph("icube")
GEOMETRY, MODEL = PROFILE.pantograph, PROFILE.dynamic_model
A1, A2, BASE = GEOMETRY.links
MEETING: Final = acos(BASE / (2.0 * A1)), pi - acos(BASE / (2.0 * A1))
X, Y, HEIGHT = GEOMETRY.fulcrum_xyz
ASIDE: Final = sqrt(1.0 - 0.36**2)

_Way = Callable[..., Any]


def _kinematics() -> tuple[HardCase, ...]:
    found = []
    for words, gap in (("1e-3", 1e-3), ("1e-6", 1e-6), ("1e-8", 1e-8)):
        point = digits(f"tool point, elbows {words} rad from meeting")
        rates = digits(f"jacobian, elbows {words} rad from meeting")
        found += [
            HardCase(
                subsystem="kinematics",
                case=f"tool point where the elbows are {words} rad from meeting",
                given=f"q = meeting + ({gap:g}, {-0.5 * gap:g}) rad",
                way=forward,
                found=lambda way, q=point.given: way(GEOMETRY, np.array(q)),
                reference=point,
                unit="m",
                bound=2e-16 * A2 / gap + 1e-16,  # one bit of an angle, times a2 / distance
                beyond=named(SingularError, lambda: forward(GEOMETRY, MEETING)),
            ),
            HardCase(
                subsystem="kinematics",
                case=f"Jacobian where the elbows are {words} rad from meeting",
                given=f"q = meeting + ({gap:g}, {-0.5 * gap:g}) rad",
                way=jacobian,
                found=lambda way, q=rates.given: way(GEOMETRY, np.array(q)),
                reference=rates,
                unit="1",
                bound=1e-15 / gap,
                relative=True,
                beyond=named(SingularError, lambda: jacobian_rate(GEOMETRY, MEETING, (1.0, 0.0))),
            ),
        ]
    return tuple(found)


def _reaching(words: str, short: str, bound: float) -> HardCase:
    reference = digits(f"joint angles, left arm {words} to {short}")
    reach = (A1 + A2) if words == "stretched" else (A2 - A1)
    past = reach * (1.0 + (1e-9 if words == "stretched" else -1e-9))
    return HardCase(
        subsystem="kinematics",
        case=f"joint angles of an arm {words} to {short} of its length",
        given="P3 on a ray from the left motor",
        way=inverse,
        found=lambda way: way(GEOMETRY, np.array(reference.given)),
        reference=reference,
        unit="rad",
        bound=bound,
        beyond=named(
            UnreachableError, lambda: inverse(GEOMETRY, (-BASE / 2 + past * 0.36, past * ASIDE))
        ),
    )


def _rate() -> HardCase:
    reference = digits("rate of the jacobian, elbows 1e-3 rad from meeting")
    q, qd = np.array(reference.given[:2]), np.array(reference.given[2:])
    return HardCase(
        subsystem="kinematics",
        case="rate of the Jacobian where the elbows are 1e-3 rad from meeting",
        given="q̇ = (1, -2) rad/s",
        way=jacobian_rate,
        found=lambda way: way(GEOMETRY, q, qd),
        reference=reference,
        unit="1",
        bound=1e-11,
        relative=True,
        beyond=named(NotFiniteError, lambda: jacobian_rate(GEOMETRY, q, (np.nan, 0.0))),
    )


def _upright() -> HardCase:
    reference = digits("needle 1 pm beside the vertical")

    def numbers(way: _Way) -> Any:
        needle = way(GEOMETRY, np.array(reference.given), 0.11)
        return [*needle.axis, needle.l_in]

    def sideways() -> bool:
        return bool(needle_at(GEOMETRY, (X, Y), 0.11).axis.tolist() == [0.0, 0.0, -1.0])

    return HardCase(
        subsystem="kinematics",
        case="direction of a needle 1 pm beside the vertical",
        given="P3 = P_I + (1e-12, 0) m",
        way=needle_at,
        found=numbers,
        reference=reference,
        unit="1",
        bound=2e-16,
        beyond=answers("exactly (0, 0, -1) at the vertical: no azimuth is asked for", sideways),
    )


def _in_line() -> HardCase:
    """Only links other than the robot's own can stretch both distal links."""
    wide = Geometry(0.1225, 0.165, 0.085, GEOMETRY.fulcrum, 0.2)
    gap = 1e-6
    q = np.array([pi - gap, gap])

    def measure(way: _Way) -> Any:
        return way(wide, q, 1, 1e-9).parallel

    # Elbows at ±(0.04250 + 0.1225 cos gap) and the same height: sine of the opening = 2 s c.
    half = (0.5 * wide.base + wide.proximal * cos(gap)) / wide.distal
    sine = 2.0 * half * sqrt(1.0 - half * half)
    return HardCase(
        subsystem="kinematics",
        case="distal links 1e-6 rad from being in line (θ2 = θ4)",
        given="wide links, q = (π - 1e-6, 1e-6) rad",
        way=singularity,
        found=measure,
        reference=analytic("2 s √(1 - s²), s = half the elbows' distance over a2", sine),
        unit="1",
        bound=1e-9,  # √ε / sine: the arms are stretched
        beyond=named(SingularError, lambda: jacobian(wide, (pi, 0.0))),
    )


def _at_the_axis() -> HardCase:
    stretched = np.array([-BASE / 2, 0.0]) + (A1 + A2) * (1.0 - 1e-15) * np.array([0.36, ASIDE])

    def kinds(way: _Way) -> Any:
        return [way(GEOMETRY, inverse(GEOMETRY, stretched)).kind is Singularity.SERIAL_LEFT]

    return HardCase(
        subsystem="kinematics",
        case="an arm stretched to its very end is named, and its angles are finite",
        given="P3 at a1 + a2 from the left motor, to 1e-8",
        way=singularity,
        found=kinds,
        reference=analytic("named SERIAL_LEFT", 1.0),
        unit="1",
        bound=0.0,
        beyond=named(DegenerateError, lambda: inverse(GEOMETRY, (-BASE / 2, 0.0))),
    )


def _lean(law: str) -> list[HardCase]:
    own = force_map if law == "tool force" else printed_force
    found = []
    for tilt in ("45", "89", "89.99"):
        reference = digits(f"{law} at {tilt} degrees of tilt")
        found.append(_leaning(own, law, tilt, reference))
    return found


def _leaning(own: _Way, law: str, tilt: str, reference: ReferenceValue) -> HardCase:
    x, y, l_out, *force = reference.given
    needle = needle_at(GEOMETRY, (x, y), l_out)
    flat = needle_at(GEOMETRY, (X, Y), l_out)
    object.__setattr__(flat, "axis", np.array([1.0, 0.0, 0.0]))

    return HardCase(
        subsystem="statics",
        case=f"{law} with the needle tilted by {tilt}°",
        given="F = (1, -2, 0.5) N, L_out = 110 mm",
        way=own,
        found=lambda way: way(needle, np.array(force)),
        reference=reference,
        unit="1",
        bound=1e-15 if law == "tool force" else 1e-14,
        relative=True,
        beyond=named(DegenerateError, lambda: own(flat, (1.0, 0.0, 0.0))),
    )


def _felt() -> HardCase:
    tilt = np.radians(80.0)
    needle = needle_at(GEOMETRY, (X + HEIGHT * np.tan(tilt), Y), 0.08)
    force = np.array([1.0, -2.0, 0.5])
    across = force - needle.axis * (needle.axis @ force)
    return HardCase(
        subsystem="statics",
        case="what the hand feels of the force asked for, at 80° of tilt",
        given="F = (1, -2, 0.5) N",
        way=felt_force,
        found=lambda way: way(needle, force_map(needle, force)),
        reference=analytic("the part of F across the needle, F - d (d·F)", across),
        unit="N",
        bound=5e-14,
        beyond=named(UnreachableError, lambda: system_inverse(GEOMETRY, (X + 0.1, Y, HEIGHT))),
    )


def _solved() -> HardCase:
    reference = digits("tool force of an almost singular jacobian")
    matrix = np.array(reference.given[:4]).reshape(2, 2)
    torques = np.array(reference.given[4:])
    return HardCase(
        subsystem="statics",
        case="tool force where the Jacobian has lost rank to 1e-9",
        given="rows (1, 2) and (2, 4 + 4e-9) mm/rad, τ = (0.1, -0.2) N·m",
        way=tool_force,
        found=lambda way: way(matrix, torques),
        reference=reference,
        unit="1",
        bound=1e-6,  # ε / 1e-9, its condition
        relative=True,
        beyond=named(SingularError, lambda: tool_force([[1.0, 2.0], [2.0, 4.0]], (0.1, 0.1))),
    )


def _hub_rates() -> HardCase:
    reference = digits("rates of the hub, needle 1e-9 rad from vertical")
    q, l_out = np.array(reference.given[:2]), reference.given[2]

    return HardCase(
        subsystem="statics",
        case="rates of the hub with the needle 1e-9 rad from vertical",
        given="q at the fulcrum, left joint 1e-9 rad on; L_out = 110 mm",
        way=system_rates,
        found=lambda way: way(GEOMETRY, q, l_out).by_joints,
        reference=reference,
        unit="m/rad",
        bound=1e-15,
        beyond=named(SingularError, lambda: system_rates(GEOMETRY, MEETING, 0.1)),
    )


def _dexterity() -> HardCase:
    reference = digits("inverse dexterity, left arm stretched to 1e-6")
    matrix = np.array(reference.given).reshape(2, 2)

    return HardCase(
        subsystem="statics",
        case="condition of a Jacobian whose columns are almost parallel",
        given="rows (0.6, -0.4), (0.3, -0.2001)",
        way=dexterity,
        found=lambda way: way(matrix),
        reference=reference,
        unit="1",
        bound=1e-16,
        beyond=answers("exactly 0 without any rank", lambda: dexterity(np.zeros((2, 2))) == 0.0),
    )


LEANING: Final = 0.6
"""Tilt at which forces are compared with those of another program [rad]."""


def virtual_work() -> FloatArray:
    """Return what the hand feels of τ = (0.1, -0.05) N·m at `LEANING` [N], shape (3,)."""
    needle = needle_at(GEOMETRY, (X + HEIGHT * np.tan(LEANING), Y), 0.11)
    q = inverse(GEOMETRY, needle.p3)
    return felt_force(needle, tool_force(jacobian(GEOMETRY, q), (0.1, -0.05)))


def _mujoco() -> HardCase:
    # The same robot in another program: its closed loop held by constraints.
    def in_mujoco(*_: Any) -> Any:
        from app.studies.references.mujoco_pantograph import felt_in_mujoco

        return felt_in_mujoco(PROFILE, LEANING, 0.0, (0.1, -0.05), 0.11)

    return HardCase(
        subsystem="statics",
        case="force felt at 34° of tilt, in MuJoCo's constraints",
        given="τ = (0.1, -0.05) N·m, L_out = 110 mm",
        way=in_mujoco,
        found=lambda way: way(),
        reference=analytic("virtual work: -(L_in/L_out) of J⁻ᵀ τ", virtual_work()),
        unit="1",
        bound=1e-2,
        relative=True,
        beyond=answers("bounded: 1e-4 of an acceleration passes its constraints", lambda: True),
        needs=("mujoco",),
    )


def _dynamics() -> tuple[HardCase, ...]:
    found = []
    for words, gap, bound in (("1e-2", 1e-2, 1e-12), ("1e-5", 1e-5, 1e-9)):
        reference = digits(f"mass matrix, elbows {words} rad from meeting")
        found.append(_mass(words, gap, bound, reference))
    return tuple(found)


def _mass(words: str, gap: float, bound: float, reference: ReferenceValue) -> HardCase:
    q, depth = np.array(reference.given[:2]), reference.given[2]

    return HardCase(
        subsystem="dynamics",
        case=f"mass matrix where the elbows are {words} rad from meeting",
        given=f"q = meeting + ({gap:g}, {-0.5 * gap:g}) rad, 20 mm deep",
        way=dynamic_terms,
        found=lambda way: way(MODEL, q, (0.0, 0.0), depth).mass,
        reference=reference,
        unit="1",
        bound=bound,
        relative=True,
        beyond=named(SingularError, lambda: dynamic_terms(MODEL, MEETING, (0.0, 0.0), 0.0)),
    )


def _velocity_terms() -> HardCase:
    reference = digits("velocity terms, elbows 1e-2 rad from meeting")
    q, depth = np.array(reference.given[:2]), reference.given[2]
    qd, rate = np.array(reference.given[3:5]), reference.given[5]
    return HardCase(
        subsystem="dynamics",
        case="velocity terms where the elbows are 1e-2 rad from meeting",
        given="q̇ = (1.3, -0.7) rad/s, the needle at 0.2 m/s",
        way=dynamic_terms,
        found=lambda way: way(MODEL, q, qd, depth, rate).velocity,
        reference=reference,
        unit="1",
        bound=1e-11,
        relative=True,
        beyond=named(NumericalError, lambda: dynamic_terms(MODEL, q, (np.inf, 0.0), depth)),
    )


def _gravity() -> HardCase:
    reference = digits("gravity of a needle 1e-6 rad from vertical")
    q, depth = np.array(reference.given[:2]), reference.given[2]
    return HardCase(
        subsystem="dynamics",
        case="gravity with the needle 1e-6 rad from vertical",
        given="q at the fulcrum, both joints 1e-6 rad off; 20 mm deep",
        way=dynamic_terms,
        found=lambda way: way(MODEL, q, (0.0, 0.0), depth).gravity,
        reference=reference,
        unit="N·m",
        bound=1e-16,
        beyond=named(NumericalError, lambda: dynamic_terms(MODEL, (np.nan, 0.0), (0, 0), depth)),
    )


def _friction() -> HardCase:
    reference = digits("friction of a joint at 1e-9 rad/s")

    return HardCase(
        subsystem="dynamics",
        case="friction of a joint that turns at 1e-9 rad/s",
        given="0.02 N·m Coulomb, smoothed over 0.01 rad/s",
        way=friction_kernel,
        found=lambda way: way(*reference.given),
        reference=reference,
        unit="N·m",
        bound=1e-24,
        beyond=answers(
            "bounded by Coulomb and viscous part at 1e9 rad/s",
            lambda: abs(friction_kernel(1e9, 0.02, 0.0, 0.01)) <= 0.02,
        ),
    )


CASES: Final = (
    *_kinematics(),
    _reaching("stretched", "1e-06", 2e-13),
    _reaching("stretched", "1e-12", 2e-10),
    _reaching("folded", "1e-06", 2e-13),
    _reaching("folded", "1e-12", 2e-10),
    _rate(),
    _upright(),
    _in_line(),
    _at_the_axis(),
    *_lean("tool force"),
    *_lean("printed law 4.12"),
    _felt(),
    _solved(),
    _hub_rates(),
    _dexterity(),
    _mujoco(),
    *_dynamics(),
    _velocity_terms(),
    _gravity(),
    _friction(),
)
"""Kinematics, statics, dynamics."""
