"""Rib or bone: where a rigid layer begins, the needle stops.

A spring-damper (k, b) that only pushes, on the mass m that slides along the needle. The force of a
tick is the mean of what the mass would feel in one tick of h₀ from where it is and as fast as it
goes, so its coefficients are two constants, made when the scene is compiled:

    F = max(0, A x + B v),   x = depth beyond the surface, v the speed inwards.

Models. `exact`: with Φ = exp([[0, 1], [-k/m, -b/m]] h₀), A = -m Φ₂₁ / h₀, B = m (1 - Φ₂₂) / h₀.
`implicit`: linearly implicit Euler, A = k / N, B = (b + h₀ k) / N, N = 1 + h₀ b/m + h₀² k/m. Both
stay finite for any k, and k is capped at m / h₀², the stiffest that a tick can tell.

BONE_CONTACT is 1 while the tip is beyond the surface.

Energy: A x²/2 is stored; the damping part only takes, since it never makes the bone pull.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import numbered, packed
from app.simulation.along_needle import keep_memory, smoothed_speed, smoothing_of
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Contact of the tip with bone",
    "reads": ("depth", "plant_depth", "dt"),
    "writes": ("axial_force", "bone_contact"),
    "consumers": ("device axis axial", "simulated hand", "view force_gauge", "score"),
    "needs": ("bones",),
    "models": {
        "exact": "spring-damper on the sliding mass, exact over a tick",
        "implicit": "the same by linearly implicit Euler; a little softer",
    },
    "energy": ("potential", "stores A x²/2 beyond the surface; its damping only takes"),
    "cost_class": "A",
    "parameters": {
        "stiffness": (40e3, "N/m", 100.0, 5e5, "of the bone; capped at mass / tick²"),
        "damping": (10.0, "N·s/m", 0.0, 200.0, "of the contact"),
        "mass": (0.05, "kg", 0.005, 5.0, "that slides along the needle"),
        "tick": (0.001, "s", 0.0001, 0.005, "step that the force is made for"),
        "speed_smoothing": (0.03, "s", 0.0, 1.0, "time constant of a measured depth's speed"),
    },
}


class _BonePlaces(NamedTuple):
    """Depth of the surface [m], A [N/m], B [N·s/m]; then the depth before and its speed."""

    slot: int
    surface: int
    stiffness: int
    damping: int
    smoothing: int
    depth: int = 0
    speed: int = 0


_AT: Final = numbered(_BonePlaces)
_STRONGEST: Final = 50.0  # [N] far beyond any hand


def coefficients(
    model: str, stiffness: float, damping: float, mass: float, tick: float
) -> tuple[float, float]:
    """Return A [N/m] and B [N·s/m], see the top of the file; the stiffness is capped."""
    k, b = min(stiffness, mass / tick**2), damping
    if model == "implicit":
        n = 1.0 + tick * b / mass + tick * tick * k / mass
        return k / n, (b + tick * k) / n
    from scipy.linalg import expm  # 0.2 s to import, and only where there is bone

    transition = expm(np.array([[0.0, 1.0], [-k / mass, -b / mass]]) * tick)
    return -mass * transition[1, 0] / tick, mass * (1.0 - transition[1, 1]) / tick


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: needle at rest, outside."""
    surface = np.inf
    depth = 0.0
    for layer in binding.scene.layers:
        surface = min(surface, depth) if layer.rigid else surface
        depth += layer.thickness
    given = (values[name] for name in ("stiffness", "damping", "mass", "tick"))
    stiffness, damping = coefficients(binding.model, *given)
    return packed(
        _AT,
        slot=binding.depth_slot,
        surface=surface,
        stiffness=stiffness,
        damping=damping,
        smoothing=smoothing_of(binding, values["speed_smoothing"]),
        depth=np.nan,
    )


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model from where the tip is."""
    keep_memory(_AT, old, new)


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the force of the bone to AXIAL_FORCE; write BONE_CONTACT."""
    depth, p = state[int(parameters[_AT.slot])], parameters
    if not np.isfinite(depth):
        depth = p[_AT.depth]
    if np.isnan(depth):
        return
    if np.isnan(p[_AT.depth]):
        p[_AT.depth] = depth
    travel = depth - p[_AT.depth]
    p[_AT.depth] = depth
    p[_AT.speed] = smoothed_speed(p[_AT.speed], travel, state[sv.DT], p[_AT.smoothing])
    beyond = depth - p[_AT.surface]
    if beyond <= 0.0:
        return
    force = p[_AT.stiffness] * beyond + p[_AT.damping] * p[_AT.speed]
    state[sv.AXIAL_FORCE] += min(max(force, 0.0), _STRONGEST)
    state[sv.BONE_CONTACT] = 1.0


def axial_energy_bound(parameters: FloatArray) -> float:
    """Return the most that it can hold [J]: pushed with more than any hand has."""
    return float(0.5 * _STRONGEST**2 / parameters[_AT.stiffness])
