"""One degree of freedom: mass and damper under a sampled spring-damper with delay, exactly.

m v' = -b v + F with F held over a tick, F_k = -K x_{k-d} - B (x_{k-d} - x_{k-d-1})/T. The sampled
system is linear; it is stable where the spectral radius of its matrix is below one.
"""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.mechanisms.pantograph import inverse, jacobian
from app.mechanisms.pantograph.dynamics import dynamic_terms
from app.mechanisms.profile import DeviceProfile


@dataclass(frozen=True, slots=True)
class Reduction:
    """What the tool point feels like along one direction: mass [kg] and viscous damping [N·s/m]."""

    mass: float
    damping: float


def reductions(profile: DeviceProfile, depth: float) -> tuple[Reduction, Reduction]:
    """Mass and damping of P3 along x and y, needle vertical: Λ = (J M⁻¹ Jᵀ)⁻¹, J⁻ᵀ b J⁻¹.

    There the mechanism is symmetric, so that x and y do not couple.
    """
    geometry = profile.pantograph
    q = inverse(geometry, geometry.fulcrum[:2])
    j = jacobian(geometry, q)
    mass = dynamic_terms(profile.dynamic_model, q, (0.0, 0.0), depth).mass
    felt = np.linalg.inv(j @ np.linalg.inv(mass) @ j.T)
    back = np.linalg.inv(j)
    damping = profile.friction.viscous * back.T @ back
    along_x, along_y = (Reduction(float(felt[k, k]), float(damping[k, k])) for k in (0, 1))
    return along_x, along_y


def spectral_radius(
    model: Reduction, stiffness: FloatArray, damping: FloatArray, step: float, delay: int
) -> FloatArray:
    """Spectral radius over arrays of K [N/m] and B [N·s/m], both (n,), for a tick T = `step` [s]
    and a delay of whole ticks; (n,).
    """
    rate = model.damping / model.mass
    if rate * step > 1e-9:
        hold = -np.expm1(-rate * step) / rate
        speed, drift = hold / model.mass, (step - hold) / rate / model.mass
    else:
        hold, speed, drift = step, step / model.mass, 0.5 * step**2 / model.mass
    size = delay + 3  # x, v, then x of the ticks before
    a = np.zeros((len(stiffness), size, size))
    a[:, 0, 0], a[:, 0, 1], a[:, 1, 1] = 1.0, hold, 1.0 - rate * hold
    newest = 0 if delay == 0 else delay + 1
    for column, gain in (
        (newest, stiffness + damping / step),
        (delay + 2, -damping / step),
    ):
        a[:, 0, column] -= drift * gain
        a[:, 1, column] -= speed * gain
    a[:, 2, 0] = 1.0
    for row in range(3, size):
        a[:, row, row - 1] = 1.0
    return np.asarray(np.abs(np.linalg.eigvals(a)).max(axis=1))


def colgate(damping: float, virtual: FloatArray, step: float) -> FloatArray:
    """Largest K [N/m] by Colgate and Schenkel (1997): passive if b > K T/2 + |B|; (n,) of B."""
    return np.asarray(np.maximum(2.0 * (damping - np.abs(virtual)) / step, 0.0))


def delayed(damping: float, virtual: FloatArray, step: float, delay: int) -> FloatArray:
    """Largest K [N/m] of the free device with delay: K < (b + B)/(T/2 + t_d), small B and K."""
    return np.asarray((damping + virtual) / (0.5 * step + delay * step))
