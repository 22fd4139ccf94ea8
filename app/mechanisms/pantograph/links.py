"""Inertia of the links of the closed chain, on scalars; the needle comes on top (`dynamics`).

Two double pendulums (absolute link angles θ1, θ2 and θ1', θ2') joined at P3. Because P3 belongs to
both arms, θ̇2 and θ̇2' are linear in q̇:

    θ̇2  = (a1/a2) [-s(2'-1) q̇1 + s(2'-1') q̇2] / s(2'-2)
    θ̇2' = (a1/a2) [ s(2-1) q̇1 -  s(2-1') q̇2] / s(2-2')

and M = Sᵀ M_w S + Jᵀ W J, h = Sᵀ(M_w Ṡq̇ + h_w) + Jᵀ f, with W the inertia of what moves with P3
and f what it takes to give it the acceleration J̇q̇ (docs/errata.md).

Arguments, all `Four`: `turns` are cosine and sine of q1, then of q2 (`turns_kernel`, taken once by
the caller), `u` the directions of the distal links (`distal_kernel`), `s` their rates by q
(`passive_rates_kernel`), `speeds` the rates of all four links (`speeds_kernel`). All divide by
s(2'-2): call them only where `jacobian_kernel` says `OK`.
"""

from math import cos, sin

from app.core.compiled import njit

Four = tuple[float, float, float, float]
"""Two numbers of the left arm, two of the right."""


@njit
def turns_kernel(q1: float, q2: float) -> Four:
    """Cosine and sine of both motor angles: (c1, s1, c1', s1')."""
    return cos(q1), sin(q1), cos(q2), sin(q2)


@njit
def distal_kernel(turns: Four, x: float, y: float, a1: float, a2: float, base: float) -> Four:
    """Return the unit vectors along the distal links from elbow to tool: (c2, s2, c2', s2')."""
    c1, s1, c1r, s1r = turns
    return (
        (x - (a1 * c1 - 0.5 * base)) / a2,
        (y - a1 * s1) / a2,
        (x - (a1 * c1r + 0.5 * base)) / a2,
        (y - a1 * s1r) / a2,
    )


@njit
def passive_rates_kernel(turns: Four, u: Four, a1: float, a2: float) -> Four:
    """dθ2/dq and dθ2'/dq: (left by q1, left by q2, right by q1, right by q2)."""
    c1, s1, c1r, s1r = turns
    ux, uy, rx, ry = u
    gain = a1 / (a2 * (ry * ux - rx * uy))
    return (
        -gain * (ry * c1 - rx * s1),
        gain * (ry * c1r - rx * s1r),
        -gain * (uy * c1 - ux * s1),
        gain * (uy * c1r - ux * s1r),
    )


@njit
def speeds_kernel(s: Four, v1: float, v2: float) -> Four:
    """Rates of the four links [rad/s] at joint rates v: (θ̇1, θ̇1', θ̇2, θ̇2')."""
    ll, lr, rl, rr = s
    return v1, v2, ll * v1 + lr * v2, rl * v1 + rr * v2


@njit
def passive_acceleration_kernel(turns: Four, u: Four, speeds: Four, a1: float, a2: float) -> Four:
    """Accelerations at q̈ = 0: (θ̈2, θ̈2', ax, ay), with a = J̇q̇.

    P̈3 = k + a2 θ̈2 t2 = k' + a2 θ̈2' t2', k the centripetal accelerations of the two arms.
    """
    c1, s1, c1r, s1r = turns
    ux, uy, rx, ry = u
    v1, v2, w, wr = speeds
    kx, ky = -a1 * v1 * v1 * c1 - a2 * w * w * ux, -a1 * v1 * v1 * s1 - a2 * w * w * uy
    krx = -a1 * v2 * v2 * c1r - a2 * wr * wr * rx
    kry = -a1 * v2 * v2 * s1r - a2 * wr * wr * ry
    scale = 1.0 / (a2 * (ry * ux - rx * uy))
    alpha = scale * ((krx - kx) * rx + (kry - ky) * ry)
    alpha_r = -scale * ((kx - krx) * ux + (ky - kry) * uy)
    return alpha, alpha_r, kx - a2 * alpha * uy, ky + a2 * alpha * ux


