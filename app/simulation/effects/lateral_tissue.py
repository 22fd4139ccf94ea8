"""Side stiffness of layered tissue about the fulcrum: a needle in a Winkler foundation.

Tissue is pierced where the tip passes and from then on resists the needle's sideways displacement
there with k(s) [N/m²]; the needle bends, held along d̂ at the fulcrum. `simulation.buried_needle`
solves that: the stored energy is U = ½ a - n · m + c, and virtual work gives the force at the hub
point P_u = P_I - L_out n,

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
"""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.simulation.buried_needle import (
    AT,
    BIN,
    advance,
    at_tip,
    empty,
    retreat,
    rotational_stiffness,
    stored,
)
from app.simulation.errors import SimulationError
from app.simulation.needles import bending_stiffness
from app.simulation.scene import Binding

__all__ = ["AT", "BIN", "energy_bound", "parameters", "rotational_stiffness", "step"]

DECLARATION: Final[dict[str, Any]] = {
    "title": "Side stiffness of layered tissue about the fulcrum",
    "reads": ("axis", "depth", "depth_source", "l_out", "kinematics"),
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
    },
    "energy": (
        "potential",
        "stored energy is never negative; advancing adds none, retreating loses it",
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

    Raises:
        SimulationError: if the layers together are thicker than a metre.
    """
    scene, scale = binding.scene, values["stiffness_scale"]
    ends = np.cumsum([layer.thickness for layer in scene.layers])
    if ends[-1] > _LONGEST:
        raise SimulationError(
            f"the layers are {ends[-1]:g} m thick together; at most {_LONGEST:g} m"
        )
    stiffness = np.array([scale * layer.side_stiffness for layer in scene.layers])
    rigid = binding.model == "winkler"
    flexibility = 0.0 if rigid else 1.0 / bending_stiffness(scene.needle.outer_diameter)
    return empty(ends, stiffness, flexibility, values["shortest_lever"])


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
    depth = min(max(depth, 0.0), parameters[AT.bins] * BIN - 0.5 * BIN)
    change = 0.0
    if depth != parameters[AT.depth]:
        change = -stored(parameters, x, y, z)
        if depth > parameters[AT.depth]:
            advance(parameters, depth, x, y, z)
        else:
            retreat(parameters, depth)
        change += stored(parameters, x, y, z)
    state[sv.POTENTIAL] += stored(parameters, x, y, z)
    state[sv.GAIN_WORK] += change  # by advancing and retreating
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
    state[sv.BENT_LENGTH] += depth


def stored_energy(parameters: FloatArray, axis: FloatArray) -> float:
    """Return U [J] for the needle direction `axis`, shape (3,)."""
    return float(stored(parameters, *axis))


def energy_bound(parameters: FloatArray) -> float:
    """Return the most energy that turning the needle can store [J]: 2 a at the deepest needle.

    With the channel's mean direction m / a, no longer than 1, U is ½ a |n - m / a|² and what the
    channel's own windings hold, which no turning gives back.
    """
    return 2.0 * float(rotational_stiffness(parameters, parameters[AT.bins] * BIN - 0.5 * BIN))
