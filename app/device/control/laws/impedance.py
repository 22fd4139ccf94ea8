"""Impedance control at the tool point P3: the hand meets a mass, a spring and a damper.

The robot's own Coriolis and centrifugal torques are taken away in operational space: with
τ = Jᵀ γ + h - M J⁻¹ J̇ q̇ the motion obeys Λ a = γ + γ_hand, Λ = (J M⁻¹ Jᵀ)⁻¹. Gravity and friction
are the law `compensation`, to be asked for beside it.

Without a force sensor the robot's inertia Λ cannot be made smaller or rounder: feeding back a
scaled inertia makes a port that gives energy out. The wanted inertia is therefore *added*: a
virtual mass m hangs on P3 by a coupling spring and damper, and is drawn to the path's P3 by the
wanted spring K and damper B:

    m z'' = K_c (x - z) + B_c (x' - z') - K (z - x_path) - B z',   γ = -K_c (x - z) - B_c (x' - z'),

solved by the implicit Euler rule, stable for any K and step. Everything in it is passive and
bounded: both springs saturate at F (the mass is dragged along where the coupling would exceed it),
the mass's speed at 1 m/s. What is stored is both springs and ½ m z'².
"""

from collections.abc import Mapping
from math import isfinite, sqrt
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.device.control.law_kernels import STOP_GIVES, no_pose, push, store
from app.device.control.operational_space import velocity_torques
from app.mechanisms.lever import felt_kernel
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.status import OK

DECLARATION: Final[dict[str, Any]] = {
    "title": "Impedance at the tool point: virtual mass, spring and damper",
    "reads": (
        "kinematics",
        "q",
        "qd",
        "p3",
        "p3_v",
        "jacobian",
        "axis",
        "path",
        "l_in",
        "l_out",
        "depth",
        "dt",
        "mass",
        "bias",
        "drift",
    ),
    "writes": ("guide", "force", "joint", "potential", "gain_work"),
    "energy": (
        "active",
        "stores two saturated springs and the motion of a virtual mass, dampers take; moving the"
        " path is counted in gain_work; taking Coriolis torques away can give up to the change of"
        " the robot's own kinetic energy with its pose, within a torque limit",
    ),
    "parameters": {
        "stiffness": (150.0, "N/m", 0.0, 3000.0, "of the spring to the path, at P3"),
        "damping": (2.0, "N·s/m", 0.0, 50.0, "of the virtual mass"),
        "inertia": (0.1, "kg", 0.02, 3.0, "of the virtual mass at P3"),
        "coupling": (600.0, "N/m", 10.0, 5000.0, "stiffness between P3 and the virtual mass"),
        "limit": (3.0, "N", 0.0, 10.0, "largest force of each spring at P3"),
        "coriolis": (1.0, "", 0.0, 1.0, "share of the robot's velocity torques taken away"),
        "torque": (0.05, "N·m", 0.0, 0.2, "largest joint torque for that"),
    },
}

FASTEST: Final = 1.0
"""Largest speed of the virtual mass [m/s]."""

_COUPLING_DAMPS: Final = 0.4  # of 2 sqrt(K_c m)
_FLATTEST: Final = 0.1  # -z of a path below which its P3 is too far away


class _ImpedancePlaces(NamedTuple):
    """Springs, dampers and mass, limits, remote centre [m], and memory."""

    k: int
    b: int
    m: int
    kc: int
    bc: int
    limit: int
    share: int
    torque: int
    fx: int
    fy: int
    fz: int
    started: int = 0
    zx: int = 0
    zy: int = 0
    wx: int = 0
    wy: int = 0
    goal_x: int = 0
    goal_y: int = 0


_AT: Final = numbered(_ImpedancePlaces)


def parameters(values: Mapping[str, float], profile: DeviceProfile) -> FloatArray:
    """Return a fresh parameters array, its memory included."""
    fx, fy, fz = profile.geometry.fulcrum
    return packed(
        _AT,
        k=values["stiffness"],
        b=values["damping"],
        m=values["inertia"],
        kc=values["coupling"],
        bc=_COUPLING_DAMPS * 2.0 * sqrt(values["coupling"] * values["inertia"]),
        limit=values["limit"],
        share=values["coriolis"],
        torque=values["torque"],
        fx=fx,
        fy=fy,
        fz=fz,
    )


def energy_bound(values: Mapping[str, float], profile: DeviceProfile) -> float:
    """Return both springs at their largest in the workspace and the mass at its fastest [J]."""
    limit, coupling = values["limit"], values["coupling"]
    radius = profile.geometry.fulcrum[2] * np.tan(profile.tilt_limit + STOP_GIVES)
    farthest = 2.0 * radius + limit / coupling
    spring = spring_energy(farthest, values["stiffness"], limit)
    moving = 0.5 * values["inertia"] * FASTEST**2
    return float(spring + 0.5 * limit * limit / coupling + moving)


@njit
def spring_energy(stretch: float, stiffness: float, limit: float) -> float:
    """Energy [J] of a spring whose force is min(K s, F)."""
    if stiffness * stretch <= limit:
        return 0.5 * stiffness * stretch * stretch
    return limit * (stretch - 0.5 * limit / stiffness)


@njit
def softened(stretch: float, stiffness: float, limit: float) -> float:
    """Stiffness in effect [N/m] of such a spring at a stretch."""
    return stiffness if stiffness * stretch <= limit else limit / stretch


