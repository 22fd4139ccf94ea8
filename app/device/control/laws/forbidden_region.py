"""A region that the needle must not enter: pushes the shaft aside before it gets there.

The region is a capsule in world coordinates (a sphere if both ends are the same). The needle is
the shaft inside the body, from the fulcrum to the tip, and `ahead` of it in the direction it
points. With r the distance of the two, R = radius + margin, and t the distance from the fulcrum to
the nearest point of the shaft, the potential is

    V = L_out c (1 - r²/R²)³,   c = F R / (1.717 T),   T the largest t there is,

and the force at the hub F_u = -(t/L_out) f, f = -∂V/∂x at that point, across the needle: the
fulcrum turns directions round. |F_u| <= F everywhere; on the region's axis, where no direction is
better than another, it is zero, and it fades to that continuously. This device cannot push along
the needle: a shaft that points at the axis is not held back.
"""

from collections.abc import Mapping
from math import sqrt
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import numbered, packed
from app.device.control.law_kernels import (
    damper_share,
    hub_velocity,
    longest_lever,
    no_pose,
    push,
    speed_fade,
    store,
)
from app.device.errors import LawError
from app.mechanisms.profile import DeviceProfile

DECLARATION: Final[dict[str, Any]] = {
    "title": "Region that the needle must not enter",
    "reads": ("axis", "l_out", "depth", "hub_v"),
    "writes": ("guide", "force", "potential", "gain_work"),
    "energy": (
        "potential",
        "stores L_out c (1 - r²/R²)³, r the distance of shaft and region's axis; damps inside;"
        " sliding the needle changes it, counted in gain_work",
    ),
    "parameters": {
        "from_x": (None, "m", -1.0, 1.0, "one end of the capsule's axis, in world"),
        "from_y": (None, "m", -1.0, 1.0, "one end"),
        "from_z": (None, "m", -1.0, 1.0, "one end"),
        "to_x": (None, "m", -1.0, 1.0, "the other end; the same for a sphere"),
        "to_y": (None, "m", -1.0, 1.0, "the other end"),
        "to_z": (None, "m", -1.0, 1.0, "the other end"),
        "radius": (0.008, "m", 0.001, 0.1, "of the region"),
        "margin": (0.006, "m", 0.001, 0.05, "around it in which the force begins"),
        "ahead": (0.02, "m", 0.0, 0.1, "of the tip that counts as shaft"),
        "force": (3.0, "N", 0.0, 5.0, "largest force at the hub"),
        "damping": ("fixture.damping", "N·s/m", 0.0, 20.0, "of the hub's motion, deep inside"),
        "fade_from": (0.05, "m/s", 0.0, 1.0, "speed along the force from which it fades"),
        "fade_to": (0.20, "m/s", 0.0, 1.0, "speed at which it has ended"),
    },
}


class _ForbiddenRegionPlaces(NamedTuple):
    """Capsule seen from the fulcrum (start s, axis b), strength, and memory."""

    sx: int
    sy: int
    sz: int
    bx: int
    by: int
    bz: int
    reach: int
    scale: int
    ahead: int
    limit: int
    damping: int
    fade_from: int
    fade_to: int
    last_l_out: int = 0
    last_depth: int = 0


_AT: Final = numbered(_ForbiddenRegionPlaces)

_STEEPEST: Final = 96.0 / (25.0 * sqrt(5.0))
"""Largest slope of (1 - x²)³, at x = 1/sqrt(5)."""


def parameters(values: Mapping[str, float], profile: DeviceProfile) -> FloatArray:
    """Return a fresh parameters array, its memory included.

    Raises:
        LawError: if the region lies on the entry, or its axis points at it.
    """
    start, axis = _placed(values, profile)
    return packed(
        _AT,
        sx=start[0],
        sy=start[1],
        sz=start[2],
        bx=axis[0],
        by=axis[1],
        bz=axis[2],
        reach=values["radius"] + values["margin"],
        scale=_scale(values, start, axis),
        ahead=values["ahead"],
        limit=values["force"],
        damping=values["damping"],
        fade_from=values["fade_from"],
        fade_to=values["fade_to"],
    )


def energy_bound(values: Mapping[str, float], profile: DeviceProfile) -> float:
    """Return the potential on the region's axis, the needle drawn out as far as it may be [J]."""
    return longest_lever(profile) * _scale(values, *_placed(values, profile))


def _scale(values: Mapping[str, float], start: FloatArray, axis: FloatArray) -> float:
    """Potential on the axis per lever [J/m], so that no force at the hub is above the limit."""
    reach = values["radius"] + values["margin"]
    farthest = max(float(np.linalg.norm(start)), float(np.linalg.norm(start + axis))) + reach
    return values["force"] * reach / (_STEEPEST * farthest)


