"""Kinematics of the spherical tensegrity needle holder on scalars: the one place of every formula.

All functions are compiled, allocate nothing and return a status first (`mechanisms.status`); a
status other than `OK` comes with zeros. Symbols: β1, β2 the joint variables [rad] in [0, π], the
spherical angle at A between the bars AB and AD; t the unit vector from the remote centre O to the
guide's joint T (the needle points along -t); θ the angle between t and OA; `bars` the nine numbers
of `TensegrityGeometry.bars`, given one by one. `assembly` is the sign of D = t·(a1 × a2): +1 as
built, -1 the mirror image below the plane of both base axes.

- `forward_kernel(b1, b2, *bars, assembly) -> (status, tx, ty, tz)`
- `inverse_kernel(tx, ty, tz, *bars, assembly) -> (status, b1, b2)`, t of any length
- `jacobian_kernel(b1, b2, tx, ty, tz, *bars) -> (status, x1, x2, y1, y2, z1, z2)`, dt/dβ
- `joint_rates_kernel(b1, b2, tx, ty, tz, *bars) -> (status, x1, y1, z1, x2, y2, z2)`, dβ/dt
- `jacobian_rate_kernel(b1, b2, v1, v2, tx, ty, tz, *bars) -> (status, six of dJ/dt)`
- `singularity_kernel(b1, b2, tx, ty, tz, *bars) -> (sin β1/2, cos β1/2, sin β2/2, cos β2/2, D)`
- `opening_kernel(b, gain, fold) -> (sin θ, cos θ, θ', θ'')`, derivatives by β

Equations of the paper, corrected (errata C1 to C9): docs/mechanism.md.
"""

from math import atan2, cos, isfinite, pi, sin, sqrt

from app.core.compiled import njit
from app.mechanisms.status import (
    DEGENERATE,
    NOT_FINITE,
    OK,
    SINGULAR,
    UNREACHABLE,
)

_RELATIVE = 1e-12
"""Room for rounding [rad or 1]: within it cones that miss each other touch, and a pantograph that
is asked for more than its reach is stretched."""


@njit
def _half(b: float, gain: float, fold: float) -> tuple[float, float]:
    # sin and cos of θ/2 from tan(θ/(2 fold)) = gain cos(β/2): equations 1 and 3, no angle taken.
    v = gain * cos(0.5 * b)
    c = 1.0 / sqrt(1.0 + v * v)
    if fold == 1.0:
        return v * c, c
    return 2.0 * v * c * c, (1.0 - v * v) * c * c


@njit
def forward_kernel(
    b1: float,
    b2: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
    assembly: float,
) -> tuple[int, float, float, float]:
    """Direction of the guide from the joint variables, in closed form: (status, tx, ty, tz).

    Two cones about a1 and a2 and the unit sphere (equation 4) meet in two points, mirror images in
    the plane of a1 and a2; the one with D = t·(a1 × a2) of the sign of `assembly` is taken ("upper
    hemisphere" would not tell them apart: errata C5). With half angles h1, h2, hγ and the half sum
    s of the spherical triangle (t, a1, a2),

        P = sin(s - θ1) sin(s - γ),  Q = sin s sin(s - θ2),  P + Q = sin θ1 sin γ,
        t = cos θ1 a1 + [(Q - P)(a2 - g a1) ± 2 √(P Q) (a1 × a2)] / sin²γ,  4 P Q = D²,

    products of sines of half angles that keep full precision where the usual discriminant
    1 - g² - k1² - k2² + 2 g k1 k2 (errata C4) has cancelled. Cones that miss each other by more
    than 1e-12 rad are `UNREACHABLE`, less is taken as touching (D = 0); so are joint variables
    more than 1e-12 rad outside [0, π].
    """
    if not (isfinite(b1) and isfinite(b2)):
        return NOT_FINITE, 0.0, 0.0, 0.0
    if min(b1, b2) < -_RELATIVE or max(b1, b2) > pi + _RELATIVE:
        return UNREACHABLE, 0.0, 0.0, 0.0
    s1, c1 = _half(b1, gain1, fold)
    s2, c2 = _half(b2, gain2, fold)
    sum_sin, sum_cos = s1 * c2 + c1 * s2, c1 * c2 - s1 * s2
    gap_sin, gap_cos = s1 * c2 - c1 * s2, c1 * c2 + s1 * s2
    whole = sum_sin * half_cos + sum_cos * half_sin  # sin s
    without = sum_sin * half_cos - sum_cos * half_sin  # sin(s - γ)
    without2 = gap_sin * half_cos + gap_cos * half_sin  # sin(s - θ2)
    without1 = gap_cos * half_sin - gap_sin * half_cos  # sin(s - θ1)
    if min(min(whole, without), min(without1, without2)) < -0.5 * _RELATIVE:
        return UNREACHABLE, 0.0, 0.0, 0.0
    p = max(without1, 0.0) * max(without, 0.0)
    q = max(whole, 0.0) * max(without2, 0.0)
    scale = 1.0 / (2.0 * half_cos * half_sin) ** 2
    along = (q - p) * scale
    across = 2.0 * assembly * sqrt(p * q) * scale
    base = c1 * c1 - s1 * s1 - s10 * s20 * along
    tx = base * c10 - across * s10 * c20
    ty = along * c20 - across * c10 * s20
    tz = base * s10 + along * s20 + across * c10 * c20
    size = 1.0 / sqrt(tx * tx + ty * ty + tz * tz)
    return OK, tx * size, ty * size, tz * size


