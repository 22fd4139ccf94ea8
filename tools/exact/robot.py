"""The pantograph in many digits: kinematics by circles, rates by differences, bodies by points."""

from collections.abc import Callable
from math import acos, pi, radians, sqrt, tan
from typing import Any

import mpmath  # type: ignore[import-untyped]
from mpmath import atan2, cos, matrix, mpf, sin

from app.mechanisms.pantograph.profile import load_pantograph
from tools.exact import exact

PROFILE = load_pantograph("icube")
GEOMETRY, MODEL = PROFILE.pantograph, PROFILE.dynamic_model
A1, A2, BASE = GEOMETRY.links
HEIGHT = GEOMETRY.fulcrum_xyz[2]
MEETING = acos(BASE / (2.0 * A1))
"""Angle of the left motor at which, mirrored on the right, the elbows meet."""


def lengths() -> tuple[Any, Any, Any]:
    """Link lengths as the doubles they are."""
    return mpf(A1), mpf(A2), mpf(BASE)


def fulcrum() -> Any:
    """Return the fulcrum as the doubles it is."""
    return matrix([mpf(v) for v in GEOMETRY.fulcrum_xyz])


def elbows(q1: Any, q2: Any) -> tuple[Any, Any]:
    """Elbows in the plane of the links."""
    a1, _, base = lengths()
    left = matrix([a1 * cos(q1) - base / 2, a1 * sin(q1)])
    return left, matrix([a1 * cos(q2) + base / 2, a1 * sin(q2)])


def tool(q1: Any, q2: Any) -> Any:
    """Tool point: the circles about both elbows meet."""
    left, right = elbows(q1, q2)
    e = right - left
    l2 = e[0] ** 2 + e[1] ** 2
    r = mpmath.sqrt((mpf(A2) ** 2 - l2 / 4) / l2)
    return matrix([left[0] + e[0] / 2 - r * e[1], left[1] + e[1] / 2 + r * e[0]])


def slope(call: Callable[..., Any], at: list[Any], i: int) -> Any:
    """Central difference: 1e-70 of the value in so many digits."""
    h = mpf(10) ** -35
    up, down = list(at), list(at)
    up[i], down[i] = at[i] + h, at[i] - h
    return (call(*up) - call(*down)) / (2 * h)


def jacobian(q1: Any, q2: Any) -> Any:
    """dP3/dq, (2, 2)."""
    columns = [slope(tool, [q1, q2], i) for i in range(2)]
    return matrix([[columns[j][i] for j in range(2)] for i in range(2)])


def angles(x: Any, y: Any) -> list[Any]:
    """Angles of the motors, elbows outwards, by the law of cosines."""
    a1, a2, base = lengths()
    found = []
    for side, mode in ((-1, 1), (1, -1)):
        px = x - side * base / 2
        reach = mpmath.sqrt(px**2 + y**2)
        opening = mpmath.acos((a1**2 + reach**2 - a2**2) / (2 * a1 * reach))
        found.append(atan2(y, px) + mode * opening)
    return found


def direction(x: Any, y: Any) -> tuple[Any, Any]:
    """Needle's direction and lever L_in of a tool point."""
    e = matrix([x, y, 0]) - fulcrum()
    l_in = mpmath.norm(e)
    return e / l_in, l_in


def hub(q1: Any, q2: Any, l_out: Any) -> Any:
    """Hub point at a measured L_out."""
    p3 = tool(q1, q2)
    d, _ = direction(p3[0], p3[1])
    return fulcrum() - l_out * d


def flat(m: Any) -> list[Any]:
    """Entries row by row."""
    return [m[i, j] for i in range(m.rows) for j in range(m.cols)]


for gap, words in ((1e-3, "1e-3"), (1e-6, "1e-6"), (1e-8, "1e-8")):
    apart = MEETING + gap, pi - MEETING - 0.5 * gap

    @exact(f"tool point, elbows {words} rad from meeting", "two circles meet", *apart)
    def _(q1: Any, q2: Any) -> Any:
        return tool(q1, q2)

    @exact(f"jacobian, elbows {words} rad from meeting", "differences of two circles", *apart)
    def _(q1: Any, q2: Any) -> Any:
        return flat(jacobian(q1, q2))


