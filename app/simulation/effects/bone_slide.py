"""Bone turns the tip aside: met at a slant, its surface pushes the tip along.

The push across the needle that `bone_contact` says (BONE_PUSH) acts on the tip, a depth d beyond
the fulcrum; at the hub, L_out on the other side, that is

    F = -BONE_PUSH d / L_out.

What presses the tip on bone is the hand's own push along the needle, so what is given back here
came in there: with the work of `bone_contact` along the needle a closed way gives out nothing. By
itself it is declared active. A device without a port along the needle takes none in, and gives
none back: where the hand is real, nothing is added.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import numbered, packed
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Bone turns the tip aside",
    "reads": ("bone_push", "plant_depth", "l_out", "kinematics"),
    "writes": ("force",),
    "consumers": ("device axis lateral", "score of felt force"),
    "needs": ("bones", "field"),
    "models": {"lever": "the push on the tip by the lever about the fulcrum"},
    "energy": ("active", "gives back what the push along the needle stored"),
    "cost_class": "A",
    "parameters": {
        "shortest_lever": (0.02, "m", 0.005, 0.2, "L_out below which the force stops growing"),
    },
}


class _SlidePlaces(NamedTuple):
    """Slot of the depth, the shortest lever [m]; 1 where it acts."""

    slot: int
    lever: int
    acts: int


_AT: Final = numbered(_SlidePlaces)


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters."""
    return packed(
        _AT,
        slot=binding.depth_slot,
        lever=values["shortest_lever"],
        acts=float(binding.depth_slot == sv.PLANT_DEPTH),
    )


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the push on the tip to FORCE_*, as it is felt at the hub."""
    p = parameters
    x, y, z = state[sv.BONE_PUSH_X], state[sv.BONE_PUSH_Y], state[sv.BONE_PUSH_Z]
    scale = -max(state[int(p[_AT.slot])], 0.0) / max(state[sv.L_OUT], p[_AT.lever])
    if p[_AT.acts] == 0.0 or state[sv.KINEMATICS] != 0.0 or not np.isfinite(scale * (x + y + z)):
        return
    state[sv.FORCE_X] += scale * x
    state[sv.FORCE_Y] += scale * y
    state[sv.FORCE_Z] += scale * z
