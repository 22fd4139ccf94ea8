"""Friction of the tissue along the inserted shaft: Dahl with Stribeck level, plus viscous.

Per inserted length [N/m]: kinetic level C, break-away level D, viscous b (values of the layers,
Okamura, Simone, O'Leary 2004). With lengths L_i in the layers and speed v,

    g(v) = Σ L_i (C_i + (D_i - C_i) exp(-(v / v_s)²)),   F = f + Σ L_i b_i v,

f follows Dahl's df/dx = σ (1 - f sgn(v) / g) with σ = s Σ L_i, s the presliding stiffness per
length. Over a displacement Δx at constant g the solution is exact at any step:

    f ← g sgn(Δx) + (f - g sgn(Δx)) exp(-σ |Δx| / g),

so |f| <= g always and no step size, stiffness or speed makes it unstable (explicit Euler diverges
for |v| > 2 g / (σ T)). It integrates over space, so a needle at rest holds its force and does not
creep, and a depth that flickers by one count moves f by at most σ times that count.

Energy: dissipative but for the presliding spring, which gives back at most g²/(2σ).
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Friction of the tissue along the inserted shaft",
    "reads": ("depth", "dt"),
    "writes": ("axial_force",),
    "consumers": ("device axis axial", "simulated hand", "view force_gauge"),
    "needs": ("layers",),
    "models": {"dahl": "Dahl with Stribeck level, exponential update exact at any step"},
    "energy": ("dissipative", "the presliding spring returns at most g²/(2σ) of what it took"),
    "cost_class": "A",
    "parameters": {
        "presliding_stiffness": (
            1e5,
            "N/m²",
            1.0,
            1e9,
            "before sliding, per inserted length",
        ),
        "stribeck_speed": (
            0.002,
            "m/s",
            1e-5,
            1.0,
            "at which break-away has fallen to kinetic",
        ),
        "speed_smoothing": (
            0.03,
            "s",
            0.0,
            1.0,
            "time constant of a measured depth's speed",
        ),
    },
}


class _FrictionPlaces(NamedTuple):
    """Constants, how many layers follow, and what is known from the tick before."""

    slot: int
    presliding: int
    stribeck: int
    smoothing: int
    layers: int
    depth: int = 0
    speed: int = 0
    force: int = 0


class _LayerPlaces(NamedTuple):
    """A layer: depth of its end [m], kinetic and break-away level, viscous friction."""

    end: int
    kinetic: int
    static: int
    viscous: int


_AT: Final = numbered(_FrictionPlaces)
_LAYER: Final = numbered(_LayerPlaces)
_FASTEST: Final = 10.0  # [m/s]; faster is a jump of the measurement
_SNAP: Final = 1e-12  # below this a decaying value becomes 0: subnormal numbers cost 20 times more


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh parameters array: needle at rest.

    The true depth of a simulated needle is differenced as it is; a measured depth comes in steps
    of a camera frame, so its speed is smoothed over `speed_smoothing`.
    """
    simulated = binding.depth_slot == sv.PLANT_DEPTH
    smoothing = 0.0 if simulated else values["speed_smoothing"]
    layers = []
    ends = np.cumsum([layer.thickness for layer in binding.scene.layers])
    for end, layer in zip(ends, binding.scene.layers, strict=True):
        static = max(layer.static_friction, layer.friction)
        layers.append((end, layer.friction, static, layer.viscous_friction))
    return packed(
        _AT,
        np.ravel(layers),
        slot=binding.depth_slot,
        presliding=values["presliding_stiffness"],
        stribeck=values["stribeck_speed"],
        smoothing=smoothing,
        layers=len(ends),
        depth=np.nan,
    )


@njit
def _level(p: FloatArray, depth: float, speed: float) -> tuple[float, float, float]:
    """Return inserted length [m], friction level g [N] and viscous coefficient [N·s/m]."""
    inserted = 0.0
    level = 0.0
    viscous = 0.0
    ratio = speed / p[_AT.stribeck]
    stribeck = np.exp(-ratio * ratio)
    for i in range(int(p[_AT.layers])):
        at = len(_AT) + len(_LAYER) * i
        length = min(p[at + _LAYER.end], depth) - inserted
        if length > 0.0:
            kinetic, static = p[at + _LAYER.kinetic], p[at + _LAYER.static]
            level += length * (kinetic + (static - kinetic) * stribeck)
            viscous += length * p[at + _LAYER.viscous]
            inserted += length
    return inserted, level, viscous


@njit
def dahl(force: float, travel: float, level: float, stiffness: float) -> float:
    """Friction force after `travel` [m] at constant level: exact, |result| <= level."""
    if level <= 0.0:
        return 0.0
    force = min(max(force, -level), level)  # the level may have fallen since the last step
    if travel == 0.0:
        return force
    end = level if travel > 0.0 else -level
    return end + (force - end) * np.exp(-stiffness * abs(travel) / level)


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the friction to AXIAL_FORCE; it opposes the motion (positive pushes the tip out)."""
    depth = state[int(parameters[_AT.slot])]
    dt = state[sv.DT]
    if not np.isfinite(depth):
        return
    if np.isnan(parameters[_AT.depth]):  # the first tick has no travel yet
        parameters[_AT.depth] = depth
    travel = depth - parameters[_AT.depth]
    parameters[_AT.depth] = depth
    if dt > 0.0:
        smoothing = parameters[_AT.smoothing]
        keep = np.exp(-dt / smoothing) if smoothing > 0.0 else 0.0
        now = min(max(travel / dt, -_FASTEST), _FASTEST)
        speed = keep * parameters[_AT.speed] + (1.0 - keep) * now
        parameters[_AT.speed] = speed if abs(speed) > _SNAP else 0.0
    inserted, level, viscous = _level(parameters, depth, parameters[_AT.speed])
    force = dahl(parameters[_AT.force], travel, level, parameters[_AT.presliding] * inserted)
    parameters[_AT.force] = force if abs(force) > _SNAP else 0.0
    state[sv.AXIAL_FORCE] += parameters[_AT.force] + viscous * parameters[_AT.speed]