for reach, words in ((A1 + A2, "stretched"), (A2 - A1, "folded")):
    for short in (1e-6, 1e-12):
        inwards = -1.0 if reach > 0.2 else 1.0
        at = reach * (1.0 + inwards * short)
        p3 = -BASE / 2 + at * 0.36, at * sqrt(1.0 - 0.36**2)

        @exact(f"joint angles, left arm {words} to {short:g}", "law of cosines", *p3)
        def _(x: Any, y: Any) -> Any:
            return angles(x, y)


@exact(
    "rate of the jacobian, elbows 1e-3 rad from meeting",
    "second differences of two circles",
    MEETING + 1e-3,
    pi - MEETING - 5e-4,
    1.0,
    -2.0,
)
def _(q1: Any, q2: Any, v1: Any, v2: Any) -> Any:
    return flat(slope(lambda t: jacobian(q1 + t * v1, q2 + t * v2), [mpf(0)], 0))


@exact(
    "needle 1 pm beside the vertical",
    "unit vector from fulcrum to tool",
    GEOMETRY.fulcrum_xyz[0] + 1e-12,
    GEOMETRY.fulcrum_xyz[1],
)
def _(x: Any, y: Any) -> Any:
    d, l_in = direction(x, y)
    return [d[0], d[1], d[2], l_in]


@exact("inverse dexterity, left arm stretched to 1e-6", "singular values", 0.6, -0.4, 0.3, -0.2001)
def _(a: Any, b: Any, c: Any, d: Any) -> Any:
    values = mpmath.svd_r(matrix([[a, b], [c, d]]), compute_uv=False)
    return [values[1] / values[0]]


for tilt in (45.0, 89.0, 89.99):
    across = HEIGHT * tan(radians(tilt))
    lean = 0.6 * across, GEOMETRY.fulcrum_xyz[1] + 0.8 * across, 0.11, 1.0, -2.0, 0.5

    @exact(f"tool force at {tilt:g} degrees of tilt", "-(L_out/L_in)(I - d dᵀ) F", *lean)
    def _(x: Any, y: Any, l_out: Any, *force: Any) -> Any:
        d, l_in = direction(x, y)
        f = matrix(force)
        across = f - d * mpmath.fdot(d, f)
        return [-l_out / l_in * across[0], -l_out / l_in * across[1]]

    @exact(f"printed law 4.12 at {tilt:g} degrees of tilt", "-(L_out/L_in)(F - d F_z/d_z)", *lean)
    def _(x: Any, y: Any, l_out: Any, *force: Any) -> Any:
        d, l_in = direction(x, y)
        f = matrix(force)
        slide = f - d * (f[2] / d[2])
        return [-l_out / l_in * slide[0], -l_out / l_in * slide[1]]


@exact(
    "tool force of an almost singular jacobian",
    "solution of Jᵀ γ = τ",
    1e-3,
    2e-3,
    2e-3,
    4e-3 * (1.0 + 1e-9),
    0.1,
    -0.2,
)
def _(a: Any, b: Any, c: Any, d: Any, left: Any, right: Any) -> Any:
    return mpmath.lu_solve(matrix([[a, c], [b, d]]), matrix([left, right]))


@exact(
    "rates of the hub, needle 1e-9 rad from vertical",
    "differences of the hub point",
    *(float(v) for v in (lambda q: (q[0] + 1e-9, q[1]))(tuple(angles(*GEOMETRY.fulcrum[:2])))),
    0.11,
)
def _(q1: Any, q2: Any, l_out: Any) -> Any:
    columns = [slope(hub, [q1, q2, l_out], i) for i in range(2)]
    return [columns[j][i] for i in range(3) for j in range(2)]


