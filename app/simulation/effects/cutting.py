"""Cutting: advancing into fresh tissue costs its fracture toughness times the width of the cut.

With J [J/m²] of the layer at the tip and the outer diameter as the width,

    F = J · OD   while the tip advances in the tissue, nothing while it is withdrawn,

one number per tissue, and the gauge for free (Gokgol 2012: J of bovine liver is the same for four
diameters). A tip that pushes a membrane in front of it (INDENTATION grows as it goes) cuts nothing.

Models. `displacement`: F is reached, and given up, over a short way λ, exactly at any step,

    f ← e + (f - e) exp(-|Δx| / λ),   e = J·OD while cutting, else 0,

so a tip that trembles by a count moves f by a share of it. `speed`: F v / (v + v₀). `switched`: on
and off; it chatters where the depth is measured in counts.

Energy: what is given back on withdrawing is at most J·OD·λ, less than was put in on the same way.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import numbered, packed
from app.simulation.along_needle import (
    approach,
    keep_memory,
    layer_at,
    layer_rows,
    smoothed_speed,
    smoothing_of,
)
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Cutting of the tissue at the tip",
    "reads": ("depth", "plant_depth", "dt", "indentation"),
    "writes": ("axial_force",),
    "consumers": ("device axis axial", "simulated hand", "view force_gauge", "dimpling"),
    "needs": ("layers", "needle"),
    "models": {
        "displacement": "toughness times diameter, reached over a short way; exact at any step",
        "speed": "the same, reached with the speed of the tip",
        "switched": "on while the depth grows, else off; chatters on a measured depth",
    },
    "energy": ("dissipative", "returns at most J·OD·λ of what it took"),
    "cost_class": "A",
    "parameters": {
        "toughness_scale": (1.0, "-", 0.0, 100.0, "factor on the toughness of every layer"),
        "way": (1e-4, "m", 1e-6, 0.01, "over which the force is reached (displacement)"),
        "slow": (0.002, "m/s", 1e-5, 1.0, "at which half of it is reached (speed)"),
        "speed_smoothing": (0.03, "s", 0.0, 1.0, "time constant of a measured depth's speed"),
    },
    "published": {
        "toughness_scale": (0.46, 1.13, "76 to 185 J/m² of liver, Azar and Hayward 2008"),
    },
}


class _CuttingPlaces(NamedTuple):
    """Constants, how many layers follow; then depth, place in the tissue, speed and force."""

    slot: int
    model: int
    way: int
    slow: int
    smoothing: int
    layers: int
    depth: int = 0
    place: int = 0
    speed: int = 0
    force: int = 0


_AT: Final = numbered(_CuttingPlaces)
_ROW: Final = 2  # depth of its end, J·OD [N]
_MODELS: Final = tuple(DECLARATION["models"])
_DISPLACEMENT, _SPEED = 0, 1


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: needle at rest."""
    rows = layer_rows(binding, "toughness")
    rows[:, 1] *= values["toughness_scale"] * binding.scene.needle.outer_diameter
    return packed(
        _AT,
        rows.ravel(),
        slot=binding.depth_slot,
        model=_MODELS.index(binding.model or _MODELS[0]),
        way=values["way"],
        slow=values["slow"],
        smoothing=smoothing_of(binding, values["speed_smoothing"]),
        layers=len(rows),
        depth=np.nan,
    )


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model from where the tip is and what it feels."""
    keep_memory(_AT, old, new)


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the force of the cut to AXIAL_FORCE."""
    depth, p = state[int(parameters[_AT.slot])], parameters
    if not np.isfinite(depth):
        return
    place = depth - max(state[sv.INDENTATION], 0.0)  # of the tip in the tissue as it was at rest
    if np.isnan(p[_AT.depth]):
        p[_AT.depth], p[_AT.place] = depth, place
    travel, new = depth - p[_AT.depth], place - p[_AT.place]
    p[_AT.depth], p[_AT.place] = depth, place
    p[_AT.speed] = smoothed_speed(p[_AT.speed], travel, state[sv.DT], p[_AT.smoothing])
    cut = 0.0
    if place > 0.0:
        cut = p[layer_at(p, len(_AT), _ROW, int(p[_AT.layers]), place) + 1]
    cuts = travel > 0.0 and new > 0.5 * travel
    if p[_AT.model] == _DISPLACEMENT:
        p[_AT.force] = approach(p[_AT.force], cut if cuts else 0.0, abs(travel) / p[_AT.way])
    elif p[_AT.model] == _SPEED:
        ahead = max(p[_AT.speed], 0.0) if new >= 0.0 else 0.0
        p[_AT.force] = cut * ahead / (ahead + p[_AT.slow])
    else:
        p[_AT.force] = cut if cuts else 0.0
    state[sv.AXIAL_FORCE] += p[_AT.force]


def axial_energy_bound(parameters: FloatArray) -> float:
    """Return the most that withdrawing can be given back [J]."""
    rows = parameters[len(_AT) :].reshape(-1, _ROW)
    return float(rows[:, 1].max() * parameters[_AT.way])
