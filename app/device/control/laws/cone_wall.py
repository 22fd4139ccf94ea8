"""A wall before the ball joint's stop: pushes the needle back inside the cone that it may lean in.

With δ the tilt beyond (limit - margin), the spring pushes the hub inwards by min(K δ, F); its
potential is V = L_out ∫ min(K δ, F) dδ. A damper beside it grows with δ, so that nothing jumps at
the wall's face; together they never pull outwards. A device that cannot push along the needle can
have no wall in depth.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import numbered, packed
from app.device.control.law_kernels import (
    HALF_PI,
    STOP_GIVES,
    across_kernel,
    hub_velocity,
    longest_lever,
    no_pose,
    push,
    spring_kernel,
    store,
)
from app.mechanisms.profile import DeviceProfile

DECLARATION: Final[dict[str, Any]] = {
    "title": "Wall before the tilt limit",
    "reads": ("axis", "l_out", "depth", "hub_v"),
    "writes": ("guide", "force", "potential", "gain_work"),
    "energy": (
        "potential",
        "stores L_out times the integral of its spring over the tilt inside the wall, damps beside"
        " it; sliding the needle changes it, counted in gain_work",
    ),
    "parameters": {
        "stiffness": (60.0, "N/rad", 0.0, 1000.0, "at the hub, inside the wall"),
        "damping": ("fixture.damping", "N·s/m", 0.0, 20.0, "of the hub's motion, at full depth"),
        "margin": (0.052, "rad", 0.005, 0.3, "where the wall begins before the joint's limit"),
        "limit": ("limits.hand_force", "N", 0.0, 5.0, "largest force of this law"),
    },
}


class _ConeWallPlaces(NamedTuple):
    """Strength and place of the wall, and L_out of the last tick."""

    stiffness: int
    damping: int
    margin: int
    limit: int
    face: int
    last_l_out: int = 0


_AT: Final = numbered(_ConeWallPlaces)


def parameters(values: Mapping[str, float], profile: DeviceProfile) -> FloatArray:
    """Return a fresh parameters array, its memory included."""
    return packed(
        _AT,
        stiffness=values["stiffness"],
        damping=values["damping"],
        margin=values["margin"],
        limit=values["limit"],
        face=profile.tilt_limit - values["margin"],
    )


def energy_bound(values: Mapping[str, float], profile: DeviceProfile) -> float:
    """Return the potential where the joint's stop has yielded as far as it does [J]."""
    deepest = values["margin"] + STOP_GIVES
    stored = spring_kernel(deepest, values["stiffness"], values["limit"])[1]
    return float(longest_lever(profile) * stored)


@stage
def step(state: FloatArray, p: FloatArray) -> None:
    """Add the wall's force and energy."""
    if no_pose(state):
        return
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    ax, ay, az, tilt = across_kernel(dx, dy, dz, 0.0, 0.0, -1.0)
    depth = tilt - p[_AT.face]
    size = (ax * ax + ay * ay + az * az) ** 0.5
    if not (depth > 0.0 and size > 0.0):
        p[_AT.last_l_out] = 0.0
        return
    depth = min(depth, HALF_PI)
    stored = spring_kernel(depth, p[_AT.stiffness], p[_AT.limit])[1]
    store(state, stored * state[sv.L_OUT], stored * p[_AT.last_l_out])
    p[_AT.last_l_out] = state[sv.L_OUT]
    # The hub leans the other way than the tip: minus the vertical's part across is inwards.
    nx, ny, nz = -ax / size, -ay / size, -az / size
    vx, vy, vz = hub_velocity(state)
    outwards = -(vx * nx + vy * ny + vz * nz)
    damper = p[_AT.damping] * min(1.0, depth / p[_AT.margin])
    force = min(p[_AT.stiffness] * depth, p[_AT.limit]) + damper * outwards
    force = min(max(force, 0.0), p[_AT.limit])
    push(state, force * nx, force * ny, force * nz)
