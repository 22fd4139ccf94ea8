"""A needle that a machine turns and a hand holds, moved by a tick: what every simulated robot does.

Sideways, in the machine's two joints q:

    M(q) q̈ + h(q, q̇) + g(q) + friction(q̇) = τ + Aᵀ F_hand + Jᵀ γ_stop,   A = G_perp J,

with M, h and g of links, tool and needle (`terms`), what the motors do (`drive`), and the hand a
spring-damper at the hub point, perpendicular to the needle, towards where the hand is; it goes
where it is wanted at a hand's speed (`hand_motion`). Along the needle, one mass: hand
spring-damper, the needle's weight and what its turning adds, the seal at the remote centre (Coulomb
and viscous) and AXIAL_FORCE. Stops: a stiff spring-damper on the tool point beyond the tilt limit,
an inelastic end of the depth range.

Springs, dampers and friction are integrated by linearly implicit Euler in substeps of at most half
a millisecond: stable for any stiffness and any step, and it takes energy, never adds any, where the
forces are passive. Coulomb friction of joints and seal is dry and solved exactly: it can hold.
Gravity and velocity terms are explicit. Motor torques are held over the tick, as a real amplifier
holds them, so the limits of a sampled controller show as they would on the device. A tissue force
that opposes the motion acts as the damper F / v: it can stop the needle but not turn it back.

What cannot be integrated (NaN in an input) is left out: a hand with NaN lets go, a torque or tissue
force with NaN is zero, a pose that the mechanism cannot have falls back to the starting pose.

A machine brings four compiled functions and compiles its own stage of them (see
`pantograph.stages`); `p` is the stage's array, the machine's own numbers from p[OWN] on:

- `pose_of(p, q1, q2) -> Pose`,
- `terms(state, p, pose) -> (m11, m12, m22, h1, h2, g1, g2)` at PLANT_Q_*, PLANT_QD_*, PLANT_DEPTH,
- `drive(state, p, h) -> (t1, t2, d11, d12, d22)`: torques at the joints, and the matrix that is
  added to M where they depend on the speeds at the end of the substep of h s,
- `settle(state, p, h)`: what the motors do once the joints have their new speeds.

Whoever takes these functions as arguments is inlined: an address of a function in compiled code
could not be kept on disk.
"""

from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.parameters import numbered
from app.mechanisms import hand_motion
from app.mechanisms.hand_motion import advance, grip_direction, take_hold, turn, wanted
from app.mechanisms.lever import (
    axis_kernel,
    force_map_kernel,
    hub_velocity_kernel,
    needle_axial_kernel,
)


class PlantPlaces(NamedTuple):
    """Needle, stops, what slides along the needle, hand, starting pose; what every machine has."""

    length: int
    radius: int
    stop_k: int
    stop_b: int
    depth_min: int
    depth_max: int
    mass: int
    seal: int
    seal_viscous: int
    hand_k: int
    hand_b: int
    hand_axial_k: int
    hand_axial_b: int
    hand_most: int
    start_left: int
    start_right: int
    start_depth: int
    fx: int  # remote centre [m]
    fy: int
    fz: int
    coulomb: int  # friction of each joint [N·m, N·m·s/rad]
    viscous: int
    gx: int  # gravity [m/s²]
    gy: int
    gz: int
    needle_mass: int  # [kg]
    needle_offset: int  # its centre beyond the remote centre at zero depth [m]


AT: Final = numbered(PlantPlaces)
MOTION: Final = len(AT)
"""Place of the hand's bounds and memory, see `hand_motion`."""
OWN: Final = MOTION + hand_motion.SIZE
"""Place from which on the numbers are the machine's own."""

SHORTEST_LEVER: Final = 0.01  # [m] of needle outside the fulcrum

Pose = tuple[bool, float, float, float, float, float, float]
"""Whether the mechanism can have the pose, its tool point and Jacobian (jxl, jxr, jyl, jyr)."""