def _placed(values: Mapping[str, float], profile: DeviceProfile) -> tuple[FloatArray, FloatArray]:
    """Return the capsule's start seen from the fulcrum, and its axis [m]."""
    ends = np.array([[values[f"{end}_{i}"] for i in "xyz"] for end in ("from", "to")])
    start, axis = ends[0] - profile.fulcrum, ends[1] - ends[0]
    reach, square = values["radius"] + values["margin"], float(axis @ axis)
    share = float(np.clip(-(start @ axis) / square, 0.0, 1.0)) if square > 0.0 else 0.0
    distance = float(np.linalg.norm(start + share * axis))
    if distance < reach:
        raise LawError(
            sentence(
                "law 'forbidden_region': the region with its margin reaches {reach:.1f} mm from"
                " its axis, and the entry lies {distance:.1f} mm from it; move it or make it"
                " smaller",
                reach=reach * 1e3,
                distance=distance * 1e3,
            )
        )
    if square > 0.0 and float(np.linalg.norm(np.cross(start, axis))) < reach * sqrt(square):
        raise LawError(
            sentence(
                "law 'forbidden_region': the region's axis points at the entry, so that a needle "
                "along it has no nearest point; turn the axis across the path or give a sphere"
            )
        )
    return start, axis


@njit
def nearest_kernel(
    sx: float,
    sy: float,
    sz: float,
    dx: float,
    dy: float,
    dz: float,
    length: float,
    bx: float,
    by: float,
    bz: float,
) -> tuple[float, float]:
    """Nearest points of the segment t d, 0 <= t <= length, and s + u b, 0 <= u <= 1: (t, u).

    `d` is a unit vector, `s` the start of the other segment seen from the first one's; `b` may be
    zero. The answer is unique, and moves without a jump, unless the two are parallel.
    """
    bb = bx * bx + by * by + bz * bz
    bd = bx * dx + by * dy + bz * dz
    sd = sx * dx + sy * dy + sz * dz
    sb = sx * bx + sy * by + sz * bz
    across = bb - bd * bd  # |d x b|²
    u = 0.0
    if across > 1e-12 * bb:
        u = min(max((sd * bd - sb) / across, 0.0), 1.0)
    t = sd + u * bd
    if t < 0.0:
        t = 0.0
        u = min(max(-sb / bb, 0.0), 1.0) if bb > 0.0 else 0.0
    elif t > length:
        t = length
        u = min(max((t * bd - sb) / bb, 0.0), 1.0) if bb > 0.0 else 0.0
    return t, u


@njit
def region_kernel(
    dx: float, dy: float, dz: float, depth: float, p: FloatArray
) -> tuple[float, float, float, float, float]:
    """Force at the hub [N] and potential per lever [J/m], damper's share: (fx, fy, fz, V, w)."""
    length = max(0.0, depth + p[_AT.ahead])
    t, u = nearest_kernel(
        p[_AT.sx], p[_AT.sy], p[_AT.sz], dx, dy, dz, length, p[_AT.bx], p[_AT.by], p[_AT.bz]
    )
    x = t * dx - p[_AT.sx] - u * p[_AT.bx]
    y = t * dy - p[_AT.sy] - u * p[_AT.by]
    z = t * dz - p[_AT.sz] - u * p[_AT.bz]
    square = p[_AT.reach] * p[_AT.reach]
    rest = 1.0 - (x * x + y * y + z * z) / square
    if not rest > 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    along = x * dx + y * dy + z * dz
    pull = -6.0 * p[_AT.scale] * t / square * rest * rest
    return (
        pull * (x - along * dx),
        pull * (y - along * dy),
        pull * (z - along * dz),
        p[_AT.scale] * rest * rest * rest,
        rest * rest,
    )


@stage
def step(state: FloatArray, p: FloatArray) -> None:
    """Add the region's force and energy."""
    if no_pose(state):
        return
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    l_out, depth = state[sv.L_OUT], state[sv.DEPTH]
    fx, fy, fz, stored, inside = region_kernel(dx, dy, dz, depth, p)
    before = stored
    if depth != p[_AT.last_depth]:
        before = region_kernel(dx, dy, dz, p[_AT.last_depth], p)[3]
    store(state, stored * l_out, before * p[_AT.last_l_out])
    p[_AT.last_l_out], p[_AT.last_depth] = l_out, depth
    if inside == 0.0:
        return
    vx, vy, vz = hub_velocity(state)
    size = sqrt(fx * fx + fy * fy + fz * fz)
    if size > 0.0:
        fade = speed_fade((vx * fx + vy * fy + vz * fz) / size, p[_AT.fade_from], p[_AT.fade_to])
        fx, fy, fz = fade * fx, fade * fy, fade * fz
    damper = -inside * p[_AT.damping]
    bx, by, bz = damper * vx, damper * vy, damper * vz
    share = damper_share(fx, fy, fz, bx, by, bz, p[_AT.limit])
    push(state, fx + share * bx, fy + share * by, fz + share * bz)
