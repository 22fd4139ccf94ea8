"""The needle as a body: it turns about the fulcrum with P3 and slides along its axis.

Its centre of mass stands at s = depth + offset beyond the fulcrum along d (offset = its distance
from the hub less the needle's length). With E = dd/dP3 = (1/L_in)(I - d dᵀ)[:, :2] the kinetic
energy is ½ m ṡ² + ½ (I + m s²) |ḋ|², ḋ = E Ṗ3, and the potential -m s g·d. So

- it adds W = (I + m s²) EᵀE to the inertia at P3,
- (I + m s²) Eᵀ d̈ + 2 m s ṡ Eᵀ ḋ to the force there, d̈ at the acceleration J̇q̇ of P3,
- -m s Eᵀ g of gravity, and m s |ḋ|² + m g·d along the needle, inwards.

The spin about its own axis is left out: it turns freely in its tube, and its inertia is that of a
thin rod. `d` points from hub to tip; e = (x, y).
"""

from app.core.compiled import njit


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