@njit
def tool_jacobian_kernel(turns: Four, u: Four, s: Four, a1: float, a2: float) -> Four:
    """J = dP2/dq + a2 t2 dθ2/dq along the left arm: (jxl, jxr, jyl, jyr)."""
    c1, s1, _, _ = turns
    ux, uy, _, _ = u
    ll, lr, _, _ = s
    return (
        -a1 * s1 - a2 * uy * ll,
        -a2 * uy * lr,
        a1 * c1 + a2 * ux * ll,
        a2 * ux * lr,
    )


@njit
def link_mass_kernel(
    turns: Four, u: Four, s: Four, driven: float, passive: float, coupling: float
) -> tuple[float, float, float]:
    """Sᵀ M_w S: (left, cross, right) [kg·m²]."""
    c1, s1, c1r, s1r = turns
    ux, uy, rx, ry = u
    ll, lr, rl, rr = s
    left = coupling * (ux * c1 + uy * s1)
    right = coupling * (rx * c1r + ry * s1r)
    return (
        driven + 2.0 * left * ll + passive * (ll * ll + rl * rl),
        left * lr + right * rl + passive * (ll * lr + rl * rr),
        driven + 2.0 * right * rr + passive * (lr * lr + rr * rr),
    )


@njit
def link_velocity_kernel(
    turns: Four,
    u: Four,
    s: Four,
    speeds: Four,
    alpha: float,
    alpha_r: float,
    passive: float,
    coupling: float,
) -> tuple[float, float]:
    """Sᵀ(M_w Ṡq̇ + h_w) [N·m]: (left, right)."""
    c1, s1, c1r, s1r = turns
    ux, uy, rx, ry = u
    ll, lr, rl, rr = s
    v1, v2, w, wr = speeds
    cosine, sine = coupling * (ux * c1 + uy * s1), coupling * (uy * c1 - ux * s1)
    cosine_r, sine_r = coupling * (rx * c1r + ry * s1r), coupling * (ry * c1r - rx * s1r)
    swing = passive * alpha + sine * v1 * v1
    swing_r = passive * alpha_r + sine_r * v2 * v2
    return (
        cosine * alpha - sine * w * w + ll * swing + rl * swing_r,
        cosine_r * alpha_r - sine_r * wr * wr + lr * swing + rr * swing_r,
    )


@njit
def link_gravity_kernel(
    turns: Four, u: Four, s: Four, driven_moment: float, passive_moment: float, gx: float, gy: float
) -> tuple[float, float]:
    """dV/dq of the links in gravity (gx, gy) [N·m]: (left, right). Gravity along z does no work."""
    c1, s1, c1r, s1r = turns
    ux, uy, rx, ry = u
    ll, lr, rl, rr = s
    swing = -passive_moment * (gy * ux - gx * uy)
    swing_r = -passive_moment * (gy * rx - gx * ry)
    return (
        -driven_moment * (gy * c1 - gx * s1) + ll * swing + rl * swing_r,
        -driven_moment * (gy * c1r - gx * s1r) + lr * swing + rr * swing_r,
    )


@njit
def at_joints_kernel(
    xx: float, xy: float, yy: float, jxl: float, jxr: float, jyl: float, jyr: float
) -> tuple[float, float, float]:
    """Jᵀ W J of a symmetric W at P3: (left, cross, right)."""
    txl, tyl = xx * jxl + xy * jyl, xy * jxl + yy * jyl
    txr, tyr = xx * jxr + xy * jyr, xy * jxr + yy * jyr
    return jxl * txl + jyl * tyl, jxr * txl + jyr * tyl, jxr * txr + jyr * tyr
