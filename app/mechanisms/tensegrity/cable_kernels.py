"""Cables of the tensegrity needle holder on scalars: lengths, tensions, stiffness, hub forces.

All functions are compiled and allocate nothing. Four cables in the order B1D1, C1A1, B2D2, C2A2;
the first two belong to the first pantograph. A winch that pulls a cable shorter does the work
-t dl, so that the torque of the cables on β is τ = -t1 l1' - t2 l2' for each pantograph, with
l1' ≥ 0 ≥ l2' (derivatives by β): the first cable closes the rhombus towards β = 0, the second opens
it towards β = π. `law` are the four numbers of `Cables.law`, `radii` the two of the spheres.

- `cable_kernel(b, radius, gain, fold) -> (l1, l2, l1', l2', l1'', l2'')`, one pantograph
- `lengths_kernel(b1, b2, *radii, *bars) -> four lengths [m]`
- `tensions_kernel(b1, b2, τ1, τ2, k1, k2, *law, *radii, *bars) -> (status, four tensions [N], two
  shortfalls [N·m])`
- `torques_kernel(four tensions, b1, b2, *radii, *bars) -> (τ1, τ2)`, its inverse
- `joint_stiffness_kernel(four tensions, b1, b2, *law, *radii, *bars) -> (k1, k2) [N·m/rad]`
- `hub_torque_kernel(fx, fy, fz, l_out, six of dt/dβ) -> (τ1, τ2)`; `hub_force_kernel` inverts it
- `pulled_kernel(stretch, k0, c)`, `stretch_kernel(tension, k0, c)`: the law of one cable
"""

from math import cos, exp, expm1, isfinite, log1p, sin, sqrt

from app.core.compiled import njit
from app.mechanisms.status import NOT_FINITE, OK, SINGULAR, UNREACHABLE
from app.mechanisms.tensegrity.kernels import opening_kernel

_RELATIVE = 1e-12

_STEEP = 0.05
"""Share of the radius from which on a slope of stiffness by pretension is used in full. Below it
pretension is used the less the less it does, so that tensions have no jump where a slope changes
its sign. With cables of constant stiffness and the
paper's bars no slope is below 0.10 of the radius."""


@njit
def cable_kernel(
    b: float, radius: float, gain: float, fold: float
) -> tuple[float, float, float, float, float, float]:
    """Lengths of both cables of one pantograph and their derivatives by β, up to the second.

    l1 = |BD| = 2 R sin(side) sin(β/2) and l2 = |CA| = 2 R sin(θ/4), straight between the joints;
    gain = tan(side).
    """
    sb, cb = sin(0.5 * b), cos(0.5 * b)
    wide = radius * gain / sqrt(1.0 + gain * gain)
    v = gain * cb
    c = 1.0 / sqrt(1.0 + v * v)
    if fold == 1.0:  # c is cos θ/2
        quarter_cos = sqrt(0.5 * (1.0 + c))
        quarter_sin = 0.5 * v * c / quarter_cos
    else:  # c is cos θ/4
        quarter_sin, quarter_cos = v * c, c
    _, _, rate, second = opening_kernel(b, gain, fold)
    return (
        2.0 * wide * sb,
        2.0 * radius * quarter_sin,
        wide * cb,
        0.5 * radius * quarter_cos * rate,
        -0.5 * wide * sb,
        0.5 * radius * (quarter_cos * second - 0.25 * quarter_sin * rate * rate),
    )


@njit
def lengths_kernel(
    b1: float,
    b2: float,
    radius1: float,
    radius2: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
) -> tuple[float, float, float, float]:
    """Lengths of the four cables between their joints [m]."""
    l1, l2, _, _, _, _ = cable_kernel(b1, radius1, gain1, fold)
    l3, l4, _, _, _, _ = cable_kernel(b2, radius2, gain2, fold)
    return l1, l2, l3, l4


