"""Closed-chain dynamics in the motor angles: M(q) q̈ + h(q, q̇) = τ, in closed form.

Two double pendulums (absolute link angles θ1, θ2 and θ1', θ2') joined at P3, with a point mass m3
there. Because P3 belongs to both arms, θ̇2 and θ̇2' are linear in q̇:

    θ̇2  = (a1/a2) [-s(2'-1) q̇1 + s(2'-1') q̇2] / s(2'-2)
    θ̇2' = (a1/a2) [ s(2-1) q̇1 -  s(2-1') q̇2] / s(2-2')

and M = Sᵀ M_w S + m3 JᵀJ, h = Sᵀ(M_w Ṡq̇ + h_w) + m3 Jᵀ J̇q̇ (docs/errata.md). The
links move in a horizontal plane: no gravity. The needle's own inertia is left out.

Both kernels take the pose (q1, q2, x, y), the lengths (a1, a2, base) and the lumped inertias
(`driven`, `passive`, `coupling`, `tool`) of `LumpedInertia.values`:

- `mass_matrix_kernel(q1, q2, x, y, a1, a2, base, driven, passive, coupling, tool)
  -> (m_left, m_cross, m_right)`
- `velocity_terms_kernel(q1, q2, v1, v2, x, y, a1, a2, base, driven, passive, coupling, tool)
  -> (h_left, h_right)`

They divide by s(2'-2): call them only where `jacobian_kernel` says `OK`.
"""

from math import cos, sin

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.geometry import Geometry
from app.mechanisms.inertia import LumpedInertia
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.kinematics import forward, pair
from app.mechanisms.pantograph.status import check


@njit
def _distal(
    q1: float, q2: float, x: float, y: float, a1: float, a2: float, base: float
) -> tuple[float, float, float, float]:
    # Unit vectors along the distal links, from elbow to tool.
    ux = (x - (a1 * cos(q1) - 0.5 * base)) / a2
    uy = (y - a1 * sin(q1)) / a2
    rx = (x - (a1 * cos(q2) + 0.5 * base)) / a2
    ry = (y - a1 * sin(q2)) / a2
    return ux, uy, rx, ry


@njit
def _rates(
    q1: float, q2: float, ux: float, uy: float, rx: float, ry: float, a1: float, a2: float
) -> tuple[float, float, float, float]:
    # dθ2/dq and dθ2'/dq: (left by q1, left by q2, right by q1, right by q2).
    c1, s1, c1r, s1r = cos(q1), sin(q1), cos(q2), sin(q2)
    gain = a1 / (a2 * (ry * ux - rx * uy))
    return (
        -gain * (ry * c1 - rx * s1),
        gain * (ry * c1r - rx * s1r),
        -gain * (uy * c1 - ux * s1),
        gain * (uy * c1r - ux * s1r),
    )


@njit
def mass_matrix_kernel(
    q1: float,
    q2: float,
    x: float,
    y: float,
    a1: float,
    a2: float,
    base: float,
    driven: float,
    passive: float,
    coupling: float,
    tool: float,
) -> tuple[float, float, float]:
    """Joint-space mass matrix [kg·m²]: (m_left, m_cross, m_right), symmetric positive definite."""
    ux, uy, rx, ry = _distal(q1, q2, x, y, a1, a2, base)
    ll, lr, rl, rr = _rates(q1, q2, ux, uy, rx, ry, a1, a2)
    left = coupling * (ux * cos(q1) + uy * sin(q1))
    right = coupling * (rx * cos(q2) + ry * sin(q2))
    # J = dP2/dq + a2 t2 dθ2/dq, with P2 on the left arm.
    jxl, jyl = -a1 * sin(q1) - a2 * uy * ll, a1 * cos(q1) + a2 * ux * ll
    jxr, jyr = -a2 * uy * lr, a2 * ux * lr
    m_left = driven + 2.0 * left * ll + passive * (ll * ll + rl * rl)
    m_right = driven + 2.0 * right * rr + passive * (lr * lr + rr * rr)
    m_cross = left * lr + right * rl + passive * (ll * lr + rl * rr)
    return (
        m_left + tool * (jxl * jxl + jyl * jyl),
        m_cross + tool * (jxl * jxr + jyl * jyr),
        m_right + tool * (jxr * jxr + jyr * jyr),
    )