Compiled = Any
"""A compiled function of a machine: `pose_of`, `terms`, `drive` or `settle`."""

System = tuple[float, float, float, float, float]
"""Force at the tool (x, y) and the matrix (xx, xy, yy) that its spring-damper adds."""


@njit
def spring(
    p: FloatArray, gx: float, gy: float, gz: float, dx: float, dy: float, dz: float, l_out: float
) -> tuple[float, float, float, float]:
    """Spring of a hand at g, at the hub, across the needle: (stiffness in effect, fx, fy, fz)."""
    sx, sy, sz = -l_out * (gx - dx), -l_out * (gy - dy), -l_out * (gz - dz)
    along = sx * dx + sy * dy + sz * dz
    sx, sy, sz = sx - along * dx, sy - along * dy, sz - along * dz
    stretch = np.sqrt(sx * sx + sy * sy + sz * sz)
    k = p[AT.hand_k]
    if k * stretch > p[AT.hand_most]:
        k = p[AT.hand_most] / stretch
    return k, k * sx, k * sy, k * sz


@njit
def axial_spring(state: FloatArray, p: FloatArray) -> tuple[float, float]:
    """Hand spring along the needle: (stiffness in effect [N/m], force inwards [N])."""
    stretch = state[sv.GRIP_DEPTH] - state[sv.PLANT_DEPTH]
    k = p[AT.hand_axial_k]
    if k * abs(stretch) > p[AT.hand_most]:
        k = p[AT.hand_most] / abs(stretch)
    return k, k * stretch


@njit
def hand_at_tool(
    p: FloatArray,
    h: float,
    hx: float,
    hy: float,
    hz: float,
    dx: float,
    dy: float,
    dz: float,
    l_in: float,
    l_out: float,
) -> System:
    """Hand force at the tool and its part of the system matrix: (gx, gy, xx, xy, yy)."""
    k, fx, fy, fz = spring(p, hx, hy, hz, dx, dy, dz, l_out)
    gx, gy = force_map_kernel(fx, fy, fz, dx, dy, dz, l_in, l_out)
    c = (h * p[AT.hand_b] + h * h * k) * (l_out / l_in) ** 2
    return gx, gy, c * (1.0 - dx * dx), -c * dx * dy, c * (1.0 - dy * dy)


@njit
def stop_at_tool(p: FloatArray, h: float, x: float, y: float, vx: float, vy: float) -> System:
    """Force of the tilt stop at the tool, likewise; it only pushes inwards."""
    ex, ey = x - p[AT.fx], y - p[AT.fy]
    radius = np.sqrt(ex * ex + ey * ey)
    beyond = radius - p[AT.radius]
    if not beyond > 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    ex, ey = ex / radius, ey / radius
    damping = p[AT.stop_b] if ex * vx + ey * vy > 0.0 else 0.0
    c = h * damping + h * h * p[AT.stop_k]
    push = -p[AT.stop_k] * beyond
    return push * ex, push * ey, c * ex * ex, c * ex * ey, c * ey * ey


_SPEED: Final = 50.0  # [rad/s]
_SNAP: Final = 1e-12  # slower than this is at rest: subnormal numbers cost 20 times more
_ROUNDS: Final = 40  # of joints that may stick; each leaves at most a quarter of the error


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