@njit
def pair_kernel(
    p: float,
    q: float,
    bend1: float,
    bend2: float,
    torque: float,
    wanted: float,
    k0: float,
    c: float,
    least: float,
    most: float,
    radius: float,
) -> tuple[int, float, float, float, float, float]:
    """Tensions of the two cables of one pantograph: (status, t1, t2, shortfall, and the
    stiffness at the least and at the most pretension).

    p = l1', q = -l2', `bend` the second derivatives. All tensions that give a torque τ are
    t_p + λ n, with t_p = τ (-p, q)/(p² + q²) the shortest and n = (q, p)/√(p² + q²), whose entries
    are never negative: more λ is more pretension, and the limits leave one interval of λ. So the
    programme of both pantographs falls into two of one variable each, which cost the same
    whatever is asked. Without a request (`wanted` ≤ 0) λ is λ0, the least that keeps the limits:
    the tensions of least norm. Stiffness is linear in λ, with slope σ; a request adds the d that
    minimises (k - wanted)² + max(0, σ0² - σ²) d² over 0 ≤ d ≤ Λ min(1, |σ|/σ0), Λ the rest of the
    interval and σ0 = _STEEP R: one expression, clipped. It is met exactly or is the nearest for
    |σ| ≥ σ0; d changes by no more than 1/σ0 per unit of stiffness asked and Λ/σ0 per unit of
    slope, so it is continuous in everything.

    Torque is to be had between q least - p most and q most - p least. Beyond, one cable stands at
    each limit (`UNREACHABLE`) and what is missing is the shortfall [N·m]. At β = 0 and β = π one
    cable has lost its lever and there is no pretension (`SINGULAR`); the tensions are still within
    the limits and still continuous. So they are beyond, where a β that is measured may stand: a
    lever that has changed its sign counts as none.
    """
    p, q = max(p, 0.0), max(q, 0.0)
    norm2 = p * p + q * q
    low, high = q * least - p * most, q * most - p * least
    status = OK if min(p, q) > _RELATIVE * radius else SINGULAR
    m1, m2 = c * p * p + bend1, c * q * q + bend2
    constant = k0 * norm2
    if torque >= high or torque <= low:
        first, second, end = (least, most, high) if torque >= high else (most, least, low)
        short = torque - end
        if status == OK and abs(short) > _RELATIVE * radius * most:
            status = UNREACHABLE
        stiffness = constant + first * m1 + second * m2
        return status, first, second, short, stiffness, stiffness
    norm = sqrt(norm2)
    n1, n2 = q / norm, p / norm
    t1, t2 = -torque * p / norm2, torque * q / norm2
    down, up = -1e300, 1e300
    if n1 > 1e-15:
        down, up = (least - t1) / n1, (most - t1) / n1
    if n2 > 1e-15:
        down, up = max(down, (least - t2) / n2), min(up, (most - t2) / n2)
    start = min(max(0.0, down), up)  # 0 is below the interval wherever a cable must pull
    slope = n1 * m1 + n2 * m2
    at_start = constant + (t1 + start * n1) * m1 + (t2 + start * n2) * m2
    best = start
    if wanted > 0.0:
        steep = _STEEP * radius
        added = slope * (wanted - at_start) / max(slope * slope, steep * steep)
        best += min(max(added, 0.0), (up - start) * min(1.0, abs(slope) / steep))
    return (
        status,
        min(max(t1 + best * n1, least), most),
        min(max(t2 + best * n2, least), most),
        0.0,
        at_start,
        at_start + (up - start) * slope,
    )


@njit
def tensions_kernel(
    b1: float,
    b2: float,
    torque1: float,
    torque2: float,
    wanted1: float,
    wanted2: float,
    k0: float,
    c: float,
    least: float,
    most: float,
    radius1: float,
    radius2: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
) -> tuple[int, float, float, float, float, float, float]:
    """Tensions of the four cables for two torques: (status, t1, t2, t3, t4, shortfall 1, 2).

    `wanted` are stiffnesses of the joints [N·m/rad] at held winches; 0 asks for none. Tensions are
    always within their limits; the status is the first pantograph's if that is not `OK`, else the
    second's: `UNREACHABLE` where torque is missing, `SINGULAR` at β = 0 and β = π. With an input
    that is `NOT_FINITE` all cables are at the least tension. See `pair_kernel`.
    """
    if not isfinite(b1 + b2 + torque1 + torque2 + wanted1 + wanted2):
        return NOT_FINITE, least, least, least, least, 0.0, 0.0
    _, _, p, q, bend1, bend2 = cable_kernel(b1, radius1, gain1, fold)
    status, t1, t2, short1, _, _ = pair_kernel(
        p, -q, bend1, bend2, torque1, wanted1, k0, c, least, most, radius1
    )
    _, _, p, q, bend1, bend2 = cable_kernel(b2, radius2, gain2, fold)
    second, t3, t4, short2, _, _ = pair_kernel(
        p, -q, bend1, bend2, torque2, wanted2, k0, c, least, most, radius2
    )
    return status if status != OK else second, t1, t2, t3, t4, short1, short2


