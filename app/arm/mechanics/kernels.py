"""Kinematics of an arm with spherical shoulder and wrist: the one place of every formula.

Compiled; nothing is allocated, arrays are filled. The chain is the paper's table of modified
(Craig) parameters with d1, d3, d5 (`lengths`): R = Rz(θ1) Ry(θ2) Rz(θ3) Ry(-θ4) Rz(θ5) Ry(θ6)
Rz(θ7), where the first three axes meet in the shoulder S, the last three in the wrist centre W.

The inverse. |SW| alone gives θ4, up to its sign. Let B = Rz(θref) Ry(ψp) be the frame whose z
points from S to W and whose y is level, and φ the angle at S between upper arm and SW, of the sign
of θ4. Turning the elbow about SW by the arm angle ψ gives

    R03(ψ) = B Rz(ψ) Ry(φ),      R47(ψ) = Ry(θ4 - φ) Rz(-ψ) Bᵀ R,

both of the form Rz Ry Rz with two solutions each, by the sign of the middle angle. Every entry is
linear in (cos ψ, sin ψ, 1). ψ = 0 is the decoupled solution with θ3 = 0 and θ1 = θref =
atan2(p_y, p_x). ψ is the angle about SW of the elbow plane's normal, R03 y, from the level B y:
it is defined, and exact, with the elbow stretched too.

Bits of `singular` that answers carry: `FIRST_AXIS` W on the axis of joint 1 (θref is what was kept
of θ1), `SHOULDER` sin θ2 = 0 (only θ1 + θ3 is defined; θ1 is kept), `ELBOW` sin θ4 = 0 (stretched),
`WRIST` sin θ6 = 0 (only θ5 + θ7 is defined; θ5 is kept).

"Errata" entries: docs/errata.md.
"""

from math import atan2, cos, hypot, isfinite, pi, sin, sqrt
from typing import Final

from app.core.arrays import FloatArray, IntArray
from app.core.compiled import njit
from app.mechanisms.status import DEGENERATE, NOT_FINITE, OK, UNREACHABLE

FIRST_AXIS: Final = 1
SHOULDER: Final = 2
ELBOW: Final = 4
WRIST: Final = 8

ALIGNED: Final = 1e-12
"""Sine below which two axes count as aligned, and relative room for rounding at the edge of reach.
What is kept then puts the pose off by no more than that."""

Three = tuple[float, float, float]
Nine = tuple[float, float, float, float, float, float, float, float, float]
"""A rotation matrix, row by row."""


@njit
def wrapped(angle: float) -> float:
    """Bring an angle of less than two turns into (-π, π]."""
    if angle > pi:
        return angle - 2.0 * pi
    if angle <= -pi:
        return angle + 2.0 * pi
    return angle


@njit
def _turned_z(m: Nine, angle: float) -> Nine:
    # m Rz(angle)
    c, s = cos(angle), sin(angle)
    return (
        c * m[0] + s * m[1],
        c * m[1] - s * m[0],
        m[2],
        c * m[3] + s * m[4],
        c * m[4] - s * m[3],
        m[5],
        c * m[6] + s * m[7],
        c * m[7] - s * m[6],
        m[8],
    )


@njit
def _turned_y(m: Nine, angle: float) -> Nine:
    # m Ry(angle)
    c, s = cos(angle), sin(angle)
    return (
        c * m[0] - s * m[2],
        m[1],
        s * m[0] + c * m[2],
        c * m[3] - s * m[5],
        m[4],
        s * m[3] + c * m[5],
        c * m[6] - s * m[8],
        m[7],
        s * m[6] + c * m[8],
    )


@njit
def forward_kernel(
    q: FloatArray, lengths: Three, rotation: FloatArray, position: FloatArray
) -> None:
    """Pose of the wrist ⁰T₇ of joint angles (7,): fills (3, 3) and (3,) [m]."""
    m: Nine = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    m = _turned_z(_turned_y(_turned_z(m, q[0]), q[1]), q[2])
    x, y, z = lengths[1] * m[2], lengths[1] * m[5], lengths[0] + lengths[1] * m[8]
    m = _turned_y(m, -q[3])
    position[0], position[1], position[2] = (
        x + lengths[2] * m[2],
        y + lengths[2] * m[5],
        z + lengths[2] * m[8],
    )
    m = _turned_z(_turned_y(_turned_z(m, q[4]), q[5]), q[6])
    for i in range(3):
        for j in range(3):
            rotation[i, j] = m[3 * i + j]


