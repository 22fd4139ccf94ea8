"""Rib or bone: where a rigid layer begins, the needle stops.

A spring-damper (k, b) that only pushes, on the mass m that slides along the needle. The force of a
tick is the mean of what the mass would feel in one tick of h₀ from where it is and as fast as it
goes, so its coefficients are two constants, made when the scene is compiled:

    F = max(0, A x + B v),   x = depth beyond the surface, v the speed inwards.

Models. `exact`: with Φ = exp([[0, 1], [-k/m, -b/m]] h₀), A = -m Φ₂₁ / h₀, B = m (1 - Φ₂₂) / h₀.
`implicit`: linearly implicit Euler, A = k / N, B = (b + h₀ k) / N, N = 1 + h₀ b/m + h₀² k/m. Both
stay finite for any k, and k is capped at m / h₀², the stiffest that a tick can tell.

BONE_CONTACT is 1 while the tip is beyond the surface.

`field` meets bone where the patient's field has it, at its surface with its normal n (into the
bone). The surface is the plane that WALL says, followed while the tip is near it, kept while the
tip is deeper. With x the tip's distance beyond it and v the speed of the tip into it, F is the same
law; what of it acts along the needle, F n·d, is felt there, and what acts across pushes the tip
along the surface (BONE_PUSH, which the effect `bone_slide` brings to the hand), without friction on
it, none having been measured: so both together store A x²/2 and give back no more. A hand whose
device has no port along the needle cannot be stopped: the needle is as deep as it is measured, and
BONE_CROSSED says how far that is beyond the surface along the needle, whatever has been passed on
the way.

Energy: A x²/2 is stored; the damping part only takes, since it never makes the bone pull.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.simulation.along_needle import keep_memory, smoothed_speed, smoothing_of
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Contact of the tip with bone",
    "reads": ("depth", "plant_depth", "dt"),
    "writes": ("axial_force", "bone_contact", "bone_crossed", "bone_push"),
    "consumers": ("device axis axial", "simulated hand", "view force_gauge", "score"),
    "needs": ("bones",),
    "models": {
        "exact": "spring-damper on the sliding mass, exact over a tick",
        "implicit": "the same by linearly implicit Euler; a little softer",
        "field": "as exact, on the surface of bone in the patient's field; the tip slides along it",
    },
    "model_reads": {"field": ("tissue", "wall", "wall_normal", "axis", "tip", "kinematics")},
    "energy": (
        "potential",
        "stores A x²/2 beyond the surface; its damping and the tip's friction only take",
    ),
    "cost_class": "A",
    "parameters": {
        "stiffness": (40e3, "N/m", 100.0, 5e5, "of the bone; capped at mass / tick²"),
        "damping": (10.0, "N·s/m", 0.0, 200.0, "of the contact"),
        "mass": (0.05, "kg", 0.005, 5.0, "that slides along the needle"),
        "tick": (0.001, "s", 0.0001, 0.005, "step that the force is made for"),
        "speed_smoothing": (0.03, "s", 0.0, 1.0, "time constant of a measured depth's speed"),
    },
}


class _BonePlaces(NamedTuple):
    """Depth of the surface [m], A [N/m], B [N·s/m]; then the depth before and its speed."""

    slot: int
    surface: int
    stiffness: int
    damping: int
    smoothing: int
    depth: int = 0
    speed: int = 0


class _PlanePlaces(NamedTuple):
    """Of a field, behind these: how many tissues; then the surface that is touched.

    `touches` is 1 while there is one: its normal, and how far along it the straight needle's tip
    touched it [m]. Whether each tissue is rigid follows.
    """

    codes: int
    touches: int = 0
    x: int = 0
    y: int = 0
    z: int = 0
    at: int = 0


_AT: Final = numbered(_BonePlaces)
_ON: Final = numbered(_PlanePlaces, len(_AT))
_STRONGEST: Final = 50.0  # [N] far beyond any hand
_EDGE: Final = 0.001  # [m] deeper than this beyond a surface the tip did not slide off it
_FLAT: Final = 0.2  # least cosine between needle and normal by which ways along it are told


def coefficients(
    model: str, stiffness: float, damping: float, mass: float, tick: float
) -> tuple[float, float]:
    """Return A [N/m] and B [N·s/m], see the top of the file; the stiffness is capped."""
    k, b = min(stiffness, mass / tick**2), damping
    if model == "implicit":
        n = 1.0 + tick * b / mass + tick * tick * k / mass
        return k / n, (b + tick * k) / n
    from scipy.linalg import expm  # 0.2 s to import, and only where there is bone

    transition = expm(np.array([[0.0, 1.0], [-k / mass, -b / mass]]) * tick)
    return -mass * transition[1, 0] / tick, mass * (1.0 - transition[1, 1]) / tick


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh array of parameters: needle at rest, outside.

    Where the scene has no field, `field` is `exact`.
    """
    surface = np.inf
    depth = 0.0
    for layer in binding.scene.layers:
        surface = min(surface, depth) if layer.rigid else surface
        depth += layer.thickness
    given = (values[name] for name in ("stiffness", "damping", "mass", "tick"))
    stiffness, damping = coefficients(binding.model, *given)
    behind = list[FloatArray]()
    if binding.model == "field" and binding.scene.has_field:
        rigid = np.array([float(tissue.rigid) for tissue in binding.scene.tissues])
        behind = [packed(_ON, rigid, codes=len(rigid))]
    return packed(
        _AT,
        *behind,
        slot=binding.depth_slot,
        surface=surface,
        stiffness=stiffness,
        damping=damping,
        smoothing=smoothing_of(binding, values["speed_smoothing"]),
        depth=np.nan,
    )


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model from where the tip is."""
    keep_memory(_AT, old, new)
    new[_AT.speed] = 0.0 if (len(old) > len(_AT)) != (len(new) > len(_AT)) else new[_AT.speed]


@njit
def _beyond(state: FloatArray, p: FloatArray, tip: Any) -> float:
    """Return how far the tip is beyond the surface that it touches [m]; 0 where it touches none.

    By what lies about it now.
    """
    code, wall = state[sv.TISSUE], state[sv.WALL]
    rigid = 0.0 <= code < p[_ON.codes] and p[len(_AT) + len(_ON) + int(code)] > 0.0
    x, y, z = state[sv.WALL_X], state[sv.WALL_Y], state[sv.WALL_Z]
    if rigid and wall < 0.0 and np.isfinite(wall + x + y + z):
        along = x * state[sv.AXIS_X] + y * state[sv.AXIS_Y] + z * state[sv.AXIS_Z]
        if along > 0.0:
            p[_ON.touches], p[_ON.x], p[_ON.y], p[_ON.z] = 1.0, x, y, z
            p[_ON.at] = tip[0] * x + tip[1] * y + tip[2] * z + wall * along
            return -wall * along
    if p[_ON.touches] == 0.0:
        return 0.0
    beyond = tip[0] * p[_ON.x] + tip[1] * p[_ON.y] + tip[2] * p[_ON.z] - p[_ON.at]
    if beyond <= 0.0 or (not rigid and beyond < _EDGE):
        p[_ON.touches] = 0.0
        return 0.0
    return beyond


@njit
def _press(state: FloatArray, p: FloatArray) -> None:
    """Meet bone in a field: add to AXIAL_FORCE, write BONE_CONTACT, BONE_CROSSED, BONE_PUSH."""
    further = state[int(p[_AT.slot])] - state[sv.DEPTH]
    ax, ay, az = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    tip = (
        state[sv.TIP_X] + further * ax,
        state[sv.TIP_Y] + further * ay,
        state[sv.TIP_Z] + further * az,
    )
    if state[sv.KINEMATICS] != 0.0 or not np.isfinite(tip[0] + tip[1] + tip[2] + ax + ay + az):
        return
    beyond = _beyond(state, p, tip)
    before = 0.0 if np.isnan(p[_AT.depth]) else p[_AT.depth]
    p[_AT.depth] = beyond
    if beyond <= 0.0:
        p[_AT.speed] = 0.0
        return
    speed = smoothed_speed(p[_AT.speed], beyond - before, state[sv.DT], p[_AT.smoothing])
    p[_AT.speed] = speed
    force = p[_AT.stiffness] * beyond + p[_AT.damping] * speed
    force = min(max(force, 0.0), _STRONGEST)
    along = ax * p[_ON.x] + ay * p[_ON.y] + az * p[_ON.z]
    state[sv.AXIAL_FORCE] += force * max(along, 0.0)
    state[sv.BONE_CONTACT] = 1.0
    state[sv.BONE_CROSSED] = beyond / max(along, _FLAT)
    x, y, z = p[_ON.x] - along * ax, p[_ON.y] - along * ay, p[_ON.z] - along * az
    state[sv.BONE_PUSH_X] -= force * x
    state[sv.BONE_PUSH_Y] -= force * y
    state[sv.BONE_PUSH_Z] -= force * z


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the force of the bone to AXIAL_FORCE; write BONE_CONTACT."""
    if len(parameters) > len(_AT):
        _press(state, parameters)
        return
    depth, p = state[int(parameters[_AT.slot])], parameters
    if not np.isfinite(depth):
        depth = p[_AT.depth]
    if np.isnan(depth):
        return
    if np.isnan(p[_AT.depth]):
        p[_AT.depth] = depth
    travel = depth - p[_AT.depth]
    p[_AT.depth] = depth
    p[_AT.speed] = smoothed_speed(p[_AT.speed], travel, state[sv.DT], p[_AT.smoothing])
    beyond = depth - p[_AT.surface]
    if beyond <= 0.0:
        return
    force = p[_AT.stiffness] * beyond + p[_AT.damping] * p[_AT.speed]
    state[sv.AXIAL_FORCE] += min(max(force, 0.0), _STRONGEST)
    state[sv.BONE_CONTACT] = 1.0
    state[sv.BONE_CROSSED] = beyond


def axial_energy_bound(parameters: FloatArray) -> float:
    """Return the most that it can hold [J]: pushed with more than any hand has."""
    return float(0.5 * _STRONGEST**2 / parameters[_AT.stiffness])
