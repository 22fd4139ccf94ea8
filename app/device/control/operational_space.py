"""The robot's motion as its tool point sees it."""

from typing import Final

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit

_SMALLEST_PIVOT: Final = 0.02
"""|det J| over the sum of J's squares below which the inverse of J fades out."""


@njit
def velocity_torques(state: FloatArray) -> tuple[float, float]:
    """Torques h - M J⁻¹ J̇ q̇ [N·m]: added to Jᵀ γ, the tool point moves by Λ a = γ.

    Λ = (J M⁻¹ Jᵀ)⁻¹ (Khatib 1987). Where J loses its inverse (arms in line) that fades out: the
    answer is bounded and continuous. A law that calls this reads `mass`, `bias` and `drift`.
    """
    m11, m12, m22 = state[sv.MASS_LEFT], state[sv.MASS_CROSS], state[sv.MASS_RIGHT]
    h1, h2 = state[sv.BIAS_LEFT], state[sv.BIAS_RIGHT]
    ax, ay = state[sv.DRIFT_X], state[sv.DRIFT_Y]
    jxl, jxr, jyl, jyr = state[sv.J_XL], state[sv.J_XR], state[sv.J_YL], state[sv.J_YR]
    det = jxl * jyr - jxr * jyl
    pivot = _SMALLEST_PIVOT * (jxl * jxl + jxr * jxr + jyl * jyl + jyr * jyr)
    square = max(det * det, pivot * pivot)
    inverse = det / square if square > 0.0 else 0.0
    b1, b2 = inverse * (jyr * ax - jxr * ay), inverse * (jxl * ay - jyl * ax)
    return h1 - m11 * b1 - m12 * b2, h2 - m12 * b1 - m22 * b2
