"""Side stiffness of layered tissue about the fulcrum: a needle in a Winkler foundation.

Tissue at depth s is pierced where the tip passes, at direction r(s), and from then on resists the
needle's sideways displacement s (n - r(s)) there with k(s) [N/m²]. With |n| = |r| = 1 the stored
energy of the tissue around a needle inserted to depth d is

    U(n, d) = K(d) - n · C(d),   K = ∫_0^d k s² ds,   C = ∫_0^d k s² r ds

(∫ of ½ k s² |n - r|², as ½ |n - r|² = 1 - n · r). K over layers is Σ k_i (b_i³ - a_i³) / 3; for a
needle pushed in along one direction and turned by θ the moment about the fulcrum is K sin θ, the
closed form K θ for small angles. Virtual work gives the force at the hub point P_u = P_I - L_out n:

    F = -(C - n (n · C)) / L_out,

perpendicular to the needle and back towards the directions at which the tissue was pierced.

Models. `winkler` takes the needle as rigid. `beam` (default: see docs/studies.md) lets it bend:
K(d) becomes the moment per angle of a beam on the layered foundation whose slope is held at the
fulcrum, tabulated over depth when the scene is compiled; C is laid with the same increments dK. K
rises with depth in both, so what is said here of energy holds for both.

Energy. Advancing lays new tissue down unstressed (dU = 0); retreating frees tissue, whose energy
is lost in the tissue (dU <= 0). Without this memory (a spring K(d) towards one fixed direction)
pushing at an angle would give out energy at the lateral port unless an axial port were counted;
with it the lateral port alone is passive, so this effect has no axial force.

Memory: C at the edges of bins of depth, in the parameters array. Withdrawing forgets; inside a bin
only the mean direction is kept, so a depth that flickers re-lays at most the bin at the tip. A
depth that nobody measured (DEPTH_SOURCE 0, the model's) moves nothing: the tissue stays as it was
last known, and before the first measurement there is none.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.simulation.errors import SimulationError
from app.simulation.foundation import hermite_moment
from app.simulation.needles import bending_stiffness
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Side stiffness of layered tissue about the fulcrum",
    "reads": ("axis_x", "axis_y", "axis_z", "depth", "depth_source", "l_out", "kinematics"),
    "writes": ("force_x", "force_y", "force_z", "potential", "gain_work"),
    "consumers": ("device axis lateral", "score of felt force"),
    "needs": ("layers", "needle"),
    "models": {
        "beam": "needle that bends: stiffness by depth from a beam on the layers, tabulated",
        "winkler": "rigid needle, closed form per layer; far too stiff beyond some 40 mm",
    },
    "energy": (
        "potential",
        "stored energy K - n·C is never negative; advancing adds none, retreating loses it",
    ),
    "cost_class": "A",
    "parameters": {
        "stiffness_scale": ("-", 0.0, 100.0, "factor on the side stiffness of every layer"),
        "shortest_lever": ("m", 0.005, 0.2, "L_out below which the force stops growing"),
    },
}

BIN: Final = 2.0**-10  # [m] depth resolution of the memory; a power of two, so that edges are exact
_LONGEST: Final = 1.0  # [m] of layers; longer than any needle

# Parameters array: heads, layers (end, k), C at the bin edges (triples), K of the beam there.
LAYERS, BINS, LEVER, BEAM, DEPTH, CX, CY, CZ, HEAD = range(9)


@dataclass(frozen=True, slots=True)
class LateralTissue:
    """Parameters of the effect; layers and needle come from the scene."""

    stiffness_scale: float = 1.0
    shortest_lever: float = 0.02

    def parameters(self, binding: Binding) -> FloatArray:
        """Return a fresh parameters array: tissue not yet pierced.

        Raises:
            SimulationError: if the layers together are thicker than a metre.
        """
        layers = binding.scene.layers
        ends = np.cumsum([layer.thickness for layer in layers])
        if ends[-1] > _LONGEST:
            raise SimulationError(
                f"the layers are {ends[-1]:g} m thick together; at most {_LONGEST:g} m"
            )
        stiffness = [self.stiffness_scale * layer.side_stiffness for layer in layers]
        bins = int(np.ceil(ends[-1] / BIN)) + 1
        beam = binding.model != "winkler"
        head = np.array([len(ends), bins, self.shortest_lever, beam, 0.0, 0.0, 0.0, 0.0])
        pairs = np.column_stack([ends, stiffness]).ravel()
        p = np.concatenate([head, pairs, np.zeros(4 * (bins + 1))])
        if beam:
            p[-(bins + 1) :] = _beam_table(
                p, bending_stiffness(binding.scene.needle.outer_diameter)
            )
        return p


@njit
def _rigid_stiffness(p: FloatArray, depth: float) -> float:
    """K(d) = Σ k_i (b_i³ - a_i³) / 3 [N·m/rad]; zero for d <= 0."""
    total = 0.0
    start = 0.0
    for i in range(int(p[LAYERS])):
        end = min(p[HEAD + 2 * i], depth)
        if end > start:
            total += p[HEAD + 2 * i + 1] * (end * end * end - start * start * start) / 3.0
            start = end
    return total


@njit
def _beam_table(p: FloatArray, ei: float) -> FloatArray:
    """K at the bin edges [N·m/rad] of a needle that bends, by one Hermite element per bin.

    Never falls with depth: the needle of a shorter depth is a restriction of the longer one.
    """
    bins = int(p[BINS])
    k = np.empty(bins)
    for j in range(bins):  # mean side stiffness of the bin
        k[j] = 0.0
        start = 0.0
        for i in range(int(p[LAYERS])):
            end = p[HEAD + 2 * i]
            share = min(end, (j + 1) * BIN) - max(start, j * BIN)
            k[j] += max(share, 0.0) / BIN * p[HEAD + 2 * i + 1]
            start = end
    table = np.zeros(bins + 1)
    band, right = np.empty((2 * bins, 4)), np.empty(2 * bins)
    for n in range(1, bins + 1):
        moment = hermite_moment(k[:n], ei, n * BIN, 1.0, band[: 2 * n], right[: 2 * n])
        table[n] = max(moment, table[n - 1])
    return table


@njit
def rotational_stiffness(p: FloatArray, depth: float) -> float:
    """Moment about the fulcrum per angle for a needle inserted straight [N·m/rad]."""
    if p[BEAM] == 0.0 or depth <= 0.0:
        return _rigid_stiffness(p, depth)
    table = HEAD + 2 * int(p[LAYERS]) + 3 * (int(p[BINS]) + 1)
    j = min(int(depth / BIN), int(p[BINS]) - 1)
    low = p[table + j]
    return low + (depth / BIN - j) * (p[table + j + 1] - low)


@njit
def _advance(p: FloatArray, depth: float, x: float, y: float, z: float) -> None:
    """Lay the tissue between the old and the new depth down at the present direction."""
    edges = HEAD + 2 * int(p[LAYERS])
    stiffness = rotational_stiffness(p, p[DEPTH])
    for j in range(int(p[DEPTH] / BIN), int(p[BINS])):
        end = min((j + 1) * BIN, depth)
        reached = rotational_stiffness(p, end)
        weight = reached - stiffness
        p[CX] += weight * x
        p[CY] += weight * y
        p[CZ] += weight * z
        stiffness = reached
        if (j + 1) * BIN > depth:
            break
        p[edges + 3 * (j + 1)] = p[CX]
        p[edges + 3 * (j + 1) + 1] = p[CY]
        p[edges + 3 * (j + 1) + 2] = p[CZ]
    p[DEPTH] = depth


@njit
def _retreat(p: FloatArray, depth: float) -> None:
    """Forget what lies deeper; inside a bin its mean direction stays."""
    edges = HEAD + 2 * int(p[LAYERS])
    old, new = int(p[DEPTH] / BIN), int(depth / BIN)
    top = p[DEPTH] if new == old else (new + 1) * BIN
    bottom = rotational_stiffness(p, new * BIN)
    whole = rotational_stiffness(p, top) - bottom
    share = (rotational_stiffness(p, depth) - bottom) / whole if whole > 0.0 else 0.0
    for axis in range(3):
        low = p[edges + 3 * new + axis]
        high = p[CX + axis] if new == old else p[edges + 3 * (new + 1) + axis]
        p[CX + axis] = low + share * (high - low)
    p[DEPTH] = depth


@njit
def _stored(p: FloatArray, x: float, y: float, z: float) -> float:
    """U = K - n · C [J], never below 0 for rounding."""
    stiffness = rotational_stiffness(p, p[DEPTH])
    return max(stiffness - (x * p[CX] + y * p[CY] + z * p[CZ]), 0.0)


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the tissue's force at the hub point to FORCE_*; nothing without valid kinematics."""
    depth = state[sv.DEPTH]
    lever = state[sv.L_OUT]
    x, y, z = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    if state[sv.KINEMATICS] != 0.0 or not np.isfinite(depth + lever + x + y + z):
        return
    if state[sv.DEPTH_SOURCE] == 0.0:
        depth = parameters[DEPTH]
    depth = min(max(depth, 0.0), parameters[BINS] * BIN - 0.5 * BIN)
    change = 0.0
    if depth != parameters[DEPTH]:
        change = -_stored(parameters, x, y, z)
        if depth > parameters[DEPTH]:
            _advance(parameters, depth, x, y, z)
        else:
            _retreat(parameters, depth)
        change += _stored(parameters, x, y, z)
    along = x * parameters[CX] + y * parameters[CY] + z * parameters[CZ]
    state[sv.POTENTIAL] += _stored(parameters, x, y, z)
    state[sv.GAIN_WORK] += change  # by advancing and retreating
    scale = -1.0 / max(lever, parameters[LEVER])
    state[sv.FORCE_X] += scale * (parameters[CX] - along * x)
    state[sv.FORCE_Y] += scale * (parameters[CY] - along * y)
    state[sv.FORCE_Z] += scale * (parameters[CZ] - along * z)


def stored_energy(parameters: FloatArray, axis: FloatArray) -> float:
    """Return U = K - n · C [J] for the needle direction `axis`, shape (3,)."""
    return float(_stored(parameters, *axis))


def energy_bound(parameters: FloatArray) -> float:
    """Return the most energy that the tissue can store [J]: U <= 2 K at the deepest needle."""
    return 2.0 * float(rotational_stiffness(parameters, parameters[BINS] * BIN - 0.5 * BIN))
