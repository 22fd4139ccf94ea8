"""The robot's motion as its tool point sees it."""

from typing import Final

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms import dynamic_model as dm
from app.mechanisms.pantograph.differential import jacobian_rate_kernel
from app.mechanisms.pantograph.dynamics import dynamics_kernel

_SMALLEST_PIVOT: Final = 0.02
"""|det J| over the sum of J's squares below which the inverse of J fades out."""


@njit
def velocity_torques(state: FloatArray, p: FloatArray, first: int) -> tuple[float, float]:
    """Torques h - M J⁻¹ J̇ q̇ [N·m]: added to Jᵀ γ, the tool point moves by Λ a = γ.

    Λ = (J M⁻¹ Jᵀ)⁻¹ (Khatib 1987). Where J loses its inverse (arms in line) that fades out: the
    answer is bounded and continuous. The dynamic model stands at p[first:].
    """
    q1, q2, v1, v2 = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.QD_LEFT], state[sv.QD_RIGHT]
    x, y, depth = state[sv.P3_X], state[sv.P3_Y], state[sv.DEPTH]
    m11, m12, m22, h1, h2, _, _ = dynamics_kernel(q1, q2, v1, v2, x, y, depth, 0.0, p, first)
    a1, a2, base = p[first + dm.A1], p[first + dm.A2], p[first + dm.BASE]
    _, rxl, rxr, ryl, ryr = jacobian_rate_kernel(q1, q2, v1, v2, x, y, a1, a2, base)
    ax, ay = rxl * v1 + rxr * v2, ryl * v1 + ryr * v2
    jxl, jxr, jyl, jyr = state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR]
    det = jxl * jyr - jxr * jyl
    pivot = _SMALLEST_PIVOT * (jxl * jxl + jxr * jxr + jyl * jyl + jyr * jyr)
    square = max(det * det, pivot * pivot)
    inverse = det / square if square > 0.0 else 0.0
    b1, b2 = inverse * (jyr * ax - jxr * ay), inverse * (jxl * ay - jyl * ax)
    return h1 - m11 * b1 - m12 * b2, h2 - m12 * b1 - m22 * b2
