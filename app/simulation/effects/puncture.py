"""Membranes on the way: skin, fascia, capsule. Each dimples, is punctured, and lets the tip go.

The membrane in front of the tip is a quadratic spring (Okamura, Simone, O'Leary 2004, without
their constant) from where the tip met it,

    F(x) = a₁ x + a₂ x²,   U(x) = a₁ x²/2 + a₂ x³/3,

until F reaches the force at which it is punctured: that of its layer, for 18 G, times the outer
diameter over 1.27 mm. Then the dimple is free, and what it stored is lost in the tissue.

- A tip that punctured one membrane meets the next where it stands then: it begins at zero force, so
  nothing is given out that was not put in, however deep the dimple was.
- A punctured membrane stays so until the tip has left the layer at its depth at rest: between
  dimple and rest lies the hysteresis. Entered again it is a hole, opened at `reopening` of the
  force, and counts no second time.

Models. `instant`: the force falls within a tick, nearly all of it. `snap`: the dimple springs back
along the shaft and drags it, with a time constant; as it shrinks by at least what the needle is
drawn out, it gives back no more than it held.

`rate`: a membrane that relaxes and tears at less force the faster it is pushed, in layers or where
the scene's field has its walls; see `simulation.rupture`. Its stated force is all that a load cell
reads at the stated speed, so nothing else of the dimple may be added: `relaxation` by `standing`.

Array: these places, then a row per membrane; of `rate` its own.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.simulation.along_needle import approach, keep_memory
from app.simulation.needles import GAUGE_18
from app.simulation.rupture import held_energy, membranes, most_energy, push_membranes
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Dimpling and puncture of skin, fascia and capsule",
    "reads": ("depth", "plant_depth", "dt"),
    "writes": ("axial_force", "indentation", "punctures"),
    "consumers": ("device axis axial", "simulated hand", "view force_gauge", "other effects"),
    "needs": ("membranes", "needle"),
    "models": {
        "instant": "quadratic spring; punctured, its force falls within a tick",
        "snap": "the same; punctured, the dimple springs back in some milliseconds",
        "rate": "relaxes, tears at less force the faster it is pushed; snaps back as it tears",
    },
    "model_reads": {"rate": ("axis", "tissue", "wall", "channel", "carried")},
    "energy": ("potential", "stores a₁x²/2 + a₂x³/3 of the dimple; a puncture loses it"),
    "cost_class": "A",
    "parameters": {
        "force_scale": (1.0, "-", 0.0, 10.0, "factor on the force that punctures every membrane"),
        "reopening": (0.3, "-", 0.0, 1.0, "share of that force which a hole takes to be opened"),
        "snap_time": (0.01, "s", 0.001, 0.2, "in which a free dimple springs back (snap, rate)"),
        "stated_speed": (0.005, "m/s", 1e-4, 1.0, "at which the stated forces hold (rate)"),
        "critical_speed": (0.02, "m/s", 1e-4, 1.0, "over which the force falls (rate)"),
        "floor": (0.6, "-", 0.05, 1.0, "share of the slow force that fast needles need (rate)"),
        "speed_smoothing": (0.03, "s", 0.0, 1.0, "of a measured depth's speed (rate)"),
    },
    "published": {
        "force_scale": (
            0.5,
            3.0,
            "skin 2-3 N of 1.5, fascia 1-3 N of 1, capsule 0.3-1 N of 0.6: Maurin 2004",
            (1.33, 2.0, 1.0, 3.0, 0.5, 1.67),
        ),
    },
}


class _PuncturePlaces(NamedTuple):
    """Constants, then the depth before [m], the free dimple [m] with its spring, and the count.

    `snap_time` is -1 in the array of `rate`, which has other places.
    """

    slot: int
    reopening: int
    snap_time: int
    membranes: int
    depth: int = 0
    dimple: int = 0
    linear: int = 0
    quadratic: int = 0
    punctured: int = 0


class _MembranePlaces(NamedTuple):
    """Depth at rest [m], a₁, a₂, force that punctures it [N]; where it was met [m], its state."""

    rest: int
    linear: int
    quadratic: int
    force: int
    met: int
    state: int = 0


_AT: Final = numbered(_PuncturePlaces)
_ROW: Final = numbered(_MembranePlaces)
_INTACT, _PIERCED, _HOLE = 0.0, 1.0, 2.0


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: all membranes intact."""
    if binding.model == "rate":
        return membranes(values, binding)
    scale = values["force_scale"] * binding.scene.needle.outer_diameter / GAUGE_18
    rows, depth = [], 0.0
    for layer in binding.scene.layers:
        force = scale * layer.puncture_force
        if force > 0.0:
            k, h = layer.indentation_stiffness, layer.indentation_hardening
            rows.append(packed(_ROW, rest=depth, linear=k, quadratic=h, force=force, met=depth))
        depth += layer.thickness
    return packed(
        _AT,
        np.ravel(rows),
        slot=binding.depth_slot,
        reopening=values["reopening"],
        snap_time=values["snap_time"] if binding.model == "snap" else 0.0,
        membranes=len(rows),
        depth=np.nan,
    )


