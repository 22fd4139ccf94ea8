"""How fast the needle can turn: what torques can do to it, and what the encoders prove of it.

Everything here is about the *turning* of the needle, rad/s of its direction d, because that is what
joints and encoders know: |ḋ| = |v_hub| / L_out, whatever L_out is. The lever enters only where a
speed of the hub is promised (`governor`). The kinetic energy of the free mechanism is

    T = ½ q̇ᵀ M0(q) q̇ + ½ (I + m s²) |ḋ|²,    s = centre of the needle beyond the fulcrum,

links and tool plus a needle that turns about the fulcrum like a rod. With R = dd/dq, shape (3, 2),
and the Gram matrix G = RᵀR of the turnings per joint it is one inertia, M = M0 + (I + m s²) G, and
1/λ of M0⁻¹ G are the least and the greatest inertia against turning, Θ [kg·m²], of links and tool.

An inertia that is known to a factor 0.7 to 1.3, part by part, is a matrix between 0.7 M and 1.3 M.
So the needle's turning gains at most √(τᵀM⁻¹τ / (Θ_least + I + m s²)) / 0.7: the norm of R M⁻¹ τ
is at most √λmax(R M⁻¹ Rᵀ) times √(τᵀM⁻¹τ), and both fall as M grows. And driven by τ = Rᵀf to a
turning w it holds at most ½ 1.3 w² |f|² / (τᵀM⁻¹τ): T = ½ t² τᵀM⁻¹τ, w = t |R M⁻¹τ|, and f·R M⁻¹τ
is τᵀM⁻¹τ, which is at most |f| |R M⁻¹τ|. Both are met by some robot within those factors.

A depth known to an interval: a hub speed L_out |ḋ| is the greatest where the needle is drawn out
furthest, although its inertia is greater there, as long as (with c the centre's distance from the
hub, L_out = c - s) d/ds [(c - s) / (K + m s²)] < 0, that is m s² + 2 m c |s| < K = Θ_least + I at
that end; at s > 0 it always is. Where it is not, the needle's inertia is taken at its least in the
interval, and the lever at its longest: together worse than any depth. The power of a bound in the
acceleration is between 0 and 1, for which the same condition is enough.

Pure functions; `governor` decides by them.
"""

from math import isfinite, sqrt
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.parameters import numbered
from app.device.control.vectors import norm_kernel
from app.mechanisms.lever import hub_velocity_kernel

LIGHTEST: Final = 0.7
"""Least share of the profile's inertias that a bound must hold for."""
HEAVIEST: Final = 1.3
"""Greatest share."""


class BodyPlaces(NamedTuple):
    """The needle: mass [kg], inertia [kg·m²], its centre and its tip from the hub [m]."""

    needle_mass: int
    needle_inertia: int
    needle_centre: int
    needle_length: int


BODY: Final = numbered(BodyPlaces)
"""First entries of the governor's parameters."""

_SIDEWAYS = 0.1  # cosine to the force below which a motion counts less and less
_SHORT = 6  # every window up to this is looked at, then every fourth

Turning = tuple[float, float, float, float, float, float, float, float]
"""Largest acceleration of the needle's turning [rad/s²]; its turning in the direction of the
nominal acceleration per angle of each joint [-]; Gram matrix (ll, lr, rr) of the turnings per joint
[-]; the profile's least inertia against turning, in any direction, and the greatest that its
energy has under these torques, without any that of the heaviest direction [kg·m²]."""


@njit
def needle_inertia(s: float, p: FloatArray) -> float:
    """Inertia of the needle about the fulcrum [kg·m²], its centre `s` [m] beyond it."""
    return p[BODY.needle_inertia] + p[BODY.needle_mass] * s * s


@njit
def needle_inertias(
    shallow: float, deep: float, links: float, p: FloatArray
) -> tuple[float, float]:
    """Inertia of the needle for acceleration and for energy [kg·m²] over an interval of depths.

    Args:
        shallow: least depth of the tip that is possible [m].
        deep: greatest depth [m].
        links: least inertia of links and tool against turning [kg·m²].
        p: see `BODY`.
    """
    centre = p[BODY.needle_centre]
    first = shallow + centre - p[BODY.needle_length]
    last = deep + centre - p[BODY.needle_length]
    most = max(needle_inertia(first, p), needle_inertia(last, p))
    out = -first
    growth = p[BODY.needle_mass] * (out * out + 2.0 * centre * out)
    if first >= 0.0 or growth <= links + p[BODY.needle_inertia]:
        return needle_inertia(first, p), most
    return needle_inertia(min(last, 0.0), p), most


@njit
def _unknown() -> Turning:
    return np.inf, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, np.inf