@njit
def torques_kernel(
    t1: float,
    t2: float,
    t3: float,
    t4: float,
    b1: float,
    b2: float,
    radius1: float,
    radius2: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
) -> tuple[float, float]:
    """Torques of four tensions on β [N·m]: τ = -t1 l1' - t2 l2' for each pantograph."""
    _, _, p, q, _, _ = cable_kernel(b1, radius1, gain1, fold)
    first = -t1 * p - t2 * q
    _, _, p, q, _, _ = cable_kernel(b2, radius2, gain2, fold)
    return first, -t3 * p - t4 * q


@njit
def joint_stiffness_kernel(
    t1: float,
    t2: float,
    t3: float,
    t4: float,
    b1: float,
    b2: float,
    k0: float,
    c: float,
    least: float,
    most: float,
    radius1: float,
    radius2: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
) -> tuple[float, float]:
    """Stiffness of both joints at held winches [N·m/rad]: k = Σ k l'² + Σ t l''.

    The second sum is never positive: bars on the rim and cables on the diagonals of a rhombus are
    the super-stable tensegrity with its stress reversed, so pretension alone softens (errata C11).
    A cable without tension is slack and gives nothing.
    """
    _, _, p, q, pp, qq = cable_kernel(b1, radius1, gain1, fold)
    first = _stiffness(t1, p, pp, k0, c) + _stiffness(t2, q, qq, k0, c)
    _, _, p, q, pp, qq = cable_kernel(b2, radius2, gain2, fold)
    return first, _stiffness(t3, p, pp, k0, c) + _stiffness(t4, q, qq, k0, c)


@njit
def _stiffness(tension: float, lever: float, bend: float, k0: float, c: float) -> float:
    if not tension > 0.0:
        return 0.0
    return (k0 + c * tension) * lever * lever + tension * bend


@njit
def hub_torque_kernel(
    fx: float,
    fy: float,
    fz: float,
    l_out: float,
    x1: float,
    x2: float,
    y1: float,
    y2: float,
    z1: float,
    z2: float,
) -> tuple[float, float]:
    """Torques τ = L_out Jᵀ F [N·m] that make the hand at the hub feel F [N]: (τ1, τ2).

    The hub stands at O + L_out t. Only the part of F across the needle can be delivered.
    """
    return l_out * (x1 * fx + y1 * fy + z1 * fz), l_out * (x2 * fx + y2 * fy + z2 * fz)


@njit
def hub_force_kernel(
    torque1: float,
    torque2: float,
    l_out: float,
    x1: float,
    y1: float,
    z1: float,
    x2: float,
    y2: float,
    z2: float,
) -> tuple[float, float, float]:
    """Force across the needle [N] that torques make the hand feel: Bᵀ τ/L_out, B = dβ/dt.

    The six entries are those of `joint_rates_kernel`, L_out must be positive.
    """
    return (
        (x1 * torque1 + x2 * torque2) / l_out,
        (y1 * torque1 + y2 * torque2) / l_out,
        (z1 * torque1 + z2 * torque2) / l_out,
    )


@njit
def pulled_kernel(stretch: float, k0: float, c: float) -> tuple[float, float, float]:
    """Tension, stiffness and stored energy of a cable by its stretch: (t [N], k [N/m], [J]).

    dt/dx = k0 + c t, so t = k0 (e^(c x) - 1)/c; with c = 0 a spring. A cable does not push.
    """
    if not stretch > 0.0:
        return 0.0, 0.0, 0.0
    if c == 0.0:
        return k0 * stretch, k0, 0.5 * k0 * stretch * stretch
    tension = k0 * expm1(c * stretch) / c
    return tension, k0 * exp(c * stretch), (tension - k0 * stretch) / c


@njit
def stretch_kernel(tension: float, k0: float, c: float) -> float:
    """Stretch of a cable at a tension [m]; the inverse of `pulled_kernel`, 0 where slack."""
    if not tension > 0.0:
        return 0.0
    return tension / k0 if c == 0.0 else log1p(c * tension / k0) / c