@njit
def velocity_terms_kernel(
    q1: float,
    q2: float,
    v1: float,
    v2: float,
    x: float,
    y: float,
    a1: float,
    a2: float,
    base: float,
    driven: float,
    passive: float,
    coupling: float,
    tool: float,
) -> tuple[float, float]:
    """Centrifugal and Coriolis torques h(q, q̇) [N·m]: (h_left, h_right)."""
    c1, s1, c1r, s1r = cos(q1), sin(q1), cos(q2), sin(q2)
    ux, uy, rx, ry = _distal(q1, q2, x, y, a1, a2, base)
    ll, lr, rl, rr = _rates(q1, q2, ux, uy, rx, ry, a1, a2)
    w = ll * v1 + lr * v2
    wr = rl * v1 + rr * v2
    # Accelerations at q̈ = 0: P̈3 = k + a2 θ̈2 t2 = k' + a2 θ̈2' t2'.
    kx, ky = -a1 * v1 * v1 * c1 - a2 * w * w * ux, -a1 * v1 * v1 * s1 - a2 * w * w * uy
    krx, kry = -a1 * v2 * v2 * c1r - a2 * wr * wr * rx, -a1 * v2 * v2 * s1r - a2 * wr * wr * ry
    scale = 1.0 / (a2 * (ry * ux - rx * uy))
    alpha = scale * ((krx - kx) * rx + (kry - ky) * ry)
    alpha_r = -scale * ((kx - krx) * ux + (ky - kry) * uy)
    px, py = tool * (kx - a2 * alpha * uy), tool * (ky + a2 * alpha * ux)
    cosine, sine = coupling * (ux * c1 + uy * s1), coupling * (uy * c1 - ux * s1)
    cosine_r, sine_r = coupling * (rx * c1r + ry * s1r), coupling * (ry * c1r - rx * s1r)
    swing = passive * alpha + sine * v1 * v1
    swing_r = passive * alpha_r + sine_r * v2 * v2
    jxl, jyl = -a1 * s1 - a2 * uy * ll, a1 * c1 + a2 * ux * ll
    jxr, jyr = -a2 * uy * lr, a2 * ux * lr
    h_left = cosine * alpha - sine * w * w + ll * swing + rl * swing_r + jxl * px + jyl * py
    h_right = cosine_r * alpha_r - sine_r * wr * wr + lr * swing + rr * swing_r
    return h_left, h_right + jxr * px + jyr * py


def mass_matrix(geometry: Geometry, inertia: LumpedInertia, q: ArrayLike) -> FloatArray:
    """Mass matrix in the motor angles [kg·m²], shape (2, 2), at q [rad], shape (2,).

    Raises:
        MechanismError: where the pose does not exist or is singular.
    """
    q1, q2, x, y = _regular_pose(geometry, q)
    left, cross, right = mass_matrix_kernel(q1, q2, x, y, *geometry.links, *inertia.values)
    return np.array([[left, cross], [cross, right]])


def velocity_terms(
    geometry: Geometry, inertia: LumpedInertia, q: ArrayLike, qd: ArrayLike
) -> FloatArray:
    """Torques h(q, q̇) [N·m], shape (2,), at q [rad] and q̇ [rad/s], shapes (2,).

    Raises:
        MechanismError: where the pose does not exist or is singular.
    """
    q1, q2, x, y = _regular_pose(geometry, q)
    v1, v2 = pair(qd, "qd")
    links, lumps = geometry.links, inertia.values
    return np.array(velocity_terms_kernel(q1, q2, v1, v2, x, y, *links, *lumps))


def _regular_pose(geometry: Geometry, q: ArrayLike) -> tuple[float, float, float, float]:
    q1, q2 = pair(q, "q")
    x, y = forward(geometry, q).tolist()
    check(kernels.jacobian_kernel(q1, q2, x, y, *geometry.links)[0], f"pose q = ({q1}, {q2}) rad")
    return q1, q2, x, y
