"""Friction of the tissue along the inserted shaft: dry with Stribeck level, plus viscous.

Per inserted length [N/m]: kinetic level C, break-away level D, viscous b (values of the layers,
Okamura, Simone, O'Leary 2004). With lengths L_i in the layers and speed v,

    g(v) = Σ L_i (C_i + (D_i - C_i) exp(-(v / v_s)²)),   F = f + Σ L_i b_i v,

f is a spring of σ = s Σ L_i, s the presliding stiffness per length, that slides at the level g.

Models, over a displacement Δx:
- `kikuuwe` (default): Coulomb friction in series with the spring by implicit Euler, in closed form
  (Kikuuwe, Takesue, Sano, Mochiyama, Fujimoto 2006, T-RO 22(6):1176, without their damper),

      f ← max(-g, min(g, f + σ Δx)):

  stuck, it is a spring and nothing else. A needle at rest whose depth flickers by a count Δ gives
  back the same two forces, of one sign as long as σ Δ <= g.
- `dahl`: df/dx = σ (1 - f sgn(v) / g), exact at any step for constant g,

      f ← g sgn(Δx) + (f - g sgn(Δx)) exp(-σ |Δx| / g),

  so |f| <= g always and no step size, stiffness or speed makes it unstable (explicit Euler diverges
  for |v| > 2 g / (σ T)). A flicker makes f creep to zero and then change sign with every count.
- `lugre`: the same bristle z = f / σ by the same exponential update, and its damping
  σ₁ exp(-(v / v_s)²) dz/dt, the whole within ±g (falling with v, which keeps it passive).

All integrate over space, so a needle at rest holds its force and does not creep.

- `inserted`: the same laws for what is really in tissue, and as it was measured. L_i is what is
  inserted, not the depth: nothing before a membrane gives way, tissue by tissue as the tip went
  (`simulation.inserted`), all of it times the diameter over that of 18 G: the circumference.
  Sliding friction does not fall with speed. Break-away takes rest: the level is C + (D - C) a, a
  growing towards 1 with the time at rest and falling with the way slid,

      a ← 1 - (1 - a exp(-|Δx| / λ)) exp(-h / t).

  A share of the force stands behind three dampers (`simulation.standing`) and relaxes while the
  needle stands, in seconds to minutes; slid slowly it is not quite reached, so friction rises with
  the speed up to some mm/s, as it does in agarose.

Energy: dissipative but for the presliding spring, which gives back at most g²/(2σ).
"""

import math
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
    in_tissue,
    keep_memory,
    layer_rows,
    smoothed_speed,
    smoothing_of,
    tissue_rows,
)
from app.simulation.channel import BIN, bins_of
from app.simulation.dry_friction import DAHL, KIKUUWE, LUGRE, dahl, kikuuwe, stribeck
from app.simulation.inserted import ROW, SUM, go_to
from app.simulation.needles import GAUGE_18
from app.simulation.scene import Binding
from app.simulation.standing import BRANCHES, branch_time, slipping

DECLARATION: Final[dict[str, Any]] = {
    "title": "Friction of the tissue along the inserted shaft",
    "reads": ("depth", "plant_depth", "dt"),
    "writes": ("axial_force",),
    "consumers": ("device axis axial", "simulated hand", "view force_gauge"),
    "needs": ("layers",),
    "models": {
        "kikuuwe": "a spring that slides at the Stribeck level; calm on a measured depth",
        "dahl": "Dahl with Stribeck level, exponential update exact at any step",
        "lugre": "the same with damped bristles, within the Stribeck level",
        "inserted": "of what is inserted, by tissue and circumference; relaxes at rest",
    },
    "model_reads": {"inserted": ("axis", "indentation", "tissue", "carried")},
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
        "bristle_damping": (30.0, "N·s/m²", 0.0, 1e4, "per inserted length (lugre)"),
        "resting": (30.0, "s", 0.1, 1e4, "in which a needle at rest sticks (inserted)"),
        "loosening": (2e-4, "m", 1e-6, 0.01, "way over which it is loose again (inserted)"),
        "relaxing_share": (0.4, "-", 0.0, 0.99, "of the force, while it stands (inserted)"),
        "relaxing_time": (0.5, "s", 0.001, 100.0, "first of three time constants (inserted)"),
    },
    "published": {
        "stribeck_speed": (
            0.0005,
            0.0025,
            "speeds of fits to porcine organs, PMC13024575",
            (0.0005, 0.0025),
        ),
    },
}


class _FrictionPlaces(NamedTuple):
    """Constants, how many layers follow, and what is known from the tick before.

    Behind the layers stand the law and the damping of its bristles; `dahl` alone has neither.
    """

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