@njit
def _joint(size: float, along: float, across: float, gain: float, fold: float) -> tuple[int, float]:
    # β from |t|, t·a and |t × a|: tan(θ/2) = |t × a|/(|t| + t·a) = (|t| - t·a)/|t × a|, whichever
    # does not cancel.
    if along >= 0.0:
        above, below = across, size + along
    else:
        above, below = size - along, across
    if fold == 2.0:
        below += sqrt(below * below + above * above)  # half the angle once more
    below *= gain
    if above > below * (1.0 + _RELATIVE):
        return UNREACHABLE, 0.0
    left = max((below - above) * (below + above), 0.0)
    return OK, 2.0 * atan2(sqrt(left), above)


@njit
def inverse_kernel(
    tx: float,
    ty: float,
    tz: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
    assembly: float,
) -> tuple[int, float, float]:
    """Joint variables from the direction of the guide, of any length: (status, b1, b2).

    Equations 1 and 2 without acos (errata C2): tan(θ/2) = |t × a|/(|t| + t·a), then
    cos(β/2) = (R/f) tan(θ/2), or tan(θ/4)/tan b with two rhombi. Exact at β = π, where t = a.
    `UNREACHABLE` where a pantograph would have to be longer than it is, and on the other side of
    the plane of both base axes than `assembly`, beyond 1e-12 each. A zero vector is `DEGENERATE`.
    """
    size = sqrt(tx * tx + ty * ty + tz * tz)
    if not isfinite(size):
        return NOT_FINITE, 0.0, 0.0
    if size < 1e-150:
        return DEGENERATE, 0.0, 0.0
    height = (tz * c10 - tx * s10) * c20 - ty * c10 * s20
    if assembly * height < -_RELATIVE * size:
        return UNREACHABLE, 0.0, 0.0
    across = tz * c10 - tx * s10
    first, b1 = _joint(size, tx * c10 + tz * s10, sqrt(ty * ty + across * across), gain1, fold)
    if first != OK:
        return first, 0.0, 0.0
    across = tz * c20 - ty * s20
    second, b2 = _joint(size, ty * c20 + tz * s20, sqrt(tx * tx + across * across), gain2, fold)
    if second != OK:
        return second, 0.0, 0.0
    return OK, b1, b2


@njit
def opening_kernel(b: float, gain: float, fold: float) -> tuple[float, float, float, float]:
    """θ of one pantograph at β: (sin θ, cos θ, dθ/dβ, d²θ/dβ²), from equation 3.

    θ' = -fold gain sin(β/2) cos²x with x = θ/(2 fold): never positive, zero where β = 0.
    """
    sb, cb = sin(0.5 * b), cos(0.5 * b)
    v = gain * cb
    cc = 1.0 / (1.0 + v * v)  # cos²x; sin x cos x = v cc
    rate = -fold * gain * sb * cc
    second = -0.5 * fold * gain * cb * cc + gain * sb * v * cc * rate
    sine, cosine = 2.0 * v * cc, (1.0 - v * v) * cc  # of 2x
    if fold == 2.0:
        sine, cosine = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
    return sine, cosine, rate, second


