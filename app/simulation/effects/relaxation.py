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

`standing`: what the pierced tissue goes on doing; the dimple's own relaxation is `puncture`'s then,
by its model `rate`. A tip that goes in presses on what lies before it, beside what it cuts, with
the force P of its tissue (for 18 G, times the diameter over 1.27 mm), reached over a short way λ.
While it stands the share s of that relaxes with three time constants (`simulation.standing`), which
goes on for minutes; drawn back it is gone over λ. A second insertion presses as the first: what it
does without is the cut.

Energy: K e²/2 is stored, the damper only takes; a puncture loses what was stored. `standing`:
drawn back, at most P λ is given out. f rises by (P - f) / λ at most on the way of a push, so a push
from 0 that ends at f = P (1 - exp(-u)) took P λ (u - 1 + exp(-u)) or more, whatever relaxes, and
drawn back gives f λ: P λ (2 (1 - exp(-u)) - u) more, at most (1 - ln 2) P λ = 0.307 P λ, at
u = ln 2, and from u = 1.59 on nothing more. Each push and draw can do so; from an f before it gains
less.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import numbered, packed
from app.simulation.along_needle import (
    SNAP,
    approach,
    in_tissue,
    keep_memory,
    layer_at,
    layer_rows,
    tissue_row,
    tissue_rows,
)
from app.simulation.needles import GAUGE_18
from app.simulation.scene import Binding, TissueLayer
from app.simulation.standing import BRANCHES, branch_time, pressed

DECLARATION: Final[dict[str, Any]] = {
    "title": "Relaxation of dimpled tissue",
    "reads": ("depth", "plant_depth", "dt", "indentation"),
    "writes": ("axial_force",),
    "consumers": ("device axis axial", "simulated hand", "view force_gauge", "dimpling"),
    "needs": ("membranes", "needle"),
    "models": {
        "exact": "standard linear solid, exact for a motion that is straight between ticks",
        "midpoint": "the same by the implicit midpoint rule",
        "standing": "the pierced tissue's: what the tip presses on, in three time constants",
    },
    "model_reads": {"standing": ("axis", "tissue", "carried")},
    "energy": (
        "potential",
        "stores K e²/2; `standing` P λ, and gives out 0.31 P λ more a push at most",
    ),
    "cost_class": "A",
    "parameters": {
        "share_scale": (1.0, "-", 0.0, 1.0, "factor on the share that relaxes, of every layer"),
        "time_scale": (1.0, "-", 0.01, 100.0, "factor on the time constant of every layer"),
        "pressing_scale": (1.0, "-", 0.0, 10.0, "factor on the tip's pressing (standing)"),
        "pressing_way": (3e-4, "m", 1e-6, 0.01, "over which that is reached (standing)"),
    },
    "published": {
        "time_scale": (
            0.1,
            4.0,
            "0.05 to 2 s for layers of 0.5 s: soft tissue, this project's table",
            (0.1, 4.0),
        ),
    },
}


class _RelaxationPlaces(NamedTuple):
    """Constants, how many layers follow; indentation before [m], stretch [m], its spring [N/m].

    `midpoint` is 1 for that model and 2 for `standing`, whose other places are its own.
    """

    slot: int
    midpoint: int
    layers: int
    indentation: int = 0
    stretch: int = 0
    stiffness: int = 0


class _StandingPlaces(NamedTuple):
    """The same of `standing`, beginning alike; then what each branch holds [N].

    Behind it stand the tissues.
    """

    slot: int
    midpoint: int
    by_field: int
    way: int
    rows: int
    depth: int = 0
    place: int = 0
    held0: int = 0
    held1: int = 0
    held2: int = 0
    held3: int = 0
    taken_off: int = 0
    carried: int = 0
    carrier: int = 0


