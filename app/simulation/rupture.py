"""A membrane that resists by its speed, and gives way to less the faster it is pushed.

Law of the model `rate` of the effect `puncture`, after Mahvash and Dupont (2009, PMC3051196; 2010,
TBME 57:934), whose membrane is a nonlinear Kelvin body that is torn by an unstable crack. Pushed in
by x it resists with

    F = a₁ x + a₂ x² + K Σ eᵢ,      deᵢ/dt = dx/dt - eᵢ/τᵢ,      0 <= eᵢ <= x,

a spring with three branches beside it that relax (`standing`), K = K_m s / (3 (1 - s)) for the
share s of the tissue and the mean stiffness K_m of its spring. So a quick push is steeper. It is
punctured once F, all that a load cell reads of it, reaches

    F_r(v) = F_s h(v) / h(v_s),      h(v) = φ + (1 - φ) exp(-v / v_c),

F_s the stated force of its tissue for 18 G times the diameter, v_s the speed at which it was
stated, φ the floor that fast needles come to. Deformation and work fall with the speed too.

One law for both worlds. The tip is *in* a tissue: none outside, a layer, or a code of the field.
Where the tissue at the tip is another, its membrane stands in front from then on, if it has one and
the tip came on: of layers one after the other, each where it lies at rest or, if it was pushed past
before, where the tip is. Drawn back the tip is at once where it lies. A layer that was punctured
before, or a place that the field calls CHANNEL, is a hole: opened at a share of the force, counted
no more. Punctured, the dimple springs back along the shaft and drags it a little while (`snap`).
"""

from collections.abc import Mapping
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.parameters import numbered, packed
from app.simulation.along_needle import (
    approach,
    in_tissue,
    layer_at,
    smoothed_speed,
    smoothing_of,
    tissue_rows,
)
from app.simulation.needles import GAUGE_18
from app.simulation.scene import Binding, TissueLayer
from app.simulation.standing import BRANCHES, branch_time, stretched

SETTLED: Final = 0.02
"""Time over which the speed of a push is averaged at least [s]: a hand trembles."""
OUTSIDE: Final = -1.0


class MembranePlaces(NamedTuple):
    """Constants; then where the tip is, what stands in front of it, and what was freed.

    `mark` is -1: it stands where the other models have a time that is never below 0.
    """

    slot: int
    reopening: int
    mark: int
    by_field: int
    rows: int
    snap_time: int
    stated_speed: int
    critical_speed: int
    floor: int
    smoothing: int
    depth: int = 0
    speed: int = 0
    inside: int = 0
    front: int = 0
    met: int = 0
    hole: int = 0
    e0: int = 0
    e1: int = 0
    e2: int = 0
    dimple: int = 0
    linear: int = 0
    quadratic: int = 0
    branch: int = 0
    free0: int = 0
    free1: int = 0
    free2: int = 0
    punctured: int = 0
    taken_off: int = 0
    carried: int = 0
    carrier: int = 0


class TissuePlaces(NamedTuple):
    """A tissue: end of its layer [m], a₁, a₂, F_s [N], K [N/m], τ [s]; whether it was punctured."""

    end: int
    linear: int
    quadratic: int
    force: int
    branch: int
    time: int
    pierced: int


AT: Final = numbered(MembranePlaces)
ROW: Final = numbered(TissuePlaces)


def mean_stiffness(tissue: TissueLayer, diameter: float) -> float:
    """Force over depth of a tissue's dimple when it is punctured [N/m]; 0 without a membrane."""
    force = diameter * tissue.puncture_force
    return force / tissue.indentation(force) if force > 0.0 else 0.0


