"""Direct kinematics as the paper solves it: equation 4 by iteration, for comparison.

The three equations t·a1 = cos θ1, t·a2 = cos θ2, |t|² = 1 have two solutions and their Jacobian
has determinant 2 t·(a1 × a2): an iteration needs a start on the right side, loses half the digits
where the two meet, and says nothing of which it found. `kernels.forward_kernel` is what is used.
"""

from math import cos, isfinite

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import root

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.mechanisms.errors import MechanismError, UnreachableError
from app.mechanisms.status import NOT_FINITE, OK, SINGULAR, UNREACHABLE
from app.mechanisms.tensegrity.geometry import TensegrityGeometry
from app.mechanisms.tensegrity.kernels import opening_kernel

_MOST_STEPS = 50


@njit
def newton_kernel(
    b1: float,
    b2: float,
    tx: float,
    ty: float,
    tz: float,
    residual: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
) -> tuple[int, float, float, float, int]:
    """Newton's method on equation 4 from the start t: (status, tx, ty, tz, steps).

    Ends when no equation is off by more than `residual`; `SINGULAR` where t·(a1 × a2) = 0 on the
    way, `UNREACHABLE` after 50 steps. It stays on the side of the start, mostly.
    """
    if not isfinite(b1 + b2 + tx + ty + tz):
        return NOT_FINITE, 0.0, 0.0, 0.0, 0
    _, k1, _, _ = opening_kernel(b1, gain1, fold)
    _, k2, _, _ = opening_kernel(b2, gain2, fold)
    for step in range(_MOST_STEPS):
        e1 = tx * c10 + tz * s10 - k1
        e2 = ty * c20 + tz * s20 - k2
        e3 = 0.5 * (tx * tx + ty * ty + tz * tz - 1.0)
        if max(abs(e1), max(abs(e2), abs(e3))) <= residual:
            return OK, tx, ty, tz, step
        height = (tz * c10 - tx * s10) * c20 - ty * c10 * s20
        if height == 0.0:
            return SINGULAR, 0.0, 0.0, 0.0, step
        e1, e2, e3 = e1 / height, e2 / height, e3 / height
        dx = e1 * (c20 * tz - s20 * ty) + e2 * ty * s10 - e3 * s10 * c20
        dy = e1 * s20 * tx + e2 * (tz * c10 - tx * s10) - e3 * c10 * s20
        dz = -e1 * c20 * tx - e2 * ty * c10 + e3 * c10 * c20
        tx, ty, tz = tx - dx, ty - dy, tz - dz
    return UNREACHABLE, 0.0, 0.0, 0.0, _MOST_STEPS


def forward_by_root(
    geometry: TensegrityGeometry, beta: ArrayLike, start: ArrayLike = (0.0, 0.0, 1.0)
) -> FloatArray:
    """Direction t, shape (3,), of β [rad], shape (2,), by `scipy.optimize.root` from a start.

    Which of the two solutions comes out depends on the start: compare t·(a1 × a2).

    Raises:
        UnreachableError: if the iteration does not converge.
        MechanismError: if β has another shape.
    """
    b = np.asarray(beta, dtype=np.float64)
    if b.shape != (2,):
        raise MechanismError(sentence("beta has shape {b_shape}; (2,) is needed", b_shape=b.shape))
    (gain1, gain2, fold), (a1, a2) = geometry.bars[:3], geometry.bases
    opened = (
        float(2.0 * fold * np.arctan(g * cos(0.5 * v)))
        for g, v in zip((gain1, gain2), b, strict=True)
    )
    k1, k2 = (cos(theta) for theta in opened)

    def off(t: FloatArray) -> list[float]:
        return [float(t @ a1) - k1, float(t @ a2) - k2, float(t @ t) - 1.0]

    found = root(off, np.asarray(start, dtype=np.float64), tol=1e-14)
    if not np.abs(found.fun).max() < 1e-9:
        raise UnreachableError(
            sentence(
                "unreachable: no direction for β = {b} rad after {evaluations} evaluations",
                b=b.tolist(),
                evaluations=found.nfev,
            )
        )
    return np.asarray(found.x, dtype=np.float64)
