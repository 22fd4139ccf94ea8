"""Side stiffness of layered tissue about the fulcrum: a needle in a Winkler foundation.

Tissue is pierced where the tip passes and from then on resists the needle's sideways displacement
there with k(s) [N/m²]; the needle bends, held along d̂ at the fulcrum. The stored energy is
U = ½ a - n · m + c (below), and virtual work gives the force at the hub point P_u = P_I - L_out n,

    F = -(m - n (n · m)) / L_out,

perpendicular to the needle and back towards where the tissue was pierced. The same solution says
where the needle is: `TIP_OFFSET` from the straight line's tip to the bent one's, `TIP_SLOPE` the
tip's direction beyond the straight one, `ROOT_CURVATURE` at the fulcrum, which is the moment / EI,
so -F L_out / EI. `core.bend` evaluates the shape from these.

The undeformed line of the tissue is the channel that the tip has cut, not a direction: a needle
that is only tilted, deep in the tissue, bends back towards its channel and its tip hardly moves.

Models. `beam` (default: see docs/studies.md) bends; `winkler` takes the needle as rigid: K sin θ
with K = Σ k_i (b_i³ - a_i³) / 3 for a needle pushed in along one direction and turned by θ, and no
offset of the tip.

Energy. Advancing lays new tissue down where the needle is (dU = 0); retreating frees tissue, whose
energy is lost in the tissue (dU <= 0). Without this memory (a spring K(d) towards one fixed
direction) pushing at an angle would give out energy at the lateral port unless an axial port were
counted; with it the lateral port alone is passive, so this effect has no axial force.

Withdrawing forgets. A depth that nobody measured (DEPTH_SOURCE 0, the model's) moves nothing: the
tissue stays as it was last known, and before the first measurement there is none.

Force and bent shape at once. The needle leaves the fulcrum (s = 0) along the unit vector n, as its
tube holds it there, and ends free at s = d. Tissue of side stiffness k(s) [N/m²] holds it where the
tip once passed, at u(s). With p(s) the needle's place from the fulcrum, each coordinate by itself,
the stored energy is

    U(n) = min over p of  ½ ∫_0^d EI |p''|² + k |p - u|² ds,   p(0) = 0, p'(0) = n,

a quadratic ½ a - n · m + c for |n| = 1. Its slope gives the moment about the fulcrum, m across n,
hence the force at the hub point and the curvature m / EI at the fulcrum; the p that attains it is
where the needle is, tip included. So force and shape are one solution and cannot disagree.

Solved from the fulcrum inwards, bin by bin, as a filter does: the state (p, p') at an edge has the
compliance S against what lies above it and the free place G n + y. A bin adds its tissue, F and q,

    (p, p') <- (1 + S F)⁻¹ (p, p' + S q),   S <- (1 + S F)⁻¹ S,

then the beam leads on to the next edge, T = [[1, h], [0, 1]], S <- T S Tᵀ + [[h³/3, h²/2],
[h²/2, h]] / EI. All terms are positive, nothing cancels, and 1 / EI = 0 is the rigid needle. What
lies above an edge does not change while the needle goes deeper, so a tick costs the same at every
depth. Inside its bin the tissue is taken at the tangent of the upper edge: an error of the second
order in the bin, 2e-4 of the displacement for an 18 G needle (tested).

The tip goes straight ahead through new tissue, which is laid down where the needle already is:
advancing adds no energy at all. Withdrawing frees tissue; what is left of the last bin is the
straight line nearest to what was laid there. Energy falls by both, so the lateral port is passive.

Tissue that breathing moves drags the needle. A layer shifts by its share w of the displacement δ
(TARGET_SHIFT): what it holds is p - w δ, so new tissue is laid in coordinates that move with it. By
superposition the place at an edge is G n + R δ + y. With P = R - (w, 0), the same filter gives

    U = ½ a + n · D δ + ½ b |δ|² - n · m - δ · e + c,    D += Gᵀ (F - F C F) P,  C = (1 + S F)⁻¹ S,
    b += Pᵀ (F - F C F) P,  e += Pᵀ (1 - F C)(q - F y),  R <- (1 + S F)⁻¹ P + (w, 0), led on,

R, D and b once for all. The moment becomes m - D δ; of a rigid needle D δ = -Σ k_i w_i ∫ s ds δ. A
breath held elsewhere than where the needle was inserted leaves a side force, and the tip goes with
the tissue. What δ alone changes of U was supplied by the patient: it is counted in POTENTIAL and as
GAIN_WORK, so no more than that comes out in a cycle. δ's part along the needle moves no force and
no tip; its share of U (tissue that clings to the shaft) comes and goes through GAIN_WORK alone.
Neglected are that tissue moves along the shaft and past the tip, and its motion within a layer.
A bin of two layers moves with their mean share. Where no layer moves, the array has none of this.

Array: heads, layers (end, k), then per edge: S, G and a, which no history changes; y, m, c; and the
q of the bin below the edge; where layers move, δ, then per edge R, D, b, w and e.

The model `field` has no layers: a bin keeps the stiffness of the tissue that it was cut in, of the
patient's field, and is forgotten with it as the needle withdraws. Its tissue is the one that the
tip met in the middle of the bin, its share w that of the tissue there (CARRIED_SHARE), δ is
BREATH. S, G, a, R, D and b are tabulated as bins are laid; stiffness never changes under a needle
that is there, so all that is said of energy holds. Behind the edges: the true depth's slot, how far
it was followed, the table k by code, then per bin k, and tissue and share that were met.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import numbered, packed
from app.simulation.errors import SimulationError
from app.simulation.needles import bending_stiffness
from app.simulation.scene import Binding

BIN: Final = 2.0**-10  # [m] depth resolution of the memory; a power of two, so that edges are exact


class _BuriedPlaces(NamedTuple):
    """Sizes, 1 / EI, depth, and of the bin at the tip q0, q1 (vectors) and ∫ k u²."""

    layers: int
    bins: int
    lever: int
    flexibility: int
    depth: int = 0
    q0: int = 0
    q0_y: int = 0
    q0_z: int = 0
    q1: int = 0
    q1_y: int = 0
    q1_z: int = 0
    square: int = 0


class _EdgePlaces(NamedTuple):
    """Of an edge: S, G, a; y0, y1, m (vectors), c; and q0, q1 (vectors) of the bin below it."""

    s11: int
    s12: int
    s22: int
    g0: int
    g1: int
    a: int
    y0: int
    y0_y: int
    y0_z: int
    y1: int
    y1_y: int
    y1_z: int
    m: int
    m_y: int
    m_z: int
    c: int
    q0: int
    q0_y: int
    q0_z: int
    q1: int
    q1_y: int
    q1_z: int


class _DraggedPlaces(NamedTuple):
    """Of an edge, where layers move: R, D, b; share w of the bin below; e (vector)."""

    r0: int
    r1: int
    d: int
    b: int
    share: int
    e: int
    e_y: int
    e_z: int


class _MetPlaces(NamedTuple):
    """Of a field: 1 where the true depth is a simulated needle's; how many tissues; those now.

    Now are the depth [m], the tissue and its share.
    """

    simulated: int
    codes: int
    depth: int = 0
    code: int = 0
    share: int = 0


AT: Final = numbered(_BuriedPlaces)
_MET: Final = numbered(_MetPlaces)
_EDGE: Final = numbered(_EdgePlaces)
_DRAG: Final = numbered(_DraggedPlaces)
FURTHEST: Final = 0.1
"""Displacement of the tissue beyond which it is followed no further [m]."""


def empty(
    ends: FloatArray,
    stiffness: FloatArray,
    flexibility: float,
    lever: float,
    shares: FloatArray | None = None,
) -> FloatArray:
    """Return the array of tissue not yet pierced.

    Args:
        ends: where the layers end [m], rising, shape (n,).
        stiffness: side stiffness of each [N/m²], shape (n,).
        flexibility: 1 / EI of the needle [1/(N·m²)]; 0 for a rigid one.
        lever: shortest L_out [m].
        shares: of the displacement of breathing that each goes along with, 0 to 1, shape (n,); None
            where nothing moves.
    """
    bins = int(np.ceil(ends[-1] / BIN)) + 1
    pairs = np.column_stack([ends, stiffness]).ravel()
    edges = np.zeros(len(_EDGE) * (bins + 1))
    p = packed(AT, pairs, edges, layers=len(ends), bins=bins, lever=lever, flexibility=flexibility)
    if shares is not None and shares.any():
        p = np.concatenate([p, np.zeros(3 + len(_DRAG) * (bins + 1))])
        for j in range(bins):
            p[_drag(p, j) + _DRAG.share] = _mean_share(ends, stiffness, shares, j)
    _tabulate(p)
    return p


def _empty_field(
    length: float, stiffness: FloatArray, flexibility: float, lever: float, slot: int
) -> FloatArray:
    """Return the array of a field not yet pierced, `stiffness` [N/m²] by code, shape (codes,)."""
    bins = int(np.ceil(length / BIN)) + 1
    edges = np.zeros(len(_EDGE) * (bins + 1) + 3 + len(_DRAG) * (bins + 1))
    met = packed(
        _MET,
        stiffness,
        np.zeros(3 * bins),
        simulated=float(slot == sv.PLANT_DEPTH),
        codes=len(stiffness),
    )
    p = packed(AT, edges, met, layers=0, bins=bins, lever=lever, flexibility=flexibility)
    p[_edge(p, 0) + _EDGE.g1] = 1.0
    return p


def _mean_share(ends: FloatArray, stiffness: FloatArray, shares: FloatArray, j: int) -> float:
    """Share of bin j: the mean over its tissue by stiffness; 0 without any."""
    starts = np.concatenate([[0.0], ends[:-1]])
    within = np.clip(np.minimum(ends, (j + 1) * BIN) - np.maximum(starts, j * BIN), 0.0, None)
    held = within * stiffness
    return float(held @ shares / held.sum()) if held.sum() > 0.0 else 0.0


@njit
def _edge(p: FloatArray, j: int) -> int:
    return len(AT) + 2 * int(p[AT.layers]) + len(_EDGE) * j


@njit
def _shift(p: FloatArray) -> int:
    """Return where δ stands in an array whose layers move."""
    return _edge(p, int(p[AT.bins]) + 1)


@njit
def moves(p: FloatArray) -> bool:
    """Return whether layers move with breathing."""
    return len(p) > _shift(p)


@njit
def _drag(p: FloatArray, j: int) -> int:
    return _shift(p) + 3 + len(_DRAG) * j


@njit
def _in_field(p: FloatArray) -> bool:
    """Return whether bins keep the tissue that they were cut in."""
    return p[AT.layers] == 0.0


@njit
def _met(p: FloatArray) -> int:
    """Return where `_MET` stands in an array of a field."""
    return _drag(p, int(p[AT.bins]) + 1)


@njit
def _of_bin(p: FloatArray, row: int, j: int) -> int:
    """Return where the k (0), the tissue (1) and the share (2) of bin j stand, of a field."""
    met = _met(p)
    return met + len(_MET) + int(p[met + _MET.codes]) + row * int(p[AT.bins]) + j


@njit
def _tissue(p: FloatArray, j: int, begin: float, end: float) -> Any:
    """∫ k, ∫ k t and ∫ k t² over the part of bin j from `begin` to `end`, t from its upper edge."""
    f0 = f1 = f2 = 0.0
    if _in_field(p):
        if end > begin:
            k = p[_of_bin(p, 0, j)]
            f0 = k * (end - begin)
            f1 = k * (end * end - begin * begin) / 2.0
            f2 = k * (end * end * end - begin * begin * begin) / 3.0
        return f0, f1, f2
    upper = j * BIN
    start = 0.0
    for i in range(int(p[AT.layers])):
        low, high = max(start - upper, begin), min(p[len(AT) + 2 * i] - upper, end)
        if high > low:
            k = p[len(AT) + 2 * i + 1]
            f0 += k * (high - low)
            f1 += k * (high * high - low * low) / 2.0
            f2 += k * (high * high * high - low * low * low) / 3.0
        start = p[len(AT) + 2 * i]
    return f0, f1, f2


@njit
def _held(p: FloatArray, e: int, f0: float, f1: float, f2: float) -> Any:
    """(1 + S F)⁻¹ and the compliance after the tissue F has been added to the edge at `e`."""
    s11, s12, s22 = p[e + _EDGE.s11], p[e + _EDGE.s12], p[e + _EDGE.s22]
    n11, n12 = 1.0 + s11 * f0 + s12 * f1, s11 * f1 + s12 * f2
    n21, n22 = s12 * f0 + s22 * f1, 1.0 + s12 * f1 + s22 * f2
    # The determinant written so that every term is positive.
    det = (
        1.0
        + s11 * f0
        + 2.0 * s12 * f1
        + s22 * f2
        + max(s11 * s22 - s12 * s12, 0.0) * max(f0 * f2 - f1 * f1, 0.0)
    )
    i11, i12, i21, i22 = n22 / det, -n12 / det, -n21 / det, n11 / det
    c11, c12 = i11 * s11 + i12 * s12, i11 * s12 + i12 * s22
    c22 = i21 * s12 + i22 * s22
    return i11, i12, i21, i22, c11, c12, c22


@njit
def _coupled(x0: float, x1: float, z0: float, z1: float, f: Any, c: Any) -> float:
    """xᵀ (F - F C F) z: energy of the tissue F below an edge between two free places there."""
    r0, r1 = f[0] * x0 + f[1] * x1, f[1] * x0 + f[2] * x1
    s0, s1 = f[0] * z0 + f[1] * z1, f[1] * z0 + f[2] * z1
    lost = c[0] * r0 * s0 + (c[1] * r0 * s1 + c[1] * s0 * r1) + c[2] * r1 * s1
    return x0 * s0 + x1 * s1 - lost


@njit
def _unit_moment(p: FloatArray, e: int, f: Any, c: Any) -> float:
    """Return `a`, the moment per unit of n, with the tissue F below the edge at `e`."""
    g0, g1 = p[e + _EDGE.g0], p[e + _EDGE.g1]
    return p[e + _EDGE.a] + max(_coupled(g0, g1, g0, g1, f, c), 0.0)


@njit
def _dragged(p: FloatArray, j: int, f: Any, c: Any) -> tuple[float, float]:
    """D and b with the tissue F of bin j, as `_unit_moment` gives a."""
    e, t = _edge(p, j), _drag(p, j)
    g0, g1 = p[e + _EDGE.g0], p[e + _EDGE.g1]
    p0, p1 = p[t + _DRAG.r0] - p[t + _DRAG.share], p[t + _DRAG.r1]
    d = p[t + _DRAG.d] + _coupled(g0, g1, p0, p1, f, c)
    return d, p[t + _DRAG.b] + max(_coupled(p0, p1, p0, p1, f, c), 0.0)


@njit
def _tabulate_drag(p: FloatArray, j: int, f: Any, held: Any) -> None:
    """Fill R, D and b at the edge below bin j."""
    t, below = _drag(p, j), _drag(p, j + 1)
    p[below + _DRAG.d], p[below + _DRAG.b] = _dragged(p, j, f, held[4:])
    p0, p1 = p[t + _DRAG.r0] - p[t + _DRAG.share], p[t + _DRAG.r1]
    turn = held[2] * p0 + held[3] * p1
    p[below + _DRAG.r0] = held[0] * p0 + held[1] * p1 + p[t + _DRAG.share] + BIN * turn
    p[below + _DRAG.r1] = turn


@njit
def _tabulate_bin(p: FloatArray, j: int) -> None:
    """Fill what depends on tissue and needle alone at the edge below bin j: S, G, a; R, D, b."""
    e, below = _edge(p, j), _edge(p, j + 1)
    f0, f1, f2 = _tissue(p, j, 0.0, BIN)
    held = _held(p, e, f0, f1, f2)
    i11, i12, i21, i22, c11, c12, c22 = held
    if moves(p):
        _tabulate_drag(p, j, (f0, f1, f2), held)
    p[below + _EDGE.a] = _unit_moment(p, e, (f0, f1, f2), (c11, c12, c22))
    g0, g1 = p[e + _EDGE.g0], p[e + _EDGE.g1]
    turn = i21 * g0 + i22 * g1
    p[below + _EDGE.g0], p[below + _EDGE.g1] = i11 * g0 + i12 * g1 + BIN * turn, turn
    flexibility = p[AT.flexibility]
    p[below + _EDGE.s11] = (
        c11 + 2.0 * BIN * c12 + BIN * BIN * c22 + flexibility * BIN * BIN * BIN / 3.0
    )
    p[below + _EDGE.s12] = c12 + BIN * c22 + flexibility * BIN * BIN / 2.0
    p[below + _EDGE.s22] = c22 + flexibility * BIN


@njit
def _tabulate(p: FloatArray) -> None:
    """Fill it at every edge."""
    p[_edge(p, 0) + _EDGE.g1] = 1.0
    for j in range(int(p[AT.bins])):
        _tabulate_bin(p, j)


@njit
def rotational_stiffness(p: FloatArray, depth: float) -> float:
    """Moment about the fulcrum per angle for a needle inserted straight [N·m/rad]; 0 outside."""
    if depth <= 0.0:
        return 0.0
    j = min(int(depth / BIN), int(p[AT.bins]) - 1)
    e = _edge(p, j)
    f = _tissue(p, j, 0.0, depth - j * BIN)
    return _unit_moment(p, e, f, _held(p, e, f[0], f[1], f[2])[4:])


@njit
def at_tip(p: FloatArray, axis: int, n: float) -> Any:
    """One coordinate of the solution: (place of the tip [m], its slope, moment, share of U - ½ a).

    Args:
        p: the array.
        axis: which coordinate, 0 to 2.
        n: that coordinate of the needle's direction at the fulcrum.
    """
    j = min(int(p[AT.depth] / BIN), int(p[AT.bins]) - 1)
    e, length = _edge(p, j), p[AT.depth] - j * BIN
    f0, f1, f2 = _tissue(p, j, 0.0, length)
    i11, i12, i21, i22, c11, c12, c22 = _held(p, e, f0, f1, f2)
    q0, q1 = p[AT.q0 + axis], p[AT.q1 + axis]
    y0, y1 = p[e + _EDGE.y0 + axis], p[e + _EDGE.y1 + axis]
    g0, g1 = p[e + _EDGE.g0], p[e + _EDGE.g1]
    s11, s12, s22 = p[e + _EDGE.s11], p[e + _EDGE.s12], p[e + _EDGE.s22]
    b0 = g0 * n + y0 + s11 * q0 + s12 * q1
    b1 = g1 * n + y1 + s12 * q0 + s22 * q1
    place, slope = i11 * b0 + i12 * b1, i21 * b0 + i22 * b1
    r0, r1 = q0 - f0 * y0 - f1 * y1, q1 - f1 * y0 - f2 * y1
    v0, v1 = c11 * r0 + c12 * r1, c12 * r0 + c22 * r1
    m = p[e + _EDGE.m + axis] + g0 * (r0 - f0 * v0 - f1 * v1) + g1 * (r1 - f1 * v0 - f2 * v1)
    rest = 0.5 * (
        y0 * (f0 * y0 + f1 * y1)
        + y1 * (f1 * y0 + f2 * y1)
        - 2.0 * (y0 * q0 + y1 * q1)
        - r0 * v0
        - r1 * v1
    )
    if moves(p):
        t, shift = _drag(p, j), p[_shift(p) + axis]
        share = p[t + _DRAG.share]
        p0, p1 = p[t + _DRAG.r0] - share, p[t + _DRAG.r1]
        place += (i11 * p0 + i12 * p1 + share) * shift
        slope += (i21 * p0 + i22 * p1) * shift
        pulled = p0 * (r0 - f0 * v0 - f1 * v1) + p1 * (r1 - f1 * v0 - f2 * v1)
        d, b = _dragged(p, j, (f0, f1, f2), (c11, c12, c22))
        m -= d * shift
        rest += shift * (0.5 * b * shift - p[t + _DRAG.e + axis] - pulled)
    return place + slope * length, slope, m, rest - n * m


@njit
def stored(p: FloatArray, x: float, y: float, z: float) -> float:
    """U [J] with the needle along (x, y, z), never below 0 for rounding."""
    if p[AT.depth] <= 0.0:
        return 0.0
    j = min(int(p[AT.depth] / BIN), int(p[AT.bins]) - 1)
    total = (
        0.5 * rotational_stiffness(p, p[AT.depth]) + p[_edge(p, j) + _EDGE.c] + 0.5 * p[AT.square]
    )
    total += at_tip(p, 0, x)[3] + at_tip(p, 1, y)[3] + at_tip(p, 2, z)[3]
    return max(total, 0.0)


@njit
def _finish_bin(p: FloatArray, j: int) -> None:
    """Lead the solution of the full bin j on to the next edge, and begin the next bin."""
    if _in_field(p):
        _tabulate_bin(p, j)
    e, below = _edge(p, j), _edge(p, j + 1)
    f0, f1, f2 = _tissue(p, j, 0.0, BIN)
    i11, i12, i21, i22, c11, c12, c22 = _held(p, e, f0, f1, f2)
    s11, s12, s22 = p[e + _EDGE.s11], p[e + _EDGE.s12], p[e + _EDGE.s22]
    g0, g1 = p[e + _EDGE.g0], p[e + _EDGE.g1]
    total = p[e + _EDGE.c] + 0.5 * p[AT.square]
    dragged = moves(p)
    for axis in range(3):
        q0, q1 = p[AT.q0 + axis], p[AT.q1 + axis]
        y0, y1 = p[e + _EDGE.y0 + axis], p[e + _EDGE.y1 + axis]
        r0, r1 = q0 - f0 * y0 - f1 * y1, q1 - f1 * y0 - f2 * y1
        v0, v1 = c11 * r0 + c12 * r1, c12 * r0 + c22 * r1
        p[below + _EDGE.m + axis] = (
            p[e + _EDGE.m + axis] + g0 * (r0 - f0 * v0 - f1 * v1) + g1 * (r1 - f1 * v0 - f2 * v1)
        )
        total += 0.5 * (
            y0 * (f0 * y0 + f1 * y1)
            + y1 * (f1 * y0 + f2 * y1)
            - 2.0 * (y0 * q0 + y1 * q1)
            - r0 * v0
            - r1 * v1
        )
        b0, b1 = y0 + s11 * q0 + s12 * q1, y1 + s12 * q0 + s22 * q1
        turn = i21 * b0 + i22 * b1
        p[below + _EDGE.y0 + axis] = i11 * b0 + i12 * b1 + BIN * turn
        p[below + _EDGE.y1 + axis] = turn
        p[e + _EDGE.q0 + axis], p[e + _EDGE.q1 + axis] = q0, q1
        if dragged:
            t = _drag(p, j)
            p0, p1 = p[t + _DRAG.r0] - p[t + _DRAG.share], p[t + _DRAG.r1]
            pulled = p0 * (r0 - f0 * v0 - f1 * v1) + p1 * (r1 - f1 * v0 - f2 * v1)
            p[_drag(p, j + 1) + _DRAG.e + axis] = p[t + _DRAG.e + axis] + pulled
        p[AT.q0 + axis] = p[AT.q1 + axis] = 0.0
    p[below + _EDGE.c] = total
    p[AT.square] = 0.0


@njit
def _cut_in(p: FloatArray, j: int) -> None:
    """Let a bin that is begun keep the tissue that the tip met in its middle, or is in now."""
    met = _met(p)
    passed = (j + 0.5) * BIN <= p[met + _MET.depth]
    code = p[_of_bin(p, 1, j)] if passed else p[met + _MET.code]
    p[_of_bin(p, 0, j)] = p[met + len(_MET) + int(code)]
    share = p[_of_bin(p, 2, j)] if passed else p[met + _MET.share]
    p[_drag(p, j) + _DRAG.share] = share


@njit
def _meet(state: FloatArray, p: FloatArray) -> None:
    """Keep what the tip meets now, and for each bin whose middle it has passed since."""
    met = _met(p)
    depth = state[sv.PLANT_DEPTH] if p[met + _MET.simulated] > 0.0 else state[sv.DEPTH]
    code, share = state[sv.TISSUE], state[sv.CARRIED_SHARE]
    if not (np.isfinite(depth + share) and 0.0 <= code < p[met + _MET.codes]):
        return
    depth = min(max(depth, 0.0), p[AT.bins] * BIN)
    first, last = int(p[met + _MET.depth] / BIN + 0.5), int(depth / BIN + 0.5)
    for j in range(first, min(last, int(p[AT.bins]))):
        p[_of_bin(p, 1, j)], p[_of_bin(p, 2, j)] = code, share
    p[met + _MET.depth], p[met + _MET.code], p[met + _MET.share] = depth, code, share


@njit
def _lay(p: FloatArray, j: int, begin: float, end: float, axis: int, at: float, on: float) -> None:
    """Lay one coordinate of the tissue of bin j down on the line at + on t."""
    f0, f1, f2 = _tissue(p, j, begin, end)
    p[AT.q0 + axis] += at * f0 + on * f1
    p[AT.q1 + axis] += at * f1 + on * f2
    p[AT.square] += at * at * f0 + 2.0 * at * on * f1 + on * on * f2


@njit
def advance(p: FloatArray, depth: float, x: float, y: float, z: float) -> None:
    """Go on to `depth`, straight ahead from the tip of the needle along (x, y, z)."""
    tip = (at_tip(p, 0, x), at_tip(p, 1, y), at_tip(p, 2, z))
    old = p[AT.depth]
    dragged = moves(p)
    for j in range(int(old / BIN), int(p[AT.bins])):
        upper = j * BIN
        begin, end = max(old - upper, 0.0), min(depth - upper, BIN)
        if begin == 0.0 and _in_field(p):
            _cut_in(p, j)
        for axis in range(3):
            place, slope = tip[axis][0], tip[axis][1]
            if dragged:
                place -= p[_drag(p, j) + _DRAG.share] * p[_shift(p) + axis]
            _lay(p, j, begin, end, axis, place + slope * (upper - old), slope)
        if upper + BIN > depth:
            break
        _finish_bin(p, j)
    p[AT.depth] = depth


@njit
def retreat(p: FloatArray, depth: float) -> None:
    """Forget what lies deeper than `depth`; of its bin the nearest straight line stays."""
    old, new = int(p[AT.depth] / BIN), int(depth / BIN)
    whole = p[AT.depth] - old * BIN if new == old else BIN
    e, left = _edge(p, new), depth - new * BIN
    f0, f1, f2 = _tissue(p, new, 0.0, whole)
    k0, k1, k2 = _tissue(p, new, 0.0, left)
    det = f0 * f2 - f1 * f1
    p[AT.square] = 0.0
    for axis in range(3):
        q0 = p[AT.q0 + axis] if new == old else p[e + _EDGE.q0 + axis]
        q1 = p[AT.q1 + axis] if new == old else p[e + _EDGE.q1 + axis]
        at, on = (q0 / f0 if f0 > 0.0 else 0.0), 0.0
        if det > 1e-9 * f0 * f2:
            at, on = (f2 * q0 - f1 * q1) / det, (f0 * q1 - f1 * q0) / det
        p[AT.q0 + axis], p[AT.q1 + axis] = at * k0 + on * k1, at * k1 + on * k2
        p[AT.square] += at * at * k0 + 2.0 * at * on * k1 + on * on * k2
    p[AT.depth] = depth


@njit
def carry(old: FloatArray, new: FloatArray) -> None:
    """Lay the channel that was cut in `old` down in `new`, of the same layers and another needle.

    Of every bin the straight line nearest to what was laid there, as when a needle withdraws.
    """
    depth = old[AT.depth]
    if depth <= 0.0:
        return
    tip = min(int(depth / BIN), int(old[AT.bins]) - 1)
    for j in range(tip + 1):
        e, end = _edge(old, j), (depth - tip * BIN if j == tip else BIN)
        f0, f1, f2 = _tissue(old, j, 0.0, end)
        if _in_field(new):
            new[_of_bin(new, 0, j)] = f0 / end if end > 0.0 else 0.0
            share = old[_drag(old, j) + _DRAG.share] if moves(old) else 0.0
            new[_drag(new, j) + _DRAG.share] = share
        det = f0 * f2 - f1 * f1
        for axis in range(3):
            q0 = old[AT.q0 + axis] if j == tip else old[e + _EDGE.q0 + axis]
            q1 = old[AT.q1 + axis] if j == tip else old[e + _EDGE.q1 + axis]
            at, on = (q0 / f0 if f0 > 0.0 else 0.0), 0.0
            if det > 1e-9 * f0 * f2:
                at, on = (f2 * q0 - f1 * q1) / det, (f0 * q1 - f1 * q0) / det
            _lay(new, j, 0.0, end, axis, at, on)
        if j < tip:
            _finish_bin(new, j)
    new[AT.depth] = depth
    if moves(old) and moves(new):
        for axis in range(3):
            new[_shift(new) + axis] = old[_shift(old) + axis]


@njit
def _has_moved(state: FloatArray, p: FloatArray) -> bool:
    """Return whether δ is another than it was, where layers move."""
    if not _in_field(p):
        return moves(p)
    at = _shift(p)
    x, y, z = state[sv.BREATH_X], state[sv.BREATH_Y], state[sv.BREATH_Z]
    return x != p[at] or y != p[at + 1] or z != p[at + 2]


@njit
def _follow(state: FloatArray, p: FloatArray) -> None:
    """Take the displacement δ from the state where layers move; what is no number moves nothing."""
    first = sv.BREATH_X if _in_field(p) else sv.TARGET_SHIFT_X
    x, y, z = state[first], state[first + 1], state[first + 2]
    length = np.sqrt(x * x + y * y + z * z)
    if not moves(p) or not np.isfinite(length):
        return
    near = FURTHEST / length if length > FURTHEST else 1.0
    at = _shift(p)
    p[at], p[at + 1], p[at + 2] = near * x, near * y, near * z


__all__ = [
    "AT",
    "BIN",
    "FURTHEST",
    "carry",
    "energy_bound",
    "parameters",
    "rotational_stiffness",
    "step",
]

DECLARATION: Final[dict[str, Any]] = {
    "title": "Side stiffness of layered tissue about the fulcrum",
    "reads": ("axis", "depth", "depth_source", "l_out", "kinematics", "target_shift"),
    "writes": (
        "force",
        "potential",
        "gain_work",
        "tip_offset",
        "tip_slope",
        "root_curvature",
        "bent_length",
    ),
    "consumers": ("device axis lateral", "score of felt force", "views and score of the tip"),
    "needs": ("layers", "needle"),
    "models": {
        "beam": "needle that bends on the layers, with its shape",
        "winkler": "rigid needle, closed form per layer; far too stiff beyond some 40 mm",
        "field": "as beam, each millimetre in the tissue of the patient's field that it was cut in",
    },
    "model_reads": {"field": ("plant_depth", "tissue", "carried_share", "breath")},
    "energy": (
        "potential",
        "stored energy is never negative; advancing adds none, retreating loses it, and what"
        " breathing adds by moving layers is counted in gain_work",
    ),
    "cost_class": "A",
    "parameters": {
        "stiffness_scale": (1.0, "-", 0.0, 100.0, "factor on the side stiffness of every layer"),
        "shortest_lever": (0.02, "m", 0.005, 0.2, "L_out below which the force stops growing"),
    },
}

_LONGEST: Final = 1.0  # [m] of layers; longer than any needle


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh parameters array: tissue not yet pierced.

    Where the scene has no field, `field` is `beam`.

    Raises:
        SimulationError: if the layers together are thicker than a metre.
    """
    scene, scale = binding.scene, values["stiffness_scale"]
    if binding.model == "field" and scene.has_field:
        stiffness = np.array([scale * tissue.side_stiffness for tissue in scene.tissues])
        flexibility = 1.0 / bending_stiffness(scene.needle.outer_diameter)
        length = scene.needle.length + 2.0 * BIN
        return _empty_field(
            length, stiffness, flexibility, values["shortest_lever"], binding.depth_slot
        )
    ends = np.cumsum([layer.thickness for layer in scene.layers])
    if ends[-1] > _LONGEST:
        raise SimulationError(
            sentence(
                "the layers are {thickness:g} m thick together; at most {longest:g} m",
                thickness=ends[-1],
                longest=_LONGEST,
            )
        )
    stiffness = np.array([scale * layer.side_stiffness for layer in scene.layers])
    rigid = binding.model == "winkler"
    flexibility = 0.0 if rigid else 1.0 / bending_stiffness(scene.needle.outer_diameter)
    shares = np.array(scene.shares_moved)
    return empty(ends, stiffness, flexibility, values["shortest_lever"], shares)


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the tissue's force at the hub point to FORCE_*, and how the needle bends.

    Nothing without valid kinematics.
    """
    depth = state[sv.DEPTH]
    lever = state[sv.L_OUT]
    x, y, z = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    if state[sv.KINEMATICS] != 0.0 or not np.isfinite(depth + lever + x + y + z):
        return
    if state[sv.DEPTH_SOURCE] == 0.0:
        depth = parameters[AT.depth]
    if _in_field(parameters):
        _meet(state, parameters)
    depth = min(max(depth, 0.0), parameters[AT.bins] * BIN - 0.5 * BIN)
    change = 0.0
    if depth != parameters[AT.depth] or _has_moved(state, parameters):
        change = -stored(parameters, x, y, z)
        _follow(state, parameters)
        if depth > parameters[AT.depth]:
            advance(parameters, depth, x, y, z)
        elif depth < parameters[AT.depth]:
            retreat(parameters, depth)
        change += stored(parameters, x, y, z)
    state[sv.POTENTIAL] += stored(parameters, x, y, z)
    state[sv.GAIN_WORK] += change  # by advancing, retreating and breathing
    px, tx, mx, _ = at_tip(parameters, 0, x)
    py, ty, my, _ = at_tip(parameters, 1, y)
    pz, tz, mz, _ = at_tip(parameters, 2, z)
    along = x * mx + y * my + z * mz
    mx, my, mz = mx - along * x, my - along * y, mz - along * z
    scale = -1.0 / max(lever, parameters[AT.lever])
    state[sv.FORCE_X] += scale * mx
    state[sv.FORCE_Y] += scale * my
    state[sv.FORCE_Z] += scale * mz
    flexibility = parameters[AT.flexibility]
    if flexibility == 0.0 or depth <= 0.0:
        return
    along = x * px + y * py + z * pz
    state[sv.TIP_OFFSET_X] += px - along * x
    state[sv.TIP_OFFSET_Y] += py - along * y
    state[sv.TIP_OFFSET_Z] += pz - along * z
    along = x * tx + y * ty + z * tz
    state[sv.TIP_SLOPE_X] += tx - along * x
    state[sv.TIP_SLOPE_Y] += ty - along * y
    state[sv.TIP_SLOPE_Z] += tz - along * z
    state[sv.ROOT_CURVATURE_X] += flexibility * mx
    state[sv.ROOT_CURVATURE_Y] += flexibility * my
    state[sv.ROOT_CURVATURE_Z] += flexibility * mz
    state[sv.BENT_LENGTH] = max(state[sv.BENT_LENGTH], depth)  # a bevel's bend is as long


def stored_energy(parameters: FloatArray, axis: FloatArray) -> float:
    """Return U [J] for the needle direction `axis`, shape (3,)."""
    return float(stored(parameters, *axis))


def energy_bound(parameters: FloatArray) -> float:
    """Return the most energy that turning the needle can store [J]: 2 a at the deepest needle.

    With the channel's mean direction m / a, no longer than 1, U is ½ a |n - m / a|² and what the
    channel's own windings hold, which no turning gives back. Where layers move, m - D δ is longer:
    by 2 |D| δ at most, for tissue was laid with a displacement, too; and D² <= a b. Of a field:
    with all of it as stiff as the stiffest, moved by all of the displacement.
    """
    if parameters[AT.layers] == 0.0:
        parameters = _stiffest(parameters)
    a = float(rotational_stiffness(parameters, parameters[AT.bins] * BIN - 0.5 * BIN))
    if not moves(parameters):
        return 2.0 * a
    b = float(parameters[_drag(parameters, int(parameters[AT.bins])) + _DRAG.b])
    return 2.0 * (a**0.5 + FURTHEST * b**0.5) ** 2


def _stiffest(p: FloatArray) -> FloatArray:
    """Return one layer of the stiffest tissue of a field, that all of breathing moves."""
    met = int(_met(p))
    table = p[met + len(_MET) :][: int(p[met + _MET.codes])]
    ends = np.array([p[AT.bins] * BIN])
    return empty(ends, table.max(keepdims=True), p[AT.flexibility], p[AT.lever], np.ones(1))