def membranes(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: everything intact, the tip outside."""
    diameter = values["force_scale"] * binding.scene.needle.outer_diameter / GAUGE_18
    rows = tissue_rows(binding, *("thickness",) * (len(ROW) - 1))
    for row, tissue in zip(rows, binding.scene.met, strict=True):
        share = tissue.relaxation_share
        row[ROW.linear] = tissue.indentation_stiffness
        row[ROW.quadratic] = tissue.indentation_hardening
        row[ROW.force] = diameter * tissue.puncture_force
        row[ROW.branch] = mean_stiffness(tissue, diameter) * share / (1.0 - share) / BRANCHES
        row[ROW.time] = tissue.relaxation_time
        row[ROW.pierced] = 0.0
    return packed(
        AT,
        rows.ravel(),
        slot=binding.depth_slot,
        mark=-1.0,
        by_field=float(binding.scene.has_field),
        rows=len(rows),
        reopening=values["reopening"],
        snap_time=values["snap_time"],
        stated_speed=values["stated_speed"],
        critical_speed=values["critical_speed"],
        floor=values["floor"],
        smoothing=smoothing_of(binding, values["speed_smoothing"]),
        depth=np.nan,
        inside=OUTSIDE,
        front=OUTSIDE,
        carrier=np.nan,
    )


@njit
def falling(speed: float, critical: float, floor: float) -> float:
    """h(v): share of the force that tears a membrane slowly that is left at a speed [m/s]."""
    return floor + (1.0 - floor) * np.exp(-max(speed, 0.0) / critical)


@njit
def _at_tip(p: FloatArray, state: FloatArray, depth: float) -> int:
    """Return which tissue lies where the tip is: a layer by its number, -1 outside, or a code."""
    rows = int(p[AT.rows])
    if p[AT.by_field] > 0.0:
        code = state[sv.TISSUE]
        return int(code) if 0.0 <= code < rows else 0
    if depth < 0.0:
        return -1
    return (layer_at(p, len(AT), len(ROW), rows, depth) - len(AT)) // len(ROW)


@njit
def _row(index: int) -> int:
    return len(AT) + len(ROW) * index


@njit
def _wall(p: FloatArray, state: FloatArray, tissue: int, before: float, depth: float) -> float:
    """Depth at which the membrane of `tissue`, which the tip has just come to, stands [m]."""
    if p[AT.by_field] > 0.0:
        wall = depth + state[sv.WALL]
    else:
        wall = p[_row(tissue - 1) + ROW.end] if tissue > 0 else 0.0
    return wall if before <= wall <= depth else depth


@njit
def _go(p: FloatArray, state: FloatArray, before: float, depth: float) -> None:
    """Find what stands in front of the tip after it went from `before` to `depth`."""
    for _ in range(int(p[AT.rows]) + 1):
        inside, now = int(p[AT.inside]), _at_tip(p, state, depth)
        if now == inside:
            return
        if depth < before or (p[AT.by_field] == 0.0 and now < inside):
            if p[AT.by_field] > 0.0 or now < inside:
                p[AT.inside] = now
            return
        next_one = now if p[AT.by_field] > 0.0 else inside + 1
        at = _row(next_one)
        if p[at + ROW.force] > 0.0:
            p[AT.front], p[AT.met] = next_one, _wall(p, state, next_one, before, depth)
            again = state[sv.CHANNEL] if p[AT.by_field] > 0.0 else p[at + ROW.pierced]
            p[AT.hole] = 1.0 if again > 0.0 else 0.0
            p[AT.e0] = p[AT.e1] = p[AT.e2] = 0.0
            return
        p[AT.inside] = next_one


@njit
def _free(p: FloatArray, at: int, x: float, most: float) -> None:
    """Puncture the membrane at `at`, pushed in by x: its dimple is free, and the tip is in it.

    However far a tick went beyond, the dimple holds no more than the force `most` that tears it.
    """
    p[AT.punctured] += 1.0 - p[AT.hole]
    p[at + ROW.pierced] = 1.0
    p[AT.inside], p[AT.front] = p[AT.front], OUTSIDE
    linear, quadratic, branch = p[at + ROW.linear], p[at + ROW.quadratic], p[at + ROW.branch]
    slope = linear + np.sqrt(linear * linear + 4.0 * quadratic * most)
    dimple = min(x, 2.0 * most / slope if slope > 0.0 else 0.0)
    held = 0.0
    for i in range(BRANCHES):
        p[AT.e0 + i] = min(p[AT.e0 + i], dimple)
        held += branch * p[AT.e0 + i]
    left = max(most - dimple * (linear + quadratic * dimple), 0.0)
    share = left / held if held > left else 1.0
    for i in range(BRANCHES):
        p[AT.free0 + i] = share * p[AT.e0 + i]
        p[AT.e0 + i] = 0.0
    p[AT.dimple], p[AT.branch] = dimple, branch
    p[AT.linear], p[AT.quadratic] = linear, quadratic


@njit
def _push(
    p: FloatArray, state: FloatArray, travel: float, depth: float, h: float
) -> tuple[float, float]:
    """Push the membrane in front: its force [N] and how far it is pushed in [m].

    One that gives way leaves its dimple in the memory, and neither force nor depth here.
    """
    at, x = _row(int(p[AT.front])), depth - p[AT.met]
    if x < 0.0:
        p[AT.e0] = p[AT.e1] = p[AT.e2] = 0.0
        if p[AT.by_field] == 0.0 or _at_tip(p, state, depth) != int(p[AT.front]):
            p[AT.front] = OUTSIDE  # else the tip still touches it: the wall was found a tick late
        return 0.0, 0.0
    held = 0.0
    change = min(max(travel, -x), x)
    for i in range(BRANCHES):
        tau = branch_time(p[at + ROW.time], i)
        e = stretched(p[AT.e0 + i], change, h, tau)
        p[AT.e0 + i] = min(max(e, 0.0), x)
        held += p[AT.e0 + i]
    force = x * (p[at + ROW.linear] + p[at + ROW.quadratic] * x) + p[at + ROW.branch] * held
    most = p[at + ROW.force] * (p[AT.reopening] if p[AT.hole] > 0.0 else 1.0)
    most *= falling(p[AT.speed], p[AT.critical_speed], p[AT.floor])
    most /= falling(p[AT.stated_speed], p[AT.critical_speed], p[AT.floor])
    if force >= most and travel > 0.0:
        _free(p, at, x, most)
        return 0.0, 0.0
    return force, x


@njit
def _spring_back(p: FloatArray, drawn: float, h: float) -> float:
    """Let the free dimple shrink, and return the force with which it drags the shaft [N]."""
    dimple = max(p[AT.dimple] + drawn, 0.0)
    if p[AT.snap_time] > 0.0:
        dimple = approach(dimple, 0.0, h / p[AT.snap_time])
    p[AT.dimple] = dimple
    held = 0.0
    for i in range(BRANCHES):
        p[AT.free0 + i] = min(p[AT.free0 + i], dimple)
        held += p[AT.free0 + i]
    return dimple * (p[AT.linear] + p[AT.quadratic] * dimple) + p[AT.branch] * held


@njit
def push_membranes(state: FloatArray, p: FloatArray) -> None:
    """Add the membranes' force to AXIAL_FORCE; write INDENTATION and PUNCTURES."""
    depth, dt = state[int(p[AT.slot])], state[sv.DT]
    h = min(dt, 1.0) if dt > 0.0 else 0.0  # not for NaN
    if not np.isfinite(depth):
        depth, h = p[AT.depth], 0.0
    else:
        depth = in_tissue(p, AT.taken_off, state, p[AT.by_field], depth)
    if np.isnan(depth):
        return
    if np.isnan(p[AT.depth]):
        p[AT.depth] = depth
    before = p[AT.depth]
    travel = depth - before
    p[AT.depth] = depth
    p[AT.speed] = smoothed_speed(p[AT.speed], travel, h, max(p[AT.smoothing], SETTLED))
    force = _spring_back(p, min(travel, 0.0), h)
    pushed = 0.0
    if p[AT.front] < 0.0:
        _go(p, state, before, depth)
        travel = min(travel, depth - p[AT.met]) if p[AT.front] >= 0.0 else travel
    if p[AT.front] >= 0.0:
        more, pushed = _push(p, state, travel, depth, h)
        force += more
        if p[AT.dimple] > pushed and more == 0.0 and p[AT.front] < 0.0:
            force = _spring_back(p, 0.0, 0.0)
    state[sv.AXIAL_FORCE] += force
    state[sv.INDENTATION] = max(pushed, p[AT.dimple])
    state[sv.PUNCTURES] = p[AT.punctured]


def held_energy(p: FloatArray) -> float:
    """Return what the membrane in front and the free dimple hold [J]."""
    held = _energy(p[AT.linear], p[AT.quadratic], p[AT.branch], p[AT.dimple], p[AT.free0 :])
    if p[AT.front] >= 0.0:
        row = p[len(AT) + len(ROW) * int(p[AT.front]) :]
        x = max(p[AT.depth] - p[AT.met], 0.0)
        held += _energy(row[ROW.linear], row[ROW.quadratic], row[ROW.branch], x, p[AT.e0 :])
    return float(held)


def _energy(linear: float, quadratic: float, branch: float, x: float, e: FloatArray) -> float:
    spring = x * x * (linear / 2.0 + quadratic * x / 3.0)
    return float(spring + 0.5 * branch * (e[:BRANCHES] ** 2).sum())


def most_energy(p: FloatArray) -> float:
    """Return the most that the membranes can hold [J]: each pushed slowly until it is punctured."""
    slow = falling(0.0, p[AT.critical_speed], p[AT.floor])
    slow /= falling(p[AT.stated_speed], p[AT.critical_speed], p[AT.floor])
    bound = 0.0
    for row in p[len(AT) :].reshape(-1, len(ROW)):
        if row[ROW.force] > 0.0:
            linear, quadratic, most = row[ROW.linear], row[ROW.quadratic], slow * row[ROW.force]
            slope = linear + (linear * linear + 4.0 * quadratic * most) ** 0.5
            x = 2.0 * most / slope
            bound += _energy(linear, quadratic, row[ROW.branch], x, np.full(BRANCHES, x))
    return bound
