"""Kinematics of the five-bar on scalars: the one place of every formula.

All functions are compiled, allocate nothing and return tuples whose first entry is a status (see
`mechanisms.status`) where an answer may not exist; a status other than `OK` comes with zeros. The
numpy functions of this package and the stages of the loop call these. Symbols: q1, q2 absolute
motor angles from +x [rad]; a1, a2 link lengths and `base` the distance of the motor axes [m];
(x, y) the tool point P3 in z = 0 [m]. What the needle makes of P3 is in `mechanisms.lever`.

- `forward_kernel(q1, q2, a1, a2, base, assembly) -> (status, x, y)`
- `inverse_kernel(x, y, a1, a2, base, mode_left, mode_right) -> (status, q1, q2)`
- `jacobian_kernel(q1, q2, x, y, a1, a2, base) -> (status, jxl, jxr, jyl, jyr)`

"Errata" entries: docs/errata.md.
"""

from math import atan2, cos, isfinite, sin, sqrt

from app.core.compiled import njit
from app.mechanisms.status import (
    DEGENERATE,
    NOT_FINITE,
    OK,
    SINGULAR,
    UNREACHABLE,
)

_RELATIVE = 1e-12
"""Relative room for rounding: within it a stretched arm is stretched, not out of reach."""


@njit
def forward_kernel(
    q1: float, q2: float, a1: float, a2: float, base: float, assembly: float
) -> tuple[int, float, float]:
    """Tool point from the motor angles: (status, x, y).

    P3 is one of the two points at a2 from both elbows; `assembly` = +1 takes the one with
    cross(P2' - P2, P3 - P2) > 0, the thesis' own. Coincident elbows are `SINGULAR` (P3 may be
    anywhere on a circle), elbows more than 2 a2 apart `UNREACHABLE`.
    """
    if not (isfinite(q1) and isfinite(q2)):
        return NOT_FINITE, 0.0, 0.0
    x2 = a1 * cos(q1) - 0.5 * base
    y2 = a1 * sin(q1)
    ex = a1 * cos(q2) + 0.5 * base - x2
    ey = a1 * sin(q2) - y2
    l2 = ex * ex + ey * ey
    if l2 <= (_RELATIVE * a2) ** 2:
        return SINGULAR, 0.0, 0.0
    height2 = a2 * a2 - 0.25 * l2
    if height2 < -_RELATIVE * a2 * a2:
        return UNREACHABLE, 0.0, 0.0
    ratio = assembly * sqrt(max(height2, 0.0) / l2)
    return OK, x2 + 0.5 * ex - ratio * ey, y2 + 0.5 * ey + ratio * ex


@njit
def _arm(x: float, y: float, a1: float, a2: float, mode: float) -> tuple[int, float]:
    # Angle of the driven link of one arm whose motor stands at the origin. atan2 of the two sides
    # of the law of cosines (product form) keeps full precision at the stretched and folded ends.
    l2 = x * x + y * y
    length = sqrt(l2)
    if length <= _RELATIVE * a2:
        return DEGENERATE, 0.0
    sine2 = ((a1 + length) ** 2 - a2 * a2) * (a2 * a2 - (a1 - length) ** 2)
    if sine2 < -_RELATIVE * a2 * a2 * (a1 + length) ** 2:
        return UNREACHABLE, 0.0
    opening = atan2(sqrt(max(sine2, 0.0)), a1 * a1 + l2 - a2 * a2)
    return OK, atan2(y, x) + mode * opening


@njit
def inverse_kernel(
    x: float, y: float, a1: float, a2: float, base: float, mode_left: float, mode_right: float
) -> tuple[int, float, float]:
    """Motor angles from the tool point: (status, q1, q2).

    The working mode (+1, -1) is elbows outwards, the thesis' own (errata A4, A5: q2 is
    π - α' - β'). Angles are not wrapped to (-π, π]: for y > 0, where the whole workspace lies, q1
    stays continuous in (0, 2π) and q2 in (-π, π).
    """
    if not (isfinite(x) and isfinite(y)):
        return NOT_FINITE, 0.0, 0.0
    left, q1 = _arm(x + 0.5 * base, y, a1, a2, mode_left)
    if left != OK:
        return left, 0.0, 0.0
    right, q2 = _arm(x - 0.5 * base, y, a1, a2, mode_right)
    if right != OK:
        return right, 0.0, 0.0
    return OK, q1, q2


@njit
def jacobian_kernel(
    q1: float, q2: float, x: float, y: float, a1: float, a2: float, base: float
) -> tuple[int, float, float, float, float]:
    """Jacobian dP3/dq [m/rad] at a pose with its tool point: (status, jxl, jxr, jyl, jyr).

    J = a1/s(2'-2) · [[s2' s(2-1), -s2 s(2'-1')], [-c2' s(2-1), c2 s(2'-1')]] with absolute angles
    (errata A3; the printed 4.7 is wrong in three entries). `SINGULAR` where the distal links are
    in line (type 2); in line arms (type 1) only lose rank and are fine here.
    """
    c1, s1, c1r, s1r = cos(q1), sin(q1), cos(q2), sin(q2)
    c2 = (x - (a1 * c1 - 0.5 * base)) / a2
    s2 = (y - a1 * s1) / a2
    c2r = (x - (a1 * c1r + 0.5 * base)) / a2
    s2r = (y - a1 * s1r) / a2
    closing = s2r * c2 - c2r * s2
    if not isfinite(closing):
        return NOT_FINITE, 0.0, 0.0, 0.0, 0.0
    if abs(closing) <= _RELATIVE:
        return SINGULAR, 0.0, 0.0, 0.0, 0.0
    left = a1 * (s2 * c1 - c2 * s1) / closing
    right = a1 * (s2r * c1r - c2r * s1r) / closing
    return OK, s2r * left, -s2 * right, -c2r * left, c2 * right
