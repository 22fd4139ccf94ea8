"""Relaxation: tissue that is dimpled quickly resists more at first, then gives way in its time.

A standard linear solid: beside the spring of the membrane (effect `puncture`) stands a spring K in
series with a damper. e is the stretch of that spring, x the indentation, τ the layer's time:

    de/dt = dx/dt - e / τ,   F = K e,   never pulling: e >= 0.

With the share s of a quick push's force that relaxes, K = K_m s / (1 - s); K_m is the membrane's
own mean stiffness up to its puncture.

Models. `exact`: the solution for an x that goes straight from tick to tick,

    e ← e E + (Δx / h) τ (1 - E),   E = exp(-h / τ),

whatever the step. `midpoint`: the implicit midpoint rule, e ← ((1 - h/2τ) e + Δx) / (1 + h/2τ),
without an exponential; at the loop's own step both are the same to 1e-6.

Energy: K e²/2 is stored, the damper only takes; a puncture loses what was stored.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.simulation.along_needle import GAUGE_18, SNAP, keep_memory, layer_at, layer_rows
from app.simulation.scene import Binding, TissueLayer

DECLARATION: Final[dict[str, Any]] = {
    "title": "Relaxation of dimpled tissue",
    "reads": ("depth", "plant_depth", "dt", "indentation"),
    "writes": ("axial_force",),
    "consumers": ("device axis axial", "simulated hand", "view force_gauge", "dimpling"),
    "needs": ("membranes", "needle"),
    "models": {
        "exact": "standard linear solid, exact for a motion that is straight between ticks",
        "midpoint": "the same by the implicit midpoint rule",
    },
    "energy": ("potential", "stores K e²/2 in its spring; its damper and a puncture only take"),
    "cost_class": "A",
    "parameters": {
        "share_scale": (1.0, "-", 0.0, 1.0, "factor on the share that relaxes, of every layer"),
        "time_scale": (1.0, "-", 0.01, 100.0, "factor on the time constant of every layer"),
    },
    "published": {
        "time_scale": (
            0.1,
            4.0,
            "0.05 to 2 s for layers of 0.5 s: soft tissue, this project's table",
        ),
    },
}


class _RelaxationPlaces(NamedTuple):
    """Constants, how many layers follow; indentation before [m], stretch [m], its spring [N/m]."""

    slot: int
    midpoint: int
    layers: int
    indentation: int = 0
    stretch: int = 0
    stiffness: int = 0


_AT: Final = numbered(_RelaxationPlaces)
_ROW: Final = 4  # depth of its end [m], K [N/m], τ [s], how far it is pushed in at most [m]
_TOUCH: Final = 1e-9  # [m] a membrane's own depth counts to its layer


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: tissue at rest."""
    rows = layer_rows(binding, "thickness", "relaxation_time", "thickness")
    diameter = binding.scene.needle.outer_diameter / GAUGE_18
    for row, layer in zip(rows, binding.scene.layers, strict=True):
        share = values["share_scale"] * layer.relaxation_share
        row[1] = mean_stiffness(layer, diameter) * share / (1.0 - share)
        row[2] *= values["time_scale"]
        row[3] = layer.indentation(diameter * layer.puncture_force) if row[1] > 0.0 else 0.0
    return packed(
        _AT,
        rows.ravel(),
        slot=binding.depth_slot,
        midpoint=float(binding.model == "midpoint"),
        layers=len(rows),
    )


def mean_stiffness(layer: TissueLayer, diameter: float) -> float:
    """Force over depth of a layer's dimple when it is punctured [N/m]; 0 without a membrane.

    Args:
        layer: the layer.
        diameter: of the needle, in diameters of 18 G.
    """
    force = diameter * layer.puncture_force
    return force / layer.indentation(force) if force > 0.0 else 0.0


@njit
def exact(stretch: float, change: float, h: float, tau: float) -> float:
    """Stretch of the spring after x changed by `change` at a steady speed within h."""
    if h <= 0.0:
        return stretch + change
    return stretch * np.exp(-h / tau) - change * tau / h * np.expm1(-h / tau)


@njit
def midpoint(stretch: float, change: float, h: float, tau: float) -> float:
    """Return the same by the implicit midpoint rule."""
    half = 0.5 * h / tau
    return ((1.0 - half) * stretch + change) / (1.0 + half)


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model from the same stretch."""
    keep_memory(_AT, old, new)


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the force that relaxes to AXIAL_FORCE."""
    depth, x, p = state[int(parameters[_AT.slot])], state[sv.INDENTATION], parameters
    if not np.isfinite(depth + x):
        return
    h = min(state[sv.DT], 1.0) if state[sv.DT] > 0.0 else 0.0  # not for NaN
    change = x - p[_AT.indentation]
    p[_AT.indentation] = x
    at = layer_at(p, len(_AT), _ROW, int(p[_AT.layers]), depth - x + _TOUCH)
    if p[_AT.stretch] == 0.0:
        p[_AT.stiffness] = p[at + 1]
    tau = p[at + 2]
    if p[_AT.midpoint] > 0.0:
        stretch = midpoint(p[_AT.stretch], change, h, tau)
    else:
        stretch = exact(p[_AT.stretch], change, h, tau)
    stretch = min(stretch, x)  # the damper never pushes the dimple
    p[_AT.stretch] = stretch if stretch > SNAP else 0.0
    state[sv.AXIAL_FORCE] += p[_AT.stiffness] * p[_AT.stretch]


def stored_energy(parameters: FloatArray) -> float:
    """Return what the spring holds [J]."""
    return float(0.5 * parameters[_AT.stiffness] * parameters[_AT.stretch] ** 2)


def axial_energy_bound(parameters: FloatArray) -> float:
    """Return the most that the spring can hold [J]: a dimple made in no time."""
    rows = parameters[len(_AT) :].reshape(-1, _ROW)
    return float((0.5 * rows[:, 1] * rows[:, 3] ** 2).max())