@njit
def _column(out: FloatArray, k: int, axis: Three, arm: Three) -> None:
    # A turn about `axis` moves a point at `arm` from it by axis x arm.
    out[0, k] = axis[1] * arm[2] - axis[2] * arm[1]
    out[1, k] = axis[2] * arm[0] - axis[0] * arm[2]
    out[2, k] = axis[0] * arm[1] - axis[1] * arm[0]
    out[3, k], out[4, k], out[5, k] = axis


@njit
def jacobian_kernel(q: FloatArray, lengths: Three, at: Three, out: FloatArray) -> None:
    """Geometric Jacobian (6, 7) in the base's axes: velocity [m/rad], then angular velocity.

    `at` is the point whose velocity is meant, in the frame of the wrist [m].
    """
    m: Nine = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    axis0 = (0.0, 0.0, 1.0)
    m = _turned_z(m, q[0])
    axis1 = (m[1], m[4], m[7])
    m = _turned_y(m, q[1])
    axis2 = (m[2], m[5], m[8])
    m = _turned_z(m, q[2])
    axis3 = (-m[1], -m[4], -m[7])
    upper = (lengths[1] * m[2], lengths[1] * m[5], lengths[1] * m[8])
    m = _turned_y(m, -q[3])
    axis4 = (m[2], m[5], m[8])
    fore = (lengths[2] * m[2], lengths[2] * m[5], lengths[2] * m[8])
    m = _turned_z(m, q[4])
    axis5 = (m[1], m[4], m[7])
    m = _turned_y(m, q[5])
    axis6 = (m[2], m[5], m[8])
    m = _turned_z(m, q[6])
    hand = (
        m[0] * at[0] + m[1] * at[1] + m[2] * at[2],
        m[3] * at[0] + m[4] * at[1] + m[5] * at[2],
        m[6] * at[0] + m[7] * at[1] + m[8] * at[2],
    )
    elbow = (fore[0] + hand[0], fore[1] + hand[1], fore[2] + hand[2])
    shoulder = (upper[0] + elbow[0], upper[1] + elbow[1], upper[2] + elbow[2])
    _column(out, 0, axis0, shoulder)
    _column(out, 1, axis1, shoulder)
    _column(out, 2, axis2, shoulder)
    _column(out, 3, axis3, elbow)
    _column(out, 4, axis4, hand)
    _column(out, 5, axis5, hand)
    _column(out, 6, axis6, hand)


@njit
def direction_kernel(
    position: FloatArray, pedestal: float, keep: float
) -> tuple[float, float, float, float, float, int]:
    """Where W stands from S: (|SW|, sin ψp, cos ψp, cos θref, sin θref, singular).

    ψp is the angle of SW from the vertical. On the axis of joint 1 θref is `keep`.
    """
    x, y, z = position[0], position[1], position[2] - pedestal
    aside = hypot(x, y)
    reach = hypot(aside, z)
    if aside <= ALIGNED * reach:
        return reach, 0.0, 1.0 if z >= 0.0 else -1.0, cos(keep), sin(keep), FIRST_AXIS
    return reach, aside / reach, z / reach, x / aside, y / aside, 0


@njit
def elbow_kernel(reach: float, lengths: Three, sign: float) -> tuple[int, float, float, float, int]:
    """Elbow of a distance |SW|: (status, θ4, sin φ, cos φ, singular).

    2 d3 d5 sin θ4 in product form (Heron) keeps every digit with the elbow stretched or folded; a
    reach off by rounding only counts as its edge. W in S (a folded arm of equal links) is
    `DEGENERATE`.
    """
    a, b = lengths[1], lengths[2]
    if not isfinite(reach):
        return NOT_FINITE, 0.0, 0.0, 1.0, 0
    room = ALIGNED * (a + b)
    if reach > a + b + room or reach < abs(a - b) - room:
        return UNREACHABLE, 0.0, 0.0, 1.0, 0
    if reach <= room:
        return DEGENERATE, 0.0, 0.0, 1.0, 0
    product = (a + b - reach) * (a + b + reach) * (reach - (a - b)) * (reach + (a - b))
    sine = sign * sqrt(max(product, 0.0))
    along = reach * reach + (a - b) * (a + b)
    scale = hypot(sine, along)
    theta = atan2(sine, (reach * reach - a * a) - b * b)
    flag = ELBOW if abs(sine) <= 2.0 * ALIGNED * a * b else 0
    return OK, theta, sine / scale, along / scale, flag


