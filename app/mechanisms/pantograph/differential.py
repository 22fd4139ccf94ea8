"""Rates, singularities, dexterity and passive joints of the five-bar, on scalars.

Link angles θ1 = q1, θ2 (left arm) and θ1' = q2, θ2' (right arm) are absolute, from +x (errata B4:
the thesis mixes them with relative ones). All take a pose with its tool point and the lengths.

- `jacobian_rate_kernel(q1, q2, v1, v2, x, y, a1, a2, base) -> (status, jxl, jxr, jyl, jyr)`, dJ/dt
- `singularity_kernel(q1, q2, x, y, a1, a2, base) -> (serial_left, serial_right, parallel)`
- `dexterity_kernel(jxl, jxr, jyl, jyr) -> reciprocal condition number`
- `passive_kernel(q1, q2, x, y, a1, a2, base) -> (θ2, θ2', θ2 - θ1, θ2' - θ1')`
- `assembly_kernel(q1, q2, x, y, a1, base) -> +1, -1 or 0`
"""

from math import atan2, cos, hypot, isfinite, pi, sin

from app.core.compiled import njit
from app.mechanisms.pantograph.links import (
    distal_kernel,
    passive_rates_kernel,
    speeds_kernel,
    turns_kernel,
)
from app.mechanisms.status import NOT_FINITE, OK, SINGULAR

_RELATIVE = 1e-12


@njit
def singularity_kernel(
    q1: float, q2: float, x: float, y: float, a1: float, a2: float, base: float
) -> tuple[float, float, float]:
    """Return how far the pose is from singular: (sin(θ2-θ1), sin(θ2'-θ1'), sin(θ2'-θ2)).

    The first two vanish where an arm is stretched or folded (type 1: the tool loses a direction),
    the third where the distal links are in line (type 2: the tool moves with the motors held).
    """
    turns = turns_kernel(q1, q2)
    c1, s1, c1r, s1r = turns
    u = distal_kernel(turns, x, y, a1, a2, base)
    c2, s2, c2r, s2r = u
    return (
        s2 * c1 - c2 * s1,
        s2r * c1r - c2r * s1r,
        s2r * c2 - c2r * s2,
    )


@njit
def jacobian_rate_kernel(
    q1: float,
    q2: float,
    v1: float,
    v2: float,
    x: float,
    y: float,
    a1: float,
    a2: float,
    base: float,
) -> tuple[int, float, float, float, float]:
    """Time derivative of the Jacobian at joint rates (v1, v2) [m/(rad·s)].

    The columns of J are a1 sin(θ2-θ1)/sin(θ2'-θ2) (s2', -c2') and a1 sin(θ2'-θ1')/sin(θ2'-θ2)
    (-s2, c2); the product rule with θ̇2 and θ̇2' from q̇. `SINGULAR` as `jacobian_kernel`.
    """
    turns = turns_kernel(q1, q2)
    c1, s1, c1r, s1r = turns
    u = distal_kernel(turns, x, y, a1, a2, base)
    c2, s2, c2r, s2r = u
    closing = s2r * c2 - c2r * s2
    if not isfinite(closing + v1 + v2):
        return NOT_FINITE, 0.0, 0.0, 0.0, 0.0
    if abs(closing) <= _RELATIVE:
        return SINGULAR, 0.0, 0.0, 0.0, 0.0
    _, _, w, wr = speeds_kernel(passive_rates_kernel(turns, u, a1, a2), v1, v2)
    closing_rate = (c2r * c2 + s2r * s2) * (wr - w)
    left = a1 * (s2 * c1 - c2 * s1) / closing
    right = a1 * (s2r * c1r - c2r * s1r) / closing
    left_rate = (a1 * (c2 * c1 + s2 * s1) * (w - v1) - left * closing_rate) / closing
    right_rate = (a1 * (c2r * c1r + s2r * s1r) * (wr - v2) - right * closing_rate) / closing
    return (
        OK,
        left_rate * s2r + left * wr * c2r,
        -right_rate * s2 - right * w * c2,
        -left_rate * c2r + left * wr * s2r,
        right_rate * c2 - right * w * s2,
    )


@njit
def dexterity_kernel(jxl: float, jxr: float, jyl: float, jyr: float) -> float:
    """Smallest over largest singular value of J: 1 for an isotropic pose, 0 for a singular one."""
    largest = 0.5 * (hypot(jxl + jyr, jyl - jxr) + hypot(jxl - jyr, jyl + jxr))
    return abs(jxl * jyr - jxr * jyl) / (largest * largest) if largest > 0.0 else 0.0


@njit
def passive_kernel(
    q1: float, q2: float, x: float, y: float, a1: float, a2: float, base: float
) -> tuple[float, float, float, float]:
    """Angles of the distal links [rad]: absolute left and right, relative left and right.

    Absolute from +x; relative to the driven link, what an encoder on the elbow would read. Both in
    (-π, π].
    """
    c2, s2, c2r, s2r = distal_kernel(turns_kernel(q1, q2), x, y, a1, a2, base)
    left, right = atan2(s2, c2), atan2(s2r, c2r)
    return left, right, _wrapped(left - q1), _wrapped(right - q2)


@njit
def _wrapped(angle: float) -> float:
    turned = atan2(sin(angle), cos(angle))
    return turned if turned > -pi else pi


@njit
def assembly_kernel(q1: float, q2: float, x: float, y: float, a1: float, base: float) -> float:
    """Assembly of a pose: sign of cross(P2' - P2, P3 - P2); 0 where both assemblies meet."""
    x2, y2 = a1 * cos(q1) - 0.5 * base, a1 * sin(q1)
    ex, ey = a1 * cos(q2) + 0.5 * base - x2, a1 * sin(q2) - y2
    turn = ex * (y - y2) - ey * (x - x2)
    return 1.0 if turn > 0.0 else (-1.0 if turn < 0.0 else 0.0)
