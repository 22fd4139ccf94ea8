"""Cutting: advancing into fresh tissue costs its fracture toughness times the width of the cut.

With J [J/m²] of the layer at the tip and the outer diameter as the width,

    F = J · OD   while the tip advances in the tissue, nothing while it is withdrawn,

one number per tissue, and the gauge for free (Gokgol 2012: J of bovine liver is the same for four
diameters). A tip that pushes a membrane in front of it (INDENTATION grows as it goes) cuts nothing.

Models. `displacement`: F is reached, and given up, over a short way λ, exactly at any step,

    f ← e + (f - e) exp(-|Δx| / λ),   e = J·OD while cutting, else 0,

so a tip that trembles by a count moves f by a share of it. `speed`: F v / (v + v₀). `switched`: on
and off; it chatters where the depth is measured in counts.

Energy: drawn back, at most J·OD·λ is given out. Pushed from rest by x = uλ it took
J·OD·λ (u - 1 + exp(-u)) and gives back J·OD·λ (1 - exp(-u)): more than it took below u = 1.59, by
(1 - ln 2) J·OD·λ = 0.307 J·OD·λ at most, at u = ln 2. Pushed on from f it gains less, so each push
into fresh tissue and back gives out no more than that besides what was held before it.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.simulation.along_needle import (
    approach,
    in_tissue,
    keep_memory,
    layer_at,
    layer_rows,
    smoothed_speed,
    smoothing_of,
    tissue_row,
    tissue_rows,
)
from app.simulation.channel import BIN, WIDTH, bins_of, cut_on
from app.simulation.scene import Binding
from app.simulation.standing import BRANCHES, branch_time, pressed

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
        "track": "by displacement, and nothing where the tip has cut before; relaxes at rest",
    },
    "model_reads": {"track": ("axis", "tissue", "channel", "carried")},
    "energy": ("dissipative", "gives out at most 0.31 J·OD·λ more than it took at each push"),
    "cost_class": "A",
    "parameters": {
        "toughness_scale": (1.0, "-", 0.0, 100.0, "factor on the toughness of every layer"),
        "way": (1e-4, "m", 1e-6, 0.01, "over which the force is reached (displacement, track)"),
        "slow": (0.002, "m/s", 1e-5, 1.0, "at which half of it is reached (speed)"),
        "speed_smoothing": (0.03, "s", 0.0, 1.0, "time constant of a measured depth's speed"),
    },
    "published": {
        "toughness_scale": (
            0.46,
            1.13,
            "76 to 185 J/m² of liver's 164, Azar and Hayward 2008; 164 ± 6 Gokgol 2012",
            (0.463, 1.128, 1.0),
        ),
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
_DISPLACEMENT, _SPEED, _TRACK = 0, 1, 3


class _TrackPlaces(NamedTuple):
    """The same of `track`, beginning alike; then what each branch holds [N], and the carried depth.

    Behind it stand the tissues, then the bins of `simulation.channel`.
    """

    slot: int
    model: int
    by_field: int
    way: int
    wide: int
    rows: int
    bins: int
    depth: int = 0
    place: int = 0
    kept0: int = 0
    kept1: int = 0
    kept2: int = 0
    kept3: int = 0
    taken_off: int = 0
    carried: int = 0
    carrier: int = 0


_TO: Final = numbered(_TrackPlaces)
_TISSUE: Final = 4  # end of its layer [m], J·OD [N], share that relaxes, its time [s]


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: needle at rest."""
    if binding.model == "track":
        return _tracking(values, binding)
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


def _tracking(values: Mapping[str, float], binding: Binding) -> FloatArray:
    needle = binding.scene.needle
    rows = tissue_rows(binding, "toughness", "relaxation_share", "relaxation_time")
    rows[:, 1] *= values["toughness_scale"] * needle.outer_diameter
    bins = bins_of(needle.length)
    return packed(
        _TO,
        rows.ravel(),
        np.zeros(bins * WIDTH),
        slot=binding.depth_slot,
        model=_TRACK,
        by_field=float(binding.scene.has_field),
        way=values["way"],
        wide=needle.outer_diameter,
        rows=len(rows),
        bins=bins,
        depth=np.nan,
        carrier=np.nan,
    )


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model from where the tip is and what it feels; `track` as itself alone."""
    if _TRACK in (old[_AT.model], new[_AT.model]):
        if len(old) == len(new) and old[_AT.model] == new[_AT.model]:
            new[:] = old
        return
    keep_memory(_AT, old, new)


@njit
def _track(state: FloatArray, p: FloatArray) -> float:
    """Force of the cut where the tip remembers its ways [N]; no number moves nothing."""
    depth, dt = state[int(p[_TO.slot])], state[sv.DT]
    held = p[_TO.kept0] + p[_TO.kept1] + p[_TO.kept2] + p[_TO.kept3]
    if not np.isfinite(depth + state[sv.INDENTATION]):
        return held
    depth = in_tissue(p, _TO.taken_off, state, p[_TO.by_field], depth)
    deepest = (p[_TO.bins] - 0.5) * BIN
    place = min(max(depth - max(state[sv.INDENTATION], 0.0), 0.0), deepest)
    if np.isnan(p[_TO.depth]):
        p[_TO.depth], p[_TO.place] = depth, place
    travel, new = depth - p[_TO.depth], place - p[_TO.place]
    rows, count = len(_TO), int(p[_TO.rows])
    at = tissue_row(p, state, rows, _TISSUE, count, p[_TO.by_field], place)
    fresh = False
    if new > 0.0:
        first = rows + _TISSUE * count
        fresh = cut_on(p, first, int(p[_TO.bins]), state, p[_TO.place], place, p[_TO.wide])
        if p[_TO.by_field] > 0.0:
            fresh = state[sv.CHANNEL] == 0.0
    p[_TO.depth], p[_TO.place] = depth, place
    level = p[at + 1] if fresh and travel > 0.0 and new > 0.5 * travel else 0.0
    share, h = p[at + 2], (min(dt, 1.0) if dt > 0.0 else 0.0)
    p[_TO.kept0] = approach(p[_TO.kept0], (1.0 - share) * level, abs(travel) / p[_TO.way])
    held = p[_TO.kept0]
    for i in range(BRANCHES):
        tau, part = branch_time(p[at + 3], i), share / BRANCHES * level
        kept = p[_TO.kept1 + i]
        p[_TO.kept1 + i] = pressed(kept, part, abs(travel), p[_TO.way], h, tau)
        held += p[_TO.kept1 + i]
    return held


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the force of the cut to AXIAL_FORCE."""
    if parameters[_AT.model] == _TRACK:
        state[sv.AXIAL_FORCE] += _track(state, parameters)
        return
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
    """Return the most that drawing back can give out [J]; a push may take 0.31 of it less."""
    if parameters[_AT.model] == _TRACK:
        tissues = parameters[len(_TO) :][: _TISSUE * int(parameters[_TO.rows])]
        return float(tissues.reshape(-1, _TISSUE)[:, 1].max() * parameters[_TO.way])
    rows = parameters[len(_AT) :].reshape(-1, _ROW)
    return float(rows[:, 1].max() * parameters[_AT.way])