class _InsertedPlaces(NamedTuple):
    """The same of `inserted`: `layers` is -1; then what is known from the tick before.

    Behind it stand the tissues, then the sums at the edges of the bins.
    """

    slot: int
    presliding: int
    resting: int
    smoothing: int
    layers: int
    by_field: int
    loosening: int
    share: int
    time: int
    rows: int
    deepest: int
    depth: int = 0
    place: int = 0
    speed: int = 0
    stuck: int = 0
    force0: int = 0
    force1: int = 0
    force2: int = 0
    force3: int = 0
    kinetic: int = 0
    static: int = 0
    viscous: int = 0
    taken_off: int = 0
    carried: int = 0
    carrier: int = 0


_IN: Final = numbered(_InsertedPlaces)
_AT: Final = numbered(_FrictionPlaces)
_LAYER: Final = numbered(_LayerPlaces)
COUNT: Final = 33e-6
"""Step of a measured depth that is warned of: that of the encoders of the thesis' device [m]."""


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh parameters array: needle at rest.

    The true depth of a simulated needle is differenced as it is; a measured depth comes in steps
    of a camera frame, so its speed is smoothed over `speed_smoothing`.
    """
    if binding.model == "inserted":
        return _inserted(values, binding)
    rows = layer_rows(binding, "friction", "static_friction", "viscous_friction")
    rows[:, 2] = np.maximum(rows[:, 1], rows[:, 2])
    law = {"dahl": [], "lugre": [LUGRE, values["bristle_damping"]]}
    return packed(
        _AT,
        rows.ravel(),
        law.get(binding.model, [KIKUUWE, 0.0]),
        slot=binding.depth_slot,
        presliding=values["presliding_stiffness"],
        stribeck=values["stribeck_speed"],
        smoothing=smoothing_of(binding, values["speed_smoothing"]),
        layers=len(rows),
        depth=np.nan,
    )


def _inserted(values: Mapping[str, float], binding: Binding) -> FloatArray:
    needle = binding.scene.needle
    rows = tissue_rows(binding, "friction", "static_friction", "viscous_friction")
    rows[:, 2] = np.maximum(rows[:, 1], rows[:, 2])
    rows[:, 1:] *= needle.outer_diameter / GAUGE_18
    bins = bins_of(needle.length)
    deepest = (bins - 0.5) * BIN
    if not binding.scene.has_field:
        deepest = min(deepest, float(rows[-1, 0]))
    return packed(
        _IN,
        rows.ravel(),
        np.zeros(len(SUM) * (bins + 1)),
        slot=binding.depth_slot,
        presliding=values["presliding_stiffness"],
        resting=values["resting"],
        smoothing=smoothing_of(binding, values["speed_smoothing"]),
        layers=-1.0,
        by_field=float(binding.scene.has_field),
        loosening=values["loosening"],
        share=values["relaxing_share"],
        time=values["relaxing_time"],
        rows=len(rows),
        deepest=deepest,
        depth=np.nan,
        carrier=np.nan,
    )


def warnings(values: Mapping[str, float], binding: Binding) -> tuple[str, ...]:
    """Return what a measured depth, which comes in counts, makes of a still hand's friction."""
    if binding.depth_slot == sv.PLANT_DEPTH:
        return ()
    if binding.model in ("dahl", "lugre"):
        return (
            sentence(
                "model {binding_model} changes sign with every count of a measured depth, here "
                "{count:g} µm; kikuuwe does not",
                binding_model=binding.model,
                count=1e6 * COUNT,
            ),
        )
    least = min((one.friction for one in binding.scene.met if one.friction > 0.0), default=math.inf)
    if values["presliding_stiffness"] * COUNT <= least:
        return ()
    return (
        sentence(
            "presliding_stiffness {presliding_stiffness:g} N/m² times a count of "
            "{count:g} µm is more than the friction of {friction:g} N/m: a still hand feels it "
            "change sign with every count; give {largest_stiffness:g} N/m² or less",
            presliding_stiffness=values["presliding_stiffness"],
            count=1e6 * COUNT,
            friction=least,
            largest_stiffness=least / COUNT,
        ),
    )