@njit
def jacobian_kernel(
    b1: float,
    b2: float,
    tx: float,
    ty: float,
    tz: float,
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
    """Jacobian dt/dβ [1/rad] at a pose: (status, x1, x2, y1, y2, z1, z2), by rows of (3, 2).

    From ṫ·a_i = -sin θ_i θ_i' β̇_i and ṫ·t = 0: columns -sin θ1 θ1' (a2 × t)/D and
    -sin θ2 θ2' (t × a1)/D. `SINGULAR` where D = 0 (type 2: the guide moves with the joints held);
    at β = 0 and β = π a column is zero and that is fine here (type 1).
    """
    height = (tz * c10 - tx * s10) * c20 - ty * c10 * s20
    if not isfinite(height + b1 + b2):
        return NOT_FINITE, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if abs(height) <= _RELATIVE:
        return SINGULAR, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    sine1, _, rate1, _ = opening_kernel(b1, gain1, fold)
    sine2, _, rate2, _ = opening_kernel(b2, gain2, fold)
    first, second = -sine1 * rate1 / height, -sine2 * rate2 / height
    return (
        OK,
        first * (c20 * tz - s20 * ty),
        second * ty * s10,
        first * s20 * tx,
        second * (tz * c10 - tx * s10),
        -first * c20 * tx,
        -second * ty * c10,
    )


@njit
def joint_rates_kernel(
    b1: float,
    b2: float,
    tx: float,
    ty: float,
    tz: float,
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
    """dβ/dt [rad], the inverse of the Jacobian on the sphere: (status, x1, y1, z1, x2, y2, z2).

    Rows of (2, 3): a_i without its part along t, over -sin θ_i θ_i'. Regular where D = 0;
    `SINGULAR` at β = 0 and β = π (type 1), where a joint's rate would have no bound.
    """
    if not isfinite(tx + ty + tz + b1 + b2):
        return NOT_FINITE, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    sine1, _, rate1, _ = opening_kernel(b1, gain1, fold)
    sine2, _, rate2, _ = opening_kernel(b2, gain2, fold)
    by1, by2 = -sine1 * rate1, -sine2 * rate2
    if min(abs(by1), abs(by2)) <= _RELATIVE:
        return SINGULAR, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    k1, k2 = tx * c10 + tz * s10, ty * c20 + tz * s20
    return (
        OK,
        (c10 - k1 * tx) / by1,
        -k1 * ty / by1,
        (s10 - k1 * tz) / by1,
        -k2 * tx / by2,
        (c20 - k2 * ty) / by2,
        (s20 - k2 * tz) / by2,
    )


@njit
def jacobian_rate_kernel(
    b1: float,
    b2: float,
    v1: float,
    v2: float,
    tx: float,
    ty: float,
    tz: float,
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
    """Time derivative of dt/dβ at joint rates (v1, v2) [1/(rad·s)], by rows of (3, 2).

    Product rule on q (a × t)/D with q = -sin θ θ', ṫ = J β̇ and Ḋ = ṫ·(a1 × a2). `SINGULAR` as
    `jacobian_kernel`.
    """
    height = (tz * c10 - tx * s10) * c20 - ty * c10 * s20
    if not isfinite(height + b1 + b2 + v1 + v2):
        return NOT_FINITE, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if abs(height) <= _RELATIVE:
        return SINGULAR, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    sine1, cosine1, rate1, second1 = opening_kernel(b1, gain1, fold)
    sine2, cosine2, rate2, second2 = opening_kernel(b2, gain2, fold)
    q1, q2 = -sine1 * rate1 / height, -sine2 * rate2 / height
    p1 = -(cosine1 * rate1 * rate1 + sine1 * second1) * v1 / height
    p2 = -(cosine2 * rate2 * rate2 + sine2 * second2) * v2 / height
    x1, y1, z1 = c20 * tz - s20 * ty, s20 * tx, -c20 * tx
    x2, y2, z2 = ty * s10, tz * c10 - tx * s10, -ty * c10
    wx, wy, wz = (
        q1 * x1 * v1 + q2 * x2 * v2,
        q1 * y1 * v1 + q2 * y2 * v2,
        q1 * z1 * v1 + q2 * z2 * v2,
    )
    fall = ((wz * c10 - wx * s10) * c20 - wy * c10 * s20) / height
    p1, p2 = p1 - q1 * fall, p2 - q2 * fall
    return (
        OK,
        p1 * x1 + q1 * (c20 * wz - s20 * wy),
        p2 * x2 + q2 * wy * s10,
        p1 * y1 + q1 * s20 * wx,
        p2 * y2 + q2 * (wz * c10 - wx * s10),
        p1 * z1 - q1 * c20 * wx,
        p2 * z2 - q2 * wy * c10,
    )


@njit
def singularity_kernel(
    b1: float,
    b2: float,
    tx: float,
    ty: float,
    tz: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
) -> tuple[float, float, float, float, float]:
    """Return how far a pose is from singular: (sin β1/2, cos β1/2, sin β2/2, cos β2/2, D).

    The first four vanish where a pantograph is stretched (β = 0) or folded (β = π, T on A), the
    last where t lies in the plane of both base axes and the two assemblies meet.
    """
    height = (tz * c10 - tx * s10) * c20 - ty * c10 * s20
    return sin(0.5 * b1), cos(0.5 * b1), sin(0.5 * b2), cos(0.5 * b2), height


@njit
def dexterity_kernel(
    x1: float, x2: float, y1: float, y2: float, z1: float, z2: float
) -> tuple[float, float]:
    """Singular values of dt/dβ: (smaller over larger, 1 if isotropic; the larger [1/rad])."""
    aa, bb = x1 * x1 + y1 * y1 + z1 * z1, x2 * x2 + y2 * y2 + z2 * z2
    ab = x1 * x2 + y1 * y2 + z1 * z2
    largest2 = 0.5 * (aa + bb + sqrt((aa - bb) ** 2 + 4.0 * ab * ab))
    if largest2 <= 0.0:
        return 0.0, 0.0
    nx, ny, nz = y1 * z2 - z1 * y2, z1 * x2 - x1 * z2, x1 * y2 - y1 * x2
    return sqrt(nx * nx + ny * ny + nz * nz) / largest2, sqrt(largest2)