@njit
def turning(
    state: FloatArray, p: FloatArray, left: float, right: float, shallow: float, deep: float
) -> Turning:
    """Bound what two torques can do to the free needle, for every inertia and depth possible.

    Size 0 where there is no acceleration; a size of infinity where it cannot be told.

    Args:
        state: pose of the mechanism, see `core.state_vector`.
        p: see `BODY`.
        left: torque of the left motor [N·m].
        right: likewise of the right motor.
        shallow: least depth of the tip that is possible [m].
        deep: greatest depth [m].
    """
    m11, m12, m22 = state[sv.INERTIA_LEFT], state[sv.INERTIA_CROSS], state[sv.INERTIA_RIGHT]
    dx, dy, dz, l_in = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z], state[sv.L_IN]
    lx, ly, lz = hub_velocity_kernel(state[sv.J_XL], state[sv.J_YL], dx, dy, dz, l_in, 1.0)
    rx, ry, rz = hub_velocity_kernel(state[sv.J_XR], state[sv.J_YR], dx, dy, dz, l_in, 1.0)
    ll, lr, rr = (
        lx * lx + ly * ly + lz * lz,
        lx * rx + ly * ry + lz * rz,
        rx * rx + ry * ry + rz * rz,
    )
    half = 0.5 * (m22 * ll - 2.0 * m12 * lr + m11 * rr)
    product = (ll * rr - lr * lr) * (m11 * m22 - m12 * m12)
    root = half + sqrt(max(half * half - product, 0.0))  # determinant of M0 times the larger λ
    determinant = m11 * m22 - m12 * m12
    if not (determinant > 0.0 and root > 0.0 and isfinite(root)):
        return _unknown()
    least, most = determinant / root, determinant * root / product if product > 0.0 else np.inf
    light, heavy = needle_inertias(shallow, deep, least, p)
    m11, m12, m22 = m11 + light * ll, m12 + light * lr, m22 + light * rr
    determinant = m11 * m22 - m12 * m12
    q1, q2 = (m22 * left - m12 * right) / determinant, (m11 * right - m12 * left) / determinant
    ax, ay, az = lx * q1 + rx * q2, ly * q1 + ry * q2, lz * q1 + rz * q2
    nominal = norm_kernel(ax, ay, az)
    size = sqrt(max(left * q1 + right * q2, 0.0) / (least + light)) / LIGHTEST
    w11, w12, w22 = (
        m11 + (heavy - light) * ll,
        m12 + (heavy - light) * lr,
        m22 + (heavy - light) * rr,
    )
    work = (w22 * left * left - 2.0 * w12 * left * right + w11 * right * right) / (
        w11 * w22 - w12 * w12
    )
    square = (rr * left * left - 2.0 * lr * left * right + ll * right * right) / (ll * rr - lr * lr)
    if not isfinite(size + nominal + heavy):
        return _unknown()
    if not nominal > 1e-9:
        return 0.0, 0.0, 0.0, ll, lr, rr, least + light, most + heavy
    ax, ay, az = ax / nominal, ay / nominal, az / nominal
    return (
        size,
        ax * lx + ay * ly + az * lz,
        ax * rx + ay * ry + az * rz,
        ll,
        lr,
        rr,
        least + light,
        min(square / work, most + heavy),
    )


@njit
def counted(along: float, size: float) -> float:
    """Travel that counts: its `size` where it goes with the force, `along` where against it.

    `along` is its part in the direction of the force's acceleration; continuous in both.
    """
    if along <= 0.0:
        return along
    return min(along / _SIDEWAYS, size)


@njit
def speed_bounds(
    ring: FloatArray,
    head: int,
    samples: int,
    along_left: float,
    along_right: float,
    ll: float,
    lr: float,
    rr: float,
    count: float,
) -> tuple[float, float]:
    """Bounds of the needle's counted turning now [rad/s]: (at least, at most).

    Args:
        ring: rows (q_left, q_right, time, largest acceleration sent after it), flat.
        head: row of the newest reading.
        samples: rows that hold readings.
        along_left: turning of the needle along the force per angle of the left joint [-].
        along_right: likewise of the right joint.
        ll: Gram matrix of its turnings per joint angle, left with left [-].
        lr: left with right.
        rr: right with right.
        count: one encoder count [rad].
    """
    rows = len(ring) // 4
    newest = 4 * head
    doubt = count * sqrt(ll + rr + 2.0 * abs(lr))
    least, most = -np.inf, np.inf
    gained, moment = 0.0, 0.0  # ∫ a dt, ∫ a (t - t_start) dt over the window
    end = ring[newest + 2]
    later = end
    row = newest
    for k in range(1, samples):
        row = row - 4 if row > 0 else 4 * (rows - 1)
        step = later - ring[row + 2]
        later = ring[row + 2]
        moment += step * gained + 0.5 * ring[row + 3] * step * step
        gained += ring[row + 3] * step
        width = end - later
        if (k > _SHORT and k & 3 != 3) or not width > 0.0:
            continue
        left, right = ring[newest] - ring[row], ring[newest + 1] - ring[row + 1]
        size = sqrt(max(ll * left * left + 2.0 * lr * left * right + rr * right * right, 0.0))
        travel = counted(along_left * left + along_right * right, size)
        least = max(least, (travel - doubt) / width)
        most = min(most, (travel + doubt + moment) / width)
    return least, most


@njit
def stoppable(room: float, doubt: float, step: float) -> float:
    """Largest acceleration a [rad/s²] with 2 √(doubt a) + a step <= room [rad/s]."""
    root = (sqrt(doubt + step * max(room, 0.0)) - sqrt(doubt)) / step
    return root * root