@njit
def split_kernel(m: Nine, sign: float, keep: float) -> tuple[float, float, float, bool]:
    """Angles of m = Rz(a) Ry(b) Rz(c), b of a sign: (a, b, c, aligned).

    c is found with a as it is, not for itself: however badly a is defined near b = 0 (or π), the
    product is m to the last bits. Aligned axes define a ± c alone; a is then `keep`.
    """
    h = hypot(m[2], m[5])
    aligned = h <= ALIGNED
    if aligned:
        ca, sa = cos(keep), sin(keep)
        a = wrapped(keep)
    else:
        ca, sa = sign * m[2] / h, sign * m[5] / h
        a = atan2(sa, ca)
    b = atan2(ca * m[2] + sa * m[5], m[8])
    c = atan2(ca * m[3] - sa * m[0], ca * m[4] - sa * m[1])
    return a, b, wrapped(c), aligned


@njit
def shoulder_matrix(sp: float, cp: float, sf: float, cf: float, c: float, s: float) -> Nine:
    """Ry(ψp) Rz(ψ) Ry(φ) from sines and cosines of ψp, φ and ψ: R03 without θref."""
    return (
        cp * c * cf - sp * sf,
        -cp * s,
        cp * c * sf + sp * cf,
        s * cf,
        c,
        s * sf,
        -sp * c * cf - cp * sf,
        sp * s,
        -sp * c * sf + cp * cf,
    )


@njit
def seen_from_reach(rotation: FloatArray, sp: float, cp: float, cr: float, sr: float) -> Nine:
    """Bᵀ R: the hand in the frame of S and W."""
    x0, x1, x2 = rotation[0, 0], rotation[0, 1], rotation[0, 2]
    y0, y1, y2 = rotation[1, 0], rotation[1, 1], rotation[1, 2]
    z0, z1, z2 = rotation[2, 0], rotation[2, 1], rotation[2, 2]
    a0, a1, a2 = cr * x0 + sr * y0, cr * x1 + sr * y1, cr * x2 + sr * y2
    return (
        cp * a0 - sp * z0,
        cp * a1 - sp * z1,
        cp * a2 - sp * z2,
        cr * y0 - sr * x0,
        cr * y1 - sr * x1,
        cr * y2 - sr * x2,
        sp * a0 + cp * z0,
        sp * a1 + cp * z1,
        sp * a2 + cp * z2,
    )


@njit
def wrist_matrix(m: Nine, sb: float, cb: float, c: float, s: float) -> Nine:
    """Ry(β) Rz(-ψ) m from sines and cosines of β = θ4 - φ and ψ: R47 of m = Bᵀ R."""
    a0, a1, a2 = c * m[0] + s * m[3], c * m[1] + s * m[4], c * m[2] + s * m[5]
    return (
        cb * a0 + sb * m[6],
        cb * a1 + sb * m[7],
        cb * a2 + sb * m[8],
        c * m[3] - s * m[0],
        c * m[4] - s * m[1],
        c * m[5] - s * m[2],
        cb * m[6] - sb * a0,
        cb * m[7] - sb * a1,
        cb * m[8] - sb * a2,
    )


@njit
def redundant_kernel(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    arm_angle: float,
    branch: Three,
    keep: tuple[float, float],
    out: FloatArray,
) -> tuple[int, int]:
    """Joint angles (7,) of a pose, an arm angle and a branch: (status, singular).

    Args:
        rotation: of the pose ⁰T₇, (3, 3).
        position: of the pose ⁰T₇, (3,) [m].
        lengths: d1, d3, d5.
        arm_angle: ψ.
        branch: signs of θ2, θ4, θ6.
        keep: θ1 and θ5 to keep where they are not defined.
        out: filled, in (-π, π].
    """
    reach, sp, cp, cr, sr, singular = direction_kernel(position, lengths[0], keep[0])
    status, theta4, sf, cf, flag = elbow_kernel(reach, lengths, branch[1])
    if status != OK:
        return status, singular
    singular |= flag
    ref = atan2(sr, cr)
    c, s = cos(arm_angle), sin(arm_angle)
    m = shoulder_matrix(sp, cp, sf, cf, c, s)
    a, out[1], out[2], aligned = split_kernel(m, branch[0], keep[0] - ref)
    out[0], out[3] = wrapped(ref + a), theta4
    if aligned:
        singular |= SHOULDER
    beta_s, beta_c = sin(theta4) * cf - cos(theta4) * sf, cos(theta4) * cf + sin(theta4) * sf
    w = wrist_matrix(seen_from_reach(rotation, sp, cp, cr, sr), beta_s, beta_c, c, s)
    out[4], out[5], out[6], aligned = split_kernel(w, branch[2], keep[1])
    if aligned:
        singular |= WRIST
    if not isfinite(out[0] + out[1] + out[2] + out[4] + out[5] + out[6]):
        return NOT_FINITE, singular
    return OK, singular


