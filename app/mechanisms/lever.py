"""A needle that slides through a remote centre, as its tool point sees it: on scalars.

Whatever machine points the needle, its line crosses the plane z = 0 of the world below the remote
centre P_I (fx, fy, fz) in the tool point P3 (x, y): of the pantograph that is where it holds the
needle, of another machine a way to say its direction d, hub to tip, in two regular numbers. With
L_in = |P_I P3| the lever, and L_out from the hub point P_u to P_I, everything that a force at the
hub does follows by virtual work from the machine's own J = dP3/dq:

- `axis_kernel(x, y, fx, fy, fz) -> (dx, dy, dz, l_in)`
- `tool_kernel(ux, uy, uz, fx, fy, fz) -> (status, x, y, l_in, l_out)`
- `hub_velocity_kernel(vx, vy, dx, dy, dz, l_in, l_out) -> (wx, wy, wz)`
- `force_map_kernel`, `printed_force_kernel (fx, fy, fz, dx, dy, dz, l_in, l_out) -> (gx, gy)`
- `felt_kernel(gx, gy, dx, dy, dz, l_in, l_out) -> (fx, fy, fz)`
- `torque_kernel(gx, gy, jxl, jxr, jyl, jyr) -> (left, right)` and its inverse `tool_force_kernel`

and so do the needle's own inertia and weight, its centre of mass s beyond P_I (`needle_*`). F is a
force at the hub point [N], γ one at P3 [N]. "Errata" entries: docs/errata.md.
"""

from enum import StrEnum
from math import isfinite, sqrt

from app.core.compiled import njit
from app.mechanisms.status import DEGENERATE, NOT_FINITE, OK, SINGULAR, UNREACHABLE

_RELATIVE = 1e-12


class ForceLaw(StrEnum):
    """How a wanted force at the hand becomes a force at the tool.

    `VIRTUAL_WORK` delivers it; `PRINTED` is equation 4.12 of the thesis, which delivers 1.66 times
    the force at 39° and twice at 45° in the tilt plane.
    """

    VIRTUAL_WORK = "virtual_work"
    PRINTED = "printed"


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


@njit
def needle_mass_kernel(
    dx: float, dy: float, l_in: float, s: float, mass: float, inertia: float
) -> tuple[float, float, float]:
    """Inertia at P3 [kg] of the needle that P3 turns: (xx, xy, yy)."""
    scale = (inertia + mass * s * s) / (l_in * l_in)
    return scale * (1.0 - dx * dx), -scale * dx * dy, scale * (1.0 - dy * dy)


@njit
def needle_velocity_kernel(
    vx: float,
    vy: float,
    ax: float,
    ay: float,
    dx: float,
    dy: float,
    l_in: float,
    s: float,
    rate: float,
    mass: float,
    inertia: float,
) -> tuple[float, float]:
    """Force at P3 [N] for velocity v and acceleration a of P3 at depth rate `rate` [m/s]: (x, y).

    From L d = P3 - P_I, twice differentiated: L d̈ = (I - d dᵀ) a - 2 L̇ ḋ across the needle.
    """
    along = dx * vx + dy * vy  # = L̇
    tx, ty = (vx - along * dx) / l_in, (vy - along * dy) / l_in  # ḋ on x and y
    fall = dx * ax + dy * ay
    scale = (inertia + mass * s * s) / (l_in * l_in)
    slide = 2.0 * mass * s * rate / l_in
    return (
        scale * (ax - fall * dx - 2.0 * along * tx) + slide * tx,
        scale * (ay - fall * dy - 2.0 * along * ty) + slide * ty,
    )


@njit
def needle_gravity_kernel(
    gx: float,
    gy: float,
    gz: float,
    dx: float,
    dy: float,
    dz: float,
    l_in: float,
    s: float,
    mass: float,
) -> tuple[float, float]:
    """dV/dP3 of the needle in gravity [N]: (x, y)."""
    fall = dx * gx + dy * gy + dz * gz
    scale = -mass * s / l_in
    return scale * (gx - fall * dx), scale * (gy - fall * dy)


@njit
def needle_axial_kernel(
    vx: float,
    vy: float,
    gx: float,
    gy: float,
    gz: float,
    dx: float,
    dy: float,
    dz: float,
    l_in: float,
    s: float,
    mass: float,
) -> float:
    """Force that draws the needle inwards [N]: m s |ḋ|² of its turning and m g·d of gravity."""
    along = dx * vx + dy * vy
    turning = (vx * vx + vy * vy - along * along) / (l_in * l_in)
    return mass * (s * turning + dx * gx + dy * gy + dz * gz)