@njit
def _move(p: FloatArray, h: float, x: float, y: float, vx: float, vy: float) -> None:
    """Move the virtual mass by one step, and drag it where the coupling would be too strong."""
    ex, ey = p[_AT.zx] - p[_AT.goal_x], p[_AT.zy] - p[_AT.goal_y]
    k = softened(sqrt(ex * ex + ey * ey), p[_AT.k], p[_AT.limit])
    mass = p[_AT.m] + h * (p[_AT.bc] + p[_AT.b]) + h * h * (p[_AT.kc] + k)
    wx = (p[_AT.m] * p[_AT.wx] + h * (p[_AT.kc] * (x - p[_AT.zx]) + p[_AT.bc] * vx - k * ex)) / mass
    wy = (p[_AT.m] * p[_AT.wy] + h * (p[_AT.kc] * (y - p[_AT.zy]) + p[_AT.bc] * vy - k * ey)) / mass
    speed = sqrt(wx * wx + wy * wy)
    if speed > FASTEST:
        wx, wy = wx * FASTEST / speed, wy * FASTEST / speed
    p[_AT.wx], p[_AT.wy] = (wx, wy) if speed > 1e-12 else (0.0, 0.0)
    zx, zy = p[_AT.zx] + h * wx, p[_AT.zy] + h * wy
    sx, sy = zx - x, zy - y
    stretch, most = sqrt(sx * sx + sy * sy), p[_AT.limit] / p[_AT.kc]
    if stretch > most:
        zx, zy = x + sx * most / stretch, y + sy * most / stretch
    p[_AT.zx], p[_AT.zy] = zx, zy


@njit
def _energy(p: FloatArray, x: float, y: float, goal_x: float, goal_y: float) -> float:
    ex, ey = p[_AT.zx] - goal_x, p[_AT.zy] - goal_y
    sx, sy = x - p[_AT.zx], y - p[_AT.zy]
    moving = 0.5 * p[_AT.m] * (p[_AT.wx] * p[_AT.wx] + p[_AT.wy] * p[_AT.wy])
    coupled = 0.5 * p[_AT.kc] * (sx * sx + sy * sy)
    return moving + coupled + spring_energy(sqrt(ex * ex + ey * ey), p[_AT.k], p[_AT.limit])


@njit
def _coupling_force(p: FloatArray, x: float, y: float, vx: float, vy: float) -> tuple[float, float]:
    """Force at P3 [N]: the coupling's spring and as much of its damper as the limit leaves."""
    fx, fy = p[_AT.kc] * (p[_AT.zx] - x), p[_AT.kc] * (p[_AT.zy] - y)
    bx, by = p[_AT.bc] * (p[_AT.wx] - vx), p[_AT.bc] * (p[_AT.wy] - vy)
    damping = sqrt(bx * bx + by * by)
    room = p[_AT.limit] - sqrt(fx * fx + fy * fy)
    share = min(1.0, max(room, 0.0) / damping) if damping > 0.0 else 0.0
    return fx + share * bx, fy + share * by


@njit
def _take_coriolis_away(state: FloatArray, p: FloatArray) -> None:
    t1, t2 = velocity_torques(state)
    t1, t2 = p[_AT.share] * t1, p[_AT.share] * t2
    largest = max(abs(t1), abs(t2))
    if not isfinite(largest):
        return  # the distal links are in line
    scale = p[_AT.torque] / largest if largest > p[_AT.torque] else 1.0
    state[sv.JOINT_LEFT] += scale * t1
    state[sv.JOINT_RIGHT] += scale * t2


@stage
def step(state: FloatArray, p: FloatArray) -> None:
    """Add the force at the hub that the coupling's force at P3 is, and the torques."""
    px, py, pz = state[sv.PATH_X], state[sv.PATH_Y], state[sv.PATH_Z]
    length = sqrt(px * px + py * py + pz * pz)
    x, y, vx, vy = state[sv.P3_X], state[sv.P3_Y], state[sv.P3_VX], state[sv.P3_VY]
    fine = state[sv.KINEMATICS] == OK and not no_pose(state) and isfinite(x + y + vx + vy)
    if not (fine and -pz > _FLATTEST * length and isfinite(length)):
        p[_AT.started] = 0.0
        return
    fall = p[_AT.fz] / pz
    goal_x, goal_y = p[_AT.fx] - fall * px, p[_AT.fy] - fall * py
    if p[_AT.started] == 0.0:
        p[_AT.started] = 1.0
        p[_AT.zx], p[_AT.zy], p[_AT.wx], p[_AT.wy] = x, y, 0.0, 0.0
        p[_AT.goal_x], p[_AT.goal_y] = goal_x, goal_y
        gained = _energy(p, x, y, goal_x, goal_y)
    else:
        gained = _energy(p, x, y, goal_x, goal_y) - _energy(p, x, y, p[_AT.goal_x], p[_AT.goal_y])
        p[_AT.goal_x], p[_AT.goal_y] = goal_x, goal_y
    h = state[sv.DT] if state[sv.DT] > 0.0 else 0.0
    _move(p, min(h, 0.005), x, y, vx, vy)
    stored = _energy(p, x, y, goal_x, goal_y)
    store(state, stored, stored - gained)
    gx, gy = _coupling_force(p, x, y, vx, vy)
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    fx, fy, fz = felt_kernel(gx, gy, dx, dy, dz, state[sv.L_IN], state[sv.L_OUT])
    push(state, fx, fy, fz)
    if p[_AT.share] > 0.0:
        _take_coriolis_away(state, p)