_STANDING: Final = 2.0
_ON: Final = numbered(_StandingPlaces)
_TISSUE: Final = 4  # end of its layer [m], P [N], share that relaxes, its time [s]
_AT: Final = numbered(_RelaxationPlaces)
_ROW: Final = 4  # depth of its end [m], K [N/m], τ [s], how far it is pushed in at most [m]
_TOUCH: Final = 1e-9  # [m] a membrane's own depth counts to its layer


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: tissue at rest."""
    if binding.model == "standing":
        return _standing(values, binding)
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


def _standing(values: Mapping[str, float], binding: Binding) -> FloatArray:
    rows = tissue_rows(binding, "pressing", "relaxation_share", "relaxation_time")
    rows[:, 1] *= values["pressing_scale"] * binding.scene.needle.outer_diameter / GAUGE_18
    rows[:, 2] *= values["share_scale"]
    rows[:, 3] *= values["time_scale"]
    return packed(
        _ON,
        rows.ravel(),
        slot=binding.depth_slot,
        midpoint=_STANDING,
        by_field=float(binding.scene.has_field),
        way=values["pressing_way"],
        rows=len(rows),
        depth=np.nan,
        carrier=np.nan,
    )


def warnings(_: Mapping[str, float], binding: Binding) -> tuple[str, ...]:
    """Return where this and `puncture` would relax a dimple twice by their models, or never."""
    asked = {request.name: request.model for request in binding.scene.effects}
    hosted, standing = asked.get("puncture") == "rate", binding.model == "standing"
    if "puncture" not in asked or hosted == standing:
        return ()
    if hosted:
        return (
            sentence(
                "puncture by rate relaxes its dimple itself: this adds to the force that a "
                "membrane tears at; take the model standing"
            ),
        )
    return (
        sentence("the dimple does not relax: puncture by rate would, and its model is another"),
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
    """Go on by another model from the same stretch; `standing` goes on as itself alone."""
    if _STANDING in (old[_AT.midpoint], new[_AT.midpoint]):
        if len(old) == len(new) and old[_AT.midpoint] == new[_AT.midpoint]:
            new[:] = old
        return
    keep_memory(_AT, old, new)


@njit
def _press(state: FloatArray, p: FloatArray) -> float:
    """Force of what the tip presses on [N]; no number moves nothing."""
    depth, dt = state[int(p[_ON.slot])], state[sv.DT]
    if not np.isfinite(depth + state[sv.INDENTATION]):
        return p[_ON.held0] + p[_ON.held1] + p[_ON.held2] + p[_ON.held3]
    h = min(dt, 1.0) if dt > 0.0 else 0.0  # not for NaN
    depth = in_tissue(p, _ON.taken_off, state, p[_ON.by_field], depth)
    place = max(depth - max(state[sv.INDENTATION], 0.0), 0.0)
    if np.isnan(p[_ON.depth]):
        p[_ON.depth], p[_ON.place] = depth, place
    travel, new = depth - p[_ON.depth], place - p[_ON.place]
    p[_ON.depth], p[_ON.place] = depth, place
    at = tissue_row(p, state, len(_ON), _TISSUE, int(p[_ON.rows]), p[_ON.by_field], place)
    level = p[at + 1] if place > 0.0 and travel > 0.0 and new > 0.5 * travel else 0.0
    share, gone = p[at + 2], abs(travel)
    p[_ON.held0] = approach(p[_ON.held0], (1.0 - share) * level, gone / p[_ON.way])
    held = p[_ON.held0]
    for i in range(BRANCHES):
        tau, part = branch_time(p[at + 3], i), share / BRANCHES * level
        p[_ON.held1 + i] = pressed(p[_ON.held1 + i], part, gone, p[_ON.way], h, tau)
        held += p[_ON.held1 + i]
    return held


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the force that relaxes to AXIAL_FORCE."""
    if parameters[_AT.midpoint] == _STANDING:
        state[sv.AXIAL_FORCE] += _press(state, parameters)
        return
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
    """Return what the spring holds [J]; of `standing` the most that it can."""
    if parameters[_AT.midpoint] == _STANDING:
        return axial_energy_bound(parameters)
    return float(0.5 * parameters[_AT.stiffness] * parameters[_AT.stretch] ** 2)


def axial_energy_bound(parameters: FloatArray) -> float:
    """Return the most that the spring can hold [J]: a dimple made in no time.

    Of `standing` the most that drawing back gives out; a push may have taken 0.31 of it less.
    """
    if parameters[_AT.midpoint] == _STANDING:
        tissues = parameters[len(_ON) :].reshape(-1, _TISSUE)
        return float(tissues[:, 1].max() * parameters[_ON.way])
    rows = parameters[len(_AT) :].reshape(-1, _ROW)
    return float((0.5 * rows[:, 1] * rows[:, 3] ** 2).max())