@njit
def eight_kernel(
    rotation: FloatArray,
    position: FloatArray,
    lengths: Three,
    keep: tuple[float, float],
    out: FloatArray,
    singular: IntArray,
) -> int:
    """All solutions with θ3 = 0, the paper's decoupling: status; fills (8, 7) and flags (8,).

    θ1 = atan2(p_y, p_x) or half a turn on (errata D3); θ2 = s1 ψp + φ with φ of the sign of θ4
    (errata D4); wrist by the sign of θ6 (errata D5). Rows count s1, sign θ4, sign θ6, each + first.
    """
    reach, sp, cp, cr, sr, first = direction_kernel(position, lengths[0], keep[0])
    ref, lean = atan2(sr, cr), atan2(sp, cp)
    row = 0
    for s1 in (1.0, -1.0):
        # Behind: the same reach seen from a base half a turn on, where it leans the other way.
        m = seen_from_reach(rotation, s1 * sp, cp, s1 * cr, s1 * sr)
        for s4 in (1.0, -1.0):
            status, theta4, sf, cf, elbow = elbow_kernel(reach, lengths, s4)
            if status != OK:
                return status
            c4, s4_sine = cos(theta4), sin(theta4)
            w = wrist_matrix(m, s4_sine * cf - c4 * sf, c4 * cf + s4_sine * sf, 1.0, 0.0)
            theta2 = wrapped(s1 * lean + atan2(sf, cf))
            for s6 in (1.0, -1.0):
                out[row, 0] = ref if s1 > 0.0 else wrapped(ref + pi)
                out[row, 1], out[row, 2], out[row, 3] = theta2, 0.0, theta4
                out[row, 4], out[row, 5], out[row, 6], aligned = split_kernel(w, s6, keep[1])
                if not isfinite(out[row, 4] + out[row, 5] + out[row, 6]):
                    return NOT_FINITE
                singular[row] = first | elbow | (WRIST if aligned else 0)
                if abs(sin(theta2)) <= ALIGNED:
                    singular[row] |= SHOULDER
                row += 1
    return OK


@njit
def normal_kernel(q: FloatArray) -> Three:
    """Return the normal of the elbow plane, R03 y, in the base's axes."""
    c1, s1, c3, s3, c2, s2 = cos(q[0]), sin(q[0]), cos(q[2]), sin(q[2]), cos(q[1]), sin(q[1])
    return -c1 * c2 * s3 - s1 * c3, -s1 * c2 * s3 + c1 * c3, s2 * s3


@njit
def angle_of_normal(normal: Three, sp: float, cp: float, cr: float, sr: float) -> float:
    """Arm angle ψ at which the elbow plane has a normal, or the nearest to it: in (-π, π].

    The line SW by sine and cosine of ψp and θref; in B the normal is (-sin ψ, cos ψ, 0).
    """
    level = cr * normal[0] + sr * normal[1]
    return wrapped(atan2(sp * normal[2] - cp * level, cr * normal[1] - sr * normal[0]))


@njit
def arm_angle_kernel(q: FloatArray, lengths: Three, keep: float) -> tuple[float, int]:
    """Arm angle ψ of joint angles (7,), in (-π, π], and whether it has a zero: (ψ, singular).

    Between the normals of the elbow plane, R03 y, and of the vertical plane through S and W.
    """
    m: Nine = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    m = _turned_z(_turned_y(_turned_z(m, q[0]), q[1]), q[2])
    upper = (lengths[1] * m[2], lengths[1] * m[5], lengths[1] * m[8])
    m = _turned_y(m, -q[3])
    x = upper[0] + lengths[2] * m[2]
    y = upper[1] + lengths[2] * m[5]
    z = upper[2] + lengths[2] * m[8]
    aside = hypot(x, y)
    reach = hypot(aside, z)
    singular = ELBOW if abs(sin(q[3])) <= ALIGNED else 0
    if aside <= ALIGNED * reach:
        singular |= FIRST_AXIS
        sp, cp, cr, sr = 0.0, 1.0 if z >= 0.0 else -1.0, cos(keep), sin(keep)
    else:
        sp, cp, cr, sr = aside / reach, z / reach, x / aside, y / aside
    return angle_of_normal(normal_kernel(q), sp, cp, cr, sr), singular
