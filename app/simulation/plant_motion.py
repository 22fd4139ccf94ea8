"""One substep of the simulated robot: across the needle (joints) and along it."""

from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.dynamic_model import A1, A2, BASE, COULOMB, FX, FY, FZ, VISCOUS
from app.mechanisms.pantograph.dynamics import axial_load_kernel, dynamics_kernel
from app.mechanisms.pantograph.kernels import axis_kernel, forward_kernel, jacobian_kernel
from app.simulation.plant_hand import axial_spring, hand_at_tool, stop_at_tool
from app.simulation.plant_layout import AT, MODEL, SHORTEST_LEVER, Pose

_SPEED: Final = 50.0  # [rad/s]
_SNAP: Final = 1e-12  # slower than this is at rest: subnormal numbers cost 20 times more
_ROUNDS: Final = 40  # of joints that may stick; each leaves at most a quarter of the error


@njit
def pose_of(p: FloatArray, q1: float, q2: float) -> Pose:
    """Tool point and Jacobian: (ok, x, y, jxl, jxr, jyl, jyr)."""
    status, x, y = forward_kernel(q1, q2, p[A1], p[A2], p[BASE], 1.0)
    if status != 0:
        return False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    status, jxl, jxr, jyl, jyr = jacobian_kernel(q1, q2, x, y, p[A1], p[A2], p[BASE])
    return status == 0, x, y, jxl, jxr, jyl, jyr


@njit
def _slower(impulse: float, most: float) -> float:
    """Return what dry friction of at most `most` leaves of an impulse."""
    return impulse - most if impulse > most else (impulse + most if impulse < -most else 0.0)


@njit
def dry(
    a11: float, a12: float, a22: float, b1: float, b2: float, v1: float, v2: float, most: float
) -> tuple[float, float]:
    """Speeds of A v = b - λ, λ the impulse of dry friction of each joint: (v1, v2).

    |λ| ≤ most; a joint that moves has it whole, against its motion; one that it can hold rests.
    `v1` and `v2` on entry are the speeds before: where the signs stay, the answer is direct.
    """
    determinant = a11 * a22 - a12 * a12
    s1 = most if v1 > 0.0 else -most
    s2 = most if v2 > 0.0 else -most
    u1 = (a22 * (b1 - s1) - a12 * (b2 - s2)) / determinant
    u2 = (a11 * (b2 - s2) - a12 * (b1 - s1)) / determinant
    if most == 0.0 or (u1 * s1 > 0.0 and u2 * s2 > 0.0):
        return u1, u2
    for _ in range(_ROUNDS):
        u1 = _slower(b1 - a12 * v2, most) / a11
        u2 = _slower(b2 - a12 * u1, most) / a22
        if abs(u1 - v1) + abs(u2 - v2) <= _SNAP:
            break
        v1, v2 = u1, u2
    return u1, u2


@njit
def swing(
    state: FloatArray,
    p: FloatArray,
    h: float,
    t1: float,
    t2: float,
    holds: bool,
    wx: float,
    wy: float,
    wz: float,
    pose: Pose,
) -> Pose:
    """One substep sideways: solve (M + h D + h² K) q̇⁺ = M q̇ + h (τ - h - g + spring forces).

    Returns the pose that it moves to.
    """
    q1, q2 = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    _, x, y, jxl, jxr, jyl, jyr = pose
    m11, m12, m22, c1, c2, g1, g2 = dynamics_kernel(
        q1, q2, v1, v2, x, y, state[sv.PLANT_DEPTH], state[sv.PLANT_DEPTH_RATE], p, MODEL
    )
    vx, vy = jxl * v1 + jxr * v2, jyl * v1 + jyr * v2
    gx, gy, xx, xy, yy = stop_at_tool(p, h, x, y, vx, vy)
    if holds:
        dx, dy, dz, l_in = axis_kernel(x, y, p[FX], p[FY], p[FZ])
        l_out = max(p[AT.length] - state[sv.PLANT_DEPTH], SHORTEST_LEVER)
        hx, hy, hxx, hxy, hyy = hand_at_tool(p, h, wx, wy, wz, dx, dy, dz, l_in, l_out)
        gx, gy, xx, xy, yy = gx + hx, gy + hy, xx + hxx, xy + hxy, yy + hyy
    b1 = m11 * v1 + m12 * v2 + h * (t1 - c1 - g1 + jxl * gx + jyl * gy)
    b2 = m12 * v1 + m22 * v2 + h * (t2 - c2 - g2 + jxr * gx + jyr * gy)
    a11 = m11 + h * p[VISCOUS] + jxl * (xx * jxl + xy * jyl) + jyl * (xy * jxl + yy * jyl)
    a12 = m12 + jxl * (xx * jxr + xy * jyr) + jyl * (xy * jxr + yy * jyr)
    a22 = m22 + h * p[VISCOUS] + jxr * (xx * jxr + xy * jyr) + jyr * (xy * jxr + yy * jyr)
    v1, v2 = dry(a11, a12, a22, b1, b2, v1, v2, h * p[COULOMB])
    v1 = _rest(min(max(v1, -_SPEED), _SPEED))
    v2 = _rest(min(max(v2, -_SPEED), _SPEED))
    moved = pose_of(p, q1 + h * v1, q2 + h * v2)
    ok = moved[0]
    state[sv.PLANT_Q_LEFT] = q1 + h * v1 if ok else q1
    state[sv.PLANT_Q_RIGHT] = q2 + h * v2 if ok else q2
    state[sv.PLANT_QD_LEFT] = v1 if ok else 0.0
    state[sv.PLANT_QD_RIGHT] = v2 if ok else 0.0
    return moved if ok else pose


@njit
def _load(state: FloatArray, p: FloatArray, pose: Pose) -> float:
    """Weight and turning of the needle along its axis, inwards [N]."""
    _, x, y, jxl, jxr, jyl, jyr = pose
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    vx, vy = jxl * v1 + jxr * v2, jyl * v1 + jyr * v2
    return axial_load_kernel(vx, vy, x, y, state[sv.PLANT_DEPTH], p, MODEL)


@njit
def slide(
    state: FloatArray, p: FloatArray, h: float, tissue: float, holds: bool, pose: Pose
) -> None:
    """One substep along the needle; the seal's Coulomb friction is solved exactly (it can hold)."""
    depth, v = state[sv.PLANT_DEPTH], state[sv.PLANT_DEPTH_RATE]
    mass = p[AT.mass] + h * p[AT.seal_viscous]
    impulse = p[AT.mass] * v + h * _load(state, p, pose)
    if tissue * v > 0.0:  # opposes the motion: implicit, as the damper F / v
        mass += h * tissue / v
    else:
        impulse -= h * tissue
    if holds:
        k, spring = axial_spring(state, p)
        mass += h * p[AT.hand_axial_b] + h * h * k
        impulse += h * spring
    held = h * p[AT.seal]
    v = 0.0 if abs(impulse) <= held else (impulse - np.sign(impulse) * held) / mass
    v = _rest(v)
    moved = min(max(depth + h * v, p[AT.depth_min]), p[AT.depth_max])
    state[sv.PLANT_DEPTH_RATE] = v if moved == depth + h * v else 0.0
    state[sv.PLANT_DEPTH] = moved


@njit
def _rest(speed: float) -> float:
    return speed if abs(speed) > _SNAP else 0.0