@njit
def _level(p: FloatArray, depth: float, speed: float) -> tuple[float, float, float]:
    """Return inserted length [m], friction level g [N] and viscous coefficient [N·s/m]."""
    inserted = 0.0
    level = 0.0
    viscous = 0.0
    share = stribeck(speed, p[_AT.stribeck])
    for i in range(int(p[_AT.layers])):
        at = len(_AT) + len(_LAYER) * i
        length = min(p[at + _LAYER.end], depth) - inserted
        if length > 0.0:
            kinetic, static = p[at + _LAYER.kinetic], p[at + _LAYER.static]
            level += length * (kinetic + (static - kinetic) * share)
            viscous += length * p[at + _LAYER.viscous]
            inserted += length
    return inserted, level, viscous


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model from the same force; `inserted` goes on as itself alone."""
    if old[_AT.layers] < 0.0 or new[_AT.layers] < 0.0:
        if len(old) == len(new) and old[_AT.layers] == new[_AT.layers]:
            new[:] = old
        return
    keep_memory(_AT, old, new)


@njit
def _rub(state: FloatArray, p: FloatArray) -> float:
    """Friction of what is inserted [N]; a depth that is no number moves nothing."""
    depth, dt = state[int(p[_IN.slot])], state[sv.DT]
    if not np.isfinite(depth + state[sv.INDENTATION]):
        return p[_IN.force0] + p[_IN.force1] + p[_IN.force2] + p[_IN.force3]
    h = min(dt, 1.0) if dt > 0.0 else 0.0  # not for NaN
    depth = in_tissue(p, _IN.taken_off, state, p[_IN.by_field], depth)
    rows, count = len(_IN), int(p[_IN.rows])
    place = min(max(depth - max(state[sv.INDENTATION], 0.0), 0.0), p[_IN.deepest])
    if np.isnan(p[_IN.depth]):  # the first tick has no travel yet
        p[_IN.depth] = depth
    travel = depth - p[_IN.depth]
    p[_IN.depth] = depth
    p[_IN.speed] = smoothed_speed(p[_IN.speed], travel, dt, p[_IN.smoothing])
    edges = rows + ROW * count
    go_to(p, state, _IN.kinetic, rows, count, edges, p[_IN.by_field], p[_IN.place], place)
    p[_IN.place] = place
    loose = p[_IN.stuck] * np.exp(-abs(travel) / p[_IN.loosening])
    p[_IN.stuck] = 1.0 - (1.0 - loose) * np.exp(-h / p[_IN.resting])
    level = p[_IN.kinetic] + max(p[_IN.static] - p[_IN.kinetic], 0.0) * p[_IN.stuck]
    level = max(level, 0.0)
    stiffness, share = p[_IN.presliding] * place, p[_IN.share]
    rigid = 1.0 - share
    force = kikuuwe(p[_IN.force0], travel, rigid * level, rigid * stiffness)
    p[_IN.force0] = force if abs(force) > SNAP else 0.0
    total = p[_IN.force0]
    for i in range(BRANCHES):
        part, tau = share / BRANCHES, branch_time(p[_IN.time], i)
        p[_IN.force1 + i] = slipping(
            p[_IN.force1 + i], travel, h, tau, part * level, part * stiffness
        )
        total += p[_IN.force1 + i]
    return total + p[_IN.viscous] * p[_IN.speed]


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the friction to AXIAL_FORCE; it opposes the motion (positive pushes the tip out)."""
    if parameters[_AT.layers] < 0.0:
        state[sv.AXIAL_FORCE] += _rub(state, parameters)
        return
    depth = state[int(parameters[_AT.slot])]
    dt = state[sv.DT]
    if not np.isfinite(depth):
        return
    if np.isnan(parameters[_AT.depth]):  # the first tick has no travel yet
        parameters[_AT.depth] = depth
    travel = depth - parameters[_AT.depth]
    parameters[_AT.depth] = depth
    speed = smoothed_speed(parameters[_AT.speed], travel, dt, parameters[_AT.smoothing])
    parameters[_AT.speed] = speed
    inserted, level, viscous = _level(parameters, depth, speed)
    stiffness, before = parameters[_AT.presliding] * inserted, parameters[_AT.force]
    behind = len(_AT) + len(_LAYER) * int(parameters[_AT.layers])
    law = parameters[behind] if len(parameters) > behind else DAHL
    if law == KIKUUWE:
        force = kikuuwe(before, travel, level, stiffness)
    else:
        force = dahl(before, travel, level, stiffness)
    force = force if abs(force) > SNAP else 0.0
    parameters[_AT.force] = force
    if law == LUGRE and dt > 0.0 and stiffness > 0.0:
        damping = parameters[behind + 1] * inserted * stribeck(speed, parameters[_AT.stribeck])
        force += damping * (force - min(max(before, -level), level)) / (stiffness * dt)
        force = min(max(force, -level), level)
    state[sv.AXIAL_FORCE] += force + viscous * speed


def axial_energy_bound(parameters: FloatArray) -> float:
    """Return the most that presliding gives back [J]: g²/(2σ) of the whole needle in the tissue."""
    if parameters[_AT.layers] < 0.0:
        tissues = parameters[len(_IN) :][: ROW * int(parameters[_IN.rows])].reshape(-1, ROW)
        length = parameters[_IN.deepest]
        return float(0.5 * tissues[:, 2].max() ** 2 * length / parameters[_IN.presliding])
    rows = parameters[len(_AT) :][: len(_LAYER) * int(parameters[_AT.layers])]
    rows = rows.reshape(-1, len(_LAYER))
    lengths = np.diff(rows[:, 0], prepend=0.0)
    level, stiffness = lengths @ rows[:, 2], parameters[_AT.presliding] * rows[-1, 0]
    return float(0.5 * level**2 / stiffness) if stiffness > 0.0 else 0.0