@njit
def indentation_at(force: float, linear: float, quadratic: float) -> float:
    """Return how far a membrane gives way to a force [m]; 0 for one without stiffness."""
    slope = linear + np.sqrt(linear * linear + 4.0 * quadratic * force)
    return 2.0 * force / slope if slope > 0.0 else 0.0


@njit
def _push(p: FloatArray, depth: float) -> tuple[float, float]:
    """Push the membrane in front of the tip: its force [N] and how far it is pushed in [m].

    One that gives way leaves its dimple in the memory, and neither force nor depth here.
    """
    front = True
    force, pushed = 0.0, 0.0
    for i in range(int(p[_AT.membranes])):
        at = len(_AT) + len(_ROW) * i
        rest = p[at + _ROW.rest]
        if p[at + _ROW.state] == _PIERCED and depth < rest:
            p[at + _ROW.state] = _HOLE
        if p[at + _ROW.state] == _PIERCED:
            continue
        stands = max(rest, depth)
        if not front:
            p[at + _ROW.met] = stands
            continue
        front = False
        p[at + _ROW.met] = min(p[at + _ROW.met], stands)
        x = max(depth - p[at + _ROW.met], 0.0)
        linear, quadratic = p[at + _ROW.linear], p[at + _ROW.quadratic]
        most = p[at + _ROW.force]
        if p[at + _ROW.state] == _HOLE:
            most *= p[_AT.reopening]
        f = x * (linear + quadratic * x)
        if x > 0.0 and f >= most:
            p[_AT.punctured] += 1.0 if p[at + _ROW.state] == _INTACT else 0.0
            p[at + _ROW.state] = _PIERCED
            p[_AT.linear], p[_AT.quadratic] = linear, quadratic
            p[_AT.dimple] = indentation_at(most, linear, quadratic)
        else:
            force, pushed = f, x
    return force, pushed


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model with the same membranes punctured; `rate` goes on as itself alone."""
    if old[_AT.snap_time] < 0.0 or new[_AT.snap_time] < 0.0:
        if len(old) == len(new) and old[_AT.snap_time] == new[_AT.snap_time]:
            new[:] = old
        return
    keep_memory(_AT, old, new)
    for at in range(len(_AT), len(new), len(_ROW)):
        new[at + _ROW.met], new[at + _ROW.state] = old[at + _ROW.met], old[at + _ROW.state]


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the membranes' force to AXIAL_FORCE; write INDENTATION and PUNCTURES."""
    if parameters[_AT.snap_time] < 0.0:
        push_membranes(state, parameters)
        return
    depth, dt = state[int(parameters[_AT.slot])], state[sv.DT]
    if not np.isfinite(depth):
        depth = parameters[_AT.depth]
    if np.isnan(depth):
        return
    if np.isnan(parameters[_AT.depth]):
        parameters[_AT.depth] = depth
    drawn = min(depth - parameters[_AT.depth], 0.0)
    parameters[_AT.depth] = depth
    dimple = max(parameters[_AT.dimple] + drawn, 0.0)
    if parameters[_AT.snap_time] == 0.0:
        dimple = 0.0
    elif dt > 0.0:
        dimple = approach(dimple, 0.0, dt / parameters[_AT.snap_time])
    parameters[_AT.dimple] = dimple
    force, pushed = _push(parameters, depth)
    dimple = parameters[_AT.dimple]
    force += dimple * (parameters[_AT.linear] + parameters[_AT.quadratic] * dimple)
    state[sv.AXIAL_FORCE] += force
    state[sv.INDENTATION] = max(pushed, dimple)
    state[sv.PUNCTURES] = parameters[_AT.punctured]


def stored_energy(parameters: FloatArray) -> float:
    """Return what the membrane in front and the free dimple hold [J]."""
    p = parameters
    if p[_AT.snap_time] < 0.0:
        return held_energy(p)
    held = p[_AT.dimple] ** 2 * (p[_AT.linear] / 2.0 + p[_AT.quadratic] * p[_AT.dimple] / 3.0)
    for row in p[len(_AT) :].reshape(-1, len(_ROW)):
        if row[_ROW.state] != _PIERCED:
            x = max(p[_AT.depth] - row[_ROW.met], 0.0)
            return float(held + x * x * (row[_ROW.linear] / 2.0 + row[_ROW.quadratic] * x / 3.0))
    return float(held)


def axial_energy_bound(parameters: FloatArray) -> float:
    """Return the most that the membranes can hold [J]: each pushed in to where it is punctured."""
    if parameters[_AT.snap_time] < 0.0:
        return most_energy(parameters)
    bound = 0.0
    for row in parameters[len(_AT) :].reshape(-1, len(_ROW)):
        linear, quadratic = row[_ROW.linear], row[_ROW.quadratic]
        x = float(indentation_at(row[_ROW.force], linear, quadratic))
        bound += x * x * (linear / 2.0 + quadratic * x / 3.0)
    return bound
