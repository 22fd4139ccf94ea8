"""The needle drags its target along: tissue that the tip pushes moves, and with it what is near.

    shift = d̂ · α exp(-r / λ) · w,   r = distance of the straight needle's tip from the target,

w is how far the tissue at the tip gives way; it settles with a time constant, so that a puncture
moves the target quickly but without a jump. Targets in the liver moved by 6.4 ± 3.9 mm while a
needle went in (robot study of the Hebrew University of Jerusalem); α and λ are estimates that give
some millimetres near the tip.

Models. `membrane`: w is the dimple of what is not yet punctured (INDENTATION). `drag`: w is how far
the layer at the tip gives way to the whole force along the needle, a₁ w + a₂ w² = |F|, so that
friction drags the target along too, in both directions. In a scene with a field the layer is the
tissue of the field at the tip.

It has no force of its own.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import numbered, packed
from app.simulation.along_needle import approach, keep_memory, tissue_row, tissue_rows
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "The target gives way to the needle",
    "reads": (
        "axis",
        "tip",
        "target",
        "depth",
        "plant_depth",
        "dt",
        "kinematics",
        "indentation",
        "axial_force",
    ),
    "writes": ("target_shift",),
    "consumers": ("view target_motion", "score of tip to target"),
    "needs": ("layers",),
    "models": {
        "membrane": "moves with the dimple of what is not yet punctured",
        "drag": "moves with all that the needle pushes along its axis, friction too",
    },
    "model_reads": {"drag": ("tissue",)},
    "energy": ("dissipative", "it moves the target and has no force of its own"),
    "cost_class": "A",
    "parameters": {
        "share": (0.7, "-", 0.0, 1.0, "of the tissue's motion at the tip that a target there has"),
        "reach": (0.04, "m", 0.001, 0.5, "distance over which it falls to 37 %"),
        "settling": (0.02, "s", 0.001, 1.0, "time constant of the motion"),
        "furthest": (0.01, "m", 0.0, 0.1, "that tissue gives way at most"),
    },
    "published": {
        "furthest": (
            0.0014,
            0.0103,
            "targets moved 6.4 ± 3.9 mm in the liver, 3.5 ± 2.1 mm behind the peritoneum: robot"
            " study of the Hebrew University of Jerusalem",
            (0.0064, 0.0035),
        ),
    },
}


class _DimplingPlaces(NamedTuple):
    """Constants, how many layers follow; then how far the tissue has given way [m].

    `drag` is 2 where tissue is looked up in a field.
    """

    slot: int
    drag: int
    share: int
    reach: int
    settling: int
    furthest: int
    layers: int
    given: int = 0


_AT: Final = numbered(_DimplingPlaces)
_ROW: Final = 3  # depth of its end [m], a₁ [N/m], a₂ [N/m²]


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: tissue at rest."""
    rows = tissue_rows(binding, "indentation_stiffness", "indentation_hardening")
    return packed(
        _AT,
        rows.ravel(),
        slot=binding.depth_slot,
        drag=float(binding.model == "drag") * (1.0 + float(binding.scene.has_field)),
        share=values["share"],
        reach=values["reach"],
        settling=values["settling"],
        furthest=values["furthest"],
        layers=len(rows),
    )


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model from where the target is."""
    keep_memory(_AT, old, new)


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the displacement of the target to TARGET_SHIFT_*; nothing without valid kinematics."""
    p, dt = parameters, state[sv.DT]
    depth, way = state[int(p[_AT.slot])], state[sv.INDENTATION]
    if p[_AT.drag] > 0.0:
        force = state[sv.AXIAL_FORCE]
        count, by_field = int(p[_AT.layers]), p[_AT.drag] - 1.0
        at = tissue_row(p, state, len(_AT), _ROW, count, by_field, depth - way)
        linear, quadratic = p[at + 1], p[at + 2]
        slope = linear + np.sqrt(linear * linear + 4.0 * quadratic * abs(force))
        way = 2.0 * force / slope if slope > 0.0 and depth > 0.0 else 0.0
    if np.isfinite(way) and dt > 0.0:
        way = min(max(way, -p[_AT.furthest]), p[_AT.furthest])
        p[_AT.given] = approach(p[_AT.given], way, dt / p[_AT.settling])
    square = 0.0
    for i in range(3):
        off = state[sv.TARGET_X + i] - state[sv.TIP_X + i]
        square += off * off
    moved = p[_AT.share] * np.exp(-np.sqrt(square) / p[_AT.reach]) * p[_AT.given]
    x, y, z = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    if state[sv.KINEMATICS] != 0.0 or not np.isfinite(moved + x + y + z):
        return
    state[sv.TARGET_SHIFT_X] += moved * x
    state[sv.TARGET_SHIFT_Y] += moved * y
    state[sv.TARGET_SHIFT_Z] += moved * z
