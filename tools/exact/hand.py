"""The hand in many digits: fingers by triangles and by differences, grasps by tetrahedra."""

from math import cos as cosine
from math import sin as sine
from typing import Any

import mpmath  # type: ignore[import-untyped]
from mpmath import atan2, cos, matrix, mpf, sin

from app.arm.hand import load_hand
from tools.exact import exact

FOLDER = "app/arm/hard_cases"

HAND = load_hand().hand
L1, L2, L3, BEND = HAND.links
STRETCHED = 0.16941151879340471, 0.036957937976196086
"""(ρ, z) of a finger without bend, its L3 55 mm, with 1 + 2⁻⁵² for the cosine in doubles [m]."""
BESIDE = 1e-9
"""Distance of a point from the spread axis [m]."""
TURN = 0.4
"""Half the opening of the friction cone less 1e-9 rad: the second normal's turn."""


def lengths() -> tuple[Any, Any, Any, Any]:
    """Lengths and bend as the doubles they are."""
    return mpf(L1), mpf(L2), mpf(L3), mpf(BEND)


def point(phi1: Any, phi2: Any, phi3: Any) -> list[Any]:
    """Grasp point in the finger's frame."""
    l1, l2, l3, bend = lengths()
    tip = phi2 + phi3 + bend
    rho = l1 + l2 * cos(phi2) + l3 * cos(tip)
    return [rho * cos(phi1), rho * sin(phi1), l2 * sin(phi2) + l3 * sin(tip)]


def joints(x: Any, y: Any, z: Any) -> list[Any]:
    """Joints outward, by the angles of the triangle of joint 2, joint 3 and point."""
    l1, l2, l3, bend = lengths()
    away = mpmath.sqrt(x**2 + y**2) - l1
    reach = mpmath.sqrt(away**2 + z**2)
    at_joint_3 = mpmath.acos((l2**2 + l3**2 - reach**2) / (2 * l2 * l3))
    at_joint_2 = mpmath.acos((l2**2 + reach**2 - l3**2) / (2 * l2 * reach))
    return [atan2(y, x), atan2(z, away) - at_joint_2, mpmath.pi - at_joint_3 - bend]


@exact(
    "joints of a finger, its point 1 nm beside the spread axis",
    "angles of a triangle",
    0.6 * BESIDE,
    0.8 * BESIDE,
    0.085,
)
def _(x: Any, y: Any, z: Any) -> Any:
    return joints(x, y, z)


@exact("jacobian of a finger, its point near the spread axis", "differences", 0.3, 1.508, 0.4935)
def _(*q: Any) -> Any:
    h, columns = mpf(10) ** -35, []
    for i in range(3):
        up, down = list(q), list(q)
        up[i], down[i] = q[i] + h, q[i] - h
        pairs = zip(point(*up), point(*down), strict=True)
        columns.append([(one - other) / (2 * h) for one, other in pairs])
    return [columns[j][i] for i in range(3) for j in range(3)]


@exact(
    "joints of a stretched finger without bend",
    "direction of the point, joint 3 straight",
    *STRETCHED,
)
def _(rho: Any, z: Any) -> Any:
    return [atan2(z, rho - mpf(L1)), mpf(0)]


@exact("margin of two opposed contacts, friction 1e-9", "1/√(1 + 2/μ²)", 1e-9)
def _(mu: Any) -> Any:
    return [1 / mpmath.sqrt(1 + 2 / mu**2)]


@exact(
    "margin of two contacts, one 1e-9 rad inside its cone",
    "least distance of the origin from a tetrahedron's faces",
    -cosine(TURN),
    sine(TURN),
    float(mpmath.tan(TURN + 1e-9)),
)
def _(nx: Any, ny: Any, mu: Any) -> Any:
    size = mpmath.sqrt(nx**2 + ny**2)
    rays = []
    for x, n in ((mpf(-1), (mpf(1), mpf(0))), (mpf(1), (nx / size, ny / size))):
        for way in (1, -1):
            fx, fy = n[0] - way * mu * n[1], n[1] + way * mu * n[0]
            rays.append([fx, fy, x * fy])
    least = []
    for i in range(4):
        a, b, c = (rays[j] for j in range(4) if j != i)
        planes = mpmath.lu_solve(matrix([a, b, c]), matrix([1, 1, 1]))
        least.append(1 / mpmath.norm(planes))
    return [min(least)]