@njit(cache=False, forceinline=True)
def swing(
    state: FloatArray,
    p: FloatArray,
    h: float,
    holds: bool,
    wx: float,
    wy: float,
    wz: float,
    pose: Pose,
    pose_of: Compiled,
    terms: Compiled,
    drive: Compiled,
    settle: Compiled,
) -> Pose:
    """One substep sideways: solve (M + h D + h² K) q̇⁺ = M q̇ + h (τ - h - g + spring forces).

    Returns the pose that it moves to.
    """
    q1, q2 = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    _, x, y, jxl, jxr, jyl, jyr = pose
    m11, m12, m22, c1, c2, g1, g2 = terms(state, p, pose)
    t1, t2, d11, d12, d22 = drive(state, p, h)
    vx, vy = jxl * v1 + jxr * v2, jyl * v1 + jyr * v2
    gx, gy, xx, xy, yy = stop_at_tool(p, h, x, y, vx, vy)
    if holds:
        dx, dy, dz, l_in = axis_kernel(x, y, p[AT.fx], p[AT.fy], p[AT.fz])
        l_out = max(p[AT.length] - state[sv.PLANT_DEPTH], SHORTEST_LEVER)
        hx, hy, hxx, hxy, hyy = hand_at_tool(p, h, wx, wy, wz, dx, dy, dz, l_in, l_out)
        gx, gy, xx, xy, yy = gx + hx, gy + hy, xx + hxx, xy + hxy, yy + hyy
    b1 = m11 * v1 + m12 * v2 + h * (t1 - c1 - g1 + jxl * gx + jyl * gy)
    b2 = m12 * v1 + m22 * v2 + h * (t2 - c2 - g2 + jxr * gx + jyr * gy)
    a11 = m11 + h * p[AT.viscous] + jxl * (xx * jxl + xy * jyl) + jyl * (xy * jxl + yy * jyl)
    a12 = m12 + jxl * (xx * jxr + xy * jyr) + jyl * (xy * jxr + yy * jyr)
    a22 = m22 + h * p[AT.viscous] + jxr * (xx * jxr + xy * jyr) + jyr * (xy * jxr + yy * jyr)
    a11, a12, a22 = a11 + d11, a12 + d12, a22 + d22
    v1, v2 = dry(a11, a12, a22, b1, b2, v1, v2, h * p[AT.coulomb])
    v1 = _rest(min(max(v1, -_SPEED), _SPEED))
    v2 = _rest(min(max(v2, -_SPEED), _SPEED))
    moved = pose_of(p, q1 + h * v1, q2 + h * v2)
    ok = moved[0]
    state[sv.PLANT_Q_LEFT] = q1 + h * v1 if ok else q1
    state[sv.PLANT_Q_RIGHT] = q2 + h * v2 if ok else q2
    state[sv.PLANT_QD_LEFT] = v1 if ok else 0.0
    state[sv.PLANT_QD_RIGHT] = v2 if ok else 0.0
    settle(state, p, h)
    return moved if ok else pose


@njit
def _load(state: FloatArray, p: FloatArray, pose: Pose) -> float:
    """Weight and turning of the needle along its axis, inwards [N]."""
    _, x, y, jxl, jxr, jyl, jyr = pose
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    vx, vy = jxl * v1 + jxr * v2, jyl * v1 + jyr * v2
    dx, dy, dz, l_in = axis_kernel(x, y, p[AT.fx], p[AT.fy], p[AT.fz])
    gx, gy, gz = p[AT.gx], p[AT.gy], p[AT.gz]
    s = state[sv.PLANT_DEPTH] + p[AT.needle_offset]
    return needle_axial_kernel(vx, vy, gx, gy, gz, dx, dy, dz, l_in, s, p[AT.needle_mass])


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


SUBSTEP: Final = 0.5e-3
"""Longest substep [s]; by measurement: `acus study plant_substeps`."""
LONGEST_STEP: Final = 5e-3  # [s] as the loop clamps it
_AXIAL: Final = 50.0  # [N]


@njit
def bounded(value: float, limit: float) -> float:
    """Return `value` within ±limit; NaN counts as zero."""
    return 0.0 if np.isnan(value) else min(max(value, -limit), limit)