def bodies(q1: Any, q2: Any, depth: Any) -> list[tuple[Any, Any, bool]]:
    """All bodies as weights with what they weigh: points with masses, angles with inertias."""
    part, a1, a2 = PROFILE.inertia, mpf(A1), mpf(A2)
    p3 = tool(q1, q2)
    p3 = matrix([p3[0], p3[1], 0])
    d, _ = direction(p3[0], p3[1])
    centre = fulcrum() + d * (depth - mpf(GEOMETRY.needle_length) + mpf(part.needle_centre))
    found = [(part.tool_mass, p3, True), (part.needle_mass, centre, True)]
    found.append((part.needle_inertia, d, False))
    for side, q, elbow in zip((-1, 1), (q1, q2), elbows(q1, q2), strict=True):
        motor = matrix([side * mpf(BASE) / 2, 0, 0])
        joint = matrix([elbow[0], elbow[1], 0])
        along = (p3 - joint) / a2
        turn = matrix([atan2(along[1], along[0]), 0, 0])
        turning = mpf(part.proximal_inertia) + mpf(part.reflected_rotor)
        found += [
            (part.proximal_mass, motor + (joint - motor) / a1 * mpf(part.proximal_centre), True),
            (turning, matrix([q, 0, 0]), False),
            (part.distal_mass, joint + along * mpf(part.distal_centre), True),
            (part.distal_inertia, turn, False),
        ]
    return [(mpf(weight), value, heavy) for weight, value, heavy in found]


def partials(u: list[Any]) -> list[list[Any]]:
    """Return what each body's value gains per q1, q2 and depth."""
    h = mpf(10) ** -35
    found = []
    for i in range(3):
        up, down = list(u), list(u)
        up[i], down[i] = u[i] + h, u[i] - h
        pairs = zip(bodies(*up), bodies(*down), strict=True)
        found.append([(one[1] - other[1]) / (2 * h) for one, other in pairs])
    return found


for gap, words in ((1e-2, "1e-2"), (1e-5, "1e-5")):
    near = MEETING + gap, pi - MEETING - 0.5 * gap, 0.02

    @exact(f"mass matrix, elbows {words} rad from meeting", "sum of m (∂x/∂q)²", *near)
    def _(*u: Any) -> Any:
        each, turned = bodies(*u), partials(list(u))
        return [
            mpmath.fsum(
                weight * mpmath.fdot(turned[i][b], turned[j][b])
                for b, (weight, _, _) in enumerate(each)
            )
            for i in range(2)
            for j in range(2)
        ]


@exact(
    "velocity terms, elbows 1e-2 rad from meeting",
    "sum of m ∂x/∂q · ẍ at constant rates",
    MEETING + 1e-2,
    pi - MEETING - 5e-3,
    0.02,
    1.3,
    -0.7,
    0.2,
)
def _(q1: Any, q2: Any, depth: Any, v1: Any, v2: Any, rate: Any) -> Any:
    h = mpf(10) ** -30
    u, rates = [q1, q2, depth], [v1, v2, rate]
    here, turned = bodies(*u), partials(u)
    on, back = (bodies(*[x + s * h * v for x, v in zip(u, rates, strict=True)]) for s in (1, -1))
    second = [(on[b][1] - 2 * here[b][1] + back[b][1]) / h**2 for b in range(len(here))]
    return [
        mpmath.fsum(here[b][0] * mpmath.fdot(turned[i][b], second[b]) for b in range(len(here)))
        for i in range(2)
    ]


@exact(
    "gravity of a needle 1e-6 rad from vertical",
    "-sum of m g · ∂x/∂q",
    *(float(v) for v in (lambda q: (q[0] + 1e-6, q[1] - 1e-6))(angles(*GEOMETRY.fulcrum[:2]))),
    0.02,
)
def _(*u: Any) -> Any:
    each, turned = bodies(*u), partials(list(u))
    g = matrix([mpf(v) for v in MODEL.gravity.tolist()])
    return [
        -mpmath.fsum(
            weight * mpmath.fdot(turned[i][b], g)
            for b, (weight, _, heavy) in enumerate(each)
            if heavy
        )
        for i in range(2)
    ]


@exact("friction of a joint at 1e-9 rad/s", "c tanh(v/s) + b v", 1e-9, 0.02, 0.003, 0.01)
def _(v: Any, coulomb: Any, viscous: Any, smooth: Any) -> Any:
    return [coulomb * mpmath.tanh(v / smooth) + viscous * v]
