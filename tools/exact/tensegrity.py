"""The tensegrity needle holder in many digits: two cones by their discriminant, rates by slopes."""

from math import pi
from typing import Any

import mpmath  # type: ignore[import-untyped]
from mpmath import acos, atan, cos, matrix, mpf, sin, tan

from app.mechanisms.tensegrity import GuideMasses, JointReading, TensegrityGeometry
from tools.exact import exact
from tools.exact.robot import flat, slope

RHOMBUS = TensegrityGeometry()
SCISSOR = TensegrityGeometry(reading=JointReading.SCISSOR)


def bases(g: TensegrityGeometry) -> tuple[Any, Any, Any]:
    """a1, a2 and a1 × a2 of the doubles they are made of."""
    first, second = mpf(g.first_tilt), mpf(g.second_tilt)
    a1, a2 = matrix([cos(first), 0, sin(first)]), matrix([0, cos(second), sin(second)])
    return a1, a2, cross(a1, a2)


def cross(a: Any, b: Any) -> Any:
    """Cross product."""
    return matrix([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def ratio(g: TensegrityGeometry, i: int) -> Any:
    """f/R of a pantograph."""
    reach, radius = ((g.first_reach, g.first_radius), (g.second_reach, g.second_radius))[i]
    return mpf(reach) / mpf(radius)


def theta(g: TensegrityGeometry, i: int, b: Any) -> Any:
    """Equation 3, or that of two rhombi."""
    if g.reading is JointReading.RHOMBUS:
        return 2 * atan(ratio(g, i) * cos(b / 2))
    return 4 * atan(tan(atan(ratio(g, i)) / 2) * cos(b / 2))


def beta(g: TensegrityGeometry, i: int, t: Any) -> Any:
    """Equations 1 and 2, as printed but for T's length."""
    angle = acos(mpmath.fdot(bases(g)[i], t) / mpmath.norm(t))
    if g.reading is JointReading.RHOMBUS:
        return 2 * acos(tan(angle / 2) / ratio(g, i))
    return 2 * acos(tan(angle / 4) / tan(atan(ratio(g, i)) / 2))


def direction(g: TensegrityGeometry, b1: Any, b2: Any) -> Any:
    """Equation 4 solved: the foot in the plane of both axes, and up along their cross product."""
    a1, a2, normal = bases(g)
    k1, k2, cosine = cos(theta(g, 0, b1)), cos(theta(g, 1, b2)), mpmath.fdot(a1, a2)
    left = 1 - cosine**2 - k1**2 - k2**2 + 2 * cosine * k1 * k2
    foot = (k1 - cosine * k2) * a1 + (k2 - cosine * k1) * a2
    return (foot + mpmath.sqrt(max(left, mpf(0))) * normal) / (1 - cosine**2)


def jacobian(g: TensegrityGeometry, b1: Any, b2: Any) -> Any:
    """dt/dβ, (3, 2)."""
    columns = [slope(lambda *b: direction(g, *b), [b1, b2], i) for i in range(2)]
    return matrix([[columns[j][i] for j in range(2)] for i in range(3)])


def cable(g: TensegrityGeometry, i: int, number: int, b: Any) -> Any:
    """Length of a pantograph's first (BD) or second (CA) cable."""
    radius = mpf(g.radii[i])
    side = atan(ratio(g, i)) / g.rhombi
    if number == 0:
        return 2 * radius * sin(side) * sin(b / 2)
    return 2 * radius * sin(theta(g, i, b) / 4)


def opened(g: TensegrityGeometry, i: int, angle: float) -> float:
    """β at which a pantograph opens to θ [rad], as a double."""
    with mpmath.workdps(60):
        return float(2 * acos(tan(mpf(angle) / 2) / ratio(g, i)))


def towards(g: TensegrityGeometry, angle: float) -> tuple[float, float, float]:
    """Direction at θ1 = angle from a1, over the arc to the zenith, as doubles."""
    with mpmath.workdps(60):
        a1, _, _ = bases(g)
        up = matrix([-a1[2], 0, a1[0]])
        side = matrix([0, 1, 0])
        aside = up * mpf("0.8") + side * mpf("0.6")
        x, y, z = a1 * cos(mpf(angle)) + aside * sin(mpf(angle))
        return float(x), float(y), float(z)


for geometry in (RHOMBUS, SCISSOR):
    reading = geometry.reading.value
    for short, words in ((1e-3, "1e-3"), (1e-6, "1e-6")):
        # The edge towards the zenith: a direction that the second pantograph reaches too.
        edge = towards(geometry, geometry.largest[0] - short)

        @exact(f"joint variables, {reading}, θ1 {words} inside the edge", "equations 1, 2", *edge)
        def _(x: Any, y: Any, z: Any, g: TensegrityGeometry = geometry) -> Any:
            return [beta(g, i, matrix([x, y, z])) for i in range(2)]

    for gap, words in ((1e-3, "1e-3"), (1e-9, "1e-9")):
        beside = towards(geometry, gap)

        @exact(f"joint variables, {reading}, T {words} from A1", "equations 1, 2", *beside)
        def _(x: Any, y: Any, z: Any, g: TensegrityGeometry = geometry) -> Any:
            return [beta(g, i, matrix([x, y, z])) for i in range(2)]


def low(height: float) -> tuple[float, float]:
    """β of a direction between the base axes with t·(a1 × a2) of that size, as doubles."""
    with mpmath.workdps(60):
        a1, a2, normal = bases(RHOMBUS)
        level = a1 * mpf("0.7") + a2 * mpf("0.6")
        level = level / mpmath.norm(level)
        size = mpmath.norm(normal)
        rise = mpf(height) / size
        t = level * mpmath.sqrt(1 - rise**2) + normal / size * rise
        return float(beta(RHOMBUS, 0, t)), float(beta(RHOMBUS, 1, t))


for height, words in ((1e-3, "1e-3"), (1e-6, "1e-6")):
    pose = low(height)

    @exact(f"direction, D = {words}", "two cones and a sphere", *pose)
    def _(b1: Any, b2: Any) -> Any:
        return direction(RHOMBUS, b1, b2)

    @exact(f"jacobian of the guide, D = {words}", "slopes of two cones and a sphere", *pose)
    def _(b1: Any, b2: Any) -> Any:
        return flat(jacobian(RHOMBUS, b1, b2))


@exact("rate of the guide's jacobian, D = 1e-3", "second slopes", *low(1e-3), 1.0, -2.0)
def _(b1: Any, b2: Any, v1: Any, v2: Any) -> Any:
    return flat(slope(lambda s: jacobian(RHOMBUS, b1 + s * v1, b2 + s * v2), [mpf(0)], 0))


@exact(
    "direction, T 1e-6 from A1",
    "two cones and a sphere",
    opened(RHOMBUS, 0, 1e-6),
    opened(RHOMBUS, 1, RHOMBUS.apart - 3e-7),
)
def _(b1: Any, b2: Any) -> Any:
    return direction(RHOMBUS, b1, b2)


@exact("direction where both roots look up", "two cones and a sphere", 2.2, 2.8)
def _(b1: Any, b2: Any) -> Any:
    return direction(RHOMBUS, b1, b2)


def touching(left: float) -> tuple[float, float]:
    """β of a pose between the base axes whose discriminant is as near as doubles come."""
    with mpmath.workdps(60):
        apart = acos(mpmath.fdot(*bases(RHOMBUS)[:2]))
        first = apart * mpf("0.45")
        second = apart - first
        # Δ = 4 sin s sin(s-θ1) sin(s-θ2) sin(s-γ), with s - γ the only small one
        miss = mpf(left) / (4 * sin(apart) * sin(second) * sin(first))
        b1 = float(2 * acos(tan(first / 2) / ratio(RHOMBUS, 0)))
        second += 2 * miss + first - theta(RHOMBUS, 0, mpf(b1))
        return b1, float(2 * acos(tan(second / 2) / ratio(RHOMBUS, 1)))


for sign, left in (("+", 1e-15), ("-", -1e-15)):

    @exact(f"direction, discriminant {sign}1e-15", "two cones that touch", *touching(left))
    def _(b1: Any, b2: Any) -> Any:
        found = direction(RHOMBUS, b1, b2)
        return found / mpmath.norm(found)


@exact("rates of the joints, β1 = 1e-6", "inverse of the slopes on the sphere", 1e-6, 1.9)
def _(b1: Any, b2: Any) -> Any:
    t = direction(RHOMBUS, b1, b2)
    rows = []
    for i, b in enumerate((b1, b2)):
        base = bases(RHOMBUS)[i]
        cosine = mpmath.fdot(base, t)
        by = mpmath.diff(lambda x, i=i: cos(theta(RHOMBUS, i, x)), b)
        rows += list((base - t * cosine) / by)
    return rows


@exact("joint B1, β1 = 1e-6", "at s from A and T, aside of their arc", 1e-6, 1.9)
def _(b1: Any, b2: Any) -> Any:
    t, a1 = direction(RHOMBUS, b1, b2), bases(RHOMBUS)[0]
    side, angle = atan(ratio(RHOMBUS, 0)), theta(RHOMBUS, 0, b1)
    middle, aside = a1 + t, cross(a1, t)
    middle, aside = middle / mpmath.norm(middle), aside / mpmath.norm(aside)
    sine = sin(side) * sin(b1 / 2)
    return (middle * cos(side) / cos(angle / 2) + aside * sine) * mpf(RHOMBUS.first_radius)


def levers(b: Any, i: int) -> tuple[Any, Any]:
    """-dl/dβ of both cables of a pantograph: what a tension is multiplied with."""
    return tuple(-mpmath.diff(lambda x, n=n: cable(RHOMBUS, i, n, x), b) for n in range(2))


def shortest(b: Any, i: int, torque: Any, least: Any) -> list[Any]:
    """Tensions of least norm: at least one cable stands at the least tension."""
    first, second = levers(b, i)
    with_first = [least, (torque - first * least) / second]
    with_second = [(torque - second * least) / first, least]
    fitting = [pair for pair in (with_first, with_second) if min(pair) >= least]
    return min(fitting, key=lambda pair: pair[0] ** 2 + pair[1] ** 2)


for words, pose in (("β1 = 1e-6", (1e-6, 1.9)), ("D = 1e-6", low(1e-6))):

    @exact(f"tensions, {words}", "equilibrium, one cable at its least", *pose, -0.5, 0.4, 2.0)
    def _(b1: Any, b2: Any, torque1: Any, torque2: Any, least: Any) -> Any:
        return shortest(b1, 0, torque1, least) + shortest(b2, 1, torque2, least)


@exact("curvature of the cables, β = 1e-3 and π - 1e-3", "second derivatives", 1e-3, pi - 1e-3)
def _(b1: Any, b2: Any) -> Any:
    return [
        mpmath.diff(lambda x, i=i, n=n: cable(RHOMBUS, i, n, x), b, 2)
        for i, b in enumerate((b1, b2))
        for n in range(2)
    ]


@exact("largest torques, β1 = 1.5", "levers times limits", 1.5, 2.0, 60.0)
def _(b1: Any, least: Any, most: Any) -> Any:
    first, second = levers(b1, 0)
    return [first * most + second * least, first * least + second * most]


def joints(g: TensegrityGeometry, i: int, b1: Any, b2: Any) -> list[Any]:
    """Return A, B, D, T of a pantograph of one rhombus, as unit vectors: B, D aside of the arc."""
    t, base = direction(g, b1, b2), bases(g)[i]
    side, angle = atan(ratio(g, i)), theta(g, i, (b1, b2)[i])
    middle, aside = base + t, cross(base, t)
    middle, aside = middle / mpmath.norm(middle), aside / mpmath.norm(aside)
    along, sine = middle * cos(side) / cos(angle / 2), sin(side) * sin((b1, b2)[i] / 2)
    return [base, along + aside * sine, along - aside * sine, t]


for words, pose in (("β1 = 1e-6", (1e-6, 1.9)), ("D = 1e-3", low(1e-3))):

    @exact(f"mass matrix of the holder, {words}", "integral of (∂r/∂β)² over all bars", *pose)
    def _(b1: Any, b2: Any) -> Any:
        g, masses = RHOMBUS, GuideMasses()
        found = mpmath.matrix(2, 2)
        inertia = mpf(masses.guide_mass) * mpf(masses.guide_centre) ** 2
        inertia += mpf(masses.guide_inertia)
        moved = [slope(lambda *b: direction(g, *b), [b1, b2], j) for j in range(2)]
        for j in range(2):
            for k in range(2):
                found[j, k] = inertia * mpmath.fdot(moved[j], moved[k])
        for i in range(2):
            side, radius = atan(ratio(g, i)), mpf(g.radii[i])
            places = [
                [slope(lambda *b, n=n, i=i: joints(g, i, *b)[n], [b1, b2], j) for j in range(2)]
                for n in range(4)
            ]
            own = mpmath.quad(lambda x: sin(x) ** 2, [0, side]) / sin(side) ** 2
            both = mpmath.quad(lambda x: sin(side - x) * sin(x), [0, side])  # noqa: B023
            both /= sin(side) ** 2
            weight = mpf(masses.density) * radius**3
            for near, far in ((0, 1), (0, 2), (1, 3), (2, 3)):
                u, v = places[near], places[far]
                for j in range(2):
                    for k in range(2):
                        same = mpmath.fdot(u[j], u[k]) + mpmath.fdot(v[j], v[k])
                        mixed = mpmath.fdot(u[j], v[k]) + mpmath.fdot(u[k], v[j])
                        found[j, k] += weight * (own * same + both * mixed)
        return flat(found)
