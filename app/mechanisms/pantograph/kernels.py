"""Kinematics and statics of the pantograph on scalars: the one place of every formula.

All functions are compiled, allocate nothing and return tuples whose first entry is a status (see
`status.py`) where an answer may not exist; a status other than `OK` comes with zeros. The numpy
functions of this package and the stages of the loop call these. Symbols: q1, q2 absolute motor
angles from +x [rad]; a1, a2 link lengths and `base` the distance of the motor axes [m]; (x, y) the
tool point P3 in z = 0 [m]; d the needle's direction from hub to tip; F a force at the hub point
P_u [N]; γ a force at P3 [N].

- `forward_kernel(q1, q2, a1, a2, base, assembly) -> (status, x, y)`
- `inverse_kernel(x, y, a1, a2, base, mode_left, mode_right) -> (status, q1, q2)`
- `jacobian_kernel(q1, q2, x, y, a1, a2, base) -> (status, jxl, jxr, jyl, jyr)`
- `axis_kernel(x, y, fx, fy, fz) -> (dx, dy, dz, l_in)`
- `tool_kernel(ux, uy, uz, fx, fy, fz) -> (status, x, y, l_in, l_out)`
- `hub_velocity_kernel(vx, vy, dx, dy, dz, l_in, l_out) -> (wx, wy, wz)`
- `force_map_kernel`, `printed_force_kernel (fx, fy, fz, dx, dy, dz, l_in, l_out) -> (gx, gy)`
- `felt_kernel(gx, gy, dx, dy, dz, l_in, l_out) -> (fx, fy, fz)`
- `torque_kernel(gx, gy, jxl, jxr, jyl, jyr) -> (left, right)` and its inverse `tool_force_kernel`

"Errata" entries: docs/errata.md.
"""

from math import atan2, cos, isfinite, sin, sqrt

from app.core.compiled import njit
from app.mechanisms.pantograph.status import (
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


@njit
def axis_kernel(
    x: float, y: float, fx: float, fy: float, fz: float
) -> tuple[float, float, float, float]:
    """Needle direction d = (P3 - P_I)/L_in and the lever L_in [m]: (dx, dy, dz, l_in).

    Regular for every P3 as long as the fulcrum is above the plane; needs neither azimuth nor
    elevation (errata A7 and the vertical needle).
    """
    ex, ey = x - fx, y - fy
    l_in = sqrt(ex * ex + ey * ey + fz * fz)
    return ex / l_in, ey / l_in, -fz / l_in, l_in


@njit
def tool_kernel(
    ux: float, uy: float, uz: float, fx: float, fy: float, fz: float
) -> tuple[int, float, float, float, float]:
    """Tool point of a hub point (ux, uy, uz): (status, x, y, l_in, l_out).

    The line from the hub through the fulcrum meets z = 0 (never L_in = C - L_out, which leaves the
    plane for a measured L_out: errata B9). A hub at the fulcrum is `DEGENERATE`; level with or
    below it, `UNREACHABLE`.
    """
    ex, ey, ez = fx - ux, fy - uy, fz - uz
    l_out = sqrt(ex * ex + ey * ey + ez * ez)
    if not isfinite(l_out):
        return NOT_FINITE, 0.0, 0.0, 0.0, 0.0
    if l_out <= _RELATIVE * fz:
        return DEGENERATE, 0.0, 0.0, 0.0, 0.0
    if ez >= -_RELATIVE * l_out:
        return UNREACHABLE, 0.0, 0.0, 0.0, 0.0
    l_in = -fz * l_out / ez
    return OK, fx - fz * ex / ez, fy - fz * ey / ez, l_in, l_out


@njit
def hub_velocity_kernel(
    vx: float, vy: float, dx: float, dy: float, dz: float, l_in: float, l_out: float
) -> tuple[float, float, float]:
    """Velocity of the hub perpendicular to the needle [m/s] for tool velocity (vx, vy).

    G_perp P3dot with G_perp = -(L_out/L_in)(I - d dᵀ)[:, :2]; the part along the needle is free.
    """
    gain = -l_out / l_in
    along = dx * vx + dy * vy
    return gain * (vx - along * dx), gain * (vy - along * dy), -gain * along * dz


@njit
def force_map_kernel(
    fx: float, fy: float, fz: float, dx: float, dy: float, dz: float, l_in: float, l_out: float
) -> tuple[float, float]:
    """Tool force γ = G_perpᵀ F that makes the hand feel F, by virtual work (errata A1).

    Only the part of F perpendicular to the needle can be delivered; the rest drops out.
    """
    gain = -l_out / l_in
    along = dx * fx + dy * fy + dz * fz
    return gain * (fx - along * dx), gain * (fy - along * dy)


@njit
def printed_force_kernel(
    fx: float, fy: float, fz: float, dx: float, dy: float, dz: float, l_in: float, l_out: float
) -> tuple[float, float]:
    """Tool force of the thesis' printed law 4.12 in vector form: -(L_out/L_in)(F - d F_z/d_z)_xy.

    It takes F for the needle-perpendicular part of a *horizontal* force and forgets that the
    mechanism also reacts vertically at P3: in the tilt plane it delivers 1/cos²(tilt) of F (1.66 at
    39°, 2.00 at 45°), sideways F. Kept for comparison.
    """
    gain = -l_out / l_in
    slide = fz / dz
    return gain * (fx - dx * slide), gain * (fy - dy * slide)


@njit
def felt_kernel(
    gx: float, gy: float, dx: float, dy: float, dz: float, l_in: float, l_out: float
) -> tuple[float, float, float]:
    """Force at the hub perpendicular to the needle that a tool force γ makes the hand feel.

    Inverse of `force_map_kernel` on its range: F·d = 0 and G_perpᵀ F = γ.
    """
    gain = -l_in / l_out
    fx, fy = gain * gx, gain * gy
    return fx, fy, -(dx * fx + dy * fy) / dz


@njit
def torque_kernel(
    gx: float, gy: float, jxl: float, jxr: float, jyl: float, jyr: float
) -> tuple[float, float]:
    """Joint torques τ = Jᵀ γ [N·m]: (left, right)."""
    return jxl * gx + jyl * gy, jxr * gx + jyr * gy


@njit
def tool_force_kernel(
    left: float, right: float, jxl: float, jxr: float, jyl: float, jyr: float
) -> tuple[int, float, float]:
    """Tool force γ = J⁻ᵀ τ [N]: (status, gx, gy); `SINGULAR` where J has lost rank."""
    determinant = jxl * jyr - jxr * jyl
    scale = jxl * jxl + jxr * jxr + jyl * jyl + jyr * jyr
    if not abs(determinant) > _RELATIVE * scale:
        return SINGULAR, 0.0, 0.0
    return OK, (jyr * left - jyl * right) / determinant, (jxl * right - jxr * left) / determinant