@njit(cache=False, forceinline=True)
def _recover(state: FloatArray, p: FloatArray, pose_of: Compiled) -> Pose:
    """Go back to the starting pose, at rest, if the pose is none the mechanism can have.

    Returns the pose.
    """
    q1, q2 = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    pose = pose_of(p, q1, q2)
    if not (np.isfinite(q1 + q2 + v1 + v2) and pose[0]):
        state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT] = p[AT.start_left], p[AT.start_right]
        state[sv.PLANT_QD_LEFT] = state[sv.PLANT_QD_RIGHT] = 0.0
        pose = pose_of(p, p[AT.start_left], p[AT.start_right])
    if not np.isfinite(state[sv.PLANT_DEPTH] + state[sv.PLANT_DEPTH_RATE]):
        state[sv.PLANT_DEPTH], state[sv.PLANT_DEPTH_RATE] = p[AT.start_depth], 0.0
    return pose


@njit
def _report(state: FloatArray, p: FloatArray, holds: bool, pose: Pose) -> None:
    """Write the force of the hand across (PULL_*) and along (PUSH) the needle."""
    state[sv.PULL_X] = state[sv.PULL_Y] = state[sv.PULL_Z] = state[sv.PUSH] = 0.0
    ok, x, y, jxl, jxr, jyl, jyr = pose
    if not (holds and ok):
        return
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    dx, dy, dz, l_in = axis_kernel(x, y, p[AT.fx], p[AT.fy], p[AT.fz])
    l_out = max(p[AT.length] - state[sv.PLANT_DEPTH], SHORTEST_LEVER)
    gx, gy, gz = grip_direction(state)
    _, fx, fy, fz = spring(p, gx, gy, gz, dx, dy, dz, l_out)
    ux, uy, uz = hub_velocity_kernel(
        jxl * v1 + jxr * v2, jyl * v1 + jyr * v2, dx, dy, dz, l_in, l_out
    )
    state[sv.PULL_X] = fx - p[AT.hand_b] * ux
    state[sv.PULL_Y] = fy - p[AT.hand_b] * uy
    state[sv.PULL_Z] = fz - p[AT.hand_b] * uz
    state[sv.PUSH] = axial_spring(state, p)[1] - p[AT.hand_axial_b] * state[sv.PLANT_DEPTH_RATE]


@njit
def _move_hand(state: FloatArray, p: FloatArray, dt: float, pose: Pose) -> bool:
    """Move GRIP_* towards HAND_*; returns whether the hand holds."""
    holds, wx, wy, wz = wanted(state)
    ok, x, y, _, _, _, _ = pose
    dx, dy, _, _ = axis_kernel(x, y, p[AT.fx], p[AT.fy], p[AT.fz])
    if not ok:
        dx, dy = 0.0, 0.0
    if take_hold(state, p, MOTION, holds, dx, dy, state[sv.PLANT_DEPTH]) and dt > 0.0:
        lever = max(p[AT.length] - state[sv.PLANT_DEPTH], SHORTEST_LEVER)
        turn(state, p, MOTION, dt, wx, wy, wz, lever)
        advance(state, p, MOTION, dt)
    return holds


@njit(cache=False, forceinline=True)
def move_needle(
    state: FloatArray,
    parameters: FloatArray,
    substep: float,
    pose_of: Compiled,
    terms: Compiled,
    drive: Compiled,
    settle: Compiled,
) -> None:
    """Move hand, machine and needle by DT (at most 5 ms) and write the forces of the hand.

    In substeps of at most `substep` [s]; the machine's functions: see the module.
    """
    pose = _recover(state, parameters, pose_of)
    dt = min(state[sv.DT], LONGEST_STEP) if state[sv.DT] > 0.0 else 0.0  # not for NaN
    holds = _move_hand(state, parameters, dt, pose)
    if dt > 0.0:
        gx, gy, gz = grip_direction(state)
        substeps = int(np.ceil(dt / substep - 1e-9))
        h = dt / max(substeps, 1)
        tissue = bounded(state[sv.AXIAL_FORCE], _AXIAL)
        for _ in range(substeps):
            slide(state, parameters, h, tissue, holds, pose)
            pose = swing(
                state, parameters, h, holds, gx, gy, gz, pose, pose_of, terms, drive, settle
            )
    _report(state, parameters, holds, pose)
